// ovoid robot matrix: which pairs of links can touch, proven or sampled, as a table, JSON or an SRDF; and what a given
// SRDF leaves out wrongly.
#include "robot/matrix/matrix.h"

#include "base/finish.h"
#include "base/message.h"
#include "base/outputs.h"
#include "base/progress.h"
#include "robot/commands.h"

typedef struct settings {
    robot_settings robot;
    unsigned samples, budget, seed;
    int json, sampled;
    const char *output, *pictures;
} settings;

static const cli_option options[] = {
    ROBOT_OPTIONS(settings),
    {"samples", 'n', OPTION_COUNT, offsetof(settings, samples), "N", NULL, "random states (default: 10000)"},
    {"budget", 0, OPTION_COUNT, offsetof(settings, budget), "N", NULL,
     "the most cells of joint space that the proof of a pair looks at (default: 100000)"},
    {"seed", 0, OPTION_AMOUNT, offsetof(settings, seed), "S", NULL, "of the random states (default: 0)"},
    {"sampled", 0, OPTION_FLAG, offsetof(settings, sampled), NULL, NULL,
     "the SRDF leaves out, too, what is sampled and not proven"},
    {"output", 'o', OPTION_OUTPUT, offsetof(settings, output), "FILE", "srdf",
     "write the pairs that may be left out, as an SRDF of its own"},
    {"pictures", 0, OPTION_FILE, offsetof(settings, pictures), "DIR", NULL,
     "with --srdf: a picture of each pair that is disabled wrongly, both links in the state that shows it, as SVG "
     "files "
     "in a folder"},
    {"json", 0, OPTION_FLAG, offsetof(settings, json), NULL, NULL,
     "write lines of JSON: a pair each, with the states that prove it"},
    {.name = NULL},
};

static int write_srdf(const char *path, const matrix_view *v, int with_sampled) {
    ovoid_output *output = finish_open(path);
    if (!output) return EXIT_INPUT;
    matrix_write_srdf(ovoid_output_get_file(output), v, with_sampled);
    return finish_close(output, 0);
}

static int report(const settings *s, const matrix_view *v) {
    (s->json ? matrix_write_json : matrix_write_text)(stdout, v);
    int code = finish_file(stdout);
    if (!code && s->output) code = write_srdf(s->output, v, s->sampled);
    if (!code && s->pictures) code = matrix_write_pictures(s->pictures, v);
    return code;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.json = 0};
    cli_operands operands;
    cli_robot robot;
    int code = command_parse(command, argc, argv, &s, &operands);
    if (code < 0 && s.pictures && !s.robot.srdf)
        code = args_complain(command, "%s: --pictures are of pairs that --srdf FILE disables", command->name);
    if (code < 0) code = robot_settle(command, &s.robot);
    if (code >= 0) return code;
    code = robot_open(command, operands.items[0], &s.robot, &robot);
    if (code) return code;
    ovoid_error error;
    ovoid_robot_matrix_options making = {
        .samples = s.samples, .budget = s.budget, .seed = s.seed, .watch = progress_make_watch(1)};
    progress_start("groups of states and cells of joint space", 0);
    ovoid_robot_matrix *matrix = ovoid_robot_matrix_create(robot.robot, &making, &error);
    progress_end();
    if (matrix) {
        matrix_view view = {robot.robot, ovoid_robot_get_description(robot.robot), matrix, s.robot.srdf != NULL};
        code = report(&s, &view);
    } else {
        message_error("%s: %s", operands.items[0], error.message);
        code = EXIT_INPUT;
    }
    ovoid_robot_matrix_destroy(matrix);
    robot_close(&robot);
    return code;
}

const cli_command command_robot_matrix = {
    .name = "robot matrix",
    .summary = "which links can touch: never, always, sometimes; proven or sampled",
    .usage = "[OPTION...] ROBOT.urdf",
    .description =
        "Each pair of links that have collision geometry, over all states within the limits. \"never\" and \"always\" "
        "are proven over the whole box of the joints between the two; \"sampled never\" and \"sampled always\" say "
        "that "
        "no random state showed otherwise; \"sometimes\" has a state in which they touch and one in which they do not. "
        "Neighbours have no other geometry between them. A mesh is a hull, a solid or a surface, as everywhere. What "
        "a link holds has no place in a matrix of links: \"ovoid robot check --attach\" finds the states in which it "
        "touches.\n\n"
        "With --srdf the pairs that the file disables are looked at like all others, and compared: those that are "
        "disabled wrongly, with a state in which they touch, and those that might be disabled and are not.",
    .exits = "0 done\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written",
    .examples = "ovoid robot matrix panda.urdf --srdf panda.srdf\n"
                "ovoid robot matrix panda.urdf --srdf panda.srdf --pictures wrong\n"
                "ovoid robot matrix arm.urdf --budget 100000 -o arm.srdf\n"
                "ovoid robot matrix arm.urdf --json > matrix.jsonl",
    .options = options,
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
