/**
 * @file prepared.h
 * Shapes prepared at their poses, to query one body often. The rotation of the body and, for a small body, its vertices
 * rotated into the world's axes are computed once, for instance once a frame, and not in each query.
 *
 * The queries return the verdict, and points, proof or answer on request, with the bits of the queries of
 * <ovoid/query.h> for the same pair. Pairs that their spheres separate or that few steps decide take a third to two
 * thirds of the time; docs/performance.md has the numbers.
 */
#ifndef OVOID_PREPARED_H
#define OVOID_PREPARED_H

#include "ovoid/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * The largest number of vertices of a body whose vertices are rotated when it is prepared; for larger bodies only the
 * rotation matrix is prepared.
 */
#define OVOID_PREPARED_VERTICES 32

/**
 * A prepared posed shape. It is plain data that may be copied and read by any number of threads. All fields but `body`
 * belong to the library and must not be changed; to change the pose, prepare the shape again.
 */
typedef struct ovoid_prepared_shape {
    ovoid_posed_shape body;
    double rotation[9]; /**< to the world, by rows */
    ovoid_vec3 center;  /**< of the enclosing sphere, relative to the origin of the body frame, in the world's axes */
    ovoid_vec3 first;   /**< vertex 0, relative to that origin, in those axes */
    uint32_t is_ready;  /**< 0: the shape is refused, or each query has to place it (docs/query.md); 3: the rotation is
                             a matrix that was given, 1: that of the pose */
    uint32_t turned_count; /**< of `turned`, a multiple of 8; 0: none */
    double
        turned[3 * OVOID_PREPARED_VERTICES]; /**< x, then y, then z of the vertices, from that origin, in those axes */
} ovoid_prepared_shape;

/**
 * Prepares a posed shape, whose shape must outlive it. It never fails: the queries refuse an invalid pose or a NULL
 * shape. Cost: 15 to 40 ns.
 */
OVOID_API void ovoid_prepared_shape_make(const ovoid_posed_shape *body, ovoid_prepared_shape *prepared);

/**
 * Prepares a shape at a rotation matrix, by rows, as transforms of Eigen and others hold it; NULL: not rotated. The
 * matrix is used as it is where its columns are those of a rotation to a few roundings, else as ovoid_pose_make_matrix
 * does; `body` has its pose, of which proofs of answers are. Bounds are wider by a part in 1e13 of the size than those
 * of that pose, and vertices are not rotated before a query needs them.
 *
 * Returns OVOID_OK; ARGUMENT where `prepared` is NULL; NOT_FINITE, RANGE and ROTATION as ovoid_pose_make_matrix: then
 * queries refuse the pose. Cost: 10 ns.
 */
OVOID_API ovoid_code ovoid_prepared_shape_make_matrix(const ovoid_shape *shape, const double rotation[9],
                                                      ovoid_vec3 position, ovoid_prepared_shape *prepared);

/**
 * What a query writes beside its verdict. All NULL, or NULL for the whole: nothing.
 */
typedef struct ovoid_evidence {
    ovoid_proof *proof;     /**< the earlier proof of this pair (all zero: none), replaced by the new answer's */
    ovoid_witness *witness; /**< receives points and normal */
    ovoid_answer *answer;   /**< receives the whole answer, which ovoid_answer_verify takes */
} ovoid_evidence;

/** Two prepared shapes, borrowed: passed by value, in two registers where the machine has them. */
typedef struct ovoid_prepared_pair {
    const ovoid_prepared_shape *a, *b;
} ovoid_prepared_pair;

/** ovoid_collide of prepared shapes. */
OVOID_API ovoid_verdict ovoid_prepared_collide(ovoid_prepared_pair pair, const ovoid_options *options,
                                               const ovoid_evidence *evidence);
/** ovoid_within of prepared shapes. Read it with ovoid_verdict_is_within. */
OVOID_API ovoid_verdict ovoid_prepared_within(ovoid_prepared_pair pair, double margin, const ovoid_options *options,
                                              const ovoid_evidence *evidence);
/** ovoid_distance of prepared shapes. */
OVOID_API ovoid_verdict ovoid_prepared_distance(ovoid_prepared_pair pair, const ovoid_options *options,
                                                const ovoid_evidence *evidence);
/** ovoid_depth of prepared shapes, without a cover. */
OVOID_API ovoid_verdict ovoid_prepared_depth(ovoid_prepared_pair pair, const ovoid_options *options,
                                             const ovoid_evidence *evidence);

/** 1: proven within the margin; 0: proven farther; -1: neither is proven. As ovoid_answer_is_within. */
OVOID_API int ovoid_verdict_is_within(const ovoid_verdict *verdict, double margin);

#ifdef __cplusplus
}
#endif
#endif
