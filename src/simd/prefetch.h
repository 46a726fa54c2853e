// A hint that memory will be read soon. Any address is safe.
#ifndef OVOID_SIMD_PREFETCH_H
#define OVOID_SIMD_PREFETCH_H

#if defined(__GNUC__)
static inline void simd_prefetch(const void *at) { __builtin_prefetch(at); }
#else
static inline void simd_prefetch(const void *at) { (void)at; }
#endif

#endif
