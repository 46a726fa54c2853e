/**
 * @file body.h
 * The proximity of two bodies, each a shape, a compound or a solid: the queries of <ovoid/query.h>, answered by one
 * pair of their parts and proven for all of them.
 * Queries allocate nothing and keep no state. Stack as in <ovoid/query.h>, with a solid 16 KB more, so a thread of 128
 * KB will do.
 */
#ifndef OVOID_BODY_H
#define OVOID_BODY_H

#include "ovoid/compound.h"
#include "ovoid/query.h"
#include "ovoid/solid.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * A posed shape, compound or solid: exactly one of the three pointers is set. Borrowed. A shape is its part 0, the
 * parts of a solid are its triangles.
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

/**
 * The warm start of the next query of a pair of bodies: the parts that decided the last one, and their proof. Made by
 * ovoid_body_answer_get_proof. Any numbers are safe.
 */
typedef struct ovoid_body_proof {
    uint32_t part_a, part_b;
    ovoid_proof proof;
} ovoid_body_proof;

/**
 * A proof that pairs of parts do not decide: each part of a at [first_a, end_a) of its tree's order has a signed
 * distance of at least `lower` from each part of b at [first_b, end_b), along the normal (normal + normal_low as in
 * ovoid_proof; normal_low is zero except for single pairs). The range of a shape is [0, 1).
 */
typedef struct ovoid_exclusion {
    uint32_t first_a, end_a, first_b, end_b;
    ovoid_vec3 normal, normal_low; /**< world frame, from a to b */
    double lower;
} ovoid_exclusion;

/**
 * Memory for the proof of a query's answer beside the deciding pair's own proof: sorted exclusions, which with the
 * deciding pair cover all pairs of parts; and for a depth the deciding pair's cover (NULL: not written; a query with a
 * solid does not use it). Their number is known only at the end of a query. With `grows` the query allocates room for
 * them; without it, repeat the query with a capacity of `count` if there was too little.
 */
typedef struct ovoid_exclusions {
    ovoid_exclusion *items; /**< capacity of them; may be NULL if capacity is 0. Owned by the caller, but see grows */
    size_t capacity;
    size_t count; /**< written: how many there are; if more than capacity, some are missing */
    ovoid_cover *cover;
    int grows; /**< 1: a query that needs more room allocates it and releases the items that it was given, which must be
                  NULL or from the allocator. Free them with ovoid_exclusions_release. If memory runs out, count is
                  above capacity; the answer is still right. */
    const ovoid_allocator *allocator; /**< of items that grow; NULL: the default one. Must outlive the items */
} ovoid_exclusions;

/**
 * Frees items that grow and sets their number and capacity to 0. Does nothing if `grows` is 0 or exclusions is NULL.
 */
OVOID_API void ovoid_exclusions_release(ovoid_exclusions *exclusions);

/** Which body has a point of the other inside, if that is what proves an overlap. */
typedef enum ovoid_body_inside {
    OVOID_BODY_INSIDE_NONE = 0,
    OVOID_BODY_A_INSIDE,    /**< a component of a is inside b; of a compound a part, of a shape the whole of it */
    OVOID_BODY_B_INSIDE,    /**< a component of b is inside a */
    OVOID_BODY_COMMON_POINT /**< neither; `common` is a point of both bodies, away from their surfaces */
} ovoid_body_inside;

/**
 * The answer to a query: lower <= d <= upper.
 *
 * Without a solid d is the smallest signed distance over the pairs of a part of a and a part of b: the distance if the
 * bodies are apart, minus the depth of the deepest pair if they overlap. `deciding` is the answer of the deciding pair
 * with the bracket of the bodies, and `inside` is NONE.
 *
 * With a solid d is the distance if the bodies are apart, else minus the length of the shortest translation that
 * separates them; a compound is the union of its parts. `deciding` is the answer of the deciding pair of triangles (a
 * shape, or a part of a compound, stands in the place of a triangle), but its lower end holds for all pairs. SEPARATED:
 * that bracket is the one of d. OVERLAPPING: deciding.upper < 0, so two triangles cross (or one reaches into a shape or
 * a part); or `inside` says which body has a component in the other, at least deciding.lower away from its surface, or
 * that a point lies in both. Otherwise rounding leaves open whether the surfaces cross: upper is that of the surfaces,
 * lower comes from a separating translation. Then the status is TOUCHING if the bracket is as narrow as the tolerance,
 * else UNDECIDED, for example for bodies that interlock, or touch around a corner.
 */
typedef struct ovoid_body_answer {
    ovoid_status status;
    ovoid_limit limit;   /**< as in ovoid_answer; NONE for an overlap of solids, although no depth is searched for */
    double lower, upper; /**< of d; -infinity and infinity if refused */
    uint32_t part_a, part_b;  /**< the deciding pair: 0 for a shape, of a solid the triangle */
    uint32_t visited;         /**< pairs of nodes, and of triangles, whose bounds were computed */
    uint32_t tested;          /**< pairs of parts queried */
    ovoid_body_inside inside; /**< of solids */
    uint32_t component;       /**< the component that is inside; else 0 */
    ovoid_vec3 parting;       /**< of solids: unit, world frame; the direction of the separating translation that proves
                                 `lower` if it is below 0 */
    ovoid_vec3 common;        /**< COMMON_POINT: the point, frame of a; else 0 */
    ovoid_answer deciding;    /**< of the deciding pair, with points, normal and proof */
} ovoid_body_answer;

/*
 * Options as in <ovoid/query.h>; the relative tolerance is of the size of the pair of bodies: the sum of the largest
 * |part position| + vertex norm + radius of each (of a shape vertex norm + radius, of a solid the largest point norm)
 * and the distance of their frames' origins. Refused as there, and SHAPE_A or SHAPE_B if a body has not exactly one of
 * shape, compound and solid, and POSE_A or POSE_B if a part would lie beyond OVOID_LENGTH_MAX.
 * evidence: NULL, or the warm start of this pair of bodies and room for the proof; the ranges of exclusions are of the
 * trees' orders. For two shapes the answer has the bits of ovoid_collide and its sisters. Cost: a traversal of both
 * trees.
 */

/** The warm start of a query of bodies, and room for what it writes beside its answer. */
typedef struct ovoid_body_evidence {
    const ovoid_body_proof *earlier; /**< of this pair of bodies; NULL: none */
    ovoid_exclusions *exclusions;    /**< receive the proof of the answer for all pairs of parts; NULL: not written */
} ovoid_body_evidence;

/** Do the bodies touch? Stops at the first two parts that overlap. */
OVOID_API ovoid_body_answer ovoid_body_collide(const ovoid_body_pair *pair, const ovoid_options *options,
                                               const ovoid_body_evidence *evidence);
/**
 * Are the bodies within margin (>= 0) of each other? Stops when no two parts are, or when two are and the sign of d is
 * known. Read it with ovoid_body_answer_is_within.
 */
OVOID_API ovoid_body_answer ovoid_body_within(const ovoid_body_pair *pair, double margin, const ovoid_options *options,
                                              const ovoid_body_evidence *evidence);
/**
 * The distance to the tolerance and the nearest parts. Of an overlap only the sign is proven, for solids also a bracket
 * of the depth.
 */
OVOID_API ovoid_body_answer ovoid_body_distance(const ovoid_body_pair *pair, const ovoid_options *options,
                                                const ovoid_body_evidence *evidence);
/**
 * The signed distance to the tolerance: if the bodies overlap, minus the depth of the deepest pair of parts. With a
 * solid the same as ovoid_body_distance, as the depth of triangles is not searched for.
 */
OVOID_API ovoid_body_answer ovoid_body_depth(const ovoid_body_pair *pair, const ovoid_options *options,
                                             const ovoid_body_evidence *evidence);

/** 1: proven within the margin (upper <= margin); 0: proven farther (lower > margin); -1: neither is proven. */
OVOID_API int ovoid_body_answer_is_within(const ovoid_body_answer *answer, double margin);
/** The warm start of the pair's next query. */
OVOID_API ovoid_body_proof ovoid_body_answer_get_proof(const ovoid_body_answer *answer);
/**
 * The answer in the form of an answer of two shapes: that of the deciding pair, with status, limit and bracket of the
 * bodies.
 */
OVOID_API ovoid_answer ovoid_body_answer_get_answer(const ovoid_body_answer *answer);
/** The answer of two bodies without a solid from that of their deciding pair, for example from a file. */
OVOID_API ovoid_body_answer ovoid_body_answer_make(const ovoid_answer *deciding, uint32_t part_a, uint32_t part_b);

/** What an answer is verified with, beside its own proof; all zero, or NULL, is the default. */
typedef struct ovoid_body_basis {
    const ovoid_options *options;       /**< those of the query; NULL: the default */
    const ovoid_exclusions *exclusions; /**< those of the query; NULL is enough for two shapes */
} ovoid_body_basis;

/**
 * Verifies an answer without any search: the deciding pair as in ovoid_answer_verify; each exclusion by all its parts
 * along its normal; that exclusions and deciding pair leave out no pair of parts; containment by the winding numbers of
 * all components; a common point by its distance from all triangles; a depth of solids by all points along `parting`;
 * and that status and limit follow from the brackets and the tolerance. Not verified, since they claim nothing:
 * visited, tested, `parting` of bodies that are apart or have no solid, the reason of a wide bracket (a limit other
 * than NONE). OVOID_OK, or PROOF with a sentence in *error (may be NULL; place: the exclusion). Cost: the parts of all
 * exclusions, and all triangles for each component that is not outside of the other body's box.
 */
OVOID_API ovoid_code ovoid_body_verify(const ovoid_body_pair *pair, const ovoid_body_answer *answer,
                                       const ovoid_body_basis *basis, ovoid_error *error);

#ifdef __cplusplus
}
#endif
#endif
