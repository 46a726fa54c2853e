// GJK of two small bodies in one function: both are brought into the world's axes once, and supports, steps and tests
// run without a call. For bodies of few points most of a query's time is the latency of one direction after another:
// direction, values, largest value, its index, its point, the step's candidates, the next direction. Nothing but that
// chain is waited for; bounds are computed beside it, and only branches read them.
//
// E. G. Gilbert, D. W. Johnson, S. S. Keerthi, A fast procedure for computing the distance between complex objects in
// three-dimensional space, 1988. What is unusual (contact to rounding, slivers, no progress) ends the search as OPEN,
// for exact/gjk.c to decide.
#ifndef OVOID_SIMD_SMALL_GJK_H
#define OVOID_SIMD_SMALL_GJK_H

#include "simd/corner.h"
#include "simd/pair.h"

enum { SMALL_GJK_POINTS = 64 };

/// A body's points in the world.
typedef struct small_gjk_body {
    _Alignas(64) double x[SMALL_GJK_POINTS];
    double y[SMALL_GJK_POINTS], z[SMALL_GJK_POINTS];
    uint32_t count; ///< in the scalar twin
} small_gjk_body;

typedef struct small_gjk_bodies {
    small_gjk_body a, b;
} small_gjk_bodies;

/// Points before they are brought into the world.
typedef struct placed_points {
    simd_points points;
    const double *rows; ///< of the rotation to the world; not read where the points are turned already
    const double *at;   ///< their frame's place in the world
} placed_points;

/// The pair, and when its search ends.
typedef struct small_gjk_query {
    simd_points a, b;              ///< body frames, padded; at most SMALL_GJK_POINTS each where it is searched
    const double *rows_a, *rows_b; ///< rotations to the world, by rows
    /// The same points turned by them, padded_count of x, then of y, then of z, without a place; NULL: to be turned.
    const double *turned_a, *turned_b;
    double offset[3]; ///< of B's body frame from A's, world
    double start[3];  ///< the first direction, from A to B, of any length
    double lower_radii, upper_radii, claim;
    double far, near, tolerance; ///< as in the goal of a query (pair/search.h)
    int wants_bracket;
    uint32_t iterations;
} small_gjk_query;

typedef enum small_gjk_end {
    SMALL_GJK_OPEN,   ///< undecided here
    SMALL_GJK_APART,  ///< the gap along n and the support there answer the query: one corner
    SMALL_GJK_NEAR,   ///< the gap along n and the nearest point of the corners answer the query: 1 to 3 corners
    SMALL_GJK_INSIDE, ///< the origin seems to be in the tetrahedron of four corners; n is the first direction
    SMALL_GJK_KEPT ///< as NEAR, of the corners of an earlier search, in lanes 0 to 2, with their weights; of lanes not
                   ///< valid the indices and weights are zero
} small_gjk_end;

typedef struct small_gjk_result {
    corner_lanes at;     ///< differences B minus A in the world,
    uint32_t a[4], b[4]; ///< of these points,
    unsigned valid;      ///< in the lanes of this mask
    uint32_t iterations; ///< steps of the simplex
    small_gjk_end end;
    double n[3];      ///< a direction of any length, world
    double scale;     ///< 1 / |n|
    double gap;       ///< along n, times |n|
    double weight[3]; ///< KEPT: sum 1 to rounding
    double distance;  ///< KEPT: of the weighted point from the origin
    /// Of simd_run_small_gjk, where lane 0 alone is valid: the posed points, from A's body frame, world axes.
    double point_a[3], point_b[3];
} small_gjk_result;

/// Runs the search. The same bits from every instruction set. Every number that comes back but OPEN's is finite; none
/// is a proof: the caller makes the bounds from them.
void simd_run_small_gjk(const small_gjk_query *query, small_gjk_result *result);

/// The same search, with other roundings: the bodies are not posed, each direction is turned into their frames and the
/// points of its support are turned back, with the bits of group_gjk.h.
void simd_run_small_gjk_unposed(const small_gjk_query *query, small_gjk_result *result);

/// The end of a search a moment ago: the points of one to three differences, whose indices the bodies have. Places from
/// `count` on repeat the first.
typedef struct small_gjk_kept {
    uint32_t a[4], b[4], count;
} small_gjk_kept;

/// Runs the search from these differences; query->start is not read. Mostly the nearest point still lies between them,
/// and the first support is the last: it is measured before the bodies are posed.
void simd_run_small_gjk_kept(const small_gjk_query *query, const small_gjk_kept *kept, small_gjk_result *result);

/// The nearest point of kept differences of bodies with any number of points, without a support: KEPT where it lies
/// between all of them, the gap being 0; else OPEN.
void simd_find_kept(const small_gjk_query *query, const small_gjk_kept *kept, small_gjk_result *result);

typedef void small_gjk_function(const small_gjk_query *query, small_gjk_result *result);
typedef void small_gjk_kept_function(const small_gjk_query *query, const small_gjk_kept *kept,
                                     small_gjk_result *result);

/// The function of one instruction set; NULL where this machine or build lacks it.
small_gjk_function *simd_get_small_gjk(simd_isa isa);
small_gjk_function *simd_get_small_gjk_unposed(simd_isa isa);
small_gjk_kept_function *simd_get_small_gjk_kept(simd_isa isa);
small_gjk_kept_function *simd_get_find_kept(simd_isa isa);

#endif
