// The kernels in single precision that every processor of a build runs: the scalar twins of those in avx2.c and
// avx512.c.
#include "simd/kernels/sets.h"

#define LANES_ARE_FLOATS
#define LANES 1
#include "simd/floats/float_support.h"
#include "simd/kernels/float_ellipsoids.h"
#include "simd/kernels/float_rounds.h"
#include "simd/kernels/float_spheres.h"

const float_gjk_kernels float_gjk_scalar = {
    LANES,          run_float_spheres, run_float_ellipsoids, run_float_append,   run_float_fill,         run_float_load,
    run_float_turn, run_float_find,    run_float_advance,    run_float_approach, run_float_advance_named};
