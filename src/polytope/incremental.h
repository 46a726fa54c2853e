// The convex hull of a few points: one after another is added.
#ifndef OVOID_POLYTOPE_INCREMENTAL_H
#define OVOID_POLYTOPE_INCREMENTAL_H

#include "polytope/quickhull.h"

/// Up to this number of points the incremental hull takes less time than quickhull.
enum { INCREMENTAL_MOST = 128 };

/// Fills the surface of at most INCREMENTAL_MOST points whose rank, 3, and first simplex it has, as quickhull_create
/// does. Errors: MEMORY, HULL; what the surface has then must be destroyed. Cost: the square of the number of points.
ovoid_code incremental_find(const points *p, const ovoid_allocator *allocator, surface *s);

#endif
