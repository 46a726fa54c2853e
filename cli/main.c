// The tool's entry: finds the command and calls it with its arguments.
#include "base/finish.h"
#include "base/help.h"
#include "commands.h"
#include "page/page.h"
#include "verdict.h"

#include <ovoid/io.h>
#include <ovoid/ovoid.h>

#include <stdio.h>
#include <string.h>

static const cli_command *const commands[] = {&command_fit,
                                              &command_info,
                                              &command_decompose,
                                              &command_distance,
                                              &command_batch,
                                              &command_check,
                                              &command_run,
                                              &command_pack,
                                              &command_merge,
                                              &command_verify,
                                              &command_view,
                                              &command_paper,
#ifdef OVOID_HAVE_ROBOT
                                              &command_robot,
#endif
                                              NULL};
#define COMMAND_COUNT (sizeof commands / sizeof *commands - 1)

static const cli_command *find_command(const char *name) {
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(commands[i]->name, name) == 0) return commands[i];
    return NULL;
}

static int complain_unknown(const char *name) {
    const char *words[COMMAND_COUNT];
    for (size_t i = 0; i < COMMAND_COUNT; i++) words[i] = commands[i]->name;
    const char *similar = args_find_similar(name, words, COMMAND_COUNT);
    if (similar) return args_complain(NULL, "unknown command %s; did you mean %s?", name, similar);
    return args_complain(NULL, "unknown command %s", name);
}

static int print_version(void) {
    printf("ovoid %s\n", ovoid_get_version());
    printf("verify: %s\n",
           verdict_is_exact() ? "exact rational arithmetic (GMP)" : "floating point with rigorous error bounds");
    printf("meshes: STL, OBJ, OFF, PLY%s\n", ovoid_io_has_assimp() ? ", COLLADA, glTF and more through Assimp" : "");
    return finish_file(stdout);
}

/// The command of one word, or of two where the first one has subcommands; the command itself where the second word is
/// none of these.
static const cli_command *find_whole(int argc, char **argv) {
    const cli_command *command = argc > 0 ? find_command(argv[0]) : NULL;
    const cli_command *sub = command && argc > 1 ? args_find_subcommand(command, argv[1]) : NULL;
    return sub ? sub : command;
}

/// Runs "help" or "help COMMAND".
static int run_help(int argc, char **argv) {
    if (argc < 1) return help_print_tool(stdout, commands);
    const cli_command *command = find_whole(argc, argv);
    return command ? help_print_command(stdout, command) : complain_unknown(argv[0]);
}

/// Runs "complete" or "complete COMMAND", for shell completion.
static int run_complete(int argc, char **argv) { return help_print_words(stdout, commands, find_whole(argc, argv)); }

int main(int argc, char **argv) {
    finish_catch_signals();
    page_keep_words(argc, argv);
    if (argc < 2) {
        help_print_tool(stderr, commands);
        return EXIT_USAGE;
    }
    const char *name = argv[1];
    const cli_command *command = find_command(name);
    int code;
    if (command)
        code = command->run(command, argc - 2, argv + 2);
    else if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0)
        code = run_help(argc - 2, argv + 2);
    else if (strcmp(name, "--version") == 0 || strcmp(name, "version") == 0)
        code = print_version();
    else if (strcmp(name, "complete") == 0)
        code = run_complete(argc - 2, argv + 2);
    else
        code = name[0] == '-' ? args_complain(NULL, "unknown option %s", name) : complain_unknown(name);
    return code;
}
