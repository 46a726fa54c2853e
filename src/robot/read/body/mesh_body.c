// Exact signs decide what a mesh is (ovoid_triangles_compute_hull_match). Cost: linear, plus a tree of what is no hull.
#include "robot/read/body/mesh_body.h"

// The hull with the allowance that keeps brackets true of the triangles.
static ovoid_code allow(mesh_body *body, double allowance, const ovoid_allocator *allocator, ovoid_error *error) {
    ovoid_shape_options options = {.allowance = ovoid_shape_get_allowance(body->shape), .allocator = allocator};
    options.allowance.inside += allowance;
    ovoid_shape *allowed = ovoid_shape_create_allowed(body->shape, &options, error);
    ovoid_shape_destroy(body->shape);
    body->shape = allowed;
    body->allowance = allowance;
    return allowed ? OVOID_OK : error->code;
}

ovoid_code mesh_body_make(const ovoid_triangles *triangles, ovoid_shape *hull, const ovoid_allocator *allocator,
                          mesh_body *body, ovoid_error *error) {
    ovoid_hull_match match;
    *body = (mesh_body){.kind = OVOID_MESH_HULL, .shape = hull};
    ovoid_code code = ovoid_triangles_compute_hull_match(triangles, hull, &match, error);
    if (!code && match.is_hull) {
        if (match.allowance > 0) code = allow(body, match.allowance, allocator, error);
    } else if (!code) {
        body->kind = match.is_closed ? OVOID_MESH_SOLID : OVOID_MESH_SURFACE;
        body->edges_open = match.edges_unmatched;
        body->solid = ovoid_solid_create_from_triangles(triangles, &(ovoid_solid_options){allocator}, error);
        if (!body->solid) code = error->code;
    }
    if (!code) return OVOID_OK;
    ovoid_shape_destroy(body->shape);
    *body = (mesh_body){.kind = OVOID_MESH_HULL};
    return code;
}
