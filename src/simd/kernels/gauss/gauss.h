// The kernels of gauss.h, written once over lanes; scalar.c, avx2.c and avx512.c include plane.h. Every number is
// computed lane by lane, minima and maxima do not depend on an order, ties go to the lowest index: so all widths give
// the same bits.
//
// The first body is A mirrored at the origin, so that the difference is a sum: its height along n is the first one's
// support along n and the second one's.
#include "simd/gauss.h"
#include "simd/kernels/lanes.h"

#include "base/compiler.h"

#if LANES >= 4
#define GAUSS_PART LANES_INLINE
#else
/// Not copied to each caller: narrow lanes gain nothing from that, and downloads are smaller.
#define GAUSS_PART COMPILER_NOINLINE static
#endif

/// Arcs are coplanar with a normal, to rounding: a triple product of unit vectors is off by 8 u.
#define GAUSS_LEVEL 0x1p-48
/// What rounding does to the height along a crossing, times its length, in parts of the size.
#define GAUSS_SLACK 0x1p-47
/// Arcs whose crossing is no longer than this lie nearly on one circle, and so do their heights, by that many times the
/// distance between them (exact/gauss).
#define GAUSS_SHARP 0x1p-40
#define GAUSS_BLUR 10
/// Arcs that a column has room for.
enum { GAUSS_ROOM = GAUSS_ARCS + 8 };

// A body in the frame, and what is known of its facets.
typedef struct gauss_body {
    _Alignas(64) double x[3][GAUSS_POINTS], n[3][GAUSS_FACETS], low[GAUSS_FACETS];
    double bound[GAUSS_FACETS]; ///< no height along a facet's normal is less
    vec3 center;
    double q[6], ball, shrink;
    const gauss_map *map;
    uint32_t points, facets; ///< padded
} gauss_body;

LANES_INLINE lane3 gauss_load(const double *x, const double *y, const double *z, uint32_t i) {
    return (lane3){lane_load(x + i), lane_load(y + i), lane_load(z + i)};
}
LANES_INLINE lane3 gauss_spread(vec3 v) { return (lane3){lane_set(v.x), lane_set(v.y), lane_set(v.z)}; }

// ---- the bodies in the frame

LANES_INLINE void gauss_mirror(const gauss_side *from, gauss_body *to) {
    const simd_points *p = &from->points;
    const double *given[3] = {p->x, p->y, p->z};
    to->map = from->map;
    to->points = p->padded_count;
    to->facets = (uint32_t)simd_get_padded(from->map->facets);
    for (int k = 0; k < 3; k++)
        for (uint32_t i = 0; i < to->points; i += LANES) lane_store(to->x[k] + i, -lane_load(given[k] + i));
    for (uint32_t i = 0; i < to->facets; i += LANES) {
        const double *facet = gauss_get_facet(from->map, i);
        for (int k = 0; k < 3; k++) lane_store(to->n[k] + i, -lane_load(facet + 8 * k));
        lane_store(to->low + i, lane_load(facet + 24));
    }
    to->center = vec3_neg(from->center);
    memcpy(to->q, from->q, sizeof to->q);
    to->ball = from->ball;
    to->shrink = from->shrink;
}

LANES_INLINE lane3 gauss_turn(const lane3 rows[3], lane3 v) {
    return (lane3){lane3_dot(rows[0], v), lane3_dot(rows[1], v), lane3_dot(rows[2], v)};
}

// R Q R'.
GAUSS_PART void gauss_turn_ellipsoid(const mat3 *r, const double q[6], double to[6]) {
    const vec3 x = {q[0], q[1], q[2]}, y = {q[1], q[3], q[4]}, z = {q[2], q[4], q[5]};
    const vec3 a = {vec3_dot(x, r->r0), vec3_dot(y, r->r0), vec3_dot(z, r->r0)};
    const vec3 b = {vec3_dot(x, r->r1), vec3_dot(y, r->r1), vec3_dot(z, r->r1)};
    const vec3 c = {vec3_dot(x, r->r2), vec3_dot(y, r->r2), vec3_dot(z, r->r2)};
    to[0] = vec3_dot(a, r->r0), to[1] = vec3_dot(a, r->r1), to[2] = vec3_dot(a, r->r2);
    to[3] = vec3_dot(b, r->r1), to[4] = vec3_dot(b, r->r2), to[5] = vec3_dot(c, r->r2);
}

LANES_INLINE void gauss_pose(const gauss_side *from, const gauss_query *q, gauss_body *to) {
    const simd_points *p = &from->points;
    const lane3 rows[3] = {gauss_spread(q->rotation.r0), gauss_spread(q->rotation.r1), gauss_spread(q->rotation.r2)};
    const lane3 t = gauss_spread(q->translation);
    to->map = from->map;
    to->points = p->padded_count;
    to->facets = (uint32_t)simd_get_padded(from->map->facets);
    for (uint32_t i = 0; i < to->points; i += LANES) {
        lane3 v = lane3_add(gauss_turn(rows, gauss_load(p->x, p->y, p->z, i)), t);
        lane_store(to->x[0] + i, v.x);
        lane_store(to->x[1] + i, v.y);
        lane_store(to->x[2] + i, v.z);
    }
    for (uint32_t i = 0; i < to->facets; i += LANES) {
        const double *given = gauss_get_facet(from->map, i);
        lane3 v = gauss_turn(rows, gauss_load(given, given + 8, given + 16, 0));
        lane_store(to->n[0] + i, v.x);
        lane_store(to->n[1] + i, v.y);
        lane_store(to->n[2] + i, v.z);
        lane_store(to->low + i, lane_load(given + 24) + lane3_dot(v, t));
    }
    to->center = vec3_add(mat3_mul_vec3(q->rotation, from->center), q->translation);
    gauss_turn_ellipsoid(&q->rotation, from->q, to->q);
    to->ball = from->ball;
    to->shrink = from->shrink;
}

// ---- heights along the normals of facets

// The facets, as bits, whose bounds are not above a height.
LANES_INLINE uint64_t gauss_find_low(const gauss_body *of, double height) {
    uint64_t low = 0;
    for (uint32_t i = 0; i < of->facets; i += LANES)
        low |= (uint64_t)lane_bits(lane_at_least(lane_set(height), lane_load(of->bound + i))) << i;
    return low;
}

// At least the longest semi-axis: the largest eigenvalue is no more than the entries of a row.
LANES_INLINE double gauss_find_longest(const double q[6]) {
    double x = fabs(q[0]) + fabs(q[1]) + fabs(q[2]), y = fabs(q[1]) + fabs(q[3]) + fabs(q[4]),
           z = fabs(q[2]) + fabs(q[4]) + fabs(q[5]);
    x = x > y ? x : y;
    return sqrt(x > z ? x : z);
}

// Lower bounds by the other body's ellipsoid, of whose support's root the chord is taken that goes from the square of
// its shortest semi-axis to that of its longest one: a root is above its chord. Returns the facet of the least one; of
// several the first.
GAUSS_PART uint32_t gauss_bound_facets(gauss_body *of, const gauss_body *by) {
    lane3 c = gauss_spread(by->center);
    lane xx = lane_set(by->q[0]), xy = lane_set(2 * by->q[1]), xz = lane_set(2 * by->q[2]);
    lane yy = lane_set(by->q[3]), yz = lane_set(2 * by->q[4]), zz = lane_set(by->q[5]);
    double top = gauss_find_longest(by->q), slope = 1 / (by->ball + top);
    lane rise = lane_set(slope), start = lane_set(by->ball * top * slope - by->shrink), least = lane_set(INFINITY);
    for (uint32_t i = 0; i < of->facets; i += LANES) {
        lane3 n = gauss_load(of->n[0], of->n[1], of->n[2], i);
        lane square = n.x * (xx * n.x + xy * n.y + xz * n.z) + n.y * (yy * n.y + yz * n.z) + zz * (n.z * n.z);
        lane middle = lane3_dot(n, c) + lane_load(of->low + i);
        lane bound = middle + (square * rise + start);
        lane_store(of->bound + i, bound);
        least = lane_min(bound, least);
    }
    uint64_t low = gauss_find_low(of, lane_first(-lane_find_max(-least)));
    return low ? (uint32_t)__builtin_ctzll(low) : 0;
}

LANES_INLINE vec3 gauss_get_normal(const gauss_body *of, uint32_t facet) {
    return (vec3){of->n[0][facet], of->n[1][facet], of->n[2][facet]};
}

GAUSS_PART double gauss_measure_facet(const gauss_body *of, const gauss_body *by, uint32_t facet) {
    lane3 n = gauss_spread(gauss_get_normal(of, facet));
    lane most = lane_set(-INFINITY);
    for (uint32_t i = 0; i < by->points; i += LANES)
        most = lane_top(lane3_dot(gauss_load(by->x[0], by->x[1], by->x[2], i), n), most);
    return lane_first(lane_find_max(most)) + of->low[facet];
}

// The least height so far, and the facet.
typedef struct gauss_least {
    double height;
    uint32_t facet;
    gauss_kind kind;
} gauss_least;

LANES_INLINE void gauss_try_facet(const gauss_body *of, const gauss_body *by, uint32_t facet, gauss_kind kind,
                                  gauss_least *least) {
    double height = gauss_measure_facet(of, by, facet);
    if (height < least->height) *least = (gauss_least){height, facet, kind};
}

// Measures the facets that the ellipsoid leaves open, but for one that was.
GAUSS_PART void gauss_try_facets(const gauss_body *of, const gauss_body *by, uint32_t tried, gauss_kind kind,
                                 gauss_least *least) {
    for (uint64_t open = gauss_find_low(of, least->height) & ~(1ull << tried); open; open &= open - 1)
        gauss_try_facet(of, by, (uint32_t)__builtin_ctzll(open), kind, least);
}

// ---- arcs that no point of the other body lifts

// For each facet the witnesses, as bits, whose value along its normal is above the height: seven of the other body's
// points, and the last one its ball, of which no more is taken than keeps the centre's own value positive.
LANES_INLINE void gauss_find_witnesses(const gauss_body *of, const gauss_body *by, double height,
                                       uint8_t found[GAUSS_FACETS]) {
    static const double is_ball[8] = {0, 0, 0, 0, 0, 0, 0, 1};
    _Alignas(64) double x[3][8];
    double radius = by->ball < height ? by->ball : height;
    for (uint32_t i = 0; i < GAUSS_WIDE; i++)
        for (int k = 0; k < 3; k++) x[k][i] = by->x[k][by->map->wide[i]];
    x[0][7] = by->center.x, x[1][7] = by->center.y, x[2][7] = by->center.z;
    lane3 p[8 / LANES];
    lane beyond[8 / LANES];
    for (uint32_t i = 0; i < 8 / LANES; i++) {
        p[i] = gauss_load(x[0], x[1], x[2], LANES * i);
        beyond[i] = lane_set(height) - lane_set(radius) * lane_load(is_ball + LANES * i);
    }
    for (uint32_t f = 0; f < of->facets; f++) {
        lane3 n = {lane_set(of->n[0][f]), lane_set(of->n[1][f]), lane_set(of->n[2][f])};
        lane low = lane_set(of->low[f]);
        unsigned bits = 0;
        for (uint32_t i = 0; i < 8 / LANES; i++)
            bits |= lane_bits(lane_greater(lane3_dot(p[i], n) + low, beyond[i])) << LANES * i;
        found[f] = (uint8_t)bits;
    }
}

#if LANES >= 4

#define GAUSS_CHUNK(i) _mm256_broadcastsi128_si256(_mm_load_si128((const __m128i *)(const void *)(table + 16 * (i))))

// The bytes of a table of 64 at 32 places.
LANES_INLINE __m256i gauss_look_up(const uint8_t table[GAUSS_FACETS], const uint8_t *places) {
    const __m256i at = _mm256_loadu_si256((const __m256i *)(const void *)places), high = _mm256_set1_epi8(0x70);
    __m256i found = _mm256_setzero_si256();
    // A place outside of a chunk has its highest bit set, for which the shuffle gives zero.
    for (int i = 0; i < GAUSS_FACETS / 16; i++) {
        __m256i within = _mm256_adds_epu8(_mm256_xor_si256(at, _mm256_set1_epi8((char)(16 * i))), high);
        found = _mm256_or_si256(found, _mm256_shuffle_epi8(GAUSS_CHUNK(i), within));
    }
    return found;
}

// Of GAUSS_ROW places of arcs those whose facets have no witness in common, as bits.
LANES_INLINE uint32_t gauss_find_unseen(const uint8_t table[GAUSS_FACETS], const uint8_t *from, const uint8_t *to) {
    __m256i both = _mm256_and_si256(gauss_look_up(table, from), gauss_look_up(table, to));
    return (uint32_t)_mm256_movemask_epi8(_mm256_cmpeq_epi8(both, _mm256_setzero_si256()));
}

#else

LANES_INLINE uint32_t gauss_find_unseen(const uint8_t table[GAUSS_FACETS], const uint8_t *from, const uint8_t *to) {
    uint32_t open = 0;
    for (uint32_t i = 0; i < GAUSS_ROW; i++) open |= (uint32_t) !(table[from[i]] & table[to[i]]) << i;
    return open;
}

#endif

// The arcs from `row` on, up to GAUSS_ROW, whose facets have no witness in common.
LANES_INLINE uint32_t gauss_find_open(const gauss_map *map, const uint8_t table[GAUSS_FACETS], uint32_t row) {
    uint32_t open = gauss_find_unseen(table, gauss_get_list(map, 0) + row, gauss_get_list(map, 1) + row),
             left = map->arcs - row;
    return left < GAUSS_ROW ? open & ((1u << left) - 1) : open;
}

// Arcs of which no witness is known.
typedef struct gauss_list {
    uint32_t count;
    uint8_t arc[GAUSS_ARCS];
} gauss_list;

GAUSS_PART void gauss_list_arcs(const gauss_map *map, const uint8_t table[GAUSS_FACETS], gauss_list *to) {
    uint32_t count = 0;
    for (uint32_t row = 0; row < map->arcs; row += GAUSS_ROW)
        for (uint32_t open = gauss_find_open(map, table, row); open; open &= open - 1)
            to->arc[count++] = (uint8_t)(row + (uint32_t)__builtin_ctz(open));
    to->count = count;
}

GAUSS_PART void gauss_find_arcs(const gauss_body *of, const gauss_body *by, double height, gauss_list *to) {
    _Alignas(64) uint8_t witnesses[GAUSS_FACETS];
    gauss_find_witnesses(of, by, height, witnesses);
    gauss_list_arcs(of->map, witnesses, to);
}

// An arc in the frame: the normals at its ends, and a vertex of its edge.
typedef struct gauss_arc {
    vec3 from, to, x;
} gauss_arc;

LANES_INLINE gauss_arc gauss_get_arc(const gauss_body *of, uint32_t arc) {
    uint32_t vertex = gauss_get_list(of->map, 2)[arc];
    return (gauss_arc){gauss_get_normal(of, gauss_get_list(of->map, 0)[arc]),
                       gauss_get_normal(of, gauss_get_list(of->map, 1)[arc]),
                       {of->x[0][vertex], of->x[1][vertex], of->x[2][vertex]}};
}

// Arcs as columns, and the cross products of their ends.
typedef struct gauss_arcs {
    uint32_t count;
    uint8_t arc[GAUSS_ARCS];
    /// Readable in groups of lanes: numbers behind the last arc are zero.
    _Alignas(64) double from[3][GAUSS_ROOM], to[3][GAUSS_ROOM], cross[3][GAUSS_ROOM], x[3][GAUSS_ROOM];
} gauss_arcs;

LANES_INLINE void gauss_store(double to[3][GAUSS_ROOM], uint32_t i, lane3 v) {
    lane_store(to[0] + i, v.x);
    lane_store(to[1] + i, v.y);
    lane_store(to[2] + i, v.z);
}

LANES_INLINE void gauss_put(double to[3][GAUSS_ROOM], uint32_t i, vec3 v) {
    to[0][i] = v.x, to[1][i] = v.y, to[2][i] = v.z;
}

LANES_INLINE void gauss_add_arc(gauss_arcs *to, uint32_t name, const gauss_arc *arc) {
    uint32_t i = to->count++;
    to->arc[i] = (uint8_t)name;
    gauss_put(to->from, i, arc->from);
    gauss_put(to->to, i, arc->to);
    gauss_put(to->x, i, arc->x);
}

// Behind the last arc.
LANES_INLINE void gauss_end_arcs(gauss_arcs *of) {
    const lane3 zero = {lane_set(0), lane_set(0), lane_set(0)};
    gauss_store(of->from, of->count, zero);
    gauss_store(of->to, of->count, zero);
    gauss_store(of->x, of->count, zero);
    for (uint32_t i = 0; i < of->count; i += LANES) {
        lane3 u = gauss_load(of->from[0], of->from[1], of->from[2], i),
              v = gauss_load(of->to[0], of->to[1], of->to[2], i);
        gauss_store(of->cross, i, lane3_cross(u, v));
    }
}

// Number by number, which costs less than to gather the lanes of a column, as it is stored again.
LANES_INLINE void gauss_put_arcs(const gauss_body *of, const gauss_list *list, gauss_arcs *to) {
    to->count = 0;
    for (uint32_t i = 0; i < list->count; i++) {
        gauss_arc arc = gauss_get_arc(of, list->arc[i]);
        gauss_add_arc(to, list->arc[i], &arc);
    }
    gauss_end_arcs(to);
}

// ---- crossings

// An arc of the first body, in all lanes.
typedef struct gauss_spread_arc {
    lane3 from, to, cross, x;
} gauss_spread_arc;

// The triple products of an arc with the ends of others, and of theirs with its ends.
typedef struct gauss_sides {
    lane a1, a2, b1, b2;
} gauss_sides;

LANES_INLINE lane_mask gauss_is_one_sided(lane a, lane b) {
    lane level = lane_set(GAUSS_LEVEL);
    return lane_or(lane_greater(lane_min(a, b), level), lane_greater(-level, lane_top(a, b)));
}

// 1 where the arcs do not cross, beyond rounding: the ends of one are on one side of the other, or they cross each
// other's circles on opposite sides of the sphere.
LANES_INLINE lane_mask gauss_are_apart(const gauss_sides *s) {
    lane level = lane_set(GAUSS_LEVEL), a = s->a2 - s->a1, b = s->b1 - s->b2;
    lane_mask opposite = lane_or(lane_and(lane_greater(a, level), lane_greater(-level, b)),
                                 lane_and(lane_greater(-level, a), lane_greater(b, level)));
    return lane_or(opposite, lane_or(gauss_is_one_sided(s->a1, s->a2), gauss_is_one_sided(s->b1, s->b2)));
}

// The state of a search over crossings.
typedef struct gauss_search {
    double slack;
    gauss_plane *out;
    double blur; ///< no crossing without a direction is lower than the least height by more than this
} gauss_search;

LANES_INLINE void gauss_take_crossing(gauss_search *s, lane height, lane3 n, unsigned below, const uint8_t *arcs) {
    _Alignas(64) double heights[LANES], x[LANES], y[LANES], z[LANES];
    lane_store(heights, height);
    lane_store(x, n.x);
    lane_store(y, n.y);
    lane_store(z, n.z);
    for (; below; below &= below - 1) {
        uint32_t k = (uint32_t)__builtin_ctz(below);
        if (!(heights[k] < s->out->height)) continue;
        s->out->height = heights[k];
        s->out->n = (vec3){x[k], y[k], z[k]};
        s->out->b = arcs[k];
        s->out->kind = GAUSS_CROSSING;
    }
}

// Arcs that lie nearly on one circle: how far the first one may be from the other's circle.
LANES_INLINE void gauss_take_blur(gauss_search *s, const gauss_spread_arc *u, lane3 cross, const gauss_sides *sides,
                                  unsigned blurred) {
    _Alignas(64) double off[LANES];
    lane3 sum = lane3_add(u->from, u->to);
    lane most = lane_top(lane_abs(sides->b1), lane_abs(sides->b2)) + lane_set(GAUSS_LEVEL);
    lane_store(off, most / lane_sqrt(lane3_dot(cross, cross) * lane3_dot(sum, sum)));
    for (; blurred; blurred &= blurred - 1) {
        double now = off[__builtin_ctz(blurred)] * GAUSS_BLUR;
        s->blur = now > s->blur ? now : s->blur;
    }
}

// The crossings of an arc of the first body with LANES of the second one, of which `all` are there. 1 if one of them is
// the least high now.
GAUSS_PART int gauss_cross(gauss_search *s, const gauss_spread_arc *u, const gauss_arcs *others, uint32_t at,
                           unsigned all) {
    lane3 cross = gauss_load(others->cross[0], others->cross[1], others->cross[2], at);
    gauss_sides sides = {lane3_dot(u->cross, gauss_load(others->from[0], others->from[1], others->from[2], at)),
                         lane3_dot(u->cross, gauss_load(others->to[0], others->to[1], others->to[2], at)),
                         lane3_dot(cross, u->from), lane3_dot(cross, u->to)};
    unsigned open = ~lane_bits(gauss_are_apart(&sides)) & all;
    if (!open) return 0;
    // In the first arc's plane and across the other's: the positive combination of both ends, for b1 and b2 are of
    // opposite signs.
    lane3 n = {sides.b1 * u->to.x - sides.b2 * u->from.x, sides.b1 * u->to.y - sides.b2 * u->from.y,
               sides.b1 * u->to.z - sides.b2 * u->from.z};
    lane length = lane_sqrt(lane3_dot(n, n)), inverse = lane_set(1) / length;
    unsigned blurred = open & ~lane_bits(lane_greater(length, lane_set(GAUSS_SHARP)));
    if (blurred) gauss_take_blur(s, u, cross, &sides, blurred);
    lane sign = lane_select(lane_greater(sides.b1, sides.b2), inverse, -inverse);
    lane3 x = lane3_add(gauss_load(others->x[0], others->x[1], others->x[2], at), u->x);
    lane height = lane3_dot(n, x) * sign - lane_set(s->slack) * inverse;
    unsigned below = open & ~blurred & lane_bits(lane_greater(lane_set(s->out->height), height));
    if (!below) return 0;
    gauss_take_crossing(s, height, (lane3){n.x * sign, n.y * sign, n.z * sign}, below, others->arc + at);
    return 1;
}

// The crossings of an arc of the first body with those of the second one.
LANES_INLINE void gauss_try_arc(gauss_search *s, uint32_t name, const gauss_arc *arc, const gauss_arcs *others) {
    const lane3 from = gauss_spread(arc->from), to = gauss_spread(arc->to);
    const gauss_spread_arc u = {from, to, lane3_cross(from, to), gauss_spread(arc->x)};
    for (uint32_t k = 0; k < others->count; k += LANES) {
        uint32_t left = others->count - k;
        unsigned all = left < LANES ? (1u << left) - 1 : (1u << LANES) - 1;
        if (gauss_cross(s, &u, others, k, all)) s->out->a = name;
    }
}
