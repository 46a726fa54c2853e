/**
 * @file compound.h
 * Compounds: several shapes with poses in one body, and the proximity of shapes and compounds.
 * A compound is immutable: any number of bodies and threads share it. Queries allocate nothing and keep no state; stack
 * as in <ovoid/query.h>.
 */
#ifndef OVOID_COMPOUND_H
#define OVOID_COMPOUND_H

#include "ovoid/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Most parts of a compound. */
#define OVOID_COMPOUND_PARTS_MAX ((size_t)1 << 24)

/**
 * Parts (a shape and its pose in the compound's frame) and a tree over them, in one block of memory. The shapes are
 * borrowed and must outlive it. Parts may overlap, touch or be the same; a part may be a point, a segment or flat.
 *
 * Where part i is in the world, in a body of pose P, is ovoid_pose_compute_product(&P, &part.pose) by definition, with
 * its rounding. So each part is an exact mathematical object, and two parts are an ordinary ovoid_pair.
 */
typedef struct ovoid_compound ovoid_compound;

/**
 * A compound of count >= 1 parts; the array is copied. Returns NULL with *error filled (may be NULL): EMPTY, LIMIT,
 * ARGUMENT (place: a part without a shape), NOT_FINITE, RANGE, ROTATION (place: the part), MEMORY. The caller destroys
 * it. allocator: NULL for malloc; copied into the compound; it also gives working memory, all of which goes back.
 * Cost: the vertices of all parts for each level of the tree; 0.1 ms a part of 32 vertices.
 */
OVOID_API ovoid_compound *ovoid_compound_create(const ovoid_posed_shape *parts, size_t count,
                                                const ovoid_allocator *allocator, ovoid_error *error);
/** Frees it, not its shapes; NULL is allowed. No query may be using it. */
OVOID_API void ovoid_compound_destroy(ovoid_compound *compound);

/** Number of parts. */
OVOID_API size_t ovoid_compound_get_part_count(const ovoid_compound *compound);
/** Part i < part count, with its pose in the compound's frame. */
OVOID_API ovoid_posed_shape ovoid_compound_get_part(const ovoid_compound *compound, size_t i);
/** The parts in the order of the tree: part count indices. Exclusions name ranges of it. A view into the compound. */
OVOID_API const uint32_t *ovoid_compound_get_order(const ovoid_compound *compound);
/** An ellipsoid that encloses all parts, radii included, proven after rounding. Compound's frame. */
OVOID_API ovoid_ellipsoid ovoid_compound_get_outer(const ovoid_compound *compound);
/** The largest inner ellipsoid of a part: it lies in that part, proven after rounding. Q is 0 if no part is solid. */
OVOID_API ovoid_ellipsoid ovoid_compound_get_inner(const ovoid_compound *compound);
/** Size of the block in bytes, without the shapes: about 472 bytes a part. */
OVOID_API size_t ovoid_compound_get_size(const ovoid_compound *compound);

/** Triangles that need not be convex: <ovoid/solid.h>. */
typedef struct ovoid_solid ovoid_solid;

/**
 * A posed shape, compound or solid: exactly one of the three pointers is set. Borrowed. A shape is its part 0, the
 * parts of a solid are its triangles. Pairs with a solid are asked about in <ovoid/solid.h>.
 */
typedef struct ovoid_body {
    const ovoid_shape *shape;
    const ovoid_compound *compound;
    ovoid_pose pose;
    const ovoid_solid *solid;
} ovoid_body;

/** Two bodies. */
typedef struct ovoid_body_pair {
    ovoid_body a, b;
} ovoid_body_pair;

/** The warm start of the next query of a pair of bodies: the parts that decided the last one. Any numbers are safe. */
typedef struct ovoid_compound_proof {
    uint32_t part_a, part_b;
    ovoid_proof proof;
} ovoid_compound_proof;

/**
 * Why pairs of parts do not decide: each part of a at [first_a, end_a) of its tree's order has a signed distance of at
 * least `lower` from each part of b at [first_b, end_b), as the normal shows (normal + normal_low as in ovoid_proof;
 * normal_low is zero but for single pairs). Of a shape the range is [0, 1).
 */
typedef struct ovoid_exclusion {
    uint32_t first_a, end_a, first_b, end_b;
    ovoid_vec3 normal, normal_low; /**< world frame, from a to b */
    double lower;
} ovoid_exclusion;

/**
 * Memory for the proof of a query's answer beside the deciding pair's own proof: sorted exclusions, which with the
 * deciding pair cover all pairs of parts; and for a depth the deciding pair's cover (NULL: none is wanted).
 */
typedef struct ovoid_exclusions {
    ovoid_exclusion *items; /**< the caller's, capacity of them; may be NULL where capacity is 0 */
    size_t capacity;
    size_t count; /**< written: how many there are; more than capacity: the items are not all there */
    ovoid_cover *cover;
} ovoid_exclusions;

/** The answer to a query. */
typedef struct ovoid_compound_answer {
    ovoid_answer answer;     /**< of the deciding pair of parts; but lower, status and limit are those of the bodies:
                                  lower <= d <= upper holds for the smallest signed distance d of all pairs of parts */
    uint32_t part_a, part_b; /**< the deciding pair: 0 for a shape */
    uint32_t visited;        /**< pairs of nodes visited */
    uint32_t tested;         /**< pairs of parts queried */
} ovoid_compound_answer;

/*
 * In all of these d is the smallest signed distance over the pairs of a part of a and a part of b: the distance where
 * the bodies are apart, minus the depth of the deepest pair where they overlap. Options as in <ovoid/query.h>; the
 * relative tolerance is of the pair of bodies' size: the largest |part position| + vertex norm + radius of both (of a
 * shape vertex norm + radius) and the distance of their frames' origins. Refused as there, SHAPE_A or SHAPE_B where a
 * body has neither a shape nor a compound, both, or a solid, and POSE_A or POSE_B where a part would lie beyond
 * OVOID_LENGTH_MAX.
 * earlier: of this pair of bodies, or NULL. exclusions: NULL where no proof is wanted. Two shapes get the bits that
 * ovoid_collide and its sisters give. Cost: a traversal of both trees.
 */

/** Do the bodies touch? Stops at the first two parts that overlap. */
OVOID_API ovoid_compound_answer ovoid_compound_collide(const ovoid_body_pair *pair, const ovoid_options *options,
                                                       const ovoid_compound_proof *earlier,
                                                       ovoid_exclusions *exclusions);
/**
 * Are the bodies within margin (>= 0) of each other? Stops when no two parts are, or when two are and the sign of d is
 * known. Read it with ovoid_answer_is_within.
 */
OVOID_API ovoid_compound_answer ovoid_compound_within(const ovoid_body_pair *pair, double margin,
                                                      const ovoid_options *options, const ovoid_compound_proof *earlier,
                                                      ovoid_exclusions *exclusions);
/** The distance to the tolerance and the nearest parts; where two overlap only that is proven. */
OVOID_API ovoid_compound_answer ovoid_compound_distance(const ovoid_body_pair *pair, const ovoid_options *options,
                                                        const ovoid_compound_proof *earlier,
                                                        ovoid_exclusions *exclusions);
/** The signed distance to the tolerance: where the bodies overlap, minus the depth of the deepest pair of parts. */
OVOID_API ovoid_compound_answer ovoid_compound_depth(const ovoid_body_pair *pair, const ovoid_options *options,
                                                     const ovoid_compound_proof *earlier, ovoid_exclusions *exclusions);

/**
 * Checks an answer without any search: the deciding pair as ovoid_answer_verify does, each exclusion by the supports of
 * all its parts along its normal, and that with the deciding pair they leave out no pair of parts. OVOID_OK, or PROOF
 * with a sentence in *error (may be NULL; place: the exclusion). options: those of the query, or NULL; their relative
 * tolerance is of the bodies' size. exclusions: those of the query; NULL is enough for two shapes. Cost: the parts of
 * all exclusions.
 */
OVOID_API ovoid_code ovoid_compound_answer_verify(const ovoid_body_pair *pair, const ovoid_compound_answer *answer,
                                                  const ovoid_options *options, const ovoid_exclusions *exclusions,
                                                  ovoid_error *error);

#ifdef __cplusplus
}
#endif
#endif
