// ovoid verify: checks the proofs of a results file. Each bound is computed again from its proof alone, on the given
// bodies, without any search: in exact rational arithmetic where the judge was built in, else in floating point with
// rigorous error bounds. The steps of impacts, whose bodies turn by angles that no rational pose has, are always
// checked in floating point; such results are counted apart.
#include "commands.h"

#include "answers.h"
#include "finish.h"
#include "frames.h"
#include "inputs.h"
#include "message.h"
#include "outputs.h"
#include "pipeline.h"
#include "progress.h"
#include "seen.h"
#include "verdict.h"
#ifdef OVOID_HAVE_ROBOT
#include "robot/path_verify.h"
#endif

#include <ovoid/ovoid.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Results of a chunk.
#define CHUNK 32

/// Most failures that are reported one by one.
#define REPORTED_MAX 10

typedef struct settings {
    read_settings read;
    const char *list, *pairs, *motion;
    int query, parts, json, allow_empty;
    unsigned threads;
    ovoid_pose pose_a, pose_b;
#ifdef OVOID_HAVE_ROBOT
    path_verify_settings paths;
#endif
} settings;

static const cli_option options[] = {
    {"shapes", 0, OPTION_FILE, offsetof(settings, list), "LIST", NULL, "the shapes of ovoid batch"},
    {"pairs", 0, OPTION_FILE, offsetof(settings, pairs), "PAIRS.csv", NULL, "the pairs of ovoid batch"},
    {"query", 0, OPTION_CHOICE, offsetof(settings, query), "QUERY", QUERY_CHOICES,
     "the query of ovoid batch or run; for distance, it is also checked that the witness points differ "
     "by the distance along the normal (default: distance; of a batch: within)"},
    {"pose-a", 0, OPTION_POSE, offsetof(settings, pose_a), ARGS_POSE, NULL, "pose of A, as given to ovoid distance"},
    {"pose-b", 0, OPTION_POSE, offsetof(settings, pose_b), ARGS_POSE, NULL, "pose of B"},
    {"parts", 0, OPTION_FLAG, offsetof(settings, parts), NULL, NULL,
     "A and B are compounds of their files' objects, as given to ovoid distance"},
    {"motion", 0, OPTION_FILE, offsetof(settings, motion), "MOTION.csv", NULL, "the motion of ovoid run"},
    {"allow-empty", 0, OPTION_FLAG, offsetof(settings, allow_empty), NULL, NULL,
     "a file without results is no error, as of a scene whose pairs are all beyond a margin"},
    {"json", 0, OPTION_FLAG, offsetof(settings, json), NULL, NULL, "write the counts as one JSON object"},
    {"threads", 0, OPTION_COUNT, offsetof(settings, threads), "N", NULL,
     "work on N threads (default: one for each processor)"},
    INPUTS_OPTIONS(settings),
#ifdef OVOID_HAVE_ROBOT
    PATH_VERIFY_OPTIONS(settings),
#endif
    {0},
};

/// The source of the bodies of a result: a scene, which may move, a list with pairs, or two bodies.
typedef struct body_source {
    ovoid_scene *scene;
    cli_frames frames; ///< of a motion; else without poses
    ovoid_shapes *list;
    ovoid_pairs_reader *pairs;
    cli_body bodies[2];
    const char *paths[2];
    ovoid_body_pair pair; ///< of the two bodies
} body_source;

/// One result, and the outcome of its check.
typedef struct claim {
    int64_t line;
    ovoid_body_pair pair;
    ovoid_moving_body moving[2]; ///< of an impact
    double duration;             ///< of an impact: of the motions
    ovoid_record record;         ///< with copies of the arrays that it points to; its names are not valid
    int holds;
    char message[256]; ///< why it does not hold; empty where it does
} claim;

typedef struct chunk {
    size_t count;
    claim items[CHUNK];
} chunk;

/// The state of a run.
typedef struct verify {
    const settings *settings;
    body_source bodies;
    const char *path;
    ovoid_results_reader *reader;
    verdict *verdict;
    size_t proofs, held, undecided;
    size_t impacts;        ///< results whose steps were checked in floating point
    cli_seen seen;         ///< the scene's pairs that have a result
    size_t pairs, missing; ///< of a scene, of all frames, and those of them without a result
    int refused;           ///< *error has the reason, if it has a message
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

/// Advances to the frame of the result: the last one that is not after it, or of an impact the one that ends its
/// interval. 0 where the motion is refused.
static int go_to_frame(verify *v, const ovoid_record *record, claim *item) {
    cli_frames *f = &v->bodies.frames;
    int is_impact = (record->fields & OVOID_RECORD_IMPACT) != 0, got = 1;
    if (!(record->fields & OVOID_RECORD_TIME)) {
        disprove(item, "it has no time, which the results of a motion have");
        return 1;
    }
    double from = is_impact ? record->frame : record->time;
    while (got > 0 && !(f->count && (is_impact ? f->time > from : f->time >= from))) {
        got = frames_next(f);
        seen_begin_frame(&v->seen);
    }
    if (got < 0) return v->refused = 1, v->error.message[0] = 0, 0;
    if (is_impact ? f->earlier != from || !(f->time > from) : f->time != from)
        disprove(item, is_impact ? "the motion has no such frame" : "the motion has no frame at this time");
    return 1;
}

/// Sets both bodies of an impact, and their motions.
static void set_impact(const verify *v, const ovoid_record *record, size_t a, size_t b, claim *item) {
    const cli_frames *f = &v->bodies.frames;
    ovoid_motion motions[2] = {frames_get_motion(f, a), frames_get_motion(f, b)};
    double at = isfinite(record->hit_after) ? record->hit_after : record->free_for;
    item->duration = f->time - f->earlier;
    item->pair.a.pose = ovoid_motion_compute_pose(&motions[0], at);
    item->pair.b.pose = ovoid_motion_compute_pose(&motions[1], at);
    if (!(at >= 0 && at <= item->duration && record->free_for >= 0) || record->time != record->frame + at)
        disprove(item, "its times are not those of an impact between two frames");
    item->moving[0] = (ovoid_moving_body){item->pair.a.shape, item->pair.a.compound, motions[0]};
    item->moving[1] = (ovoid_moving_body){item->pair.b.shape, item->pair.b.compound, motions[1]};
}

/// Finds the objects of the scene that the result names. 0 where the motion is refused.
static int find_in_scene(verify *v, const ovoid_record *record, claim *item) {
    const ovoid_scene *scene = v->bodies.scene;
    size_t none = (size_t)-1;
    size_t a = record->a ? ovoid_scene_find(scene, record->a) : none;
    size_t b = record->b ? ovoid_scene_find(scene, record->b) : none;
    if (a == none || b == none) {
        disprove(item, "the scene has no object of that name");
        return 1;
    }
    const cli_frames *f = &v->bodies.frames;
    if (v->settings->motion && !go_to_frame(v, record, item)) return 0;
    if (!v->settings->motion && record->fields & OVOID_RECORD_TIME) disprove(item, "it has a time: give the --motion");
    ovoid_pose pose_a = f->poses ? f->poses[a] : ovoid_scene_get(scene, a).pose;
    ovoid_pose pose_b = f->poses ? f->poses[b] : ovoid_scene_get(scene, b).pose;
    item->pair = (ovoid_body_pair){answers_get_body(scene, a, &pose_a), answers_get_body(scene, b, &pose_b)};
    int is_impact = (record->fields & OVOID_RECORD_IMPACT) != 0;
    if (is_impact && !item->message[0]) set_impact(v, record, a, b, item);
    if (is_impact || item->message[0] || seen_add(&v->seen, scene, a, b)) return 1;
    return refuse(v, "out of memory");
}

/// Reads the next pair of the pairs file, which must be the one that the result names. 0 where there is none.
static int find_in_list(verify *v, const ovoid_record *record, claim *item) {
    const body_source *bodies = &v->bodies;
    ovoid_indexed_pair pair;
    int got = ovoid_pairs_reader_read(bodies->pairs, &pair, &v->error);
    if (got < 0) return v->refused = 1, 0;
    if (got == 0) return refuse(v, "there are more results than pairs");
    item->pair = (ovoid_body_pair){{.shape = ovoid_shapes_get(bodies->list, pair.a).shape, .pose = pair.pose_a},
                                   {.shape = ovoid_shapes_get(bodies->list, pair.b).shape, .pose = pair.pose_b}};
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

/// A copy of `size` bytes; NULL for none, and where memory is out.
static void *copy(const void *data, size_t size) {
    void *made = size ? malloc(size) : NULL;
    if (made) memcpy(made, data, size);
    return made;
}

/// Stores the record with copies of the arrays that it points to. 0 where memory is out.
static int store_record(const ovoid_record *record, claim *item) {
    ovoid_record *stored = &item->record;
    *stored = *record;
    stored->a = stored->b = NULL;
    stored->cover = NULL;
    if (record->cover && record->cover->point_count) stored->cover = copy(record->cover, sizeof *record->cover);
    stored->exclusions = copy(record->exclusions, record->exclusion_count * sizeof *record->exclusions);
    stored->steps = copy(record->steps, record->step_count * sizeof *record->steps);
    stored->groups = copy(record->groups, record->group_count * sizeof *record->groups);
    return !stored->cover == !(record->cover && record->cover->point_count) &&
           !stored->exclusions == !record->exclusion_count && !stored->steps == !record->step_count &&
           !stored->groups == !record->group_count;
}

static void drop_record(claim *item) {
    free((void *)item->record.cover);
    free((void *)item->record.exclusions);
    free((void *)item->record.steps);
    free((void *)item->record.groups);
    item->record = (ovoid_record){.a = NULL};
}

/// Reads the next result with its bodies. 0: the end, or refused.
static int read_item(verify *v, claim *item) {
    ovoid_record record;
    int got = ovoid_results_reader_read(v->reader, &record, &v->error);
    if (got < 0) v->refused = 1;
    if (got <= 0) return 0;
    *item = (claim){.line = ovoid_results_reader_get_line(v->reader)};
    if (v->bodies.scene)
        got = find_in_scene(v, &record, item);
    else if (v->bodies.list)
        got = find_in_list(v, &record, item);
    else
        find_given(&v->bodies, &record, item);
    if (got <= 0) return 0;
    if (store_record(&record, item)) return 1;
    drop_record(item);
    return refuse(v, "out of memory");
}

static int fill(void *context, void *slot) {
    verify *v = context;
    chunk *c = slot;
    c->count = 0;
    while (!v->refused && c->count < CHUNK && read_item(v, &c->items[c->count])) c->count++;
    return c->count > 0;
}

/// 1 if point_b - point_a must be d times the normal: in answers to distance; not where a limit ended the search of a
/// depth and the proof is a common point.
static int has_nearest_points(int query, const ovoid_answer *answer) {
    if (answer->proof.kind == OVOID_PROOF_HULL || answer->proof.kind == OVOID_PROOF_INNER) return 0;
    return query == QUERY_DISTANCE;
}

/// Finds the pair of parts of a record; 0 where there is none such.
static int get_parts(const ovoid_body_pair *bodies, const ovoid_record *record, ovoid_pair *pair) {
    const ovoid_body *body[2] = {&bodies->a, &bodies->b};
    const uint32_t part[2] = {record->fields & OVOID_RECORD_PARTS ? record->part_a : OVOID_RECORD_NO_PART,
                              record->fields & OVOID_RECORD_PARTS ? record->part_b : OVOID_RECORD_NO_PART};
    ovoid_posed_shape found[2];
    for (int i = 0; i < 2; i++) {
        found[i] = (ovoid_posed_shape){body[i]->shape, body[i]->pose};
        if (!body[i]->compound != (part[i] == OVOID_RECORD_NO_PART)) return 0;
        if (!body[i]->compound) continue;
        if (part[i] >= ovoid_compound_get_part_count(body[i]->compound)) return 0;
        found[i] = ovoid_compound_get_part(body[i]->compound, part[i]);
        found[i].pose = ovoid_pose_compute_product(&body[i]->pose, &found[i].pose);
    }
    *pair = (ovoid_pair){found[0].shape, found[1].shape, found[0].pose, found[1].pose};
    return 1;
}

/// Checks the answer of compounds: that of the deciding parts, and that the exclusions hold and leave out no other pair
/// of parts.
static ovoid_code check_compound(const verify *v, const claim *item, ovoid_error *error) {
    const ovoid_record *r = &item->record;
    ovoid_compound_answer answer = {.answer = r->answer,
                                    .part_a = item->pair.a.compound ? r->part_a : 0,
                                    .part_b = item->pair.b.compound ? r->part_b : 0};
    ovoid_exclusions exclusions = {(ovoid_exclusion *)r->exclusions, r->exclusion_count, r->exclusion_count,
                                   (ovoid_cover *)r->cover};
    return verdict_check_compound(v->verdict, &item->pair, &answer, &exclusions, error);
}

/// Checks an impact: the steps show that the pair was farther apart than the margin until then, and at the end it is
/// not; of one that is not proven, the steps alone.
static ovoid_code check_impact(const claim *item, const ovoid_answer *answer, ovoid_error *error) {
    const ovoid_record *r = &item->record;
    if (!(r->fields & OVOID_RECORD_IMPACT)) return OVOID_OK;
    const ovoid_moving_body *a = &item->moving[0], *b = &item->moving[1];
    ovoid_compound_impact found = {
        .part_a = a->compound ? r->part_a : 0, .part_b = b->compound ? r->part_b : 0, .group_count = r->group_count};
    int is_hit = isfinite(r->hit_after);
    found.impact = (ovoid_impact){.status = is_hit ? OVOID_IMPACT_HIT : OVOID_IMPACT_UNDECIDED,
                                  .limit = is_hit ? OVOID_LIMIT_NONE : r->answer.limit,
                                  .end = item->duration,
                                  .free_until = r->free_for,
                                  .hit_at = r->hit_after,
                                  .step_count = r->step_count,
                                  .hit = *answer};
    if (a->compound || b->compound)
        return ovoid_compound_impact_check(a, b, r->margin, &found, r->steps, r->groups, error);
    // The distance at the end of the free time is not claimed, so it is queried here.
    ovoid_moving_shape moving[2] = {ovoid_moving_body_get_part(a, 0), ovoid_moving_body_get_part(b, 0)};
    ovoid_pair free = {a->shape, b->shape, ovoid_moving_shape_compute_pose(&moving[0], r->free_for),
                       ovoid_moving_shape_compute_pose(&moving[1], r->free_for)};
    found.impact.free = ovoid_within(&free, r->margin, NULL, NULL);
    return ovoid_impact_check(&moving[0], &moving[1], r->margin, &found.impact, r->steps, error);
}

static ovoid_code check_claim(const verify *v, const claim *item, ovoid_error *error) {
    ovoid_pair pair;
    const ovoid_answer answer = item->record.answer;
    int is_compound = item->pair.a.compound || item->pair.b.compound;
    if (!get_parts(&item->pair, &item->record, &pair)) {
        snprintf(error->message, sizeof error->message, "the parts are not those of the bodies");
        return OVOID_ERROR_PROOF;
    }
    // The answer of an impact is that of ovoid_within at its margin.
    int is_impact = (item->record.fields & OVOID_RECORD_IMPACT) != 0;
    int points = !is_impact && has_nearest_points(v->settings->query, &answer);
    ovoid_code code = is_compound ? check_compound(v, item, error)
                                  : verdict_check(v->verdict, &pair, &answer, item->record.cover, points, error);
    return code == OVOID_OK ? check_impact(item, &answer, error) : code;
}

static void work(void *context, void *slot) {
    const verify *v = context;
    chunk *c = slot;
    for (claim *i = c->items; i < c->items + c->count; i++) {
        ovoid_error error = {.message = ""};
        if (!i->message[0] && check_claim(v, i, &error) != OVOID_OK)
            disprove(i, error.message[0] ? error.message : "the proof does not hold");
        i->holds = !i->message[0];
    }
}

/// 1 for an impact that is not proven.
static int is_open(const ovoid_record *record) {
    return record->fields & OVOID_RECORD_IMPACT && !isfinite(record->hit_after);
}

static int drain(void *context, void *slot) {
    verify *v = context;
    chunk *c = slot;
    for (claim *i = c->items; i < c->items + c->count; i++) {
        size_t failures = v->proofs++ - v->held;
        v->held += (size_t)i->holds;
        v->undecided += i->record.answer.status == OVOID_UNDECIDED || is_open(&i->record);
        v->impacts += (i->record.fields & OVOID_RECORD_IMPACT) != 0;
        if (!i->holds && failures < REPORTED_MAX) message_error("%s:%lld: %s", v->path, (long long)i->line, i->message);
        drop_record(i);
    }
    progress_set(v->proofs);
    return 0;
}

static void clear(void *slot) {
    chunk *c = slot;
    for (size_t i = 0; i < CHUNK; i++) drop_record(&c->items[i]);
}

/// Counts the pairs of a scene, at each of its frames, that have no result: a margin leaves far ones out.
static void count_missing(verify *v) {
    cli_frames *f = &v->bodies.frames;
    int got = 1;
    while (v->settings->motion && got > 0) got = frames_next(f);
    if (got < 0) v->refused = 1, v->error.message[0] = 0;
    v->pairs = ovoid_scene_get_pair_count(v->bodies.scene) * (v->settings->motion ? f->count : 1);
    v->missing = v->pairs - seen_get_count(&v->seen);
}

/// Refuses results of a batch that were cut off.
static void check_rest(verify *v) {
    ovoid_indexed_pair pair;
    size_t rest = 0;
    int got;
    while ((got = ovoid_pairs_reader_read(v->bodies.pairs, &pair, &v->error)) > 0) rest++;
    v->refused = got < 0 || rest > 0;
    if (got == 0 && rest)
        snprintf(v->error.message, sizeof v->error.message, "%s: %zu pairs have no result: it was cut off", v->path,
                 rest);
}

/// Reports pairs without a result, and a file without any.
static void report_missing(verify *v) {
    if (!v->refused && v->bodies.pairs) check_rest(v);
    if (!v->refused && v->bodies.scene) count_missing(v);
    if (v->refused || v->proofs || v->settings->allow_empty) return;
    v->refused = 1;
    snprintf(v->error.message, sizeof v->error.message,
             "%s: there is no result; where none is wanted, --allow-empty says so", v->path);
}

/// The counts, and in what arithmetic the proofs were checked.
static void print_counts(const verify *v) {
    static const char floating[] = "floating point with rigorous error bounds";
    size_t exact = verdict_is_exact() ? v->proofs - v->impacts : 0, failed = v->proofs - v->held;
    if (v->settings->json) {
        printf("{\"proofs\":%zu,\"hold\":%zu,\"fail\":%zu,\"undecided\":%zu,\"exact\":%zu,\"floating\":%zu,", v->proofs,
               v->held, failed, v->undecided, exact, v->proofs - exact);
        printf("\"pairs\":%zu,\"missing\":%zu}\n", v->bodies.scene ? v->pairs : v->proofs, v->missing);
        return;
    }
    printf("proofs: %zu, hold: %zu, do not: %zu; undecided answers: %zu; ", v->proofs, v->held, failed, v->undecided);
    if (v->missing)
        printf("%s without a result: %zu of %zu; ", v->settings->motion ? "pairs of frames" : "pairs", v->missing,
               v->pairs);
    if (!verdict_is_exact())
        printf("checked in %s\n", floating);
    else if (!v->impacts)
        printf("checked in exact arithmetic\n");
    else
        printf("checked in exact arithmetic, but for impacts (%zu): their steps in %s\n", v->impacts, floating);
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
    report_missing(v);
    if (v->refused && v->error.message[0]) message_error("%s", v->error.message);
    if (v->refused) return EXIT_INPUT;
    print_counts(v);
    code = finish_file(stdout);
    if (code) return code;
    return v->held == v->proofs ? EXIT_APART : EXIT_NOT_PROVEN;
}

/* ---- the inputs ---- */

/// Checks the operands and options together. -1 to go on, or EXIT_USAGE.
static int check_inputs(const cli_command *command, const settings *s, const cli_operands *paths) {
    int has_list = s->list || s->pairs;
    if (has_list && (!s->list || !s->pairs)) return args_complain(command, "verify: --shapes and --pairs go together");
    if (has_list && paths->count > 1)
        return args_complain(command, "verify: --shapes takes the place of %s", paths->items[1]);
    if (!has_list && paths->count < 2)
        return args_complain(command, "verify: on which bodies? Give SCENE.json, or A and B, or --shapes and --pairs");
    if (!has_list && paths->count == 2 && !inputs_is_scene(paths->items[1]) && strcmp(paths->items[1], "-") != 0)
        return args_complain(command, "verify: %s is no scene (.json); of two bodies, both must be given",
                             paths->items[1]);
    if (s->motion && (has_list || paths->count > 2))
        return args_complain(command, "verify: --motion is that of a scene: give SCENE.json");
    int is_scene = !has_list && paths->count == 2;
    if (is_scene && (s->read.unit != INPUTS_NO_UNIT || s->read.scale > 0))
        return args_complain(command,
                             "verify: --unit and --scale are for meshes; a scene says its own (\"unit\": \"mm\")");
    if (s->parts && (has_list || paths->count < 3)) return args_complain(command, "verify: --parts goes with A and B");
    return -1;
}

static void close_bodies(body_source *bodies) {
    frames_close(&bodies->frames);
    ovoid_scene_destroy(bodies->scene);
    ovoid_pairs_reader_destroy(bodies->pairs);
    ovoid_shapes_destroy(bodies->list);
    inputs_close_body(&bodies->bodies[0]);
    inputs_close_body(&bodies->bodies[1]);
}

/// Opens the bodies of ovoid batch. 0, or EXIT_INPUT after a message.
static int open_list(body_source *bodies, const settings *s) {
    ovoid_error error;
    bodies->list = inputs_read_list(s->list, &s->read);
    if (!bodies->list) return EXIT_INPUT;
    bodies->pairs = ovoid_pairs_reader_create(s->pairs, ovoid_shapes_get_count(bodies->list), &error);
    if (!bodies->pairs) message_error("%s", error.message);
    return bodies->pairs ? 0 : EXIT_INPUT;
}

/// Opens the bodies of ovoid distance. 0, or EXIT_INPUT after a message.
static int open_pair(body_source *bodies, const settings *s, const cli_operands *paths) {
    bodies->paths[0] = paths->items[1];
    bodies->paths[1] = paths->items[2];
    if (inputs_open_pair(bodies->paths, &s->read, s->parts, bodies->bodies)) return EXIT_INPUT;
    bodies->pair = (ovoid_body_pair){inputs_get_body(&bodies->bodies[0], &s->pose_a),
                                     inputs_get_body(&bodies->bodies[1], &s->pose_b)};
    return 0;
}

static int open_bodies(body_source *bodies, const settings *s, const cli_operands *paths) {
    if (s->list) return open_list(bodies, s);
    if (paths->count == 3) return open_pair(bodies, s, paths);
    bodies->scene = inputs_read_scene(paths->items[1]);
    if (!bodies->scene) return EXIT_INPUT;
    return s->motion ? frames_open(&bodies->frames, s->motion, bodies->scene) : 0;
}

/// 1 where the operands are those of path proofs: the file alone, or with a URDF.
static int has_path_proofs(const settings *s, const cli_operands *paths) {
    if (s->list || s->pairs || s->motion) return 0;
    return paths->count == 1 || (paths->count == 2 && outputs_has_extension(paths->items[1], "urdf"));
}

#ifdef OVOID_HAVE_ROBOT
static int verify_paths(const cli_command *command, settings *s, const cli_operands *paths) {
    s->paths.json = s->json;
    s->paths.allow_empty = s->allow_empty;
    return path_verify(command, &s->paths, paths->items[0], paths->count > 1 ? paths->items[1] : NULL);
}
#else
static int verify_paths(const cli_command *command, settings *s, const cli_operands *paths) {
    (void)s;
    if (paths->count == 1)
        return args_complain(command, "verify: on which bodies? Give SCENE.json, or A and B, or --shapes and --pairs");
    return args_complain(command, "verify: path proofs need libovoid_robot, without which this ovoid was built");
}
#endif

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.read.unit = INPUTS_NO_UNIT,
                  .query = QUERY_NONE,
                  .pose_a = ovoid_pose_make_identity(),
                  .pose_b = ovoid_pose_make_identity()};
    cli_operands paths;
    int code = command_parse(command, argc, argv, &s, &paths);
    if (code < 0 && has_path_proofs(&s, &paths)) return verify_paths(command, &s, &paths);
    if (code < 0) code = check_inputs(command, &s, &paths);
    if (code >= 0) return code;
    if (s.query == QUERY_NONE) s.query = s.list ? QUERY_WITHIN : QUERY_DISTANCE;
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
    seen_clear(&v.seen);
    close_bodies(&v.bodies);
    return code;
}

const cli_command command_verify = {
    .name = "verify",
    .summary = "checks the proofs of a results file",
    .usage = "[OPTION...] RESULTS.jsonl SCENE.json\n"
             "[OPTION...] RESULTS.jsonl SCENE.json --motion MOTION.csv\n"
             "[OPTION...] RESULTS.jsonl A B\n"
             "[OPTION...] RESULTS.jsonl --shapes LIST --pairs PAIRS.csv\n"
             "[OPTION...] PROOFS.jsonl [ROBOT.urdf]",
    .description =
        "Checks every result of a file written with --json by check, run, distance or batch, on the same bodies, "
        "without the search that found it: each bound is computed again from the proof alone, in exact rational "
        "arithmetic where ovoid was built with GMP. A result holds if its proof shows lower <= d <= upper and the "
        "status, if the normal is the one that proves the lower bound, and if the witness points lie on their "
        "bodies.\n\n"
        "Of compounds, it is also checked that the exclusions hold and leave out no pair of parts; and of impacts, the "
        "steps that show that a pair was free until then, these always in floating point with rigorous error bounds. "
        "Such results are counted apart.\n\n"
        "PROOFS.jsonl is of \"ovoid robot path --proofs\". It names its robot and its obstacles, which must be the "
        "same "
        "still: a digest says so. Each step is measured again, without a search, and for each pair the steps must "
        "reach "
        "from the beginning to the end of what is said to be free.\n\n"
        "RESULTS.jsonl is \"-\" for standard input. The first failures are listed with their lines. "
        "Of a scene, pairs without a result are counted (check --margin leaves far ones out); of a batch they are an "
        "error.",
    .exits = "0 every proof holds\n"
             "2 the command line is wrong\n"
             "3 bad input\n"
             "4 a proof does not hold",
    .examples = "ovoid check cell.json --json | ovoid verify - cell.json\n"
                "ovoid verify results.jsonl --shapes hulls.txt --pairs pairs.csv\n"
                "ovoid verify proof.jsonl",
    .options = options,
    .operands_min = 1,
    .operands_max = 3,
    .run = run,
};
