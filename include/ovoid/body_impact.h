/**
 * @file body_impact.h
 * Bodies that move, each a shape, a compound or a solid: when they meet, which of their parts, and the boxes that they
 * sweep.
 */
#ifndef OVOID_BODY_IMPACT_H
#define OVOID_BODY_IMPACT_H

#include "ovoid/body.h"
#include "ovoid/motion.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * A moving shape, compound or solid: exactly one of the three pointers is set. Borrowed. A shape is its part 0; the
 * parts of a solid are its triangles.
 */
typedef struct ovoid_moving_body {
    const ovoid_shape *shape;
    const ovoid_compound *compound;
    ovoid_motion motion;
    const ovoid_solid *solid;
} ovoid_moving_body;

/** Two bodies that move, and the margin (>= 0): they meet when they are within it. */
typedef struct ovoid_moving_body_pair {
    ovoid_moving_body a, b;
    double margin;
} ovoid_moving_body_pair;

/** When two moving bodies come within a margin of each other. */
typedef struct ovoid_body_impact {
    ovoid_impact impact;     /**< status, limit and times of the bodies: free_until is the least of all pairs of parts,
                                hit_at that of the deciding pair. Its steps and answers are those of the deciding pair; none
                                if the bodies are free */
    uint32_t part_a, part_b; /**< the deciding pair: the first that is hit, or is undecided */
    uint32_t visited;        /**< pairs of nodes visited */
    uint32_t tested;         /**< pairs of parts queried */
    size_t group_count;      /**< groups of steps; if more than the capacity, the others were not written */
} ovoid_body_impact;

/**
 * When do two moving bodies first come within the margin of each other? The search is ovoid_impact_find over the pairs
 * of parts, down both trees: the balls around nodes move too, and pairs of nodes whose balls meet later than the first
 * hit found are pruned. Options as in ovoid_impact_find; iterations are those of each pair of parts. Refused as there,
 * and SHAPE_A or SHAPE_B if a body has not exactly one of shape, compound and solid. Allocates nothing; with a solid
 * the stack is 32 KB beside that of <ovoid/motion.h>.
 *
 * With a solid the bodies are queried at the beginning. If they are within the margin there, or one is inside the
 * other, hit_at = begin, and `hit` is the answer of the surfaces with the bracket of the bodies; later nothing gets
 * inside without touching first. Flat faces that meet flush are proven to touch only after they cross, which widens the
 * bracket of the time. Cost: a sweep of two balls or parts for each pair that comes near: some thousands for surfaces
 * that touch.
 */
OVOID_API ovoid_body_impact ovoid_body_impact_find(const ovoid_moving_body_pair *pair,
                                                   const ovoid_motion_options *options);

/**
 * Verifies an impact without a search: the groups leave out no pair of parts, the steps of each group reach free_until
 * with a gap above the margin, the deciding parts are within the margin at hit_at, and times and status follow as in
 * ovoid_impact_verify. Not verified, beside what that function leaves out: `free`, visited, tested. With a solid the
 * bodies are queried at the beginning once more, and containment is computed from all triangles: the bodies must be
 * apart there, or within the margin with a bracket that the claimed bracket contains. basis: with all steps and groups
 * that the query wrote (options.groups). OVOID_OK, or PROOF with a sentence in *error (may be NULL); place: the group.
 * Cost: the steps, the square of the number of groups, and with a solid a query.
 */
OVOID_API ovoid_code ovoid_body_impact_verify(const ovoid_moving_body_pair *pair, const ovoid_body_impact *impact,
                                              const ovoid_motion_basis *basis, ovoid_error *error);

/** Part i of a moving shape or compound, as a moving shape: ovoid_compound defines its pose at a time. */
OVOID_API ovoid_moving_shape ovoid_moving_body_get_part(const ovoid_moving_body *body, size_t i);

/**
 * A box that holds the body at all times of [begin, end], rounding included. For a compound it is made of the balls
 * around at most 16 nodes of its tree, for a solid of those around at most 8. NaN as in ovoid_moving_shape_compute_box.
 */
OVOID_API ovoid_box ovoid_moving_body_compute_box(const ovoid_moving_body *body, double begin, double end);

#ifdef __cplusplus
}
#endif
#endif
