// The kernel of box_axes.h for AVX-512.
#if defined(__x86_64__) && defined(__GNUC__)
#define LANES 8
#include "simd/box_axes_kernel.h"

LANES_TARGET int box_axes_find_avx512(const box_axes_query *query, box_axes *out) { return run_axes(query, out); }
#else
#include "simd/box_axes.h"
#endif
