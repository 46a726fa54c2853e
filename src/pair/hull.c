// The depth of the origin in the hull of four to six points: by determinants, or by the surface (cover.c).
#include "pair/hull.h"

#include "pair/cover.h"

static const uint16_t tetrahedron[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

// A tetrahedron by its determinants: the origin is inside iff the four have one sign. A determinant of corners off by
// `error` is off by 4 reach^2 error, its evaluation by 64 u reach^3; a cross product by 8 reach (error + 4 u reach).
// The corners have about unit length, so that no square loses digits to underflow. 0: in doubt; -1: outside.
static double compact_tetrahedron_depth(const vec3 w[4], double reach, double error) {
    double slack = reach * reach * (4 * error + 64 * 0x1p-53 * reach), depth = INFINITY;
    int above = 0, below = 0;
    for (int i = 0; i < 4; i++) {
        vec3 a = w[tetrahedron[i][0]], b = w[tetrahedron[i][1]], c = w[tetrahedron[i][2]];
        double det = vec3_dot(a, vec3_cross(b, c));
        above += det > slack;
        below += det < -slack;
        double area = vec3_norm(vec3_cross(vec3_sub(b, a), vec3_sub(c, a))) + 8 * reach * (error + 4 * 0x1p-53 * reach);
        depth = min2(depth, (fabs(det) - slack) / area * (1 - 0x1p-50));
    }
    if (above > 0 && below > 0) return -1;
    return above == 4 || below == 4 ? depth : 0;
}

// compact_tetrahedron_depth in units of the corners' size.
static double tetrahedron_depth(const vec3 w[4], double error) {
    double reach = 0;
    for (int i = 0; i < 4; i++) reach = max2(reach, vec3_max_abs(w[i]));
    if (reach > 1e-60 && reach < 1e60) return compact_tetrahedron_depth(w, 2 * reach, error);
    double unit = ldexp(1, -find_unit_exponent(reach));
    vec3 compact[4];
    for (int i = 0; i < 4; i++) compact[i] = vec3_scale(w[i], unit);
    double depth = compact_tetrahedron_depth(compact, 2, error * unit);
    return depth > 0 ? depth / unit * (1 - 0x1p-50) : depth;
}

static double double_pyramid_depth(const vec3 *w, int count, double error) {
    uint16_t triangles[8][3];
    int ring = count - 2;
    for (int i = 0; i < ring; i++) {
        uint16_t from = (uint16_t)(2 + i), to = (uint16_t)(2 + (i + 1) % ring);
        triangles[2 * i][0] = 0, triangles[2 * i][1] = from, triangles[2 * i][2] = to;
        triangles[2 * i + 1][0] = 1, triangles[2 * i + 1][1] = to, triangles[2 * i + 1][2] = from;
    }
    surface s = {w, (const uint16_t(*)[3])triangles, (uint32_t)count, (uint32_t)(2 * ring)};
    return surface_compute_depth(&s, error);
}

double hull_compute_clearance(const vec3 *w, int count, double error) {
    surface s = {w, tetrahedron, 4, 4};
    if (count == 4) return surface_compute_depth(&s, error);
    return count == 5 || count == 6 ? double_pyramid_depth(w, count, error) : 0;
}

double hull_compute_depth(const vec3 *w, int count, double error) {
    double depth = count == 4 ? tetrahedron_depth(w, error) : 0;
    return depth != 0 ? fmax(depth, 0) : hull_compute_clearance(w, count, error);
}
