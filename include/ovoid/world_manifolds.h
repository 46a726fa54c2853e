/**
 * @file world_manifolds.h
 * The contact manifolds of a world: of each pair of bodies within a margin the points at which they touch, kept from
 * step to step, and which pairs have begun and ended to be in contact. docs/world.md has the mathematics.
 *
 * A world without manifolds holds no memory for them.
 */
#ifndef OVOID_WORLD_MANIFOLDS_H
#define OVOID_WORLD_MANIFOLDS_H

#include "ovoid/body_manifolds.h"
#include "ovoid/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * What a caller sets of a body for its manifolds; all zero is the default. The world does not use friction and
 * restitution but for those of a pair.
 */
typedef struct ovoid_material {
    double margin; /**< contacts of this body are wanted up to this distance farther; >= 0, at most OVOID_LENGTH_MAX */
    double friction, restitution; /**< >= 0, finite */
} ovoid_material;

/** Sets the material of a body; the next manifolds use it. Errors: INDEX, ARGUMENT (a number), MEMORY. */
OVOID_API ovoid_code ovoid_world_set_material(ovoid_world *world, ovoid_id id, const ovoid_material *material,
                                              ovoid_error *error);
/** The material of a body; all zero if none was set. Errors: INDEX. */
OVOID_API ovoid_code ovoid_world_get_material(const ovoid_world *world, ovoid_id id, ovoid_material *material,
                                              ovoid_error *error);

/** The query of the manifolds of all pairs. */
typedef struct ovoid_world_manifold_query {
    ovoid_manifold_options options; /**< of each manifold. The margin of a pair is options.margin and the ranges of both
                                       bodies; a new options.margin costs a rebuild. No cover is written */
    double ahead; /**< the range of a body is its material's margin, and so many times the way that its points went at
                     most by its last move since the last step, but of that no more than its size; 0 to 100 */
} ovoid_world_manifold_query;

/**
 * Is a pair in contact for the first time? In contact are bodies that are not proven farther apart than their margin:
 * they may still be apart, as the pair's verdict.status says, and a contact that ends may never have touched.
 */
typedef enum ovoid_manifold_event {
    OVOID_MANIFOLD_BEGIN = 0, /**< the manifolds before these had none of this pair */
    OVOID_MANIFOLD_STAY
} ovoid_manifold_event;

/**
 * A pair of bodies that are not proven farther apart than their margin. verdict.lower <= d <= verdict.upper for the
 * smallest signed distance d over all their parts.
 */
typedef struct ovoid_world_manifold {
    ovoid_id a, b;           /**< a < b */
    uint64_t user_a, user_b; /**< stored with the bodies (ovoid_world_body) */
    ovoid_verdict verdict;   /**< limit SHAPE_B: both are solids, and there is no manifold */
    double margin;           /**< of this pair */
    double friction;         /**< the square root of the product of both bodies' */
    double restitution;      /**< the larger one of both bodies' */
    size_t first;            /**< its manifolds: `count` of ovoid_world_manifolds.parts from here on */
    uint32_t count; /**< one for shapes; for compounds one for each pair of parts within the margin; for a solid
                       one for each facet that a part touches, none where they are too deep in one another
                       (ovoid_body_manifolds_find) */
    ovoid_manifold_event event;
} ovoid_world_manifold;

/** A pair that was among the manifolds before these, and is not any more. Its bodies may have been removed. */
typedef struct ovoid_world_parting {
    ovoid_id a, b;
    uint64_t user_a, user_b;
} ovoid_world_parting;

/**
 * The manifolds of a step. The arrays belong to the world and are valid until the next call with a world that is not
 * const.
 */
typedef struct ovoid_world_manifolds {
    const ovoid_world_manifold *items; /**< sorted by a, then b */
    size_t count, begun;               /**< of items; of these, with the event BEGIN */
    const ovoid_world_parting *ended;  /**< sorted by a, then b */
    size_t ended_count;
    const ovoid_body_manifold *parts;    /**< of all items; of each sorted by part_a, then part_b */
    const ovoid_manifold_points *points; /**< beside the parts */
    size_t part_count;
    size_t kept;         /**< of parts: taken over, since neither body moved */
    ovoid_contacts step; /**< the counts of the step, as of ovoid_world_compute_contacts; its arrays are NULL */
} ovoid_world_manifolds;

/**
 * Ends a step as ovoid_world_compute_contacts does, with the manifolds of all pairs that are not proven farther apart
 * than their margin. A manifold is found with that of the same two parts in the last call as the earlier one, and taken
 * over if neither body has moved since. Events compare with the last call too, whatever steps were between. The same
 * bits for any number of threads. Errors: ARGUMENT (query), MEMORY; then nothing is lost, and the call can be repeated.
 * Cost: docs/world.md.
 */
OVOID_API ovoid_code ovoid_world_compute_manifolds(ovoid_world *world, const ovoid_world_manifold_query *query,
                                                   ovoid_world_manifolds *manifolds, ovoid_error *error);

#ifdef __cplusplus
}
#endif
#endif
