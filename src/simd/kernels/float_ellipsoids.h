// The ellipsoids of float_gjk.h, written once over lanes of floats. The steps are those of kernels/pair8.h, of one
// improvement at most. Errors (docs/error-analysis.md): two claims for a gap along a direction, and of the quadratic
// forms so many u of the trace.
#include "simd/kernels/float_columns.h"

#define SPREAD_A (16 * 0x1p-24)
#define SPREAD_B (64 * 0x1p-24)

// The ellipsoids of one body of each lane, times the factor into the couple's unit.
typedef struct float_body {
    float_column row[24];
} float_body;

LANES_INLINE void read_part(const float_shape *const bodies[FLOATS], int i, int at, lane c[8]) {
    const float *rows[FLOATS];
    for (int k = at; k < at + LANES; k++) rows[k] = bodies[k]->row + 8 * i;
    read_eight(rows, at, c);
}

// Returns the factor.
LANES_INLINE lane read_body(const float_shape *const bodies[FLOATS], lane scale, float_body *to, int at, int is_inner) {
    lane c[24];
    read_part(bodies, 1, at, c + 8);
    lane factor = c[FLOAT_UNIT] * scale;
    read_part(bodies, 0, at, c);
    if (is_inner) read_part(bodies, 2, at, c + 16);
    for (int j = 0; j < (is_inner ? 24 : 16); j++) put(&to->row[j], at, c[j] * factor);
    return factor;
}

LANES_INLINE lane6 get6(const float_column *c, int at) {
    return (lane6){get(c, at), get(c + 1, at), get(c + 2, at), get(c + 3, at), get(c + 4, at), get(c + 5, at)};
}

// Of B's point minus A's, both about the spheres' centres.
LANES_INLINE lane3 get_difference(const float_query *q, lane3 a, lane3 b, int at) {
    lane3 turned = lane9_mul3(get9(q->rotation, at), b);
    return lane3_sub(lane3_add(turned, get3(q->translation, at)), a);
}

// |W y|. The row has W times the factor from the shape's unit; `inverse` is 1 / factor^2.
LANES_INLINE lane compute_inner_norm(const float_column *w, lane3 y, lane inverse, int at) {
    lane3 v = {get(w, at) * y.x, get(w + 1, at) * y.x + get(w + 2, at) * y.y,
               (get(w + 3, at) * y.x + get(w + 4, at) * y.y) + get(w + 5, at) * y.z};
    return lane3_norm(lane3_scale(v, inverse));
}

// A common point of the inner ellipsoids, on the line of their centres, of equal norm k in both. The balls around it
// inside them show the depth. Two claims are more than the errors of the point and of W.
LANES_INLINE lane_mask find_common(const float_query *q, const float_body *a, const float_body *b, lane *upper,
                                   int at) {
    lane one = lane_set(1), most = lane_set(0.9999), zero = lane_set(0), twice = lane_set(2) * get(&q->claim, at);
    lane factor_a = get(&q->factor_a, at), factor_b = get(&q->factor_b, at);
    lane least_a = get(&a->row[FLOAT_LEAST], at), least_b = get(&b->row[FLOAT_LEAST], at);
    lane3 d = get_difference(q, get3(a->row + FLOAT_INNER, at), get3(b->row + FLOAT_INNER, at), at);
    lane3 in_b = lane9_mul3_transposed(get9(q->rotation, at), d);
    lane ka = compute_inner_norm(a->row + FLOAT_INNER_W, d, one / (factor_a * factor_a), at);
    lane kb = compute_inner_norm(b->row + FLOAT_INNER_W, in_b, one / (factor_b * factor_b), at);
    lane k = (ka * kb / ((ka + kb) + lane_set(1e-20))) * lane_set(1 + 1e-5);
    lane na = k + twice / least_a, nb = k + twice / least_b;
    lane depth = lane_set(0.999) * ((one - na) * least_a + (one - nb) * least_b);
    lane_mask is_solid = lane_and(lane_greater(least_a, zero), lane_greater(least_b, zero));
    lane_mask is_inside = lane_and(lane_less(na, most), lane_less(nb, most));
    *upper = zero - depth;
    return lane_and(lane_and(is_solid, is_inside), lane_greater(depth, twice));
}

// The outer ellipsoids, B's in the axes of A.
typedef struct float_outer {
    lane6 qa, qb;
    lane spread_a, spread_b; // what rounding may add to the quadratic forms
    lane3 d;                 // of the centres
} float_outer;

LANES_INLINE float_outer get_outer(const float_query *q, const float_body *a, const float_body *b, int at) {
    float_outer o;
    lane6 qb = lane6_scale(get6(b->row + FLOAT_OUTER_Q, at), get(&q->factor_b, at));
    o.qa = lane6_scale(get6(a->row + FLOAT_OUTER_Q, at), get(&q->factor_a, at));
    o.qb = lane6_rotate(qb, get9(q->rotation, at));
    o.spread_a = lane_set(SPREAD_A) * lane6_trace(o.qa);
    o.spread_b = lane_set(SPREAD_B) * lane6_trace(qb);
    o.d = get_difference(q, get3(a->row + FLOAT_OUTER, at), get3(b->row + FLOAT_OUTER, at), at);
    return o;
}

// The gap along a direction of about unit length, and the ellipsoids' half widths.
typedef struct float_gap {
    lane gap, a, b;
} float_gap;

LANES_INLINE float_gap measure_outer(const float_outer *o, lane3 n) {
    lane zero = lane_set(0);
    lane a = lane_sqrt(lane_max(lane3_dot(n, lane6_mul3(o->qa, n)), zero) + o->spread_a);
    lane b = lane_sqrt(lane_max(lane3_dot(n, lane6_mul3(o->qb, n)), zero) + o->spread_b);
    return (float_gap){lane3_dot(n, o->d) - a - b, a, b};
}

LANES_INLINE lane3 make_unit(lane3 n, lane_mask *good) {
    lane square = lane3_dot(n, n);
    *good = lane_greater(square, lane_set(1e-30));
    return lane3_scale(n, lane_set(1) / lane_sqrt(square));
}

// improve_direction of kernels/pair8.h.
LANES_INLINE lane3 improve(const float_outer *o, const float_gap *g) {
    lane6 m = lane6_add(lane6_scale(o->qa, g->b), lane6_scale(o->qb, g->a));
    lane thickness = lane_max(g->gap * (g->a * g->b), lane_set(1e-4) * lane6_trace(m));
    m.xx = m.xx + thickness;
    m.yy = m.yy + thickness;
    m.zz = m.zz + thickness;
    return lane6_mul3(lane6_adjugate(m), o->d);
}

// Parts lanes along the line of the outer ellipsoids' centres or, if that leaves one open, along the improved one. The
// direction is where a search begins, unless the ellipsoids overlap much: then it is the line of the spheres' centres.
LANES_INLINE unsigned part(float_query *q, const float_body *a, const float_body *b, float_bounds *out, int at,
                           unsigned open, lane size) {
    lane claim = get(&q->claim, at), far = get(&q->far, at), zero = lane_set(0), twice = claim + claim;
    float_outer o = get_outer(q, a, b, at);
    lane_mask good, better;
    lane3 n = make_unit(o.d, &good), line = get3(q->translation, at);
    float_gap g = measure_outer(&o, n);
    lane lower = g.gap - twice;
    lane_mask apart = lane_and(good, lane_greater(lower, far));
    if (open & ~lane_bits(apart)) {
        lane3 next = make_unit(improve(&o, &g), &better);
        float_gap h = measure_outer(&o, next);
        // A lane that the line parts ends with that bound, whatever the others do.
        better = lane_and(lane_and(better, lane_greater(h.gap, g.gap)), lane_not(apart));
        n = lane3_select(better, next, n);
        g.gap = lane_select(better, h.gap, g.gap);
        lower = g.gap - twice;
        good = lane_or(good, better);
        apart = lane_and(good, lane_greater(lower, far));
    }
    // Bodies around one centre begin along any direction.
    line = lane3_select(lane_greater(lane3_dot(line, line), lane_set(1e-12)), line, (lane3){lane_set(1), zero, zero});
    lane_mask takes = lane_and(good, lane_greater(g.gap, lane_set(-0.05) * size));
    put3(q->start, at, lane3_select(takes, n, line));
    put(&out->lower, at, lower);
    return lane_bits(apart) & open;
}

LANES_TARGET static void run_float_ellipsoids(const float_shapes *from, unsigned lanes, float_query *q,
                                              float_bounds *out) {
    float_body a, b;
    out->apart = out->inside = 0;
    for (int at = 0; has_more(lanes, at); at += LANES) {
        unsigned open = get_lanes(lanes, at);
        if (!open) continue;
        // The inner ones are worth a look where the spheres overlap by 0.4 of their radii: |t| < 0.6 (z - |t|).
        lane3 t = get3(q->translation, at);
        lane size = get(&q->size, at), upper = lane_set(0);
        unsigned deep = lane_bits(lane_less(lane3_norm(t), lane_set(0.375) * size)) & open;
        put(&q->factor_a, at, read_body(from->a, get(&q->scale, at), &a, at, deep != 0));
        put(&q->factor_b, at, read_body(from->b, get(&q->scale, at), &b, at, deep != 0));
        unsigned inside = 0;
        if (deep) {
            inside = lane_bits(find_common(q, &a, &b, &upper, at)) & deep;
            put(&out->upper, at, upper);
            out->inside |= inside << at;
        }
        open &= ~inside;
        if (open) out->apart |= part(q, &a, &b, out, at, open, size) << at;
    }
}
