// The kernels of solid8.h for AVX2.
#if defined(__x86_64__) && defined(__GNUC__)
#define LANES 4
#include "simd/solid8_kernel.h"

const solid8_kernels solid8_avx2 = {run_boxes, run_triangles};
#else
#include "simd/solid8.h"
#endif
