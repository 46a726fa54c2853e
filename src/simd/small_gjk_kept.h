// The search of small_gjk.h from what an earlier one left. Who includes it has included small_gjk_kernel.h and defined
//   met_set(m, w)            the difference of a support, from numbers
//   corners_meet(c, q, a, b) the differences of four points b and a, posed
//   find_extreme_point(p, n, blocks, is_least, value)   the point of a body that is extreme along n, in its own frame
#include "simd/small_gjk_kernel.h"

SMALL_GJK_INLINE double turn_row(const double row[3], const simd_points *p, uint32_t i) {
    return (row[0] * p->x[i] + row[1] * p->y[i]) + row[2] * p->z[i];
}

// The difference of point k of B and point i of A, in the world.
SMALL_GJK_INLINE void meet_points(const small_gjk_query *q, uint32_t i, uint32_t k, met *m) {
    double w[3];
    for (int c = 0; c < 3; c++)
        w[c] = (turn_row(q->rows_b + 3 * c, &q->b, k) + q->offset[c]) - turn_row(q->rows_a + 3 * c, &q->a, i);
    met_set(m, w);
    m->a = i;
    m->b = k;
}

// The support along a direction before the bodies are posed: the direction is turned into their frames.
SMALL_GJK_INLINE void measure_unposed(met *m, const small_gjk_query *q, uint32_t blocks, double x, double y, double z) {
    const double *ra = q->rows_a, *rb = q->rows_b, *o = q->offset;
    double in_a[3], in_b[3], high, low;
    for (int c = 0; c < 3; c++) {
        in_a[c] = (ra[c] * x + ra[3 + c] * y) + ra[6 + c] * z;
        in_b[c] = (rb[c] * x + rb[3 + c] * y) + rb[6 + c] * z;
    }
    uint32_t i = find_extreme_point(&q->a, in_a, blocks, 0, &high),
             k = find_extreme_point(&q->b, in_b, blocks, 1, &low);
    m->gap = (((o[0] * x + o[1] * y) + o[2] * z) + low) - high;
    meet_points(q, i, k, m);
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

// The walk at the nearest point of the kept corners, posed anew; 0 where there is no certain one. The step is told that
// the nearest corner is the new one: nearly always it is one of those that hold the nearest point.
SMALL_GJK_INLINE int begin_at_kept(const small_gjk_query *q, const small_gjk_kept *kept, walk *k) {
    met m;
    double w[3];
    for (unsigned i = 0; i < 4; i++) {
        unsigned at = i < kept->count ? i : 0;
        k->a[i] = kept->a[at];
        k->b[i] = kept->b[at];
    }
    corners_meet(&k->at, q, k->a, k->b);
    unsigned nearest = find_nearest(&k->at, w);
    met_set(&m, w);
    m.a = k->a[nearest];
    m.b = k->b[nearest];
    k->valid = ((1u << kept->count) - 1) & ~(1u << nearest);
    // Any height is a gain.
    k->height = 1e150;
    k->square = 1;
    return take_step(k, &m) == STEP_ON;
}

SMALL_GJK_INLINE void run_kept(const small_gjk_query *q, const small_gjk_kept *kept, uint32_t blocks,
                               small_gjk_result *r) {
    small_gjk_body a, b;
    met m;
    walk k;
    r->iterations = 0;
    r->end = SMALL_GJK_OPEN;
    if (!begin_at_kept(q, kept, &k)) return;
    double scale = 1 / sqrt(k.square);
    if (!(k.height * scale > q->claim)) return;
    measure_unposed(&m, q, blocks, k.x, k.y, k.z);
    write_direction(r, k.x, k.y, k.z, k.square, m.gap);
    if (!look(q, &k, &m, scale, r)) {
        pose_bodies(q, &a, &b, blocks);
        search(q, &a, &b, blocks, &k, &m, r);
        r->iterations++;
    }
    if (r->end == SMALL_GJK_APART)
        end_at_support(r, &m);
    else
        write_walk(r, &k);
}

SMALL_GJK_INLINE void run_kept_class(const small_gjk_query *q, const small_gjk_kept *kept, small_gjk_result *r) {
    switch (find_blocks(q)) {
    case 1: run_kept(q, kept, 1, r); break;
    case 2: run_kept(q, kept, 2, r); break;
    case 3: run_kept(q, kept, 3, r); break;
    default: run_kept(q, kept, 4, r); break;
    }
}
