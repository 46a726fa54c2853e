// ovoid as a contestant: the public calls, with default options.
#include "pairs/ours.h"

#include <stdlib.h>
#include <string.h>

typedef struct self {
    ovoid_pair *pairs;
    double *margins;
    ovoid_proof *proofs; ///< of each track's last frame
    ovoid_cover *covers; ///< of each track's last depth
    unsigned char *cover_memory;
    uint32_t count, tracks;
} self;

static void destroy(void *state) {
    self *s = state;
    if (!s) return;
    free(s->pairs);
    free(s->margins);
    free(s->proofs);
    free(s->covers);
    free(s->cover_memory);
    free(s);
}

static void *create(const workload *work) {
    self *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->count = work->pair_count;
    s->tracks = work->tracks ? work->tracks : work->pair_count;
    s->pairs = malloc(sizeof *s->pairs * s->count);
    s->margins = malloc(sizeof *s->margins * s->count);
    s->proofs = malloc(sizeof *s->proofs * s->tracks);
    s->covers = calloc(s->tracks, sizeof *s->covers);
    s->cover_memory = malloc(OVOID_COVER_SIZE * s->tracks);
    if (!s->pairs || !s->margins || !s->proofs || !s->covers || !s->cover_memory) {
        destroy(s);
        return NULL;
    }
    for (uint32_t i = 0; i < s->tracks; i++)
        s->covers[i] = (ovoid_cover){.memory = s->cover_memory + OVOID_COVER_SIZE * i, .size = OVOID_COVER_SIZE};
    for (uint32_t i = 0; i < s->count; i++) {
        s->pairs[i] = workload_get_pair(work, i);
        s->margins[i] = work->pairs[i].margin;
    }
    return s;
}

ovoid_answer ours_get_answer(const ovoid_pair *pair, question what, double margin, const ovoid_proof *earlier) {
    switch (what) {
    case QUESTION_COLLIDE: return ovoid_collide(pair, NULL, earlier);
    case QUESTION_WITHIN: return ovoid_within(pair, margin, NULL, earlier);
    case QUESTION_DISTANCE: return ovoid_distance(pair, NULL, earlier);
    default: return ovoid_depth(pair, NULL, earlier, NULL);
    }
}

static verdict read_verdict(const ovoid_answer *answer, question what, double margin) {
    if (what == QUESTION_WITHIN) {
        int within = ovoid_answer_is_within(answer, margin);
        return within < 0 ? VERDICT_NONE : within ? VERDICT_YES : VERDICT_NO;
    }
    if (answer->status == OVOID_UNDECIDED) return VERDICT_NONE;
    return answer->status == OVOID_SEPARATED ? VERDICT_NO : VERDICT_YES;
}

/// In motion a depth starts from the proof and the cover of the last frame, the other questions from its proof.
static ovoid_answer ask_warm(self *s, uint32_t i, question what) {
    uint32_t track = i % s->tracks;
    const ovoid_proof *proof = i >= s->tracks ? &s->proofs[track] : NULL;
    if (what != QUESTION_DEPTH) return ours_get_answer(&s->pairs[i], what, s->margins[i], proof);
    if (!proof) s->covers[track].point_count = 0;
    return ovoid_depth_from(&s->pairs[i], NULL, proof, &s->covers[track]);
}

static void run(void *state, question what, int warm, found *answers) {
    self *s = state;
    for (uint32_t i = 0; i < s->count; i++) {
        ovoid_proof *proof = warm ? &s->proofs[i % s->tracks] : NULL;
        ovoid_answer answer = warm ? ask_warm(s, i, what) : ours_get_answer(&s->pairs[i], what, s->margins[i], NULL);
        if (proof) *proof = answer.proof;
        double distance = what == QUESTION_DEPTH ? -answer.upper : answer.upper;
        answers[i] = (found){read_verdict(&answer, what, s->margins[i]), distance, answer.point_a, answer.point_b,
                             answer.normal};
    }
}

const peer ours = {"ovoid", (1u << QUESTION_COUNT) - 1, (1u << QUESTION_COUNT) - 1, 0, create, run, destroy};

// --- prepared at their poses

typedef struct prepared_self {
    ovoid_prepared_shape *bodies; ///< two of each pair
    double *margins;
    ovoid_proof *proofs; ///< of each track's last frame
    uint32_t count, tracks;
} prepared_self;

static void destroy_prepared(void *state) {
    prepared_self *s = state;
    if (!s) return;
    free(s->bodies);
    free(s->margins);
    free(s->proofs);
    free(s);
}

static void *create_prepared(const workload *work) {
    prepared_self *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->count = work->pair_count;
    s->tracks = work->tracks ? work->tracks : work->pair_count;
    s->bodies = malloc(sizeof *s->bodies * 2 * s->count);
    s->margins = malloc(sizeof *s->margins * s->count);
    s->proofs = malloc(sizeof *s->proofs * s->tracks);
    if (!s->bodies || !s->margins || !s->proofs) {
        destroy_prepared(s);
        return NULL;
    }
    for (uint32_t i = 0; i < s->count; i++) {
        ovoid_pair pair = workload_get_pair(work, i);
        ovoid_prepared_shape_make(&(ovoid_posed_shape){pair.shape_a, pair.pose_a}, &s->bodies[2 * i]);
        ovoid_prepared_shape_make(&(ovoid_posed_shape){pair.shape_b, pair.pose_b}, &s->bodies[2 * i + 1]);
        s->margins[i] = work->pairs[i].margin;
    }
    return s;
}

static ovoid_verdict ask_prepared(const prepared_self *s, uint32_t i, question what, const ovoid_evidence *evidence) {
    ovoid_prepared_pair pair = {&s->bodies[2 * i], &s->bodies[2 * i + 1]};
    switch (what) {
    case QUESTION_COLLIDE: return ovoid_prepared_collide(pair, NULL, evidence);
    case QUESTION_WITHIN: return ovoid_prepared_within(pair, s->margins[i], NULL, evidence);
    case QUESTION_DISTANCE: return ovoid_prepared_distance(pair, NULL, evidence);
    default: return ovoid_prepared_depth(pair, NULL, evidence);
    }
}

/// For yes or no only verdicts are requested, else points and normal too.
static void run_prepared(void *state, question what, int warm, found *answers) {
    prepared_self *s = state;
    int yes_or_no = what == QUESTION_COLLIDE || what == QUESTION_WITHIN;
    if (warm) memset(s->proofs, 0, sizeof *s->proofs * s->tracks);
    for (uint32_t i = 0; i < s->count; i++) {
        ovoid_witness points;
        ovoid_evidence evidence = {.proof = warm ? &s->proofs[i % s->tracks] : NULL,
                                   .witness = yes_or_no ? NULL : &points};
        ovoid_verdict v = ask_prepared(s, i, what, warm || !yes_or_no ? &evidence : NULL);
        ovoid_answer answer = {.status = v.status, .lower = v.lower, .upper = v.upper};
        answers[i].yes = read_verdict(&answer, what, s->margins[i]);
        if (yes_or_no) continue;
        answers[i].distance = what == QUESTION_DEPTH ? -v.upper : v.upper;
        answers[i].point_a = points.point_a;
        answers[i].point_b = points.point_b;
        answers[i].normal = points.normal;
    }
}

const peer ours_prepared = {
    "prepared",      (1u << QUESTION_COUNT) - 1, (1u << QUESTION_COUNT) - 1, 0, create_prepared, run_prepared,
    destroy_prepared};

// --- in batches

typedef struct batch_self {
    ovoid_batch batch; ///< of all couples
    double margin;
    uint32_t frame; ///< couples of one query
} batch_self;

static void destroy_batch(void *state) {
    batch_self *s = state;
    if (!s) return;
    free((void *)s->batch.bodies);
    free((void *)s->batch.couples);
    free(s->batch.proofs);
    free(s->batch.verdicts);
    free(s->batch.witnesses);
    free(s);
}

static void *create_batch(const workload *work) {
    batch_self *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    size_t count = work->pair_count;
    s->frame = work->tracks ? work->tracks : work->pair_count;
    s->margin = work->pairs[0].margin;
    ovoid_posed_shape *posed = malloc(sizeof *posed * 2 * count);
    ovoid_couple *couples = malloc(sizeof *couples * count);
    s->batch = (ovoid_batch){.bodies = posed,
                             .body_count = 2 * count,
                             .couples = couples,
                             .couple_count = s->frame,
                             .proofs = calloc(s->frame, sizeof(ovoid_proof)),
                             .verdicts = malloc(sizeof(ovoid_verdict) * s->frame),
                             .witnesses = malloc(sizeof(ovoid_witness) * s->frame)};
    if (!posed || !couples || !s->batch.proofs || !s->batch.verdicts || !s->batch.witnesses) {
        destroy_batch(s);
        return NULL;
    }
    for (uint32_t i = 0; i < count; i++) {
        ovoid_pair pair = workload_get_pair(work, i);
        posed[2 * i] = (ovoid_posed_shape){pair.shape_a, pair.pose_a};
        posed[2 * i + 1] = (ovoid_posed_shape){pair.shape_b, pair.pose_b};
        couples[i] = (ovoid_couple){2 * i, 2 * i + 1};
    }
    return s;
}

static ovoid_code ask_batch(const ovoid_batch *batch, question what, double margin) {
    switch (what) {
    case QUESTION_COLLIDE: return ovoid_collide_batch(batch, NULL);
    case QUESTION_WITHIN: return ovoid_within_batch(batch, margin, NULL);
    case QUESTION_DISTANCE: return ovoid_distance_batch(batch, NULL);
    default: return ovoid_depth_batch(batch, NULL);
    }
}

static void read_verdicts(const batch_self *s, question what, found *answers) {
    for (uint32_t i = 0; i < s->frame; i++) {
        const ovoid_verdict *v = &s->batch.verdicts[i];
        ovoid_answer answer = {.status = v->status, .lower = v->lower, .upper = v->upper};
        answers[i].yes = read_verdict(&answer, what, s->margin);
    }
}

static void read_witnesses(const batch_self *s, question what, found *answers) {
    for (uint32_t i = 0; i < s->frame; i++) {
        const ovoid_witness *w = &s->batch.witnesses[i];
        answers[i].distance = what == QUESTION_DEPTH ? -s->batch.verdicts[i].upper : s->batch.verdicts[i].upper;
        answers[i].point_a = w->point_a;
        answers[i].point_b = w->point_b;
        answers[i].normal = w->normal;
    }
}

/// For yes or no only verdicts are requested, else points and normal too. A frame is a batch, and its proofs are the
/// earlier ones of the next frame.
static void run_batch(void *state, question what, int warm, found *answers) {
    batch_self *s = state;
    int yes_or_no = what == QUESTION_COLLIDE || what == QUESTION_WITHIN;
    ovoid_batch batch = s->batch;
    if (yes_or_no) batch.witnesses = NULL;
    if (warm)
        memset(batch.proofs, 0, sizeof *batch.proofs * s->frame);
    else
        batch.proofs = NULL;
    for (size_t at = 0; at < batch.body_count / 2; at += s->frame) {
        batch.couples = s->batch.couples + at;
        int good = ask_batch(&batch, what, s->margin) == OVOID_OK;
        if (good)
            read_verdicts(s, what, answers + at);
        else
            for (uint32_t i = 0; i < s->frame; i++) answers[at + i] = (found){.yes = VERDICT_NONE};
        if (good && !yes_or_no) read_witnesses(s, what, answers + at);
    }
}

const peer ours_in_batches = {
    "batch", (1u << QUESTION_COUNT) - 1, (1u << QUESTION_COUNT) - 1, 0, create_batch, run_batch, destroy_batch};

uint32_t ours_count_unproven(const workload *work, question what) {
    static uint64_t memory[OVOID_COVER_SIZE / sizeof(uint64_t)];
    static ovoid_cover cover = {.memory = memory, .size = sizeof memory};
    uint32_t unproven = 0;
    for (uint32_t i = 0; i < work->pair_count; i++) {
        ovoid_pair pair = workload_get_pair(work, i);
        double margin = work->pairs[i].margin;
        ovoid_answer answer = what == QUESTION_DEPTH ? ovoid_depth(&pair, NULL, NULL, &cover)
                                                     : ours_get_answer(&pair, what, margin, NULL);
        ovoid_code code = ovoid_answer_verify(
            &pair, &answer, &(ovoid_answer_basis){.cover = what == QUESTION_DEPTH ? &cover : NULL}, NULL);
        unproven += code != OVOID_OK || read_verdict(&answer, what, margin) == VERDICT_NONE;
    }
    return unproven;
}
