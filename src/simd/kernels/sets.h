// The kernels of each instruction set: scalar.c, avx2.c and avx512.c compile all of kernels/ once each, those in
// single precision floats/scalar.c and its sisters, and kernels.c chooses among them.
#ifndef OVOID_SIMD_KERNELS_SETS_H
#define OVOID_SIMD_KERNELS_SETS_H

#include "simd/areas.h"
#include "simd/box_axes.h"
#include "simd/epa8.h"
#include "simd/float_gjk.h"
#include "simd/gauss.h"
#include "simd/group_gjk.h"
#include "simd/kept8.h"
#include "simd/move8.h"
#include "simd/patch.h"
#include "simd/solid8.h"

areas_function areas_compute_scalar, areas_compute_avx2;
box_separation_function box_separation_find_scalar, box_separation_find_avx2;
box_axes_function box_axes_find_scalar, box_axes_find_avx2, box_axes_find_avx512;
epa8_function epa8_grow_scalar, epa8_grow_avx2, epa8_grow_avx512;
simd_extents_function extents_find_scalar, extents_find_avx2, extents_find_avx512;
extern const float_gjk_kernels float_gjk_scalar, float_gjk_avx2, float_gjk_avx512, float_gjk_alone;
gauss_function gauss_find_scalar, gauss_find_avx2, gauss_find_avx512;
extern const group_gjk_kernels group_gjk_scalar, group_gjk_avx2, group_gjk_avx512;
heights_function heights_find_scalar, heights_find_avx2;
extern const kept8_kernels kept8_scalar, kept8_avx2, kept8_avx512;
move8_function move8_run_scalar, move8_run_avx2, move8_run_avx512;
extern const pair8_kernels pair8_scalar, pair8_avx2, pair8_avx512;
extern const patch_kernels patch_scalar, patch_avx2;
extern const solid8_kernels solid8_scalar, solid8_avx2, solid8_avx512;
small_gjk_function small_gjk_run_scalar, small_gjk_run_avx2, small_gjk_run_avx512;
small_gjk_function small_gjk_run_unposed_scalar, small_gjk_run_unposed_avx2;
small_gjk_kept_function small_gjk_run_kept_scalar, small_gjk_run_kept_avx2, small_gjk_run_kept_avx512;
small_gjk_kept_function small_gjk_find_kept_scalar, small_gjk_find_kept_avx2;

#endif
