// Help texts. Lines break at spaces before column 80; a newline in a text begins a new line, "\n\n" a paragraph.
#include "base/help.h"

#include "base/finish.h"

#include <string.h>

/// Columns of a line, and where the explanations of options begin.
#define WIDTH 80
#define HELP_COLUMN 26

void help_print_wrapped(FILE *file, const char *text, int indent, int column) {
    int fresh = 1; // the line contains only its indent so far
    for (; column < indent; column++) fputc(' ', file);
    while (*text) {
        if (*text == '\n') {
            fputc('\n', file);
            for (column = 0; column < indent && text[1] && text[1] != '\n'; column++) fputc(' ', file);
            fresh = 1, text++;
            continue;
        }
        int length = (int)strcspn(text, " \n");
        if (!fresh && column + 1 + length > WIDTH) {
            fprintf(file, "\n%*s", indent, "");
            column = indent, fresh = 1;
        }
        column += fprintf(file, "%s%.*s", fresh ? "" : " ", length, text);
        fresh = 0;
        text += length;
        if (*text == ' ') text++;
    }
    fputc('\n', file);
}

/// Prints "  -o, --output FILE", then the explanation, beside it or below.
static void print_option(FILE *file, char letter, const char *name, const char *value, const char *help) {
    int column = letter ? fprintf(file, "  -%c, --%s", letter, name) : fprintf(file, "      --%s", name);
    if (value) column += fprintf(file, " %s", value);
    if (column + 2 > HELP_COLUMN) {
        fputc('\n', file);
        column = 0;
    }
    help_print_wrapped(file, help, HELP_COLUMN, column);
}

/// Prints lines of text, each after two spaces.
static void print_lines(FILE *file, const char *title, const char *text) {
    fprintf(file, "\n%s:\n", title);
    while (*text) {
        int length = (int)strcspn(text, "\n");
        fprintf(file, "  %.*s\n", length, text);
        text += length + (text[length] == '\n');
    }
}

/// Prints each line of the synopsis after "ovoid NAME".
static void print_usage(FILE *file, const cli_command *command) {
    const char *text = command->usage, *head = "Usage:";
    while (*text) {
        int length = (int)strcspn(text, "\n");
        fprintf(file, "%s ovoid %s %.*s\n", head, command->name, length, text);
        text += length + (text[length] == '\n');
        head = "      ";
    }
}

/// Prints the list of commands, each by its last word.
static void print_commands(FILE *file, const cli_command *const *commands) {
    fprintf(file, "\nCommands:\n");
    for (; *commands; commands++) {
        int column = fprintf(file, "  %s", args_get_last_word(*commands));
        help_print_wrapped(file, (*commands)->summary, 12, column);
    }
}

int help_print_command(FILE *file, const cli_command *command) {
    print_usage(file, command);
    fputc('\n', file);
    help_print_wrapped(file, command->description, 0, 0);
    if (command->subcommands) print_commands(file, command->subcommands);
    fprintf(file, "\nOptions:\n");
    for (const cli_option *o = command->options; o->name; o++)
        print_option(file, o->letter, o->name, o->value, o->help);
    print_option(file, 'h', "help", NULL, "this text");
    print_lines(file, "Exit codes", command->exits);
    print_lines(file, "Examples", command->examples);
    return finish_file(file);
}

int help_print_tool(FILE *file, const cli_command *const *commands) {
    fprintf(file, "Usage: ovoid COMMAND [ARGUMENT...]\n\n");
    help_print_wrapped(file,
                       "How far apart are convex bodies, and how deep do they overlap: every answer is a bracket, "
                       "lower <= d <= upper, with a proof that anyone can check.",
                       0, 0);
    print_commands(file, commands);
    fprintf(file, "\nOptions:\n");
    print_option(file, 'h', "help", NULL, "this text; after a command, that command's");
    print_option(file, 0, "version", NULL, "the version, and what it was built with");
    print_lines(file, "Exit codes",
                "0 apart (or done)\n1 touching, overlapping or within the margin\n2 the command line is wrong\n"
                "3 bad input, or output that could not be written\n4 not proven");
    fprintf(file, "\nThe manual: man ovoid\n");
    return finish_file(file);
}

static const char *get_kind_name(option_kind kind) {
    switch (kind) {
    case OPTION_FLAG: return "flag";
    case OPTION_FILE:
    case OPTION_OUTPUT: return "file";
    case OPTION_CHOICE:
    case OPTION_SET: return "choice";
    default: return "value";
    }
}

int help_print_words(FILE *file, const cli_command *const *commands, const cli_command *command) {
    if (!command) {
        for (; *commands; commands++) fprintf(file, "%s\n", (*commands)->name);
        return finish_file(file);
    }
    for (const cli_command *const *c = command->subcommands; c && *c; c++)
        fprintf(file, "%s\tcommand\t\n", args_get_last_word(*c));
    for (const cli_option *o = command->options; o->name; o++) {
        fprintf(file, "--%s\t%s\t%s\n", o->name, get_kind_name(o->kind), o->choices ? o->choices : "");
        if (o->letter) fprintf(file, "-%c\t%s\t\n", o->letter, get_kind_name(o->kind));
    }
    fprintf(file, "--help\tflag\t\n-h\tflag\t\n");
    return finish_file(file);
}
