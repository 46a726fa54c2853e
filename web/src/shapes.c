// Shapes: made, read, written, described.
#include "src/exchange.h"

// Numbers 0 to 7: radius, gap, inner method, allowance, its axis.
static ovoid_shape_options read_shape_options(void) {
    const double *x = exchange;
    return (ovoid_shape_options){.radius = x[0],
                                 .gap = x[1],
                                 .inner = (ovoid_inner_method)x[2],
                                 .allowance = {.outside = x[3], .inside = x[4], .axis = {x[5], x[6], x[7]}}};
}

ovoid_shape *EXPORT(shape_from_points)(const double *xyz, size_t count) {
    ovoid_shape_options options = read_shape_options();
    return ovoid_shape_create_from_points(xyz, count, &options, &exchange_error);
}

/// Numbers from 8 on: of a box the half sizes, of an ellipsoid the half axes and the tolerance, else radius, half
/// length, tolerance or sides.
ovoid_shape *EXPORT(shape_create)(int kind) {
    ovoid_shape_options options = read_shape_options();
    const double *x = exchange + 8;
    ovoid_error *e = &exchange_error;
    options.tolerance = kind == 7 ? x[3] : kind == 3 || kind == 4 ? x[2] : 0;
    uint32_t sides = x[2] >= 0 && x[2] <= 1e6 ? (uint32_t)x[2] : 0;
    switch (kind) {
    case 0: return ovoid_shape_create_box((ovoid_vec3){x[0], x[1], x[2]}, &options, e);
    case 1: return ovoid_shape_create_sphere(x[0], &options, e);
    case 2: return ovoid_shape_create_capsule(x[0], x[1], &options, e);
    case 3: return ovoid_shape_create_cylinder(x[0], x[1], &options, e);
    case 4: return ovoid_shape_create_cone(x[0], x[1], &options, e);
    case 5: return ovoid_shape_create_prism(&(ovoid_prism){x[0], x[1], sides}, &options, e);
    case 6: return ovoid_shape_create_pyramid(&(ovoid_prism){x[0], x[1], sides}, &options, e);
    default: return ovoid_shape_create_ellipsoid((ovoid_vec3){x[0], x[1], x[2]}, &options, e);
    }
}

ovoid_shape *EXPORT(shape_read)(const void *bytes, size_t size) {
    return ovoid_shape_read(bytes, size, NULL, &exchange_error);
}
size_t EXPORT(shape_write)(const ovoid_shape *shape, void *buffer, size_t capacity) {
    return ovoid_shape_write(shape, buffer, capacity);
}
void EXPORT(shape_destroy)(ovoid_shape *shape) { ovoid_shape_destroy(shape); }

static double *write_fit(double *to, ovoid_fit f) {
    to = write_sym3(write_vec3(to, f.ellipsoid.center), f.ellipsoid.q);
    *to++ = f.volume, *to++ = f.gap;
    return to;
}

/// Counts of vertices and triangles, rank, radius, allowance, volume, area, centroid, inertia, box, origin, both fits,
/// the allowance's axis, 1 if it is lean.
void EXPORT(shape_describe)(const ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    ovoid_measures m = ovoid_shape_get_measures(shape);
    ovoid_allowance allowance = ovoid_shape_get_allowance(shape);
    double *to = exchange;
    *to++ = p.vertex_count, *to++ = p.triangle_count, *to++ = p.rank;
    *to++ = ovoid_shape_get_radius(shape), *to++ = allowance.outside, *to++ = allowance.inside;
    *to++ = m.volume, *to++ = m.area;
    to = write_sym3(write_vec3(to, m.centroid), m.inertia);
    to = write_vec3(write_vec3(to, m.box.min), m.box.max);
    to = write_vec3(to, p.origin);
    to = write_fit(write_fit(to, ovoid_shape_get_outer(shape)), ovoid_shape_get_inner(shape));
    to = write_vec3(to, allowance.axis);
    *to = ovoid_shape_is_lean(shape);
}

/// Views into the shape: three numbers a vertex, three indices a triangle.
const double *EXPORT(shape_get_vertices)(const ovoid_shape *shape) { return ovoid_shape_get_polytope(shape).vertices; }
const uint32_t *EXPORT(shape_get_triangles)(const ovoid_shape *shape) {
    return ovoid_shape_get_polytope(shape).triangles;
}
