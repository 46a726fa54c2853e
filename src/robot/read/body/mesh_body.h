// What a mesh is: its hull, exactly or with an allowance, the solid that its triangles enclose, or their surface.
#ifndef OVOID_ROBOT_READ_BODY_MESH_BODY_H
#define OVOID_ROBOT_READ_BODY_MESH_BODY_H

#include "ovoid/robot_io.h"

typedef struct mesh_body {
    ovoid_mesh_kind kind; ///< HULL, SOLID or SURFACE
    double allowance;     ///< of a hull: that its shape got
    uint64_t edges_open;  ///< of a surface
    ovoid_shape *shape;   ///< the hull, which answers first
    ovoid_solid *solid;   ///< what counts; NULL: the shape does
} mesh_body;

/// The body of triangles. hull: of their points; it becomes the body's, or is destroyed. On failure there is neither
/// shape nor solid, and *error says why, without a path.
ovoid_code mesh_body_make(const ovoid_triangles *triangles, ovoid_shape *hull, const ovoid_allocator *allocator,
                          mesh_body *body, ovoid_error *error);

#endif
