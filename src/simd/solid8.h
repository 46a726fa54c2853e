// Kernels of solids: one box against the eight of a node, one triangle against eight. They give lower bounds as
// measured; the caller lowers them by what rounding can do.
#ifndef OVOID_SIMD_SOLID8_H
#define OVOID_SIMD_SOLID8_H

#include "linear/mat3.h"
#include "simd/box8.h"

/// Axes u and v with |u x v|^2 up to this are nearly parallel: no direction across both is tried.
#define SOLID8_PARALLEL 1e-6

/// A box, or the body in it, beside the boxes of a node. Lengths in the user's unit; the node's frame is that of its
/// tree.
typedef struct solid8_other {
    vec3 center;   ///< in the node's frame
    vec3 turned;   ///< half sizes of the box along the node's axes around it
    vec3 half;     ///< its own half sizes, along its own axes
    mat3 rotation; ///< from the node's frame to its own
    mat3 absolute; ///< the sizes of the rotation's entries
    vec3 normal;   ///< a unit direction from the node to it, in the node's frame; zero: none
    double reach;  ///< how far it reaches from its centre along that; infinity: none
    int across;    ///< 1: directions across an axis of each are tried too
    double least;  ///< of these only gaps above it count, what rounding can do at least
    double unit;   ///< of the node's boxes
} solid8_other;

/// Eight triangles: x, y, z of their corners in their own frame.
typedef struct solid8_triangles {
    _Alignas(64) double corner[3][3][BOX8];
} solid8_triangles;

/// A triangle beside eight others, in its own frame.
typedef struct solid8_triangle {
    vec3 corner[3];
    mat3 rotation; ///< of the others' frame to this one
    vec3 translation;
    vec3 normal;   ///< a unit direction to the others, in its own frame
    double enough; ///< a gap above this needs no nearest points
} solid8_triangle;

/// What is measured of eight pairs of triangles.
typedef struct solid8_gaps {
    _Alignas(64) double lower[BOX8]; ///< the gap along the normal
    double upper[BOX8];              ///< the distance of two points of them; infinity where not looked for
    double normal[3][BOX8];          ///< from the one to the eight, in the frame of the one; zero: none was found
} solid8_gaps;

/// Kernels of one instruction set; all give the same bits.
typedef struct solid8_kernels {
    /// For each box of the node: the largest gap along a direction, among the six axes, the lines between the nearest
    /// points of boxes along either's axes, the line of the centres, and the normal given; and |u x v| times the gap
    /// across an axis u of the node and v of the other box.
    void (*boxes)(const box8 *node, const solid8_other *other, double lower[BOX8]);
    void (*triangles)(const solid8_triangle *one, const solid8_triangles *eight, solid8_gaps *out);
} solid8_kernels;

/// The kernels of the widest instruction set of this machine.
const solid8_kernels *solid8_get_kernels(void);
/// The kernels of one instruction set, for tests; NULL where this machine or build lacks them.
const solid8_kernels *solid8_get_kernels_of(simd_isa isa);

#endif
