// Help texts, made from the tables of commands and options.
#ifndef OVOID_CLI_BASE_HELP_H
#define OVOID_CLI_BASE_HELP_H

#include "base/args.h"

/// Prints the help of one command, at most 80 columns wide. Returns EXIT_APART, or EXIT_INPUT if the file cannot be
/// written.
int help_print_command(FILE *file, const cli_command *command);

/// Prints the help of the tool: its commands, a NULL-terminated list.
int help_print_tool(FILE *file, const cli_command *const *commands);

/// Prints the words for shell completion: the commands, or with a command its options; one a line, fields between tabs:
/// "--name", "flag" or "file" or "choice" or "value", choices with bars, first sentence of the help.
int help_print_words(FILE *file, const cli_command *const *commands, const cli_command *command);

/// Prints text in lines of at most 80 columns, each indented; `column` is the column of the first line so far.
void help_print_wrapped(FILE *file, const char *text, int indent, int column);

#endif
