// GJK of the couples of a lane group (pair8.h), from the spheres or the ellipsoids to the answer without leaving the
// lanes. Bodies are never posed: a direction is turned into both body frames, and the vertices of the supports are
// turned back, for eight couples at once. A support is the couple's own, and eight that do not wait for one another
// fill the pipeline; the steps of the simplex are in lanes.
//
// Lanes that end wait for the slowest one: this costs less than to pose the bodies and to fill the lanes again
// (docs/query.md).
#ifndef OVOID_SIMD_GROUP_GJK_H
#define OVOID_SIMD_GROUP_GJK_H

#include "simd/gjk8.h"

/// The nearest points of eight couples, from one to three corners each.
typedef struct group_nearest {
    lane_column weight[3];              ///< of the corners, zero of those that are none
    lane_column point_a[3], point_b[3]; ///< of the cores, world, from the origin of A's body frame
    lane_column normal[3];              ///< unit, world
    lane_column lower, upper;
} group_nearest;

/// Corners whose search proved nothing (float_gjk.h).
typedef struct group_corners {
    const double *a[3][PAIR8], *b[3][PAIR8];      ///< vertices, xyz, body frames; of all lanes, those that are none too
    lane_column count;                            ///< 1 to 3
    simd_points points_a[PAIR8], points_b[PAIR8]; ///< of the lanes asked for: at most SMALL_GJK_POINTS
    lane_column along_a[3], along_b[3];           ///< written by `measure`: the direction in the body frames
    lane_column n[3], scale, high, low;           ///< and in the world, 1 / |n|, the supports' values
    unsigned good;                                ///< and the lanes whose numbers are finite
} group_corners;

typedef struct group_gjk {
    gjk8 search;
    int is_along_n; ///< set by the caller: 1 to begin along o->n of the ellipsoids, 0 for the line of centres
    simd_points points_a[PAIR8], points_b[PAIR8]; ///< set by the caller for the lanes at work: at most SMALL_GJK_POINTS
    /// The vertices of the same bodies, xyz; of lanes at work set by the caller.
    const double *vertices_a[PAIR8], *vertices_b[PAIR8];
    lane_column along_a[3], along_b[3];              ///< the heading in the body frames
    lane_column high, low;                           ///< the latest supports: A's and B's values,
    const double *vertex_a[PAIR8], *vertex_b[PAIR8]; ///< and vertices, body frames
    lane_column count;                               ///< set by the caller before `finish`: corners, 1 to 3,
    lane_column corner[3 * 3];                       ///< their differences, world,
    lane_column corner_a[3 * 3];                     ///< and A's vertices, body frame
} group_gjk;

/// Kernels of one instruction set. The group has gone through `spheres`.
typedef struct group_gjk_kernels {
    /// Begins all lanes; those at work are in s->search.active, and its near, far and
    /// wants_bracket are set.
    void (*begin)(const pair8 *o, const pair8_query *query, group_gjk *s);
    /// The supports of the lanes at work along the heading. Nothing of the others changes.
    void (*support)(const pair8 *o, group_gjk *s);
    /// The first support becomes the simplex, and may be the answer already. Lanes that end are at work no more.
    gjk8_ends (*start)(group_gjk *s);
    /// A step to a later support of all lanes at work. gjk8_get_result finds what lanes ended with.
    gjk8_ends (*advance)(gjk8 *g);
    /// The bounds, weights and nearest points of the lanes of a mask, which ended near.
    void (*finish)(const pair8 *o, unsigned lanes, const group_gjk *s, group_nearest *out);
    /// The same of corners that a search in single precision ended with: the direction is made from them, and the gap
    /// along it measured. Lanes that are not `good` are written too.
    void (*measure)(const pair8 *o, const pair8_query *query, unsigned lanes, group_corners *from, group_nearest *out);
} group_gjk_kernels;

/// The kernels for lane groups of so many pairs: of the widest instruction set of this machine that they fill.
const group_gjk_kernels *group_gjk_get_kernels(size_t pairs);

/// The kernels of one instruction set, for tests; NULL where this machine or build lacks them.
const group_gjk_kernels *group_gjk_get_kernels_of(simd_isa isa);

#endif
