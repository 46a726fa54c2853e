// Eight pairs side by side through the first stages of a query: poses, enclosing spheres, ellipsoids, what a support
// says. Each lane gets the bits that the single query computes (query/frame.c, glance.c, stages.c: the same operations
// in the same order), whatever the instruction set. Lanes that need more than the common case (a quaternion that has to
// be scaled, squares that over- or underflow, a matrix that is not positive definite) are reported, not computed: the
// caller takes them to the single query.
//
// Cost, a pair, one core at 2.8 GHz, AVX-512 (AVX2, scalar): place 10 ns (18, 40), part 31 ns (46, 120), meet 1.3 ns.
#ifndef OVOID_SIMD_OCTET_H
#define OVOID_SIMD_OCTET_H

#include "simd/support.h"

enum { OCTET = 8, OCTET_ALL = 0xff, OCTET_GROUP = 4 };

/// A number of each of the eight pairs.
typedef struct octet_column {
    _Alignas(64) double lane[OCTET];
} octet_column;

/// Eight pairs. Matrices by rows.
typedef struct octet {
    // What `place` finds, and `part` reads.
    octet_column center_a[3], center_b[3]; ///< of the enclosing spheres, body frames
    octet_column first_a[3], first_b[3];   ///< vertex 0, body frames
    octet_column reach, radii, size;       ///< of the pair: sums of both radii; frame.h's s
    octet_column world_a[9], world_b[9];   ///< rotations to the world
    octet_column offset[3];                ///< of B's body frame from A's, world
    octet_column tolerance;
    octet_column line; ///< put in by the caller: 1 where the direction shall be that of the spheres' centres, else 0
    // What `part` finds, and `meet` reads: B in the frame of A, the ellipsoids' direction.
    octet_column rotation[9], translation[3], claim;
    octet_column n[3], low[3]; ///< unit, frame of A, from A to B; minus it in the frame of B
    octet_column inner[3];     ///< a common point of the inner ellipsoids, frame of A
    // What the caller puts in before `meet`: the supports.
    octet_column high_value, low_value;    ///< of A along n, of B along `low`
    octet_column vertex_a[3], vertex_b[3]; ///< the vertices, body frames
    octet_column w[3];                     ///< their difference, found by `meet`
    // The bounds of the latest stage.
    octet_column lower, upper;
} octet;

/// How many columns, from the first one on, are filled before `part`.
enum { OCTET_PLACED = 3 + 3 + 3 + 3 + 3 + 9 + 9 + 3 + 1 + 1 };

/// Where the numbers of the eight pairs are. Body: a number that is not read, position xyz, rotation wxyz. Shape:
/// reach, radius, centre xyz, extent, two that are not read, first vertex xyz, one that is not read.
typedef struct octet_places {
    const double *body_a[OCTET], *body_b[OCTET], *shape_a[OCTET], *shape_b[OCTET];
} octet_places;

/// The ellipsoids'. Outer: centre xyz, Q (xx xy xz yy yz zz), inner centre xyz. Inner: W (6), least radius, largest.
typedef struct octet_ellipsoids {
    const double *outer_a[OCTET], *outer_b[OCTET], *inner_a[OCTET], *inner_b[OCTET];
} octet_ellipsoids;

/// The question, and the constants of the floor above, in parts of the size and as lengths.
typedef struct octet_ask {
    double far, absolute, relative; ///< answered when lower > far; the tolerance, of the size
    double glance, claim;           ///< FRAME_GLANCE, FRAME_CLAIM
    double hidden, length_most;     ///< OVOID_LENGTH_MIN, OVOID_LENGTH_MAX
    int keeps_all;                  ///< `place` fills its columns even where all lanes are apart
} octet_ask;

/// Masks of lanes.
typedef struct octet_found {
    unsigned odd;    ///< not computed: for the single query
    unsigned inner;  ///< a common point proves an overlap; lower, upper are its bounds
    unsigned apart;  ///< lower > far
    unsigned narrow; ///< upper - lower is within the tolerance
} octet_found;

/// Kernels of one instruction set.
typedef struct octet_kernels {
    /// Both bodies in the world, and the enclosing spheres: lower, upper.
    octet_found (*place)(const octet_places *from, const octet_ask *ask, octet *o);
    /// B in the frame of A, inner and outer ellipsoids: lower, upper of those; the direction of the rest. For `count`
    /// eights, at most OCTET_GROUP: together they are faster.
    void (*part)(const octet_ellipsoids *from, const octet_ask *ask, octet *o, unsigned count, octet_found *found);
    /// The bounds of the supports' gap and of their difference w.
    void (*meet)(octet *o);
} octet_kernels;

/// The best of this machine.
const octet_kernels *octet_get_kernels(void);

/// Those of one instruction set, for tests; NULL where this machine or build lacks them.
const octet_kernels *octet_get_kernels_of(simd_isa isa);

#endif
