/**
 * @file body.h
 * The proximity of two bodies, each a shape, a compound or a solid: the questions of <ovoid/query.h>, answered by one
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
 * deciding pair cover all pairs of parts; and for a depth the deciding pair's cover (NULL: none is wanted; of a solid
 * it is not used). How many there are is known at the end of a query only. With `grows` the query makes room for them;
 * without, `count` tells how many there are, and the query may be repeated with that capacity.
 */
typedef struct ovoid_exclusions {
    ovoid_exclusion *items; /**< capacity of them; may be NULL where capacity is 0. The caller's, or see grows */
    size_t capacity;
    size_t count; /**< written: how many there are; more than capacity: the items are not all there */
    ovoid_cover *cover;
    int grows; /**< 1: a query that finds too little room takes more from the allocator and releases the items that it
                  was given, which must be NULL or the allocator's. ovoid_exclusions_release ends them. Where memory is
                  out count is above capacity; the answer holds nonetheless. */
    const ovoid_allocator *allocator; /**< of items that grow; NULL: the default one. Must outlive the items */
} ovoid_exclusions;

/** Releases items that grow; then there are none, and no room. Nothing where `grows` is 0, or exclusions is NULL. */
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
 * Without a solid d is the smallest signed distance over the pairs of a part of a and a part of b: the distance where
 * the bodies are apart, minus the depth of the deepest pair where they overlap. `deciding` is the answer of the
 * deciding pair with the bracket of the bodies, and nothing is inside.
 *
 * With a solid d is positive apart, else minus the least translation that parts the bodies; a compound is the union of
 * its parts. `deciding` is the answer of the deciding pair of triangles (of a shape the whole of it, of a compound a
 * part), but its lower end holds for all pairs. SEPARATED: that bracket is d's. OVERLAPPING: deciding.upper < 0, two
 * triangles cross (or one reaches into a shape or a part); or `inside` says which body has a component in the other, at
 * least deciding.lower away from its surface, or that a point lies in both. Else rounding leaves open whether the
 * surfaces cross: upper is theirs, lower what parts the bodies; TOUCHING where that bracket is as narrow as the
 * tolerance, and UNDECIDED where it is not, as of bodies that interlock, or touch around a corner.
 */
typedef struct ovoid_body_answer {
    ovoid_status status;
    ovoid_limit limit;        /**< as in ovoid_answer; of an overlap of solids NONE though no depth is searched for */
    double lower, upper;      /**< of d; -infinity and infinity where refused */
    uint32_t part_a, part_b;  /**< the deciding pair: 0 for a shape, of a solid the triangle */
    uint32_t visited;         /**< pairs of nodes, and of triangles, whose bounds were looked at */
    uint32_t tested;          /**< pairs of parts queried */
    ovoid_body_inside inside; /**< of solids */
    uint32_t component;       /**< the component that is inside; else 0 */
    ovoid_vec3 parting;       /**< of solids: unit, world frame; along it `lower` is shown where it is below 0 */
    ovoid_vec3 common;        /**< COMMON_POINT: the point, frame of a; else 0 */
    ovoid_answer deciding;    /**< of the deciding pair, with points, normal and proof */
} ovoid_body_answer;

/*
 * Options as in <ovoid/query.h>; the relative tolerance is of the pair of bodies' size: the largest |part position| +
 * vertex norm + radius of both (of a shape vertex norm + radius, of a solid the largest point norm) and the distance of
 * their frames' origins. Refused as there, SHAPE_A or SHAPE_B where a body has not exactly one of shape, compound and
 * solid, and POSE_A or POSE_B where a part would lie beyond OVOID_LENGTH_MAX.
 * evidence: NULL, or what is known of this pair of bodies and what is wanted; the exclusions' ranges are of the trees'
 * orders. Two shapes get the bits that ovoid_collide and its sisters give. Cost: a traversal of both trees.
 */

/** What a query of bodies begins with, and what it writes beside its answer. */
typedef struct ovoid_body_evidence {
    const ovoid_body_proof *earlier; /**< of this pair of bodies; NULL: none */
    ovoid_exclusions *exclusions;    /**< receive what proves the answer for all pairs of parts; NULL: not wanted */
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
/** The distance to the tolerance and the nearest parts; where two overlap only that is proven, of solids with a depth.
 */
OVOID_API ovoid_body_answer ovoid_body_distance(const ovoid_body_pair *pair, const ovoid_options *options,
                                                const ovoid_body_evidence *evidence);
/**
 * The signed distance to the tolerance: where the bodies overlap, minus the depth of the deepest pair of parts. With a
 * solid as ovoid_body_distance, as the depth of triangles is not searched for.
 */
OVOID_API ovoid_body_answer ovoid_body_depth(const ovoid_body_pair *pair, const ovoid_options *options,
                                             const ovoid_body_evidence *evidence);

/** 1: proven within the margin (upper <= margin); 0: proven farther (lower > margin); -1: the bracket straddles it. */
OVOID_API int ovoid_body_answer_is_within(const ovoid_body_answer *answer, double margin);
/** The warm start of the pair's next query. */
OVOID_API ovoid_body_proof ovoid_body_answer_get_proof(const ovoid_body_answer *answer);
/** The answer as that of two shapes: the deciding pair's, with status, limit and bracket of the bodies. */
OVOID_API ovoid_answer ovoid_body_answer_get_answer(const ovoid_body_answer *answer);
/** The answer of two bodies without a solid from that of their deciding pair, as it was kept in a file, say. */
OVOID_API ovoid_body_answer ovoid_body_answer_make(const ovoid_answer *deciding, uint32_t part_a, uint32_t part_b);

/** What an answer is verified with, beside its own proof; all zero is the default, and NULL means that. */
typedef struct ovoid_body_basis {
    const ovoid_options *options;       /**< those of the query; NULL: the default */
    const ovoid_exclusions *exclusions; /**< those of the query; NULL is enough for two shapes */
} ovoid_body_basis;

/**
 * Verifies an answer without any search: the deciding pair as ovoid_answer_verify does, each exclusion by all its parts
 * along its normal, that with the deciding pair they leave out no pair of parts, what is inside by the winding numbers
 * of all components, a common point by its distance from all triangles, a depth of solids by all points along
 * `parting`; and that status and limit follow from their brackets and the tolerance. Not claims, and not verified:
 * visited, tested, `parting` of what is apart or has no solid, why a bracket is wide (a limit other than NONE).
 * OVOID_OK, or PROOF with a sentence in *error (may be NULL; place: the exclusion). Cost: the parts of all exclusions,
 * and for each component that is not outside of the other's box all triangles.
 */
OVOID_API ovoid_code ovoid_body_verify(const ovoid_body_pair *pair, const ovoid_body_answer *answer,
                                       const ovoid_body_basis *basis, ovoid_error *error);

#ifdef __cplusplus
}
#endif
#endif
