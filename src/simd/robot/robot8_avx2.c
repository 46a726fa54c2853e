// The kernels of robot8.h for AVX2.
#if defined(__x86_64__) && defined(__GNUC__)
#define LANES 4
#include "simd/robot/robot8_kernel.h"

#include "simd/robot/cover8_kernel.h"

const robot8_kernels robot8_avx2 = ROBOT8_KERNELS;
#else
#include "simd/robot/robot8.h"
#endif
