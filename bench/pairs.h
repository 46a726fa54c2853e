// The benchmark's input: pairs of random convex hulls in uncorrelated orientations, at a distance of a kind.
#ifndef OVOID_BENCH_PAIRS_H
#define OVOID_BENCH_PAIRS_H

#include <ovoid/ovoid.h>

/// How far apart, in sizes (diameters of the bounding sphere).
typedef enum placement {
    PLACE_FAR,  ///< a gap of five
    PLACE_MID,  ///< of one half
    PLACE_NEAR, ///< of one hundredth
    PLACE_OVER, ///< overlapping: the centres are 0.3 apart
    PLACE_COUNT
} placement;

/// "far" and so on.
const char *placement_get_name(placement place);

/// Hulls of so many vertices: points on a sphere, stretched by 1 to 4 along two axes. NULL where one cannot be made.
ovoid_shape **shapes_create(uint32_t vertices, uint32_t count);
void shapes_destroy(ovoid_shape **shapes, uint32_t count);

/// Pairs of neighbours in the list of shapes. Free with free.
ovoid_pair *pairs_create(ovoid_shape **shapes, uint32_t count, placement place);

#endif
