// Moving bodies as trees, and the moving balls around their nodes.
#ifndef OVOID_COMPOUND_COMPOUND_IMPACT_H
#define OVOID_COMPOUND_COMPOUND_IMPACT_H

#include "body/body_view.h"
#include "linear/box.h"
#include "ovoid/compound_impact.h"
#include "shape/point.h"

/// The tree of a moving body, with parts in the body's own frame. 0 where the body has neither a shape nor a compound,
/// or both.
int moving_view_make(const ovoid_moving_body *body, body_view *view);

/// The part at a place of the order, as a moving shape.
ovoid_moving_shape moving_view_get_part(const ovoid_moving_body *body, const body_view *view, uint32_t place);

/// Takes the impact of another pair of parts into that of the bodies; free_until: the least of all pairs that are not
/// free. 1: this pair decides, a hit before all others, or undecided where there is no hit yet.
static inline int impact_take_pair(ovoid_impact *best, const ovoid_impact *x, double *free_until) {
    uint32_t all = best->iterations + x->iterations;
    int is_first = x->status == OVOID_IMPACT_HIT || (x->status == OVOID_IMPACT_UNDECIDED &&
                                                     best->status != OVOID_IMPACT_HIT && x->free_until < *free_until);
    if (x->status != OVOID_IMPACT_FREE && x->free_until < *free_until) *free_until = x->free_until;
    if (is_first) *best = *x;
    best->iterations = all;
    return is_first;
}
/// At the end: another pair may have been proven free for a shorter time without being hit.
static inline void impact_finish_pairs(ovoid_impact *best, double free_until) {
    if (!(free_until < best->free_until)) return;
    best->free_until = free_until;
    if (best->limit == OVOID_LIMIT_NONE) best->limit = OVOID_LIMIT_PRECISION;
}

/// 1 if two groups have no pair of parts in common.
static inline int step_groups_are_apart(const ovoid_step_group *x, const ovoid_step_group *y) {
    return x->end_a <= y->first_a || y->end_a <= x->first_a || x->end_b <= y->first_b || y->end_b <= x->first_b;
}

/// ovoid_moving_body_compute_box of a shape or a compound.
box moving_body_compute_box(const ovoid_moving_body *body, double begin, double end);

/// The ball around a node, as a moving shape; *ball holds its shape and must outlive it.
ovoid_moving_shape moving_node_make_sphere(const ovoid_moving_body *body, const compound_node *node, point_shape *ball);

#endif
