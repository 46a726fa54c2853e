// What the kernels of kernels/small_gjk.h are made of, in plain C: the scalar twin.
#ifndef OVOID_SIMD_KERNELS_SMALL_GJK_SCALAR_H
#define OVOID_SIMD_KERNELS_SMALL_GJK_SCALAR_H

#include "simd/small_gjk.h"

#define SMALL_GJK_INLINE static inline
#define SMALL_GJK_CLASSES(DO) DO(8)

typedef struct met {
    double w[3], gap;
    uint32_t a, b;
} met;

SMALL_GJK_INLINE void met_get(const met *m, double w[3]) {
    for (int i = 0; i < 3; i++) w[i] = m->w[i];
}

SMALL_GJK_INLINE void met_set(met *m, const double w[3]) {
    for (int i = 0; i < 3; i++) m->w[i] = w[i];
}

SMALL_GJK_INLINE void pose_points(small_gjk_body *p, const placed_points *from, uint32_t blocks) {
    (void)blocks;
    p->count = from->points.padded_count;
    simd_pose_points_scalar(&from->points, from->rows, from->at, (double *[]){p->x, p->y, p->z});
}

// Moves points that are turned already; the bits are those of posing them.
SMALL_GJK_INLINE void move_points(small_gjk_body *p, const placed_points *from, uint32_t blocks) {
    (void)blocks;
    const simd_points *own = &from->points;
    p->count = own->padded_count;
    for (uint32_t i = 0; i < p->count; i++) {
        p->x[i] = own->x[i] + from->at[0];
        p->y[i] = own->y[i] + from->at[1];
        p->z[i] = own->z[i] + from->at[2];
    }
}

SMALL_GJK_INLINE support_result find_extreme_point(const simd_points *p, vec3 n, uint32_t blocks, int is_least) {
    (void)blocks;
    double sign = is_least ? -1 : 1;
    support_result best = simd_find_support_scalar(p, vec3_scale(n, sign));
    return (support_result){sign * best.value, best.index};
}

SMALL_GJK_INLINE void measure(met *m, const small_gjk_bodies *bodies, uint32_t blocks, vec3 n, int is_first) {
    (void)blocks;
    (void)is_first;
    const small_gjk_body *a = &bodies->a, *b = &bodies->b;
    support_result high = simd_find_support_scalar(&(simd_points){a->x, a->y, a->z, a->count}, n);
    support_result low = simd_find_support_scalar(&(simd_points){b->x, b->y, b->z, b->count}, vec3_neg(n));
    uint32_t i = m->a = high.index, k = m->b = low.index;
    m->gap = -low.value - high.value;
    m->w[0] = b->x[k] - a->x[i];
    m->w[1] = b->y[k] - a->y[i];
    m->w[2] = b->z[k] - a->z[i];
}

typedef corner_lanes corners;

SMALL_GJK_INLINE void corners_put(corners *c, unsigned i, const met *m) {
    c->x[i] = m->w[0];
    c->y[i] = m->w[1];
    c->z[i] = m->w[2];
}

SMALL_GJK_INLINE void corners_fill(corners *c, const met *m) {
    for (unsigned i = 0; i < 4; i++) corners_put(c, i, m);
}

SMALL_GJK_INLINE void corners_meet(corners *c, const small_gjk_query *q, const uint32_t a[4], const uint32_t b[4]) {
    double *axes[3] = {c->x, c->y, c->z};
    for (int i = 0; i < 4; i++) {
        double in_a[3] = {q->a.x[a[i]], q->a.y[a[i]], q->a.z[a[i]]};
        double in_b[3] = {q->b.x[b[i]], q->b.y[b[i]], q->b.z[b[i]]};
        for (int k = 0; k < 3; k++) {
            const double *u = q->rows_a + 3 * k, *v = q->rows_b + 3 * k;
            double at_a = ((u[0] * in_a[0] + u[1] * in_a[1]) + u[2] * in_a[2]) + 0;
            double at_b = ((v[0] * in_b[0] + v[1] * in_b[1]) + v[2] * in_b[2]) + q->offset[k];
            axes[k][i] = at_b - at_a;
        }
    }
}

SMALL_GJK_INLINE void corners_store(const corners *c, corner_lanes *at) { *at = *c; }

SMALL_GJK_INLINE corner_step corners_step(const corners *c, unsigned valid, const met *m) {
    return simd_step_from_corner_scalar(c, valid, vec3_at(m->w, 0));
}

SMALL_GJK_INLINE corner_step corners_step_filled(const corners *c, const met *m) { return corners_step(c, 1, m); }

#endif
