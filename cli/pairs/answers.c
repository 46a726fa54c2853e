// The answers of many pairs: chunks of the same size for any number of threads, so that the output is the same bytes.
#include "pairs/answers.h"

#include "base/covers.h"
#include "base/message.h"
#include "base/pipeline.h"

#include <math.h>
#include <stdlib.h>

/// Pairs of a chunk.
#define CHUNK 128

typedef struct chunk {
    size_t first, count;
    ovoid_record *records; ///< CHUNK
    answer_room room;
    char *text;
    size_t size;
    int failed;               ///< no memory
    const char *long_pair[2]; ///< the names of a pair whose proof is too long for a line; NULL: none
} chunk;

typedef struct work_state {
    const answers_job *job;
    size_t next;
} work_state;

/* ---- one answer */

ovoid_body answers_get_body(const ovoid_scene *scene, size_t object, const ovoid_pose *pose) {
    return ovoid_scene_get_body(scene, object, pose);
}

static ovoid_body_answer find(const ovoid_body_pair *pair, const answers_query *q, ovoid_exclusions *exclusions) {
    ovoid_options options = {.absolute_tolerance = q->tolerance};
    if (q->query == QUERY_COLLIDE)
        return ovoid_body_collide(pair, &options,
                                  &(ovoid_body_evidence){.earlier = q->earlier, .exclusions = exclusions});
    if (q->query == QUERY_WITHIN)
        return ovoid_body_within(pair, q->margin, &options,
                                 &(ovoid_body_evidence){.earlier = q->earlier, .exclusions = exclusions});
    return ovoid_body_depth(pair, &options, &(ovoid_body_evidence){.earlier = q->earlier, .exclusions = exclusions});
}

void answers_describe(const ovoid_scene *scene, ovoid_couple couple, ovoid_record *record) {
    ovoid_scene_object a = ovoid_scene_get(scene, couple.a), b = ovoid_scene_get(scene, couple.b);
    record->kind_a = a.kind;
    record->kind_b = b.kind;
    record->mesh_a = a.convexity;
    record->mesh_b = b.convexity;
}

/// The width that a shape's allowance adds to a bracket.
static double get_width(const ovoid_shape *shape) {
    ovoid_allowance allowance = ovoid_shape_get_allowance(shape);
    return allowance.outside + allowance.inside;
}

double answers_find_width(const ovoid_body *body) {
    double width = body->shape ? get_width(body->shape) : 0;
    for (size_t i = 0; body->compound && i < ovoid_compound_get_part_count(body->compound); i++)
        width = fmax(width, get_width(ovoid_compound_get_part(body->compound, i).shape));
    return width;
}

void answers_settle_limit(ovoid_answer *answer, const ovoid_body_pair *pair, double margin, double tolerance) {
    double width = answer->upper - answer->lower;
    if (!(margin >= 0) || answer->limit != OVOID_LIMIT_NONE || answer->status == OVOID_TOUCHING) return;
    if (ovoid_answer_is_within(answer, margin) >= 0 || width <= tolerance) return;
    if (2 * (answers_find_width(&pair->a) + answers_find_width(&pair->b)) > width)
        answer->limit = OVOID_LIMIT_ALLOWANCE;
}

int answers_find(answer_room *room, const ovoid_body_pair *pair, const answers_query *query, ovoid_record *record) {
    int is_solid = pair->a.solid || pair->b.solid;
    ovoid_exclusions *proof = &room->exclusions;
    proof->grows = 1;
    proof->count = 0;
    proof->cover = query->query == QUERY_DISTANCE ? &room->cover : NULL;
    room->cover.point_count = 0;
    if (query->wants_proof && !cover_take_memory(&room->cover)) return 0;
    room->body = find(pair, query, query->wants_proof ? proof : NULL);
    // The search filled its own memory, and goes on in that of a cover.
    if (room->body.limit == OVOID_LIMIT_CAPACITY && !query->wants_proof) {
        if (!cover_take_memory(&room->cover)) return 0;
        room->body = find(pair, query, proof);
    }
    if (proof->count > proof->capacity) return 0;
    record->solid = NULL;
    record->answer = room->body.deciding;
    if (is_solid)
        ovoid_record_set_solid(record, &room->body);
    else if (query->query == QUERY_DISTANCE)
        answers_settle_limit(&record->answer, pair, query->margin, query->tolerance);
    record->part_a = pair->a.compound ? room->body.part_a : OVOID_RECORD_NO_PART;
    record->part_b = pair->b.compound ? room->body.part_b : OVOID_RECORD_NO_PART;
    record->cover = query->wants_proof && room->cover.point_count ? &room->cover : NULL;
    record->exclusions = proof->items;
    record->exclusion_count = proof->count;
    return !query->contacts || contacts_find(pair, query->contacts, record);
}

void answer_room_clear(answer_room *room) {
    free(room->cover.memory);
    ovoid_exclusions_release(&room->exclusions);
    *room = (answer_room){.cover = {.memory = NULL}};
}

/* ---- many */

static int fill(void *context, void *slot) {
    work_state *w = context;
    chunk *k = slot;
    k->count = pipeline_take(&w->next, w->job->count, CHUNK, &k->first);
    return k->count > 0;
}

static ovoid_couple get_couple(const answers_job *job, size_t i) {
    return *(const ovoid_couple *)(const void *)((const char *)job->couples + i * job->stride);
}

/// 1 if the pair is proven farther apart than job->reach. Nothing but the pair and its poses decides.
static int is_beyond(const answers_job *job, const ovoid_body_pair *pair, const ovoid_body_answer *answer) {
    int within = ovoid_body_answer_is_within(answer, job->reach);
    if (within >= 0 || job->query != QUERY_DISTANCE) return within == 0;
    // The bracket is as wide as the tolerance or the allowances leave it.
    ovoid_body_answer own = ovoid_body_within(pair, job->reach, NULL, NULL);
    return ovoid_body_answer_is_within(&own, job->reach) == 0;
}

/// Record i of the chunk, which has no names where the pair is left out; 0 if memory runs out.
static int make_record(const answers_job *job, chunk *k, size_t i, int wants_proof) {
    ovoid_couple c = get_couple(job, k->first + i);
    ovoid_body_pair pair = {answers_get_body(job->scene, c.a, &job->poses[c.a]),
                            answers_get_body(job->scene, c.b, &job->poses[c.b])};
    k->records[i] = (ovoid_record){.a = ovoid_scene_get(job->scene, c.a).name,
                                   .b = ovoid_scene_get(job->scene, c.b).name,
                                   .fields = job->results ? job->results->fields : 0,
                                   .time = job->time,
                                   .margin = job->margin,
                                   .frame = NAN};
    const answers_query query = {job->query, job->margin, job->tolerance, wants_proof, NULL, job->contacts};
    answers_describe(job->scene, c, &k->records[i]);
    int done = answers_find(&k->room, &pair, &query, &k->records[i]);
    if (done && job->is_near_only && is_beyond(job, &pair, &k->room.body)) k->records[i].a = NULL;
    return done;
}

static void work(void *context, void *slot) {
    const answers_job *job = ((work_state *)context)->job;
    chunk *k = slot;
    int lines = job->results && results_are_lines(job->results);
    int proofs = job->wants_proof || (job->results && results_have_proofs(job->results));
    if (!k->records) k->records = calloc(CHUNK, sizeof *k->records);
    FILE *file = lines ? open_memstream(&k->text, &k->size) : NULL;
    k->failed = !k->records || (lines && !file);
    for (size_t i = 0; i < k->count && !k->failed; i++) {
        k->failed = !make_record(job, k, i, proofs);
        if (lines && !k->failed && k->records[i].a &&
            !results_write_line(file, job->results->settings, &k->records[i])) {
            k->long_pair[0] = k->records[i].a;
            k->long_pair[1] = k->records[i].b;
        }
        // The room is reused for the next pair.
        k->records[i].cover = NULL;
        k->records[i].exclusions = NULL;
        k->records[i].exclusion_count = 0;
        k->records[i].solid = NULL;
    }
    if (file && fclose(file) != 0) k->failed = 1;
}

static int drain(void *context, void *slot) {
    const answers_job *job = ((work_state *)context)->job;
    chunk *k = slot;
    int lines = job->results && results_are_lines(job->results), code = 0;
    if (k->failed) {
        message_error("out of memory");
        return EXIT_INPUT;
    }
    if (k->long_pair[0]) {
        results_report_long(k->long_pair[0], k->long_pair[1]);
        return EXIT_INPUT;
    }
    if (lines) code = results_add_text(job->results, k->text, k->size);
    for (size_t i = 0; i < k->count && !code; i++) {
        int is_listed = k->records[i].a != NULL;
        if (is_listed && job->results && !lines) code = results_add(job->results, &k->records[i]);
        if (is_listed && job->take) job->take(job->context, k->first + i, &k->records[i]);
        contacts_clear(&k->records[i]);
    }
    free(k->text);
    k->text = NULL;
    if (!code && job->are_units) code = results_end_units(job->results, k->count);
    return code;
}

static void clear(void *slot) {
    chunk *k = slot;
    answer_room_clear(&k->room);
    for (size_t i = 0; k->records && i < CHUNK; i++) contacts_clear(&k->records[i]);
    free(k->records);
    free(k->text);
}

int answers_run(const answers_job *job) {
    work_state w = {job, 0};
    cli_pipeline line = {&w, sizeof(chunk), fill, work, drain, clear};
    // A few pairs are answered faster than a thread starts.
    unsigned threads = pipeline_get_threads(job->threads);
    int code = job->count ? pipeline_run(&line, job->count <= CHUNK ? 1 : threads) : 0;
    if (code < 0) message_error("out of memory or threads"), code = EXIT_INPUT;
    return code;
}
