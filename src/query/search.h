// The state of one query: the best bounds so far with what proves them, and the question that says when to stop.
#ifndef OVOID_QUERY_SEARCH_H
#define OVOID_QUERY_SEARCH_H

#include "query/simplex.h"

/// What is asked. All bounds are of the signed distance, radii subtracted.
typedef struct question {
    double far;          ///< answered when lower > far: the margin, the cap
    double near;         ///< answered when upper <= near and the sign is proven: the margin; -infinity: never
    double tolerance;    ///< answered when the bracket is this narrow
    uint32_t iterations; ///< most iterations of each exact method
    int wants_depth;     ///< a proven overlap does not answer it
    int wants_bracket;   ///< narrowing the bracket is asked, not only the sign
    ovoid_limit beyond;  ///< what an answer says that stopped at lower > far
} question;

/// The differences behind an upper bound, with weights.
typedef struct evidence {
    difference p[OVOID_PROOF_PAIRS];
    double weight[OVOID_PROOF_PAIRS];
    int count;
} evidence;

typedef struct search {
    const pair_frame *frame;
    question ask;
    double lower, upper;   ///< proven; radii subtracted
    vec3 normal;           ///< unit direction (frame) of the lower bound
    vec3 world, world_low; ///< REFINE: the direction of the lower bound, world, as a sum; zero: it is `normal`
    evidence witness;      ///< POINTS, HULL; of COVER the nearest face
    ovoid_proof_kind kind;
    vec3 inner_a, inner_b; ///< INNER: the common point, A's body frame; INNER_POINTS
    ovoid_stage stage;     ///< the last one that improved a bound
    ovoid_limit limit;
    uint32_t iterations;
} search;

/// The state before anything is known: the bracket is everything. The witness' entries, most of it all, stay as they
/// are, for no one reads past its count.
static inline void search_make(search *s, const pair_frame *frame, const question *ask) {
    const vec3 zero = {0, 0, 0};
    s->frame = frame;
    s->ask = *ask;
    s->lower = -INFINITY;
    s->upper = INFINITY;
    s->normal = s->world = s->world_low = zero;
    s->witness.count = 0;
    s->kind = OVOID_PROOF_NONE;
    s->inner_a = s->inner_b = zero;
    s->stage = OVOID_STAGE_NONE;
    s->limit = OVOID_LIMIT_NONE;
    s->iterations = 0;
}

/// 1 if bounds answer the question, of a depth asked for apart.
static inline int question_is_answered(const question *ask, double lower, double upper) {
    if (lower > ask->far) return 1;
    if (!(lower > 0 || upper < 0)) return 0;
    return upper <= ask->near || upper < 0 || (ask->wants_bracket && upper - lower <= ask->tolerance);
}

/// 1 if the question is answered by the bounds.
int search_is_done(const search *s);

/// 1 if lower > 0 or upper < 0.
int search_is_sign_known(const search *s);

/// Takes the gap that was measured along the unit direction n as lower bound if it is the best so far.
void search_take_gap(search *s, vec3 n, double gap);

/// Measures the gap along the unit direction n and takes it as lower bound if it is the best so far.
frame_support search_probe(search *s, vec3 n);

/// Takes the simplex's nearest point as upper bound if it is the best so far.
void search_take_points(search *s, const simplex *points);

/// Takes 4 to 6 differences (hull.h) as proof of an overlap if the origin is strictly inside, rounding included; 1 if
/// so.
int search_take_hull(search *s, const evidence *hull);

/// The simplex as evidence.
evidence evidence_make(const simplex *x);

/// Weights of the point nearest to the origin, by the best of the tetrahedra that four of the differences make.
void evidence_set_weights(evidence *x);

#endif
