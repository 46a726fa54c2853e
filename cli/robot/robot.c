// ovoid robot: finds the command about robots and calls it.
#include "robot/commands.h"

#include "base/help.h"
#include "commands.h"

#include <string.h>

static const cli_command *const subcommands[] = {&command_robot_info,
                                                 &command_robot_check,
                                                 &command_robot_path,
                                                 &command_robot_plan,
                                                 &command_robot_matrix,
                                                 &command_robot_spheres,
                                                 NULL};
#define SUBCOMMAND_COUNT (sizeof subcommands / sizeof *subcommands - 1)

static int complain_unknown(const cli_command *command, const char *name) {
    const char *words[SUBCOMMAND_COUNT];
    for (size_t i = 0; i < SUBCOMMAND_COUNT; i++) words[i] = args_get_last_word(subcommands[i]);
    const char *similar = args_find_similar(name, words, SUBCOMMAND_COUNT);
    if (similar) return args_complain(command, "robot: unknown command %s; did you mean %s?", name, similar);
    return args_complain(command, "robot: unknown command %s", name);
}

static int run(const cli_command *command, int argc, char **argv) {
    if (argc < 1) {
        (void)help_print_command(stderr, command);
        return EXIT_USAGE;
    }
    const cli_command *sub = args_find_subcommand(command, argv[0]);
    if (sub) return sub->run(sub, argc - 1, argv + 1);
    if (strcmp(argv[0], "--help") == 0 || strcmp(argv[0], "-h") == 0) return help_print_command(stdout, command);
    return complain_unknown(command, argv[0]);
}

static const cli_option options[] = {{.name = NULL}};

const cli_command command_robot = {
    .name = "robot",
    .summary = "robots from URDF files: what they are, and what they hit",
    .usage = "COMMAND [ARGUMENT...]",
    .description = "A robot is a URDF with its meshes, and perhaps an SRDF, which says which of its links need not be "
                   "looked at. Lengths are metres, angles radians. A file that ends in .xacro is expanded by the "
                   "program xacro, if it is on PATH; else: xacro FILE > robot.urdf.",
    .exits = "0 done, or free\n"
             "1 a state or a path hits\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written\n"
             "4 not proven",
    .examples = "ovoid robot info panda.urdf --srdf panda.srdf\n"
                "ovoid robot check panda.urdf --scene cell.yaml --states q.csv\n"
                "ovoid robot path panda.urdf --scene cell.yaml --states q.csv\n"
                "ovoid robot plan panda.urdf --scene cell.yaml --states ends.csv -o path.csv\n"
                "ovoid robot check --help",
    .options = options,
    .operands_min = 1,
    .operands_max = -1,
    .subcommands = subcommands,
    .run = run,
};
