// Results as a table for people: aligned columns; of a distance the digits that its bracket proves. Two passes over the
// records: widths, then lines.
#include "io/results/record.h"
#include "io/text.h"

#include <math.h>
#include <string.h>

enum { TIME, A, B, STATUS, DISTANCE, WIDTH, STAGE, STEPS, NOTE, COLUMNS };
enum { CELL = 96 };

/// One line of the table; texts are cut where they are longer than a cell.
typedef struct table_row {
    char cell[COLUMNS][CELL];
} table_row;

// Sets a cell; a name from a file must not end the line, control the terminal, or turn what stands beside it round.
static void set_cell(char cell[CELL], const char *text) {
    size_t n = 0;
    while (*text) {
        int length = utf8_get_length((const unsigned char *)text), is_shown = ovoid_text_get_visible_length(text) > 0;
        if (!length) length = 1;
        size_t needed = is_shown ? (size_t)length : 1;
        if (n + needed > CELL - 1) break;
        memcpy(cell + n, is_shown ? text : "?", needed);
        n += needed;
        text += length;
    }
    cell[n] = 0;
}

static void set_number(char cell[CELL], double value) { number_write(cell, value, 9); }

static void set_body(char cell[CELL], const char *name, size_t index, uint32_t part) {
    if (name)
        set_cell(cell, name);
    else
        snprintf(cell, CELL, "%zu", index);
    // A compound's part follows its name, which is cut to make room.
    char number[16];
    if (part == OVOID_RECORD_NO_PART) return;
    int width = snprintf(number, sizeof number, "[%lu]", (unsigned long)part);
    size_t end = strlen(cell);
    if (end + (size_t)width >= CELL) {
        end = CELL - 1 - (size_t)width;
        while (end > 0 && ((unsigned char)cell[end] & 0xc0) == 0x80) end--;
    }
    memcpy(cell + end, number, (size_t)width + 1);
}

// The decimal of fewest digits in a bracket; of numbers from 1 to 1e9 no fewer than stand before the point.
static size_t write_shortest(char text[32], double lower, double upper) {
    double middle = lower + (upper - lower) / 2, value, size = fabs(middle);
    size_t length = 0;
    if (lower <= 0 && upper >= 0) middle = 0;
    for (int digits = size >= 1 && size < 1e9 ? 1 + (int)log10(size) : 1; digits <= 17; digits++) {
        length = number_write(text, middle, digits);
        if (number_read(text, text + length, &value) && value >= lower && value <= upper) break;
    }
    return length;
}

// 1 where one number would hide what the bracket leaves open: it is wider than the digits of a table show, or holds 0
// and the bodies are not proven to touch.
static int is_wide(const ovoid_answer *answer) {
    double larger = fmax(fabs(answer->lower), fabs(answer->upper)), width = answer->upper - answer->lower;
    if (answer->status == OVOID_UNDECIDED || !isfinite(width)) return 1;
    return answer->status != OVOID_TOUCHING && width > 1e-6 * larger;
}

// Both ends, with as many digits as tell them apart.
static size_t write_ends(char text[64], const ovoid_answer *answer) {
    char low[32], high[32];
    for (int digits = 6; digits <= 17; digits += 11) {
        number_write(low, answer->lower, digits);
        number_write(high, answer->upper, digits);
        if (strcmp(low, high) != 0) break;
    }
    return (size_t)snprintf(text, 64, "%s .. %s", low, high);
}

size_t ovoid_answer_write_distance(char text[64], const ovoid_answer *answer) {
    return is_wide(answer) ? write_ends(text, answer) : write_shortest(text, answer->lower, answer->upper);
}

// The words about the margin; empty where there is none, and where the bodies are farther.
static const char *name_within(const ovoid_record *record) {
    switch (*record_find_within(record)) {
    case 'y': return "within";
    case 'a': return "at the margin";
    case 'u': return "not proven";
    default: return "";
    }
}

// What a body is where it is no plain hull: "solid", "surface", or by how much its hull is off; else "".
static void name_mesh(char text[40], ovoid_mesh_kind kind, const ovoid_convexity *mesh) {
    text[0] = 0;
    if (kind == OVOID_MESH_SOLID || kind == OVOID_MESH_SURFACE)
        snprintf(text, 40, "%s", ovoid_mesh_kind_get_name(kind));
    else if (kind == OVOID_MESH_HULL && mesh->allowance > 0) {
        char number[32];
        number_write(number, mesh->allowance, 2);
        snprintf(text, 40, "hull to %s", number);
    }
}

// Adds words to a note, behind a comma where there are some before.
static void add_note(char cell[CELL], const char *before, const char *words) {
    size_t used = strlen(cell);
    if (*words) snprintf(cell + used, CELL - used, "%s%s%s", used ? ", " : "", before, words);
}

// What else there is to say: what the bodies are, an impact, the margin, and the limit that left the bracket wide.
static void set_note(char cell[CELL], const ovoid_record *record) {
    ovoid_limit limit = record->answer.limit;
    const char *impact = isfinite(record->hit_after) ? "impact" : "impact not proven";
    const char *note = record_is_impact(record) ? impact : name_within(record);
    int is_ended = limit != OVOID_LIMIT_NONE && limit != OVOID_LIMIT_ANSWERED;
    const char *words = is_ended ? "ended by " : "", *name = is_ended ? ovoid_limit_get_name(limit) : "";
    char mesh[40];
    cell[0] = 0;
    name_mesh(mesh, record->kind_a, &record->mesh_a);
    add_note(cell, "a ", mesh);
    name_mesh(mesh, record->kind_b, &record->mesh_b);
    add_note(cell, "b ", mesh);
    add_note(cell, "", note);
    add_note(cell, words, name);
}

static table_row make_row(const ovoid_record *record) {
    const ovoid_answer *answer = &record->answer;
    table_row row;
    int has_parts = (record->fields & OVOID_RECORD_PARTS) != 0;
    row.cell[TIME][0] = 0;
    if (record->fields & OVOID_RECORD_TIME) set_number(row.cell[TIME], record->time);
    set_body(row.cell[A], record->a, record->index_a, has_parts ? record->part_a : OVOID_RECORD_NO_PART);
    set_body(row.cell[B], record->b, record->index_b, has_parts ? record->part_b : OVOID_RECORD_NO_PART);
    set_cell(row.cell[STATUS], ovoid_status_get_name(answer->status));
    ovoid_answer_write_distance(row.cell[DISTANCE], answer);
    number_write(row.cell[WIDTH], answer->upper - answer->lower, 2);
    set_cell(row.cell[STAGE], ovoid_stage_get_name(answer->stage));
    snprintf(row.cell[STEPS], CELL, "%lu", (unsigned long)answer->iterations);
    set_note(row.cell[NOTE], record);
    return row;
}

// The title, with the unit of the lengths behind the names of the columns.
static table_row make_head(const char *unit) {
    table_row head = {{"time", "a", "b", "status", "distance", "width", "stage", "steps", ""}};
    if (!unit || !unit[0]) return head;
    snprintf(head.cell[DISTANCE], CELL, "distance/%.20s", unit);
    snprintf(head.cell[WIDTH], CELL, "width/%.20s", unit);
    return head;
}

// The number of characters of a UTF-8 text.
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

// Writes a row from the column `first` on: TIME where there are times, else A.
static void write_row(FILE *file, const int widths[COLUMNS], int first, const table_row *row) {
    int last = NOTE;
    while (last > first && !row->cell[last][0]) last--;
    for (int i = first; i <= last; i++) {
        int is_number = i == TIME || i == DISTANCE || i == WIDTH || i == STEPS;
        int blanks = widths[i] - text_width(row->cell[i]);
        if (i > first) fputs("  ", file);
        // No blanks at the line's end.
        if (is_number)
            fprintf(file, "%*s%s", blanks, "", row->cell[i]);
        else
            fprintf(file, "%s%*s", row->cell[i], i < last ? blanks : 0, "");
    }
    fputc('\n', file);
}

ovoid_code ovoid_records_write_table(FILE *file, const ovoid_record *records, size_t count, const char *unit) {
    int widths[COLUMNS] = {0}, first = count && records[0].fields & OVOID_RECORD_TIME ? TIME : A;
    const table_row head = make_head(unit);
    widen(widths, &head);
    for (size_t i = 0; i < count; i++) {
        table_row row = make_row(&records[i]);
        widen(widths, &row);
    }
    write_row(file, widths, first, &head);
    for (size_t i = 0; i < count; i++) {
        table_row row = make_row(&records[i]);
        write_row(file, widths, first, &row);
        (void)ovoid_record_write_contacts(file, &records[i]);
    }
    return ferror(file) ? OVOID_ERROR_FILE : OVOID_OK;
}
