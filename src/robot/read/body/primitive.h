// Boxes, spheres and their like, of robots and of scenes: equal ones are one shape.
#ifndef OVOID_ROBOT_READ_BODY_PRIMITIVE_H
#define OVOID_ROBOT_READ_BODY_PRIMITIVE_H

#include "ovoid/robot_io.h"

typedef enum primitive_kind {
    PRIMITIVE_BOX,      ///< full sizes
    PRIMITIVE_SPHERE,   ///< radius
    PRIMITIVE_CAPSULE,  ///< radius, length of its segment
    PRIMITIVE_CYLINDER, ///< radius, length
    PRIMITIVE_CONE,     ///< radius, length
    PRIMITIVE_MESH      ///< none itself: three factors
} primitive_kind;

typedef struct primitive {
    primitive_kind kind;
    double size[3]; ///< those that the kind does not have are 0
} primitive;

/// An order of primitives; 0: equal.
int primitive_compare(const primitive *a, const primitive *b);
/// How many sizes a kind has.
size_t primitive_get_size_count(primitive_kind kind);
/// The shape; not of PRIMITIVE_MESH. Errors as those of its constructor.
ovoid_shape *primitive_create(const primitive *p, const ovoid_robot_read_options *options, ovoid_error *error);

#endif
