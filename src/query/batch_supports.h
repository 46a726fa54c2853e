// The supports of couples in single precision whose bodies have more vertices than the columns of a group hold
// (float_given of simd/float_gjk.h): of each body by its own table, its own columns, or a search of all vertices.
#ifndef OVOID_QUERY_BATCH_SUPPORTS_H
#define OVOID_QUERY_BATCH_SUPPORTS_H

#include "shape/floats.h"

/// The bodies of the lanes at work.
typedef struct float_bodies {
    const ovoid_shape *a[FLOATS], *b[FLOATS];
} float_bodies;

/// Finds the supports of the lanes at work, whose directions are set; kernels: those that go on with them.
void batch_supports_find(float_gjk *g, const float_gjk_kernels *kernels, const float_bodies *bodies);

#endif
