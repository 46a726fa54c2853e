/**
 * @file body_manifolds.h
 * The manifolds of two bodies, part by part: each pair of parts within a margin has a manifold of its own, as
 * <ovoid/manifold.h> describes it. Of a solid the parts are its flat facets (docs/contact.md): triangles in one plane
 * that share points count as one, so an edge between them has no contact of its own. A facet is named by its largest
 * triangle, the one with the lowest index of equal ones.
 *
 * A manifold of a solid differs in what it claims. The bracket is that of the separation along the normal, between the
 * part and the plane across it through the facet's points: PROOF_NORMAL. No other direction is ruled out, as a solid
 * has no least translation that a facet could show. The normal is the facet's (FACE_A or FACE_B), or that of a facet of
 * the part, or a direction that a search found, and then the solid rises nowhere beside the contact along it. Vertices
 * in ids and features are points of the solid, edges 3 t + i: that of triangle t from its corner i to the next; a facet
 * is named by its triangle. The polygon is the convex hull of the corners: a facet with a hole or a bay may be out of
 * contact inside of it. Of a surface that is not closed the side on which the part's centre lies is the outer one.
 * Queries allocate nothing and keep no state. Stack as in <ovoid/body.h>.
 */
#ifndef OVOID_BODY_MANIFOLDS_H
#define OVOID_BODY_MANIFOLDS_H

#include "ovoid/body.h"
#include "ovoid/manifold.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The manifold of a part of a and a part of b: indices of the compound's parts, 0 for a shape, the facet's triangle
 * for a solid. */
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
    uint32_t through; /**< written: facets of a solid that a part has gone through, out of the other side: they have no
                         manifold, since their normal would push it the wrong way */
} ovoid_body_manifolds;

/**
 * The manifolds of all pairs of parts that are not proven farther apart than options->margin, each with the bits of
 * ovoid_manifold_find of the two parts and their manifold in `earlier`. Cover and points of the options are not used.
 * Returns NONE, or why the query is refused, and
 * then there are no manifolds: as for ovoid_body_collide, OPTIONS for those that ovoid_manifold_find refuses, and
 * SHAPE_B where both bodies are solids, which is not answered. With a solid, lower and upper are those of
 * ovoid_body_within; if they do not part the bodies and there is no manifold, the bodies are too deep in one another
 * for a normal of a facet near them to lead out. Cost: a traversal of both trees, and a manifold for each pair of parts
 * near each other; with a solid that of ovoid_body_within, of the facets near each part, and of a query of two shapes
 * for each triangle near it that has an edge at which only that may touch.
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
