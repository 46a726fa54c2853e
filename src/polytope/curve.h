// Points along a space-filling curve, so that points near in space are near in memory.
#ifndef OVOID_POLYTOPE_CURVE_H
#define OVOID_POLYTOPE_CURVE_H

#include "base/allocator.h"

#include <stdint.h>

/// The points in their new order. Both arrays are owned.
typedef struct curve {
    double *grid;    ///< x, y, z of each
    uint32_t *given; ///< its index before
} curve;

/// Puts points into the order of the curve through their box; points with equal cells keep their order. 0 if memory
/// runs out; then *c needs no destroying. Cost: linear.
int curve_create(const double *grid, uint32_t count, const ovoid_allocator *allocator, curve *c);
void curve_destroy(curve *c, const ovoid_allocator *allocator);

#endif
