// The nearest point of a triangle (C. Ericson, Real-time collision detection, 2004): over its inside by barycentric
// coordinates, else on an edge.
#include "linear/triangle.h"

static vec3 find_on_edge(vec3 a, vec3 b, vec3 x) {
    vec3 e = vec3_sub(b, a);
    double square = vec3_norm_squared(e), t = square > 0 ? vec3_dot(vec3_sub(x, a), e) / square : 0;
    return t <= 0 ? a : t < 1 ? vec3_add_scaled(a, e, t) : b;
}

static vec3 find_on_edges(const vec3 c[3], vec3 x) {
    vec3 best = c[0];
    double least = INFINITY;
    for (int i = 0; i < 3; i++) {
        vec3 p = find_on_edge(c[i], c[(i + 1) % 3], x);
        double d = vec3_norm_squared(vec3_sub(x, p));
        if (d < least) least = d, best = p;
    }
    return best;
}

vec3 triangle_find_nearest(const vec3 c[3], vec3 x) {
    vec3 ab = vec3_sub(c[1], c[0]), ac = vec3_sub(c[2], c[0]), ax = vec3_sub(x, c[0]);
    double d00 = vec3_norm_squared(ab), d01 = vec3_dot(ab, ac), d11 = vec3_norm_squared(ac);
    double d20 = vec3_dot(ax, ab), d21 = vec3_dot(ax, ac), area = d00 * d11 - d01 * d01;
    double v = (d11 * d20 - d01 * d21) / area, w = (d00 * d21 - d01 * d20) / area;
    // If the triangle has nearly no area, or the point is outside of the prism over it, an edge has the nearest point.
    if (!(area > 1e-12 * d00 * d11) || !(v >= 0 && w >= 0 && v + w <= 1)) return find_on_edges(c, x);
    return vec3_add(vec3_add_scaled(c[0], ab, v), vec3_scale(ac, w));
}
