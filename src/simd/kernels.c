// The choice of a kernel, by the widest instruction set that this machine and this build have. All give the same bits.
#include "simd/kernels/sets.h"

#include <stddef.h>

#if defined(__x86_64__) && defined(__GNUC__)
// The set that is used: AVX-512 and AVX2 are told apart by one test each of a word that the C library's start has
// filled.
static inline simd_isa find_widest(void) {
    if (__builtin_cpu_supports("avx512f")) return SIMD_AVX512;
    return __builtin_cpu_supports("avx2") ? SIMD_AVX2 : SIMD_SCALAR;
}
static int has(simd_isa isa) {
    if (isa == SIMD_AVX512) return __builtin_cpu_supports("avx512f") != 0;
    return isa == SIMD_SCALAR || (isa == SIMD_AVX2 && __builtin_cpu_supports("avx2"));
}
#define KERNELS(scalar, avx2, avx512)                                                                                  \
    { [SIMD_SCALAR] = (scalar), [SIMD_AVX2] = (avx2), [SIMD_AVX512] = (avx512) }
#else
static inline simd_isa find_widest(void) { return SIMD_SCALAR; }
static int has(simd_isa isa) { return isa == SIMD_SCALAR; }
#define KERNELS(scalar, avx2, avx512)                                                                                  \
    { [SIMD_SCALAR] = (scalar) }
#endif

// One row for each kernel.
static areas_function *const areas_of[SIMD_ISA_COUNT] =
    KERNELS(areas_compute_scalar, areas_compute_avx2, areas_compute_avx2);
static box_axes_function *const box_axes_of[SIMD_ISA_COUNT] =
    KERNELS(box_axes_find_scalar, box_axes_find_avx2, box_axes_find_avx512);
static box_separation_function *const box_separation_of[SIMD_ISA_COUNT] =
    KERNELS(box_separation_find_scalar, box_separation_find_avx2, box_separation_find_avx2);
static epa8_function *const epa8_of[SIMD_ISA_COUNT] = KERNELS(epa8_grow_scalar, epa8_grow_avx2, epa8_grow_avx512);
static simd_extents_function *const extents_of[SIMD_ISA_COUNT] =
    KERNELS(extents_find_scalar, extents_find_avx2, extents_find_avx512);
static const float_gjk_kernels *const float_gjk_of[SIMD_ISA_COUNT] =
    KERNELS(&float_gjk_scalar, &float_gjk_avx2, &float_gjk_avx512);
static const float_gjk_kernels *const float_gjk_alone_of[SIMD_ISA_COUNT] =
    KERNELS(&float_gjk_scalar, &float_gjk_alone, &float_gjk_alone);
static gauss_function *const gauss_of[SIMD_ISA_COUNT] = KERNELS(gauss_find_scalar, gauss_find_avx2, gauss_find_avx512);
static const group_gjk_kernels *const group_gjk_of[SIMD_ISA_COUNT] =
    KERNELS(&group_gjk_scalar, &group_gjk_avx2, &group_gjk_avx512);
static heights_function *const heights_of[SIMD_ISA_COUNT] =
    KERNELS(heights_find_scalar, heights_find_avx2, heights_find_avx2);
static const kept8_kernels *const kept8_of[SIMD_ISA_COUNT] = KERNELS(&kept8_scalar, &kept8_avx2, &kept8_avx512);
static move8_function *const move8_of[SIMD_ISA_COUNT] = KERNELS(move8_run_scalar, move8_run_avx2, move8_run_avx512);
static const pair8_kernels *const pair8_of[SIMD_ISA_COUNT] = KERNELS(&pair8_scalar, &pair8_avx2, &pair8_avx512);
static const patch_kernels *const patch_of[SIMD_ISA_COUNT] = KERNELS(&patch_scalar, &patch_avx2, &patch_avx2);
static const solid8_kernels *const solid8_of[SIMD_ISA_COUNT] = KERNELS(&solid8_scalar, &solid8_avx2, &solid8_avx512);
static small_gjk_function *const small_gjk_of[SIMD_ISA_COUNT] =
    KERNELS(small_gjk_run_scalar, small_gjk_run_avx2, small_gjk_run_avx512);
static small_gjk_function *const small_gjk_unposed_of[SIMD_ISA_COUNT] =
    KERNELS(small_gjk_run_unposed_scalar, small_gjk_run_unposed_avx2, small_gjk_run_unposed_avx2);
static small_gjk_kept_function *const small_gjk_kept_of[SIMD_ISA_COUNT] =
    KERNELS(small_gjk_run_kept_scalar, small_gjk_run_kept_avx2, small_gjk_run_kept_avx512);
static small_gjk_kept_function *const find_kept_of[SIMD_ISA_COUNT] =
    KERNELS(small_gjk_find_kept_scalar, small_gjk_find_kept_avx2, small_gjk_find_kept_avx2);

// The set for a lane group of so many pairs, the narrowest that holds them: of wide vectors most lanes would be idle.
static inline simd_isa find_isa_of(size_t pairs) {
    simd_isa widest = find_widest();
    return widest == SIMD_AVX512 && pairs <= 4 ? SIMD_AVX2 : widest;
}

// The kernels of the widest instruction set of this machine.
void areas_compute(const simd_triangles *triangles, vec3 *areas) { areas_of[find_widest()](triangles, areas); }
int box_axes_find(const box_axes_query *query, box_axes *out) { return box_axes_of[find_widest()](query, out); }
int box_separation_find(const box_separation_query *query, box_separation *out) {
    return box_separation_of[find_widest()](query, out);
}
epa8_end epa8_grow(epa8 *s, const epa8_query *query) { return epa8_of[find_widest()](s, query); }
int gauss_find_plane(const gauss_query *query, gauss_plane *out) { return gauss_of[find_widest()](query, out); }
simd_extents simd_find_extents(const simd_points *points, const mat3 *rows) {
    return extents_of[find_widest()](points, rows);
}
// Of sixteen lanes most would be idle for few couples.
const float_gjk_kernels *float_gjk_get_kernels(size_t couples) {
    simd_isa widest = find_widest();
    if (couples == 1) return float_gjk_alone_of[widest];
    return float_gjk_of[couples <= 8 && widest > SIMD_AVX2 ? SIMD_AVX2 : widest];
}
const group_gjk_kernels *group_gjk_get_kernels(size_t pairs) { return group_gjk_of[find_isa_of(pairs)]; }
uint32_t heights_find(const simd_planes *planes, const heights_query *query, const heights_result *out) {
    return heights_of[find_widest()](planes, query, out);
}
const kept8_kernels *kept8_get_kernels(size_t pairs) { return kept8_of[find_isa_of(pairs)]; }
move8_function *move8_get(size_t bodies) { return move8_of[find_isa_of(bodies)]; }
const pair8_kernels *pair8_get_kernels(size_t pairs) { return pair8_of[find_isa_of(pairs)]; }
const patch_kernels *patch_get_kernels(void) { return patch_of[find_widest()]; }
const solid8_kernels *solid8_get_kernels(void) { return solid8_of[find_widest()]; }
// Up to 32 points four lanes are as quick as eight, and quicker where they are few.
static inline simd_isa find_small_gjk(const small_gjk_query *q) {
    simd_isa widest = find_widest();
    int is_few = (q->a.padded_count <= 32) & (q->b.padded_count <= 32);
    return is_few && widest > SIMD_AVX2 ? SIMD_AVX2 : widest;
}
void simd_run_small_gjk(const small_gjk_query *query, small_gjk_result *result) {
    small_gjk_of[find_small_gjk(query)](query, result);
}
void simd_run_small_gjk_unposed(const small_gjk_query *query, small_gjk_result *result) {
    small_gjk_unposed_of[find_widest()](query, result);
}
void simd_run_small_gjk_kept(const small_gjk_query *query, const small_gjk_kept *kept, small_gjk_result *result) {
    small_gjk_kept_of[find_small_gjk(query)](query, kept, result);
}
void simd_find_kept(const small_gjk_query *query, const small_gjk_kept *kept, small_gjk_result *result) {
    find_kept_of[find_widest()](query, kept, result);
}

// The kernels of one instruction set, for tests: NULL where this machine or build lacks it.
areas_function *areas_get(simd_isa isa) { return has(isa) ? areas_of[isa] : NULL; }
box_separation_function *box_separation_get(simd_isa isa) { return has(isa) ? box_separation_of[isa] : NULL; }
box_axes_function *box_axes_get(simd_isa isa) { return has(isa) ? box_axes_of[isa] : NULL; }
epa8_function *epa8_get(simd_isa isa) { return has(isa) ? epa8_of[isa] : NULL; }
gauss_function *gauss_get(simd_isa isa) { return has(isa) ? gauss_of[isa] : NULL; }
simd_extents_function *simd_get_extents(simd_isa isa) { return has(isa) ? extents_of[isa] : NULL; }
const float_gjk_kernels *float_gjk_get_kernels_of(simd_isa isa) { return has(isa) ? float_gjk_of[isa] : NULL; }
const group_gjk_kernels *group_gjk_get_kernels_of(simd_isa isa) { return has(isa) ? group_gjk_of[isa] : NULL; }
heights_function *heights_get(simd_isa isa) { return has(isa) ? heights_of[isa] : NULL; }
const kept8_kernels *kept8_get_kernels_of(simd_isa isa) { return has(isa) ? kept8_of[isa] : NULL; }
move8_function *move8_get_of(simd_isa isa) { return has(isa) ? move8_of[isa] : NULL; }
const pair8_kernels *pair8_get_kernels_of(simd_isa isa) { return has(isa) ? pair8_of[isa] : NULL; }
const patch_kernels *patch_get_kernels_of(simd_isa isa) { return has(isa) ? patch_of[isa] : NULL; }
const solid8_kernels *solid8_get_kernels_of(simd_isa isa) { return has(isa) ? solid8_of[isa] : NULL; }
small_gjk_function *simd_get_small_gjk(simd_isa isa) { return has(isa) ? small_gjk_of[isa] : NULL; }
small_gjk_function *simd_get_small_gjk_unposed(simd_isa isa) { return has(isa) ? small_gjk_unposed_of[isa] : NULL; }
small_gjk_kept_function *simd_get_small_gjk_kept(simd_isa isa) { return has(isa) ? small_gjk_kept_of[isa] : NULL; }
small_gjk_kept_function *simd_get_find_kept(simd_isa isa) { return has(isa) ? find_kept_of[isa] : NULL; }
