/**
 * @file decompose.h
 * Decomposition of solids into convex parts, with a proof of its error: by how much the parts must be grown to cover
 * the solid, and by how much they exceed it. docs/decompose.md has the mathematics.
 */
#ifndef OVOID_DECOMPOSE_H
#define OVOID_DECOMPOSE_H

#include "ovoid/solid.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The largest number of parts of a decomposition. */
#define OVOID_DECOMPOSITION_PARTS_MAX 65536

/** A closed solid and the convex parts that approximate it, in its frame. Borrowed. */
typedef struct ovoid_decomposition {
    const ovoid_solid *solid;
    const ovoid_shape *const *parts; /**< without allowances */
    size_t part_count;
} ovoid_decomposition;

/** A length with a proven bracket, and the point that proves its lower end. */
typedef struct ovoid_decomposition_length {
    double lower, upper; /**< 0 <= lower <= upper */
    ovoid_vec3 point;    /**< solid's frame; has no meaning if lower is 0 */
    uint32_t part;       /**< for `uncovered` one of the nearest parts, for `excess` the part that contains the point */
} ovoid_decomposition_length;

/** What is proven about the parts. */
typedef struct ovoid_decomposition_proof {
    /**
     * r: the greatest distance of a point of the solid from its nearest part. Parts that are grown by r cover the
     * solid.
     */
    ovoid_decomposition_length uncovered;
    /** p: the greatest distance of a point of a part from the solid, 0 inside it. */
    ovoid_decomposition_length excess;
    size_t cells; /**< number of cells examined */
} ovoid_decomposition_proof;

/** A callback, called from time to time: done of total, both in units of the present work. */
typedef void (*ovoid_decomposition_progress)(void *context, size_t done, size_t total);

/** Options; all zero, or NULL, is the default. */
typedef struct ovoid_decomposition_options {
    double tolerance; /**< a length: brackets need not be narrower; 0: 1/1000 of the diagonal of the solid's box */
    size_t cells;     /**< the largest number of cells held at a time, 128 bytes each, at least 4096; 0: 2^18 */
    size_t work;      /**< the largest number of cells examined for each of the two lengths; 0: 2^21 */
    double *excesses; /**< of ovoid_decomposition_compute_proof: receives part_count lengths, each at least the part's
                         own p; NULL: not written */
    double error;     /**< of parts created here: the largest excess; 0: see `parts` */
    size_t parts; /**< of parts created here: the largest number; 0: as many as `error` needs; both 0: an error of 1/50
                     of the diagonal */
    const ovoid_allocator *allocator;      /**< of the working memory and of what is created; NULL: malloc and free */
    ovoid_decomposition_progress progress; /**< or NULL */
    void *progress_context;
    ovoid_watch
        watch; /**< asked before each cell, cut and join. If it stops the call: a proof as if the work were used up;
                  parts as cut so far, which cover the solid too, but may exceed it more or be more than `parts` */
} ovoid_decomposition_options;

/**
 * Brackets of both lengths, true whatever the budget. The solid must be closed: it is the set of points of its
 * triangles and of those around which they wind. Errors: ARGUMENT (no solid, no proof, a part with an allowance or
 * NULL: place the part; an option; a solid that is not closed), EMPTY (no parts), LIMIT, MEMORY.
 */
OVOID_API ovoid_code ovoid_decomposition_compute_proof(const ovoid_decomposition *decomposition,
                                                       const ovoid_decomposition_options *options,
                                                       ovoid_decomposition_proof *proof, ovoid_error *error);

/**
 * Verifies a proof from any source against the solid and the parts: the point of each lower end is measured, and each
 * upper end is proven again, by cells that the claim bounds. Of the options work, cells, watch and allocator are used.
 * `cells` of the proof is not a claim. OVOID_OK: both brackets are true. Errors: ARGUMENT with the claim that is false,
 * or too near the truth to be told from rounding (an upper end must be above 0); LIMIT, an upper end that the work was
 * too little to prove; EMPTY, MEMORY as in ovoid_decomposition_compute_proof. Cost: about that of the proof.
 */
OVOID_API ovoid_code ovoid_decomposition_verify(const ovoid_decomposition *decomposition,
                                                const ovoid_decomposition_proof *proof,
                                                const ovoid_decomposition_options *options, ovoid_error *error);

/** Convex parts that own their shapes. */
typedef struct ovoid_parts ovoid_parts;

/**
 * Cuts a closed solid by planes into convex parts. Each part is the hull of the piece of the solid in a cell of the
 * cuts, so together they cover the solid to rounding. Their excess is estimated during the cuts; only
 * ovoid_decomposition_compute_proof proves it. Errors: ARGUMENT (no solid, not closed, an option), LIMIT, MEMORY. The
 * caller destroys the parts.
 */
OVOID_API ovoid_parts *ovoid_parts_create_from_solid(const ovoid_solid *solid,
                                                     const ovoid_decomposition_options *options, ovoid_error *error);

/**
 * Polyhedra that hold all points within `radius` of the given parts, and little more. If parts must be grown by r to
 * cover a solid, these with radius r cover it. Errors: ARGUMENT (a part NULL or with an allowance, a radius below 0),
 * NOT_FINITE, RANGE, MEMORY.
 */
OVOID_API ovoid_parts *ovoid_parts_create_enlarged(const ovoid_decomposition *decomposition, double radius,
                                                   const ovoid_decomposition_options *options, ovoid_error *error);

/** Frees the parts and their shapes; NULL is allowed. */
OVOID_API void ovoid_parts_destroy(ovoid_parts *parts);
/** The number of parts. */
OVOID_API size_t ovoid_parts_get_count(const ovoid_parts *parts);
/** The shapes of the parts: a view. */
OVOID_API const ovoid_shape *const *ovoid_parts_get_shapes(const ovoid_parts *parts);

#ifdef __cplusplus
}
#endif
#endif
