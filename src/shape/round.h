// Is a polyhedron inscribed in a cylinder, cone or ellipsoid?
#ifndef OVOID_SHAPE_ROUND_H
#define OVOID_SHAPE_ROUND_H

#include "shape/block.h"

/// 1 if the shape's vertices are those of a prism, pyramid or polygon inscribed in the body, to the `inside` of its
/// allowance, and the body exceeds it by no more than `outside`, across z; or those of the polyhedron of an ellipsoid.
int round_is_held(const ovoid_shape *shape, const ovoid_round *round);

#endif
