// What the kernels of kernels/small_gjk.h are made of, for AVX2 and AVX-512, which include this with LANES 4 or 8:
// points are in LANES lanes, the up to four corners in four.
#ifndef OVOID_SIMD_KERNELS_SMALL_GJK_LANES_H
#define OVOID_SIMD_KERNELS_SMALL_GJK_LANES_H

#include "base/compiler.h"
#include "simd/kernels/corner_avx2.h"
#include "simd/kernels/lanes.h"
#include "simd/small_gjk.h"

#define SMALL_GJK_INLINE LANES_INLINE

// Eight lanes are asked for more than 32 points alone (kernels.c).
#if LANES == 8
#define SMALL_GJK_CLASSES(DO) DO(6) DO(8)
#else
#define SMALL_GJK_CLASSES(DO) DO(1) DO(2) DO(3) DO(4) DO(6) DO(8)
#endif

// The difference in all lanes.
typedef struct met {
    vectors4 w;
    double gap;
    uint32_t a, b;
} met;

CORNER_AVX2 void met_get(const met *m, double w[3]) {
    w[0] = _mm256_cvtsd_f64(m->w.x);
    w[1] = _mm256_cvtsd_f64(m->w.y);
    w[2] = _mm256_cvtsd_f64(m->w.z);
}

CORNER_AVX2 void met_set(met *m, const double w[3]) { m->w = vectors4_spread(vec3_at(w, 0)); }

CORNER_AVX2 __m256d turn(const double row[3], vectors4 p, double t) {
    __m256d sum = _mm256_add_pd(_mm256_mul_pd(_mm256_set1_pd(row[0]), p.x), _mm256_mul_pd(_mm256_set1_pd(row[1]), p.y));
    sum = _mm256_add_pd(sum, _mm256_mul_pd(_mm256_set1_pd(row[2]), p.z));
    return _mm256_add_pd(sum, _mm256_set1_pd(t));
}

typedef vectors4 corners;

CORNER_AVX2 void corners_fill(corners *c, const met *m) { *c = m->w; }

// The corner is blended in registers: a load of four lanes just after the store of one would wait for it.
CORNER_AVX2 void corners_put(corners *c, unsigned i, const met *m) {
    static const _Alignas(32) int64_t place[4][4] = {{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, -1}};
    __m256d here = _mm256_castsi256_pd(_mm256_load_si256((const __m256i *)place[i]));
    c->x = _mm256_blendv_pd(c->x, m->w.x, here);
    c->y = _mm256_blendv_pd(c->y, m->w.y, here);
    c->z = _mm256_blendv_pd(c->z, m->w.z, here);
}

CORNER_AVX2 vectors4 gather_points(const simd_points *p, const uint32_t at[4]) {
    return (vectors4){_mm256_setr_pd(p->x[at[0]], p->x[at[1]], p->x[at[2]], p->x[at[3]]),
                      _mm256_setr_pd(p->y[at[0]], p->y[at[1]], p->y[at[2]], p->y[at[3]]),
                      _mm256_setr_pd(p->z[at[0]], p->z[at[1]], p->z[at[2]], p->z[at[3]])};
}

CORNER_AVX2 void corners_meet(corners *c, const small_gjk_query *q, const uint32_t a[4], const uint32_t b[4]) {
    vectors4 in_a = gather_points(&q->a, a), in_b = gather_points(&q->b, b);
    c->x = _mm256_sub_pd(turn(q->rows_b, in_b, q->offset[0]), turn(q->rows_a, in_a, 0));
    c->y = _mm256_sub_pd(turn(q->rows_b + 3, in_b, q->offset[1]), turn(q->rows_a + 3, in_a, 0));
    c->z = _mm256_sub_pd(turn(q->rows_b + 6, in_b, q->offset[2]), turn(q->rows_a + 6, in_a, 0));
}

CORNER_AVX2 void corners_store(const corners *c, corner_lanes *at) {
    _mm256_store_pd(at->x, c->x);
    _mm256_store_pd(at->y, c->y);
    _mm256_store_pd(at->z, c->z);
}

CORNER_AVX2 corner_step corners_step(const corners *c, unsigned valid, const met *m) {
    return corner_step_avx2(*c, valid, m->w);
}

CORNER_AVX2 corner_step corners_step_filled(const corners *c, const met *m) {
    return corner_step_from_one_avx2(*c, m->w);
}

// LANES points; the smaller body of a pair repeats its first ones: the lowest index among equals is the same.
SMALL_GJK_INLINE void load_points(const simd_points *from, uint32_t i, lane v[3]) {
    uint32_t at = i < from->padded_count ? i : i & (8 - LANES);
    v[0] = lane_load(from->x + at);
    v[1] = lane_load(from->y + at);
    v[2] = lane_load(from->z + at);
}

SMALL_GJK_INLINE lane dot_points(const lane v[3], const lane n[3]) { return (v[0] * n[0] + v[1] * n[1]) + v[2] * n[2]; }

SMALL_GJK_INLINE void pose_points(small_gjk_body *p, const placed_points *from, uint32_t blocks) {
    double *const axes[3] = {p->x, p->y, p->z};
    const lane by[3] = {lane_set(from->at[0]), lane_set(from->at[1]), lane_set(from->at[2])};
    lane rows[3][3];
    for (int c = 0; c < 9; c++) rows[c / 3][c % 3] = lane_set(from->rows[c]);
    for (uint32_t i = 0; i < 8 * blocks; i += LANES) {
        lane v[3];
        load_points(&from->points, i, v);
        for (int c = 0; c < 3; c++) lane_store(axes[c] + i, dot_points(v, rows[c]) + by[c]);
    }
}

// Moves points that are turned already; the bits are those of posing them.
SMALL_GJK_INLINE void move_points(small_gjk_body *p, const placed_points *from, uint32_t blocks) {
    double *const axes[3] = {p->x, p->y, p->z};
    const lane by[3] = {lane_set(from->at[0]), lane_set(from->at[1]), lane_set(from->at[2])};
    for (uint32_t i = 0; i < 8 * blocks; i += LANES) {
        lane v[3];
        load_points(&from->points, i, v);
        for (int c = 0; c < 3; c++) lane_store(axes[c] + i, v[c] + by[c]);
    }
}

// The largest of the values of 8 blocks points, in all lanes.
SMALL_GJK_INLINE lane find_largest_value(const lane *v, uint32_t blocks) {
    lane m[SMALL_GJK_POINTS / LANES];
    uint32_t count = 8 * blocks / LANES;
    for (uint32_t i = 0; i < count; i++) m[i] = v[i];
    for (uint32_t left = count, half; left > 1; left = half) {
        half = (left + 1) / 2;
        for (uint32_t i = 0; i + half < left; i++) m[i] = lane_top(m[i], m[i + half]);
    }
    return lane_find_max(m[0]);
}

// The largest value, and the lowest index among those that have it.
SMALL_GJK_INLINE support_result find_best(const lane *v, uint32_t blocks) {
    lane best = find_largest_value(v, blocks);
    uint64_t equal = 0;
    for (uint32_t i = 0; i < 8 * blocks / LANES; i++)
        equal |= (uint64_t)lane_bits(lane_at_least(v[i], best)) << LANES * i;
    return (support_result){lane_first(best), equal ? (uint32_t)__builtin_ctzll(equal) : 0};
}

// The farthest point along a direction, in all lanes, and how far.
typedef struct farthest {
    vectors4 p;
    double value;
    uint32_t index;
} farthest;

#if LANES == 4
enum { MASKED_BLOCKS = 1 };

// The coordinate of the one point whose lane is set, in all lanes.
SMALL_GJK_INLINE __m256d spread_point(const double *x, const lane_mask is_best[2]) {
    return spread4(lane_or(lane_and(lane_load(x), is_best[0]), lane_and(lane_load(x + 4), is_best[1])));
}

// Of eight points the coordinates come out of the lanes by masks, sooner than they are read by the index. That takes
// more instructions, for which the first support has no time: it waits for nothing but the poses.
SMALL_GJK_INLINE farthest find_farthest_of_eight(const small_gjk_body *p, const lane v[2]) {
    lane best = find_largest_value(v, 1);
    const lane_mask is_best[2] = {lane_at_least(v[0], best), lane_at_least(v[1], best)};
    unsigned equal = lane_bits(is_best[0]) | lane_bits(is_best[1]) << 4, i = (unsigned)__builtin_ctz(equal | 1u << 8);
    vectors4 at = {spread_point(p->x, is_best), spread_point(p->y, is_best), spread_point(p->z, is_best)};
    if (__builtin_expect(__builtin_popcount(equal) != 1, 0)) {
        i = equal ? i : 0;
        at = vectors4_spread((vec3){p->x[i], p->y[i], p->z[i]});
    }
    return (farthest){at, lane_first(best), i};
}
#else
enum { MASKED_BLOCKS = 0 };
#endif

SMALL_GJK_INLINE farthest find_farthest(const small_gjk_body *p, const lane n[3], uint32_t blocks, int is_first) {
    lane v[SMALL_GJK_POINTS / LANES];
    for (uint32_t i = 0; i < 8 * blocks / LANES; i++) {
        uint32_t at = LANES * i;
        v[i] = dot_points((const lane[]){lane_load(p->x + at), lane_load(p->y + at), lane_load(p->z + at)}, n);
    }
#if LANES == 4
    if (blocks <= MASKED_BLOCKS && !is_first) return find_farthest_of_eight(p, v);
#else
    (void)is_first;
#endif
    support_result best = find_best(v, blocks);
    uint32_t i = best.index;
    return (farthest){vectors4_spread((vec3){p->x[i], p->y[i], p->z[i]}), best.value, i};
}

// The extreme point along n of a body whose points are in its own frame.
SMALL_GJK_INLINE support_result find_extreme_point(const simd_points *p, vec3 n, uint32_t blocks, int is_least) {
    double sign = is_least ? -1 : 1;
    const lane along[3] = {lane_set(sign * n.x), lane_set(sign * n.y), lane_set(sign * n.z)};
    lane v[SMALL_GJK_POINTS / LANES], at[3];
    for (uint32_t i = 0; i < 8 * blocks / LANES; i++) {
        load_points(p, LANES * i, at);
        v[i] = dot_points(at, along);
    }
    support_result best = find_best(v, blocks);
    return (support_result){sign * best.value, best.index};
}

SMALL_GJK_INLINE void measure(met *m, const small_gjk_bodies *bodies, uint32_t blocks, vec3 n, int is_first) {
    const small_gjk_body *a = &bodies->a, *b = &bodies->b;
    // The bodies are read from memory: kept in registers they would push the step's own numbers out of them.
    if (blocks <= MASKED_BLOCKS) compiler_forget(bodies);
    const lane along[3] = {lane_set(n.x), lane_set(n.y), lane_set(n.z)}, back[3] = {-along[0], -along[1], -along[2]};
    farthest high = find_farthest(a, along, blocks, is_first), low = find_farthest(b, back, blocks, is_first);
    m->a = high.index;
    m->b = low.index;
    m->gap = -low.value - high.value;
    m->w.x = _mm256_sub_pd(low.p.x, high.p.x);
    m->w.y = _mm256_sub_pd(low.p.y, high.p.y);
    m->w.z = _mm256_sub_pd(low.p.z, high.p.z);
}

#endif
