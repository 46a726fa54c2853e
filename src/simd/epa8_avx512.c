// The kernel of epa8.h for AVX-512.
#if defined(__x86_64__) && defined(__GNUC__)
#define LANES 8
#include "simd/epa8_kernel.h"

LANES_TARGET epa8_end epa8_grow_avx512(epa8 *s, const epa8_query *query) { return run_grow(s, query); }
#else
#include "simd/epa8.h"
#endif
