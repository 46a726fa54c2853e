// The answer to a path, for people and as lines; with the steps of its proof.
#include "base/members.h"
#include "base/message.h"
#include "io/fields.h"
#include "robot/path/path.h"
#include "robot/path/proof.h"

#include <math.h>
#include <stdlib.h>

void path_compute_state(const cli_states *states, double s, double *q) {
    double whole = floor(s);
    size_t i = whole > 0 ? (size_t)whole : 0, n = states->variable_count;
    if (i >= states->count) i = states->count - 1;
    const double *q0 = states->q + i * n, *q1 = i + 1 < states->count ? q0 + n : q0;
    for (size_t k = 0; k < n; k++) q[k] = q0[k] + (s - (double)i) * (q1[k] - q0[k]);
}

double path_compute_time(const cli_states *states, double s) {
    if (!states->times) return NAN;
    size_t last = states->count - 1;
    if (!(s < (double)last)) return states->times[last];
    size_t i = s > 0 ? (size_t)s : 0;
    return states->times[i] + (s - (double)i) * (states->times[i + 1] - states->times[i]);
}

/// 1 if a pair is named: that of a hit, or one that was measured.
static int has_pair(const ovoid_robot_path_answer *a) {
    return a->status == OVOID_ROBOT_HIT || (a->status == OVOID_ROBOT_UNDECIDED && a->hit.upper < INFINITY);
}

size_t path_get_segment(const ovoid_robot_path_answer *answer, size_t count) {
    size_t i = answer->free_until > 0 ? (size_t)answer->free_until : 0;
    return count > 1 && i > count - 2 ? count - 2 : i;
}

static size_t get_segment(const path_report *r) { return path_get_segment(&r->answer, r->states->count); }

/// 1 if the state's number of the refused variable is out of its range by itself.
static int is_out_of_range(const path_report *r, size_t state) {
    uint32_t i = r->answer.hit.variable;
    ovoid_robot_variable v = ovoid_robot_get_variable(r->cell->robot.robot, i);
    double value = r->states->q[state * r->states->variable_count + i];
    return value < v.lower || value > v.upper || fabs(value) > OVOID_ROBOT_ANGLE_MAX;
}

/// The state that is refused: of a refused segment the end that is the reason.
static size_t get_refused(const path_report *r) {
    size_t i = r->answer.refused;
    return !is_out_of_range(r, i) && i + 1 < r->states->count && is_out_of_range(r, i + 1) ? i + 1 : i;
}

// ---- for people

/// Two numbers with as many digits as tell them apart.
static void write_times(FILE *file, double from, double until) {
    char ends[2][40];
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(ends[0], sizeof ends[0], "%.*g", digits, from);
        snprintf(ends[1], sizeof ends[1], "%.*g", digits, until);
        if (ends[0][0] && strtod(ends[0], NULL) < strtod(ends[1], NULL)) break;
    }
    fprintf(file, "%s and %s", ends[0], ends[1]);
}

/// The same of the times there, where the states have some.
static void write_seconds(FILE *file, const path_report *r) {
    const ovoid_robot_path_answer *a = &r->answer;
    if (!r->states->times) return;
    double from = path_compute_time(r->states, a->free_until), until = path_compute_time(r->states, a->hit_at);
    if (a->status == OVOID_ROBOT_HIT && until > from) {
        fputs("time        between ", file);
        write_times(file, from, until);
        fputs(" s\n", file);
    } else if (a->status == OVOID_ROBOT_HIT || a->status == OVOID_ROBOT_UNDECIDED) {
        fprintf(file, "time        %.9g s\n", from);
    }
}

static void write_state(FILE *file, const path_report *r, double s) {
    double *q = malloc((r->states->variable_count + 1) * sizeof *q);
    if (!q) return;
    path_compute_state(r->states, s, q);
    fputs("there       ", file);
    for (size_t i = 0; i < r->states->variable_count; i++) {
        fputs(i ? ", " : "", file);
        cell_write_variable_name(file, r->cell, i);
        fprintf(file, " %.6g", q[i]);
    }
    fputc('\n', file);
    free(q);
}

static void write_pair(FILE *file, const path_report *r) {
    char a[CELL_SIDE_ROOM], b[CELL_SIDE_ROOM], bracket[64];
    const ovoid_robot_answer *hit = &r->answer.hit;
    (void)cell_format_side(a, r->cell, &hit->a);
    (void)cell_format_side(b, r->cell, &hit->b);
    cell_format_bracket(bracket, hit->lower, hit->upper);
    fputs("pair        ", file);
    message_write_text(file, a);
    fputs(", ", file);
    message_write_text(file, b);
    fprintf(file, "\ndistance    %s\n", bracket);
}

static void write_refused(FILE *file, const path_report *r) {
    const ovoid_robot_path_answer *a = &r->answer;
    size_t state = get_refused(r);
    if (a->hit.code == OVOID_ERROR_ARGUMENT) {
        ovoid_robot_variable v = ovoid_robot_get_variable(r->cell->robot.robot, a->hit.variable);
        fprintf(file, "refused     from state %zu to state %zu: joint ", state, state + 1);
        message_write_text(file, r->cell->description.joints[v.joint].name);
        fputs(" is floating and turns; let its quaternion stay within a segment\n", file);
        return;
    }
    fprintf(file, "refused     state %zu: ", state);
    cell_write_refusal(file, r->cell, &a->hit, r->states->q + state * r->states->variable_count);
    fputc('\n', file);
}

static void write_hit(FILE *file, const path_report *r) {
    const ovoid_robot_path_answer *a = &r->answer;
    size_t segment = get_segment(r);
    if (a->hit_at > a->free_until) {
        fputs("hit         between s ", file);
        write_times(file, a->free_until, a->hit_at);
        fprintf(file, ", from state %zu to state %zu\n", segment, segment + 1);
    } else {
        fprintf(file, "hit         at s %.9g\n", a->hit_at);
    }
}

/// The smallest clearance, and where.
static void write_clearance(FILE *file, const path_report *r) {
    const ovoid_robot_clearance *c = r->clearance;
    char a[CELL_SIDE_ROOM], b[CELL_SIDE_ROOM];
    if (!c || c->status == OVOID_ROBOT_REFUSED) return;
    if (!(c->upper < INFINITY)) {
        fputs("clearance   there is no pair\n", file);
        return;
    }
    (void)cell_format_side(a, r->cell, &c->a);
    (void)cell_format_side(b, r->cell, &c->b);
    fprintf(file, "clearance   %.9g .. %.9g, at s %.9g", c->lower, c->upper, c->at);
    if (r->states->times) fprintf(file, ", %.9g s", path_compute_time(r->states, c->at));
    fputs(": ", file);
    message_write_text(file, a);
    fputs(", ", file);
    message_write_text(file, b);
    fputc('\n', file);
}

void path_write_text(FILE *file, const path_report *r) {
    const ovoid_robot_path_answer *a = &r->answer;
    size_t last = r->states->count - 1;
    fprintf(file, "path        %s\n", cell_get_status_name(a->status));
    if (a->status == OVOID_ROBOT_FREE)
        fprintf(file, "free        at all s from 0 to %zu\n", last);
    else if (a->status == OVOID_ROBOT_REFUSED)
        write_refused(file, r);
    else if (a->hit.code == OVOID_ERROR_EMPTY)
        fprintf(file, "because     %s\n", cell_get_empty());
    else if (a->free_until > 0)
        fprintf(file, "free        before s %.9g\n", a->free_until);
    if (a->status == OVOID_ROBOT_HIT) write_hit(file, r);
    write_seconds(file, r);
    if (has_pair(a)) write_pair(file, r);
    if (a->status == OVOID_ROBOT_HIT) write_state(file, r, a->hit_at);
    write_clearance(file, r);
}

// ---- CSV

static void write_number(FILE *file, double number, int is_there) {
    fputc(',', file);
    if (is_there && isfinite(number)) fprintf(file, "%.17g", number);
}

void path_write_csv_header(FILE *file) {
    fputs("path,status,free_until,hit_at,free_until_time,hit_at_time,segment," CELL_PAIR_COLUMNS ",lower,upper"
          ",clearance_lower,clearance_upper,clearance_at\n",
          file);
}

void path_write_csv(FILE *file, const path_report *r) {
    const ovoid_robot_path_answer *a = &r->answer;
    int named = has_pair(a), has_times = r->states->times != NULL;
    fprintf(file, "%zu,", r->number);
    fputs(cell_get_status_name(a->status), file);
    write_number(file, a->free_until, a->status != OVOID_ROBOT_REFUSED);
    write_number(file, a->hit_at, a->status == OVOID_ROBOT_HIT);
    write_number(file, path_compute_time(r->states, a->free_until), has_times && a->status != OVOID_ROBOT_REFUSED);
    write_number(file, path_compute_time(r->states, a->hit_at), has_times && a->status == OVOID_ROBOT_HIT);
    fputc(',', file);
    if (named) fprintf(file, "%zu", get_segment(r));
    fputc(',', file);
    cell_write_pair_csv(file, r->cell, named ? &a->hit.a : NULL, &a->hit.b);
    write_number(file, a->hit.lower, named);
    write_number(file, a->hit.upper, named);
    const ovoid_robot_clearance *c = r->clearance;
    int has_clearance = c && c->status != OVOID_ROBOT_REFUSED && c->upper < INFINITY;
    write_number(file, has_clearance ? c->lower : NAN, has_clearance);
    write_number(file, has_clearance ? c->upper : NAN, has_clearance);
    write_number(file, has_clearance ? c->at : NAN, has_clearance);
    fputc('\n', file);
}

// ---- JSON Lines

static void write_sides(FILE *file, const path_report *r, const ovoid_robot_side *a, const ovoid_robot_side *b) {
    fputs("\"a\":", file);
    cell_write_side_json(file, r->cell, a);
    fputs(",\"b\":", file);
    cell_write_side_json(file, r->cell, b);
}

const char *path_get_step_kind(uint16_t kind) {
    static const char *const kinds[] = {"", "outer", "middle", "ends", "solid"};
    return kinds[kind];
}

void path_write_step_pairs(FILE *file, const ovoid_robot_step *step) {
    const char *before = "";
    for (uint32_t i = 0; i < 8; i++) {
        if (!(step->mask >> i & 1)) continue;
        fprintf(file, "%s%lu", before, (unsigned long)step->pair + i);
        before = ",";
    }
}

static void write_step(FILE *file, const ovoid_robot_step *step) {
    fprintf(file, "{\"step\":\"%s\"", path_get_step_kind(step->kind));
    member_write_number(file, ",", "begin", step->begin);
    member_write_number(file, ",", "end", step->end);
    if (step->kind == OVOID_ROBOT_STEP_MIDDLE || step->kind == OVOID_ROBOT_STEP_ENDS) {
        const double normal[] = {step->normal.x, step->normal.y, step->normal.z};
        fputs(",\"normal\":", file);
        json_write_numbers(file, normal, 3);
    }
    fputs(",\"pairs\":[", file);
    path_write_step_pairs(file, step);
    fputs("]}\n", file);
}

static void write_clearance_json(FILE *file, const path_report *r) {
    const ovoid_robot_clearance *c = r->clearance;
    member_write_number(file, ",\"clearance\":{", "lower", c->lower);
    member_write_number(file, ",", "upper", c->upper);
    if (c->upper < INFINITY) {
        member_write_number(file, ",", "at", c->at);
        if (r->states->times) member_write_number(file, ",", "time", path_compute_time(r->states, c->at));
        fputc(',', file);
        write_sides(file, r, &c->a, &c->b);
    }
    fprintf(file, ",\"looked_at\":%lu}", (unsigned long)c->states);
}

void path_write_json(FILE *file, const path_report *r) {
    const ovoid_robot_path_answer *a = &r->answer;
    fputc('{', file);
    if (r->is_edge || r->has_proofs) fprintf(file, "\"path\":%zu,", r->number);
    fprintf(file, "\"status\":\"%s\",\"states\":%zu", cell_get_status_name(a->status), r->states->count);
    member_write_number(file, ",", "margin", r->margin);
    if (a->status == OVOID_ROBOT_REFUSED) {
        fprintf(file, ",\"refused\":%zu,\"code\":\"%s\",\"variable\":", get_refused(r),
                ovoid_code_get_name(a->hit.code));
        cell_write_variable_json(file, r->cell, a->hit.variable);
    } else {
        member_write_number(file, ",", "free_until", a->free_until);
        if (r->states->times)
            member_write_number(file, ",", "free_until_time", path_compute_time(r->states, a->free_until));
    }
    if (a->status == OVOID_ROBOT_HIT) {
        member_write_number(file, ",", "hit_at", a->hit_at);
        if (r->states->times) member_write_number(file, ",", "hit_at_time", path_compute_time(r->states, a->hit_at));
    }
    if (has_pair(a)) {
        fprintf(file, ",\"segment\":%zu,", get_segment(r));
        if (r->has_proofs)
            fprintf(file, "\"pair\":%lu,", (unsigned long)proof_find_pair(r->cell, &a->hit.a, &a->hit.b));
        write_sides(file, r, &a->hit.a, &a->hit.b);
        member_write_number(file, ",", "lower", a->hit.lower);
        member_write_number(file, ",", "upper", a->hit.upper);
    }
    fprintf(file, ",\"looked_at\":%lu,\"steps\":%zu", (unsigned long)a->states, a->step_count);
    if (r->has_proofs) states_write_json(file, r->states, "q", r->states->count);
    if (r->clearance && r->clearance->status != OVOID_ROBOT_REFUSED) write_clearance_json(file, r);
    fputs("}\n", file);
    for (size_t i = 0; i < a->step_count && r->has_proofs; i++) write_step(file, &r->steps[i]);
}
