// ovoid robot path: is a path through states proven free at all times in between, and if not, what is hit first, and
// when? With --proofs its steps are written, after ovoid_robot_path_verify has measured each of them again.
#include "robot/path/path.h"

#include "base/message.h"
#include "base/outputs.h"
#include "base/progress.h"
#include "robot/commands.h"
#include "robot/page.h"
#include "robot/path/answer.h"
#include "robot/path/proof.h"
#include "robot/path/speed.h"
#include "robot/report.h"

#include <stdlib.h>
#include <string.h>

typedef struct settings {
    cell_settings cell;
    robot_settings robot;
    states_settings states;
    output_settings out;
    const char *plot, *html, *trajectory;
    double tolerance, clearance_tolerance;
    int proofs, edges, clearance, speed, any_hit;
    unsigned most;
} settings;

static const cli_option options[] = {
    STATES_OPTIONS(settings),
    CELL_OPTIONS(settings),
    ATTACH_OPTION(settings),
    {"proofs", 0, OPTION_FLAG, offsetof(settings, proofs), NULL, NULL,
     "write JSON Lines, the robot, the answer and then each step of its proof, for ovoid verify, and check all of "
     "them"},
    {"edges", 0, OPTION_FLAG, offsetof(settings, edges), NULL, NULL,
     "each two states are a path by itself: the first and the second, the third and the fourth, ..."},
    {"clearance", 0, OPTION_FLAG, offsetof(settings, clearance), NULL, NULL,
     "the smallest distance of any pair at any time, as a proven bracket"},
    {"clearance-tol", 0, OPTION_POSITIVE, offsetof(settings, clearance_tolerance), "T", NULL,
     "narrow that bracket to T (default: 1/1000 of the radius of the robot's largest part)"},
    {"check-speed", 0, OPTION_FLAG, offsetof(settings, speed), NULL, NULL,
     "with a column \"time\": report joints that are faster than the URDF's limit"},
    {"plot", 0, OPTION_OUTPUT, offsetof(settings, plot), "FILE", "svg",
     "draw the distance of the nearest pair over the path, sampled"},
    {"trajectory", 0, OPTION_OUTPUT, offsetof(settings, trajectory), "FILE", "json",
     "write a path that is free as a robot trajectory of MoveIt, with the times of the states where they have some"},
    PAGE_OPTION(settings),
    {"tol", 0, OPTION_SHARE, offsetof(settings, tolerance), "T", NULL,
     "end when the first hit is known to within T of a segment (default: 1e-6)"},
    {"any-hit", 0, OPTION_FLAG, offsetof(settings, any_hit), NULL, NULL,
     "end at any hit that is found, sooner than at the first one of the path"},
    {"max-states", 0, OPTION_COUNT, offsetof(settings, most), "N", NULL,
     "give up after looking at N states (default: 100000)"},
    ROBOT_OPTIONS(settings),
    REPORT_OPTIONS(settings),
    {.name = NULL},
};

/// The smallest clearance. 0, or EXIT_INPUT after a message.
static int find_clearance(const settings *s, path_report *r, ovoid_robot_checker *checker, const ovoid_robot_path *path,
                          ovoid_robot_clearance *clearance) {
    ovoid_error error;
    const ovoid_robot_path_options o = {
        .query = cell_make_options(&s->cell), .tolerance = s->clearance_tolerance, .states = s->most};
    ovoid_robot_checker_reset(checker);
    if (ovoid_robot_path_compute_clearance(checker, &(ovoid_robot_path_query){path, &o}, clearance, &error) != OVOID_OK)
        return message_error("%s", error.message), EXIT_INPUT;
    r->clearance = clearance;
    return 0;
}

static void write_answer(const path_report *r, const cli_results *results) {
    const output_settings *out = results->settings;
    (out->json ? path_write_json : out->csv ? path_write_csv : path_write_text)(results->file, r);
}

/// A run: the path that is asked about, and what lasts from one to the next.
typedef struct path_run {
    path_report report;
    ovoid_robot_checker *checker;
    robot_page page;
    const char *urdf;
} path_run;

/// What was found of all paths.
typedef struct path_counts {
    size_t statuses[4], steps, looked_at;
    size_t outside; ///< of the refused, those with a state outside its limits
    int proven;     ///< EXIT_NOT_PROVEN: a proof does not hold
} path_counts;

static void add_counts(path_counts *c, const path_report *r) {
    c->statuses[r->answer.status]++;
    c->outside += r->answer.status == OVOID_ROBOT_REFUSED && r->answer.hit.code == OVOID_ERROR_RANGE;
    c->steps += r->answer.step_count;
    c->looked_at += r->answer.states;
}

/// One path: its answer, checked and written. 0, or an exit code after a message.
static int run_one(const settings *s, path_run *run, const cli_results *results, path_counts *counts) {
    path_report *r = &run->report;
    ovoid_robot_checker *checker = run->checker;
    const ovoid_robot_path path = {r->states->q, r->states->count};
    ovoid_robot_path_options o = {
        .query = cell_make_options(&s->cell), .tolerance = s->tolerance, .states = s->most, .any_hit = s->any_hit};
    ovoid_robot_clearance clearance;
    int code = path_find_answer(r, checker, &path, &o);
    if (!code && s->clearance) code = find_clearance(s, r, checker, &path, &clearance);
    if (code) return code;
    if (s->proofs && path_check_proofs(r, &path, &o)) counts->proven = EXIT_NOT_PROVEN;
    write_answer(r, results);
    robot_page_add_path(&run->page, r);
    r->clearance = NULL;
    add_counts(counts, r);
    return 0;
}

/// Path i of many: the states are two of all.
static cli_states get_edge(const cli_states *all, size_t i) {
    cli_states edge = *all;
    edge.q += 2 * i * all->variable_count;
    if (edge.times) edge.times += 2 * i;
    edge.count = 2;
    return edge;
}

static int get_exit(const path_counts *c) {
    if (c->proven) return c->proven;
    if (c->statuses[OVOID_ROBOT_UNDECIDED] || c->statuses[OVOID_ROBOT_REFUSED]) return EXIT_NOT_PROVEN;
    return c->statuses[OVOID_ROBOT_HIT] ? EXIT_TOUCH : EXIT_APART;
}

static void report_counts(const settings *s, const path_counts *c, const cli_states *states, double seconds) {
    const size_t *n = c->statuses;
    if (s->edges)
        message_note("%zu edges in %.3f s; free: %zu, hit: %zu, undecided: %zu, refused: %zu; looked at: %zu, steps: "
                     "%zu",
                     states->count / 2, seconds, n[OVOID_ROBOT_FREE], n[OVOID_ROBOT_HIT], n[OVOID_ROBOT_UNDECIDED],
                     n[OVOID_ROBOT_REFUSED], c->looked_at, c->steps);
    else
        message_note("%zu state%s in %.3f s; looked at: %zu, steps: %zu", states->count, states->count == 1 ? "" : "s",
                     seconds, c->looked_at, c->steps);
    if (c->outside) cell_tell_outside();
}

/// Writes the path for MoveIt, if it is free. 0, or an exit code after a message.
static int write_trajectory(const settings *s, const path_report *r) {
    const output_settings out = {.path = s->trajectory};
    cli_results results;
    if (!s->trajectory) return 0;
    if (r->answer.status != OVOID_ROBOT_FREE)
        return message_warning("%s is not written: the path is not proven free", s->trajectory), 0;
    if (states_check_trajectory(r->cell, r->states) || results_open(&results, &out, 0, "")) return EXIT_INPUT;
    states_write_trajectory(results.file, r->cell, r->states);
    return results_close(&results, 0);
}

/// Draws the plot and writes the page, those that are wanted. 0, or an exit code after a message.
static int draw(const settings *s, path_run *run) {
    const path_report *r = &run->report;
    const ovoid_robot_query_options o = cell_make_options(&s->cell);
    int code = s->plot ? path_plot(s->plot, r, run->checker, &o) : 0;
    if (!code) code = write_trajectory(s, r);
    const path_report *alone = s->edges ? NULL : r;
    const robot_page_source source = {run->urdf, &s->cell, r->cell, r->states, run->checker, alone};
    return code ? code : robot_page_write(&run->page, &source);
}

/// All paths: one through all states, or one for each two of them.
static int run_paths(const settings *s, path_run *run) {
    path_report *r = &run->report;
    const cli_states *states = r->states;
    size_t count = s->edges ? states->count / 2 : 1;
    cli_results results;
    path_counts counts = {.steps = 0};
    if (results_open(&results, &s->out, 0, "")) return EXIT_INPUT;
    results.header_due = 0;
    if (s->proofs) proof_write_source(results.file, &(const proof_source){run->urdf, &s->cell, r->cell, count});
    if (s->out.csv) path_write_csv_header(results.file);
    double start = progress_get_seconds();
    int code = 0;
    if (s->edges) progress_start("edges", count);
    for (r->number = 0; r->number < count && !code; r->number++) {
        cli_states edge = s->edges ? get_edge(states, r->number) : *states;
        r->states = &edge;
        code = run_one(s, run, &results, &counts);
        if (s->edges) progress_set(r->number + 1);
    }
    if (s->edges) progress_end();
    r->states = states;
    double seconds = progress_get_seconds() - start;
    code = results_close(&results, code ? code : get_exit(&counts));
    if (code == EXIT_INPUT || code == EXIT_PIPE) return code;
    int drawn = draw(s, run);
    report_counts(s, &counts, states, seconds);
    if (!s->edges && r->answer.status != OVOID_ROBOT_FREE && cell_has_pair(&r->answer.hit))
        cell_tell_links(r->cell, &r->answer.hit.a, &r->answer.hit.b);
    return drawn ? drawn : code;
}

/// Times must rise, and joints may be told to keep to their speeds. 0, or an exit code after a message.
static int check_times(const settings *s, const cli_cell *cell, const cli_states *states, int *is_too_fast) {
    size_t step = s->edges ? 2 : 1;
    *is_too_fast = 0;
    if (s->speed && !states->times)
        return message_error("--check-speed: the states have no times: a column \"time\", in seconds"), EXIT_INPUT;
    for (size_t i = 0; i + 1 < states->count && states->times; i += step) {
        if (states->times[i + 1] > states->times[i]) continue;
        message_error("%s: state %zu: its time, %.9g s, is not after that of the state before, %.9g s",
                      strcmp(s->states.path, "-") == 0 ? "standard input" : s->states.path, i + 1, states->times[i + 1],
                      states->times[i]);
        return EXIT_INPUT;
    }
    for (size_t i = 0; i + 1 < states->count && s->speed; i += step) *is_too_fast |= speed_report(cell, states, i);
    return 0;
}

/// Settles the command line. -1 to go on, or an exit code.
static int settle(const cli_command *command, settings *s) {
    int code = results_settle(command, &s->out);
    if (code < 0) code = states_settle(command, &s->states, &s->cell);
    if (code < 0 && s->proofs && s->out.csv)
        code = args_complain(command, "%s: --proofs goes with JSON Lines, not with CSV", command->name);
    if (code < 0 && s->edges && (s->plot || s->trajectory))
        code = args_complain(command, "%s: --%s is of one path, not of --edges", command->name,
                             s->plot ? "plot" : "trajectory");
    if (code < 0 && s->clearance_tolerance > 0 && !s->clearance)
        code = args_complain(command, "%s: --clearance-tol goes with --clearance", command->name);
    if (code < 0 && s->proofs && s->clearance)
        code = args_complain(command, "%s: --clearance is not part of --proofs: ask for one of them", command->name);
    if (s->proofs) s->out.json = 1;
    return code;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.cell.slack = CELL_SLACK};
    cli_operands operands;
    cli_cell cell;
    cli_states states = {.part = {0, 0}};
    ovoid_error error;
    int code = command_parse(command, argc, argv, &s, &operands);
    if (code < 0) code = settle(command, &s);
    if (code < 0) code = page_settle(command, s.html, (shard_part){0, 0});
    if (code < 0) code = robot_settle(command, &s.robot);
    if (code >= 0) return code;
    s.cell.robot = &s.robot;
    path_run run = {.urdf = operands.items[0]};
    if (robot_page_open(&run.page, s.html)) return EXIT_INPUT;
    code = cell_open(command, operands.items[0], &s.cell, &cell);
    if (code) return robot_page_close(&run.page), code;
    code = states_open(command, &s.states, &cell, &states);
    int is_too_fast = 0;
    if (!code) code = states_check_goal(&s.states, &states);
    if (!code && s.edges && states.count % 2)
        message_error("--edges: an even number of states is wanted, not %zu", states.count), code = EXIT_INPUT;
    if (!code) code = check_times(&s, &cell, &states, &is_too_fast);
    if (!code) code = cell_attach(command, &s.cell, states.q, &cell);
    if (!code) cell_tell_held(&cell, &s.cell);
    if (!code) {
        path_report *r = &run.report;
        *r = (path_report){
            .cell = &cell, .states = &states, .margin = s.cell.margin, .has_proofs = s.proofs, .is_edge = s.edges};
        run.checker = ovoid_robot_checker_create(cell.cell, NULL, &error);
        int has_steps = s.proofs || (s.html && !s.edges);
        if (run.checker && has_steps) r->steps = path_create_steps();
        if (!run.checker || (has_steps && !r->steps))
            message_error("out of memory"), code = EXIT_INPUT;
        else
            code = run_paths(&s, &run);
        if (is_too_fast && (code == EXIT_APART || code == EXIT_TOUCH)) code = EXIT_NOT_PROVEN;
        ovoid_robot_checker_destroy(run.checker);
        free(r->steps);
    }
    robot_page_close(&run.page);
    states_close(&states);
    cell_close(&cell);
    return code;
}

const cli_command command_robot_path = {
    .name = "robot path",
    .summary = "a path through states: free at all times, or the first hit",
    .usage = "[OPTION...] ROBOT.urdf --states Q.csv\n[OPTION...] ROBOT.urdf --state STATE --state STATE...",
    .description =
        "Is the path through the states free at all times in between? Between two states every variable is linear in "
        "s, which is 0 at the first state, 1 at the second and so on. Free means: every pair is farther apart than the "
        "margin at every real s, proven. A hit is proven too: the path is free before one s and within the margin at "
        "another, a narrow bracket, and the pair is named. Undecided: a pair stays within rounding of the margin, or "
        "--max-states were looked at. A continuous joint is not turned the shorter way round, and a floating joint "
        "must not turn within a segment.\n\n"
        "States are given as to \"ovoid robot check\". A column \"time\" has the seconds of each state: answers then "
        "say when, too. \"ovoid verify\" checks a file of proofs again.",
    .exits = "0 free at all times\n"
             "1 hit\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written\n"
             "4 undecided, refused, a proof that does not hold, or too fast (--check-speed)",
    .examples = "ovoid robot path panda.urdf --scene cell.yaml --states q.csv\n"
                "ovoid robot path arm.urdf --srdf arm.srdf --state home --state up\n"
                "ovoid robot path arm.urdf --states q.csv --proofs -o proof.jsonl\n"
                "ovoid robot path arm.urdf --states edges.csv --edges --csv\n"
                "ovoid robot path arm.urdf --states q.csv --clearance\n"
                "ovoid robot path arm.urdf --states q.csv --plot clearance.svg",
    .options = options,
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
