// The report of the experiment: a folder of CSV files and SVG figures, and one HTML page with all figures and tables,
// which needs no other file and can be printed. The page begins with its title, the verdicts and the contents.
#ifndef OVOID_CLI_PAPER_REPORT_H
#define OVOID_CLI_PAPER_REPORT_H

#include <ovoid/io.h>

/// Errors are stored: after the first one nothing is done, and report_finish returns it.
typedef struct report report;

/// Makes the folder if it is not there. NULL without memory.
report *report_create(const char *folder);

/// 1 until something fails.
int report_is_good(const report *r);

/// Adds a section's heading. The first one is the page's title; verdicts and contents come before the second.
void report_add_section(report *r, const char *title);

/// Adds a paragraph; escaped. Blank lines in it begin new ones.
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void
report_add_text(report *r, const char *format, ...);

/// The paper's result, the measured one, and why they differ: one line each, below a figure.
typedef struct report_finding {
    const char *paper, *measured, *why;
} report_finding;
void report_add_finding(report *r, report_finding finding);

/// A row of the table at the top: what the paper claims, whether that holds here, what was measured, and what ovoid
/// does instead. It links to the section in which it is added.
typedef enum report_holds { REPORT_HOLDS, REPORT_HOLDS_IN_PART, REPORT_DOES_NOT_HOLD } report_holds;
typedef struct report_verdict {
    const char *claim;
    report_holds holds;
    const char *measured, *ours;
} report_verdict;
void report_add_verdict(report *r, report_verdict verdict);

/// Adds NAME.svg, and the same figure in the page.
void report_add_chart(report *r, const char *name, const ovoid_chart *chart);

/// Adds a picture of bodies with a caption in the same way.
void report_add_picture(report *r, const char *name, const ovoid_picture *picture, const ovoid_picture_options *options,
                        const char *caption);

/// A table under construction: NAME.csv with `header` (comma separated), and in the page.
typedef struct report_table report_table;
report_table *report_begin_table(report *r, const char *name, const char *header);
/// Adds a row: cells separated by commas, none inside a cell.
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void
report_add_row(report_table *t, const char *format, ...);
/// Writes the table. in_page: the number of rows, from the first, that the page shows; the file has all.
void report_end_table(report_table *t, size_t in_page);

/// Writes FOLDER/report.html and frees everything. *error is filled on failure (may be NULL).
ovoid_code report_finish(report *r, ovoid_error *error);

#endif
