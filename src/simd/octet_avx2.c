// The kernels of octet.h for AVX2.
#if defined(__x86_64__) && defined(__GNUC__)
#define LANES 4
#include "simd/octet_kernel.h"

#include "simd/octet_sets.h"

const octet_kernels octet_avx2 = {place, part, meet};
#else
#include "simd/octet_sets.h"
#endif
