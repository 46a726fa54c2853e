// The command line: each command is one table of options, and everything that concerns options comes from that table:
// parsing, the messages about mistakes, --help, and the words that shell completion offers.
#ifndef OVOID_CLI_BASE_ARGS_H
#define OVOID_CLI_BASE_ARGS_H

#include "shard/part.h"

#include <ovoid/linear.h>

#include <stddef.h>
#include <stdio.h>

/// Exit codes, the same for every command.
typedef enum exit_code {
    EXIT_APART = 0,      ///< apart; or done, for commands without a query
    EXIT_TOUCH = 1,      ///< touching, overlapping or within the margin; of a mesh, a fault
    EXIT_USAGE = 2,      ///< the command line is wrong
    EXIT_INPUT = 3,      ///< bad input, or output that could not be written
    EXIT_NOT_PROVEN = 4, ///< no proof, or a proof that does not hold
    EXIT_PIPE = 141      ///< the reader of standard output has closed it: the code that a shell reports for SIGPIPE
} exit_code;

/// The value that an option takes, and its type in the command's settings.
typedef enum option_kind {
    OPTION_FLAG,     ///< nothing; int 1
    OPTION_LENGTH,   ///< a number from 0 to OVOID_LENGTH_MAX; double
    OPTION_POSITIVE, ///< a number above 0, at most OVOID_LENGTH_MAX; double
    OPTION_SHARE,    ///< a number above 0 and below 1; double
    OPTION_COUNT,    ///< a whole number from 1 to 1 000 000 000; unsigned
    OPTION_AMOUNT,   ///< a whole number from 0 to 1 000 000 000; unsigned
    OPTION_CHOICE,   ///< one of `choices`; int, its place in the list
    OPTION_SET,      ///< some of `choices`, separated by commas; unsigned, bit i for the i-th
    OPTION_TEXT,     ///< a name; const char *
    OPTION_FILE,     ///< a path that is read; const char *
    OPTION_OUTPUT,   ///< a path that is written, in the formats of `choices`; const char *
    OPTION_VECTOR,   ///< three numbers in one argument; ovoid_vec3
    OPTION_POSE,     ///< a position and perhaps a rotation in one argument; ovoid_pose
    OPTION_PART,     ///< "I/N", part I of N; shard_part
    OPTION_LIST      ///< a text; the option may be repeated; args_list
} option_kind;

/// The largest number of repetitions of an option, and their texts.
enum { ARGS_LIST_MAX = 64 };
typedef struct args_list {
    const char *items[ARGS_LIST_MAX];
    int count;
} args_list;

/// One option.
typedef struct cli_option {
    const char *name; ///< without the dashes; NULL ends a table
    char letter;      ///< short form, 0 for none
    option_kind kind;
    size_t offset;       ///< of its value in the settings
    const char *value;   ///< name of the value in help, NULL for a flag
    const char *choices; ///< "one|two|three" for OPTION_CHOICE and OPTION_SET; extensions for OPTION_OUTPUT
    const char *help;    ///< what it does, and its default
} cli_option;

/// The operands of a command line, in order.
typedef struct cli_operands {
    const char **items;
    int count;
} cli_operands;

/// One command of the tool.
typedef struct cli_command {
    const char *name;
    const char *summary;     ///< for the list of commands
    const char *usage;       ///< synopsis lines after the name, separated by newlines
    const char *description; ///< paragraphs, separated by newlines
    const char *exits;       ///< the meaning of the exit codes, lines "CODE text"
    const char *examples;    ///< lines
    const cli_option *options;
    int operands_min, operands_max;               ///< -1: no limit
    const struct cli_command *const *subcommands; ///< a list that ends with NULL, of the words that the first argument
                                                  ///< may be; their names begin with this one's. NULL: none
    int (*run)(const struct cli_command *command, int argc, char **argv);
} cli_command;

/// Parses argv (without the program's and the command's names) into the settings, which must hold the defaults. argv is
/// reordered: operands come first. Returns -1 to continue, or the exit code: after --help, or after a message about a
/// mistake.
int args_parse(const cli_command *command, int argc, char **argv, void *settings, cli_operands *operands);

/// The value of a pose option, for options tables.
#define ARGS_POSE "\"X Y Z [QW QX QY QZ]\""
#define ARGS_POSE_HELP                                                                                                 \
    ": position, then a quaternion, or \"rpy R P Y\" in radians or \"deg R P Y\" in degrees, roll first"

/// Writes to stderr the mistake in the command line, and where help is; returns EXIT_USAGE. command may be NULL.
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
int
args_complain(const cli_command *command, const char *format, ...);

/// Parses a text that is one number, including infinity and NaN; 0 if it is not a number.
int args_parse_number(const char *text, double *value);

/// Parses "X Y Z", followed by a quaternion, or by "rpy" or "deg" and three angles; 0 for anything else.
int args_parse_pose(const char *text, ovoid_pose *pose);
/// 1 for the pose at the origin, which is the default of such an option.
int args_is_origin(const ovoid_pose *pose);

/// The subcommand of that name, which is given without the command's own name, or NULL.
const cli_command *args_find_subcommand(const cli_command *command, const char *name);

/// The name of a subcommand without that of its command.
const char *args_get_last_word(const cli_command *command);

/// The word that begins with the mistyped one, or else the nearest one (at most two edits), or NULL.
const char *args_find_similar(const char *word, const char *const *words, size_t count);

#endif
