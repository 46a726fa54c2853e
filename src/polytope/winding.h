// How often a closed surface winds around a point.
#ifndef OVOID_POLYTOPE_WINDING_H
#define OVOID_POLYTOPE_WINDING_H

#include "linear/vec3.h"
#include "ovoid/polytope.h"

/// How often the polytope's surface winds around the point, exactly; also 0 if the surface passes through the point, or
/// if exact signs left it open. The triangles must be a closed surface: each directed edge is matched by its opposite.
/// Cost: linear.
int64_t polytope_compute_winding(const ovoid_polytope *polytope, vec3 point);

#endif
