// The states of a check, written. Rows of a table and lines of CSV are alike: one a state, or one a near pair.
#include "robot/report.h"

#include "base/message.h"
#include "io/fields.h"

#include <math.h>
#include <string.h>

/// What a row has.
enum { ROW_PAIR = 1, ROW_NEAR = 2 };

/// One row: a pair of a state, or a state without one.
typedef struct pair_row {
    const ovoid_robot_side *a, *b; ///< NULL: no pair
    ovoid_robot_near pair;
    int is_near;            ///< 0: the pair of the answer, without points
    const double *gradient; ///< NULL: none
} pair_row;

#define NEAR(member) FIELD_AT(ovoid_robot_near, member)
static const field pair_fields[] = {
    {"lower", FIELD_NUMBER, NEAR(lower), .column = FIELD_COLUMN, .bit = ROW_PAIR},
    {"upper", FIELD_NUMBER, NEAR(upper), .column = FIELD_COLUMN, .bit = ROW_PAIR},
    {"point_a", FIELD_VECTOR, NEAR(point_a), .column = ROW_NEAR, .bit = ROW_NEAR},
    {"point_b", FIELD_VECTOR, NEAR(point_b), .column = ROW_NEAR, .bit = ROW_NEAR},
    {"normal", FIELD_VECTOR, NEAR(normal), .column = ROW_NEAR, .bit = ROW_NEAR},
};
static const field_table pair_table = FIELD_TABLE(ovoid_robot_near, pair_fields);

static unsigned get_columns(const report_form *form) { return FIELD_COLUMN | (form->has_near ? ROW_NEAR : 0u); }

static uint64_t get_bits(const pair_row *row) { return (row->a ? ROW_PAIR : 0u) | (row->is_near ? ROW_NEAR : 0u); }

static size_t get_row_count(const report_form *form, const report_state *s) {
    return form->has_near && s->count ? s->count : 1;
}

static pair_row get_row(const report_form *form, const report_state *s, size_t i) {
    const ovoid_robot_answer *answer = &s->answer;
    size_t n = form->states->variable_count;
    if (form->has_near && s->count) {
        const ovoid_robot_near *near = &s->near[i];
        return (pair_row){&near->a, &near->b, *near, 1, s->gradients ? s->gradients + i * n : NULL};
    }
    if (!cell_has_pair(answer)) return (pair_row){.a = NULL};
    return (pair_row){&answer->a, &answer->b, {.lower = answer->lower, .upper = answer->upper}, 0, NULL};
}

// ---- JSON Lines

static void write_pair(FILE *file, const report_form *form, const pair_row *row) {
    fputs("\"a\":", file);
    cell_write_side_json(file, form->cell, row->a);
    fputs(",\"b\":", file);
    cell_write_side_json(file, form->cell, row->b);
    fields_write_members(file, "\"", ",", (fields_item){&pair_table, &row->pair, get_bits(row)});
    for (size_t i = 0; i < form->states->variable_count && row->gradient; i++) {
        fputs(i ? "," : ",\"gradient\":[", file);
        json_write_number(file, row->gradient[i]);
    }
    if (row->gradient && form->states->variable_count)
        fprintf(file, "],\"gradient_is_shown\":%s", row->pair.has_gradient ? "true" : "false");
}

void report_write_json(FILE *file, const report_form *form, const report_state *s) {
    const char *name = states_get_name(form->states, s->index);
    const report_form plain = {form->cell, form->states, 0, 0};
    pair_row found = get_row(&plain, s, 0);
    fprintf(file, "{\"state\":%zu", s->index);
    if (name) {
        fputs(",\"name\":", file);
        ovoid_text_write_json(file, name);
    }
    fprintf(file, ",\"status\":\"%s\"", cell_get_status_name(s->answer.status));
    if (s->answer.status == OVOID_ROBOT_REFUSED) {
        fprintf(file, ",\"code\":\"%s\",\"variable\":", ovoid_code_get_name(s->answer.code));
        cell_write_variable_json(file, form->cell, s->answer.variable);
    }
    if (s->answer.status == OVOID_ROBOT_UNDECIDED && !found.a)
        fprintf(file, ",\"code\":\"%s\"", ovoid_code_get_name(s->answer.code));
    if (found.a) {
        fputc(',', file);
        write_pair(file, form, &found);
    }
    if (form->has_near) fputs(",\"near\":[", file);
    for (size_t i = 0; i < s->count && form->has_near; i++) {
        pair_row row = get_row(form, s, i);
        fputs(i ? ",{" : "{", file);
        write_pair(file, form, &row);
        fputc('}', file);
    }
    fputs(form->has_near ? "]}\n" : "}\n", file);
}

// ---- CSV

void report_write_csv_header(FILE *file, const report_form *form) {
    fputs("state,status," CELL_PAIR_COLUMNS, file);
    fields_write_csv_header(file, ",", &pair_table, get_columns(form));
    for (size_t i = 0; i < form->states->variable_count && form->has_gradient; i++) {
        char name[CELL_SIDE_ROOM + 2] = "d ";
        cell_format_variable(name + 2, form->cell, i);
        fputc(',', file);
        ovoid_text_write_csv(file, name);
    }
    fputc('\n', file);
}

static void write_numbers(FILE *file, const double *numbers, size_t count) {
    for (size_t i = 0; i < count; i++) {
        fputc(',', file);
        if (numbers) fprintf(file, "%.17g", numbers[i]);
    }
}

static void write_csv_row(FILE *file, const report_form *form, const pair_row *row) {
    cell_write_pair_csv(file, form->cell, row->a, row->b);
    fields_write_csv(file, ",", (fields_item){&pair_table, &row->pair, get_bits(row)}, get_columns(form));
    if (form->has_gradient) write_numbers(file, row->gradient, form->states->variable_count);
    fputc('\n', file);
}

void report_write_csv(FILE *file, const report_form *form, const report_state *s) {
    for (size_t i = 0; i < get_row_count(form, s); i++) {
        pair_row row = get_row(form, s, i);
        fprintf(file, "%zu,%s,", s->index, cell_get_status_name(s->answer.status));
        write_csv_row(file, form, &row);
    }
}

// ---- tables

/// The widths of the columns with names.
typedef struct widths {
    int state, a, b;
} widths;

static int longer(int width, int length) { return length > width ? length : width; }

static widths measure(const report_form *form, const report_state *states, size_t count) {
    char text[CELL_SIDE_ROOM];
    widths w = {5, 1, 1};
    for (size_t k = 0; k < count; k++) {
        const char *name = states_get_name(form->states, states[k].index);
        w.state = longer(w.state, name ? (int)strlen(name) : snprintf(text, sizeof text, "%zu", states[k].index));
        for (size_t i = 0; i < get_row_count(form, &states[k]); i++) {
            pair_row row = get_row(form, &states[k], i);
            if (!row.a) continue;
            w.a = longer(w.a, cell_format_side(text, form->cell, row.a));
            w.b = longer(w.b, cell_format_side(text, form->cell, row.b));
        }
    }
    w.state = w.state > 40 ? 40 : w.state;
    return w;
}

/// Writes a text, padded, with what could control a terminal shown.
static void write_padded(FILE *file, const char *text, int width) {
    message_write_text(file, text);
    fprintf(file, "%*s  ", width > (int)strlen(text) ? width - (int)strlen(text) : 0, "");
}

static void write_side(FILE *file, const report_form *form, const ovoid_robot_side *side, int width) {
    char text[CELL_SIDE_ROOM] = "";
    if (side) (void)cell_format_side(text, form->cell, side);
    write_padded(file, text, width);
}

/// Derivatives of joints that do not move the pair are zero but for the rounding of both sides, which cancel.
#define GRADIENT_ZERO 1e-12

/// "shoulder -0.99 wrist 0.1"; what is zero is left out.
static void write_gradient(FILE *file, const report_form *form, const pair_row *row) {
    for (size_t i = 0; i < form->states->variable_count; i++) {
        if (fabs(row->gradient[i]) < GRADIENT_ZERO) continue;
        fputs("  ", file);
        cell_write_variable_name(file, form->cell, i);
        fprintf(file, " %.6g", row->gradient[i]);
    }
    if (!row->pair.has_gradient) fputs("  (not shown)", file);
}

static void write_state(FILE *file, const report_form *form, const report_state *s, const widths *w) {
    const char *name = states_get_name(form->states, s->index);
    char number[32], bracket[64];
    snprintf(number, sizeof number, "%zu", s->index);
    for (size_t i = 0; i < get_row_count(form, s); i++) {
        pair_row row = get_row(form, s, i);
        write_padded(file, name ? name : number, w->state);
        fputs(cell_get_status_name(s->answer.status), file);
        if (row.a) {
            fprintf(file, "%*s", 11 - (int)strlen(cell_get_status_name(s->answer.status)), "");
            write_side(file, form, row.a, w->a);
            write_side(file, form, row.b, w->b);
            cell_format_bracket(bracket, row.pair.lower, row.pair.upper);
            fputs(bracket, file);
        }
        if (row.gradient) write_gradient(file, form, &row);
        if (s->answer.status == OVOID_ROBOT_REFUSED) {
            fputs("    ", file);
            cell_write_refusal(file, form->cell, &s->answer, form->states->q + s->index * form->states->variable_count);
        }
        if (s->answer.status == OVOID_ROBOT_UNDECIDED && !row.a) fputs("  nothing is compared", file);
        fputc('\n', file);
    }
}

void report_write_table(FILE *file, const report_form *form, const report_state *states, size_t count) {
    widths w = measure(form, states, count);
    fprintf(file, "%-*s  status     %-*s  %-*s  distance%s\n", w.state, "state", w.a, "a", w.b, "b",
            form->has_gradient ? "  by the joints" : "");
    for (size_t k = 0; k < count; k++) write_state(file, form, &states[k], &w);
}
