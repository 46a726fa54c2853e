// What the kernels of kernels/small_gjk.h are made of, for AVX2: a point's coordinate in each of four lanes.
#ifndef OVOID_SIMD_KERNELS_SMALL_GJK_AVX2_H
#define OVOID_SIMD_KERNELS_SMALL_GJK_AVX2_H

#include "simd/kernels/corner_avx2.h"
#include "simd/small_gjk.h"

#define SMALL_GJK_INLINE CORNER_AVX2

// The difference in all lanes.
typedef struct met {
    vectors4 w;
    double gap;
    uint32_t a, b;
} met;

SMALL_GJK_INLINE void met_get(const met *m, double w[3]) {
    w[0] = _mm256_cvtsd_f64(m->w.x);
    w[1] = _mm256_cvtsd_f64(m->w.y);
    w[2] = _mm256_cvtsd_f64(m->w.z);
}

SMALL_GJK_INLINE void met_set(met *m, const double w[3]) { m->w = vectors4_spread(vec3_at(w, 0)); }

SMALL_GJK_INLINE __m256d turn(const double row[3], vectors4 p, double t) {
    __m256d sum = _mm256_add_pd(_mm256_mul_pd(_mm256_set1_pd(row[0]), p.x), _mm256_mul_pd(_mm256_set1_pd(row[1]), p.y));
    sum = _mm256_add_pd(sum, _mm256_mul_pd(_mm256_set1_pd(row[2]), p.z));
    return _mm256_add_pd(sum, _mm256_set1_pd(t));
}

// Four points; the smaller body of a pair repeats its first ones: the lowest index among equals is the same.
SMALL_GJK_INLINE vectors4 load_points(const simd_points *from, uint32_t i) {
    uint32_t at = i < from->padded_count ? i : i & 4;
    return vectors4_load(from->x + at, from->y + at, from->z + at);
}

SMALL_GJK_INLINE void pose_points(small_gjk_body *p, const placed_points *from, uint32_t blocks) {
    const double *rows = from->rows, *t = from->at;
    for (uint32_t i = 0; i < 8 * blocks; i += 4) {
        vectors4 v = load_points(&from->points, i);
        _mm256_store_pd(p->x + i, turn(rows, v, t[0]));
        _mm256_store_pd(p->y + i, turn(rows + 3, v, t[1]));
        _mm256_store_pd(p->z + i, turn(rows + 6, v, t[2]));
    }
}

// Moves points that are turned already; the bits are those of posing them.
SMALL_GJK_INLINE void move_points(small_gjk_body *p, const placed_points *from, uint32_t blocks) {
    const double *t = from->at;
    vectors4 by = vectors4_spread(vec3_at(t, 0));
    for (uint32_t i = 0; i < 8 * blocks; i += 4) {
        vectors4 v = load_points(&from->points, i);
        _mm256_store_pd(p->x + i, _mm256_add_pd(v.x, by.x));
        _mm256_store_pd(p->y + i, _mm256_add_pd(v.y, by.y));
        _mm256_store_pd(p->z + i, _mm256_add_pd(v.z, by.z));
    }
}

SMALL_GJK_INLINE __m256d better(__m256d a, __m256d b, int is_least) {
    return is_least ? _mm256_min_pd(a, b) : _mm256_max_pd(a, b);
}

// The largest, or least, of the values of 8 blocks points, and the lowest index among those that have it.
SMALL_GJK_INLINE support_result find_best(const __m256d *v, uint32_t blocks, int is_least) {
    __m256d m[SMALL_GJK_POINTS / 4];
    uint32_t count = 2 * blocks;
    for (uint32_t i = 0; i < count; i++) m[i] = v[i];
    for (uint32_t i = 0; i < blocks; i++) m[i] = better(m[i], m[i + blocks], is_least);
    if (blocks > 2) m[0] = better(m[0], m[2], is_least);
    if (blocks > 3) m[1] = better(m[1], m[3], is_least);
    __m256d best = blocks > 1 ? better(m[0], m[1], is_least) : m[0];
    best = better(best, _mm256_permute2f128_pd(best, best, 1), is_least);
    best = better(best, _mm256_permute_pd(best, 5), is_least);
    uint32_t equal = 0;
    for (uint32_t i = 0; i < count; i++) equal |= mask4(_mm256_cmp_pd(v[i], best, _CMP_EQ_OQ)) << 4 * i;
    return (support_result){_mm256_cvtsd_f64(best), equal ? (uint32_t)__builtin_ctz(equal) : 0};
}

// The lowest index among the points that are extreme along n, and their value.
SMALL_GJK_INLINE support_result find_extreme(const small_gjk_body *p, vectors4 n, uint32_t blocks, int is_least) {
    __m256d v[SMALL_GJK_POINTS / 4];
    for (uint32_t i = 0; i < 2 * blocks; i++)
        v[i] = vectors4_dot(
            (vectors4){_mm256_load_pd(p->x + 4 * i), _mm256_load_pd(p->y + 4 * i), _mm256_load_pd(p->z + 4 * i)}, n);
    return find_best(v, blocks, is_least);
}

// The extreme point of a body whose points are in its own frame.
SMALL_GJK_INLINE support_result find_extreme_point(const simd_points *p, vec3 n, uint32_t blocks, int is_least) {
    vectors4 along = vectors4_spread(n);
    __m256d v[SMALL_GJK_POINTS / 4];
    for (uint32_t i = 0; i < 2 * blocks; i++) v[i] = vectors4_dot(load_points(p, 4 * i), along);
    return find_best(v, blocks, is_least);
}

SMALL_GJK_INLINE void measure(met *m, const small_gjk_bodies *bodies, uint32_t blocks, vec3 along) {
    const small_gjk_body *a = &bodies->a, *b = &bodies->b;
    vectors4 n = vectors4_spread(along);
    support_result high = find_extreme(a, n, blocks, 0), low = find_extreme(b, n, blocks, 1);
    uint32_t i = m->a = high.index, k = m->b = low.index;
    m->gap = low.value - high.value;
    m->w.x = _mm256_sub_pd(_mm256_set1_pd(b->x[k]), _mm256_set1_pd(a->x[i]));
    m->w.y = _mm256_sub_pd(_mm256_set1_pd(b->y[k]), _mm256_set1_pd(a->y[i]));
    m->w.z = _mm256_sub_pd(_mm256_set1_pd(b->z[k]), _mm256_set1_pd(a->z[i]));
}

typedef vectors4 corners;

SMALL_GJK_INLINE void corners_fill(corners *c, const met *m) { *c = m->w; }

// The corner is blended in registers: a load of four lanes just after the store of one would wait for it.
SMALL_GJK_INLINE void corners_put(corners *c, unsigned i, const met *m) {
    static const _Alignas(32) int64_t place[4][4] = {{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, -1}};
    __m256d lane = _mm256_castsi256_pd(_mm256_load_si256((const __m256i *)place[i]));
    c->x = _mm256_blendv_pd(c->x, m->w.x, lane);
    c->y = _mm256_blendv_pd(c->y, m->w.y, lane);
    c->z = _mm256_blendv_pd(c->z, m->w.z, lane);
}

SMALL_GJK_INLINE vectors4 gather_points(const simd_points *p, const uint32_t at[4]) {
    return (vectors4){_mm256_setr_pd(p->x[at[0]], p->x[at[1]], p->x[at[2]], p->x[at[3]]),
                      _mm256_setr_pd(p->y[at[0]], p->y[at[1]], p->y[at[2]], p->y[at[3]]),
                      _mm256_setr_pd(p->z[at[0]], p->z[at[1]], p->z[at[2]], p->z[at[3]])};
}

SMALL_GJK_INLINE void corners_meet(corners *c, const small_gjk_query *q, const uint32_t a[4], const uint32_t b[4]) {
    vectors4 in_a = gather_points(&q->a, a), in_b = gather_points(&q->b, b);
    c->x = _mm256_sub_pd(turn(q->rows_b, in_b, q->offset[0]), turn(q->rows_a, in_a, 0));
    c->y = _mm256_sub_pd(turn(q->rows_b + 3, in_b, q->offset[1]), turn(q->rows_a + 3, in_a, 0));
    c->z = _mm256_sub_pd(turn(q->rows_b + 6, in_b, q->offset[2]), turn(q->rows_a + 6, in_a, 0));
}

SMALL_GJK_INLINE void corners_store(const corners *c, corner_lanes *at) {
    _mm256_store_pd(at->x, c->x);
    _mm256_store_pd(at->y, c->y);
    _mm256_store_pd(at->z, c->z);
}

SMALL_GJK_INLINE corner_step corners_step(const corners *c, unsigned valid, const met *m) {
    return corner_step_avx2(*c, valid, m->w);
}

#endif
