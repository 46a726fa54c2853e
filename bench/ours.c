// ovoid as a contestant: the public calls, with default options.
#include "ours.h"

#include <stdlib.h>

typedef struct self {
    ovoid_pair *pairs;
    double *margins;
    ovoid_proof *proofs; ///< of each track's last frame
    uint32_t count, tracks;
} self;

static void destroy(void *state) {
    self *s = state;
    if (!s) return;
    free(s->pairs);
    free(s->margins);
    free(s->proofs);
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
    if (!s->pairs || !s->margins || !s->proofs) {
        destroy(s);
        return NULL;
    }
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

static void run(void *state, question what, int warm, found *answers) {
    self *s = state;
    for (uint32_t i = 0; i < s->count; i++) {
        ovoid_proof *proof = warm ? &s->proofs[i % s->tracks] : NULL;
        ovoid_answer answer = ours_get_answer(&s->pairs[i], what, s->margins[i], warm && i >= s->tracks ? proof : NULL);
        if (proof) *proof = answer.proof;
        double distance = what == QUESTION_DEPTH ? -answer.upper : answer.upper;
        answers[i] = (found){read_verdict(&answer, what, s->margins[i]), distance, answer.point_a, answer.point_b,
                             answer.normal};
    }
}

const peer ours = {"ovoid", (1u << QUESTION_COUNT) - 1, (1u << QUESTION_COUNT) - 1, 0, create, run, destroy};

uint32_t ours_count_unproven(const workload *work, question what) {
    static ovoid_cover cover;
    uint32_t unproven = 0;
    for (uint32_t i = 0; i < work->pair_count; i++) {
        ovoid_pair pair = workload_get_pair(work, i);
        double margin = work->pairs[i].margin;
        ovoid_answer answer = what == QUESTION_DEPTH ? ovoid_depth(&pair, NULL, NULL, &cover)
                                                     : ours_get_answer(&pair, what, margin, NULL);
        ovoid_code code = ovoid_answer_check(&pair, &answer, what == QUESTION_DEPTH ? &cover : NULL, NULL);
        unproven += code != OVOID_OK || read_verdict(&answer, what, margin) == VERDICT_NONE;
    }
    return unproven;
}
