// ovoid robot path: is a path through states proven free at all times in between, and if not, what is hit first, and
// when? With --proofs its steps are written, after ovoid_robot_path_check has measured each of them again.
#include "robot/path.h"

#include "message.h"
#include "outputs.h"
#include "progress.h"
#include "robot/commands.h"
#include "robot/report.h"

#include <stdlib.h>

typedef struct settings {
    cell_settings cell;
    robot_settings robot;
    states_settings states;
    output_settings out;
    const char *plot;
    double tolerance;
    int proofs;
    unsigned most;
} settings;

static const cli_option options[] = {
    STATES_OPTIONS(settings),
    CELL_OPTIONS(settings),
    {"proofs", 0, OPTION_FLAG, offsetof(settings, proofs), NULL, NULL,
     "write JSON Lines, the answer and then each step of its proof, and check all of them"},
    {"plot", 0, OPTION_OUTPUT, offsetof(settings, plot), "FILE", "svg",
     "draw the distance of the nearest pair over the path, sampled"},
    {"tol", 0, OPTION_SHARE, offsetof(settings, tolerance), "T", NULL,
     "end when the first hit is known to within T of a segment (default: 1e-6)"},
    {"max-states", 0, OPTION_COUNT, offsetof(settings, most), "N", NULL,
     "give up after looking at N states (default: 100000)"},
    ROBOT_OPTIONS(settings),
    REPORT_OPTIONS(settings),
    {.name = NULL},
};

/// Steps for which there is room at first.
#define STEPS_ROOM 4096

/// Checks the path, with room for its steps where they are wanted. 0, or EXIT_INPUT after a message.
static int find_answer(path_report *r, ovoid_robot_checker *checker, const ovoid_robot_path *path,
                       ovoid_robot_path_options *o) {
    ovoid_error error;
    size_t room = r->steps ? STEPS_ROOM : 0;
    for (;;) {
        o->steps = r->steps;
        o->capacity = room;
        ovoid_robot_checker_reset(checker);
        if (ovoid_robot_check_path(checker, path, o, &r->answer, &error) != OVOID_OK)
            return message_error("%s", error.message), EXIT_INPUT;
        if (!r->steps || r->answer.step_count <= room) return 0;
        room = r->answer.step_count;
        free(r->steps);
        r->steps = malloc(room * sizeof *r->steps);
        if (!r->steps) return message_error("out of memory for %zu steps", room), EXIT_INPUT;
    }
}

/// Measures all steps again. 0, or EXIT_NOT_PROVEN after a message.
static int check_proofs(const path_report *r, const ovoid_robot_path *path, const ovoid_robot_path_options *o) {
    ovoid_error error;
    size_t count = r->answer.step_count;
    if (r->answer.status == OVOID_ROBOT_REFUSED) return message_note("nothing is proven of a path that is refused"), 0;
    if (ovoid_robot_path_check(r->cell->cell, path, o, &r->answer, r->steps, &error) != OVOID_OK) {
        message_error("of %zu proofs not all hold: %s", count, error.message);
        return EXIT_NOT_PROVEN;
    }
    const char *until = r->answer.status == OVOID_ROBOT_FREE ? "free up to" : "free before";
    message_note("%zu of %zu proofs hold: %s s %.9g%s", count, count, until, r->answer.free_until,
                 r->answer.status == OVOID_ROBOT_HIT ? ", and the hit" : "");
    return 0;
}

static int write_answer(const path_report *r, const output_settings *out, int code) {
    cli_results results;
    if (results_open(&results, out, 0, "")) return EXIT_INPUT;
    results.header_due = 0;
    (out->json ? path_write_json : out->csv ? path_write_csv : path_write_text)(results.file, r);
    return results_close(&results, code);
}

static int run_path(const settings *s, path_report *r, ovoid_robot_checker *checker) {
    const ovoid_robot_path path = {r->states->q, r->states->count};
    ovoid_robot_path_options o = {.check = cell_make_options(&s->cell), .tolerance = s->tolerance, .states = s->most};
    double start = progress_get_seconds();
    int code = find_answer(r, checker, &path, &o);
    if (code) return code;
    double seconds = progress_get_seconds() - start;
    int proven = s->proofs ? check_proofs(r, &path, &o) : 0;
    code = write_answer(r, &s->out, proven ? proven : cell_get_exit(r->answer.status));
    if (code == EXIT_INPUT || code == EXIT_PIPE) return code;
    int drawn = s->plot ? path_plot(s->plot, r, checker, &o.check) : 0;
    message_note("%zu state%s in %.3f s; looked at: %u, steps: %zu", path.count, path.count == 1 ? "" : "s", seconds,
                 (unsigned)r->answer.states, r->answer.step_count);
    return drawn ? drawn : code;
}

/// Settles the command line. -1 to go on, or an exit code.
static int settle(const cli_command *command, settings *s) {
    int code = results_settle(command, &s->out);
    if (code < 0) code = states_settle(command, &s->states);
    if (code < 0 && s->proofs && s->out.csv)
        code = args_complain(command, "%s: --proofs goes with JSON Lines, not with CSV", command->name);
    if (s->proofs) s->out.json = 1;
    return code;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.tolerance = 0};
    cli_operands operands;
    cli_cell cell;
    cli_states states = {.part = {0, 0}};
    ovoid_error error;
    int code = command_parse(command, argc, argv, &s, &operands);
    if (code < 0) code = settle(command, &s);
    if (code >= 0) return code;
    s.cell.robot = &s.robot;
    code = cell_open(command, operands.items[0], &s.cell, &cell);
    if (code) return code;
    code = states_open(command, &s.states, &cell, &states);
    if (!code) {
        path_report r = {.cell = &cell, .states = &states, .margin = s.cell.margin};
        ovoid_robot_checker *checker = ovoid_robot_checker_create(cell.cell, NULL, &error);
        if (checker && s.proofs) r.steps = malloc(STEPS_ROOM * sizeof *r.steps);
        if (!checker || (s.proofs && !r.steps))
            message_error("out of memory"), code = EXIT_INPUT;
        else
            code = run_path(&s, &r, checker);
        ovoid_robot_checker_destroy(checker);
        free(r.steps);
        states_close(&states);
    }
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
        "States are given as to \"ovoid robot check\".",
    .exits = "0 free at all times\n"
             "1 hit\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written\n"
             "4 undecided or refused, or a proof does not hold",
    .examples = "ovoid robot path panda.urdf --scene cell.yaml --states q.csv\n"
                "ovoid robot path arm.urdf --srdf arm.srdf --state home --state up\n"
                "ovoid robot path arm.urdf --states q.csv --proofs -o proof.jsonl\n"
                "ovoid robot path arm.urdf --states q.csv --plot clearance.svg",
    .options = options,
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
