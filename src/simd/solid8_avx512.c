// The kernels of solid8.h for AVX-512.
#if defined(__x86_64__) && defined(__GNUC__)
#define LANES 8
#include "simd/solid8_kernel.h"

const solid8_kernels solid8_avx512 = {run_boxes, run_triangles};
#else
#include "simd/solid8.h"
#endif
