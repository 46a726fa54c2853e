// The search of float_gjk.h, written once over lanes of floats; simd/floats/scalar.c, avx2.c and avx512.c
// include this. Errors: docs/error-analysis.md.
#include "simd/kernels/float_columns.h"
#include "simd/kernels/simplex_step.h"

// ---- queues

// How many lanes a mask has. In plain C the builtin would call the compiler's runtime.
LANES_INLINE unsigned count_bits(unsigned lanes) {
#if LANES > 1
    return (unsigned)__builtin_popcount(lanes);
#else
    unsigned count = 0;
    for (; lanes; lanes &= lanes - 1) count++;
    return count;
#endif
}

// The lanes of a vector side by side from its first on; numbers side by side into lanes, from the first on.
#if LANES == 16
typedef __mmask16 lane_order;
LANES_INLINE lane_order find_order(unsigned lanes) { return (__mmask16)lanes; }
LANES_INLINE void pack(float *to, lane_order order, lane v) {
    _mm512_storeu_ps(to, _mm512_maskz_compress_ps(order, v));
}
LANES_INLINE lane spread(const float *from, lane_order order) {
    return _mm512_maskz_expand_ps(order, _mm512_loadu_ps(from));
}
#elif LANES == 8
typedef struct lane_order {
    _Alignas(32) int32_t packed[8], place[8];
} lane_order;
LANES_INLINE lane_order find_order(unsigned lanes) {
    lane_order o = {{0}, {0}};
    for (int count = 0; lanes; lanes &= lanes - 1, count++) {
        int k = __builtin_ctz(lanes);
        o.packed[count] = k;
        o.place[k] = count;
    }
    return o;
}
LANES_INLINE lane permute(lane v, const int32_t at[8]) {
    return _mm256_permutevar8x32_ps(v, _mm256_load_si256((const __m256i *)at));
}
LANES_INLINE void pack(float *to, lane_order order, lane v) { _mm256_storeu_ps(to, permute(v, order.packed)); }
LANES_INLINE lane spread(const float *from, lane_order order) { return permute(_mm256_loadu_ps(from), order.place); }
#else
typedef unsigned lane_order;
LANES_INLINE lane_order find_order(unsigned lanes) { return lanes; }
LANES_INLINE void pack(float *to, lane_order order, lane v) {
    (void)order;
    *to = v;
}
LANES_INLINE lane spread(const float *from, lane_order order) {
    (void)order;
    return *from;
}
#endif

LANES_TARGET static void run_float_append(const float_query *from, unsigned lanes, float_queue *to) {
    const float_column *columns = (const float_column *)from;
    for (int at = 0; at < FLOATS; at += LANES) {
        unsigned some = get_lanes(lanes, at);
        if (!some) continue;
        lane_order order = find_order(some);
        for (int i = 0; i < FLOAT_COLUMNS; i++) pack(to->columns[i] + to->count, order, get(&columns[i], at));
        to->count += count_bits(some);
    }
}

// The lanes of a vector that are written, and those at work whose numbers are kept: without any, all are written.
typedef struct float_places {
    lane_mask is_new;
    unsigned kept;
} float_places;

LANES_INLINE float_places get_places(const float_gjk *s, unsigned lanes, int at) {
    return (float_places){lane_from_bits(get_lanes(lanes, at)), get_lanes(s->live & ~lanes, at)};
}
LANES_INLINE void put_new(float_column *c, int at, const float_places *places, lane v) {
    put(c, at, places->kept ? lane_select(places->is_new, v, get(c, at)) : v);
}
LANES_INLINE void put_new3(float_column *c, int at, const float_places *places, lane3 v) {
    put_new(c, at, places, v.x);
    put_new(c + 1, at, places, v.y);
    put_new(c + 2, at, places, v.z);
}

LANES_TARGET static void run_float_fill(float_queue *from, unsigned lanes, float_gjk *to) {
    float_column *columns = (float_column *)&to->query;
    lane zero = lane_set(0);
    unsigned next = from->count -= count_bits(lanes);
    for (int at = 0; at < FLOATS; at += LANES) {
        unsigned some = get_lanes(lanes, at);
        if (!some) continue;
        lane_order order = find_order(some);
        float_places places = get_places(to, lanes, at);
        for (int i = 0; i < FLOAT_COLUMNS; i++)
            put_new(&columns[i], at, &places, spread(from->columns[i] + next, order));
        next += count_bits(some);
        lane3 n = get3(to->query.start, at);
        put_new3(to->n, at, &places, n);
        put_new(&to->square, at, &places, lane3_dot(n, n));
        put_new(&to->height, at, &places, lane_set(INFINITY));
        put_new(&to->steps, at, &places, lane_set(-1));
        for (int i = 0; i < 3; i++) {
            put_new3(&to->old[3 * i], at, &places, (lane3){zero, zero, zero});
            put_new(&to->is_valid[i], at, &places, zero);
        }
    }
    to->live |= lanes;
}

// ---- the vertices

// The bodies of one side.
typedef struct float_side {
    lane factor;
    const float *const *bodies;
    const uint32_t *own; // eights of each
    int is_uniform;      // 1 if all have as many as the group
} float_side;

// Eight columns, number i of all. Eights beyond a body's own repeat its first.
LANES_INLINE void read_vertices(const float_side *side, uint32_t i, uint32_t blocks, int at, lane c[8]) {
    const float *rows[FLOATS];
    for (int k = at; k < at + LANES; k++) {
        uint32_t own = side->own[k], block = i % blocks;
        uint32_t row = side->is_uniform ? i : i / blocks * own + (block < own ? block : 0);
        rows[k] = side->bodies[k] + 8 * row;
    }
    read_eight(rows, at, c);
    for (int j = 0; j < 8; j++) c[j] = c[j] * side->factor;
}

LANES_INLINE int is_uniform(const uint32_t own[FLOATS], uint32_t blocks, int at) {
    uint32_t differs = 0;
    for (int k = at; k < at + LANES; k++) differs |= own[k] ^ blocks;
    return !differs;
}

// The columns of one body of each couple. Idle lanes that stay idle are overwritten too where no lane is kept.
LANES_INLINE void load_body(float_side *side, const float_column *factors, float_column *to, const float_gjk *s,
                            unsigned lanes) {
    for (int at = 0; at < FLOATS; at += LANES) {
        if (!get_lanes(lanes, at)) continue;
        float_places places = get_places(s, lanes, at);
        lane c[8];
        side->factor = get(factors, at);
        side->is_uniform = is_uniform(side->own, s->blocks, at);
        for (uint32_t i = 0; i < 3 * s->blocks; i++) {
            read_vertices(side, i, s->blocks, at, c);
            for (uint32_t j = 0; j < 8; j++) put_new(&to[8 * i + j], at, &places, c[j]);
        }
    }
}

LANES_TARGET static void run_float_load(const float_points *from, unsigned lanes, float_gjk *to) {
    float_side a = {lane_set(0), from->a, from->blocks_a, 0}, b = {lane_set(0), from->b, from->blocks_b, 0};
    load_body(&a, &to->query.factor_a, to->a, to, lanes);
    load_body(&b, &to->query.factor_b, to->b, to, lanes);
}

// ---- supports

// A vertex extreme along a direction; of equal ones the first of the even or the first of the odd.
typedef struct float_support {
    lane value;
    lane3 at;
} float_support;

LANES_INLINE lane3 get_vertex(const float_column *p, int count, int i, int at) {
    return (lane3){get(&p[i], at), get(&p[count + i], at), get(&p[2 * count + i], at)};
}

LANES_INLINE void take_better(float_support *best, float_support other, int is_least) {
    lane_mask is_better = is_least ? lane_less(other.value, best->value) : lane_greater(other.value, best->value);
    best->value = is_least ? lane_min(other.value, best->value) : lane_top(other.value, best->value);
    best->at = lane3_select(is_better, other.at, best->at);
}

LANES_INLINE float_support measure(const float_column *p, int count, int i, lane3 n, int at) {
    lane3 v = get_vertex(p, count, i, at);
    return (float_support){lane3_dot(v, n), v};
}

// The greatest of `count` vertices, or the least. Two chains, as each comparison waits for the one before.
LANES_INLINE float_support find_extreme(const float_column *p, int count, lane3 n, int at, int is_least) {
    float_support even = measure(p, count, 0, n, at), odd = measure(p, count, 1, n, at);
    for (int i = 2; i < count; i += 2) {
        take_better(&even, measure(p, count, i, n, at), is_least);
        take_better(&odd, measure(p, count, i + 1, n, at), is_least);
    }
    take_better(&even, odd, is_least);
    return even;
}

// The gap along n, and the difference of the supports.
typedef struct float_meeting {
    lane gap;
    lane3 w;
} float_meeting;

LANES_INLINE float_meeting meet(const float_gjk *s, lane3 n, int at, int count) {
    lane9 m = get9(s->query.rotation, at);
    lane3 t = get3(s->query.translation, at);
    float_support high = find_extreme(s->a, count, n, at, 0);
    float_support low = find_extreme(s->b, count, lane9_mul3_transposed(m, n), at, 1);
    return (float_meeting){(lane3_dot(n, t) + low.value) - high.value,
                           lane3_sub(lane3_add(lane9_mul3(m, low.at), t), high.at)};
}

// ---- the answers

// Adds what a vector of lanes found.
LANES_INLINE void add_ends(float_ends *all, const lane_mask ends[3], lane_mask goes, unsigned live, int at) {
    unsigned apart = lane_bits(ends[0]) & live, near = lane_bits(ends[1]) & live, inside = lane_bits(ends[2]) & live;
    all->apart |= apart << at;
    all->near |= near << at;
    all->inside |= inside << at;
    all->open |= (live & ~(apart | near | inside | lane_bits(goes))) << at;
}

// The norm of the simplex's point nearest to the origin. Weights below zero by rounding are cut off before they are
// normalised, so that it is a point of the hull whatever they were. NaN or infinity where their sum underflows.
LANES_INLINE lane compute_norm(const lane3 old[3], const lane_mask valid[3]) {
    lane zero = lane_set(0), one = lane_set(1);
    lane_mask first = lane_and(valid[0], valid[1]), all = lane_and(first, valid[2]);
    lane_mask two = lane_or(first, lane_and(lane_or(valid[0], valid[1]), valid[2]));
    lane3 p = lane3_select(valid[0], old[0], lane3_select(valid[1], old[1], old[2])),
          q = lane3_select(first, old[1], old[2]);
    lane3 e = lane3_sub(q, p), n = lane3_cross(e, lane3_sub(old[2], p));
    lane square = lane3_dot(e, e), t = lane_min(lane_max(zero - lane3_dot(p, e), zero), square);
    lane w0 = lane_max(lane3_dot(n, lane3_cross(q, old[2])), zero);
    lane w1 = lane_max(lane3_dot(n, lane3_cross(old[2], p)), zero);
    lane w2 = lane_select(all, lane_max(lane3_dot(n, lane3_cross(p, q)), zero), zero);
    w0 = lane_select(all, w0, lane_select(two, square - t, one));
    w1 = lane_select(all, w1, lane_select(two, t, zero));
    lane sum = (w0 + w1) + w2, scale = lane_select(lane_greater(sum, lane_set(1e-30)), one / sum, lane_set(INFINITY));
    lane3 x = lane3_add_scaled(lane3_add_scaled(lane3_scale(p, w0), q, w1), old[2], w2);
    return lane3_norm(lane3_scale(x, scale));
}

// A lower bound of the distance of the origin from the plane through a corner with the edges a and b: q = a x b, x from
// the origin to the corner, to: from the corner to the opposite one. Below zero where the origin is not proven to be
// on that corner's side, or the corner not proven to be off the plane.
LANES_INLINE lane measure_plane(lane3 a, lane3 b, lane3 x, lane3 to) {
    lane3 q = lane3_cross(a, b);
    lane origin = lane3_dot(q, x), other = lane3_dot(q, to), lengths = lane3_norm(a) * lane3_norm(b);
    lane longest = lane_sqrt(lane_max(lane3_dot(x, x), lane3_dot(to, to)));
    lane least = lane_min(lane_abs(origin), lane_abs(other)) - lane_set(16 * 0x1p-24) * (lengths * longest);
    lane distance = least / (lane3_norm(q) + lane_set(8 * 0x1p-24) * lengths);
    // Beyond that what underflows is less than a rounding.
    lane_mask same = lane_and(lane_sign(origin * other), lane_greater(lengths, lane_set(1e-30)));
    return lane_select(same, distance, lane_set(-1));
}

// A radius of a ball around the origin inside the tetrahedron of the simplex and w, rounded down; else not above zero.
LANES_INLINE lane measure_tetrahedron(const lane3 old[3], lane3 w) {
    lane3 e[3];
    for (int i = 0; i < 3; i++) e[i] = lane3_sub(old[i], w);
    lane depth = measure_plane(lane3_sub(old[1], old[0]), lane3_sub(old[2], old[0]), old[0], lane3_sub(w, old[0]));
    for (int i = 0; i < 3; i++) {
        lane other = measure_plane(e[i], e[(i + 1) % 3], w, e[(i + 2) % 3]);
        depth = lane_select(lane_less(other, depth), other, depth);
        depth = lane_select(lane_at_least(other, lane_set(-1)), depth, lane_set(-1));
    }
    return lane_select(lane_at_least(depth, lane_set(0)), depth * lane_set(1 - 16 * 0x1p-24), lane_set(-1));
}

// ---- rounds

// In the lanes that go on the new corner takes the place of the first that does not stay.
LANES_INLINE void replace_corner(float_gjk *s, int at, const lane_step *step, lane3 w) {
    lane_mask taken = lane_not(step->goes);
    for (int i = 0; i < 3; i++) {
        lane_mask here = lane_and(lane_not(taken), lane_not(step->keeps[i]));
        taken = lane_or(taken, here);
        put_some3(&s->old[3 * i], at, here, w);
        lane_mask stays = lane_or(here, step->keeps[i]), was = lane_sign(get(&s->is_valid[i], at));
        stays = lane_or(lane_and(step->goes, stays), lane_and(lane_not(step->goes), was));
        lane_store_mask(s->is_valid[i].lane + at, stays);
    }
}

LANES_INLINE void advance_lanes(float_gjk *s, int at, int count, float_ends *all) {
    lane3 n = get3(s->n, at), old[3];
    lane_mask valid[3];
    unsigned live = get_lanes(s->live, at);
    float_meeting m = meet(s, n, at, count);
    for (int i = 0; i < 3; i++) {
        old[i] = get3(&s->old[3 * i], at);
        valid[i] = lane_sign(get(&s->is_valid[i], at));
    }
    lane claim = get(&s->query.claim, at), near_to = get(&s->query.near, at), zero = lane_set(0);
    lane square = get(&s->square, at), height = get(&s->height, at), scale = lane_set(1) / lane_sqrt(square);
    lane lower = m.gap * scale - claim, upper = lane3_norm(m.w) + claim, steps = get(&s->steps, at) + lane_set(1);
    lane_mask apart = lane_greater(lower, get(&s->query.far, at));
    lane_mask positive = lane_and(lane_greater(lower, zero), lane_not(apart)), near = lane_at_most(upper, near_to);
    lane_mask nearer = lane_and(lane_at_most(height * scale + claim, near_to), lane_not(near));
    near = lane_and(positive, near);
    nearer = lane_and(positive, nearer);
    if (lane_bits(nearer) & live) {
        lane norm = compute_norm(old, valid) + claim;
        nearer = lane_and(nearer, lane_at_most(norm, near_to));
        near = lane_or(near, nearer);
        upper = lane_select(nearer, norm, upper);
    }
    lane_step step = step_lanes(old, valid, m.w);
    lane_mask goes = lane_not(lane_or(apart, near)), inside = lane_and(goes, step.inside);
    if (lane_bits(inside) & live) {
        lane depth = measure_tetrahedron(old, m.w);
        inside = lane_and(inside, lane_greater(depth, claim));
        upper = lane_select(inside, claim - depth, upper);
    }
    lane high = lane3_dot(step.n, m.w), norm = lane3_dot(step.n, step.n);
    lane_mask gains = lane_less(high * high * square, height * height * norm);
    // A support that is a corner again gains nothing. A height within the error says nothing of the sign.
    gains =
        lane_and(gains, lane_and(lane_greater(norm, lane_set(1e-30)), lane_greater(high * high, claim * claim * norm)));
    gains = lane_and(gains, lane_less(steps, lane_set(s->most)));
    step.goes = lane_and(lane_and(goes, lane_not(step.inside)), lane_and(gains, lane_from_bits(live)));
    replace_corner(s, at, &step, m.w);
    put_some3(s->n, at, step.goes, step.n);
    put(&s->height, at, lane_select(step.goes, high, height));
    put(&s->square, at, lane_select(step.goes, norm, square));
    put(&s->steps, at, steps);
    put(&s->lower, at, lower);
    put(&s->upper, at, upper);
    add_ends(all, (lane_mask[3]){apart, near, inside}, step.goes, live, at);
}

LANES_INLINE float_ends advance_all(float_gjk *s, int count) {
    float_ends all = {0, 0, 0, 0};
    for (int at = 0; at < FLOATS; at += LANES)
        if (get_lanes(s->live, at)) advance_lanes(s, at, count, &all);
    s->live &= ~(all.apart | all.near | all.inside | all.open);
    return all;
}

// Loops of a known length.
LANES_TARGET static float_ends run_float_advance(float_gjk *s) {
    switch (s->blocks) {
    case 1: return advance_all(s, 8);
    case 2: return advance_all(s, 16);
    case 3: return advance_all(s, 24);
    default: return advance_all(s, 32);
    }
}
