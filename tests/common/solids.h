// Random solids that are not convex, and their distance by brute force over all triangles in extended precision.
#ifndef OVOID_TESTS_SOLIDS_H
#define OVOID_TESTS_SOLIDS_H

#include "check.h"
#include "places.h"
#include <ovoid/ovoid.h>

/// A mesh under construction.
typedef struct mesh {
    double *xyz;
    uint32_t *indices;
    size_t points, triangles, point_room, triangle_room;
} mesh;

static inline uint32_t mesh_add_point(mesh *m, double x, double y, double z) {
    if (m->points == m->point_room) {
        m->point_room = 2 * m->point_room + 16;
        m->xyz = realloc(m->xyz, m->point_room * 3 * sizeof(double));
    }
    double *p = m->xyz + 3 * m->points;
    p[0] = x, p[1] = y, p[2] = z;
    return (uint32_t)m->points++;
}
static inline void mesh_add_triangle(mesh *m, uint32_t a, uint32_t b, uint32_t c) {
    if (m->triangles == m->triangle_room) {
        m->triangle_room = 2 * m->triangle_room + 16;
        m->indices = realloc(m->indices, m->triangle_room * 3 * sizeof(uint32_t));
    }
    uint32_t *t = m->indices + 3 * m->triangles++;
    t[0] = a, t[1] = b, t[2] = c;
}
static inline void mesh_clear(mesh *m) {
    free(m->xyz);
    free(m->indices);
    *m = (mesh){NULL, NULL, 0, 0, 0, 0};
}
static inline ovoid_solid *mesh_make_solid(const mesh *m) {
    ovoid_error error = {.message = ""};
    ovoid_solid *s = ovoid_solid_create_from_triangles(&(ovoid_triangles){m->xyz, m->points, m->indices, m->triangles},
                                                       NULL, &error);
    if (!s) printf("  %s\n", error.message);
    return s;
}

/// A grid of u by v quadrangles, closed in both directions: a ring of that radius with a tube of another. bumps: the
/// share of the tube's radius by which each point is moved.
static inline void mesh_add_ring(mesh *m, double radius, double tube, uint32_t u, uint32_t v, double bumps,
                                 uint64_t *seed) {
    uint32_t first = (uint32_t)m->points;
    for (uint32_t i = 0; i < u; i++)
        for (uint32_t j = 0; j < v; j++) {
            double a = 6.283185307179586 * i / u, b = 6.283185307179586 * j / v;
            double t = tube * (bumps > 0 ? random_uniform(seed, 1 - bumps, 1 + bumps) : 1), r = radius + t * cos(b);
            mesh_add_point(m, r * cos(a), r * sin(a), t * sin(b));
        }
    for (uint32_t i = 0; i < u; i++)
        for (uint32_t j = 0; j < v; j++) {
            uint32_t i1 = (i + 1) % u, j1 = (j + 1) % v;
            uint32_t p = first + i * v + j, q = first + i1 * v + j, r = first + i1 * v + j1, s = first + i * v + j1;
            mesh_add_triangle(m, p, q, r);
            mesh_add_triangle(m, p, r, s);
        }
}

/// A sphere of rings and segments around a point, each of its points at a random share of the radius: a star.
static inline void mesh_add_star(mesh *m, ovoid_vec3 at, double radius, uint32_t rings, uint32_t segments, double bumps,
                                 uint64_t *seed) {
    uint32_t north = mesh_add_point(m, at.x, at.y, at.z + radius), first = north + 1;
    for (uint32_t i = 1; i < rings; i++)
        for (uint32_t j = 0; j < segments; j++) {
            double a = 3.141592653589793 * i / rings, b = 6.283185307179586 * j / segments;
            double r = radius * (bumps > 0 ? random_uniform(seed, 1 - bumps, 1) : 1);
            mesh_add_point(m, at.x + r * sin(a) * cos(b), at.y + r * sin(a) * sin(b), at.z + r * cos(a));
        }
    uint32_t south = mesh_add_point(m, at.x, at.y, at.z - radius), last = first + (rings - 2) * segments;
    for (uint32_t j = 0; j < segments; j++) {
        uint32_t k = (j + 1) % segments;
        mesh_add_triangle(m, north, first + j, first + k);
        mesh_add_triangle(m, south, last + k, last + j);
        for (uint32_t i = 0; i + 2 < rings; i++) {
            uint32_t p = first + i * segments, q = p + segments;
            mesh_add_triangle(m, p + j, q + j, q + k);
            mesh_add_triangle(m, p + j, q + k, p + k);
        }
    }
}

/// The prism of height 2 h over an L of the given lengths and width.
static inline void mesh_add_angle(mesh *m, double length, double width, double h) {
    const double c[6][2] = {{0, 0}, {length, 0}, {length, width}, {width, width}, {width, length}, {0, length}};
    static const uint8_t cap[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
    uint32_t first = (uint32_t)m->points;
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < 6; i++) mesh_add_point(m, c[i][0], c[i][1], side ? h : -h);
    for (int i = 0; i < 4; i++) {
        mesh_add_triangle(m, first + cap[i][0], first + cap[i][2], first + cap[i][1]);
        mesh_add_triangle(m, first + 6 + cap[i][0], first + 6 + cap[i][1], first + 6 + cap[i][2]);
    }
    for (uint32_t i = 0; i < 6; i++) {
        uint32_t j = (i + 1) % 6;
        mesh_add_triangle(m, first + i, first + j, first + 6 + j);
        mesh_add_triangle(m, first + i, first + 6 + j, first + 6 + i);
    }
}

/// A solid of a random kind, of a size of about `scale`.
static inline void mesh_add_random(mesh *m, double scale, uint64_t *seed) {
    switch (random_next(seed) % 4) {
    case 0:
        mesh_add_angle(m, scale, scale * random_uniform(seed, 0.1, 0.5), scale * random_uniform(seed, 0.05, 1));
        break;
    case 1:
        mesh_add_ring(m, scale, scale * random_uniform(seed, 0.1, 0.6), 5 + (uint32_t)(random_next(seed) % 8),
                      3 + (uint32_t)(random_next(seed) % 6), 0.3, seed);
        break;
    case 2:
        mesh_add_star(m, (ovoid_vec3){0, 0, 0}, scale, 3 + (uint32_t)(random_next(seed) % 5),
                      3 + (uint32_t)(random_next(seed) % 7), 0.7, seed);
        break;
    default:
        // Two components, which may overlap, touch or be apart.
        mesh_add_star(m, (ovoid_vec3){random_uniform(seed, -scale, scale), 0, 0}, 0.5 * scale, 4, 5, 0.5, seed);
        mesh_add_ring(m, scale, scale * 0.2, 6, 4, 0, seed);
    }
}

// ---- cubes on a grid

enum { CUBES = 4, CUBES_ALL = CUBES * CUBES * CUBES };

/// Unit cubes of a grid that starts at the origin.
typedef struct cubes {
    unsigned char is[CUBES_ALL];
} cubes;

static inline int cubes_get(const cubes *c, int x, int y, int z) {
    int in = x >= 0 && y >= 0 && z >= 0 && x < CUBES && y < CUBES && z < CUBES;
    return in && c->is[(x * CUBES + y) * CUBES + z];
}

/// Starts with one cube and adds cubes, each beside an existing one.
static inline cubes cubes_make(uint64_t *s) {
    cubes c = {{0}};
    int count = 1 + (int)(random_next(s) % 12), at[3] = {1, 1, 1};
    for (int i = 0; i < count; i++) {
        c.is[(at[0] * CUBES + at[1]) * CUBES + at[2]] = 1;
        int axis = (int)(random_next(s) % 3), next = at[axis] + (random_next(s) % 2 ? 1 : -1);
        if (next >= 0 && next < CUBES) at[axis] = next;
    }
    return c;
}

// A unit square of n by n cells, each of two triangles; from `at` along two axes.
static inline void mesh_add_square(mesh *m, const double at[3], int axis, int is_high, int n) {
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            uint32_t p[4];
            for (int k = 0; k < 4; k++) {
                double x[3] = {at[0], at[1], at[2]};
                x[u] += (double)(i + (k == 1 || k == 2)) / n;
                x[v] += (double)(j + (k >= 2)) / n;
                p[k] = mesh_add_point(m, x[0], x[1], x[2]);
            }
            mesh_add_triangle(m, p[0], p[is_high ? 1 : 2], p[is_high ? 2 : 1]);
            mesh_add_triangle(m, p[0], p[is_high ? 2 : 3], p[is_high ? 3 : 2]);
        }
}

/// The surface of the cubes, each square of n by n cells.
static inline void mesh_add_cubes(mesh *m, const cubes *c, int n) {
    for (int i = 0; i < 6 * CUBES_ALL; i++) {
        int x = i / 6 / CUBES / CUBES, y = i / 6 / CUBES % CUBES, z = i / 6 % CUBES;
        int axis = i % 6 / 2, high = i % 2, step = high ? 1 : -1;
        if (!cubes_get(c, x, y, z)) continue;
        if (cubes_get(c, x + step * (axis == 0), y + step * (axis == 1), z + step * (axis == 2))) continue;
        const double at[3] = {x + high * (axis == 0), y + high * (axis == 1), z + high * (axis == 2)};
        mesh_add_square(m, at, axis, high, n);
    }
}

// ---- brute force

typedef struct long3 {
    long double x, y, z;
} long3;
static inline long3 long3_sub(long3 a, long3 b) { return (long3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline long3 long3_add_scaled(long3 a, long3 b, long double s) {
    return (long3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
static inline long double long3_dot(long3 a, long3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline long3 long3_cross(long3 a, long3 b) {
    return (long3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline long double long3_norm(long3 a) { return sqrtl(long3_dot(a, a)); }

static inline long3 long3_place(const ovoid_pose *pose, const double *p) {
    long double w = pose->rotation.w, x = pose->rotation.x, y = pose->rotation.y, z = pose->rotation.z;
    long double s = 2 / (w * w + x * x + y * y + z * z);
    long3 v = {p[0], p[1], p[2]}, q = {x, y, z}, c = long3_cross(q, v), d = long3_cross(q, c);
    return (long3){pose->position.x + v.x + s * (w * c.x + d.x), pose->position.y + v.y + s * (w * c.y + d.y),
                   pose->position.z + v.z + s * (w * c.z + d.z)};
}

static inline long double clamp01(long double x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

static inline long double long_edges_distance(long3 p, long3 p1, long3 q, long3 q1) {
    long3 u = long3_sub(p1, p), v = long3_sub(q1, q), r = long3_sub(p, q);
    long double a = long3_dot(u, u), e = long3_dot(v, v), f = long3_dot(v, r), c = long3_dot(u, r), b = long3_dot(u, v);
    long double best = INFINITY, denominator = a * e - b * b;
    // The interiors of both, and each end projected to the other edge: the least of five is the distance, without
    // cases.
    long double s[5] = {denominator > 0 ? clamp01((b * f - c * e) / denominator) : 0, 0, 1, a > 0 ? clamp01(-c / a) : 0,
                        a > 0 ? clamp01((b - c) / a) : 0};
    for (int i = 0; i < 5; i++) {
        long double t = i == 3 ? 0 : i == 4 ? 1 : e > 0 ? clamp01((b * s[i] + f) / e) : 0;
        long double d = long3_norm(long3_sub(long3_add_scaled(p, u, s[i]), long3_add_scaled(q, v, t)));
        best = d < best ? d : best;
    }
    return best;
}

static inline long double long_point_distance(long3 p, const long3 t[3]) {
    long3 n = long3_cross(long3_sub(t[1], t[0]), long3_sub(t[2], t[0]));
    for (int i = 0; i < 3; i++)
        if (long3_dot(long3_cross(n, long3_sub(t[(i + 1) % 3], t[i])), long3_sub(p, t[i])) < 0) return INFINITY;
    long double norm = long3_norm(n);
    return norm > 0 ? fabsl(long3_dot(n, long3_sub(p, t[0]))) / norm : INFINITY;
}

// 1 if the edge goes through the inside of the triangle.
static inline int long_is_crossing(long3 p, long3 q, const long3 t[3]) {
    long3 n = long3_cross(long3_sub(t[1], t[0]), long3_sub(t[2], t[0]));
    long double a = long3_dot(n, long3_sub(p, t[0])), b = long3_dot(n, long3_sub(q, t[0]));
    if (!(a * b < 0)) return 0;
    long3 x = long3_add_scaled(p, long3_sub(q, p), a / (a - b));
    for (int i = 0; i < 3; i++)
        if (!(long3_dot(long3_cross(n, long3_sub(t[(i + 1) % 3], t[i])), long3_sub(x, t[i])) > 0)) return 0;
    return 1;
}

/// The distance of two triangles; 0 if an edge of one goes through the other.
static inline long double long_triangles_distance(const long3 a[3], const long3 b[3]) {
    long double best = INFINITY;
    for (int i = 0; i < 3; i++) {
        if (long_is_crossing(a[i], a[(i + 1) % 3], b) || long_is_crossing(b[i], b[(i + 1) % 3], a)) return 0;
        best = fminl(best, fminl(long_point_distance(a[i], b), long_point_distance(b[i], a)));
        for (int j = 0; j < 3; j++) best = fminl(best, long_edges_distance(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
    }
    return best;
}

/// The triangles of a mesh in the world; free them.
static inline long3 *long_place_mesh(const mesh *m, const ovoid_pose *pose) {
    long3 *all = malloc(3 * m->triangles * sizeof *all);
    for (size_t i = 0; i < 3 * m->triangles; i++) all[i] = long3_place(pose, m->xyz + 3 * (size_t)m->indices[i]);
    return all;
}

/// How often closed triangles wind around a point: their solid angles (A. van Oosterom, J. Strackee, The solid angle of
/// a plane triangle, 1983) over 4 pi.
static inline long double long_winding(const long3 *t, size_t count, long3 p) {
    long double sum = 0;
    for (size_t i = 0; i < count; i++) {
        long3 a = long3_sub(t[3 * i], p), b = long3_sub(t[3 * i + 1], p), c = long3_sub(t[3 * i + 2], p);
        long double x = long3_norm(a), y = long3_norm(b), z = long3_norm(c);
        sum += atan2l(long3_dot(a, long3_cross(b, c)),
                      x * y * z + long3_dot(a, b) * z + long3_dot(b, c) * x + long3_dot(c, a) * y);
    }
    return sum / 6.28318530717958647692528676655900577L;
}

/// The result of brute force: the distance of the surfaces, and whether the bodies have a common point.
typedef struct solid_truth {
    double surfaces;
    int is_common;
} solid_truth;

/// A ball around a triangle.
typedef struct long_ball {
    long3 center;
    long double radius;
} long_ball;

static inline long_ball *long_make_balls(const long3 *t, size_t count) {
    long_ball *balls = malloc(count * sizeof *balls);
    for (size_t i = 0; i < count; i++) {
        balls[i].center =
            long3_add_scaled(long3_sub(t[3 * i], long3_sub((long3){0, 0, 0}, t[3 * i + 1])), t[3 * i + 2], 1);
        balls[i].center = long3_add_scaled((long3){0, 0, 0}, balls[i].center, 1.0L / 3);
        balls[i].radius = 0;
        for (int k = 0; k < 3; k++)
            balls[i].radius = fmaxl(balls[i].radius, long3_norm(long3_sub(t[3 * i + k], balls[i].center)) * 1.000001L);
    }
    return balls;
}

/// Over all pairs of triangles, except those whose balls are farther apart than the nearest so far. If no surfaces
/// meet, a corner inside decides; open surfaces have no inside.
static inline solid_truth find_truth_of(const mesh *a, const ovoid_pose *pose_a, int is_open_a, const mesh *b,
                                        const ovoid_pose *pose_b, int is_open_b) {
    long3 *p = long_place_mesh(a, pose_a), *q = long_place_mesh(b, pose_b);
    long_ball *in_a = long_make_balls(p, a->triangles), *in_b = long_make_balls(q, b->triangles);
    long double best = INFINITY;
    for (size_t i = 0; i < a->triangles; i++)
        for (size_t j = 0; j < b->triangles; j++) {
            long double apart = long3_norm(long3_sub(in_a[i].center, in_b[j].center)) - in_a[i].radius - in_b[j].radius;
            if (apart < best) best = fminl(best, long_triangles_distance(p + 3 * i, q + 3 * j));
        }
    int is_common = best <= 0;
    for (size_t i = 0; i < 3 * a->triangles && !is_common && !is_open_b; i++)
        is_common = fabsl(long_winding(q, b->triangles, p[i])) > 0.5L;
    for (size_t i = 0; i < 3 * b->triangles && !is_common && !is_open_a; i++)
        is_common = fabsl(long_winding(p, a->triangles, q[i])) > 0.5L;
    free(p);
    free(q);
    free(in_a);
    free(in_b);
    return (solid_truth){(double)best, is_common};
}

static inline solid_truth find_solid_truth(const mesh *a, const ovoid_pose *pose_a, const mesh *b,
                                           const ovoid_pose *pose_b) {
    return find_truth_of(a, pose_a, 0, b, pose_b, 0);
}

// ---- grounds for contacts: slabs of triangles whose top has any heights, closed

/// A slab of n by n quadrangles over the square of that half width; its bottom is level.
typedef struct ground {
    uint32_t n;
    double half, bottom;
    double (*height)(double x, double y);
    double jitter; ///< points inside are moved by this share of a cell, diagonals turned at random
} ground;

static inline void ground_add_face(mesh *m, const ground *g, int is_top, uint64_t *seed) {
    uint32_t first = (uint32_t)m->points, n = g->n;
    double cell = 2 * g->half / n;
    for (uint32_t i = 0; i <= n; i++)
        for (uint32_t j = 0; j <= n; j++) {
            int is_inside = i && j && i < n && j < n;
            double move = is_inside && is_top ? g->jitter * cell : 0;
            double x = cell * i - g->half + random_uniform(seed, -move, move + 1e-300),
                   y = cell * j - g->half + random_uniform(seed, -move, move + 1e-300);
            mesh_add_point(m, x, y, is_top ? g->height(x, y) : g->bottom);
        }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < n; j++) {
            uint32_t p = first + i * (n + 1) + j, q = p + n + 1, r = q + 1, s = p + 1;
            if (g->jitter > 0 && random_next(seed) % 2) {
                uint32_t t = p;
                p = q, q = r, r = s, s = t;
            }
            mesh_add_triangle(m, p, is_top ? q : r, is_top ? r : q);
            mesh_add_triangle(m, p, is_top ? r : s, is_top ? s : r);
        }
}

static inline void ground_add(mesh *m, const ground *g, uint64_t *seed) {
    uint32_t n = g->n, size = (n + 1) * (n + 1), top = (uint32_t)m->points, low = top + size;
    ground_add_face(m, g, 1, seed);
    ground_add_face(m, g, 0, seed);
    for (uint32_t k = 0; k < n; k++) {
        const uint32_t side[4][2] = {{k * (n + 1), (k + 1) * (n + 1)},
                                     {(k + 1) * (n + 1) + n, k * (n + 1) + n},
                                     {k + 1, k},
                                     {n * (n + 1) + k, n * (n + 1) + k + 1}};
        for (int i = 0; i < 4; i++) {
            uint32_t a = side[i][0], b = side[i][1];
            mesh_add_triangle(m, low + a, low + b, top + b);
            mesh_add_triangle(m, low + a, top + b, top + a);
        }
    }
}

static inline ovoid_solid *ground_make(const ground *g, uint64_t *seed) {
    mesh m = {0};
    ground_add(&m, g, seed);
    ovoid_solid *s = mesh_make_solid(&m);
    mesh_clear(&m);
    if (s) CHECK(ovoid_solid_get_report(s).is_closed && ovoid_solid_get_report(s).volume > 0);
    return s;
}

#endif
