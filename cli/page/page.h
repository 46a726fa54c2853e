// A page: one self-contained HTML file made of a template and data, which shows the results of a command and checks
// them in the browser. docs/page.md describes the format of the data.
#ifndef OVOID_CLI_PAGE_H
#define OVOID_CLI_PAGE_H

#include "base/args.h"
#include "page/template.h"

#include <ovoid/io.h>

/// The row of an options table; `html` is a const char * of the settings.
#define PAGE_OPTION(settings)                                                                                          \
    {                                                                                                                  \
        "html", 0, OPTION_OUTPUT, offsetof(settings, html), "FILE", "html|htm",                                        \
            "also write a page for the browser, one file that shows the bodies and checks the proofs"                  \
    }

/// Counts of what was left out of a page.
typedef struct page_left_out {
    size_t pairs, bodies, meshes, proofs; ///< those of the nearest pairs stay
    size_t frames, events;                ///< of a motion
    size_t states, steps;                 ///< of a robot, of a path's proof
} page_left_out;

/// A page under construction. All zero: no page is wanted.
typedef struct cli_page {
    const char *path; ///< NULL: no page is wanted
    page_template template;
    ovoid_output *output;
    FILE *file; ///< of the output, between page_begin and page_end
    page_left_out left_out;
} cli_page;

/// Stores the words of the command line for the page, since they are reordered later.
void page_keep_words(int argc, char **argv);

/// Refuses standard output, and a page of a shard. -1 to go on, or EXIT_USAGE.
int page_settle(const cli_command *command, const char *path, shard_part part);

/// Reads the template, before the work that the page will show; path NULL: nothing. 0, or EXIT_INPUT after a message.
int page_open(cli_page *page, const char *path);

/// The head of the data.
typedef struct page_head {
    const char *title; ///< a path, of which the file's name is taken
    const char *other; ///< a second one, or NULL
    const char *unit;  ///< "" for none
    double margin;     ///< negative: not given
} page_head;

/// Begins the file: the template up to the data, and their head. 0, or EXIT_INPUT after a message.
int page_begin(cli_page *page, const page_head *head);

/// Ends the data and the file, which appears completely or not at all. code: the result of the work in between; if it
/// is not 0 the file is dropped. Reports on stderr what was left out. Returns the code, or EXIT_INPUT after a message.
int page_end(cli_page *page, int code);

/// Frees the page, and drops an unfinished file.
void page_close(cli_page *page);

#endif
