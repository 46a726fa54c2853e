/**
 * @file solid_impact.h
 * Solids that move, against each other, shapes and compounds: when do they meet, and which triangles?
 */
#ifndef OVOID_SOLID_IMPACT_H
#define OVOID_SOLID_IMPACT_H

#include "ovoid/compound_impact.h"
#include "ovoid/solid.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * When do two moving bodies of any kind first come within margin (>= 0) of each other? As ovoid_compound_impact_find,
 * with triangles as the parts of solids: the balls around nodes of both trees are moved with their bodies. Where they
 * are within the margin at the beginning, or one is inside the other, hit_at = begin, and `hit` is the answer of the
 * surfaces there with the bracket of the bodies; later nothing gets inside that did not touch before. Flat faces that
 * meet flush are proven to touch once they cross: the bracket of the time is as wide as that takes. Options as in
 * ovoid_impact_find. Allocates nothing; stack 32 KB beside what <ovoid/motion.h> says. Cost: a query at the beginning,
 * and a sweep of two balls or triangles for each pair that comes near: some thousands for surfaces that touch.
 */
OVOID_API ovoid_compound_impact ovoid_solid_impact_find(const ovoid_moving_body *a, const ovoid_moving_body *b,
                                                        double margin, const ovoid_motion_options *options);

/**
 * Checks an impact as ovoid_compound_impact_verify does, but for the beginning: that the bodies are apart there, or
 * within the margin with a bracket that holds what is claimed, is asked anew, and what is inside counted over all
 * triangles. options: those of the query, or NULL as there. steps, groups: all that the query wrote (options.groups).
 * OVOID_OK, or PROOF with a sentence in *error (may be NULL); place: the group. Cost: a query, the steps, and the
 * square of the number of groups.
 */
OVOID_API ovoid_code ovoid_solid_impact_verify(const ovoid_moving_body *a, const ovoid_moving_body *b, double margin,
                                               const ovoid_compound_impact *impact, const ovoid_motion_options *options,
                                               const ovoid_step *steps, const ovoid_step_group *groups,
                                               ovoid_error *error);

#ifdef __cplusplus
}
#endif
#endif
