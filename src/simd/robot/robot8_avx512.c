// The kernels of robot8.h for AVX-512.
#if defined(__x86_64__) && defined(__GNUC__)
#define LANES 8
#include "simd/robot/robot8_kernel.h"

#include "simd/robot/cover8_kernel.h"

const robot8_kernels robot8_avx512 = ROBOT8_KERNELS;
#else
#include "simd/robot/robot8.h"
#endif
