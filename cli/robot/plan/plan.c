// ovoid robot plan: its command line. The planning is done by a program of its own beside the tool, which then needs
// neither OMPL nor a C++ library.
#include "robot/plan/plan.h"

#include "base/beside.h"
#include "base/message.h"
#include "base/outputs.h"
#include "page/page.h"
#include "robot/commands.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const cli_option options[] = {
    STATES_OPTIONS(plan_settings),
    CELL_OPTIONS(plan_settings),
    ATTACH_OPTION(plan_settings),
    {"moving", 0, OPTION_TEXT, offsetof(plan_settings, moving), "WHAT", NULL,
     "the joints of this group of the SRDF move, or the joints \"NAME,...\", all others stand still (default: the "
     "group "
     "of the request, where the SRDF has it; else all joints but floating ones and lengths without limits)"},
    {"planner", 0, OPTION_CHOICE, offsetof(plan_settings, planner), "NAME", "rrtconnect|biest",
     "the planner of OMPL: rrtconnect or biest (default: rrtconnect)"},
    {"time", 0, OPTION_POSITIVE, offsetof(plan_settings, seconds), "S", NULL,
     "give up after S seconds of planning (default: 10)"},
    {"seed", 0, OPTION_COUNT, offsetof(plan_settings, seed), "N", NULL,
     "seed of the random numbers; the same seed gives the same path (default: 1)"},
    {"raw", 0, OPTION_FLAG, offsetof(plan_settings, is_raw), NULL, NULL, "do not shorten the path that was found"},
    {"json", 0, OPTION_FLAG, offsetof(plan_settings, json), NULL, NULL,
     "write the path as JSON, a robot trajectory of MoveIt without times, in the place of CSV"},
    {"output", 'o', OPTION_OUTPUT, offsetof(plan_settings, output), "FILE", "csv|json",
     "write the path to FILE, which appears whole or not at all; .csv and .json choose the format (default: standard "
     "output)"},
    {"proofs", 0, OPTION_OUTPUT, offsetof(plan_settings, proofs), "FILE", "jsonl",
     "also write the proof of the whole path, for ovoid verify"},
    PAGE_OPTION(plan_settings),
    ROBOT_OPTIONS(plan_settings),
    {.name = NULL},
};

int plan_settle(const cli_command *command, int argc, char **argv, plan_settings *s, cli_operands *operands) {
    int code = command_parse(command, argc, argv, s, operands);
    if (code >= 0) return code;
    const char *path = s->output ? s->output : "";
    if (s->json && outputs_has_extension(path, "csv"))
        return args_complain(command, "%s: %s is no name for JSON", command->name, path);
    s->json |= outputs_has_extension(path, "json");
    if (s->states.texts.count == 1)
        return args_complain(command, "%s: the first --state is the start; a second one, the goal, is wanted",
                             command->name);
    code = states_settle(command, &s->states, &s->cell);
    if (code < 0) code = page_settle(command, s->html, (shard_part){0, 0});
    if (code < 0) code = robot_settle(command, &s->robot);
    s->cell.robot = &s->robot;
    return code;
}

static int complain_absent(const char *path) {
    message_error("robot plan: %s is not there: this tool was built or installed without OMPL (Debian: the package "
                  "ovoid-plan, or libompl-dev to build it)",
                  path);
    return EXIT_INPUT;
}

/// Goes on as the program that plans, with the command line as it was given.
static int run(const cli_command *command, int argc, char **argv) {
    plan_settings s = PLAN_DEFAULTS;
    cli_operands operands;
    char folder[BESIDE_FOLDER_ROOM], path[BESIDE_PATH_ROOM];
    char **words = calloc((size_t)argc + 4, sizeof *words);
    if (!words) return message_error("out of memory"), EXIT_INPUT;
    if (argc) memcpy(words + 3, argv, (size_t)argc * sizeof *words);
    int code = command_parse(command, argc, argv, &s, &operands);
    if (code >= 0) return free(words), code;
    if (!beside_find_folder(folder)) folder[0] = '.', folder[1] = 0;
    snprintf(path, sizeof path, "%s/" PLAN_PROGRAM, folder);
    char robot[] = "robot", plan[] = "plan";
    words[0] = path, words[1] = robot, words[2] = plan;
    if (access(path, X_OK) == 0) execv(path, words);
    free(words);
    return complain_absent(path);
}

const cli_command command_robot_plan = {
    .name = "robot plan",
    .summary = "a path from a start to a goal, proven free at all times",
    .usage = "[OPTION...] ROBOT.urdf --request FILE\n[OPTION...] ROBOT.urdf --state START --state GOAL...",
    .description =
        "Finds a path with a planner of OMPL, whose motions are proven free at all times in between, shortens it, "
        "proves "
        "the whole path once more and verifies that proof without a search. The first state is the start, the others "
        "are "
        "goals, of which one is reached. A continuous joint turns the shorter way round, and may pass pi.\n\n"
        "The path is written as states, one a line, for \"ovoid robot path --states\", or for MoveIt. Planning ends "
        "when "
        "a path is found, so the same seed gives the same path, however fast the machine is.",
    .exits = "0 a path was found; it is proven free\n"
             "1 none was found in the time, or the start or all goals hit\n"
             "2 the command line is wrong\n"
             "3 bad input, output that could not be written, or a tool without OMPL\n"
             "4 the whole path is not proven",
    .examples = "ovoid robot plan panda.urdf --request request1.yaml -o path.csv\n"
                "ovoid robot plan arm.urdf --scene cell.yaml --state home --state up -o path.json\n"
                "ovoid robot plan arm.urdf --states ends.csv --html path.html -o path.csv",
    .options = options,
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
