// The kernels in single precision of one couple: a lane of plain C, with supports over its vertices in AVX2.
#if defined(__x86_64__) && defined(__GNUC__)

#include "simd/kernels/sets.h"

#define LANES_ARE_FLOATS
#define LANES 1
#define FLOAT_ALONE
#define LANES_TARGET __attribute__((target("avx2")))
#define LANES_INLINE LANES_TARGET static inline __attribute__((always_inline))

#include "simd/floats/float_support.h"
#include "simd/kernels/float_alone.h"
#include "simd/kernels/float_ellipsoids.h"
#include "simd/kernels/float_spheres.h"

const float_gjk_kernels float_gjk_alone = {
    LANES,          run_float_spheres, run_float_ellipsoids, run_float_append,   run_float_fill,   run_float_load,
    run_float_turn, run_float_find,    run_float_advance,    run_float_approach, run_float_advance};

#else
#include "simd/kernels/sets.h"
#endif
