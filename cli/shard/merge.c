// ovoid merge: the shards of a command's work become what one run would have written. Their texts come in the order of
// their keys, by a heap of the shards (J. W. J. Williams, Algorithm 232: Heapsort, 1964), in memory that does not grow
// with their length.
#include "base/finish.h"
#include "base/message.h"
#include "base/outputs.h"
#include "commands.h"
#include "shard/header.h"
#include "shard/read.h"

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

typedef struct merge {
    shard_reader *readers;
    size_t count;   ///< of readers that are open
    size_t *heap;   ///< readers that have a text, the lowest key first
    size_t waiting; ///< of the heap
    uint64_t texts;
    FILE *file;
} merge;

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
    }
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

/// Refuses a name that says another format than the shards have. -1 to go on, or EXIT_USAGE.
static int check_format(const cli_command *command, const merge *m, const char *path) {
    int is_json = strcmp(m->readers[0].header.fields[SHARD_FORMAT], "json") == 0;
    int names_json = path && (outputs_has_extension(path, "json") || outputs_has_extension(path, "jsonl"));
    int names_csv = path && outputs_has_extension(path, "csv");
    if (is_json ? !names_csv : !names_json) return -1;
    return args_complain(command, "%s: %s is no name for %s, which the shards have", command->name, path,
                         is_json ? "JSON Lines" : "CSV");
}

/* ---- the heap */

static int is_before(const merge *m, size_t a, size_t b) {
    int order = shard_key_compare(&m->readers[m->heap[a]].key, &m->readers[m->heap[b]].key);
    return order ? order < 0 : m->heap[a] < m->heap[b];
}

/// Lets the item at `at` sink to its place.
static void sink(merge *m, size_t at) {
    for (;;) {
        size_t least = at;
        for (size_t child = 2 * at + 1; child <= 2 * at + 2 && child < m->waiting; child++)
            if (is_before(m, child, least)) least = child;
        if (least == at) return;
        size_t item = m->heap[at];
        m->heap[at] = m->heap[least];
        m->heap[least] = item;
        at = least;
    }
}

/// Every shard's first text. 0, or EXIT_INPUT after a message.
static int fill_heap(merge *m) {
    for (size_t i = 0; i < m->count; i++) {
        int got = shard_reader_next(&m->readers[i]);
        if (got < 0) return EXIT_INPUT;
        if (got) m->heap[m->waiting++] = i;
    }
    for (size_t i = m->waiting / 2; i-- > 0;) sink(m, i);
    return 0;
}

/// Takes the next text of the first shard of the heap.
static int advance(merge *m) {
    shard_key before = m->readers[m->heap[0]].key;
    int got = shard_reader_next(&m->readers[m->heap[0]]);
    if (got < 0) return EXIT_INPUT;
    if (!got) m->heap[0] = m->heap[--m->waiting];
    if (m->waiting) sink(m, 0);
    if (!m->waiting || shard_key_compare(&before, &m->readers[m->heap[0]].key) != 0) return 0;
    message_error("%s: has results of another part too: run all parts again", m->readers[m->heap[0]].path);
    return EXIT_INPUT;
}

/* ---- the output */

static int write_texts(merge *m) {
    const shard_header *h = &m->readers[0].header;
    if (fwrite(h->head, 1, h->head_size, m->file) != h->head_size) return EXIT_INPUT;
    int code = fill_heap(m);
    while (m->waiting && !code) {
        const shard_reader *r = &m->readers[m->heap[0]];
        int is_listed = !h->most || m->texts < h->most;
        m->texts += (uint64_t)is_listed;
        if (is_listed && fwrite(r->text, 1, r->text_size, m->file) != r->text_size) return EXIT_INPUT;
        code = advance(m);
    }
    return code;
}

static shard_tally add_tallies(const merge *m) {
    shard_tally all = {{0}};
    for (size_t i = 0; i < m->count; i++) shard_tally_add(&all, &m->readers[i].all);
    return all;
}

/// Writes the merged output; the exit code.
static int write_output(merge *m, const char *path) {
    ovoid_error error;
    finish_hold_signals();
    ovoid_output *output = ovoid_output_open(path ? path : "-", &error);
    if (output) finish_set_unfinished(ovoid_output_get_temporary(output));
    finish_release_signals();
    if (!output) return message_error("%s", error.message), EXIT_INPUT;
    m->file = ovoid_output_get_file(output);
    int code = write_texts(m);
    // A stream that failed says so as it ends; after other errors a file is not made.
    if (!code || ferror(m->file)) {
        int failed = finish_output(output);
        if (failed) code = failed;
    } else if (!path)
        (void)finish_file(m->file);
    ovoid_output_close(output);
    finish_set_unfinished(NULL);
    if (code) return code;
    shard_tally all = add_tallies(m);
    message_note("%zu shard%s of %s; apart: %" PRIu64 ", touching, overlapping or within: %" PRIu64
                 ", not proven: %" PRIu64,
                 m->count, m->count == 1 ? "" : "s", m->readers[0].header.fields[SHARD_COMMAND], all.sides[EXIT_APART],
                 all.sides[EXIT_TOUCH], all.sides[EXIT_NOT_PROVEN]);
    return shard_tally_get_exit(&all);
}

/// Merges shards, with room for all of them. The exit code.
static int merge_shards(const cli_command *command, merge *m, const cli_operands *paths, const char *path) {
    int code = open_shards(m, paths);
    if (!code) code = check_shards(m);
    if (!code) code = check_missing(m);
    if (!code) code = check_format(command, m, path);
    if (code < 0) code = write_output(m, path);
    for (size_t i = 0; i < m->count; i++) shard_reader_close(&m->readers[i]);
    return code;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {NULL};
    cli_operands paths;
    int code = command_parse(command, argc, argv, &s, &paths);
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
        "batch, check, run and robot check with --shard I/N do part I of N of their work and write a shard. From all N "
        "of them, in any order, merge makes the same bytes that one run without --shard writes, with its exit code.\n\n"
        "A shard says by which version, command, options and inputs it was made. Merge refuses, by name, a shard that "
        "is missing, there twice, of another run, not finished or damaged. A run that was interrupted goes on with the "
        "same command.",
    .exits = "0 everything is apart (with --margin: farther than M)\n"
             "1 something touches, overlaps, is within M, or hits\n"
             "2 the command line is wrong\n"
             "3 a shard is missing, there twice, of another run, not finished or damaged\n"
             "  (or output could not be written)\n"
             "4 for something that is not proven; this comes before 1",
    .examples = "for i in 1 2 3 4; do\n"
                "    ovoid check cell.json --json --shard $i/4 -o $i.shard &\n"
                "done; wait; ovoid merge ?.shard -o results.jsonl",
    .options = options,
    .operands_min = 1,
    .operands_max = -1,
    .run = run,
};
