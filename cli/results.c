// Results as a table, as JSON lines or as CSV. A table is written in blocks of many rows, so that any number of results
// takes bounded memory.
#include "results.h"

#include "base/finish.h"
#include "base/message.h"
#include "base/outputs.h"
#include "contacts.h"

#include <stdlib.h>
#include <string.h>

/// Rows of one block of a table.
#define BLOCK_ROWS 20000

int results_settle(const cli_command *command, output_settings *settings) {
    const char *path = settings->path ? settings->path : "";
    int is_csv = outputs_has_extension(path, "csv");
    int is_json = outputs_has_extension(path, "json") || outputs_has_extension(path, "jsonl");
    if (settings->json && settings->csv)
        return args_complain(command, "%s: --json and --csv exclude each other", command->name);
    if ((settings->json && is_csv) || (settings->csv && is_json))
        return args_complain(command, "%s: %s is no name for %s", command->name, path,
                             settings->json ? "JSON Lines" : "CSV");
    settings->csv |= is_csv;
    settings->json |= is_json;
    if (settings->proofs && !settings->csv)
        return args_complain(command, "%s: --proofs goes with CSV; JSON Lines always have the proofs, a table has none",
                             command->name);
    return -1;
}

int results_settle_part(const cli_command *command, output_settings *settings, shard_part part) {
    int code = results_settle(command, settings);
    const char *path = settings->path;
    if (code >= 0 || !part.count) return code;
    if (!path || strcmp(path, "-") == 0)
        return args_complain(command, "%s: --shard writes a file: --output, for example %u.%s", command->name,
                             part.index, settings->csv ? "csv" : "jsonl");
    if (!settings->csv && !settings->json)
        return args_complain(command, "%s: --shard needs --csv or --json: a table is laid out by all of its rows",
                             command->name);
    return -1;
}

int results_open(cli_results *results, const output_settings *settings, unsigned fields, const char *unit) {
    *results = (cli_results){.settings = settings, .unit = unit, .fields = fields, .header_due = settings->csv};
    if (settings->proofs) results->fields |= OVOID_RECORD_PROOF;
    results->output = finish_open(settings->path ? settings->path : "-");
    if (!results->output) return EXIT_INPUT;
    results->file = ovoid_output_get_file(results->output);
    return 0;
}

int results_open_shard(cli_results *results, const output_settings *settings, unsigned fields, shard_job *job) {
    *results = (cli_results){.settings = settings, .fields = fields};
    if (settings->proofs) results->fields |= OVOID_RECORD_PROOF;
    job->path = settings->path;
    job->is_json = settings->json;
    shard_writer *shard = malloc(sizeof *shard);
    if (!shard) return message_error("out of memory"), EXIT_INPUT;
    int code = shard_writer_open(shard, job);
    if (code) return free(shard), code;
    results->shard = shard;
    results->file = shard->file;
    results->header_due = settings->csv && !shard->progress.bytes;
    return 0;
}

uint64_t results_get_done(const cli_results *results) {
    if (!results->shard) return 0;
    return results->shard->progress.is_done ? UINT64_MAX : results->shard->kept;
}

int results_are_lines(const cli_results *results) { return results->settings->json || results->settings->csv; }

int results_have_proofs(const cli_results *results) { return results->settings->json || results->settings->proofs; }

/// Writes the rows of the block.
static void write_rows(cli_results *results) {
    ovoid_records_write_table(results->file, results->rows, results->row_count, results->unit);
    while (results->row_count) contacts_clear(&results->rows[--results->row_count]);
}

static void write_header(cli_results *results) {
    if (results->header_due) ovoid_record_write_csv_header(results->file, results->fields);
    results->header_due = 0;
}

/// What was written are whole lines. 0, or EXIT_INPUT, of a shard after a message.
static int end_lines(const cli_results *results) {
    if (!ferror(results->file)) return 0;
    return results->shard ? shard_writer_complain(results->shard) : EXIT_INPUT;
}

int results_write_line(FILE *file, const output_settings *settings, const ovoid_record *record) {
    ovoid_code code = settings->csv ? ovoid_record_write_csv(file, record) : ovoid_record_write_json(file, record);
    return code != OVOID_ERROR_LIMIT;
}

void results_report_long(const char *a, const char *b) {
    message_error("%.60s, %.60s: the proof has more than %zu items, the most that a line of JSON holds; use --csv", a,
                  b, OVOID_RECORD_ITEMS_MAX);
}

int results_add(cli_results *results, const ovoid_record *record) {
    if (results_are_lines(results)) {
        write_header(results);
        if (!results_write_line(results->file, results->settings, record)) {
            results_report_long(record->a ? record->a : "a pair", record->b ? record->b : "");
            return EXIT_INPUT;
        }
        return end_lines(results);
    }
    if (!results->rows) results->rows = malloc(BLOCK_ROWS * sizeof *results->rows);
    if (!results->rows) {
        message_error("out of memory");
        return EXIT_INPUT;
    }
    ovoid_record *row = &results->rows[results->row_count++];
    *row = *record;
    row->cover = NULL; // a table does not show the cover, which may be gone when the block is written
    if (!contacts_copy(row)) return message_error("out of memory"), EXIT_INPUT;
    if (results->row_count == BLOCK_ROWS) write_rows(results);
    return ferror(results->file) ? EXIT_INPUT : 0;
}

int results_add_text(cli_results *results, const char *text, size_t size) {
    write_header(results);
    (void)fwrite(text, 1, size, results->file);
    return end_lines(results);
}

void results_count(cli_results *results, exit_code side) {
    if (results->shard) shard_writer_count(results->shard, side);
}

int results_end_units(cli_results *results, uint64_t units) {
    return results->shard ? shard_writer_end_units(results->shard, units) : 0;
}

int results_close(cli_results *results, int code) {
    if (results->shard) {
        if (code != EXIT_INPUT) write_header(results);
        code = shard_writer_close(results->shard, code);
        free(results->shard);
        results->shard = NULL;
        return code;
    }
    int dropped = code == EXIT_INPUT && !ferror(results->file);
    // Results before a bad line of input are still true: on a stream, where they cannot be taken back, they are
    // completed.
    if (!(dropped && results->settings->path)) {
        write_header(results);
        if (results->row_count) write_rows(results);
        int failed = finish_output(results->output);
        if (failed) code = failed;
    }
    ovoid_output_close(results->output);
    finish_set_unfinished(NULL);
    while (results->row_count) contacts_clear(&results->rows[--results->row_count]);
    free(results->rows);
    return code;
}

exit_code results_judge(const ovoid_answer *answer, double margin) {
    if (answer->status == OVOID_TOUCHING || answer->status == OVOID_OVERLAPPING) return EXIT_TOUCH;
    int within = margin >= 0 ? ovoid_answer_is_within(answer, margin) : answer->status == OVOID_UNDECIDED ? -1 : 0;
    if (within >= 0) return within ? EXIT_TOUCH : EXIT_APART;
    // A bracket that straddles the margin at full precision counts as at the margin, as touching does at zero.
    int is_at = answer->status != OVOID_UNDECIDED && answer->limit == OVOID_LIMIT_NONE;
    return is_at ? EXIT_TOUCH : EXIT_NOT_PROVEN;
}

exit_code results_worse(exit_code a, exit_code b) {
    if (a == EXIT_NOT_PROVEN || b == EXIT_NOT_PROVEN) return EXIT_NOT_PROVEN;
    return a == EXIT_TOUCH || b == EXIT_TOUCH ? EXIT_TOUCH : EXIT_APART;
}
