// ovoid verify: are the proofs of a results file true? Each bound is computed again from its proof alone, on the given
// bodies, without any search: in exact rational arithmetic where the judge was built in, else in floating point with
// rigorous error bounds.
#include "commands.h"

#include "finish.h"
#include "inputs.h"
#include "message.h"
#include "pipeline.h"
#include "progress.h"
#include "verdict.h"

#include <ovoid/ovoid.h>

#include <stdlib.h>
#include <string.h>

/// Results of one piece of work.
#define CHUNK 32

/// Failures that are told one by one.
#define TOLD_MAX 10

enum query { QUERY_NONE = -1, QUERY_COLLIDE, QUERY_WITHIN, QUERY_DISTANCE, QUERY_DEPTH };

typedef struct settings {
    read_settings read;
    const char *list, *pairs;
    int query;
    unsigned threads;
    ovoid_pose pose_a, pose_b;
} settings;

static const cli_option options[] = {
    {"shapes", 0, OPTION_FILE, offsetof(settings, list), "LIST", NULL, "the shapes of ovoid batch"},
    {"pairs", 0, OPTION_FILE, offsetof(settings, pairs), "PAIRS.csv", NULL, "the pairs of ovoid batch"},
    {"query", 0, OPTION_CHOICE, offsetof(settings, query), "QUERY", "collide|within|distance|depth",
     "the query of ovoid batch; for distance and depth, it is also checked that the witness points differ by the "
     "distance along the normal (default: within; of a scene or of A and B: depth)"},
    {"pose-a", 0, OPTION_POSE, offsetof(settings, pose_a), "\"X Y Z QW QX QY QZ\"", NULL,
     "pose of A, as given to ovoid distance"},
    {"pose-b", 0, OPTION_POSE, offsetof(settings, pose_b), "\"X Y Z QW QX QY QZ\"", NULL, "pose of B"},
    {"threads", 0, OPTION_COUNT, offsetof(settings, threads), "N", NULL,
     "work on N threads (default: one for each processor)"},
    INPUTS_OPTIONS(settings),
    {0},
};

/// Where the bodies of a result come from: one of a scene, a list with pairs, or two shapes.
typedef struct body_source {
    ovoid_scene *scene;
    ovoid_shapes *list;
    ovoid_pairs_reader *pairs;
    ovoid_shape *shapes[2];
    const char *paths[2];
    ovoid_pair pair; ///< of the two shapes
} body_source;

/// One result, with what became of it.
typedef struct claim {
    int64_t line;
    ovoid_pair pair;
    ovoid_answer answer;
    ovoid_cover *cover; ///< NULL where there is none
    int holds;
    char message[256]; ///< where it does not
} claim;

typedef struct chunk {
    size_t count;
    claim items[CHUNK];
} chunk;

/// What the whole run shares.
typedef struct verify {
    const settings *settings;
    body_source bodies;
    const char *path;
    ovoid_results_reader *reader;
    verdict *verdict;
    size_t proofs, held, undecided;
    int refused; ///< *error says why
    ovoid_error error;
} verify;

/* ---- which bodies ---- */

static int refuse(verify *v, const char *message) {
    v->refused = 1;
    snprintf(v->error.message, sizeof v->error.message, "%s:%lld: %s", v->path,
             (long long)ovoid_results_reader_get_line(v->reader), message);
    return 0;
}

static void disprove(claim *item, const char *message) { snprintf(item->message, sizeof item->message, "%s", message); }

/// The objects of the scene that the result names.
static void find_in_scene(const body_source *bodies, const ovoid_record *record, claim *item) {
    size_t none = (size_t)-1;
    size_t a = record->a ? ovoid_scene_find(bodies->scene, record->a) : none;
    size_t b = record->b ? ovoid_scene_find(bodies->scene, record->b) : none;
    if (a == none || b == none) {
        disprove(item, "the scene has no object of that name");
        return;
    }
    ovoid_scene_object object_a = ovoid_scene_get(bodies->scene, a), object_b = ovoid_scene_get(bodies->scene, b);
    item->pair = (ovoid_pair){object_a.shape, object_b.shape, object_a.pose, object_b.pose};
}

/// The next pair of the pairs file, which must be the one that the result names. 0 where there is none.
static int find_in_list(verify *v, const ovoid_record *record, claim *item) {
    const body_source *bodies = &v->bodies;
    ovoid_indexed_pair pair;
    int got = ovoid_pairs_reader_read(bodies->pairs, &pair, &v->error);
    if (got < 0) return v->refused = 1, 0;
    if (got == 0) return refuse(v, "there are more results than pairs");
    item->pair = (ovoid_pair){ovoid_shapes_get(bodies->list, pair.a).shape,
                              ovoid_shapes_get(bodies->list, pair.b).shape, pair.pose_a, pair.pose_b};
    if (record->a || record->b || record->index_a != pair.a || record->index_b != pair.b)
        disprove(item, "a and b are not those of the pair with the same place in the pairs");
    return 1;
}

static void find_given(const body_source *bodies, const ovoid_record *record, claim *item) {
    item->pair = bodies->pair;
    if (!record->a || !record->b || strcmp(record->a, bodies->paths[0]) != 0 ||
        strcmp(record->b, bodies->paths[1]) != 0)
        disprove(item, "a and b are not the two bodies given");
}

/* ---- the run ---- */

/// Keeps a copy of the record's cover. 0 where memory is out.
static int copy_cover(const ovoid_record *record, claim *item) {
    item->cover = NULL;
    if (!record->cover || record->cover->point_count == 0) return 1;
    item->cover = malloc(sizeof *item->cover);
    if (item->cover) *item->cover = *record->cover;
    return item->cover != NULL;
}

/// The next result with its bodies. 0: the end, or refused.
static int read_item(verify *v, claim *item) {
    ovoid_record record;
    int got = ovoid_results_reader_read(v->reader, &record, &v->error);
    if (got < 0) v->refused = 1;
    if (got <= 0) return 0;
    item->line = ovoid_results_reader_get_line(v->reader);
    item->message[0] = 0;
    item->answer = record.answer;
    if (v->bodies.scene)
        find_in_scene(&v->bodies, &record, item);
    else if (!v->bodies.list)
        find_given(&v->bodies, &record, item);
    else if (!find_in_list(v, &record, item))
        return 0;
    return copy_cover(&record, item) || refuse(v, "out of memory");
}

static int fill(void *context, void *slot) {
    verify *v = context;
    chunk *c = slot;
    c->count = 0;
    while (!v->refused && c->count < CHUNK && read_item(v, &c->items[c->count])) c->count++;
    return c->count > 0;
}

/// Answers to distance, where the bodies are apart, and to depth promise that point_b - point_a is d times the normal;
/// not where a limit ended the search of a depth and the proof is a common point.
static int has_nearest_points(int query, const ovoid_answer *answer) {
    if (answer->proof.kind == OVOID_PROOF_HULL || answer->proof.kind == OVOID_PROOF_INNER) return 0;
    return query == QUERY_DEPTH || (query == QUERY_DISTANCE && answer->status != OVOID_OVERLAPPING);
}

static void work(void *context, void *slot) {
    const verify *v = context;
    chunk *c = slot;
    for (claim *i = c->items; i < c->items + c->count; i++) {
        ovoid_error error = {.message = ""};
        int points = has_nearest_points(v->settings->query, &i->answer);
        if (!i->message[0] && verdict_check(v->verdict, &i->pair, &i->answer, i->cover, points, &error) != OVOID_OK)
            disprove(i, error.message[0] ? error.message : "the proof does not hold");
        i->holds = !i->message[0];
        free(i->cover);
        i->cover = NULL;
    }
}

static int drain(void *context, void *slot) {
    verify *v = context;
    const chunk *c = slot;
    for (const claim *i = c->items; i < c->items + c->count; i++) {
        size_t failures = v->proofs++ - v->held;
        v->held += (size_t)i->holds;
        v->undecided += i->answer.status == OVOID_UNDECIDED;
        if (!i->holds && failures < TOLD_MAX) message_error("%s:%lld: %s", v->path, (long long)i->line, i->message);
    }
    progress_set(v->proofs);
    return 0;
}

static void clear(void *slot) { (void)slot; }

/// Are there pairs that no result speaks of? The results of a batch, and of one pair, are complete or cut off.
static void look_for_rest(verify *v) {
    ovoid_indexed_pair pair;
    size_t rest = 0;
    int got = 1;
    if (v->refused || v->bodies.scene) return;
    if (!v->bodies.pairs) {
        v->refused = v->proofs == 0;
        if (v->refused) snprintf(v->error.message, sizeof v->error.message, "%s: there is no result", v->path);
        return;
    }
    while ((got = ovoid_pairs_reader_read(v->bodies.pairs, &pair, &v->error)) > 0) rest++;
    v->refused = got < 0 || rest > 0;
    if (got == 0 && rest) {
        snprintf(v->error.message, sizeof v->error.message, "%s: %zu pairs have no result: it was cut off", v->path,
                 rest);
    }
}

/// Checks every result; returns the exit code.
static int run_results(verify *v) {
    cli_pipeline line = {v, sizeof(chunk), fill, work, drain, clear};
    unsigned threads = v->settings->threads ? v->settings->threads : pipeline_get_processors();
    v->verdict = verdict_create(threads);
    if (!v->verdict) return message_error("out of memory"), EXIT_INPUT;
    progress_start("proofs", 0);
    int code = pipeline_run(&line, threads);
    progress_end();
    verdict_destroy(v->verdict);
    if (code) return code < 0 ? (message_error("out of memory or threads"), EXIT_INPUT) : code;
    look_for_rest(v);
    if (v->refused) return message_error("%s", v->error.message), EXIT_INPUT;
    printf("proofs: %zu, hold: %zu, do not: %zu; undecided answers: %zu; checked in %s\n", v->proofs, v->held,
           v->proofs - v->held, v->undecided, verdict_get_name());
    code = finish_file(stdout);
    if (code) return code;
    return v->held == v->proofs ? EXIT_APART : EXIT_NOT_PROVEN;
}

/* ---- the inputs ---- */

/// What the operands and options must be together. -1 to go on, or EXIT_USAGE.
static int check_inputs(const cli_command *command, const settings *s, const cli_operands *paths) {
    int has_list = s->list || s->pairs;
    if (has_list && (!s->list || !s->pairs)) return args_complain(command, "verify: --shapes and --pairs go together");
    if (has_list && paths->count > 1)
        return args_complain(command, "verify: --shapes takes the place of %s", paths->items[1]);
    if (!has_list && paths->count < 2)
        return args_complain(command, "verify: on which bodies? Give SCENE.json, or A and B, or --shapes and --pairs");
    if (!has_list && paths->count == 2 && !inputs_is_scene(paths->items[1]))
        return args_complain(command, "verify: %s is no scene (.json); of two bodies, both must be given",
                             paths->items[1]);
    return -1;
}

static void close_bodies(body_source *bodies) {
    ovoid_scene_destroy(bodies->scene);
    ovoid_pairs_reader_destroy(bodies->pairs);
    ovoid_shapes_destroy(bodies->list);
    ovoid_shape_destroy(bodies->shapes[0]);
    ovoid_shape_destroy(bodies->shapes[1]);
}

/// The bodies of ovoid batch. 0, or EXIT_INPUT after a message.
static int open_list(body_source *bodies, const settings *s) {
    ovoid_error error;
    bodies->list = inputs_read_list(s->list, &s->read);
    if (!bodies->list) return EXIT_INPUT;
    bodies->pairs = ovoid_pairs_reader_create(s->pairs, ovoid_shapes_get_count(bodies->list), &error);
    if (!bodies->pairs) message_error("%s", error.message);
    return bodies->pairs ? 0 : EXIT_INPUT;
}

/// The bodies of ovoid distance. 0, or EXIT_INPUT after a message.
static int open_pair(body_source *bodies, const settings *s, const cli_operands *paths) {
    bodies->paths[0] = paths->items[1];
    bodies->paths[1] = paths->items[2];
    if (inputs_read_pair(bodies->paths, &s->read, bodies->shapes)) return EXIT_INPUT;
    bodies->pair = (ovoid_pair){bodies->shapes[0], bodies->shapes[1], s->pose_a, s->pose_b};
    return 0;
}

static int open_bodies(body_source *bodies, const settings *s, const cli_operands *paths) {
    if (s->list) return open_list(bodies, s);
    if (paths->count == 3) return open_pair(bodies, s, paths);
    bodies->scene = inputs_read_scene(paths->items[1]);
    return bodies->scene ? 0 : EXIT_INPUT;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.read.unit = INPUTS_NO_UNIT,
                  .query = QUERY_NONE,
                  .pose_a = ovoid_pose_make_identity(),
                  .pose_b = ovoid_pose_make_identity()};
    cli_operands paths;
    int code = args_parse(command, argc, argv, &s, &paths);
    if (code < 0) code = check_inputs(command, &s, &paths);
    if (code >= 0) return code;
    if (s.query == QUERY_NONE) s.query = s.list ? QUERY_WITHIN : QUERY_DEPTH;
    verify v = {.settings = &s, .path = paths.items[0]};
    code = open_bodies(&v.bodies, &s, &paths);
    if (!code) {
        v.reader = ovoid_results_reader_create(v.path, &v.error);
        if (v.reader)
            code = run_results(&v);
        else
            message_error("%s", v.error.message), code = EXIT_INPUT;
    }
    ovoid_results_reader_destroy(v.reader);
    close_bodies(&v.bodies);
    return code;
}

const cli_command command_verify = {
    .name = "verify",
    .summary = "checks the proofs of a results file",
    .usage = "[OPTION...] RESULTS.jsonl SCENE.json\n"
             "[OPTION...] RESULTS.jsonl A B\n"
             "[OPTION...] RESULTS.jsonl --shapes LIST --pairs PAIRS.csv",
    .description =
        "Checks every result of a file written with --json by check, distance or batch, on the same bodies, without "
        "the "
        "search that found it: each bound is computed again from the proof alone, in exact rational arithmetic where "
        "ovoid was built with GMP. A result holds if its proof shows lower <= d <= upper and the status, if the normal "
        "is the one that proves the lower bound, and if the witness points lie on their bodies.\n\n"
        "RESULTS.jsonl is \"-\" for standard input. The first failures are told with their lines. Of a scene, pairs "
        "that "
        "the file does not speak of are not missed (check --margin leaves far ones out); of a batch they are.",
    .exits = "0 every proof holds\n2 the command line is wrong\n3 bad input\n4 a proof does not hold",
    .examples = "ovoid check cell.json --json | ovoid verify - cell.json\n"
                "ovoid verify results.jsonl --shapes hulls.txt --pairs pairs.csv",
    .options = options,
    .operands_min = 1,
    .operands_max = 3,
    .run = run,
};
