// The kernels for AVX2.
#if defined(__x86_64__) && defined(__GNUC__)

#include "simd/kernels/sets.h"

#define LANES 4
#include "simd/kernels/small_gjk_lanes.h"

#include "simd/kernels/small_gjk_kept.h"

#include "simd/kernels/areas.h"
#include "simd/kernels/box_axes.h"
#include "simd/kernels/box_separation.h"
#include "simd/kernels/epa8/epa8.h"
#include "simd/kernels/extents.h"
#include "simd/kernels/gauss/plane.h"
#include "simd/kernels/pair8.h"

#include "simd/kernels/group_gjk.h"
#include "simd/kernels/kept8.h"
#include "simd/kernels/move8.h"
#include "simd/kernels/patch.h"
#include "simd/kernels/solid8.h"

LANES_TARGET void areas_compute_avx2(const simd_triangles *triangles, vec3 *areas) { run_areas(triangles, areas); }

LANES_TARGET int box_axes_find_avx2(const box_axes_query *query, box_axes *out) { return run_axes(query, out); }

LANES_TARGET int box_separation_find_avx2(const box_separation_query *query, box_separation *out) {
    return run_separation(query, out);
}

LANES_TARGET uint32_t heights_find_avx2(const simd_planes *planes, const heights_query *query,
                                        const heights_result *out) {
    return run_heights(planes, query, out);
}

LANES_TARGET simd_extents extents_find_avx2(const simd_points *points, const mat3 *rows) {
    return run_extents(points, rows);
}

LANES_TARGET void move8_run_avx2(const move8_places *from, const move8_errors *errors, move8_result *out) {
    run_move(from, errors, out);
}

LANES_TARGET epa8_end epa8_grow_avx2(epa8 *s, const epa8_query *query) { return run_grow(s, query); }

LANES_TARGET int gauss_find_avx2(const gauss_query *query, gauss_plane *out) { return run_gauss(query, out); }

const group_gjk_kernels group_gjk_avx2 = {run_group_begin,   run_group_support, run_group_start,
                                          run_group_advance, run_group_finish,  run_group_measure};
const kept8_kernels kept8_avx2 = {run_compare, run_gaps, run_depths};
const pair8_kernels pair8_avx2 = {run_spheres, run_inner, run_ellipsoids, run_supports, run_floats};
const patch_kernels patch_avx2 = {run_place, run_measure};
const solid8_kernels solid8_avx2 = {run_boxes, run_triangles};

LANES_TARGET void small_gjk_run_avx2(const small_gjk_query *query, small_gjk_result *result) {
    run_class(query, result);
}

LANES_TARGET void small_gjk_run_unposed_avx2(const small_gjk_query *query, small_gjk_result *result) {
    run_unposed_class(query, result);
}

LANES_TARGET void small_gjk_run_kept_avx2(const small_gjk_query *query, const small_gjk_kept *kept,
                                          small_gjk_result *result) {
    run_kept_class(query, kept, result);
}

LANES_TARGET void small_gjk_find_kept_avx2(const small_gjk_query *query, const small_gjk_kept *kept,
                                           small_gjk_result *result) {
    find_kept(query, kept, result);
}

#else
#include "simd/kernels/sets.h"
#endif
