// Closed surfaces. The winding number around the origin is the signed count of the triangles that a ray from it
// crosses, for any ray that meets no edge; which side of an edge a ray passes is the sign of a 3x3 determinant,
// exactly.
#include "shell.h"

#include <stdlib.h>

static int compare_keys(const void *a, const void *b) {
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

// The directed edges in ascending order; NULL if an index is out of range.
static uint64_t *create_sorted_edges(const shell *s) {
    size_t count = 3 * (size_t)s->triangle_count;
    uint64_t *keys = judge_allocate(count, sizeof *keys);
    for (size_t i = 0; i < count; i++) {
        uint32_t from = s->triangles[i], to = s->triangles[i % 3 == 2 ? i - 2 : i + 1];
        if (from >= s->point_count || to >= s->point_count) {
            free(keys);
            return NULL;
        }
        keys[i] = (uint64_t)from << 32 | to;
    }
    qsort(keys, count, sizeof *keys, compare_keys);
    return keys;
}

int shell_is_closed(const shell *s) {
    if (s->triangle_count == 0) return 0;
    uint64_t *keys = create_sorted_edges(s);
    if (!keys) return 0;
    size_t count = 3 * (size_t)s->triangle_count;
    int closed = 1;
    for (size_t i = 0; i < count && closed; i++) {
        uint64_t reverse = keys[i] << 32 | keys[i] >> 32;
        int is_new = i == 0 || keys[i] != keys[i - 1];
        closed = is_new && reverse != keys[i] && bsearch(&reverse, keys, count, sizeof *keys, compare_keys);
    }
    free(keys);
    return closed;
}

// +1 or -1 if the ray along g crosses the triangle, 0 if it misses; *ok = 0 if it meets an edge's line or the origin
// lies in the triangle's plane, so that the ray is not usable.
static int count_crossing(pool *p, nvec g, nvec a, nvec b, nvec c, int *ok) {
    int ab = num_sign(nvec_det(p, g, a, b)), bc = num_sign(nvec_det(p, g, b, c));
    if (ab * bc < 0) return 0;
    int ca = num_sign(nvec_det(p, g, c, a));
    if (ab * ca < 0 || bc * ca < 0) return 0;
    int side = num_sign(nvec_det(p, a, b, c));
    *ok &= ab != 0 && bc != 0 && ca != 0 && side != 0;
    return side == ab ? ab : 0;
}

static long count_winding(pool *p, const shell *s, ovoid_vec3 ray, int *ok) {
    long winding = 0;
    nvec g = nvec_from(p, ray);
    *ok = 1;
    for (uint32_t t = 0; t < s->triangle_count && *ok; t++) {
        const uint32_t *v = s->triangles + 3 * (size_t)t;
        size_t mark = pool_get_mark(p);
        winding += count_crossing(p, g, s->points[v[0]], s->points[v[1]], s->points[v[2]], ok);
        pool_release(p, mark);
    }
    return winding;
}

int shell_is_winding(pool *p, const shell *s) {
    // Directions without symmetry; one suffices unless it meets an edge.
    static const ovoid_vec3 rays[] = {{1009, 2003, -3001}, {-4001, 907, 1301}, {577, -2741, 991},
                                      {-1511, -3307, 271}, {89, 233, 4657},    {-2203, 3541, -613}};
    for (size_t i = 0; i < sizeof rays / sizeof *rays; i++) {
        int ok;
        long winding = count_winding(p, s, rays[i], &ok);
        if (ok) return winding != 0;
    }
    return 0;
}

int segment_is_farther(pool *p, nvec a, nvec b, num square) {
    size_t mark = pool_get_mark(p);
    nvec e = nvec_sub(p, b, a);
    num length = nvec_norm_squared(p, e), t = num_neg(p, nvec_dot(p, a, e));
    int farther;
    if (num_sign(t) <= 0)
        farther = num_compare(p, nvec_norm_squared(p, a), square) >= 0;
    else if (num_compare(p, t, length) >= 0)
        farther = num_compare(p, nvec_norm_squared(p, b), square) >= 0;
    else
        farther = num_compare(p, nvec_norm_squared(p, nvec_cross(p, a, b)), num_mul(p, square, length)) >= 0;
    pool_release(p, mark);
    return farther;
}

// 1 if the foot of the origin on the triangle's plane, of normal n, lies in the triangle.
static int is_foot_inside(pool *p, nvec n, nvec a, nvec b, nvec c) {
    return num_sign(nvec_det(p, n, a, b)) >= 0 && num_sign(nvec_det(p, n, b, c)) >= 0 &&
           num_sign(nvec_det(p, n, c, a)) >= 0;
}

int triangle_is_farther(pool *p, nvec a, nvec b, nvec c, num square) {
    size_t mark = pool_get_mark(p);
    nvec n = nvec_cross(p, nvec_sub(p, b, a), nvec_sub(p, c, a));
    num offset = nvec_dot(p, n, a);
    // The plane is far enough; or the foot on it is outside of the triangle and the edges are far enough.
    int is_flat = nvec_is_zero(n);
    int farther =
        !is_flat && num_compare(p, num_mul(p, offset, offset), num_mul(p, square, nvec_norm_squared(p, n))) >= 0;
    if (!farther)
        farther = (is_flat || !is_foot_inside(p, n, a, b, c)) && segment_is_farther(p, a, b, square) &&
                  segment_is_farther(p, b, c, square) && segment_is_farther(p, c, a, square);
    pool_release(p, mark);
    return farther;
}
