// The rules for output paths: a command never writes over its inputs, nor under the extension of a format that it does
// not write.
#ifndef OVOID_CLI_OUTPUTS_H
#define OVOID_CLI_OUTPUTS_H

#include "args.h"

/// Checks every OPTION_OUTPUT of the command line against its formats, the operands and the other paths. -1 to go on,
/// or EXIT_USAGE after a message.
int outputs_check(const cli_command *command, const void *settings, const cli_operands *operands);

/// 1 if the path ends in a dot and the word, in any case.
int outputs_has_extension(const char *path, const char *word);

#endif
