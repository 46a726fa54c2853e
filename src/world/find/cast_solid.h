// Casts against solids: a ray through a solid's tree, and bodies of which one is a solid.
#ifndef OVOID_WORLD_FIND_CAST_SOLID_H
#define OVOID_WORLD_FIND_CAST_SOLID_H

#include "linear/vec3.h"
#include "ovoid/body.h"
#include "ovoid/motion.h"

/// The hit of one part: bracket of its time; upper is infinity if no hit is proven.
typedef struct part_hit {
    uint32_t part, probe; ///< parts of the body and of the probe
    ovoid_impact_status status;
    double lower, upper;
    vec3 point, normal;
} part_hit;

/// The place where a ray first meets a solid; the part is the triangle. The ray must be valid.
part_hit solid_cast_ray(const ovoid_body *body, const ovoid_ray *ray);

/// When a body that moves by `displacement`, without rotation, first meets another; at least one of them is a solid.
part_hit solid_cast_body(const ovoid_body *body, const ovoid_body *moved, vec3 displacement);

#endif
