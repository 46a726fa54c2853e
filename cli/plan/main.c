// ovoid-plan: `ovoid robot plan`, linked with OMPL. The tool starts it with its own command line. What the planner
// finds is proven once more as a whole, and that proof is verified, before anything is written.
#include "base/finish.h"
#include "base/message.h"
#include "base/progress.h"
#include "plan/ends.h"
#include "plan/search.h"
#include "robot/commands.h"
#include "robot/page.h"
#include "robot/path/answer.h"
#include "robot/path/proof.h"

#include <stdlib.h>
#include <string.h>

/// A run: what is planned, and the path with its proof.
typedef struct plan_run {
    const plan_settings *settings;
    const char *urdf;
    const cli_cell *cell;
    cli_states path;
    path_report report;
    ovoid_robot_checker *checker;
    robot_page page;
} plan_run;

/// Writes one output by a function of the run. 0, or an exit code after a message.
static int write_output(const plan_run *run, const char *path, void (*write)(FILE *file, const plan_run *run)) {
    const output_settings out = {.path = path};
    cli_results results;
    if (results_open(&results, &out, 0, "")) return EXIT_INPUT;
    write(results.file, run);
    return results_close(&results, 0);
}

static void write_path(FILE *file, const plan_run *run) {
    (run->settings->json ? states_write_trajectory : states_write_csv)(file, run->cell, &run->path);
}

static void write_proofs(FILE *file, const plan_run *run) {
    proof_write_source(file, &(const proof_source){run->urdf, &run->settings->cell, run->cell, 1});
    path_write_json(file, &run->report);
}

/// Searches. 0: the path is in the run; or an exit code after a message.
static int find_path(plan_run *run, const cli_states *states, const plan_ends *ends) {
    const plan_settings *s = run->settings;
    const search_problem problem = {.robot = run->cell->robot.robot,
                                    .cell = run->cell->cell,
                                    .start = states->q,
                                    .goals = ends->goals,
                                    .goal_count = ends->goal_count,
                                    .moving = ends->moving,
                                    .moving_count = ends->moving_count,
                                    .query = cell_make_options(&s->cell),
                                    .planner = (search_planner)s->planner,
                                    .seed = s->seed,
                                    .seconds = s->seconds,
                                    .is_raw = s->is_raw};
    search_result found = search_path(&problem);
    if (found.why[0]) return free(found.q), message_error("the planner refused: %s", found.why), EXIT_INPUT;
    if (!found.q) {
        message_note("no path was found in %.3f s; motions: %u", found.planned, found.motions);
        return EXIT_TOUCH;
    }
    run->path = (cli_states){.q = found.q, .count = found.count, .variable_count = states->variable_count};
    message_note("path of %zu states, length %.4g; planned in %.3f s, shortened from %.4g in %.3f s; motions: %u",
                 found.count, found.length, found.planned, found.raw_length, found.shortened, found.motions);
    return 0;
}

/// Proves the whole path and verifies the proof. 0, or an exit code after a message.
static int prove(plan_run *run) {
    path_report *r = &run->report;
    const ovoid_robot_path path = {run->path.q, run->path.count};
    ovoid_robot_path_options how = {.query = cell_make_options(&run->settings->cell)};
    ovoid_error error;
    *r = (path_report){.cell = run->cell,
                       .states = &run->path,
                       .has_proofs = 1,
                       .margin = how.query.margin,
                       .steps = path_create_steps()};
    run->checker = ovoid_robot_checker_create(run->cell->cell, NULL, &error);
    if (!r->steps || !run->checker) return message_error("out of memory"), EXIT_INPUT;
    int code = path_find_answer(r, run->checker, &path, &how);
    if (!code) code = path_check_proofs(r, &path, &how);
    if (code || r->answer.status == OVOID_ROBOT_FREE) return code;
    message_error("the path as a whole is not proven free: %s", cell_get_status_name(r->answer.status));
    return EXIT_NOT_PROVEN;
}

static int write_all(plan_run *run) {
    const plan_settings *s = run->settings;
    int code = s->proofs ? write_output(run, s->proofs, write_proofs) : 0;
    if (!code && s->html) {
        const robot_page_source source = {run->urdf, &s->cell, run->cell, &run->path, run->checker, &run->report};
        robot_page_add_path(&run->page, &run->report);
        code = robot_page_write(&run->page, &source);
    }
    return code ? code : write_output(run, s->output, write_path);
}

static int plan(plan_run *run, const cli_command *command, cli_states *states) {
    plan_ends ends;
    int code = ends_open(command, run->settings, run->cell, states, &ends);
    if (code) return code;
    code = find_path(run, states, &ends);
    if (!code) code = prove(run);
    if (!code && run->settings->json) code = states_check_trajectory(run->cell, &run->path);
    if (!code) code = write_all(run);
    ends_close(&ends);
    states_close(&run->path);
    free(run->report.steps);
    ovoid_robot_checker_destroy(run->checker);
    return code;
}

static int run_plan(const cli_command *command, int argc, char **argv) {
    plan_settings s = PLAN_DEFAULTS;
    cli_operands operands;
    cli_cell cell;
    cli_states states = {.part = {0, 0}};
    int code = plan_settle(command, argc, argv, &s, &operands);
    if (code >= 0) return code;
    plan_run run = {.settings = &s, .urdf = operands.items[0], .cell = &cell};
    if (robot_page_open(&run.page, s.html)) return EXIT_INPUT;
    code = cell_open(command, operands.items[0], &s.cell, &cell);
    if (code) return robot_page_close(&run.page), code;
    code = states_open(command, &s.states, &cell, &states);
    if (!code) {
        code = cell_attach(command, &s.cell, states.q, &cell);
        if (!code) cell_tell_held(&cell, &s.cell);
        if (!code) code = plan(&run, command, &states);
        states_close(&states);
    }
    robot_page_close(&run.page);
    cell_close(&cell);
    return code;
}

int main(int argc, char **argv) {
    finish_catch_signals();
    page_keep_words(argc, argv);
    if (argc >= 3 && strcmp(argv[1], "robot") == 0 && strcmp(argv[2], "plan") == 0)
        return run_plan(&command_robot_plan, argc - 3, argv + 3);
    fputs("ovoid-plan is started by: ovoid robot plan\n", stderr);
    return EXIT_USAGE;
}
