// The loop of small_gjk.h. Who includes it has defined
//   SMALL_GJK_INLINE         the attributes of its functions
//   pose_points(p, from, blocks), move_points(p, from, blocks), measure(m, bodies, blocks, n, is_first)
//   met                      a support: gap, point indices a and b, and the difference as the step takes it
//   met_get(m, w), met_set(m, w)   that difference as numbers, and from numbers
//   find_extreme_point(p, n, blocks, is_least)   the point of a body that is extreme along n, in its own frame
//   corners                  up to four such differences
//   corners_fill(c, m), corners_put(c, i, m), corners_store(c, at), corners_step(c, valid, m)
//   corners_step_filled(c, m)   corners_step from lane 0 alone, after corners_fill: most of its candidates are none
//   SMALL_GJK_CLASSES(do)    do(blocks) for the numbers of eights of points that are compiled for, in order, to 8
// with `blocks` known to the compiler.
#ifndef OVOID_SIMD_KERNELS_SMALL_GJK_H
#define OVOID_SIMD_KERNELS_SMALL_GJK_H

#include "simd/small_gjk.h"

#include <math.h>
#include <stddef.h>

// The state of the search: corners in lanes, those whose bit in `valid` is set, and the heading: the nearest point's
// direction, of any length, and its height along it times that length.
typedef struct walk {
    corners at;
    uint64_t ids; // of their points, 16 bits a lane
    unsigned valid;
    int is_filled; // all lanes are the one corner
    vec3 n;
    double height, square;
} walk;

// A search: what is asked, what is found, where it is, and the latest support.
typedef struct small_search {
    walk k;
    met m;
    const small_gjk_query *q;
    small_gjk_result *r;
} small_search;

// The number of a pair of points, of bodies of at most SMALL_GJK_POINTS.
SMALL_GJK_INLINE uint64_t get_id(uint32_t a, uint32_t b) { return (a & 0xff) | (b & 0xff) << 8; }

SMALL_GJK_INLINE void put_corner(walk *k, unsigned i, const met *m) {
    corners_put(&k->at, i, m);
    k->ids = (k->ids & ~((uint64_t)0xffff << 16 * i)) | get_id(m->a, m->b) << 16 * i;
}

// 1 if the support is one of the corners. All lanes are compared at once: of the differences one is zero, and only
// below the lowest zero does no borrow set a lane's highest bit.
SMALL_GJK_INLINE int is_known(const walk *k, const met *m) {
    static const uint64_t idle[8] = {~(uint64_t)0,
                                     ~(uint64_t)0xffff,
                                     ~(uint64_t)0xffff0000,
                                     ~(uint64_t)0xffffffff,
                                     ~(uint64_t)0xffff00000000,
                                     ~(uint64_t)0xffff0000ffff,
                                     ~(uint64_t)0xffffffff0000,
                                     ~(uint64_t)0xffffffffffff};
    const uint64_t ones = 0x0001000100010001;
    uint64_t off = (k->ids ^ get_id(m->a, m->b) * ones) | idle[k->valid & 7];
    return ((off - ones) & ~off & ones << 15) != 0;
}

// 1 if the bounds answer the query, as query_goal_is_met of pair/search.h says of pairs without allowances. Whether the
// sign is known in a step follows no pattern, so that only the whole is branched on.
SMALL_GJK_INLINE int is_answered(const small_gjk_query *q, double lower, double upper) {
    int is_narrow = (q->wants_bracket != 0) & (upper - lower <= q->tolerance);
    return ((lower > 0) | (upper < 0)) & ((upper <= q->near) | (upper < 0) | is_narrow);
}

// The step to the new corner: ON with the next heading, or how the search ends.
typedef enum step_end { STEP_ON, STEP_INSIDE, STEP_OPEN } step_end;

SMALL_GJK_INLINE step_end take_step(walk *k, const met *m) {
    double w[3];
    corner_step next = k->is_filled ? corners_step_filled(&k->at, m) : corners_step(&k->at, k->valid, m);
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
    k->is_filled = 0;
    k->valid = next.kept | 1u << place;
    k->n = (vec3){next.x, next.y, next.z};
    k->height = height;
    k->square = next.square;
    return STEP_ON;
}

SMALL_GJK_INLINE void write_direction(small_gjk_result *r, vec3 n, double scale, double gap) {
    r->n[0] = n.x;
    r->n[1] = n.y;
    r->n[2] = n.z;
    r->scale = scale;
    r->gap = gap;
}

SMALL_GJK_INLINE void write_walk(small_gjk_result *r, const walk *k) {
    corners_store(&k->at, &r->at);
    for (int i = 0; i < 4; i++) {
        r->a[i] = k->ids >> 16 * i & 0xff;
        r->b[i] = k->ids >> (16 * i + 8) & 0xff;
    }
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
SMALL_GJK_INLINE int look(small_search *s, double scale) {
    const small_gjk_query *q = s->q;
    small_gjk_result *r = s->r;
    walk *k = &s->k;
    const met *m = &s->m;
    double lower = find_lower(q, m, scale), upper = find_upper(q, k, scale);
    int is_apart = lower > q->far;
    if (is_apart | is_answered(q, lower, upper)) {
        write_direction(r, k->n, scale, m->gap);
        r->end = is_apart ? SMALL_GJK_APART : SMALL_GJK_NEAR;
        return 1;
    }
    r->end = SMALL_GJK_OPEN;
    if (is_known(k, m)) return 1;
    step_end end = take_step(k, m);
    if (end == STEP_INSIDE) r->end = SMALL_GJK_INSIDE;
    return end != STEP_ON;
}

SMALL_GJK_INLINE double turn_row(const double row[3], const simd_points *p, uint32_t i) {
    return (row[0] * p->x[i] + row[1] * p->y[i]) + row[2] * p->z[i];
}

// The difference of the support's points, in the world.
SMALL_GJK_INLINE void meet_points(const small_gjk_query *q, met *m) {
    double w[3];
    for (int c = 0; c < 3; c++)
        w[c] = (turn_row(q->rows_b + 3 * c, &q->b, m->b) + q->offset[c]) - turn_row(q->rows_a + 3 * c, &q->a, m->a);
    met_set(m, w);
}

// A direction of the world in the frame of a body.
SMALL_GJK_INLINE vec3 turn_back(const double rows[9], vec3 n) {
    double in_body[3];
    for (int c = 0; c < 3; c++) in_body[c] = (rows[c] * n.x + rows[3 + c] * n.y) + rows[6 + c] * n.z;
    return vec3_at(in_body, 0);
}

// The gap along a direction of bodies that are not posed: the direction is turned into their frames. Of the support
// only its points are known: meet_points.
SMALL_GJK_INLINE void measure_unposed(met *m, const small_gjk_query *q, uint32_t blocks, vec3 n) {
    support_result high = find_extreme_point(&q->a, turn_back(q->rows_a, n), blocks, 0);
    support_result low = find_extreme_point(&q->b, turn_back(q->rows_b, n), blocks, 1);
    m->a = high.index;
    m->b = low.index;
    m->gap = (vec3_dot(vec3_at(q->offset, 0), n) + low.value) - high.value;
}

// The support along n. bodies: posed, or NULL. is_first: what follows it is not waited for as long.
SMALL_GJK_INLINE void find_support(small_search *s, const small_gjk_bodies *bodies, uint32_t blocks, vec3 n,
                                   int is_first) {
    if (bodies) {
        measure(&s->m, bodies, blocks, n, is_first);
    } else {
        measure_unposed(&s->m, s->q, blocks, n);
        meet_points(s->q, &s->m);
    }
}

SMALL_GJK_INLINE void search(small_search *s, const small_gjk_bodies *bodies, uint32_t blocks) {
    const small_gjk_query *q = s->q;
    small_gjk_result *r = s->r;
    const walk *k = &s->k;
    r->end = SMALL_GJK_OPEN;
    for (r->iterations = 0;; r->iterations++) {
        double scale = 1 / sqrt(k->square);
        if (!(k->height * scale > q->claim) || r->iterations >= q->iterations) return;
        find_support(s, bodies, blocks, k->n, 0);
        if (look(s, scale)) return;
    }
}

// turned: the points turned to the world's axes, or NULL.
SMALL_GJK_INLINE void pose_body(small_gjk_body *p, const placed_points *from, const double *turned, uint32_t blocks) {
    if (!turned) {
        pose_points(p, from, blocks);
        return;
    }
    uint32_t count = from->points.padded_count;
    simd_points points = {turned, turned + count, turned + 2 * (size_t)count, count};
    move_points(p, &(placed_points){points, NULL, from->at}, blocks);
}

SMALL_GJK_INLINE void pose_bodies(const small_gjk_query *q, small_gjk_bodies *bodies, uint32_t blocks) {
    static const double nowhere[3] = {0, 0, 0};
    pose_body(&bodies->a, &(placed_points){q->a, q->rows_a, nowhere}, q->turned_a, blocks);
    pose_body(&bodies->b, &(placed_points){q->b, q->rows_b, q->offset}, q->turned_b, blocks);
}

// Points of the larger body, in eights: 1 to 8.
SMALL_GJK_INLINE uint32_t find_blocks(const small_gjk_query *q) {
    uint32_t count = q->a.padded_count > q->b.padded_count ? q->a.padded_count : q->b.padded_count;
    return count / 8;
}

// The support along the first direction. 1: the search has ended.
SMALL_GJK_INLINE int begin(small_search *s, const small_gjk_bodies *bodies, uint32_t blocks) {
    const small_gjk_query *q = s->q;
    small_gjk_result *r = s->r;
    walk *k = &s->k;
    met *m = &s->m;
    vec3 n = vec3_at(q->start, 0);
    double square = vec3_dot(n, n), scale = 1 / sqrt(square), w[3];
    find_support(s, bodies, blocks, n, 1);
    write_direction(r, n, scale, m->gap);
    r->iterations = 0;
    met_get(m, w);
    k->n = vec3_at(w, 0);
    k->height = k->square = vec3_dot(k->n, k->n);
    // The points of rounded bodies lie along their difference's own direction, which is measured next.
    double lower = m->gap * scale - q->lower_radii - q->claim;
    int is_apart = lower > q->far, is_sharp = !(q->lower_radii > 0);
    if (is_apart | (is_sharp & is_answered(q, lower, sqrt(k->square) - q->upper_radii + q->claim))) {
        end_at_support(r, m);
        return 1;
    }
    r->end = SMALL_GJK_OPEN;
    return !(k->square > 1e-150 && k->square < 1e150);
}

SMALL_GJK_INLINE void write_point(double to[3], const small_gjk_body *from, uint32_t i) {
    to[0] = from->x[i];
    to[1] = from->y[i];
    to[2] = from->z[i];
}

// The points behind an end at one corner.
SMALL_GJK_INLINE void write_points(small_gjk_result *r, const small_gjk_bodies *bodies) {
    if (r->valid != 1) return;
    write_point(r->point_a, &bodies->a, r->a[0]);
    write_point(r->point_b, &bodies->b, r->b[0]);
}

// bodies: posed, or NULL.
SMALL_GJK_INLINE void run_search(const small_gjk_query *q, const small_gjk_bodies *bodies, uint32_t blocks,
                                 small_gjk_result *r) {
    small_search s;
    s.q = q;
    s.r = r;
    if (begin(&s, bodies, blocks)) return;
    corners_fill(&s.k.at, &s.m);
    s.k.ids = get_id(s.m.a, s.m.b);
    s.k.valid = 1;
    s.k.is_filled = 1;
    search(&s, bodies, blocks);
    if (r->end == SMALL_GJK_APART)
        end_at_support(r, &s.m);
    else
        write_walk(r, &s.k);
}

// bodies: room for them, or NULL to leave them unposed.
SMALL_GJK_INLINE void run(const small_gjk_query *q, small_gjk_bodies *bodies, uint32_t blocks, small_gjk_result *r) {
    if (bodies) pose_bodies(q, bodies, blocks);
    run_search(q, bodies, blocks, r);
    if (bodies && r->end != SMALL_GJK_OPEN) write_points(r, bodies);
}

// Runs RUN of the first class that has room for both bodies.
#define SMALL_GJK_RUN(class)                                                                                           \
    if (blocks <= (class)) {                                                                                           \
        RUN(class);                                                                                                    \
        return;                                                                                                        \
    }

SMALL_GJK_INLINE void run_class(const small_gjk_query *q, small_gjk_result *r) {
    uint32_t blocks = find_blocks(q);
    small_gjk_bodies bodies;
#define RUN(class) run(q, &bodies, class, r)
    SMALL_GJK_CLASSES(SMALL_GJK_RUN)
#undef RUN
}

SMALL_GJK_INLINE void run_unposed_class(const small_gjk_query *q, small_gjk_result *r) {
    uint32_t blocks = find_blocks(q);
#define RUN(class) run(q, NULL, class, r)
    SMALL_GJK_CLASSES(SMALL_GJK_RUN)
#undef RUN
}

#endif
