// The loop of small_gjk.h. Who includes it has defined
//   SMALL_GJK_INLINE         the attributes of its functions
//   pose_points(p, from, rows, t, blocks), move_points(p, from, t, blocks), measure(m, a, b, blocks, x, y, z)
//   met                      a support: gap, point indices a and b, and the difference as the step takes it
//   met_get(m, w)            that difference as numbers
//   corners                  up to four such differences
//   corners_fill(c, m), corners_put(c, i, m), corners_store(c, at), corners_step(c, valid, m)
// with `blocks`, the number of eights of points, known to the compiler.
#ifndef OVOID_SIMD_KERNELS_SMALL_GJK_H
#define OVOID_SIMD_KERNELS_SMALL_GJK_H

#include "simd/small_gjk.h"

#include <math.h>
#include <stddef.h>

// The state of the search: corners in lanes, those whose bit in `valid` is set, and the heading: the nearest point's
// direction, of any length, and its height along it times that length.
typedef struct walk {
    corners at;
    uint32_t a[4], b[4];
    unsigned valid;
    double x, y, z, height, square;
} walk;

SMALL_GJK_INLINE void put_corner(walk *k, unsigned i, const met *m) {
    corners_put(&k->at, i, m);
    k->a[i] = m->a;
    k->b[i] = m->b;
}

SMALL_GJK_INLINE int is_known(const walk *k, const met *m) {
    int known = 0;
    for (int i = 0; i < 3; i++) known |= (k->a[i] == m->a) & (k->b[i] == m->b) & (int)(k->valid >> i);
    return known & 1;
}

// 1 if the bounds answer the query, as query_goal_is_met of pair/search.h says of pairs without allowances.
SMALL_GJK_INLINE int is_answered(const small_gjk_query *q, double lower, double upper) {
    return (lower > 0 || upper < 0) &&
           (upper <= q->near || upper < 0 || (q->wants_bracket && upper - lower <= q->tolerance));
}

// The step to the new corner: ON with the next heading, or how the search ends.
typedef enum step_end { STEP_ON, STEP_INSIDE, STEP_OPEN } step_end;

SMALL_GJK_INLINE step_end take_step(walk *k, const met *m) {
    double w[3];
    corner_step next = corners_step(&k->at, k->valid, m);
    met_get(m, w);
    double height = (next.x * w[0] + next.y * w[1]) + next.z * w[2];
    int gains = height * height * k->square < k->height * k->height * next.square && next.square > 1e-150 &&
                next.square < 1e150;
    if (next.is_inside) {
        put_corner(k, 3, m);
        k->valid = 15;
        return STEP_INSIDE;
    }
    if (!gains || next.is_sliver) return STEP_OPEN;
    unsigned place = (unsigned)__builtin_ctz(~next.kept);
    put_corner(k, place, m);
    k->valid = next.kept | 1u << place;
    k->x = next.x;
    k->y = next.y;
    k->z = next.z;
    k->height = height;
    k->square = next.square;
    return STEP_ON;
}

SMALL_GJK_INLINE void write_direction(small_gjk_result *r, double x, double y, double z, double square, double gap) {
    r->n[0] = x;
    r->n[1] = y;
    r->n[2] = z;
    r->square = square;
    r->gap = gap;
}

SMALL_GJK_INLINE void write_walk(small_gjk_result *r, const walk *k) {
    corners_store(&k->at, &r->at);
    for (int i = 0; i < 4; i++) r->a[i] = k->a[i], r->b[i] = k->b[i];
    r->valid = k->valid;
}

// Ends with the support as the only corner.
SMALL_GJK_INLINE void end_at_support(small_gjk_result *r, const met *m) {
    double w[3];
    met_get(m, w);
    r->at.x[0] = w[0];
    r->at.y[0] = w[1];
    r->at.z[0] = w[2];
    r->a[0] = m->a;
    r->b[0] = m->b;
    r->valid = 1;
    r->end = SMALL_GJK_APART;
}

// The bounds along the walk's heading. scale: 1 over its length.
SMALL_GJK_INLINE double find_lower(const small_gjk_query *q, const met *m, double scale) {
    return m->gap * scale - q->lower_radii - q->claim;
}
SMALL_GJK_INLINE double find_upper(const small_gjk_query *q, const walk *k, double scale) {
    return k->height * scale - q->upper_radii + q->claim;
}

// 1 if they answer the query, by the upper one too.
SMALL_GJK_INLINE int is_near(const small_gjk_query *q, const walk *k, const met *m, double scale) {
    double lower = find_lower(q, m, scale);
    return !(lower > q->far) && is_answered(q, lower, find_upper(q, k, scale));
}

// What a support along the walk's heading says, and the step to it: 1 where that ends the search.
SMALL_GJK_INLINE int look(const small_gjk_query *q, walk *k, const met *m, double scale, small_gjk_result *r) {
    double lower = find_lower(q, m, scale), upper = find_upper(q, k, scale);
    int is_apart = lower > q->far;
    if (is_apart || is_answered(q, lower, upper)) {
        write_direction(r, k->x, k->y, k->z, k->square, m->gap);
        r->end = is_apart ? SMALL_GJK_APART : SMALL_GJK_NEAR;
        return 1;
    }
    r->end = SMALL_GJK_OPEN;
    if (is_known(k, m)) return 1;
    step_end end = take_step(k, m);
    if (end == STEP_INSIDE) r->end = SMALL_GJK_INSIDE;
    return end != STEP_ON;
}

SMALL_GJK_INLINE void search(const small_gjk_query *q, const small_gjk_body *a, const small_gjk_body *b,
                             uint32_t blocks, walk *k, met *m, small_gjk_result *r) {
    r->end = SMALL_GJK_OPEN;
    for (r->iterations = 0;; r->iterations++) {
        double scale = 1 / sqrt(k->square);
        if (!(k->height * scale > q->claim) || r->iterations >= q->iterations) return;
        measure(m, a, b, blocks, k->x, k->y, k->z);
        if (look(q, k, m, scale, r)) return;
    }
}

SMALL_GJK_INLINE void pose_body(small_gjk_body *p, const simd_points *from, const double *turned, const double rows[9],
                                const double t[3], uint32_t blocks) {
    if (!turned) {
        pose_points(p, from, rows, t, blocks);
        return;
    }
    uint32_t count = from->padded_count;
    simd_points at = {turned, turned + count, turned + 2 * (size_t)count, count};
    move_points(p, &at, t, blocks);
}

SMALL_GJK_INLINE void pose_bodies(const small_gjk_query *q, small_gjk_body *a, small_gjk_body *b, uint32_t blocks) {
    static const double nowhere[3] = {0, 0, 0};
    pose_body(a, &q->a, q->turned_a, q->rows_a, nowhere, blocks);
    pose_body(b, &q->b, q->turned_b, q->rows_b, q->offset, blocks);
}

// Points of the larger body, in eights: 1 to 4.
SMALL_GJK_INLINE uint32_t find_blocks(const small_gjk_query *q) {
    uint32_t count = q->a.padded_count > q->b.padded_count ? q->a.padded_count : q->b.padded_count;
    return count / 8;
}

// Poses the bodies, and measures along the first direction. 1: the search has ended.
SMALL_GJK_INLINE int begin(const small_gjk_query *q, small_gjk_body *a, small_gjk_body *b, uint32_t blocks, walk *k,
                           met *m, small_gjk_result *r) {
    pose_bodies(q, a, b, blocks);
    double x = q->start[0], y = q->start[1], z = q->start[2], square = (x * x + y * y) + z * z, w[3];
    measure(m, a, b, blocks, x, y, z);
    write_direction(r, x, y, z, square, m->gap);
    r->iterations = 0;
    met_get(m, w);
    k->x = w[0];
    k->y = w[1];
    k->z = w[2];
    k->height = k->square = (w[0] * w[0] + w[1] * w[1]) + w[2] * w[2];
    // The points of rounded bodies lie along their difference's own direction, which is measured next.
    double lower = m->gap * (1 / sqrt(square)) - q->lower_radii - q->claim;
    int is_apart = lower > q->far, is_round = q->lower_radii > 0;
    if (is_apart || (!is_round && is_answered(q, lower, sqrt(k->square) - q->upper_radii + q->claim))) {
        end_at_support(r, m);
        return 1;
    }
    r->end = SMALL_GJK_OPEN;
    return !(k->square > 1e-150 && k->square < 1e150);
}

SMALL_GJK_INLINE void run(const small_gjk_query *q, uint32_t blocks, small_gjk_result *r) {
    small_gjk_body a, b;
    met m;
    walk k;
    if (begin(q, &a, &b, blocks, &k, &m, r)) return;
    corners_fill(&k.at, &m);
    for (int i = 0; i < 4; i++) k.a[i] = m.a, k.b[i] = m.b;
    k.valid = 1;
    search(q, &a, &b, blocks, &k, &m, r);
    if (r->end == SMALL_GJK_APART)
        end_at_support(r, &m);
    else
        write_walk(r, &k);
}

SMALL_GJK_INLINE void run_class(const small_gjk_query *q, small_gjk_result *r) {
    switch (find_blocks(q)) {
    case 1: run(q, 1, r); break;
    case 2: run(q, 2, r); break;
    case 3: run(q, 3, r); break;
    default: run(q, 4, r); break;
    }
}

#endif
