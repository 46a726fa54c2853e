// The surface of epa8.h: its planes, what a point sees of it, the cone that a new point adds.
#include "linear/vec3.h"
#include "simd/epa8.h"
#include "simd/kernels/lanes.h"
#include "simd/planes.h"

enum { EPA8_ROW = 4 };

#if LANES == 8
LANES_INLINE lane_mask lane_mask_of_faces(uint64_t bits) { return (lane_mask)bits; }
/// The numbers of an array of EPA8_POINTS at the places in the low bits of the index; is_few: all below 16.
LANES_INLINE lane lane_pick_at(const double *p, __m512i index, int is_few) {
    __m512d low = _mm512_permutex2var_pd(_mm512_load_pd(p), index, _mm512_load_pd(p + 8));
    if (is_few) return low;
    __m512d high = _mm512_permutex2var_pd(_mm512_load_pd(p + 16), index, _mm512_load_pd(p + 24));
    return _mm512_mask_blend_pd(_mm512_test_epi64_mask(index, _mm512_set1_epi64(16)), low, high);
}
/// The same at LANES places, a byte each.
LANES_INLINE lane lane_pick(const double *p, uint64_t at, int is_few) {
    return lane_pick_at(p, _mm512_cvtepu8_epi64(_mm_cvtsi64_si128((long long)at)), is_few);
}
/// The same at the corners k of LANES faces.
LANES_INLINE lane lane_pick_corners(const double *p, const uint8_t v[][4], uint32_t k, int is_few) {
    __m512i faces = _mm512_cvtepu32_epi64(_mm256_loadu_si256((const __m256i *)v));
    return lane_pick_at(p, _mm512_srli_epi64(faces, 8 * k), is_few);
}
/// Four numbers as the first of LANES.
LANES_INLINE void lane_store_four(double *to, double a, double b, double c, double d) {
    _mm512_store_pd(to, _mm512_setr_pd(a, b, c, d, 0, 0, 0, 0));
}
#elif LANES == 4
LANES_INLINE lane_mask lane_mask_of_faces(uint64_t bits) {
    __m256i each = _mm256_setr_epi64x(1, 2, 4, 8), all = _mm256_set1_epi64x((long long)bits);
    return _mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(all, each), each));
}
LANES_INLINE lane lane_pick(const double *p, uint64_t at, int is_few) {
    (void)is_few;
    return _mm256_setr_pd(p[at & 0xff], p[at >> 8 & 0xff], p[at >> 16 & 0xff], p[at >> 24 & 0xff]);
}
LANES_INLINE lane lane_pick_corners(const double *p, const uint8_t v[][4], uint32_t k, int is_few) {
    (void)is_few;
    return _mm256_setr_pd(p[v[0][k]], p[v[1][k]], p[v[2][k]], p[v[3][k]]);
}
LANES_INLINE void lane_store_four(double *to, double a, double b, double c, double d) {
    _mm256_store_pd(to, _mm256_setr_pd(a, b, c, d));
}
#elif LANES == 2
LANES_INLINE lane_mask lane_mask_of_faces(uint64_t bits) {
    return (lane_mask){-(long long)(bits & 1), -(long long)(bits >> 1 & 1)};
}
LANES_INLINE lane lane_pick(const double *p, uint64_t at, int is_few) {
    (void)is_few;
    return (lane){p[at & 0xff], p[at >> 8 & 0xff]};
}
LANES_INLINE lane lane_pick_corners(const double *p, const uint8_t v[][4], uint32_t k, int is_few) {
    (void)is_few;
    return (lane){p[v[0][k]], p[v[1][k]]};
}
LANES_INLINE void lane_store_four(double *to, double a, double b, double c, double d) {
    lane_store(to, (lane){a, b});
    lane_store(to + 2, (lane){c, d});
}
#else
LANES_INLINE lane_mask lane_mask_of_faces(uint64_t bits) { return (lane_mask)(bits & 1); }
LANES_INLINE lane lane_pick(const double *p, uint64_t at, int is_few) {
    (void)is_few;
    return p[at & 0xff];
}
LANES_INLINE lane lane_pick_corners(const double *p, const uint8_t v[][4], uint32_t k, int is_few) {
    (void)is_few;
    return p[v[0][k]];
}
LANES_INLINE void lane_store_four(double *to, double a, double b, double c, double d) {
    to[0] = a, to[1] = b, to[2] = c, to[3] = d;
}
#endif

LANES_INLINE lane lane_find_min(lane m) { return -lane_find_max(-m); }

// ---- faces

#if LANES == 1

// One by one, only the faces that there are; the wider lanes look at places without one too.

// The faces that are at most that far, as bits.
LANES_INLINE void find_below(const epa8 *s, lane most, uint64_t below[2]) {
    for (uint32_t half = 0; half < 2; half++) {
        uint64_t bits = 0;
        for (uint64_t rest = s->alive[half]; rest; rest &= rest - 1)
            if (s->low[64 * half + (uint32_t)__builtin_ctzll(rest)] <= most) bits |= rest & -rest;
        below[half] = bits;
    }
}

// The face of least offset; of several the first.
LANES_INLINE uint32_t find_nearest_face(const epa8 *s) {
    uint32_t nearest = 0;
    double least = INFINITY;
    for (uint32_t half = 0; half < 2; half++)
        for (uint64_t rest = s->alive[half]; rest; rest &= rest - 1) {
            uint32_t at = 64 * half + (uint32_t)__builtin_ctzll(rest);
            nearest = s->low[at] < least ? at : nearest;
            least = s->low[at] < least ? s->low[at] : least;
        }
    return nearest;
}

// The faces that see a point, as bits.
LANES_INLINE uint64_t find_seen(const epa8 *s, const epa8_query *q, const simd_difference *point, uint64_t seen[2]) {
    for (uint32_t half = 0; half < 2; half++) {
        uint64_t bits = 0;
        for (uint64_t rest = s->alive[half]; rest; rest &= rest - 1) {
            uint32_t at = 64 * half + (uint32_t)__builtin_ctzll(rest);
            double along = (s->n[0][at] * point->x + s->n[1][at] * point->y) + s->n[2][at] * point->z;
            bits |= along - s->low[at] > q->slack ? rest & -rest : 0;
        }
        seen[half] = bits;
    }
    return seen[0] | seen[1];
}

#else

// The groups are looked at in rows of four, so that no loop's end depends on how many there are; those without faces
// are masked.

/// The bits of one row of four groups.
LANES_INLINE uint64_t get_row(const uint64_t bits[2], uint32_t row) { return bits[row / 8] >> row % 8 * 8; }

LANES_INLINE void add_row(uint64_t bits[2], uint32_t row, uint64_t found) { bits[row / 8] |= found << row % 8 * 8; }

// The faces that are at most that far, as bits.
LANES_INLINE void find_below(const epa8 *s, lane most, uint64_t below[2]) {
    below[0] = below[1] = 0;
    for (uint32_t row = 0; row < s->groups; row += EPA8_ROW) {
        uint64_t bits = 0;
        for (uint32_t i = 0; i < EPA8 * EPA8_ROW; i += LANES)
            bits |= (uint64_t)lane_bits(lane_at_most(lane_load(s->low + EPA8 * row + i), most)) << i;
        add_row(below, row, bits);
    }
    below[0] &= s->alive[0];
    below[1] &= s->alive[1];
}

// The face of least offset; of several the first.
LANES_INLINE uint32_t find_nearest_face(const epa8 *s) {
    lane least = lane_set(INFINITY);
    for (uint32_t row = 0; row < s->groups; row += EPA8_ROW) {
        uint64_t alive = get_row(s->alive, row);
        for (uint32_t i = 0; i < EPA8 * EPA8_ROW; i += LANES) {
            lane low = lane_load(s->low + EPA8 * row + i);
            least = lane_min(lane_select(lane_mask_of_faces(alive >> i), low, lane_set(INFINITY)), least);
        }
    }
    uint64_t below[2];
    find_below(s, lane_find_min(least), below);
    return below[0] ? (uint32_t)__builtin_ctzll(below[0]) : 64 + (uint32_t)__builtin_ctzll(below[1]);
}

// The faces that see a point, as bits.
LANES_INLINE uint64_t find_seen(const epa8 *s, const epa8_query *q, const simd_difference *point, uint64_t seen[2]) {
    lane3 w = {lane_set(point->x), lane_set(point->y), lane_set(point->z)};
    seen[0] = seen[1] = 0;
    for (uint32_t row = 0; row < s->groups; row += EPA8_ROW) {
        uint64_t bits = 0;
        for (uint32_t i = 0; i < EPA8 * EPA8_ROW; i += LANES) {
            uint32_t at = EPA8 * row + i;
            lane3 n = {lane_load(s->n[0] + at), lane_load(s->n[1] + at), lane_load(s->n[2] + at)};
            lane above = lane3_dot(n, w) - lane_load(s->low + at);
            bits |= (uint64_t)lane_bits(lane_greater(above, lane_set(q->slack))) << i;
        }
        add_row(seen, row, bits);
    }
    seen[0] &= s->alive[0];
    seen[1] &= s->alive[1];
    return seen[0] | seen[1];
}

#endif

/// The edges between faces that see a point and faces that do not, counter-clockwise around the former: the corners
/// where they begin and end, a byte each.
typedef struct rim {
    uint32_t count;
    uint64_t from[EPA8_POINTS / EPA8], to[EPA8_POINTS / EPA8];
} rim;

LANES_INLINE uint32_t get_byte(const uint64_t *bytes, uint32_t i) { return bytes[i / 8] >> i % 8 * 8 & 0xff; }

// 0 if the rim passes a corner twice, or is none.
LANES_INLINE int find_rim(const epa8 *s, const uint64_t seen[2], rim *r) {
    uint64_t low = seen[0], high = seen[1], first = 0, last = 0;
    uint32_t count = 0, begun = 0, twice = 0;
    for (uint64_t rest = low, at = 0; rest || (at == 0 && high); rest &= rest - 1) {
        if (!rest) rest = high, at = 64;
        uint32_t packed;
        __builtin_memcpy(&packed, s->v[at + (uint32_t)__builtin_ctzll(rest)], sizeof packed);
        uint32_t v[4] = {packed & 0xff, packed >> 8 & 0xff, packed >> 16 & 0xff, packed & 0xff};
        for (int e = 0; e < 3; e++) {
            uint32_t i = v[e], k = v[e + 1], outer = s->left[k][i];
            uint64_t is_rim = ~((outer & 64 ? high : low) >> (outer & 63)) & 1;
            // A word is kept when eight bytes are in it.
            first |= (i & -is_rim) << (count & 7) * 8;
            last |= (k & -is_rim) << (count & 7) * 8;
            twice |= begun & (uint32_t)is_rim << i;
            begun |= (uint32_t)is_rim << i;
            count += (uint32_t)is_rim;
            if (__builtin_expect(is_rim && (count & 7) == 0, 0)) {
                if (count > EPA8_POINTS) return 0;
                r->from[count / 8 - 1] = first, r->to[count / 8 - 1] = last;
                first = last = 0;
            }
        }
    }
    if (count < EPA8_POINTS) r->from[count / 8] = first, r->to[count / 8] = last;
    r->count = count;
    return count >= 3 && count <= EPA8_POINTS && !twice;
}

LANES_INLINE lane3 pick_points(const epa8 *s, uint64_t at) {
    int is_few = s->points <= 16;
    return (lane3){lane_pick(s->w[0], at, is_few), lane_pick(s->w[1], at, is_few), lane_pick(s->w[2], at, is_few)};
}

// The planes of LANES faces between apexes c and edges from u to v, at a place. Returns the bits of the plain ones, no
// slivers; *inward: of those that may not have the origin behind them. The operations are those of simd/planes.c.
LANES_INLINE unsigned set_planes(epa8 *s, const epa8_query *q, uint32_t at, lane3 c, lane3 u, lane3 v,
                                 unsigned *inward) {
    u = lane3_sub(u, c), v = lane3_sub(v, c);
    lane3 n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    lane area = lane3_dot(n, n), uu = lane3_dot(u, u), vv = lane3_dot(v, v);
    lane_mask is_wide = lane_greater(area, lane_set(SIMD_AREA_MIN));
    n = lane3_scale(n, lane_set(1) / lane_sqrt(lane_select(is_wide, area, lane_set(1))));
    lane low = lane3_dot(n, c), square = area * low * low;
    lane_store(s->n[0] + at, n.x);
    lane_store(s->n[1] + at, n.y);
    lane_store(s->n[2] + at, n.z);
    lane_store(s->low + at, low);
    *inward = lane_bits(
        lane_not(lane_and(lane_greater(low, lane_set(0)), lane_greater(square, lane_set(q->doubt) * (uu + vv)))));
    return lane_bits(lane_and(lane_greater(area, lane_set(1e-4) * (uu * vv)), is_wide));
}

// A group of faces between an apex and edges; *inward: as above. 0 if one is a sliver.
LANES_INLINE int set_group(epa8 *s, const epa8_query *q, uint32_t g, vec3 apex, uint64_t from, uint64_t to,
                           unsigned all, unsigned *inward) {
    lane3 c = {lane_set(apex.x), lane_set(apex.y), lane_set(apex.z)};
    unsigned plain = 0, doubtful = 0;
    for (uint32_t i = 0; i < EPA8; i += LANES) {
        unsigned some;
        if (LANES < EPA8 && !(all >> i)) break;
        lane3 u = pick_points(s, from >> 8 * i), v = pick_points(s, to >> 8 * i);
        plain |= set_planes(s, q, EPA8 * g + i, c, u, v, &some) << i;
        doubtful |= some << i;
    }
    *inward = doubtful & all;
    return !(~plain & all);
}

// The lowest group without a face; EPA8_GROUPS if there is none.
LANES_INLINE uint32_t find_empty(const uint64_t alive[2]) {
    for (uint32_t half = 0; half < 2; half++) {
        uint64_t some = alive[half] | alive[half] >> 4;
        some |= some >> 2;
        some |= some >> 1;
        uint64_t none = ~some & 0x0101010101010101u;
        if (none) return EPA8 * half + (uint32_t)__builtin_ctzll(none) / 8;
    }
    return EPA8_GROUPS;
}

LANES_INLINE void set_corners(epa8 *s, uint32_t face, uint32_t i, uint32_t j, uint32_t k) {
    uint32_t packed = i | j << 8 | k << 16;
    __builtin_memcpy(s->v[face], &packed, sizeof packed);
    s->left[i][j] = s->left[j][k] = s->left[k][i] = (uint8_t)face;
}

// A cone of faces over a rim, in groups that are empty. 0 if one is a sliver or there is no group left: then nothing is
// changed.
LANES_INLINE int add_cone(epa8 *s, const epa8_query *q, uint32_t apex, vec3 w, const rim *r) {
    uint64_t alive[2] = {s->alive[0], s->alive[1]}, doubtful[2] = {0, 0};
    uint32_t group[EPA8_POINTS / EPA8], groups = s->groups;
    for (uint32_t i = 0; i < r->count; i += EPA8) {
        uint32_t g = find_empty(alive), rest = r->count - i;
        if (g == EPA8_GROUPS) return 0;
        unsigned all = rest < EPA8 ? (1u << rest) - 1 : 0xff, inward;
        if (!set_group(s, q, g, w, r->from[i / EPA8], r->to[i / EPA8], all, &inward)) return 0;
        alive[g / 8] |= (uint64_t)all << g % 8 * 8;
        doubtful[g / 8] |= (uint64_t)inward << g % 8 * 8;
        group[i / EPA8] = g;
        if (g >= groups) groups = g + 1;
    }
    // A whole group each, the last one first: what is no face is overwritten where it is in the way.
    for (uint32_t i = (r->count + EPA8 - 1) / EPA8; i-- > 0;) {
        uint64_t from = r->from[i], to = r->to[i];
        for (int k = EPA8 - 1; k >= 0; k--)
            set_corners(s, EPA8 * group[i] + (uint32_t)k, apex, from >> 8 * k & 0xff, to >> 8 * k & 0xff);
    }
    s->groups = groups;
    for (int i = 0; i < 2; i++) s->alive[i] = alive[i], s->inward[i] |= doubtful[i];
    return 1;
}
