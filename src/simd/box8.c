#include "simd/box8.h"

#include "base/compiler.h"

#include <stddef.h>

void box8_begin(box8_walk *w, const box8 *nodes, const double *ends) {
    w->nodes = nodes;
    for (int k = 0; k < 3; k++) {
        w->low[k] = box8_round_down(ends[k]);
        w->high[k] = box8_round_up(ends[3 + k]);
    }
    w->count = 1;
    w->stack[0] = 0;
}

// An end of a node's box is off by less than 2^-21 |x| + 2^-138, so an end of the other box that is moved inward by
// twice that compares with it only where the ends themselves do: x - (2^-21 |x| + 2^-138) grows with x. Ends beyond
// 2^120 are near those that a node cuts off; a box with such an end counts as empty.
static float move_inward(double x) { return box8_round_down(x - (fabs(x) * 0x1p-20 + 0x1p-137)); }

void box8_begin_new(box8_walk *w, const box8 *nodes, const double *ends, const double *seen) {
    int is_plain = 1;
    for (int k = 0; k < 6; k++) is_plain &= fabs(seen[k]) < 0x1p120;
    box8_begin(w, nodes, ends);
    for (int k = 0; k < 3; k++) {
        w->seen_low[k] = is_plain ? -move_inward(-seen[k]) : INFINITY;
        w->seen_high[k] = is_plain ? move_inward(seen[3 + k]) : -INFINITY;
    }
}

// Lanes that overlap: leaves are written, nodes wait, the last one first.
static inline uint32_t sort_lanes(box8_walk *w, const box8 *n, unsigned lanes, uint32_t *leaves) {
    uint32_t found = 0;
    for (unsigned rest = lanes & n->leaves; rest; rest &= rest - 1)
        leaves[found++] = n->child[compiler_count_low_zeros(rest)];
    for (unsigned rest = lanes & ~n->leaves; rest; rest &= rest - 1)
        w->stack[w->count++] = n->child[compiler_count_low_zeros(rest)];
    return found;
}

static inline unsigned overlap_scalar(const box8 *n, const float low[3], const float high[3]) {
    unsigned lanes = 0;
    for (unsigned i = 0; i < BOX8; i++) {
        unsigned overlaps = (n->low[0][i] <= high[0]) & (low[0] <= n->high[0][i]) & (n->low[1][i] <= high[1]) &
                            (low[1] <= n->high[1][i]) & (n->low[2][i] <= high[2]) & (low[2] <= n->high[2][i]);
        lanes |= overlaps << i;
    }
    return lanes;
}

static inline uint32_t walk_scalar(box8_walk *w, uint32_t *leaves, uint32_t room, int only_new) {
    uint32_t found = 0;
    while (w->count && found + BOX8 <= room) {
        const box8 *n = &w->nodes[w->stack[--w->count]];
        unsigned lanes = overlap_scalar(n, w->low, w->high), known = n->leaves & ~n->fresh;
        if (only_new && lanes & known) lanes &= ~(known & overlap_scalar(n, w->seen_low, w->seen_high));
        found += sort_lanes(w, n, lanes, leaves + found);
    }
    return found;
}

static uint32_t find_leaves_scalar(box8_walk *w, uint32_t *leaves, uint32_t room) {
    return walk_scalar(w, leaves, room, 0);
}
static uint32_t find_new_leaves_scalar(box8_walk *w, uint32_t *leaves, uint32_t room) {
    return walk_scalar(w, leaves, room, 1);
}

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#define AVX2 __attribute__((target("avx2")))

// The ends of a box, each in all lanes.
typedef struct ends8 {
    __m256 low[3], high[3];
} ends8;

AVX2 static inline ends8 spread(const float low[3], const float high[3]) {
    return (ends8){{_mm256_set1_ps(low[0]), _mm256_set1_ps(low[1]), _mm256_set1_ps(low[2])},
                   {_mm256_set1_ps(high[0]), _mm256_set1_ps(high[1]), _mm256_set1_ps(high[2])}};
}

AVX2 static inline __m256 along(const box8 *n, int k, const ends8 *b) {
    return _mm256_and_ps(_mm256_cmp_ps(_mm256_load_ps(n->low[k]), b->high[k], _CMP_LE_OQ),
                         _mm256_cmp_ps(b->low[k], _mm256_load_ps(n->high[k]), _CMP_LE_OQ));
}

AVX2 static inline unsigned overlap(const box8 *n, const ends8 *b) {
    return (unsigned)_mm256_movemask_ps(_mm256_and_ps(_mm256_and_ps(along(n, 0, b), along(n, 1, b)), along(n, 2, b)));
}

AVX2 static inline uint32_t walk_avx2(box8_walk *w, uint32_t *leaves, uint32_t room, int only_new) {
    ends8 wanted = spread(w->low, w->high), seen = only_new ? spread(w->seen_low, w->seen_high) : wanted;
    uint32_t found = 0;
    while (w->count && found + BOX8 <= room) {
        const box8 *n = &w->nodes[w->stack[--w->count]];
        unsigned lanes = overlap(n, &wanted), known = n->leaves & ~n->fresh;
        if (only_new && lanes & known) lanes &= ~(known & overlap(n, &seen));
        found += sort_lanes(w, n, lanes, leaves + found);
    }
    return found;
}

AVX2 static uint32_t find_leaves_avx2(box8_walk *w, uint32_t *leaves, uint32_t room) {
    return walk_avx2(w, leaves, room, 0);
}
AVX2 static uint32_t find_new_leaves_avx2(box8_walk *w, uint32_t *leaves, uint32_t room) {
    return walk_avx2(w, leaves, room, 1);
}

box8_function *box8_get(simd_isa isa) {
    if (isa == SIMD_SCALAR) return find_leaves_scalar;
    return isa == SIMD_AVX2 && __builtin_cpu_supports("avx2") ? find_leaves_avx2 : NULL;
}
box8_function *box8_get_new(simd_isa isa) {
    if (isa == SIMD_SCALAR) return find_new_leaves_scalar;
    return isa == SIMD_AVX2 && __builtin_cpu_supports("avx2") ? find_new_leaves_avx2 : NULL;
}

uint32_t box8_find_leaves(box8_walk *w, uint32_t *leaves, uint32_t room) {
    if (__builtin_cpu_supports("avx2")) return find_leaves_avx2(w, leaves, room);
    return find_leaves_scalar(w, leaves, room);
}
uint32_t box8_find_new_leaves(box8_walk *w, uint32_t *leaves, uint32_t room) {
    if (__builtin_cpu_supports("avx2")) return find_new_leaves_avx2(w, leaves, room);
    return find_new_leaves_scalar(w, leaves, room);
}

#else

box8_function *box8_get(simd_isa isa) { return isa == SIMD_SCALAR ? find_leaves_scalar : NULL; }
box8_function *box8_get_new(simd_isa isa) { return isa == SIMD_SCALAR ? find_new_leaves_scalar : NULL; }

uint32_t box8_find_leaves(box8_walk *w, uint32_t *leaves, uint32_t room) { return find_leaves_scalar(w, leaves, room); }
uint32_t box8_find_new_leaves(box8_walk *w, uint32_t *leaves, uint32_t room) {
    return find_new_leaves_scalar(w, leaves, room);
}

#endif
