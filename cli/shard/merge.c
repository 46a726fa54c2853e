// ovoid merge: the shards of a command's work become what one run would have written. Their lines come in the order of
// their keys, by a heap of the shards, in memory that does not grow with their length.
#include "base/message.h"
#include "base/outputs.h"
#include "commands.h"
#include "results.h"
#include "shard/mark.h"
#include "shard/order.h"
#include "tools/heap.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

typedef struct settings {
    const char *path;
} settings;

static const cli_option options[] = {
    {"output", 'o', OPTION_OUTPUT, offsetof(settings, path), "FILE", "jsonl|json|csv|txt",
     "write to FILE, which appears whole or not at all (default: standard output)"},
    {0},
};

/// The line of a shard that waits.
typedef struct item {
    shard_key key;
    size_t reader;
} item;

typedef struct merge {
    shard_reader *readers;
    size_t count; ///< of readers that are open
    shard_lines lines;
    shard_object *bodies; ///< of the lines
    item *heap;           ///< of each shard that has a line, the lowest key first
    size_t waiting;       ///< of the heap
    cli_results results;
} merge;

/// Refuses an output that would overwrite the mark of a shard. -1 to go on, or EXIT_USAGE after a message.
static int check_marks(const cli_command *command, const cli_operands *shards, const char *path) {
    for (int i = 0; i < shards->count && path; i++) {
        char *mark = shard_get_mark_path(shards->items[i]);
        if (!mark) return message_error("out of memory"), EXIT_INPUT;
        int is_mark = outputs_is_same_file(path, mark);
        free(mark);
        if (is_mark)
            return args_complain(command,
                                 "%s: --output %s would overwrite the mark of its own input %s; choose another name",
                                 command->name, path, shards->items[i]);
    }
    return -1;
}

/* ---- the shards */

/// As many files may be open as the system allows.
static void raise_limit(void) {
    struct rlimit limit;
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
    limit.rlim_cur = limit.rlim_max;
    (void)setrlimit(RLIMIT_NOFILE, &limit);
}

static int open_shards(merge *m, const cli_operands *paths) {
    for (int i = 0; i < paths->count; i++) {
        int code = shard_reader_open(&m->readers[i], paths->items[i]);
        if (code) return code;
        m->count++;
        // The names of the objects are those of all shards: they are kept once.
        shard_header *h = &m->readers[i].header;
        if (i)
            shard_objects_free(h->objects, h->object_count);
        else
            m->bodies = h->objects, m->lines.body_count = h->object_count;
        h->objects = NULL;
        h->object_count = 0;
    }
    m->lines.bodies = m->bodies;
    m->lines.order = shard_get_order(m->readers[0].header.fields[SHARD_COMMAND]);
    if (m->bodies) qsort(m->bodies, m->lines.body_count, sizeof *m->bodies, shard_object_compare);
    return 0;
}

static int compare_parts(const void *a, const void *b) {
    const shard_reader *p = a, *q = b;
    if (p->header.part.index != q->header.part.index) return p->header.part.index < q->header.part.index ? -1 : 1;
    return strcmp(p->path, q->path);
}

/// Shards of one run, each once. 0, or EXIT_INPUT after a message. They are sorted by their parts.
static int check_shards(merge *m) {
    const shard_reader *first = &m->readers[0];
    for (size_t i = 1; i < m->count; i++) {
        const shard_reader *r = &m->readers[i];
        if (shard_header_differs(r->path, &r->header, first->path, &first->header)) return EXIT_INPUT;
        if (r->header.part.count == first->header.part.count) continue;
        message_error("%s: is part %s, and %s part %s: they are not of one run", r->path, r->header.fields[SHARD_PART],
                      first->path, first->header.fields[SHARD_PART]);
        return EXIT_INPUT;
    }
    qsort(m->readers, m->count, sizeof *m->readers, compare_parts);
    for (size_t i = 1; i < m->count; i++) {
        if (m->readers[i].header.part.index != m->readers[i - 1].header.part.index) continue;
        message_error("%s and %s are both part %s", m->readers[i - 1].path, m->readers[i].path,
                      m->readers[i].header.fields[SHARD_PART]);
        return EXIT_INPUT;
    }
    return 0;
}

/// Most missing parts that are named.
#define NAMED_MAX 8

/// Names the parts that are not there. 0 where none is missing.
static int check_missing(const merge *m) {
    unsigned count = m->readers[0].header.part.count, missing = 0;
    char list[NAMED_MAX * 24] = "";
    size_t next = 0;
    for (unsigned i = 1; i <= count; i++) {
        if (next < m->count && m->readers[next].header.part.index == i) {
            next++;
            continue;
        }
        size_t length = strlen(list);
        if (missing++ < NAMED_MAX)
            snprintf(list + length, sizeof list - length, "%s%u/%u", missing > 1 ? ", " : "", i, count);
    }
    if (!missing) return 0;
    message_error("%s missing: part%s %s%s", missing > 1 ? "shards are" : "a shard is", missing > 1 ? "s" : "", list,
                  missing > NAMED_MAX ? ", ..." : "");
    return EXIT_INPUT;
}

static int is_csv(const merge *m) { return strcmp(m->readers[0].header.fields[SHARD_FORMAT], "csv") == 0; }

/// Refuses a name that says another format than the shards have. 0, or EXIT_USAGE after a message.
static int check_name(const cli_command *command, const merge *m, const char *path) {
    int names_json = path && (outputs_has_extension(path, "json") || outputs_has_extension(path, "jsonl"));
    int names_csv = path && outputs_has_extension(path, "csv");
    if (is_csv(m) ? !names_json : !names_csv) return 0;
    return args_complain(command, "%s: %s is no name for %s, which the shards have", command->name, path,
                         is_csv(m) ? "CSV" : "JSON Lines");
}

/* ---- the lines */

static int is_before(const void *a, const void *b) {
    const item *p = a, *q = b;
    int order = shard_key_compare(&p->key, &q->key);
    return order ? order < 0 : p->reader < q->reader;
}

/// Reads the next line of a shard, with its key. 1; 0 where there is none; -1 after a message.
static int read_item(const merge *m, item *i) {
    shard_reader *r = &m->readers[i->reader];
    int got = shard_reader_next(r);
    if (got <= 0) return got;
    return shard_key_find(&i->key, &m->lines, r->line) ? 1 : (shard_reader_complain(r), -1);
}

/// Every shard's first line. 0, or EXIT_INPUT after a message.
static int fill_heap(merge *m) {
    for (size_t i = 0; i < m->count; i++) {
        item first = {.reader = i};
        int got = read_item(m, &first);
        if (got < 0) return EXIT_INPUT;
        if (got) heap_push((heap){m->heap, m->waiting++, sizeof first, is_before}, &first);
    }
    return 0;
}

/// Puts the next line of the shard at the top of the heap to its place.
static int advance(merge *m) {
    item next = m->heap[0], last;
    int got = read_item(m, &next);
    if (got > 0)
        heap_sink((heap){m->heap, m->waiting, sizeof next, is_before}, 0, &next);
    else if (!got)
        heap_pop((heap){m->heap, m->waiting--, sizeof last, is_before}, &last);
    return got < 0 ? EXIT_INPUT : 0;
}

static int write_lines(merge *m) {
    const shard_header *h = &m->readers[0].header;
    uint64_t count = 0;
    int code = fill_heap(m);
    for (; m->waiting && !code; count++) {
        const shard_reader *r = &m->readers[m->heap[0].reader];
        if (!h->most || count < h->most) code = results_add_text(&m->results, r->line, r->line_size);
        if (!code) code = advance(m);
    }
    return code;
}

/* ---- the output */

/// Writes the header of CSV, with which all shards begin, and keeps it. 0, or EXIT_INPUT after a message.
static int write_header(merge *m, char **columns) {
    int got;
    for (size_t i = 0; i < m->count; i++)
        if ((got = shard_reader_next(&m->readers[i])) <= 0)
            return got ? EXIT_INPUT : shard_reader_complain(&m->readers[i]);
    const shard_reader *first = &m->readers[0];
    m->lines.columns = *columns = strdup(first->line);
    if (!*columns) return message_error("out of memory"), EXIT_INPUT;
    return results_add_text(&m->results, first->line, first->line_size);
}

/// Adds the answers of all shards.
static shard_progress add_progress(const merge *m) {
    shard_progress all = {.bytes = 0};
    for (size_t i = 0; i < m->count; i++)
        for (int k = 0; k <= EXIT_NOT_PROVEN; k++) all.sides[k] += m->readers[i].progress.sides[k];
    return all;
}

/// Writes the merged output; the exit code.
static int write_output(merge *m, const char *path) {
    const output_settings out = {.path = path, .json = 1}; // lines that have their header
    const shard_header *first = &m->readers[0].header;
    char *columns = NULL;
    if (results_open(&m->results, &out, 0, "")) return EXIT_INPUT;
    int code = is_csv(m) ? write_header(m, &columns) : 0;
    if (!code) code = write_lines(m);
    shard_progress all = add_progress(m);
    int worst = shard_progress_get_exit(&all);
    code = results_close(&m->results, code ? code : worst);
    free(columns);
    if (code != worst) return code;
    message_note("%zu shard%s of %s; apart: %" PRIu64 ", touching, overlapping or within: %" PRIu64
                 ", not proven: %" PRIu64,
                 m->count, m->count == 1 ? "" : "s", first->fields[SHARD_COMMAND], all.sides[EXIT_APART],
                 all.sides[EXIT_TOUCH], all.sides[EXIT_NOT_PROVEN]);
    return code;
}

/// Merges shards, with room for all of them. The exit code.
static int merge_shards(const cli_command *command, merge *m, const cli_operands *paths, const char *path) {
    int code = open_shards(m, paths);
    if (!code) code = check_shards(m);
    if (!code) code = check_missing(m);
    if (!code) code = check_name(command, m, path);
    for (size_t i = 0; i < m->count && !code; i++) code = shard_reader_check(&m->readers[i]);
    if (!code) code = write_output(m, path);
    for (size_t i = 0; i < m->count; i++) shard_reader_close(&m->readers[i]);
    shard_objects_free(m->bodies, m->lines.body_count);
    return code;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {NULL};
    cli_operands paths;
    int code = command_parse(command, argc, argv, &s, &paths);
    if (code < 0) code = check_marks(command, &paths, s.path);
    if (code >= 0) return code;
    raise_limit();
    const size_t count = (size_t)paths.count;
    merge m = {.readers = calloc(count + 1, sizeof *m.readers), .heap = calloc(count + 1, sizeof *m.heap)};
    code = EXIT_INPUT;
    if (m.readers && m.heap)
        code = merge_shards(command, &m, &paths, s.path);
    else
        message_error("out of memory");
    free(m.readers);
    free(m.heap);
    return code;
}

const cli_command command_merge = {
    .name = "merge",
    .summary = "the shards of a command's work, as one run would have written it",
    .usage = "[OPTION...] SHARD...",
    .description =
        "batch, check, run and robot check with --shard I/N do part I of N of their work and write a shard: its "
        "results, a file as any other, and beside it FILE.mark, which says by which version, command, options and "
        "inputs they were made, and that they are finished. From all N shards, in any order, merge makes the same "
        "bytes that one run without --shard writes, with its exit code.\n\n"
        "Merge refuses, by name, a shard that is missing, there twice, of another run, not finished or damaged. A run "
        "that was interrupted goes on with the same command.",
    .exits = "0 everything is apart (with --margin: farther than M)\n"
             "1 something touches, overlaps, is within M, or hits\n"
             "2 the command line is wrong\n"
             "3 a shard is missing, there twice, of another run, not finished or damaged\n"
             "  (or output could not be written)\n"
             "4 for something that is not proven; this comes before 1",
    .examples = "for i in 1 2 3 4; do\n"
                "    ovoid check cell.json --shard $i/4 -o $i.jsonl &\n"
                "done; wait; ovoid merge ?.jsonl -o results.jsonl",
    .options = options,
    .operands_min = 1,
    .operands_max = -1,
    .run = run,
};
