// The kernels of pair8.h for AVX2.
#if defined(__x86_64__) && defined(__GNUC__)
#define LANES 4
#include "simd/pair8_kernel.h"

const pair8_kernels pair8_avx2 = {run_spheres, run_ellipsoids, run_supports};
#else
#include "simd/pair8.h"
#endif
