// Bodies that are parallelepipeds, for example boxes, however they were made.
#ifndef OVOID_SHAPE_PARALLELEPIPED_H
#define OVOID_SHAPE_PARALLELEPIPED_H

#include "ovoid/polytope.h"

/// Corners are center +- axis[0] +- axis[1] +- axis[2], each to within 11 u of the body's extent. Body frame.
typedef struct parallelepiped {
    ovoid_vec3 center;
    ovoid_vec3 axis[3];  ///< half edges, right-handed or left-handed
    uint8_t corner[8];   ///< the vertex whose coefficient of axis[k] is positive where bit k is set
    uint32_t is_present; ///< 0: the body is not a parallelepiped; then all other fields are zero
    uint16_t is_right;   ///< 1: a box, whose axes are at right angles, to rounding; else what follows is zero
    uint16_t is_upright; ///< 1: the unit vectors are those of the frame
    double half[3];      ///< lengths of the half edges
    ovoid_vec3 unit[3];  ///< axis[k] is half[k] unit[k], to rounding
} parallelepiped;

/// The parallelepiped with these corners. extent: no vertex is farther from the frame's origin. Cost: none unless there
/// are 8 vertices.
parallelepiped parallelepiped_find(const double *vertices, uint32_t count, double extent);

/// That of a box in closed form (polytope/centered_box.h).
parallelepiped parallelepiped_make_centered(ovoid_vec3 half);

#endif
