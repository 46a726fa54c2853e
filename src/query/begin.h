// How a query begins, of bodies that are placed in the world: what the spheres, closed forms, an earlier proof and
// the kernel of small bodies say, before B is put in the frame of A.
#ifndef OVOID_QUERY_BEGIN_H
#define OVOID_QUERY_BEGIN_H

#include "exact/closed.h"
#include "exact/kept.h"
#include "query/goal.h"

/// The rejection along an earlier proof's normal. That of a proof of overlap separated nothing, so it is not tried.
static inline int reject_by_earlier(const placed_query *q, rejection *found) {
    const ovoid_proof *earlier = q->earlier;
    int was_apart = earlier && q->goal->far < INFINITY &&
                    (earlier->kind == OVOID_PROOF_POINTS || earlier->kind == OVOID_PROOF_INNER_POINTS ||
                     earlier->kind == OVOID_PROOF_BALLS);
    return was_apart && reject_by_normal(q->frame, q->goal->far, earlier, found);
}

/// How a query begins: refused, rejected, answered as a pair of small bodies, or passed on to the search.
typedef enum beginning { BEGIN_REFUSED, BEGIN_REJECTED, BEGIN_SMALL, BEGIN_SEARCH } beginning;

/// The closed forms; then the kernel of small bodies, from the earlier proof where that says something; of larger ones
/// what the proof's differences say.
static inline small_outcome run_small(const placed_query *q, rejection *found, small_end *end) {
    const ovoid_shape *a = q->frame->a, *b = q->frame->b;
    small_outcome outcome = SMALL_UNKNOWN;
    if (closed_fits(a, b) && closed_run(q, end)) return SMALL_ANSWERED;
    if (q->earlier && small_takes(q->goal, a, b, q->sphere_gap))
        outcome = small_run_earlier(q, found, end);
    else if (q->earlier && kept_fits(q->goal, a, b, q->sphere_gap) && kept_run(q, end))
        return SMALL_ANSWERED;
    if (outcome == SMALL_UNKNOWN && small_takes(q->goal, a, b, q->sphere_gap))
        outcome = small_run(q, end) ? SMALL_ANSWERED : SMALL_OPEN;
    return outcome;
}

/// The goal's numbers that are the pair's own.
static inline void set_numbers(query_goal *goal, const ovoid_options *options, const pair_frame *frame) {
    goal->allowance = frame_get_allowance(frame);
    goal->has_axis = frame_has_axis(frame);
    goal->tolerance = options_compute_tolerance(options, frame->size, frame->hidden) + goal->allowance;
    goal->iterations = options->iterations;
}

/// The stages after the spheres. The spheres come first, as they cost the same for any number of vertices; found has
/// their bound.
static inline beginning begin_after_spheres(const placed_query *q, rejection *found, small_end *end) {
    switch (run_small(q, found, end)) {
    case SMALL_ANSWERED: return BEGIN_SMALL;
    case SMALL_REJECTED: return BEGIN_REJECTED;
    case SMALL_OPEN: return BEGIN_SEARCH;
    default: return reject_by_earlier(q, found) ? BEGIN_REJECTED : BEGIN_SEARCH;
    }
}

#endif
