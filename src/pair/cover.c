// Theorem. Let a closed oriented surface of triangles over points of a convex body C keep the distance r from the
// origin, and wind around the origin a nonzero number of times. Then the ball of radius r lies in C. Proof: the
// winding number is constant on the ball, which the surface does not meet; a point outside of C has winding number 0,
// because the surface lies in C and contracts inside C away from it. So every point of the ball is in C.
//
// The winding number is counted along a ray: +1 or -1 for each triangle that it crosses. A ray that comes near an edge
// is not used, so that rounding cannot change the count.
#include "pair/cover.h"

#include "pair/simplex.h"
#include "tools/hash.h"

#include <string.h>

// Rays to try: directions of no symmetry.
static const vec3 rays[] = {{0.5301, 0.3377, 0.7778},   {-0.6129, 0.7207, 0.3241},   {0.2713, -0.8369, 0.4754},
                            {0.8847, 0.1213, -0.4501},  {-0.3571, -0.5819, -0.7307}, {0.0917, 0.9631, -0.2531},
                            {-0.9173, 0.0731, -0.3913}, {0.1931, -0.2287, 0.9541}};

// The direction from the origin to the nearest point of the longest edge: for slivers, whose own plane is uncertain.
static vec3 find_edge_direction(vec3 a, vec3 b, vec3 c) {
    vec3 p[4] = {a, b, c, a};
    simplex longest = {.count = 2};
    double most = -1;
    for (int i = 0; i < 3; i++) {
        double length = vec3_norm_squared(vec3_sub(p[i + 1], p[i]));
        if (!(length > most)) continue;
        most = length;
        longest.p[0].w = p[i];
        longest.p[1].w = p[i + 1];
    }
    return simplex_reduce(&longest);
}

static double least_along(vec3 n, vec3 a, vec3 b, vec3 c) {
    return fmin(vec3_dot(n, a), fmin(vec3_dot(n, b), vec3_dot(n, c)));
}

// For any unit n all points of the triangle have n.x >= the least of its corners. Its own normal is tried first; if
// that does not give `enough`, the directions to its nearest point and to its longest edge.
double triangle_compute_clearance(vec3 a, vec3 b, vec3 c, double enough, vec3 *normal) {
    vec3 n = simplex_compute_normal(vec3_sub(b, a), vec3_sub(c, a));
    *normal = vec3_dot(n, a) < 0 ? vec3_neg(n) : n;
    double best = least_along(*normal, a, b, c);
    if (best >= enough) return best;
    simplex t = {.p = {{a, 0, 0}, {b, 0, 0}, {c, 0, 0}}, .count = 3};
    vec3 other[2] = {simplex_reduce(&t), find_edge_direction(a, b, c)};
    for (int i = 0; i < 2; i++) {
        double least = least_along(other[i], a, b, c);
        if (!(least > best)) continue;
        best = least;
        *normal = other[i];
    }
    return best;
}

// The sign of det(u, a, b), or 0 if rounding may hide it.
static int edge_sign(vec3 u, vec3 a, vec3 b, double slack) {
    double det = vec3_dot(u, vec3_cross(a, b));
    return det > slack ? 1 : det < -slack ? -1 : 0;
}

// The signed crossings of the surface by the ray u; *ok is 0 if the ray cannot be used. enough: as in
// triangle_compute_clearance.
static long count_crossings(const surface *s, vec3 u, double slack, double enough, int *ok) {
    long sum = 0;
    *ok = 1;
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        const uint16_t *v = s->triangles[t];
        vec3 a = surface_get_point(s, v[0]), b = surface_get_point(s, v[1]), c = surface_get_point(s, v[2]);
        int ab = edge_sign(u, a, b, slack), bc = edge_sign(u, b, c, slack), ca = edge_sign(u, c, a, slack);
        // A line that certainly passes two edges on different sides misses the triangle.
        if ((ab > 0 || bc > 0 || ca > 0) && (ab < 0 || bc < 0 || ca < 0)) continue;
        if (ab == 0 || bc == 0 || ca == 0) {
            *ok = 0;
            return 0;
        }
        // The line meets the triangle; the triangle is on one side of the plane through the origin with normal n.
        vec3 n;
        (void)triangle_compute_clearance(a, b, c, enough, &n);
        double ahead = vec3_dot(n, u);
        if (fabs(ahead) < 1e-12) {
            *ok = 0;
            return 0;
        }
        if (ahead > 0) sum += ab;
    }
    return sum;
}

// With L = |b - a| + |c - a|, the corners' errors move det = ((b - a) x (c - a)).a by less than 8 reach L error, and
// its evaluation by less than 64 u reach^2 L.
int triangle_is_outward(vec3 a, vec3 b, vec3 c, double doubt) {
    vec3 e1 = vec3_sub(b, a), e2 = vec3_sub(c, a);
    double det = vec3_dot(vec3_cross(e1, e2), a);
    return det > 0 && det * det > doubt * (vec3_norm_squared(e1) + vec3_norm_squared(e2));
}

// 1 if all triangles are outward: then each crossing of a ray counts +1, and a ray toward a triangle crosses that
// triangle.
static int is_star(const surface *s, double doubt) {
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        const uint16_t *v = s->triangles[t];
        if (!triangle_is_outward(surface_get_point(s, v[0]), surface_get_point(s, v[1]), surface_get_point(s, v[2]),
                                 doubt))
            return 0;
    }
    return 1;
}

double surface_compute_depth(const surface *s, double error) {
    double depth = INFINITY, reach = 0;
    for (uint32_t i = 0; i < s->point_count; i++) reach = fmax(reach, vec3_norm(surface_get_point(s, i)));
    for (uint32_t t = 0; t < s->triangle_count && depth > error; t++) {
        const uint16_t *v = s->triangles[t];
        vec3 n;
        depth = fmin(depth, triangle_compute_clearance(surface_get_point(s, v[0]), surface_get_point(s, v[1]),
                                                       surface_get_point(s, v[2]), depth, &n));
    }
    if (!(depth > error) || s->triangle_count == 0) return 0;
    if (is_star(s, triangle_compute_doubt(reach, error))) return depth - error;
    // |u| <= 1.01; two corners off by `error`, and the evaluation of the determinant.
    double slack = 4 * reach * (error + 16 * 0x1p-53 * reach);
    for (size_t i = 0; i < sizeof rays / sizeof *rays; i++) {
        int ok;
        long crossings = count_crossings(s, rays[i], slack, depth, &ok);
        if (ok) return crossings != 0 ? depth - error : 0;
    }
    return 0;
}

int surface_take_cover(surface *s, const pair_frame *f, const ovoid_cover *cover, vec3 *w) {
    if (!cover || cover->point_count > OVOID_COVER_POINTS_MAX || cover->triangle_count > 2 * OVOID_COVER_POINTS_MAX)
        return 0;
    if (!cover_has_arrays(cover)) return 0;
    int is_small = cover->point_count <= OVOID_COVER_POINTS;
    for (uint32_t i = 0; i < cover->point_count; i++) {
        if (!shape_has_vertex(f->a, cover->a[i]) || !shape_has_vertex(f->b, cover->b[i])) return 0;
        if (is_small) w[i] = frame_proof_difference(f, cover->a[i], cover->b[i]);
    }
    *s = (surface){
        is_small ? w : NULL, cover->triangles, cover->point_count, cover->triangle_count, f, cover->a, cover->b};
    return 1;
}

static int is_end(const void *table, size_t slot, const void *key) {
    uint32_t held = ((const uint32_t *)table)[slot];
    return held == UINT32_MAX || held == *(const uint32_t *)key;
}

// Edges are taken in parts that fit the table: an edge and its reverse are in one part. The hash by which they are
// shared out is one product, as each edge is looked at once for each part.
enum { SLOTS = 8192, EDGES_OF_PART = SLOTS / 2, EDGES_MOST = SLOTS / 4 * 3 };

static uint32_t find_part(uint32_t from, uint32_t to, uint32_t parts) {
    uint32_t low = from < to ? from : to, high = from < to ? to : from;
    return (uint32_t)((uint64_t)((low << 16 | high) * 0x9e3779b1u) * parts >> 32);
}

// Directed edges of one part in a hash table with open addressing; each must be new, and have its reverse in the end.
static int is_part_closed(const surface *s, uint32_t part, uint32_t parts) {
    uint32_t table[SLOTS], count = 0;
    memset(table, 0xff, sizeof table);
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t t = 0; t < s->triangle_count; t++)
            for (int e = 0; e < 3; e++) {
                uint32_t from = s->triangles[t][e], to = s->triangles[t][e == 2 ? 0 : e + 1];
                if (find_part(from, to, parts) != part) continue;
                if (from >= s->point_count || to >= s->point_count || from == to) return 0;
                if (pass == 0 && ++count > EDGES_MOST) return 0;
                uint32_t key = pass == 0 ? from << 16 | to : to << 16 | from;
                size_t slot = hash_find(hash_number(key), SLOTS, table, &key, is_end);
                if ((table[slot] == key) != (pass == 1)) return 0;
                table[slot] = key;
            }
    return 1;
}

int surface_is_closed(const surface *s) {
    if (s->triangle_count == 0 || s->triangle_count > 2 * UINT16_MAX) return 0;
    uint32_t parts = 1 + (3 * s->triangle_count - 1) / EDGES_OF_PART;
    for (uint32_t part = 0; part < parts; part++)
        if (!is_part_closed(s, part, parts)) return 0;
    return 1;
}
