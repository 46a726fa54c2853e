// The findings of ovoid fit about one body, and how they are written.
#ifndef OVOID_CLI_BODY_FIT_H
#define OVOID_CLI_BODY_FIT_H

#include <ovoid/io.h>
#include <ovoid/ovoid.h>

#include <stdio.h>

/// The offline steps, in the order of the report.
enum fit_step { FIT_OUTER, FIT_SHRUNK, FIT_STRETCHED, FIT_ENLARGED, FIT_INNER, FIT_STEPS };

/// The findings about a body.
typedef struct fitted {
    const char *file, *name; ///< name: "" for a whole file
    const char *output;      ///< the .ovoid file that was written, or NULL
    const char *unit;        ///< of all lengths; "" where none is named
    ovoid_report report;
    ovoid_convexity convexity; ///< of the mesh; volumes NaN for a .ovoid file
    ovoid_measures measures;
    uint32_t triangles, facets;
    int is_lean; ///< the shape that was made or read
    double radius;
    ovoid_allowance allowance;
    double measure;                    ///< volume, area (one side) or length, by rank; 0 for a point
    ovoid_fit steps[FIT_STEPS];        ///< of a flat body the phases have volume NaN
    double seconds[FIT_STEPS];         ///< of each step, run by itself
    double read_seconds, make_seconds; ///< of the file, shared by its parts; of the shape in all
} fitted;

/// Writes the report of one body for people.
void fit_write_report(FILE *file, const fitted *fitted);

/// Writes a table with one line a body; the title line first. unit: of the lengths, "" for none.
void fit_write_table_title(FILE *file, const char *unit);
void fit_write_table_row(FILE *file, const fitted *fitted);

/// Writes one line of JSON, or the same as CSV.
void fit_write_json(FILE *file, const fitted *fitted);
void fit_write_csv_title(FILE *file);
void fit_write_csv_row(FILE *file, const fitted *fitted);

#endif
