/**
 * @file compound.h
 * Compounds: several shapes with poses in one body. Queries about them are in <ovoid/body.h>.
 * A compound is immutable: any number of bodies and threads share it.
 */
#ifndef OVOID_COMPOUND_H
#define OVOID_COMPOUND_H

#include "ovoid/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The largest number of parts of a compound. */
#define OVOID_COMPOUND_PARTS_MAX ((size_t)1 << 24)

/**
 * Parts (a shape and its pose in the compound's frame) and a tree over them, in one block of memory. The shapes are
 * borrowed and must outlive it. Parts may overlap, touch or be equal; a part may be a point, a segment or flat.
 *
 * In a body of pose P, the pose of part i in the world is ovoid_pose_compute_product(&P, &part.pose) by definition,
 * with its rounding. So each part is an exact mathematical object, and two parts are an ordinary ovoid_pair.
 */
typedef struct ovoid_compound ovoid_compound;

/** Options of a compound; all zero, or NULL, is the default. */
typedef struct ovoid_compound_options {
    const ovoid_allocator *allocator; /**< NULL: malloc and free; copied. Working memory comes from it too, and is freed
                                         before the call returns */
} ovoid_compound_options;

/**
 * A compound of count >= 1 parts; the array is copied. Returns NULL with *error filled (may be NULL): EMPTY, LIMIT,
 * ARGUMENT (place: a part without a shape), NOT_FINITE, RANGE, ROTATION (place: the part), MEMORY. The caller destroys
 * it. Cost: the vertices of all parts for each level of the tree; 0.1 ms a part of 32 vertices.
 */
OVOID_API ovoid_compound *ovoid_compound_create(const ovoid_posed_shape *parts, size_t count,
                                                const ovoid_compound_options *options, ovoid_error *error);
/** Frees it, not its shapes; NULL is allowed. No query may be using it. */
OVOID_API void ovoid_compound_destroy(ovoid_compound *compound);

/** Number of parts. */
OVOID_API size_t ovoid_compound_get_part_count(const ovoid_compound *compound);
/** Part i < part count, with its pose in the compound's frame. */
OVOID_API ovoid_posed_shape ovoid_compound_get_part(const ovoid_compound *compound, size_t i);
/**
 * The parts in the order of the tree: part count indices. Exclusions name ranges of this array. A view into the
 * compound.
 */
OVOID_API const uint32_t *ovoid_compound_get_order(const ovoid_compound *compound);
/** An ellipsoid that encloses all parts, radii included, proven after rounding. Compound's frame. */
OVOID_API ovoid_ellipsoid ovoid_compound_get_outer(const ovoid_compound *compound);
/** The largest inner ellipsoid of a part: it lies in that part, proven after rounding. Q is 0 if no part is solid. */
OVOID_API ovoid_ellipsoid ovoid_compound_get_inner(const ovoid_compound *compound);
/** Size of the block in bytes, without the shapes: about 472 bytes a part. */
OVOID_API size_t ovoid_compound_get_size(const ovoid_compound *compound);

#ifdef __cplusplus
}
#endif
#endif
