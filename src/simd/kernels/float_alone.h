// The search of float_gjk.h of one couple, with the bits of a lane: the operations of kernels/float_rounds.h and
// kernels/simplex_step.h in their order. The vertices are in the room of the columns, x of all, then y, z, and a
// support goes over eight of them at once. The step has the three edges of the simplex in four lanes.
#include "simd/kernels/float_gjk.h"

#include <immintrin.h>

// Eights beyond the body's own repeat its first.
LANES_INLINE void load_body(const float *from, uint32_t own, float factor, float *to, uint32_t blocks) {
    __m256 scale = _mm256_set1_ps(factor);
    for (uint32_t d = 0; d < 3; d++)
        for (uint32_t i = 0; i < blocks; i++) {
            __m256 v = _mm256_load_ps(from + 8 * (d * own + (i < own ? i : 0)));
            _mm256_store_ps(to + 8 * (d * blocks + i), _mm256_mul_ps(v, scale));
        }
}

// `lanes` is one lane.
LANES_TARGET static void run_float_load(const float_points *from, unsigned lanes, float_gjk *to) {
    int k = __builtin_ctz(lanes);
    load_body(from->a[k], from->blocks_a[k], to->query.factor_a.lane[k], to->columns.a->lane, to->blocks);
    load_body(from->b[k], from->blocks_b[k], to->query.factor_b.lane[k], to->columns.b->lane, to->blocks);
}

// ---- supports

LANES_INLINE float find_greatest(__m256 v) {
    __m128 m = _mm_max_ps(_mm256_castps256_ps128(v), _mm256_extractf128_ps(v, 1));
    m = _mm_max_ps(m, _mm_movehl_ps(m, m));
    return _mm_cvtss_f32(_mm_max_ss(m, _mm_movehdup_ps(m)));
}

// The greatest of `count` vertices, or the least: of equal ones the first of the even or, if there is none, of the odd.
LANES_INLINE float_support find_extreme(const float *p, int count, lane3 n, int is_least) {
    float sign = is_least ? -1 : 1;
    __m256 x = _mm256_set1_ps(sign * n.x), y = _mm256_set1_ps(sign * n.y), z = _mm256_set1_ps(sign * n.z);
    __m256 v[FLOAT_GJK_BLOCKS], most = _mm256_set1_ps(-INFINITY);
    unsigned equal = 0;
    for (int i = 0; i < count; i += 8) {
        __m256 xy =
            _mm256_add_ps(_mm256_mul_ps(_mm256_load_ps(p + i), x), _mm256_mul_ps(_mm256_load_ps(p + count + i), y));
        v[i / 8] = _mm256_add_ps(xy, _mm256_mul_ps(_mm256_load_ps(p + 2 * count + i), z));
        most = _mm256_max_ps(most, v[i / 8]);
    }
    float value = find_greatest(most);
    __m256 best = _mm256_set1_ps(value);
    for (int i = 0; i < count; i += 8)
        equal |= (unsigned)_mm256_movemask_ps(_mm256_cmp_ps(v[i / 8], best, _CMP_EQ_OQ)) << i;
    unsigned even = equal & 0x55555555, k = (unsigned)__builtin_ctz(even ? even : equal ? equal : 1);
    return (float_support){sign * value, {p[k], p[(unsigned)count + k], p[2 * (unsigned)count + k]}, (float)(k)};
}

// ---- the step

typedef struct edges4 {
    __m128 x, y, z;
} edges4;

LANES_INLINE __m128 edges4_dot(edges4 a, edges4 b) {
    return _mm_add_ps(_mm_add_ps(_mm_mul_ps(a.x, b.x), _mm_mul_ps(a.y, b.y)), _mm_mul_ps(a.z, b.z));
}
LANES_INLINE edges4 edges4_cross(edges4 a, edges4 b) {
    return (edges4){_mm_sub_ps(_mm_mul_ps(a.y, b.z), _mm_mul_ps(a.z, b.y)),
                    _mm_sub_ps(_mm_mul_ps(a.z, b.x), _mm_mul_ps(a.x, b.z)),
                    _mm_sub_ps(_mm_mul_ps(a.x, b.y), _mm_mul_ps(a.y, b.x))};
}
// Lane i becomes the one that follows i, or the one before, of three.
LANES_INLINE __m128 get_next(__m128 v) { return _mm_permute_ps(v, 0xc9); }
LANES_INLINE __m128 get_previous(__m128 v) { return _mm_permute_ps(v, 0xd2); }
LANES_INLINE edges4 edges4_get_next(edges4 a) { return (edges4){get_next(a.x), get_next(a.y), get_next(a.z)}; }

// The next heading, the corners that stay, as bits, and 1 where the origin is inside of all faces.
typedef struct float_step {
    lane3 n;
    unsigned kept;
    int is_inside;
} float_step;

// The headings of the faces, 0 to 2, of the edges, 4 to 6, and of the new corner, 7.
typedef struct float_headings {
    _Alignas(16) float x[8];
    _Alignas(16) float y[8];
    _Alignas(16) float z[8];
} float_headings;

// The first of the faces, else of the edges, else the new corner.
LANES_INLINE float_step pick_heading(const float_headings *all, unsigned faces, unsigned edges) {
    static const uint8_t kept[8] = {1 | 2, 2 | 4, 4 | 1, 0, 1, 2, 4, 0};
    unsigned i = (unsigned)__builtin_ctz(faces | edges << 4 | 1u << 7);
    return (float_step){{all->x[i], all->y[i], all->z[i]}, kept[i], 0};
}

// old: lane i the corner i of those in `valid`.
LANES_INLINE float_step take_step(edges4 old, unsigned valid, lane3 w) {
    // Of each set of corners in use the corners, and the faces that two of them make with the new one.
    static const _Alignas(16) int32_t corners[8][4] = {{0, 0, 0, 0},  {-1, 0, 0, 0},  {0, -1, 0, 0},  {-1, -1, 0, 0},
                                                       {0, 0, -1, 0}, {-1, 0, -1, 0}, {0, -1, -1, 0}, {-1, -1, -1, 0}};
    static const _Alignas(16) int32_t faces[8][4] = {{0, 0, 0, 0}, {0, 0, 0, 0},  {0, 0, 0, 0},  {-1, 0, 0, 0},
                                                     {0, 0, 0, 0}, {0, 0, -1, 0}, {0, -1, 0, 0}, {-1, -1, -1, 0}};
    __m128 has_corner = _mm_load_ps((const float *)corners[valid]), has_face = _mm_load_ps((const float *)faces[valid]);
    __m128 is_full = valid == 7 ? has_face : _mm_setzero_ps();
    edges4 a = {_mm_set1_ps(w.x), _mm_set1_ps(w.y), _mm_set1_ps(w.z)};
    edges4 e = {_mm_sub_ps(old.x, a.x), _mm_sub_ps(old.y, a.y), _mm_sub_ps(old.z, a.z)};
    edges4 f = edges4_get_next(e), c = edges4_cross(a, e), n = edges4_cross(e, f), k = edges4_cross(e, c);
    __m128 height = edges4_dot(n, a), volume = edges4_dot(n, edges4_get_next(f));
    __m128 behind = _mm_and_ps(_mm_xor_ps(height, volume), is_full);
    __m128 first = _mm_andnot_ps(edges4_dot(n, c), has_face);
    __m128 next = _mm_and_ps(edges4_dot(n, edges4_get_next(c)), has_face);
    __m128 face = _mm_andnot_ps(behind, _mm_and_ps(first, next));
    __m128 edge = _mm_andnot_ps(_mm_or_ps(first, get_previous(next)), _mm_and_ps(edges4_dot(a, e), has_corner));
    // Faces point away from the origin.
    __m128 flip = _mm_and_ps(height, _mm_set1_ps(-0.0f));
    float_headings all;
    _mm_store_ps(all.x, _mm_xor_ps(n.x, flip));
    _mm_store_ps(all.y, _mm_xor_ps(n.y, flip));
    _mm_store_ps(all.z, _mm_xor_ps(n.z, flip));
    _mm_store_ps(all.x + 4, _mm_blend_ps(k.x, a.x, 8));
    _mm_store_ps(all.y + 4, _mm_blend_ps(k.y, a.y, 8));
    _mm_store_ps(all.z + 4, _mm_blend_ps(k.z, a.z, 8));
    float_step s = pick_heading(&all, (unsigned)_mm_movemask_ps(face), (unsigned)_mm_movemask_ps(edge));
    s.is_inside = _mm_movemask_ps(behind) == 7;
    return s;
}

// ---- the search

// The simplex, its nearest point's direction and the height along it times its length, |n|^2.
typedef struct float_walk {
    edges4 old;
    unsigned valid;
    lane3 n;
    float height, square, steps;
} float_walk;

typedef enum float_end { FLOAT_GOES, FLOAT_APART, FLOAT_NEAR, FLOAT_INSIDE, FLOAT_OPEN } float_end;

LANES_INLINE void get_corners(const float_walk *k, lane3 old[3], lane_mask valid[3]) {
    _Alignas(16) float x[4];
    _Alignas(16) float y[4];
    _Alignas(16) float z[4];
    _mm_store_ps(x, k->old.x);
    _mm_store_ps(y, k->old.y);
    _mm_store_ps(z, k->old.z);
    for (int i = 0; i < 3; i++) {
        old[i] = (lane3){x[i], y[i], z[i]};
        valid[i] = k->valid >> i & 1;
    }
}

// What the bounds say that a support shows; scale: one through its direction's length.
LANES_INLINE float_end test_bounds(float_gjk *s, const float_walk *k, const float_meeting *m, float scale) {
    const float_query *q = &s->query;
    float claim = *q->claim.lane, near_to = *q->near.lane;
    float lower = m->gap * scale - claim, upper = lane3_norm(m->w) + claim;
    *s->lower.lane = lower;
    *s->upper.lane = upper;
    if (lower > *q->far.lane) return FLOAT_APART;
    if (!(lower > 0)) return FLOAT_GOES;
    if (upper <= near_to) return FLOAT_NEAR;
    if (!(k->height * (1 / sqrtf(k->square)) + claim <= near_to)) return FLOAT_GOES;
    lane3 old[3];
    lane_mask valid[3];
    get_corners(k, old, valid);
    *s->upper.lane = compute_norm(old, valid) + claim;
    return *s->upper.lane <= near_to ? FLOAT_NEAR : FLOAT_GOES;
}

LANES_INLINE float_end test_inside(float_gjk *s, const float_walk *k, lane3 w) {
    lane3 old[3];
    lane_mask valid[3];
    get_corners(k, old, valid);
    float claim = *s->query.claim.lane, depth = measure_tetrahedron(old, w);
    *s->upper.lane = claim - depth;
    return depth > claim ? FLOAT_INSIDE : FLOAT_OPEN;
}

LANES_INLINE void put_corner(edges4 *old, unsigned i, lane3 w) {
    static const _Alignas(16) int32_t place[4][4] = {{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, -1}};
    __m128 here = _mm_load_ps((const float *)place[i]);
    old->x = _mm_blendv_ps(old->x, _mm_set1_ps(w.x), here);
    old->y = _mm_blendv_ps(old->y, _mm_set1_ps(w.y), here);
    old->z = _mm_blendv_ps(old->z, _mm_set1_ps(w.z), here);
}

// The place of a new corner, which is written there.
LANES_INLINE unsigned replace_corner(float_walk *k, unsigned kept, lane3 w) {
    unsigned place = (unsigned)__builtin_ctz(~kept);
    put_corner(&k->old, place, w);
    k->valid = kept | 1u << place;
    return place;
}

// Takes the step to a new corner, if it gains: a support that is a corner again gains nothing, and a height within the
// error says nothing of the sign.
LANES_INLINE float_end advance_walk(float_gjk *s, float_walk *k, const float_meeting *m) {
    lane3 w = m->w;
    *s->found.corner[3].lane = m->id;
    float_step next = take_step(k->old, k->valid, w);
    if (next.is_inside) return test_inside(s, k, w);
    float claim = *s->query.claim.lane, high = lane3_dot(next.n, w), norm = lane3_dot(next.n, next.n);
    int gains =
        (high * high * k->square < k->height * k->height * norm) & is_clear(high, norm, claim) & (k->steps < s->most);
    if (!gains) return FLOAT_OPEN;
    *s->found.corner[replace_corner(k, next.kept, w)].lane = m->id;
    k->n = next.n;
    k->height = high;
    k->square = norm;
    return FLOAT_GOES;
}

LANES_INLINE float_meeting find_meeting(const float_gjk *s, lane3 n, int count) {
    const float *a = s->columns.a->lane, *b = s->columns.b->lane;
    return meet(s, n, 0, find_extreme(a, count, n, 0), find_extreme(b, count, turn_to_b(s, n, 0), 1));
}

// Takes a support, and the step to it.
LANES_INLINE float_end take_meeting(float_gjk *s, float_walk *k, const float_meeting *m, float scale) {
    k->steps += 1;
    float_end end = test_bounds(s, k, m, scale);
    return end == FLOAT_GOES ? advance_walk(s, k, m) : end;
}

LANES_INLINE float_end search(float_gjk *s, int count) {
    lane3 n = get3(s->query.start, 0);
    __m128 zero = _mm_setzero_ps();
    float_walk k = {{zero, zero, zero}, 0, n, INFINITY, lane3_dot(n, n), -1};
    float_end end = FLOAT_GOES;
    while (end == FLOAT_GOES) {
        float_meeting m = find_meeting(s, k.n, count);
        end = take_meeting(s, &k, &m, 1 / sqrtf(k.square));
    }
    *s->steps.lane = k.steps;
    put3(s->n, 0, k.n);
    return end;
}

// The search between two supports that the caller finds, as it is kept in lane 0.
LANES_INLINE float_walk get_walk(const float_gjk *s) {
    __m128 zero = _mm_setzero_ps();
    float_walk k = {{zero, zero, zero}, 0, get3(s->given.heading, 0), *s->height.lane, *s->square.lane, *s->steps.lane};
    for (unsigned i = 0; i < 3; i++) {
        put_corner(&k.old, i, get3(&s->old[3 * i], 0));
        k.valid |= lane_sign(get(&s->is_valid[i], 0)) << i;
    }
    return k;
}

LANES_INLINE void put_walk(float_gjk *s, const float_walk *k) {
    lane3 old[3];
    lane_mask valid[3];
    get_corners(k, old, valid);
    for (int i = 0; i < 3; i++) {
        put3(&s->old[3 * i], 0, old[i]);
        lane_store_mask(s->is_valid[i].lane, valid[i]);
    }
    put3(s->given.heading, 0, k->n);
    *s->height.lane = k->height;
    *s->square.lane = k->square;
    *s->steps.lane = k->steps;
}

LANES_TARGET static void run_float_turn(float_gjk *s) { put3(s->given.b, 0, turn_to_b(s, get3(s->n, 0), 0)); }

// A step to the given support.
LANES_INLINE float_end take_given(float_gjk *s) {
    float_walk k = get_walk(s);
    lane3 a = get3(s->given.a, 0), b = get3(s->given.b, 0), n = get3(s->n, 0), in_b = turn_to_b(s, n, 0);
    float_meeting m = meet(s, n, 0, (float_support){lane3_dot(a, n), a, 0}, (float_support){lane3_dot(b, in_b), b, 0});
    float_end end = take_meeting(s, &k, &m, 1 / sqrtf(lane3_dot(n, n)));
    put_walk(s, &k);
    if (end != FLOAT_GOES && end != FLOAT_OPEN) return end;
    return choose_direction(s, 0, end == FLOAT_GOES, 1, m.w) ? FLOAT_GOES : FLOAT_OPEN;
}

LANES_INLINE float_ends end_walk(float_gjk *s, float_end end) {
    s->live = end == FLOAT_GOES;
    return (float_ends){end == FLOAT_APART, end == FLOAT_NEAR, end == FLOAT_INSIDE, end == FLOAT_OPEN};
}

// Searches the couple of lane 0 to its end, or by a step.
LANES_TARGET static float_ends run_float_advance(float_gjk *s) {
    switch (s->blocks) {
    case 0: return end_walk(s, take_given(s));
    case 1: return end_walk(s, search(s, 8));
    case 2: return end_walk(s, search(s, 16));
    case 3: return end_walk(s, search(s, 24));
    default: return end_walk(s, search(s, 32));
    }
}

// ---- nearest points

// The step of kernels/float_rounds.h's advance_walk.
LANES_INLINE float_end approach_walk(const float_gjk *s, float_walk *k, const float_meeting *m, lane id[3]) {
    float claim = *s->query.claim.lane;
    if (is_nearest(m->gap, k->height, k->square, claim)) return FLOAT_NEAR;
    for (int i = 0; i < 3; i++)
        if ((k->valid >> i & 1) && id[i] == m->id) return FLOAT_NEAR;
    float_step next = take_step(k->old, k->valid, m->w);
    if (next.is_inside) return FLOAT_INSIDE;
    float high = lane3_dot(next.n, m->w), norm = lane3_dot(next.n, next.n);
    if (!(high * high * k->square < k->height * k->height * norm)) return FLOAT_NEAR;
    if (!is_clear(high, norm, claim) | !(k->steps < s->most)) return FLOAT_OPEN;
    id[replace_corner(k, next.kept, m->w)] = m->id;
    k->n = next.n;
    k->height = high;
    k->square = norm;
    k->steps += 1;
    return FLOAT_GOES;
}

LANES_INLINE float_end approach(float_gjk *s, int count) {
    float_meeting m = find_meeting(s, get3(s->query.translation, 0), count);
    __m128 zero = _mm_setzero_ps();
    float square = lane3_dot(m.w, m.w);
    float_walk k = {{zero, zero, zero}, 0, m.w, square, square, 0};
    lane id[3] = {m.id, 0, 0};
    if (!is_clear(square, square, *s->query.claim.lane)) return FLOAT_OPEN;
    (void)replace_corner(&k, 0, m.w);
    float_end end = FLOAT_GOES;
    while (end == FLOAT_GOES) {
        m = find_meeting(s, k.n, count);
        end = approach_walk(s, &k, &m, id);
    }
    lane_mask valid[3] = {k.valid & 1, k.valid >> 1 & 1, k.valid >> 2 & 1};
    put_found(&s->found, 0, valid, id, end == FLOAT_INSIDE ? m.id : 0);
    *s->found.steps.lane = k.steps;
    return end;
}

LANES_TARGET static float_ends run_float_approach(float_gjk *s, unsigned lanes) {
    (void)lanes;
    switch (s->blocks) {
    case 1: return end_walk(s, approach(s, 8));
    case 2: return end_walk(s, approach(s, 16));
    case 3: return end_walk(s, approach(s, 24));
    default: return end_walk(s, approach(s, 32));
    }
}
