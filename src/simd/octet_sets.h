// The kernels of the vector instruction sets, each compiled in a file of its own.
#ifndef OVOID_SIMD_OCTET_SETS_H
#define OVOID_SIMD_OCTET_SETS_H

#include "simd/octet.h"

extern const octet_kernels octet_avx2, octet_avx512;

#endif
