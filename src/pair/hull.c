// The depth of the origin in the hull of four to six points: by determinants, or by the surface (cover.c).
#include "pair/hull.h"

#include "linear/both.h"
#include "pair/cover.h"
#include "pair/hull_weights.h"

static const uint16_t tetrahedron[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

// The determinants of the origin with each face of a tetrahedron, and the squares of twice the faces' areas.
typedef struct face_numbers {
    double det[4], square[4];
} face_numbers;

// Of two faces at once: face i of w is tetrahedron[i].
static void set_faces(face_numbers *f, int i, both_vec3 a, both_vec3 b, both_vec3 c) {
    both det = both_vec3_dot(a, both_vec3_cross(b, c));
    both_vec3 n = both_vec3_cross(both_vec3_sub(b, a), both_vec3_sub(c, a));
    both square = both_vec3_dot(n, n);
    f->det[i] = det[0];
    f->det[i + 1] = det[1];
    f->square[i] = square[0];
    f->square[i + 1] = square[1];
}

static face_numbers measure_faces(const vec3 w[4]) {
    face_numbers f;
    set_faces(&f, 0, both_vec3_make(w[1], w[0]), both_vec3_make(w[3], w[2]), both_vec3_make(w[2], w[3]));
    set_faces(&f, 2, both_vec3_make(w[0], w[0]), both_vec3_make(w[3], w[1]), both_vec3_make(w[1], w[2]));
    return f;
}

// A tetrahedron by its determinants: the origin is inside iff the four have one sign. A determinant of corners off by
// `error` is off by 4 reach^2 error, its evaluation by 64 u reach^3; a cross product by 8 reach (error + 4 u reach).
// The corners have about unit length, so that no square loses digits to underflow. 0: in doubt; -1: outside.
static double compact_tetrahedron_depth(const face_numbers *f, double reach, double error) {
    double slack = reach * reach * (4 * error + 64 * 0x1p-53 * reach), depth = INFINITY;
    double more = 8 * reach * (error + 4 * 0x1p-53 * reach);
    int above = 0, below = 0;
    for (int i = 0; i < 4; i++) {
        above += f->det[i] > slack;
        below += f->det[i] < -slack;
        depth = min2(depth, (fabs(f->det[i]) - slack) / (sqrt(f->square[i]) + more) * (1 - 0x1p-50));
    }
    if (above > 0 && below > 0) return -1;
    return above == 4 || below == 4 ? depth : 0;
}

// compact_tetrahedron_depth in units of the corners' size; the weights of the origin are valid only if it is inside.
static double tetrahedron_depth(const vec3 w[4], double error, double weight[4]) {
    double reach = 0, unit = 1, depth;
    for (int i = 0; i < 4; i++) reach = max2(reach, vec3_max_abs(w[i]));
    face_numbers f;
    if (reach > 1e-60 && reach < 1e60) {
        f = measure_faces(w);
        depth = compact_tetrahedron_depth(&f, 2 * reach, error);
    } else {
        unit = ldexp(1, -find_unit_exponent(reach));
        vec3 compact[4];
        for (int i = 0; i < 4; i++) compact[i] = vec3_scale(w[i], unit);
        f = measure_faces(compact);
        depth = compact_tetrahedron_depth(&f, 2, error * unit);
        if (depth > 0) depth = depth / unit * (1 - 0x1p-50);
    }
    double sum = 0;
    for (int i = 0; i < 4; i++) sum += fabs(f.det[i]);
    for (int i = 0; i < 4; i++) weight[i] = fabs(f.det[i]) / sum;
    return depth;
}

static double double_pyramid_depth(const vec3 *w, int count, double error) {
    uint16_t triangles[8][3];
    int ring = count - 2;
    for (int i = 0; i < ring; i++) {
        uint16_t from = (uint16_t)(2 + i), to = (uint16_t)(2 + (i + 1) % ring);
        triangles[2 * i][0] = 0, triangles[2 * i][1] = from, triangles[2 * i][2] = to;
        triangles[2 * i + 1][0] = 1, triangles[2 * i + 1][1] = to, triangles[2 * i + 1][2] = from;
    }
    surface s = surface_make(w, (uint32_t)count, (const uint16_t(*)[3])triangles, (uint32_t)(2 * ring));
    return surface_compute_depth(&s, error);
}

double hull_compute_clearance(const vec3 *w, int count, double error) {
    surface s = surface_make(w, 4, tetrahedron, 4);
    if (count == 4) return surface_compute_depth(&s, error);
    return count == 5 || count == 6 ? double_pyramid_depth(w, count, error) : 0;
}

double hull_compute_depth(const vec3 *w, int count, double error) {
    double weight[4], depth = count == 4 ? tetrahedron_depth(w, error, weight) : 0;
    return depth != 0 ? fmax(depth, 0) : hull_compute_clearance(w, count, error);
}

// Of a thin hull doubles do not know where the origin is.
double hull_find_weights(const vec3 *w, int count, double error, double *weight) {
    double depth = count == 4 ? tetrahedron_depth(w, error, weight) : 0;
    int has_weights = depth > 0;
    if (depth == 0) depth = hull_compute_clearance(w, count, error);
    if (depth > 0 && !(has_weights && hull_measure_weights(w, 4, weight) <= error))
        hull_set_weights_of_doubles(w, count, weight);
    return fmax(depth, 0);
}
