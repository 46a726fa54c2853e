// The output of results: standard output or a file that appears whole or not at all; a table, JSON lines or CSV.
#ifndef OVOID_CLI_RESULTS_H
#define OVOID_CLI_RESULTS_H

#include "base/args.h"
#include "shard/write.h"

#include <ovoid/io.h>

/// Options of every command that writes results.
typedef struct output_settings {
    int json, csv;
    int proofs;       ///< CSV with a column of proofs
    const char *path; ///< NULL: standard output
} output_settings;

/// The rows of these options in a table; `out` is the member of the settings that holds them.
#define RESULTS_OPTIONS(settings)                                                                                      \
    {"json", 0, OPTION_FLAG, offsetof(settings, out.json), NULL, NULL, "write JSON Lines, one object a line"},         \
        {"csv", 0, OPTION_FLAG, offsetof(settings, out.csv), NULL, NULL, "write CSV with a header line"},              \
        {"proofs",                                                                                                     \
         0,                                                                                                            \
         OPTION_FLAG,                                                                                                  \
         offsetof(settings, out.proofs),                                                                               \
         NULL,                                                                                                         \
         NULL,                                                                                                         \
         "with CSV: a last column with the proofs, which JSON Lines always have"},                                     \
    {                                                                                                                  \
        "output", 'o', OPTION_OUTPUT, offsetof(settings, out.path), "FILE", "jsonl|json|csv|txt",                      \
            "write to FILE, which appears whole or not at all; .jsonl and .csv choose the format (default: standard "  \
            "output)"                                                                                                  \
    }

/// Sets the format by the file's extension where no option does; refuses two formats at once. -1 to go on, or
/// EXIT_USAGE.
int results_settle(const cli_command *command, output_settings *settings);

/// The same for a command whose work can be cut: a shard needs a file, and a format.
int results_settle_part(const cli_command *command, output_settings *settings, shard_part part);

/// An open stream of results.
typedef struct cli_results {
    ovoid_output *output;
    FILE *file;
    const output_settings *settings;
    const char *unit;
    unsigned fields;    ///< of all records, ovoid_record_field bits
    ovoid_record *rows; ///< of the table, until there are enough to be written
    size_t row_count;
    int header_due;      ///< the CSV header is not written yet
    shard_writer *shard; ///< which writes `file`; NULL: the results are no shard
} cli_results;

/// Opens a stream of results whose records have these fields; unit: of the table's lengths, "" for none. 0, or
/// EXIT_INPUT after a message.
int results_open(cli_results *results, const output_settings *settings, unsigned fields, const char *unit);

/// The same for a shard: the job, whose path and format are set here, must live as long. Where the shard is whole
/// already nothing is left to do.
int results_open_shard(cli_results *results, const output_settings *settings, unsigned fields, shard_job *job);

/// What of a shard an earlier run has done: units of work, all of them or UINT64_MAX where it is whole; 0 without one.
uint64_t results_get_done(const cli_results *results);

/// Writes one answer: a line of JSON or CSV at once, a row of the table later. Names must live until the end. Failures
/// of the stream are found by results_close.
int results_add(cli_results *results, const ovoid_record *record);

/// 1 if each answer becomes a line of text by itself (not a table).
int results_are_lines(const cli_results *results);

/// 1 if proofs are written.
int results_have_proofs(const cli_results *results);

/// Writes text made of such lines.
int results_add_text(cli_results *results, const char *text, size_t size);

/// Counts an answer of a shard, and ends units of its work; nothing without one. 0, or EXIT_INPUT after a message.
void results_count(cli_results *results, exit_code side);
int results_end_units(cli_results *results, uint64_t units);

/// Ends the stream: writes the rest and moves the file to its path. code: the exit code so far; with EXIT_INPUT a file
/// is dropped. Returns the exit code.
int results_close(cli_results *results, int code);

/// Writes one answer to a stream in the format of the settings (not a table). 0, and nothing is written, where its
/// proof is too long for a line, which results_report_long says.
int results_write_line(FILE *file, const output_settings *settings, const ovoid_record *record);

void results_report_long(const char *a, const char *b);

/// The exit code for an answer to what was asked: the side of the margin, or, where it is negative and there is none,
/// the sign.
exit_code results_judge(const ovoid_answer *answer, double margin);

/// The more serious of two exit codes: 4 before 1 before 0.
exit_code results_worse(exit_code a, exit_code b);

#endif
