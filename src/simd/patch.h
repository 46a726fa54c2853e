// The kernels of contact polygons: a facet's corners seen along a normal, in columns, with the half-planes of its
// edges; and where the corners of one facet are to the half-planes of another. Up to four lanes wide, as most facets
// have few corners.
#ifndef OVOID_SIMD_PATCH_H
#define OVOID_SIMD_PATCH_H

#include "simd/support.h"

enum {
    PATCH_CORNERS = 64,               ///< most corners of a patch
    PATCH_COLUMN = PATCH_CORNERS + 8, ///< of which columns have room for: a kernel writes whole lanes
    PATCH_SIDES = PATCH_CORNERS + 8
};

/// A convex polygon seen along a normal: x and y across it, z along it. A side is a half-plane across the normal that
/// holds it: of a polygon one for each edge; a segment has two along it and two at its ends, a point four around it.
typedef struct simd_patch {
    uint32_t count, side_count;
    uint32_t vertices[PATCH_COLUMN];         ///< the corners
    double x[PATCH_COLUMN], y[PATCH_COLUMN]; ///< counter-clockwise; the first corner once again at the end
    double z[PATCH_COLUMN];
    double side_x[PATCH_SIDES], side_y[PATCH_SIDES]; ///< unit, to the inner side; zero for an edge of no length
    double side_at[PATCH_SIDES]; ///< the distance to the inner side is side_x x + side_y y - side_at
} simd_patch;

/// The number of places of `count` corners in whole lanes; the caller lists the first vertex again in those behind
/// them.
static inline uint32_t simd_patch_pad(uint32_t count) { return (count + 3) & ~UINT32_C(3); }

/// How vertices are placed: a matrix by rows, and what is added.
typedef struct simd_placing {
    simd_points points;
    double rows[9], shift[3];
} simd_placing;

/// Where the corners of another patch are to a patch's sides.
typedef struct simd_patch_table {
    uint64_t outside[PATCH_SIDES]; ///< of each side: a bit for each corner of the other patch outside of it
    double most[PATCH_SIDES];      ///< of each side: the largest distance of those corners to its inner side
    double least[PATCH_COLUMN];    ///< of each corner of the other patch: the least distance to the inner sides
} simd_patch_table;

/// The kernels of one instruction set; the same bits from each.
typedef struct patch_kernels {
    /// Sets x, y, z and a side for each edge, of a patch whose corners are listed. A point has no edge.
    void (*place)(const simd_placing *placing, simd_patch *patch);
    void (*measure)(const simd_patch *patch, const simd_patch *other, simd_patch_table *table);
} patch_kernels;

/// Those of the widest instruction set of this machine; those of one, for tests, NULL where it is lacking.
const patch_kernels *patch_get_kernels(void);
const patch_kernels *patch_get_kernels_of(simd_isa isa);

#endif
