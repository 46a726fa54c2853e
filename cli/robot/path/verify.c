// Path proofs of a file, checked on the robot and the obstacles that it names, or on those that are given: these must
// be the same, and then each step is measured again by ovoid_robot_path_verify, without any search.
#include "robot/path/verify.h"

#include "base/finish.h"
#include "base/message.h"
#include "base/progress.h"
#include "robot/path/proof.h"
#include "robot/xacro.h"

#include <ovoid/robot_proof.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Most failures that are reported one by one.
#define REPORTED_MAX 10

/// The state of a run.
typedef struct verify {
    const cli_command *command;
    const path_verify_settings *settings;
    const char *path, *urdf;
    size_t source; ///< of the cell
    robot_settings robot;
    cell_settings options;
    cli_cell cell; ///< NULL: not open
    cli_states states;
    size_t next;       ///< of --states, the first that is not compared yet
    size_t held, made; ///< paths
    size_t statuses[4], steps;
} verify;

// ---- the cell

static int is_side(const cli_cell *cell, const ovoid_robot_side *side, const ovoid_robot_proof_side *named) {
    cell_side s = cell_get_side(cell, side);
    const char *texts[3][2] = {
        {s.link, named->link}, {s.link ? NULL : s.obstacle, named->obstacle}, {s.element, named->name}};
    for (int i = 0; i < 3; i++)
        if (!texts[i][0] != !texts[i][1] || (texts[i][0] && strcmp(texts[i][0], texts[i][1]) != 0)) return 0;
    return s.number == named->number;
}

static int are_sides(const cli_cell *cell, size_t pair, const ovoid_robot_proof_side *a,
                     const ovoid_robot_proof_side *b) {
    ovoid_robot_sides sides;
    return ovoid_robot_cell_get_pair(cell->cell, pair, &sides, NULL) == OVOID_OK && is_side(cell, &sides.a, a) &&
           is_side(cell, &sides.b, b);
}

static int has_variables(const cli_cell *cell, const ovoid_robot_proof_source *source) {
    size_t count = ovoid_robot_get_variable_count(cell->robot.robot);
    if (source->variable_count != count) return 0;
    for (size_t i = 0; i < count; i++) {
        char name[CELL_SIDE_ROOM];
        cell_format_variable(name, cell, i);
        if (strcmp(name, source->variables[i]) != 0) return 0;
    }
    return 1;
}

/// What is not as the file says; NULL: all is.
static const char *find_difference(const cli_cell *cell, const ovoid_robot_proof_source *source) {
    if (!has_variables(cell, source)) return "the robot has other variables";
    if (source->pair_count != ovoid_robot_cell_get_pair_count(cell->cell)) return "there are other pairs of bodies";
    for (size_t i = 0; i < source->pair_count; i++)
        if (!are_sides(cell, i, &source->pairs[2 * i], &source->pairs[2 * i + 1]))
            return "there are other pairs of bodies";
    return proof_compute_digest(cell) == source->digest ? NULL : "the digest is another";
}

static void take_list(args_list *list, const char *const *items, size_t count) {
    for (size_t i = 0; i < count && i < ARGS_LIST_MAX; i++) list->items[list->count++] = items[i];
}

/// Opens the robot and the obstacles; q: the first state of the source. 0, or an exit code after a message.
static int open_cell(verify *v, ovoid_robot_proofs_reader *proofs, const double *q) {
    const ovoid_robot_proof_source *source = ovoid_robot_proofs_reader_get_source(proofs);
    size_t attached_count;
    const char *const *attached = ovoid_robot_proofs_reader_get_attached(proofs, &attached_count);
    const path_verify_settings *s = v->settings;
    cell_close(&v->cell);
    v->robot = (robot_settings){.srdf = s->srdf ? s->srdf : source->srdf,
                                .packages = s->packages,
                                .parts = source->parts,
                                .hull = source->hull,
                                .visual = source->visual,
                                .fixed_base = source->fixed_base,
                                .tolerance = source->tolerance};
    v->options = (cell_settings){.robot = &v->robot,
                                 .scene = s->scene ? s->scene : source->scene,
                                 .margin = source->margin,
                                 .slack = source->limit_slack};
    if (!s->packages.count) take_list(&v->robot.packages, source->packages, source->package_count);
    take_list(&v->robot.scales, source->scales, source->scale_count);
    take_list(&v->options.paddings, source->paddings, source->padding_count);
    // A file of proofs is no reason to run a program.
    if ((!v->urdf && xacro_is_file(source->robot)) || (!s->srdf && xacro_is_file(source->srdf)))
        return message_error("%s: the robot is in xacro: expand it, \"xacro FILE > robot.urdf\", and give that: ovoid "
                             "verify PROOFS.jsonl robot.urdf --srdf robot.srdf",
                             v->path),
               EXIT_INPUT;
    v->options.attached_in = v->path;
    take_list(&v->options.attached, attached, attached_count);
    int code = cell_open(v->command, v->urdf ? v->urdf : source->robot, &v->options, &v->cell);
    // A state of another robot is not looked at: the difference is reported below.
    if (!code && has_variables(&v->cell, source)) code = cell_attach(v->command, &v->options, q, &v->cell);
    // A package that is not one is a fault of the file, not of the command line.
    if (code) return EXIT_INPUT;
    const char *difference = find_difference(&v->cell, source);
    if (!difference) return 0;
    message_error(
        "%s: the robot or its obstacles are not those of the proofs: %s; give the files by ROBOT.urdf, --srdf, "
        "--scene and --package",
        v->path, difference);
    return EXIT_INPUT;
}

// ---- one path

/// Compares the states with those of --states. 1: they are the same.
static int are_states(verify *v, const ovoid_robot_proof *p) {
    size_t n = v->states.variable_count, from = v->next;
    if (!v->settings->states) return 1;
    v->next += p->count;
    if (v->next > v->states.count) return 0;
    for (size_t i = 0; i < p->count * n; i++)
        if (v->states.q[from * n + i] != p->states[i]) return 0;
    return !p->times || (v->states.times && memcmp(v->states.times + from, p->times, p->count * sizeof *p->times) == 0);
}

static int are_same(double a, double b) { return a == b || (isnan(a) && isnan(b)); }

/// 1 where the times are those of the states at these s.
static int are_times(const ovoid_robot_proof *p) {
    const cli_states states = {.count = p->count, .times = (double *)p->times};
    const ovoid_robot_path_answer *a = &p->answer;
    double from = a->status == OVOID_ROBOT_REFUSED ? NAN : path_compute_time(&states, a->free_until);
    double until = a->status == OVOID_ROBOT_HIT ? path_compute_time(&states, a->hit_at) : NAN;
    return are_same(from, p->free_until_time) && are_same(until, p->hit_at_time);
}

/// What does not hold; NULL: all does. *line: where. *error has the sentence.
static const char *find_fault(verify *v, const ovoid_robot_proof *p, int64_t *line, ovoid_error *error) {
    ovoid_robot_path_answer answer = p->answer;
    const ovoid_robot_path path = {p->states, p->count};
    const ovoid_robot_path_options o = {.query = cell_make_options(&v->options)};
    *line = p->line;
    if (!are_states(v, p)) return "the states are not those given";
    if (p->margin != v->options.margin) return "the margin is not that of the first line";
    if (!are_times(p)) return "the times are not those of the states at these s";
    if (answer.status == OVOID_ROBOT_REFUSED) return NULL;
    if (p->has_pair) {
        if (!are_sides(&v->cell, p->pair, &p->a, &p->b)) return "a and b are not the sides of the pair";
        if (p->segment != path_get_segment(&answer, p->count)) return "the segment is not that of free_until";
        ovoid_robot_sides sides = {answer.hit.a, answer.hit.b};
        (void)ovoid_robot_cell_get_pair(v->cell.cell, p->pair, &sides, NULL);
        answer.hit.a = sides.a;
        answer.hit.b = sides.b;
    }
    if (ovoid_robot_path_verify(v->cell.cell, &answer, &(ovoid_robot_path_basis){{&path, &o}, p->steps}, error) ==
        OVOID_OK)
        return NULL;
    if (error->code == OVOID_ERROR_PROOF && error->place >= 0) *line += 1 + error->place;
    return error->message;
}

static int take_path(verify *v, const ovoid_robot_proof *p) {
    ovoid_error error = {.message = ""};
    int64_t line;
    size_t failures = v->made++ - v->held;
    const char *fault = find_fault(v, p, &line, &error);
    if (fault && failures < REPORTED_MAX) message_error("%s:%lld: %s", v->path, (long long)line, fault);
    v->held += !fault;
    v->statuses[p->answer.status]++;
    v->steps += p->answer.step_count;
    progress_set(v->made);
    return 0;
}

// ---- all of them

/// The states of --states, once the first robot is known. 0, or an exit code after a message.
static int open_states(verify *v) {
    const states_settings s = {.path = v->settings->states};
    return v->settings->states && !v->states.q ? states_open(v->command, &s, &v->cell, &v->states) : 0;
}

/// Reads and checks all paths. 0, or an exit code after a message.
static int run_proofs(verify *v, ovoid_robot_proofs_reader *proofs) {
    ovoid_robot_proof p;
    ovoid_error error;
    int got, code = 0;
    while (!code && (got = ovoid_robot_proofs_reader_read(proofs, &p, &error)) > 0) {
        if (!v->cell.cell || p.source != v->source) {
            code = open_cell(v, proofs, p.count ? p.states : NULL);
            v->source = p.source;
        }
        if (!code) code = open_states(v);
        if (!code) code = take_path(v, &p);
    }
    if (code) return code;
    if (got < 0) {
        if (!ovoid_robot_proofs_reader_get_source(proofs) && error.code == OVOID_ERROR_FORMAT)
            return args_complain(v->command,
                                 "verify: on which bodies? Give SCENE.json, or A and B, or --shapes and --pairs (only "
                                 "path proofs of ovoid robot path need none)");
        return message_error("%s", error.message), EXIT_INPUT;
    }
    if (!v->made && !v->settings->partial)
        return message_error("%s: there is no path; where none is wanted, --partial says so", v->path), EXIT_INPUT;
    if (v->settings->states && v->next < v->states.count)
        return message_error("%s: %zu states of %s are on no path", v->path, v->states.count - v->next,
                             v->settings->states),
               EXIT_INPUT;
    return 0;
}

static void print_counts(const verify *v) {
    const size_t *n = v->statuses;
    if (v->settings->json) {
        printf("{\"paths\":%zu,\"hold\":%zu,\"fail\":%zu,\"free\":%zu,\"hit\":%zu,\"undecided\":%zu,\"refused\":%zu,"
               "\"steps\":%zu}\n",
               v->made, v->held, v->made - v->held, n[OVOID_ROBOT_FREE], n[OVOID_ROBOT_HIT], n[OVOID_ROBOT_UNDECIDED],
               n[OVOID_ROBOT_REFUSED], v->steps);
        return;
    }
    printf(
        "paths: %zu, hold: %zu, do not: %zu; free: %zu, hit: %zu, undecided: %zu, refused: %zu; steps: %zu, checked in "
        "floating point with rigorous error bounds\n",
        v->made, v->held, v->made - v->held, n[OVOID_ROBOT_FREE], n[OVOID_ROBOT_HIT], n[OVOID_ROBOT_UNDECIDED],
        n[OVOID_ROBOT_REFUSED], v->steps);
}

int path_verify(const cli_command *command, const path_verify_settings *settings, const char *path, const char *urdf) {
    verify v = {.command = command, .settings = settings, .path = path, .urdf = urdf};
    ovoid_error error;
    ovoid_robot_proofs_reader *proofs = ovoid_robot_proofs_reader_open(path, &error);
    if (!proofs) return message_error("%s", error.message), EXIT_INPUT;
    progress_start("paths", 0);
    int code = run_proofs(&v, proofs);
    progress_end();
    ovoid_robot_proofs_reader_close(proofs);
    states_close(&v.states);
    cell_close(&v.cell);
    if (code) return code;
    print_counts(&v);
    code = finish_file(stdout);
    if (code) return code;
    return v.held == v.made ? EXIT_APART : EXIT_NOT_PROVEN;
}
