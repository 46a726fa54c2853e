// From the state of a search to the answer, and the pipeline that all queries share.
#ifndef OVOID_QUERY_ANSWER_H
#define OVOID_QUERY_ANSWER_H

#include "query/search.h"

/// The answer.
void answer_write(search *s, ovoid_answer *out);

/// An answer that says nothing: all zero, but without the block store of a compiler's own, which is slow to start.
static inline void answer_clear(ovoid_answer *out) {
    const vec3 zero = {0, 0, 0};
    out->status = OVOID_UNDECIDED;
    out->stage = OVOID_STAGE_NONE;
    out->limit = OVOID_LIMIT_NONE;
    out->iterations = 0;
    out->lower = out->upper = 0;
    out->point_a = out->point_b = out->normal = zero;
    ovoid_proof *p = &out->proof;
    p->normal = p->normal_low = p->inner_a = p->inner_b = zero;
    p->kind = OVOID_PROOF_NONE;
    p->count = 0;
    for (int i = 0; i < OVOID_PROOF_PAIRS; i++) {
        p->a[i] = p->b[i] = 0;
        p->weight_a[i] = p->weight_b[i] = 0;
    }
}

/// The answer of a query that was refused: no bracket.
ovoid_answer answer_make_refused(ovoid_limit limit);

/// The whole pipeline for one question; cover may be NULL.
ovoid_answer answer_find(const ovoid_pair *pair, const ovoid_options *given, question ask, const ovoid_proof *earlier,
                         ovoid_cover *cover);

/// Likewise inside a public function: the floating-point environment is the default one already.
void answer_find_inside(const ovoid_pair *pair, const ovoid_options *given, question ask, const ovoid_proof *earlier,
                        ovoid_cover *cover, ovoid_answer *out);

/// The questions.
static inline question question_make_collide(void) {
    return (question){.far = 0, .near = -INFINITY, .beyond = OVOID_LIMIT_ANSWERED};
}
static inline question question_make_within(double margin) {
    return (question){.far = margin, .near = margin, .wants_bracket = 1, .beyond = OVOID_LIMIT_ANSWERED};
}
static inline question question_make_distance(const ovoid_options *options) {
    double cap = options && options->cap != 0 ? options->cap : INFINITY;
    return (question){.far = cap, .near = -INFINITY, .wants_bracket = 1, .beyond = OVOID_LIMIT_CAP};
}
static inline question question_make_depth(const ovoid_options *options) {
    question ask = question_make_distance(options);
    ask.wants_depth = 1;
    return ask;
}

#endif
