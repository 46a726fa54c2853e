// The kernels of gjk8.h for AVX-512.
#if defined(__x86_64__) && defined(__GNUC__)
#include "simd/small_gjk_avx2.h"

#define LANES 8
#include "simd/gjk8_kernel.h"

const gjk8_kernels gjk8_avx512 = {run_begin, run_advance};
#else
#include "simd/gjk8.h"
#endif
