/**
 * @file body_manifolds.h
 * The manifolds of two bodies, part by part: each pair of parts within a margin has a manifold of its own, as
 * <ovoid/manifold.h> describes it.
 * Queries allocate nothing and keep no state. Stack as in <ovoid/body.h>.
 */
#ifndef OVOID_BODY_MANIFOLDS_H
#define OVOID_BODY_MANIFOLDS_H

#include "ovoid/body.h"
#include "ovoid/manifold.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The manifold of a part of a and a part of b: indices of the compound's parts, 0 for a shape. */
typedef struct ovoid_body_manifold {
    uint32_t part_a, part_b;
    ovoid_manifold manifold;
} ovoid_body_manifold;

/** Memory for the manifolds of two bodies, and the manifolds of their last query. */
typedef struct ovoid_body_manifolds {
    ovoid_body_manifold *items;    /**< capacity of them, owned by the caller; may be NULL if capacity is 0. Written:
                                     sorted by part_a, then part_b */
    ovoid_manifold_points *points; /**< capacity of them, or NULL: receive the points, beside the items */
    size_t capacity;
    size_t count; /**< written: how many manifolds there are; if more than capacity, some are missing, and the query can
                     be repeated with more room */
    const ovoid_body_manifold *earlier; /**< items of the last query of these bodies, complete or not, in their order;
                                          NULL: none. Not the same memory as items */
    size_t earlier_count;
    double lower, upper; /**< written: the bracket of the smallest signed distance over all pairs of parts; above the
                            margin only `lower` is narrow. -infinity and infinity if refused */
    uint32_t visited;    /**< written: pairs of nodes whose bounds were computed */
    uint32_t tested;     /**< written: pairs of parts whose manifold was looked for */
} ovoid_body_manifolds;

/**
 * The manifolds of all pairs of parts that are not proven farther apart than options->margin, each with the bits of
 * ovoid_manifold_find of the two parts and their manifold in `earlier`. Cover and points of the options are not used.
 * Returns NONE, or why the query is refused, and
 * then there are no manifolds: as for ovoid_body_collide, OPTIONS for those that ovoid_manifold_find refuses, and
 * SHAPE_A or SHAPE_B also for a solid, since the triangles of a surface have no inside that would tell through which of
 * their sides two bodies part. Cost: a traversal of both trees, and a manifold for each pair of parts near each other.
 */
OVOID_API ovoid_limit ovoid_body_manifolds_find(const ovoid_body_pair *pair, const ovoid_manifold_options *options,
                                                ovoid_body_manifolds *manifolds);

/** The points of one manifold of these bodies at their present poses; count is 0 where a part does not exist. */
OVOID_API ovoid_manifold_points ovoid_body_manifold_compute_points(const ovoid_body_pair *pair,
                                                                   const ovoid_body_manifold *manifold);

/**
 * Verifies one manifold without a search: ovoid_manifold_verify of its two parts. OVOID_OK, or PROOF with a sentence in
 * *error (may be NULL; place: 0, part_a does not exist; 1, part_b).
 */
OVOID_API ovoid_code ovoid_body_manifold_verify(const ovoid_body_pair *pair, const ovoid_body_manifold *manifold,
                                                const ovoid_manifold_options *options, ovoid_error *error);

#ifdef __cplusplus
}
#endif
#endif
