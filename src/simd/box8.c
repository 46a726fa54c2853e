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

// Lanes that overlap: leaves are written, nodes wait, the last one first.
static inline uint32_t sort_lanes(box8_walk *w, const box8 *n, unsigned lanes, uint32_t *leaves) {
    uint32_t found = 0;
    for (unsigned rest = lanes & n->leaves; rest; rest &= rest - 1)
        leaves[found++] = n->child[compiler_count_low_zeros(rest)];
    for (unsigned rest = lanes & ~n->leaves; rest; rest &= rest - 1)
        w->stack[w->count++] = n->child[compiler_count_low_zeros(rest)];
    return found;
}

static uint32_t find_leaves_scalar(box8_walk *w, uint32_t *leaves, uint32_t room) {
    uint32_t found = 0;
    while (w->count && found + BOX8 <= room) {
        const box8 *n = &w->nodes[w->stack[--w->count]];
        unsigned lanes = 0;
        for (unsigned i = 0; i < BOX8; i++) {
            unsigned overlaps = (n->low[0][i] <= w->high[0]) & (w->low[0] <= n->high[0][i]) &
                                (n->low[1][i] <= w->high[1]) & (w->low[1] <= n->high[1][i]) &
                                (n->low[2][i] <= w->high[2]) & (w->low[2] <= n->high[2][i]);
            lanes |= overlaps << i;
        }
        found += sort_lanes(w, n, lanes, leaves + found);
    }
    return found;
}

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#define AVX2 __attribute__((target("avx2")))

AVX2 static inline __m256 along(const box8 *n, int k, __m256 low, __m256 high) {
    return _mm256_and_ps(_mm256_cmp_ps(_mm256_load_ps(n->low[k]), high, _CMP_LE_OQ),
                         _mm256_cmp_ps(low, _mm256_load_ps(n->high[k]), _CMP_LE_OQ));
}

AVX2 static uint32_t find_leaves_avx2(box8_walk *w, uint32_t *leaves, uint32_t room) {
    __m256 low[3], high[3];
    uint32_t found = 0;
    for (int k = 0; k < 3; k++) {
        low[k] = _mm256_set1_ps(w->low[k]);
        high[k] = _mm256_set1_ps(w->high[k]);
    }
    while (w->count && found + BOX8 <= room) {
        const box8 *n = &w->nodes[w->stack[--w->count]];
        __m256 all = _mm256_and_ps(_mm256_and_ps(along(n, 0, low[0], high[0]), along(n, 1, low[1], high[1])),
                                   along(n, 2, low[2], high[2]));
        found += sort_lanes(w, n, (unsigned)_mm256_movemask_ps(all), leaves + found);
    }
    return found;
}

box8_function *box8_get(simd_isa isa) {
    if (isa == SIMD_SCALAR) return find_leaves_scalar;
    return isa == SIMD_AVX2 && __builtin_cpu_supports("avx2") ? find_leaves_avx2 : NULL;
}

uint32_t box8_find_leaves(box8_walk *w, uint32_t *leaves, uint32_t room) {
    if (__builtin_cpu_supports("avx2")) return find_leaves_avx2(w, leaves, room);
    return find_leaves_scalar(w, leaves, room);
}

#else

box8_function *box8_get(simd_isa isa) { return isa == SIMD_SCALAR ? find_leaves_scalar : NULL; }

uint32_t box8_find_leaves(box8_walk *w, uint32_t *leaves, uint32_t room) { return find_leaves_scalar(w, leaves, room); }

#endif
