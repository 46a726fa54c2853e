// The frame along a body's own extents: the longest extent along a coordinate, the farthest vertex across it, and the
// normal of both. Cost: some ten passes over the vertices.
#include "ellipsoid/frame.h"

// The points with the smallest and the largest n . x.
static void find_extremes(const ovoid_polytope *p, vec3 n, uint32_t extreme[2]) {
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < p->vertex_count; i++) {
        double x = vec3_dot(n, vec3_at(p->vertices, i));
        if (x < low) low = x, extreme[0] = i;
        if (x > high) high = x, extreme[1] = i;
    }
}

// b minus its part along the unit vector a, subtracted twice, so that rounding leaves nothing of it.
static vec3 reject(vec3 b, vec3 a) {
    b = vec3_add_scaled(b, a, -vec3_dot(a, b));
    return vec3_add_scaled(b, a, -vec3_dot(a, b));
}

// The unit direction from the line through `origin` along a to the vertex that is farthest from it.
static vec3 find_across(const ovoid_polytope *p, vec3 origin, vec3 a) {
    vec3 best = {0, 0, 0};
    double most = 0;
    for (uint32_t i = 0; i < p->vertex_count; i++) {
        vec3 d = reject(vec3_sub(vec3_at(p->vertices, i), origin), a);
        double size = vec3_max_abs(d);
        if (size > most) most = size, best = d;
    }
    return most > 0 ? vec3_unit(reject(vec3_unit(best), a)) : vec3_orthogonal(a);
}

// Half of the extent of the vertices along a (1 if there is none), and the middle.
static double measure(const ovoid_polytope *p, vec3 origin, vec3 a, double *middle) {
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < p->vertex_count; i++) {
        double x = vec3_dot(a, vec3_sub(vec3_at(p->vertices, i), origin));
        low = fmin(low, x);
        high = fmax(high, x);
    }
    *middle = low + (high - low) / 2;
    return high > low ? (high - low) / 2 : 1;
}

frame frame_compute(const ovoid_polytope *p, uint32_t rank) {
    frame f = {.rank = rank};
    const double *vertices = p->vertices;
    // The longest extent along a coordinate gives the first axis.
    double most = -1;
    uint32_t end[2] = {0, 0}, extreme[2];
    for (int i = 0; i < 3; i++) {
        vec3 n = {i == 0, i == 1, i == 2};
        extreme[0] = extreme[1] = 0;
        find_extremes(p, n, extreme);
        double size = vec3_dot(n, vec3_sub(vec3_at(vertices, extreme[1]), vec3_at(vertices, extreme[0])));
        if (size > most) most = size, end[0] = extreme[0], end[1] = extreme[1];
    }
    vec3 origin = vec3_at(vertices, end[0]), along = vec3_unit(vec3_sub(vec3_at(vertices, end[1]), origin));
    // Across it, toward the farthest vertex; then across both differences found.
    vec3 across = find_across(p, origin, along), normal = vec3_cross(along, across);
    if (rank >= 2) {
        find_extremes(p, across, extreme);
        vec3 second = vec3_sub(vec3_at(vertices, extreme[1]), vec3_at(vertices, extreme[0]));
        normal = vec3_unit(reject(vec3_cross(along, vec3_unit(reject(second, along))), along));
    }
    f.axes = (mat3){along, vec3_cross(normal, along), normal};
    // The box.
    vec3 middle = {0, 0, 0};
    f.half.x = f.half.y = f.half.z = measure(p, origin, f.axes.r0, &middle.x);
    if (rank >= 2) f.half.y = measure(p, origin, f.axes.r1, &middle.y);
    if (rank >= 3) f.half.z = measure(p, origin, f.axes.r2, &middle.z);
    f.origin = vec3_add(origin, mat3_mul_transposed_vec3(f.axes, middle));
    return f;
}

void frame_fill_local(const frame *f, const ovoid_polytope *p, double *local) {
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        vec3 y = mat3_mul_vec3(f->axes, vec3_sub(vec3_at(p->vertices, v), f->origin));
        local[3 * (size_t)v] = y.x / f->half.x;
        local[3 * (size_t)v + 1] = f->rank >= 2 ? y.y / f->half.y : 0;
        local[3 * (size_t)v + 2] = f->rank >= 3 ? y.z / f->half.z : 0;
    }
}
