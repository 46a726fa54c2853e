// What ovoid robot spheres tells: of each link's spheres what they leave out and what they add, and of states where the
// two disagree.
#include "robot/spheres/spheres.h"

#include "base/message.h"
#include "io/fields.h"

#include <math.h>
#include <string.h>

enum { CELL_ROOM = 48 };

// ---- table

/// A share of a volume in per cent: both ends where they are not alike.
static void format_share(char text[CELL_ROOM], ovoid_robot_bracket part, ovoid_robot_bracket whole) {
    char lower[16], upper[16];
    if (!(whole.lower > 0) || !(part.upper < INFINITY)) {
        snprintf(text, CELL_ROOM, "-"); // a link without volume
        return;
    }
    snprintf(lower, sizeof lower, "%.1f", 100 * part.lower / whole.upper);
    snprintf(upper, sizeof upper, "%.1f", 100 * part.upper / whole.lower);
    if (strcmp(lower, upper) == 0)
        snprintf(text, CELL_ROOM, "%s %%", lower);
    else
        snprintf(text, CELL_ROOM, "%s .. %s %%", lower, upper);
}

static void format_depth(char text[CELL_ROOM], const sphere_row *row) {
    ovoid_robot_bracket d = row->audit.depth;
    if (!row->count)
        snprintf(text, CELL_ROOM, "no spheres");
    else if (d.upper <= 0)
        snprintf(text, CELL_ROOM, "covered");
    else if (d.lower > 0)
        snprintf(text, CELL_ROOM, "%.4g", d.lower);
    else
        snprintf(text, CELL_ROOM, "not proven, %.2g", d.upper);
}

static int find_width(const sphere_report *r) {
    int width = 4;
    for (int k = 0; k < r->set_count; k++)
        for (size_t i = 0; i < r->sets[k].row_count; i++) {
            int size = (int)strlen(r->cell->description.links[r->sets[k].rows[i].link].name);
            if (size > width) width = size;
        }
    return width;
}

static ovoid_robot_bracket add(ovoid_robot_bracket a, ovoid_robot_bracket b) {
    return (ovoid_robot_bracket){a.lower + b.lower, a.upper + b.upper};
}

/// The sums over the links that have spheres.
static sphere_row sum_rows(const sphere_set *set) {
    sphere_row sum = {.count = 0};
    for (size_t i = 0; i < set->row_count; i++) {
        const sphere_row *row = &set->rows[i];
        if (!row->count) continue;
        sum.count += row->count;
        sum.audit.link = add(sum.audit.link, row->audit.link);
        sum.audit.uncovered = add(sum.audit.uncovered, row->audit.uncovered);
        sum.audit.excess = add(sum.audit.excess, row->audit.excess);
    }
    return sum;
}

static void write_row(FILE *file, const sphere_row *row, const char *depth) {
    char uncovered[CELL_ROOM], excess[CELL_ROOM];
    if (!row->count) {
        fprintf(file, "      0  %s\n", depth);
        return;
    }
    format_share(uncovered, row->audit.uncovered, row->audit.link);
    format_share(excess, row->audit.excess, row->audit.link);
    fprintf(file, "%7zu  %-19s  %-15s  %s\n", row->count, depth, uncovered, excess);
}

static void write_set(FILE *file, const sphere_report *r, const sphere_set *set, int width) {
    char depth[CELL_ROOM];
    fprintf(file, "%-*s  spheres  deepest uncovered    uncovered        outside\n", width, set->name);
    for (size_t i = 0; i < set->row_count; i++) {
        const char *name = r->cell->description.links[set->rows[i].link].name;
        message_write_text(file, name);
        fprintf(file, "%*s  ", width - (int)strlen(name), "");
        format_depth(depth, &set->rows[i]);
        write_row(file, &set->rows[i], depth);
    }
    sphere_row sum = sum_rows(set);
    fprintf(file, "%-*s  ", width, "all");
    write_row(file, &sum, "");
}

/// A state as names with their numbers.
static void write_state(FILE *file, const sphere_report *r, size_t state) {
    const cli_states *s = &r->samples->states;
    for (size_t i = 0; i < s->variable_count; i++) {
        fputs(i ? "," : "    ", file);
        cell_write_variable_name(file, r->cell, i);
        fprintf(file, "=%.17g", s->q[state * s->variable_count + i]);
    }
    fputc('\n', file);
}

static void write_states(FILE *file, const sphere_report *r, const sphere_set *set, const sphere_states *states) {
    const ovoid_robot_comparison *c = &states->found;
    char a[CELL_SIDE_ROOM], b[CELL_SIDE_ROOM];
    fprintf(file, "%-9s  %-9s  %9zu  %9zu  %9zu  %9zu  %9zu\n", set->name, states->pairs,
            c->counts[OVOID_ROBOT_COMPARED_BOTH_FREE], c->counts[OVOID_ROBOT_COMPARED_BOTH_HIT],
            c->counts[OVOID_ROBOT_COMPARED_MISSED], c->counts[OVOID_ROBOT_COMPARED_INVENTED],
            c->counts[OVOID_ROBOT_COMPARED_OPEN]);
    if (!c->counts[OVOID_ROBOT_COMPARED_MISSED]) return;
    (void)cell_format_side(a, r->cell, &c->deepest.a);
    (void)cell_format_side(b, r->cell, &c->deepest.b);
    fprintf(file, "  deepest missed: state %zu, %s and %s, %.4g deep\n", c->deepest_state, a, b, -c->deepest.upper);
    write_state(file, r, c->deepest_state);
}

static void write_comparisons(FILE *file, const sphere_report *r) {
    const sphere_samples *s = r->samples;
    fprintf(file, "\n%zu states", s->states.count);
    if (s->is_random) fprintf(file, ", random within the limits, seed %u", s->seed);
    fprintf(file, ", against the links' %s\n", r->has_parts ? "parts" : "hulls");
    fputs("spheres    pairs      both free   both hit     missed   invented       open\n", file);
    for (int k = 0; k < r->set_count; k++)
        for (int i = 0; i < r->sets[k].states_count; i++) write_states(file, r, &r->sets[k], &r->sets[k].states[i]);
}

void spheres_write_text(FILE *file, const sphere_report *r) {
    int width = find_width(r);
    for (int k = 0; k < r->set_count; k++) {
        if (k) fputc('\n', file);
        write_set(file, r, &r->sets[k], width < 5 ? 5 : width);
    }
    if (r->samples) write_comparisons(file, r);
}

// ---- JSON Lines

static void write_bracket(FILE *file, const char *key, ovoid_robot_bracket b) {
    fprintf(file, ",\"%s\":[", key);
    json_write_number(file, b.lower);
    fputc(',', file);
    json_write_number(file, b.upper);
    fputc(']', file);
}

static void write_numbers(FILE *file, const char *key, const double *items, size_t count) {
    fprintf(file, ",\"%s\":[", key);
    for (size_t i = 0; i < count; i++) {
        if (i) fputc(',', file);
        json_write_number(file, items[i]);
    }
    fputc(']', file);
}

static void write_json_row(FILE *file, const sphere_report *r, const sphere_set *set, const sphere_row *row) {
    const ovoid_robot_sphere_audit *a = &row->audit;
    fprintf(file, "{\"spheres\":\"%s\",\"link\":", set->name);
    ovoid_text_write_json(file, r->cell->description.links[row->link].name);
    fprintf(file, ",\"count\":%zu", row->count);
    if (row->count) {
        const double point[] = {a->point.x, a->point.y, a->point.z};
        write_bracket(file, "depth", a->depth);
        write_numbers(file, "point", point, 3);
        fprintf(file, ",\"nearest\":%u", (unsigned)a->sphere);
        write_bracket(file, "uncovered", a->uncovered);
        write_bracket(file, "outside", a->excess);
        write_bracket(file, "link_volume", a->link);
        write_bracket(file, "spheres_volume", a->spheres);
    }
    fputs("}\n", file);
}

static void write_json_states(FILE *file, const sphere_report *r, const sphere_set *set, const sphere_states *states) {
    const ovoid_robot_comparison *c = &states->found;
    const cli_states *s = &r->samples->states;
    fprintf(file, "{\"spheres\":\"%s\",\"pairs\":\"%s\",\"against\":\"%s\",\"states\":%zu", set->name, states->pairs,
            r->has_parts ? "parts" : "hulls", c->states);
    static const char *const keys[OVOID_ROBOT_AGREEMENTS] = {"open", "both_free", "both_hit", "missed", "invented"};
    for (int i = 0; i < OVOID_ROBOT_AGREEMENTS; i++) fprintf(file, ",\"%s\":%zu", keys[i], c->counts[i]);
    if (c->counts[OVOID_ROBOT_COMPARED_MISSED]) {
        fprintf(file, ",\"deepest\":{\"state\":%zu,\"a\":", c->deepest_state);
        cell_write_side_json(file, r->cell, &c->deepest.a);
        fputs(",\"b\":", file);
        cell_write_side_json(file, r->cell, &c->deepest.b);
        write_bracket(file, "distance", (ovoid_robot_bracket){c->deepest.lower, c->deepest.upper});
        write_numbers(file, "q", s->q + c->deepest_state * s->variable_count, s->variable_count);
        fputc('}', file);
    }
    fputs("}\n", file);
}

void spheres_write_json(FILE *file, const sphere_report *r) {
    for (int k = 0; k < r->set_count; k++) {
        const sphere_set *set = &r->sets[k];
        for (size_t i = 0; i < set->row_count; i++) write_json_row(file, r, set, &set->rows[i]);
        for (int i = 0; i < set->states_count; i++) write_json_states(file, r, set, &set->states[i]);
    }
}
