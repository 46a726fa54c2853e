// The rules for output paths: a command never overwrites its inputs, and never writes a file with the extension of a
// format that it does not write.
#ifndef OVOID_CLI_BASE_OUTPUTS_H
#define OVOID_CLI_BASE_OUTPUTS_H

#include "base/args.h"

/// args_parse, then checks every OPTION_OUTPUT against its formats, the operands and the other paths. -1 to continue,
/// or an exit code.
int command_parse(const cli_command *command, int argc, char **argv, void *settings, cli_operands *operands);

/// 1 if the path ends in a dot and the word, in any case.
int outputs_has_extension(const char *path, const char *word);

/// 1 if both paths are one file, by a link or through other folders too; "-" and pipes are none.
int outputs_is_same_file(const char *a, const char *b);

#endif
