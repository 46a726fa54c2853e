// Requirements on the arithmetic: every operation on doubles is rounded to a double, once, in the order written. Proofs
// and equal bits depend on it, so any other build is refused.
#ifndef OVOID_BASE_ARITHMETIC_H
#define OVOID_BASE_ARITHMETIC_H

#include <float.h>

#if FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1
#error "ovoid needs doubles that are rounded at every operation; on 32-bit x86 compile with -msse2 -mfpmath=sse"
#endif

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0)
#error "ovoid does not hold under -ffast-math (-Ofast, -ffinite-math-only): compile without it"
#endif

#if FLT_RADIX != 2 || DBL_MANT_DIG != 53 || DBL_MAX_EXP != 1024
#error "ovoid needs doubles of IEEE 754"
#endif

#endif
