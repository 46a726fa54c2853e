/**
 * @file decompose.h
 * Solids in convex parts, with a proof of how good the parts are: by how much they must be grown to cover the solid,
 * and by how much they stand out of it. docs/decompose.md has the mathematics.
 */
#ifndef OVOID_DECOMPOSE_H
#define OVOID_DECOMPOSE_H

#include "ovoid/solid.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Most parts of a decomposition. */
#define OVOID_DECOMPOSITION_PARTS_MAX 65536

/** A closed solid and the convex parts that stand for it, in its frame. Borrowed. */
typedef struct ovoid_decomposition {
    const ovoid_solid *solid;
    const ovoid_shape *const *parts; /**< without allowances */
    size_t part_count;
} ovoid_decomposition;

/** A length that is proven to lie between two, and the point that shows the lower one. */
typedef struct ovoid_decomposition_length {
    double lower, upper; /**< 0 <= lower <= upper */
    ovoid_vec3 point;    /**< solid's frame; where lower is 0 it shows nothing */
    uint32_t part;       /**< of `uncovered` one of the nearest parts, of `excess` the part that has the point */
} ovoid_decomposition_length;

/** What is proven of the parts. */
typedef struct ovoid_decomposition_proof {
    /** r: the greatest distance of a point of the solid from its nearest part. Grown by it the parts cover the solid.
     */
    ovoid_decomposition_length uncovered;
    /** p: the greatest distance of a point of a part from the solid, 0 inside it. */
    ovoid_decomposition_length excess;
    size_t cells; /**< looked at */
} ovoid_decomposition_proof;

/** Called from time to time: done of total, both in units of the work at hand. */
typedef void (*ovoid_decomposition_progress)(void *context, size_t done, size_t total);

/** Options; all zero is the default, and NULL means that. */
typedef struct ovoid_decomposition_options {
    double tolerance; /**< a length: brackets need not be narrower; 0: 1/1000 of the diagonal of the solid's box */
    size_t cells;     /**< most cells held at a time, 128 bytes each, at least 4096; 0: 2^18 */
    size_t work;      /**< most cells looked at for each of the two lengths; 0: 2^21 */
    double *excesses; /**< of ovoid_decomposition_compute_proof: receives part_count lengths, no less than each part's
                           own p; NULL: none are wanted */
    double error;     /**< parts made here: no part shall stand out of the solid by more; 0: see `parts` */
    size_t parts; /**< parts made here: at most so many; 0: as many as `error` asks for; both 0: an error of 1/50 of the
                     diagonal */
    const ovoid_allocator *allocator;      /**< of the working memory and of what is created; NULL: malloc and free */
    ovoid_decomposition_progress progress; /**< or NULL */
    void *progress_context;
    ovoid_watch watch; /**< asked before each cell, cut and join; stopped: a proof as though the work were used up;
                          parts as cut by then, which cover too, but stand out farther or are more than `parts` */
} ovoid_decomposition_options;

/**
 * How far the parts are from the solid, both lengths in a bracket that is true whatever the budget. The solid must be
 * closed: it is all points around which its triangles wind, and these. Errors: ARGUMENT (no solid, no proof, a part
 * with an allowance or NULL: place the part; an option; a solid that is not closed), EMPTY (no parts), LIMIT, MEMORY.
 */
OVOID_API ovoid_code ovoid_decomposition_compute_proof(const ovoid_decomposition *decomposition,
                                                       const ovoid_decomposition_options *options,
                                                       ovoid_decomposition_proof *proof, ovoid_error *error);

/**
 * Holds a proof against the solid and the parts, whoever made it: the point of each lower end is measured, and each
 * upper end is shown anew, by cells that are bounded by the claim. Of the options work, cells, watch and allocator
 * count. `cells` of the proof is no claim. OVOID_OK: both brackets are true. Errors: ARGUMENT with the claim that is
 * not so, or not strictly enough to be told from rounding (an upper end must be above 0); LIMIT, an upper end that the
 * work did not show; EMPTY, MEMORY as above. Cost: about that of the proof.
 */
OVOID_API ovoid_code ovoid_decomposition_verify(const ovoid_decomposition *decomposition,
                                                const ovoid_decomposition_proof *proof,
                                                const ovoid_decomposition_options *options, ovoid_error *error);

/** Convex parts that own their shapes. */
typedef struct ovoid_parts ovoid_parts;

/**
 * Cuts a closed solid by planes into convex parts. Each is the hull of what a cell of the cuts leaves of the solid, so
 * together they cover it but for rounding; how far they stand out is estimated while it is cut, and proven by
 * ovoid_decomposition_compute_proof alone. Errors: ARGUMENT (no solid, not closed, an option), LIMIT, MEMORY. The
 * caller destroys the parts.
 */
OVOID_API ovoid_parts *ovoid_parts_create_from_solid(const ovoid_solid *solid,
                                                     const ovoid_decomposition_options *options, ovoid_error *error);

/**
 * Polyhedra that hold all points within `radius` of the parts given, and little more: parts that must be grown by r to
 * cover a solid cover it so. Errors: ARGUMENT (a part NULL or with an allowance, a radius below 0), NOT_FINITE, RANGE,
 * MEMORY.
 */
OVOID_API ovoid_parts *ovoid_parts_create_enlarged(const ovoid_decomposition *decomposition, double radius,
                                                   const ovoid_decomposition_options *options, ovoid_error *error);

/** Frees the parts and their shapes; NULL is allowed. */
OVOID_API void ovoid_parts_destroy(ovoid_parts *parts);
/** How many there are. */
OVOID_API size_t ovoid_parts_get_count(const ovoid_parts *parts);
/** The shapes, one a part: a view. */
OVOID_API const ovoid_shape *const *ovoid_parts_get_shapes(const ovoid_parts *parts);

#ifdef __cplusplus
}
#endif
#endif
