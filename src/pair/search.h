// The state of one query: the best bounds so far with their evidence, and the goal that says when to stop.
#ifndef OVOID_PAIR_SEARCH_H
#define OVOID_PAIR_SEARCH_H

#include "pair/frame.h"
#include "pair/simplex.h"

/// The goal of a query. All bounds are of the signed distance, radii and allowances subtracted.
typedef struct query_goal {
    double far;          ///< answered when lower > far: the margin, the cap
    double near;         ///< answered when upper <= near and the sign is proven: the margin; -infinity: never
    double tolerance;    ///< answered when the bracket is this narrow; includes `allowance`
    double allowance;    ///< the part of the width that no search removes, since it comes from the bodies' allowances
    int has_axis;        ///< for some normals the allowance is smaller (answer.c)
    uint32_t iterations; ///< most iterations of each exact method
    int wants_depth;     ///< a proven overlap does not answer the query
    int wants_bracket;   ///< the query asks for a narrow bracket, not only for the sign
    ovoid_limit beyond;  ///< the limit of an answer that stopped at lower > far
    uint16_t has_cover;  ///< the present cover is kept, unless a new one proves less than `covered`, its upper bound
    uint16_t
        wants_corner; ///< of a depth's witness only the first vertices are wanted, no point; there is no cover then
    double covered;
} query_goal;

/// The differences behind an upper bound, with weights.
typedef struct evidence {
    difference p[OVOID_PROOF_PAIRS];
    double weight[OVOID_PROOF_PAIRS];
    int count;
} evidence;

/// The search of one pair.
typedef struct search {
    const pair_frame *frame;
    query_goal goal;
    double lower, upper; ///< proven; radii and allowances subtracted
    vec3 normal;         ///< unit direction (frame) of the lower bound
    vec3 world,
        world_low;    ///< from REFINE: the direction of the lower bound in the world, as a sum; zero: it is `normal`
    evidence witness; ///< POINTS, HULL; of COVER a point of the surface
    ovoid_proof_kind kind;
    vec3 inner_a, inner_b; ///< INNER: the common point, A's body frame; INNER_POINTS
    ovoid_stage stage;     ///< the last one that improved a bound
    ovoid_limit limit;
    uint32_t iterations;
} search;

/// The state at the beginning: the bracket is everything. The witness' entries, the largest part of the struct, are not
/// set, since nothing reads past its count.
static inline void search_make(search *s, const pair_frame *frame, const query_goal *goal) {
    const vec3 zero = {0, 0, 0};
    s->frame = frame;
    s->goal = *goal;
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

/// 1 if the allowances leave the sign open, however narrow the bracket becomes: either only their width is left, or the
/// bracket without them is so near to zero that no further search can decide the sign. Along some normals an allowance
/// along an axis is smaller, so then the normal is searched for to the end.
static inline int query_goal_is_hopeless(const query_goal *goal, double lower, double upper) {
    if (!(goal->allowance > 0)) return 0;
    if (upper - lower <= goal->tolerance) return 1;
    if (goal->wants_bracket || goal->has_axis) return 0;
    return lower >= -goal->allowance && upper <= goal->allowance;
}

/// 1 if bounds answer a query that does not want the depth.
static inline int query_goal_is_met(const query_goal *goal, double lower, double upper) {
    if (lower > goal->far) return 1;
    if (!(lower > 0 || upper < 0)) return query_goal_is_hopeless(goal, lower, upper);
    return upper <= goal->near || upper < 0 || (goal->wants_bracket && upper - lower <= goal->tolerance);
}

/// 1 if a cover that proves `upper` is to be written: the caller's is wanted, and proves less if it is to be kept. The
/// memory of one that is smaller than OVOID_COVER_SIZE is for the start of the next depth alone (exact/cover_memory.h).
static inline int search_wants_cover(const search *s, const ovoid_cover *cover, double upper) {
    return cover && cover->size >= OVOID_COVER_SIZE && !(s->goal.has_cover && !(upper < s->goal.covered));
}

/// 1 if the next depth is to start from this one's surface: the cover is a small one.
static inline int search_wants_start(const search *s, const ovoid_cover *cover) {
    return cover && cover->size < OVOID_COVER_SIZE && !s->goal.has_cover;
}

/// 1 if the bounds answer the query.
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
/// so. Sets their weights; those given are not read.
int search_take_hull(search *s, const evidence *hull);

/// A depth that a surface around the origin shows, in the difference of the cores: the bounds, radii and allowances
/// subtracted, and the normal of its nearest face, from A to B.
typedef struct search_depth {
    double lower, upper;
    vec3 normal;
    ovoid_stage stage;
} search_depth;

/// 1 if the bounds are narrow enough for the goal, and better than what is known.
static inline int search_needs_depth(const search *s, const search_depth *depth) {
    return depth->upper < s->upper && depth->upper - depth->lower <= s->goal.tolerance;
}

/// Takes the bounds of a depth that is needed. witness: the point of the surface that is nearest to the origin.
void search_take_depth(search *s, const search_depth *depth, const evidence *witness);

/// The simplex as evidence.
evidence evidence_make(const simplex *points);

#endif
