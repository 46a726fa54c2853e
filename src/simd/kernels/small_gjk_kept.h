// The search of small_gjk.h from what an earlier one left. Who includes it has included kernels/small_gjk.h and defined
//   corners_meet(c, q, a, b) the differences of four points b and a, posed
#ifndef OVOID_SIMD_KERNELS_SMALL_GJK_KEPT_H
#define OVOID_SIMD_KERNELS_SMALL_GJK_KEPT_H

#include "simd/kernels/small_gjk.h"

// The point of one to three corners that is nearest to the origin, where it lies between all of them.
typedef struct kept_point {
    vec3 n;                ///< its direction, of any length,
    double square, height; ///< |n|^2 and n times the point
    double part[3], sum;   ///< weights times their sum
} kept_point;

SMALL_GJK_INLINE vec3 get_lane(const corner_lanes *c, int i) { return (vec3){c->x[i], c->y[i], c->z[i]}; }

SMALL_GJK_INLINE int find_between_two(vec3 a, vec3 b, kept_point *p) {
    vec3 e = vec3_sub(b, a);
    double to_b = -vec3_dot(a, e);
    p->n = vec3_cross(e, vec3_cross(a, e));
    p->sum = vec3_dot(e, e);
    p->part[0] = p->sum - to_b;
    p->part[1] = to_b;
    p->part[2] = 0;
    return (to_b > 0) & (to_b < p->sum);
}

// The parts are the areas of the triangles that the origin's projection makes with the edges; of a sliver the normal is
// uncertain (corner.h).
SMALL_GJK_INLINE int find_between_three(vec3 a, vec3 b, vec3 c, kept_point *p) {
    vec3 e = vec3_sub(b, a), f = vec3_sub(c, a), n = vec3_cross(e, f);
    double u = vec3_dot(n, vec3_cross(b, c)), v = vec3_dot(n, vec3_cross(c, a)), w = vec3_dot(n, vec3_cross(a, b));
    p->n = vec3_dot(n, a) < 0 ? vec3_neg(n) : n;
    p->part[0] = u;
    p->part[1] = v;
    p->part[2] = w;
    p->sum = (u + v) + w;
    return (u > 0) & (v > 0) & (w > 0) & (vec3_dot(n, n) > 1e-4 * (vec3_dot(e, e) * vec3_dot(f, f)));
}

SMALL_GJK_INLINE int find_between(const corner_lanes *c, uint32_t count, kept_point *p) {
    vec3 a = get_lane(c, 0);
    int is_between = 1;
    if (count == 1)
        *p = (kept_point){.n = a, .part = {1}, .sum = 1};
    else if (count == 2)
        is_between = find_between_two(a, get_lane(c, 1), p);
    else
        is_between = find_between_three(a, get_lane(c, 1), get_lane(c, 2), p);
    p->square = vec3_dot(p->n, p->n);
    p->height = vec3_dot(p->n, a);
    return is_between & (p->square > 1e-150) & (p->square < 1e150);
}

// The lane of the nearest corner of three, and its difference. Which one it is no branch could foresee.
SMALL_GJK_INLINE unsigned find_nearest(const corners *c, double w[3]) {
    corner_lanes at;
    double square[3];
    corners_store(c, &at);
    for (int i = 0; i < 3; i++) square[i] = (at.x[i] * at.x[i] + at.y[i] * at.y[i]) + at.z[i] * at.z[i];
    unsigned nearest = square[1] < square[0];
    double least = nearest ? square[1] : square[0];
    nearest = square[2] < least ? 2 : nearest;
    w[0] = at.x[nearest];
    w[1] = at.y[nearest];
    w[2] = at.z[nearest];
    return nearest;
}

// The walk at another point of the kept corners; 0 where there is no certain one. The step is told that the nearest
// corner is the new one: nearly always it is one of those that hold the nearest point.
SMALL_GJK_INLINE int step_at_kept(const small_gjk_kept *kept, walk *k) {
    met m;
    double w[3];
    unsigned nearest = find_nearest(&k->at, w);
    met_set(&m, w);
    m.a = kept->a[nearest];
    m.b = kept->b[nearest];
    k->valid = ((1u << kept->count) - 1) & ~(1u << nearest);
    // Any height is a gain.
    k->height = 1e150;
    k->square = 1;
    return take_step(k, &m) == STEP_ON;
}

// The kept corners as they are posed now.
SMALL_GJK_INLINE void meet_kept(const small_gjk_query *q, const small_gjk_kept *kept, walk *k, small_gjk_result *r) {
    corners_meet(&k->at, q, kept->a, kept->b);
    corners_store(&k->at, &r->at);
    k->ids = 0;
    for (int i = 0; i < 4; i++) k->ids |= get_id(kept->a[i], kept->b[i]) << 16 * i;
    k->valid = (1u << kept->count) - 1;
    k->is_filled = 0;
}

// The walk at the nearest point of the kept corners. 1: it lies between them, as before; 0: not all hold
// it; -1: no certain one.
SMALL_GJK_INLINE int begin_at_kept(small_search *s, const small_gjk_kept *kept, kept_point *p) {
    walk *k = &s->k;
    meet_kept(s->q, kept, k, s->r);
    if (!find_between(&s->r->at, kept->count, p)) return step_at_kept(kept, k) ? 0 : -1;
    k->n = p->n;
    k->height = p->height;
    k->square = p->square;
    return 1;
}

// Ends at the point between the kept corners, which are stored.
SMALL_GJK_INLINE void end_at_kept(small_gjk_result *r, const small_gjk_kept *kept, const kept_point *p) {
    double scale = 1 / p->sum;
    vec3 point = {0, 0, 0};
    for (unsigned i = 0; i < 3; i++) {
        uint32_t is_kept = -(uint32_t)(i < kept->count);
        r->a[i] = is_kept & kept->a[i];
        r->b[i] = is_kept & kept->b[i];
        r->weight[i] = p->part[i] * scale;
        point = vec3_add_scaled(point, get_lane(&r->at, (int)i), r->weight[i]);
    }
    r->distance = vec3_norm(point);
    r->valid = (1u << kept->count) - 1;
    r->end = SMALL_GJK_KEPT;
}

SMALL_GJK_INLINE void run_kept(const small_gjk_query *q, const small_gjk_kept *kept, uint32_t blocks,
                               small_gjk_result *r) {
    small_gjk_bodies bodies;
    small_search s;
    kept_point p;
    s.q = q;
    s.r = r;
    r->iterations = 0;
    r->end = SMALL_GJK_OPEN;
    int is_between = begin_at_kept(&s, kept, &p);
    if (is_between < 0) return;
    double scale = 1 / sqrt(s.k.square);
    if (!(s.k.height * scale > q->claim)) return;
    measure_unposed(&s.m, q, blocks, s.k.n);
    write_direction(r, s.k.n, scale, s.m.gap);
    if (is_between && is_near(q, &s.k, &s.m, scale)) {
        end_at_kept(r, kept, &p);
        return;
    }
    meet_points(q, &s.m);
    if (!look(&s, scale)) {
        pose_bodies(q, &bodies, blocks);
        search(&s, &bodies, blocks);
        r->iterations++;
    }
    if (r->end == SMALL_GJK_APART)
        end_at_support(r, &s.m);
    else
        write_walk(r, &s.k);
}

// The point between the kept corners, without a support.
SMALL_GJK_INLINE void find_kept(const small_gjk_query *q, const small_gjk_kept *kept, small_gjk_result *r) {
    walk k;
    kept_point p;
    r->iterations = 0;
    r->end = SMALL_GJK_OPEN;
    meet_kept(q, kept, &k, r);
    if (!find_between(&r->at, kept->count, &p)) return;
    double scale = 1 / sqrt(p.square);
    if (!(p.height * scale > q->claim)) return;
    write_direction(r, p.n, scale, 0);
    end_at_kept(r, kept, &p);
}

SMALL_GJK_INLINE void run_kept_class(const small_gjk_query *q, const small_gjk_kept *kept, small_gjk_result *r) {
    uint32_t blocks = find_blocks(q);
#define RUN(class) run_kept(q, kept, class, r)
    SMALL_GJK_CLASSES(SMALL_GJK_RUN)
#undef RUN
}

#endif
