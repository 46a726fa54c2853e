// The step of group_gjk.h, written once over lanes; kernels/group_gjk.h includes this. It has the operations of
// kernels/small_gjk.h and corner.c in their order: a change there is a change here, and
// tests/core/simd/test_simd_gjk8.c sees the difference.
#include "simd/gjk8.h"
#include "simd/kernels/lane_columns.h"
#include "simd/kernels/simplex_step.h"
#include "simd/kernels/small_gjk.h"

// ---- columns

LANES_INLINE void put_some(lane_column *c, int at, lane_mask some, lane v) {
    put(c, at, lane_select(some, v, get(c, at)));
}
LANES_INLINE lane_mask get_truth(const lane_column *c, int at) { return lane_greater(get(c, at), lane_set(0.5)); }

// ---- the tests, and the step of the simplex

LANES_INLINE lane_mask is_answered_at(const gjk8 *g, int at, lane lower, lane upper) {
    lane zero = lane_set(0);
    lane_mask is_overlap = lane_less(upper, zero);
    lane_mask enough = lane_or(lane_at_most(upper, lane_set(g->near)), is_overlap);
    if (g->wants_bracket) enough = lane_or(enough, lane_at_most(upper - lower, get(&g->tolerance, at)));
    return lane_and(lane_or(lane_greater(lower, zero), is_overlap), enough);
}

// A new corner: its difference and which points it is of.
typedef struct lane_corner {
    lane3 w;
    lane id;
} lane_corner;

// In the lanes that take the step the new corner takes the place of the first that does not stay.
LANES_INLINE void replace_corner(gjk8 *g, int at, const lane_step *s, const lane_corner *corner) {
    lane_mask taken = lane_not(s->goes);
    for (int i = 0; i < 3; i++) {
        lane_mask here = lane_and(lane_not(taken), lane_not(s->keeps[i]));
        taken = lane_or(taken, here);
        put_some(&g->old[i].x, at, here, corner->w.x);
        put_some(&g->old[i].y, at, here, corner->w.y);
        put_some(&g->old[i].z, at, here, corner->w.z);
        put_some(&g->old[i].id, at, here, corner->id);
        lane_mask stays = lane_or(here, s->keeps[i]);
        put_some(&g->is_valid[i], at, s->goes, lane_select(stays, lane_set(1), lane_set(0)));
    }
}

// How the tests before the step leave the lanes.
typedef struct lane_tests {
    lane_mask apart, near, goes;
} lane_tests;

// The bounds, and whether they answer the query.
LANES_INLINE lane_tests test_lanes(gjk8 *g, int at, lane length_of_w) {
    lane claim = get(&g->claim, at), gap = get(&g->gap, at);
    lane scale = lane_set(1) / lane_sqrt(get(&g->square, at)), length = get(&g->height, at) * scale;
    lane_mask goes = lane_and(lane_greater(length, claim), lane_less(get(&g->steps, at), get(&g->most, at)));
    lane lower = gap * scale - get(&g->lower_radii, at) - claim, upper = length - get(&g->upper_radii, at) + claim;
    lane_mask apart = lane_and(goes, lane_greater(lower, lane_set(g->far)));
    lane_mask near = lane_and(lane_and(goes, is_answered_at(g, at, lower, upper)), lane_not(apart));
    put(&g->lower, at, lower);
    put(&g->upper, at, length_of_w - get(&g->upper_radii, at) + claim);
    return (lane_tests){apart, near, lane_and(goes, lane_not(lane_or(apart, near)))};
}

LANES_INLINE gjk8_ends advance_lanes(gjk8 *g, int at) {
    lane3 w = get3(&g->fresh.x, at);
    lane id = get(&g->fresh.id, at), square = get(&g->square, at), height = get(&g->height, at);
    lane_tests t = test_lanes(g, at, lane3_norm(w));
    lane3 old[3];
    lane_mask valid[3], known = lane_none();
    for (int i = 0; i < 3; i++) {
        old[i] = get3(&g->old[i].x, at);
        valid[i] = get_truth(&g->is_valid[i], at);
        lane other = get(&g->old[i].id, at);
        known = lane_or(known, lane_and(valid[i], lane_and(lane_at_least(id, other), lane_at_most(id, other))));
    }
    lane_step s = step_lanes(old, valid, w);
    lane_mask goes = lane_and(t.goes, lane_not(known)), inside = lane_and(goes, s.inside);
    lane high = lane3_dot(s.n, w), norm = lane3_dot(s.n, s.n);
    lane_mask gains = lane_less(high * high * square, height * height * norm);
    gains = lane_and(gains, lane_and(lane_greater(norm, lane_set(1e-150)), lane_less(norm, lane_set(1e150))));
    goes = lane_and(lane_and(goes, lane_not(inside)), lane_and(gains, lane_greater(norm, s.least)));
    s.goes = goes;
    replace_corner(g, at, &s, &(lane_corner){w, id});
    put_some(&g->n[0], at, goes, s.n.x);
    put_some(&g->n[1], at, goes, s.n.y);
    put_some(&g->n[2], at, goes, s.n.z);
    put_some(&g->height, at, goes, high);
    put_some(&g->square, at, goes, norm);
    put(&g->steps, at, get(&g->steps, at) + lane_select(goes, lane_set(1), lane_set(0)));
    unsigned a = lane_bits(t.apart), n = lane_bits(t.near), i = lane_bits(inside), on = lane_bits(goes);
    return (gjk8_ends){a << at, n << at, i << at, (~(a | n | i | on) & ((1u << LANES) - 1)) << at};
}

// 1 where some of the lanes from `at` on are of the mask.
static inline int has_lanes(unsigned mask, int at) { return (mask >> at & ((1u << LANES) - 1)) != 0; }

// Those of all lanes that are at work. Lanes that ended before find the same end again, so they stay as they are.
static inline gjk8_ends take_ends(gjk8 *g, gjk8_ends all) {
    all.apart &= g->active;
    all.near &= g->active;
    all.inside &= g->active;
    all.open &= g->active;
    g->active &= ~(all.apart | all.near | all.inside | all.open);
    return all;
}

LANES_TARGET static gjk8_ends run_group_advance(gjk8 *g) {
    gjk8_ends all = {0, 0, 0, 0};
    for (int at = 0; at < PAIR8; at += LANES) {
        if (!has_lanes(g->active, at)) continue;
        gjk8_ends some = advance_lanes(g, at);
        all.apart |= some.apart;
        all.near |= some.near;
        all.inside |= some.inside;
        all.open |= some.open;
    }
    return take_ends(g, all);
}
