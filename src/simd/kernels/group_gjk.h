// The kernels of group_gjk.h, written once over lanes; scalar.c, avx2.c and avx512.c include this after kernels/pair8.h
// and kernels/small_gjk.h's parts. The errors are those of exact/small.c (docs/error-analysis.md).
#include "simd/group_gjk.h"
#include "simd/kernels/gjk8.h"

LANES_TARGET static void run_group_begin(const pair8 *o, const pair8_query *query, group_gjk *s) {
    gjk8 *g = &s->search;
    static const double nowhere[3] = {0, 0, 0};
    for (int k = 0; k < PAIR8; k++) s->vertex_a[k] = s->vertex_b[k] = nowhere;
    for (int at = 0; at < PAIR8; at += LANES) {
        if (!has_lanes(g->active, at)) continue;
        lane zero = lane_set(0), radii = get(&o->radii, at);
        lane3 n = get3(o->between, at), none = {zero, zero, zero};
        if (s->is_along_n) n = lane9_mul3(get9(o->world_a, at), get3(o->n, at));
        lane square = lane3_dot(n, n);
        put3(g->start, at, n);
        put3(g->n, at, n);
        put(&g->start_square, at, square);
        put(&g->square, at, square);
        for (int i = 0; i < 3; i++) {
            put3(&g->old[i].x, at, none);
            put(&g->old[i].id, at, zero);
            put(&g->is_valid[i], at, zero);
        }
        put(&s->high, at, zero);
        put(&s->low, at, zero);
        put(&g->fresh.id, at, zero);
        put(&g->steps, at, zero);
        put(&g->most, at, lane_set(query->iterations));
        put(&g->claim, at, compute_claim(query, get(&o->size, at)));
        put(&g->lower_radii, at, radii);
        put(&g->upper_radii, at, radii);
        put(&g->tolerance, at, get(&o->tolerance, at));
    }
}

// ---- supports

// Runs a function for the eights of points of the larger body of lane k. Plain C reads the counts themselves.
#if LANES > 2
#define GROUP_BY_BLOCKS(FIND, s, k)                                                                                    \
    uint32_t of_a = (s)->points_a[k].padded_count, of_b = (s)->points_b[k].padded_count;                               \
    switch ((of_a > of_b ? of_a : of_b) / 8) {                                                                         \
    case 1: FIND(s, k, 1); break;                                                                                      \
    case 2: FIND(s, k, 2); break;                                                                                      \
    case 3: FIND(s, k, 3); break;                                                                                      \
    default: FIND(s, k, 4); break;                                                                                     \
    }
#else
#define GROUP_BY_BLOCKS(FIND, s, k) FIND(s, k, 0);
#endif

// The supports of lane k, for bodies of so many eights of points.
SMALL_GJK_INLINE void find_ends(group_gjk *s, unsigned k, uint32_t blocks) {
    const simd_points *a = &s->points_a[k], *b = &s->points_b[k];
    vec3 in_a = {s->along_a[0].lane[k], s->along_a[1].lane[k], s->along_a[2].lane[k]};
    vec3 in_b = {s->along_b[0].lane[k], s->along_b[1].lane[k], s->along_b[2].lane[k]};
    support_result high = find_extreme_point(a, in_a, blocks, 0), low = find_extreme_point(b, in_b, blocks, 1);
    s->high.lane[k] = high.value;
    s->low.lane[k] = low.value;
    s->vertex_a[k] = s->vertices_a[k] + 3 * (size_t)high.index;
    s->vertex_b[k] = s->vertices_b[k] + 3 * (size_t)low.index;
    s->search.fresh.id.lane[k] = high.index + SMALL_GJK_POINTS * low.index;
}

LANES_TARGET static void find_lane_ends(group_gjk *s, unsigned k){GROUP_BY_BLOCKS(find_ends, s, k)}

// The difference of the vertices and the gap. For lanes whose supports are as before they are as before.
LANES_INLINE void meet_ends(const pair8 *o, group_gjk *s, int at) {
    gjk8 *g = &s->search;
    lane3 a = lane9_mul3(get9(o->world_a, at), read_points(s->vertex_a, at));
    lane3 b = lane9_mul3(get9(o->world_b, at), read_points(s->vertex_b, at));
    lane3 offset = get3(o->offset, at);
    put3(&g->fresh.x, at, lane3_sub(lane3_add(b, offset), a));
    put(&g->gap, at, (lane3_dot(get3(g->n, at), offset) + get(&s->low, at)) - get(&s->high, at));
}

LANES_TARGET static void run_group_support(const pair8 *o, group_gjk *s) {
    unsigned active = s->search.active;
    for (int at = 0; at < PAIR8; at += LANES) {
        if (!has_lanes(active, at)) continue;
        lane3 n = get3(s->search.n, at);
        put3(s->along_a, at, lane9_mul3_transposed(get9(o->world_a, at), n));
        put3(s->along_b, at, lane9_mul3_transposed(get9(o->world_b, at), n));
    }
    for (unsigned rest = active; rest; rest &= rest - 1) find_lane_ends(s, (unsigned)__builtin_ctz(rest));
    for (int at = 0; at < PAIR8; at += LANES)
        if (has_lanes(active, at)) meet_ends(o, s, at);
}

// Of begin() of kernels/small_gjk.h what follows the first support.
LANES_TARGET static gjk8_ends run_group_start(group_gjk *s) {
    gjk8 *g = &s->search;
    gjk8_ends all = {0, 0, 0, 0};
    for (int at = 0; at < PAIR8; at += LANES) {
        if (!has_lanes(g->active, at)) continue;
        lane3 w = get3(&g->fresh.x, at), n = get3(g->n, at);
        lane gap = get(&g->gap, at), square = get(&g->square, at), radii = get(&g->lower_radii, at);
        lane claim = get(&g->claim, at), least = lane_set(1e-150), most = lane_set(1e150);
        lane norm = lane3_dot(w, w);
        lane lower = gap * (lane_set(1) / lane_sqrt(square)) - radii - claim;
        lane upper = lane_sqrt(norm) - get(&g->upper_radii, at) + claim;
        lane_mask good = lane_and(lane_greater(square, least), lane_less(square, most));
        lane_mask apart = lane_and(lane_greater(lower, lane_set(g->far)), good);
        lane_mask near = lane_and(is_answered_at(g, at, lower, upper), lane_not(lane_greater(radii, lane_set(0))));
        near = lane_and(lane_and(near, good), lane_not(apart));
        lane_mask goes = lane_and(lane_and(lane_greater(norm, least), lane_less(norm, most)), good),
                  ends = lane_or(apart, near);
        goes = lane_and(goes, lane_not(ends));
        put(&g->lower, at, lower);
        put(&g->upper, at, upper);
        put(&g->start_gap, at, gap);
        put3(&g->old[0].x, at, w);
        put(&g->old[0].id, at, get(&g->fresh.id, at));
        put(&g->is_valid[0], at, lane_set(1));
        put3(g->n, at, lane3_select(goes, w, n));
        put(&g->height, at, lane_select(goes, norm, lane_set(0)));
        put(&g->square, at, lane_select(goes, norm, square));
        all.apart |= lane_bits(apart) << at;
        all.near |= lane_bits(near) << at;
        all.open |= lane_bits(lane_not(lane_or(ends, goes))) << at;
    }
    return take_ends(g, all);
}

// ---- the end

// One to three corners; those that are none repeat the first.
typedef struct corner_set {
    lane3 p[3];
    lane_mask has_two, has_three;
} corner_set;

LANES_INLINE corner_set get_corners(const lane_column c[3 * 3], lane count, int at) {
    corner_set s = {{get3(c, at), get3(c + 3, at), get3(c + 6, at)},
                    lane_greater(count, lane_set(1.5)),
                    lane_greater(count, lane_set(2.5))};
    s.p[1] = lane3_select(s.has_two, s.p[1], s.p[0]);
    s.p[2] = lane3_select(s.has_three, s.p[2], s.p[0]);
    return s;
}

// The weights of the corners' nearest point, as in simplex_compute_weights; those below zero by rounding are cut off,
// so that they are of a point of the corners' hull whatever they were.
LANES_INLINE void compute_group_weights(const corner_set *c, lane weight[3]) {
    lane zero = lane_set(0), one = lane_set(1);
    lane3 e = lane3_sub(c->p[1], c->p[0]), n = lane3_cross(e, lane3_sub(c->p[2], c->p[0]));
    lane t = lane_max(zero, lane_min(one, zero - lane3_dot(c->p[0], e) / lane3_dot(e, e)));
    lane u = lane_max(zero, lane3_dot(n, lane3_cross(c->p[1], c->p[2])));
    lane v = lane_max(zero, lane3_dot(n, lane3_cross(c->p[2], c->p[0])));
    lane w = lane_max(zero, lane3_dot(n, lane3_cross(c->p[0], c->p[1])));
    lane scale = one / ((u + v) + w);
    weight[0] = lane_select(c->has_three, u * scale, lane_select(c->has_two, one - t, one));
    weight[1] = lane_select(c->has_three, v * scale, lane_select(c->has_two, t, zero));
    weight[2] = lane_select(c->has_three, w * scale, zero);
}

LANES_INLINE lane3 combine(const lane3 p[3], const lane weight[3]) {
    return lane3_add_scaled(lane3_add_scaled(lane3_scale(p[0], weight[0]), p[1], weight[1]), p[2], weight[2]);
}

// A direction n from A to B, and what the bounds along it are made with.
typedef struct group_heading {
    lane3 n;
    lane scale, radii, claim; // scale: 1 / |n|
} group_heading;

// The points of corners with weights, the direction, and the upper bound. a: A's vertices, body frame.
LANES_SHARED void put_nearest(const pair8 *o, int at, const corner_set *differences, const lane3 a[3],
                              const group_heading *h, group_nearest *out) {
    lane weight[3], zero = lane_set(0), scale = h->scale;
    compute_group_weights(differences, weight);
    lane3 between = combine(differences->p, weight), point_a = lane9_mul3(get9(o->world_a, at), combine(a, weight));
    for (int i = 0; i < 3; i++) put(&out->weight[i], at, weight[i]);
    put3(out->point_a, at, point_a);
    put3(out->point_b, at, lane3_add(point_a, between));
    // No zero of a direction is negative.
    put3(out->normal, at, (lane3){h->n.x * scale + zero, h->n.y * scale + zero, h->n.z * scale + zero});
    put(&out->upper, at, lane3_norm(between) - h->radii + h->claim);
}

LANES_INLINE void put_lower(int at, const group_heading *h, lane gap, group_nearest *out) {
    put(&out->lower, at, gap * h->scale - h->radii - h->claim);
}

LANES_TARGET static void run_group_finish(const pair8 *o, unsigned lanes, const group_gjk *s, group_nearest *out) {
    const gjk8 *g = &s->search;
    for (int at = 0; at < PAIR8; at += LANES) {
        if (!has_lanes(lanes, at)) continue;
        lane count = get(&s->count, at);
        corner_set differences = get_corners(s->corner, count, at), vertices = get_corners(s->corner_a, count, at);
        const group_heading h = {get3(g->n, at), lane_set(1) / lane_sqrt(get(&g->square, at)), get(&g->lower_radii, at),
                                 get(&g->claim, at)};
        put_nearest(o, at, &differences, vertices.p, &h, out);
        put_lower(at, &h, get(&g->gap, at), out);
    }
}

// ---- corners of a search in single precision

// The direction from the origin to the nearest point of one to three differences: orthogonal to their edges.
LANES_INLINE lane3 find_heading(const corner_set *c) {
    lane3 w = c->p[0], e = lane3_sub(c->p[1], w), face = lane3_cross(e, lane3_sub(c->p[2], w));
    lane3 edge = lane3_cross(e, lane3_cross(w, e));
    lane_mask flips = lane_less(lane3_dot(face, w), lane_set(0));
    face = lane3_select(flips, lane3_neg(face), face);
    return lane3_select(c->has_three, face, lane3_select(c->has_two, edge, w));
}

// The difference of corner i, world, and its vertex of A.
LANES_SHARED lane3 meet_corner(const pair8 *o, const group_corners *from, int at, int i, lane3 *a) {
    *a = read_points(from->a[i], at);
    lane3 b = lane9_mul3(get9(o->world_b, at), read_points(from->b[i], at));
    return lane3_sub(lane3_add(b, get3(o->offset, at)), lane9_mul3(get9(o->world_a, at), *a));
}

// The differences of the corners, world, and A's vertices.
LANES_INLINE corner_set meet_corners(const pair8 *o, const group_corners *from, int at, lane3 a[3]) {
    lane count = get(&from->count, at);
    corner_set c = {.has_two = lane_greater(count, lane_set(1.5)), .has_three = lane_greater(count, lane_set(2.5))};
    for (int i = 0; i < 3; i++) c.p[i] = meet_corner(o, from, at, i, &a[i]);
    return c;
}

// The values of the supports of lane k, for bodies of so many eights of points.
SMALL_GJK_INLINE void measure_ends(group_corners *s, unsigned k, uint32_t blocks) {
    vec3 in_a = {s->along_a[0].lane[k], s->along_a[1].lane[k], s->along_a[2].lane[k]};
    vec3 in_b = {s->along_b[0].lane[k], s->along_b[1].lane[k], s->along_b[2].lane[k]};
    s->high.lane[k] = find_extreme_point(&s->points_a[k], in_a, blocks, 0).value;
    s->low.lane[k] = find_extreme_point(&s->points_b[k], in_b, blocks, 1).value;
}

LANES_TARGET static void measure_lane_ends(group_corners *s, unsigned k){GROUP_BY_BLOCKS(measure_ends, s, k)}

LANES_INLINE group_heading get_heading(const pair8 *o, const pair8_query *query, const group_corners *from, int at) {
    return (group_heading){get3(from->n, at), get(&from->scale, at), get(&o->radii, at),
                           compute_claim(query, get(&o->size, at))};
}

// All but the lower bound.
LANES_INLINE void begin_measure(const pair8 *o, const pair8_query *query, group_corners *from, int at,
                                group_nearest *out) {
    lane3 a[3];
    corner_set c = meet_corners(o, from, at, a);
    lane3 n = find_heading(&c);
    lane square = lane3_dot(n, n);
    lane_mask good = lane_and(lane_greater(square, lane_set(1e-150)), lane_less(square, lane_set(1e150)));
    from->good |= lane_bits(good) << at;
    put3(from->n, at, n);
    put(&from->scale, at, lane_set(1) / lane_sqrt(square));
    put3(from->along_a, at, lane9_mul3_transposed(get9(o->world_a, at), n));
    put3(from->along_b, at, lane9_mul3_transposed(get9(o->world_b, at), n));
    group_heading h = get_heading(o, query, from, at);
    put_nearest(o, at, &c, a, &h, out);
}

LANES_TARGET static void run_group_measure(const pair8 *o, const pair8_query *query, unsigned lanes,
                                           group_corners *from, group_nearest *out) {
    from->good = 0;
    for (int at = 0; at < PAIR8; at += LANES)
        if (has_lanes(lanes, at)) begin_measure(o, query, from, at, out);
    for (unsigned rest = lanes; rest; rest &= rest - 1) measure_lane_ends(from, (unsigned)__builtin_ctz(rest));
    for (int at = 0; at < PAIR8; at += LANES) {
        if (!has_lanes(lanes, at)) continue;
        group_heading h = get_heading(o, query, from, at);
        lane gap = (lane3_dot(h.n, get3(o->offset, at)) + get(&from->low, at)) - get(&from->high, at);
        put_lower(at, &h, gap, out);
    }
}
