// What the searches of float_gjk.h have in common, in lanes (kernels/float_rounds.h) and of one couple alone
// (kernels/float_alone.h): queues, the gap along a direction, the answers. Errors: docs/error-analysis.md.
#include "simd/kernels/float_columns.h"

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
    for (int at = 0; has_more(lanes, at); at += LANES) {
        unsigned some = get_lanes(lanes, at);
        if (!some) continue;
        lane_order order = find_order(some);
        for (int i = 0; i < FLOAT_COLUMNS; i++) pack(to->columns[i] + to->count, order, get(&columns[i], at));
        to->count += count_bits(some);
    }
}

LANES_TARGET static void run_float_fill(float_queue *from, unsigned lanes, float_gjk *to) {
    float_column *columns = (float_column *)&to->query;
    lane zero = lane_set(0);
    unsigned next = from->count -= count_bits(lanes);
    for (int at = 0; has_more(lanes, at); at += LANES) {
        unsigned some = get_lanes(lanes, at);
        if (!some) continue;
        lane_order order = find_order(some);
        float_places places = get_places(to, lanes, at);
        for (int i = 0; i < FLOAT_COLUMNS; i++)
            put_new(&columns[i], at, &places, spread(from->columns[i] + next, order));
        next += count_bits(some);
        lane3 n = get3(to->query.start, at);
        put_new3(to->n, at, &places, n);
        if (!to->blocks) {
            put_new3(to->given.heading, at, &places, n);
            put_new(&to->given.waits, at, &places, zero);
        }
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

// ---- supports

// A vertex extreme along a direction; of equal ones the first of the even or the first of the odd. Where no one reads
// the index, it costs nothing.
typedef struct float_support {
    lane value;
    lane3 at;
    lane index;
} float_support;

// The gap along n, the difference of the supports, and which vertices these are: a + 32 b.
typedef struct float_meeting {
    lane gap;
    lane3 w;
    lane id;
} float_meeting;

LANES_INLINE lane3 turn_to_b(const float_gjk *s, lane3 n, int at) {
    return lane9_mul3_transposed(get9(s->query.rotation, at), n);
}

LANES_INLINE float_meeting meet(const float_gjk *s, lane3 n, int at, float_support high, float_support low) {
    lane3 t = get3(s->query.translation, at), b = lane9_mul3(get9(s->query.rotation, at), low.at);
    return (float_meeting){(lane3_dot(n, t) + low.value) - high.value, lane3_sub(lane3_add(b, t), high.at),
                           high.index + lane_set(FLOAT_GJK_POINTS) * low.index};
}

// 1 where the gap is as large as the height, but for what floats round: the simplex is the nearest. Of two edges that
// are nearest, the support is one of four corners of the same height, of which the simplex has three.
LANES_INLINE lane_mask is_nearest(lane gap, lane height, lane square, lane claim) {
    lane left = height - gap, slack = claim * lane_set(0.125);
    return lane_at_most(left * left, slack * slack * square);
}

// 1 where a first corner, or the height of a step, is beyond what floats round and what may underflow.
LANES_INLINE lane_mask is_clear(lane height, lane norm, lane claim) {
    return lane_and(lane_greater(norm, lane_set(1e-30)), lane_greater(height * height, claim * claim * norm));
}

// The corners that a search ended with, one after another. fresh: the fourth, of those that are inside.
LANES_INLINE void put_found(float_found *to, int at, const lane_mask valid[3], const lane id[3], lane fresh) {
    lane one = lane_set(1), zero = lane_set(0), count = zero;
    for (int i = 0; i < 3; i++) count = count + lane_select(valid[i], one, zero);
    lane first = lane_select(valid[0], id[0], lane_select(valid[1], id[1], id[2]));
    lane second = lane_select(lane_and(valid[0], valid[1]), id[1], id[2]);
    put(&to->corner[0], at, first);
    put(&to->corner[1], at, lane_select(lane_greater(count, one), second, first));
    put(&to->corner[2], at, lane_select(lane_greater(count, lane_set(2)), id[2], first));
    put(&to->corner[3], at, fresh);
    put(&to->count, at, count);
}

// ---- directions

// The directions of the second and the third support, of the lanes `some`. From one corner w, met along n, GJK would
// look along w itself, which near contact is almost orthogonal to n: it meets a corner far away on the other side. Two
// directions near n, to either side of w's offset from it, make a triangle with w around the nearest point.
typedef struct float_sides {
    lane_mask some;
    lane3 next, other;
} float_sides;

LANES_INLINE float_sides find_sides(const float_gjk *s, lane3 n, lane3 w, int at) {
    lane tilt = get(&s->given.tilt, at), zero = lane_set(0);
    lane3 unit = lane3_scale(n, lane_set(1) / lane_sqrt(lane3_dot(n, n)));
    lane height = lane3_dot(w, unit);
    lane3 off = lane3_add_scaled(w, unit, zero - height);
    lane length = lane3_norm(off), part = tilt / length;
    // Far apart, or where w itself is tilted less, w is the better direction.
    lane_mask is_aside = lane_greater(length, tilt * lane_max(height, zero) + get(&s->query.claim, at));
    lane_mask is_close = lane_less(lane_set(8) * height, get(&s->query.size, at));
    lane3 along = lane3_add_scaled(unit, off, part), side = lane3_scale(lane3_cross(unit, off), part);
    return (float_sides){lane_and(is_aside, is_close), lane3_add(along, side), lane3_sub(along, side)};
}

// The directions of the next supports, where they may be tilted. took: the lanes with a new heading; on: those that
// have not ended. Lanes whose tilted direction showed nothing new keep their heading. Returns the lanes that go on.
LANES_INLINE lane_mask choose_direction(float_gjk *s, int at, lane_mask took, lane_mask on, lane3 w) {
    lane waits = get(&s->given.waits, at), one = lane_set(1);
    lane_mask waited = lane_and(on, lane_at_least(waits, one)), goes = lane_or(took, waited);
    // With few steps none is left for these.
    lane_mask is_first = s->most > 2 ? lane_and(took, lane_less(get(&s->steps, at), one)) : lane_none();
    lane3 n = get3(s->n, at),
          next = lane3_select(lane_greater(waits, one), get3(s->given.other, at), get3(s->given.heading, at));
    waits = lane_select(waited, waits - one, waits);
    if (lane_bits(is_first)) {
        float_sides sides = find_sides(s, n, w, at);
        lane_mask some = lane_and(sides.some, is_first);
        next = lane3_select(some, sides.next, next);
        put_some3(s->given.other, at, some, sides.other);
        waits = lane_select(some, lane_set(2), waits);
    }
    put(&s->given.waits, at, waits);
    put_some3(s->n, at, goes, next);
    return goes;
}

// ---- the answers

typedef struct float_simplex {
    lane3 old[3];
    lane_mask valid[3];
} float_simplex;

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
