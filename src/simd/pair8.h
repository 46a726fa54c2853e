// A lane group: eight pairs through the first stages of a query (poses, enclosing spheres, ellipsoids, supports). A
// lane has the same bits whatever the instruction set and the other lanes. The operations are those of the single query
// (pair/frame.c, reject.c, stages.c), but the ellipsoids' direction may be improved once and not twice. Lanes that need
// more than the common case (a quaternion that has to be scaled, squares that over- or underflow, a matrix that is not
// positive definite) are reported, not computed: the caller answers them by the single query.
//
// Cost, a pair, one core at 2.8 GHz, AVX-512 (AVX2, scalar): spheres 10 ns (18, 40), ellipsoids 31 ns (46, 120),
// supports 1.3 ns.
#ifndef OVOID_SIMD_PAIR8_H
#define OVOID_SIMD_PAIR8_H

#include "simd/float_gjk.h"
#include "simd/support.h"

#include <stddef.h>

enum { PAIR8 = 8, PAIR8_ALL = 0xff, PAIR8_GROUPS = 4 };

/// One number of each pair of a lane group.
typedef struct lane_column {
    _Alignas(64) double lane[PAIR8];
} lane_column;

/// The state of a lane group. Matrices by rows.
typedef struct pair8 {
    // Written by `spheres`, read by `ellipsoids`.
    lane_column center_a[3], center_b[3]; ///< of the enclosing spheres, body frames
    lane_column first_a[3], first_b[3];   ///< vertex 0, body frames
    lane_column reach, radii, size;       ///< of the pair: sums of both radii; frame.h's s
    lane_column world_a[9], world_b[9];   ///< rotations to the world
    lane_column offset[3], between[3];    ///< of B's body frame from A's, of the spheres' centres, world
    lane_column tolerance;
    lane_column line; ///< set by the caller: 1 to take the direction of the spheres' centres, 0 for the ellipsoids'
    // Written by `ellipsoids`, read by `supports`: B in the frame of A, the ellipsoids' direction.
    lane_column rotation[9], translation[3], claim;
    lane_column n[3], low[3]; ///< unit, frame of A, from A to B; minus it in the frame of B
    lane_column inner[3];     ///< a common point of the inner ellipsoids, frame of A
    // Set by the caller before `supports`.
    lane_column high_value, low_value;    ///< of A along n, of B along `low`
    lane_column vertex_a[3], vertex_b[3]; ///< the vertices, body frames
    // The bounds of the latest stage.
    lane_column lower, upper;
    unsigned count; ///< set by the caller: the lanes in use are the first so many, 1 to 8
} pair8;

/// The places of the numbers of a lane group's bodies and shapes. Pose: position xyz, rotation wxyz. Shape: radius,
/// extent, centre xyz, reach, two that are not read, first vertex xyz, one that is not read.
typedef struct pair8_places {
    const double *pose_a[PAIR8], *pose_b[PAIR8], *shape_a[PAIR8], *shape_b[PAIR8];
} pair8_places;

/// The places of the numbers of the ellipsoids. Outer: centre xyz, Q (xx xy xz yy yz zz), inner centre xyz. Inner: W
/// (6), least radius, largest.
typedef struct pair8_ellipsoids {
    const double *outer_a[PAIR8], *outer_b[PAIR8], *inner_a[PAIR8], *inner_b[PAIR8];
} pair8_ellipsoids;

/// The goal of the queries, and the constants of the floor above, in parts of the size and as lengths.
typedef struct pair8_query {
    double far, near, absolute, relative; ///< answered when lower > far, or 0 < lower and upper <= near; the tolerance,
                                          ///< of the size
    double reject, claim;                 ///< FRAME_REJECT, FRAME_CLAIM
    double hidden, length_most;           ///< OVOID_LENGTH_MIN, OVOID_LENGTH_MAX
    uint32_t iterations;                  ///< most steps of a search
    int rounds;                           ///< how often the ellipsoids' direction is improved, 1 or 2
    int keeps_all;                        ///< `spheres` fills its columns even where the origins part all lanes
} pair8_query;

/// Masks of lanes.
typedef struct pair8_found {
    unsigned odd;    ///< not computed: left to the single query
    unsigned inner;  ///< a common point proves an overlap; lower, upper are its bounds
    unsigned apart;  ///< lower > far
    unsigned origin; ///< of `apart`: by the spheres around the origins of the body frames, whose bounds these are
    unsigned narrow; ///< upper - lower is within the tolerance
} pair8_found;

/// Common points of the inner ellipsoids, in the body frame of A, and the upper bounds that they prove.
typedef struct pair8_common {
    lane_column x[3], upper;
} pair8_common;

/// A lane group on its way through the ellipsoids.
typedef struct pair8_group {
    pair8_ellipsoids from;
    pair8 *lanes;
    pair8_found found;
} pair8_group;

/// The pairs in single precision, each in its own unit, for bodies without radii: the first columns of float_query,
/// from the rotation to the claim.
typedef struct pair8_floats {
    _Alignas(32) float numbers[FLOAT_NUMBERS][PAIR8];
    lane_column unit, scale; ///< a power of two; 1 / unit
} pair8_floats;

/// Kernels of one instruction set.
typedef struct pair8_kernels {
    /// Places both bodies in the world and computes the bounds of the enclosing spheres: lower, upper. The spheres
    /// around the frames' origins come first, as they need no rotation.
    pair8_found (*spheres)(const pair8_places *from, const pair8_query *query, pair8 *o);
    /// Inner ellipsoids in the world, after `spheres`, as inner_compute_upper_in_world has them: the mask of the pairs
    /// that have a common point. Of `from` the outer ellipsoids' numbers are not read.
    unsigned (*inner)(const pair8_ellipsoids *from, const pair8_query *query, const pair8 *o, pair8_common *out);
    /// B in the frame of A, inner and outer ellipsoids: lower and upper where these decide, the direction for the other
    /// lanes. For `count` lane groups, at most PAIR8_GROUPS: together they are faster.
    void (*ellipsoids)(pair8_group *groups, unsigned count, const pair8_query *query);
    /// The bounds of the supports' gap and of their difference w.
    void (*supports)(pair8 *o);
    /// The pairs in single precision, after `spheres`. The mask of those whose lengths allow it.
    unsigned (*floats)(const pair8 *o, const pair8_query *query, pair8_floats *out);
} pair8_kernels;

/// The kernels for lane groups of so many pairs: of the widest instruction set of this machine that they fill.
const pair8_kernels *pair8_get_kernels(size_t pairs);

/// The kernels of one instruction set, for tests; NULL where this machine or build lacks them.
const pair8_kernels *pair8_get_kernels_of(simd_isa isa);

#endif
