// Results as a table for people: aligned columns, nine digits. Two passes over the records: widths, then lines.
#include "io/text.h"

#include <math.h>
#include <string.h>

enum { COLUMNS = 8, CELL = 96 };

/// One line of the table: texts that are cut where they are longer than a cell.
typedef struct table_row {
    char cell[COLUMNS][CELL];
} table_row;

// A name from a file must not end the line or speak to the terminal.
static void set_cell(char cell[CELL], const char *text) {
    size_t n = 0;
    for (; text[n] && n < CELL - 1; n++) {
        unsigned char c = (unsigned char)text[n];
        cell[n] = c < 0x20 || c == 0x7f ? '?' : text[n];
    }
    // No character of several bytes is cut in half.
    if (text[n])
        while (n > 0 && ((unsigned char)text[n] & 0xc0) == 0x80) n--;
    cell[n] = 0;
}

static void set_number(char cell[CELL], double value) { number_write(cell, value, 9); }

static void set_body(char cell[CELL], const char *name, size_t index) {
    if (name)
        set_cell(cell, name);
    else
        snprintf(cell, CELL, "%zu", index);
}

// What is proven of the margin; nothing where there is none.
static const char *name_within(const ovoid_answer *answer, double margin) {
    if (!(margin >= 0)) return "";
    int within = ovoid_answer_is_within(answer, margin);
    return within > 0 ? "within" : within == 0 ? "" : "not proven";
}

static table_row make_row(const ovoid_record *record, double margin) {
    const ovoid_answer *answer = &record->answer;
    table_row row;
    set_body(row.cell[0], record->a, record->index_a);
    set_body(row.cell[1], record->b, record->index_b);
    set_cell(row.cell[2], ovoid_status_get_name(answer->status));
    if (answer->status == OVOID_UNDECIDED)
        snprintf(row.cell[2], CELL, "%s: %s", ovoid_status_get_name(answer->status),
                 ovoid_limit_get_name(answer->limit));
    set_number(row.cell[3], answer->lower);
    set_number(row.cell[4], answer->upper);
    set_cell(row.cell[5], ovoid_stage_get_name(answer->stage));
    snprintf(row.cell[6], CELL, "%lu", (unsigned long)answer->iterations);
    set_cell(row.cell[7], name_within(answer, margin));
    return row;
}

static const table_row head = {{"a", "b", "status", "lower", "upper", "stage", "steps", ""}};

// Characters, not bytes: those of UTF-8 that begin one.
static int text_width(const char *text) {
    int width = 0;
    for (; *text; text++) width += ((unsigned char)*text & 0xc0) != 0x80;
    return width;
}

static void widen(int widths[COLUMNS], const table_row *row) {
    for (int i = 0; i < COLUMNS; i++) {
        int width = text_width(row->cell[i]);
        if (width > widths[i]) widths[i] = width;
    }
}

static void write_row(FILE *file, const int widths[COLUMNS], const table_row *row) {
    int last = COLUMNS - 1;
    while (last > 0 && !row->cell[last][0]) last--;
    for (int i = 0; i <= last; i++) {
        int is_number = i == 3 || i == 4 || i == 6;
        int blanks = widths[i] - text_width(row->cell[i]);
        if (i) fputs("  ", file);
        // No blanks at the line's end.
        if (is_number)
            fprintf(file, "%*s%s", blanks, "", row->cell[i]);
        else
            fprintf(file, "%s%*s", row->cell[i], i < last ? blanks : 0, "");
    }
    fputc('\n', file);
}

ovoid_code ovoid_records_write_table(FILE *file, const ovoid_record *records, size_t count, double margin) {
    int widths[COLUMNS] = {0};
    widen(widths, &head);
    for (size_t i = 0; i < count; i++) {
        table_row row = make_row(&records[i], margin);
        widen(widths, &row);
    }
    write_row(file, widths, &head);
    for (size_t i = 0; i < count; i++) {
        table_row row = make_row(&records[i], margin);
        write_row(file, widths, &row);
    }
    return ferror(file) ? OVOID_ERROR_FILE : OVOID_OK;
}
