// The kernels that every processor of a build runs: the scalar twins of those in avx2.c and avx512.c.
#include "simd/kernels/sets.h"

#include "simd/kernels/baseline_lanes.h"
#include "simd/kernels/small_gjk_scalar.h"

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

const uint8_t box_axes_first[BOX_AXES] = {0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 3, 3, 4, 4};
const uint8_t box_axes_second[BOX_AXES] = {1, 2, 3, 4, 5, 2, 3, 4, 5, 3, 4, 5, 4, 5, 5, 5};

void areas_compute_scalar(const simd_triangles *triangles, vec3 *areas) { run_areas(triangles, areas); }

int box_axes_find_scalar(const box_axes_query *query, box_axes *out) { return run_axes(query, out); }

int box_separation_find_scalar(const box_separation_query *query, box_separation *out) {
    return run_separation(query, out);
}

uint32_t heights_find_scalar(const simd_planes *planes, const heights_query *query, const heights_result *out) {
    return run_heights(planes, query, out);
}

simd_extents extents_find_scalar(const simd_points *points, const mat3 *rows) { return run_extents(points, rows); }

void move8_run_scalar(const move8_places *from, const move8_errors *errors, move8_result *out) {
    run_move(from, errors, out);
}

epa8_end epa8_grow_scalar(epa8 *s, const epa8_query *query) { return run_grow(s, query); }

int gauss_find_scalar(const gauss_query *query, gauss_plane *out) { return run_gauss(query, out); }

const group_gjk_kernels group_gjk_scalar = {run_group_begin,   run_group_support, run_group_start,
                                            run_group_advance, run_group_finish,  run_group_measure};
const kept8_kernels kept8_scalar = {run_compare, run_gaps, run_depths};
const pair8_kernels pair8_scalar = {run_spheres, run_inner, run_ellipsoids, run_supports, run_floats};
const patch_kernels patch_scalar = {run_place, run_measure};
const solid8_kernels solid8_scalar = {run_boxes, run_triangles};

void small_gjk_run_scalar(const small_gjk_query *query, small_gjk_result *result) { run_class(query, result); }

void small_gjk_run_unposed_scalar(const small_gjk_query *query, small_gjk_result *result) {
    run_unposed_class(query, result);
}

void small_gjk_run_kept_scalar(const small_gjk_query *query, const small_gjk_kept *kept, small_gjk_result *result) {
    run_kept_class(query, kept, result);
}

void small_gjk_find_kept_scalar(const small_gjk_query *query, const small_gjk_kept *kept, small_gjk_result *result) {
    find_kept(query, kept, result);
}
