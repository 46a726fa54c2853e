// ovoid batch: many pairs of a list of shapes, on several threads; results in the order of the pairs.
#include "commands.h"

#include "base/covers.h"
#include "base/inputs.h"
#include "base/message.h"
#include "base/outputs.h"
#include "base/pipeline.h"
#include "base/progress.h"
#include "pairs/answers.h"
#include "results.h"

#include <ovoid/ovoid.h>

#include <stdlib.h>
#include <string.h>

/// The pairs of a chunk: the same number for any number of threads, so that the output is the same too.
#define CHUNK 128

typedef struct settings {
    read_settings read;
    output_settings out;
    const char *list, *pairs;
    int query;
    unsigned threads; ///< 0: as many as there are processors
    double margin, tolerance;
    shard_part part;
} settings;

static const cli_option options[] = {
    {"shapes", 0, OPTION_FILE, offsetof(settings, list), "LIST", NULL,
     "text file with one mesh or .ovoid path a line, relative to the list's folder (required)"},
    {"pairs", 0, OPTION_FILE, offsetof(settings, pairs), "PAIRS.csv", NULL,
     "the pairs, \"-\" for standard input (required)"},
    {"query", 0, OPTION_CHOICE, offsetof(settings, query), "QUERY", QUERY_CHOICES,
     "collide: do they touch? within: are they within --margin? distance: the signed distance, minus the depth where "
     "they overlap (default)"},
    {"margin", 0, OPTION_LENGTH, offsetof(settings, margin), "M", NULL,
     "the margin of within; for distance, exit code 1 if a pair is within M"},
    {"tol", 0, OPTION_LENGTH, offsetof(settings, tolerance), "T", NULL,
     "stop when the bracket is at most T wide, or 1e-9 of the pair's size (default: the latter alone)"},
    {"hull", 0, OPTION_FLAG, offsetof(settings, read.hull), NULL, NULL,
     "each mesh is its convex hull (default: one that is not convex, or not closed, is refused)"},
    THREADS_OPTION(settings),
    SHARD_OPTION(settings),
    INPUTS_OPTIONS(settings),
    RESULTS_OPTIONS(settings),
    {0},
};

/// A chunk: pairs in, lines of text or records out.
typedef struct chunk {
    size_t count;
    ovoid_indexed_pair pairs[CHUNK];
    ovoid_answer answers[CHUNK];
    ovoid_cover cover; ///< reused for one answer after another, of distance queries
    int wants_covers;
    char *text; ///< the lines of its records
    size_t size;
    int failed; ///< no memory
} chunk;

/// The state of a run.
typedef struct batch {
    const settings *settings;
    const ovoid_shapes *shapes;
    ovoid_pairs_reader *reader;
    cli_results results;
    size_t done;
    size_t counts[4];                  ///< by ovoid_status
    size_t sides[EXIT_NOT_PROVEN + 1]; ///< of the margin, by exit_code
    exit_code worst;
    int refused; ///< a line of the pairs is wrong: `error` has the message
    ovoid_error error;
} batch;

static int fill(void *context, void *slot) {
    batch *b = context;
    chunk *c = slot;
    c->count = 0;
    while (!b->refused && c->count < CHUNK) {
        int got = ovoid_pairs_reader_read(b->reader, &c->pairs[c->count], &b->error);
        if (got < 0) b->refused = 1;
        if (got <= 0) break;
        c->count++;
    }
    return c->count > 0;
}

/// The distance or depth. The cover has memory where it is wanted, or once a search has filled its own. 0 where memory
/// is out.
static int find_distance(const ovoid_pair *pair, const ovoid_options *query, chunk *c, ovoid_answer *answer) {
    if (c->wants_covers && !cover_take_memory(&c->cover)) return 0;
    *answer = ovoid_depth(pair, query, NULL, c->wants_covers ? &c->cover : NULL);
    if (answer->limit != OVOID_LIMIT_CAPACITY || c->wants_covers) return 1;
    if (!cover_take_memory(&c->cover)) return 0;
    *answer = ovoid_depth(pair, query, NULL, &c->cover);
    return 1;
}

static int find_answer(const settings *s, const ovoid_pair *pair, chunk *c, ovoid_answer *answer) {
    ovoid_options query = {.absolute_tolerance = s->tolerance};
    if (s->query == QUERY_COLLIDE) {
        *answer = ovoid_collide(pair, &query, NULL);
    } else if (s->query == QUERY_WITHIN) {
        *answer = ovoid_within(pair, s->margin, &query, NULL);
    } else {
        const ovoid_body_pair bodies = {{.shape = pair->shape_a, .pose = pair->pose_a},
                                        {.shape = pair->shape_b, .pose = pair->pose_b}};
        if (!find_distance(pair, &query, c, answer)) return 0;
        answers_settle_limit(answer, &bodies, s->margin, s->tolerance);
    }
    return 1;
}

static ovoid_record make_record(const batch *b, const ovoid_indexed_pair *pair, const ovoid_answer *answer,
                                const ovoid_cover *cover) {
    return (ovoid_record){.index_a = pair->a,
                          .index_b = pair->b,
                          .answer = *answer,
                          .cover = cover,
                          .fields = b->results.fields,
                          .margin = b->settings->margin,
                          .mesh_a = ovoid_shapes_get(b->shapes, pair->a).convexity,
                          .mesh_b = ovoid_shapes_get(b->shapes, pair->b).convexity};
}

static void work(void *context, void *slot) {
    const batch *b = context;
    chunk *c = slot;
    int lines = results_are_lines(&b->results);
    c->wants_covers = b->settings->query == QUERY_DISTANCE && results_have_proofs(&b->results);
    FILE *file = lines ? open_memstream(&c->text, &c->size) : NULL;
    c->failed = lines && !file;
    for (size_t i = 0; i < c->count && !c->failed; i++) {
        const ovoid_indexed_pair *p = &c->pairs[i];
        ovoid_pair pair = {ovoid_shapes_get(b->shapes, p->a).shape, ovoid_shapes_get(b->shapes, p->b).shape, p->pose_a,
                           p->pose_b};
        c->failed = !find_answer(b->settings, &pair, c, &c->answers[i]);
        ovoid_record record = make_record(b, p, &c->answers[i], c->wants_covers ? &c->cover : NULL);
        if (lines && !c->failed) (void)results_write_line(file, &b->settings->out, &record); // shapes have short proofs
    }
    if (file && fclose(file) != 0) c->failed = 1;
}

/// Writes a chunk's results and counts them.
static int drain(void *context, void *slot) {
    batch *b = context;
    chunk *c = slot;
    int lines = results_are_lines(&b->results), code = 0;
    if (c->failed) {
        message_error("out of memory");
        return EXIT_INPUT;
    }
    if (lines) code = results_add_text(&b->results, c->text, c->size);
    for (size_t i = 0; i < c->count && !code; i++) {
        ovoid_record record = make_record(b, &c->pairs[i], &c->answers[i], NULL);
        if (!lines) code = results_add(&b->results, &record);
        b->counts[c->answers[i].status]++;
        exit_code side = results_judge(&c->answers[i], b->settings->margin);
        b->sides[side]++;
        results_count(&b->results, side);
        b->worst = results_worse(b->worst, side);
    }
    free(c->text);
    c->text = NULL;
    progress_set(b->done += c->count);
    return code ? code : results_end_units(&b->results, c->count);
}

static void clear(void *slot) {
    chunk *c = slot;
    free(c->cover.memory);
    free(c->text);
}

/// The number of pairs, for the progress bar; 0 if it cannot be known or no bar is drawn.
static size_t count_pairs(const char *path) {
    char block[1 << 16];
    size_t lines = 0, size;
    FILE *file = message_is_terminal(stderr) && strcmp(path, "-") != 0 ? fopen(path, "rb") : NULL;
    if (!file) return 0;
    while ((size = fread(block, 1, sizeof block, file)) > 0)
        for (const char *at = block; (at = memchr(at, '\n', size - (size_t)(at - block))) != NULL; at++) lines++;
    fclose(file);
    return lines > 1 ? lines - 1 : 0;
}

/// Reports how many pairs there are of each kind that the query distinguishes: sides of the margin, or signs.
static void report_counts(const batch *b, double seconds) {
    const char *unit = inputs_get_unit(&b->settings->read);
    if (b->settings->margin >= 0)
        message_note("%zu pairs in %.2f s; within %g%s%s: %zu, farther: %zu, not proven: %zu", b->done, seconds,
                     b->settings->margin, unit[0] ? " " : "", unit, b->sides[EXIT_TOUCH], b->sides[EXIT_APART],
                     b->sides[EXIT_NOT_PROVEN]);
    else
        message_note("%zu pairs in %.2f s; separated: %zu, touching: %zu, overlapping: %zu, undecided: %zu", b->done,
                     seconds, b->counts[OVOID_SEPARATED], b->counts[OVOID_TOUCHING], b->counts[OVOID_OVERLAPPING],
                     b->counts[OVOID_UNDECIDED]);
}

/// 1 if a mesh of the list is not its hull, while its hull is queried.
static int has_nonconvex(const ovoid_shapes *shapes) {
    size_t i = 0, count = ovoid_shapes_get_count(shapes);
    while (i < count && ovoid_shapes_get(shapes, i).convexity.kind == OVOID_MESH_HULL) i++;
    return i < count;
}

/// Opens the output; for a shard, removes what an earlier run left unfinished. 0, or an exit code after a message.
static int open_output(batch *b, shard_job *job) {
    const settings *s = b->settings;
    unsigned fields = (s->margin >= 0 ? OVOID_RECORD_MARGIN : 0) | (has_nonconvex(b->shapes) ? OVOID_RECORD_MESHES : 0);
    if (!s->part.count) return results_open(&b->results, &s->out, fields, inputs_get_unit(&s->read));
    shard_digest_add_shapes(&job->seen, b->shapes);
    int code = results_open_shard(&b->results, &s->out, fields, job);
    if (code) return code;
    uint64_t done = results_get_done(&b->results);
    code = ovoid_pairs_reader_set_part(b->reader, s->part.index - 1, s->part.count, &b->error);
    if (!code) code = ovoid_pairs_reader_skip(b->reader, done, &b->error);
    if (!code) b->done = done;
    return code ? (message_error("%s", b->error.message), results_close(&b->results, EXIT_INPUT)) : 0;
}

/// Runs all pairs through the pipeline; returns the exit code.
static int run_pairs(batch *b, shard_job *job) {
    const settings *s = b->settings;
    cli_pipeline line = {b, sizeof(chunk), fill, work, drain, clear};
    if (open_output(b, job)) return EXIT_INPUT;
    double start = progress_get_seconds();
    progress_start("pairs", s->part.count ? 0 : count_pairs(s->pairs));
    int code = pipeline_run(&line, pipeline_get_threads(s->threads));
    progress_end();
    if (code < 0) message_error("out of memory or threads"), code = EXIT_INPUT;
    if (!code && b->refused) message_error("%s", b->error.message), code = EXIT_INPUT;
    code = results_close(&b->results, code ? code : (int)b->worst);
    if (code != EXIT_INPUT && code != EXIT_PIPE && !s->part.count) report_counts(b, progress_get_seconds() - start);
    return code;
}

/// Checks the options together. -1 to continue, or EXIT_USAGE.
static int settle(const cli_command *command, settings *s) {
    if (!s->list) return args_complain(command, "batch: --shapes LIST is missing");
    if (!s->pairs) return args_complain(command, "batch: --pairs PAIRS.csv is missing");
    if (s->query == QUERY_WITHIN && s->margin < 0)
        return args_complain(command, "batch: --query within needs --margin");
    if (s->query == QUERY_COLLIDE && s->margin >= 0)
        return args_complain(command, "batch: --query collide takes no --margin; --query within does");
    return results_settle_part(command, &s->out, s->part);
}

/// Refuses meshes that are not their hulls, unless the options ask for hulls: -1 to continue, or EXIT_INPUT after a
/// message.
static int validate_meshes(const settings *s, const ovoid_shapes *shapes) {
    if (s->read.hull) return inputs_warn_list(shapes), -1;
    for (size_t i = 0; i < ovoid_shapes_get_count(shapes); i++) {
        ovoid_named_shape shape = ovoid_shapes_get(shapes, i);
        if (shape.convexity.kind == OVOID_MESH_HULL) continue;
        message_error("%s is not %s, and batch takes convex shapes: --hull takes its hull; ovoid distance and ovoid "
                      "check take the mesh itself",
                      shape.name, shape.convexity.kind == OVOID_MESH_SURFACE ? "closed" : "convex");
        return EXIT_INPUT;
    }
    return -1;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.read.unit = INPUTS_NO_UNIT, .query = QUERY_DISTANCE, .margin = -1};
    cli_operands none;
    int code = command_parse(command, argc, argv, &s, &none);
    if (code < 0) code = settle(command, &s);
    if (code >= 0) return code;
    batch b = {.settings = &s};
    ovoid_shapes *shapes = inputs_read_list(s.list, &s.read);
    if (!shapes) return EXIT_INPUT;
    if ((code = validate_meshes(&s, shapes)) >= 0) return ovoid_shapes_destroy(shapes), code;
    b.shapes = shapes;
    b.reader = ovoid_pairs_reader_open(s.pairs, ovoid_shapes_get_count(shapes), &b.error);
    shard_job job = {command, &s, &none, s.part, .seen = shard_digest_make(), .units = "pairs"};
    if (b.reader)
        code = run_pairs(&b, &job);
    else
        message_error("%s", b.error.message), code = EXIT_INPUT;
    ovoid_pairs_reader_close(b.reader);
    ovoid_shapes_destroy(shapes);
    return code;
}

const cli_command command_batch = {
    .name = "batch",
    .summary = "many pairs of a list of shapes, on several threads",
    .usage = "[OPTION...] --shapes LIST --pairs PAIRS.csv",
    .description =
        "One result for each pair of PAIRS.csv, in the file's order. Its first line must be\n\n"
        "    a,b,ax,ay,az,aqw,aqx,aqy,aqz,bx,by,bz,bqw,bqx,bqy,bqz\n\n"
        "a and b are shapes of LIST, counted from 0 without empty lines and comments; the position and the quaternion "
        "of each body follow. Shapes are convex: a mesh that is not its hull is refused, unless --hull asks for "
        "that.\n\n"
        "Pairs are read, answered and written as they come, in bounded memory. A bad line (an index that LIST does not "
        "have, NaN, a zero quaternion) ends the run with code 3 and the line's number: what stands on standard output "
        "by then are the results of all pairs before it; a file asked for with --output is not made.",
    .exits = "0 every pair is apart (with --margin: farther than M)\n"
             "1 a pair touches or overlaps (or is within M)\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written\n"
             "4 for some pair the sign (with --margin: the side of M) is not proven; this comes before 1",
    .examples = "ovoid batch --shapes hulls.txt --pairs pairs.csv --csv -o results.csv\n"
                "ovoid batch --shapes hulls.txt --pairs pairs.csv --json |\n"
                "    ovoid verify - --shapes hulls.txt --pairs pairs.csv",
    .options = options,
    .run = run,
};
