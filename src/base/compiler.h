// Extensions of gcc and clang for what standard C cannot express. They are used only here, in simd, and for the
// floating-point environment.
#ifndef OVOID_BASE_COMPILER_H
#define OVOID_BASE_COMPILER_H

#include <stdint.h>

#if !defined(__GNUC__)
#error "ovoid is compiled by gcc or clang; its headers serve any compiler of C17 or C++17"
#endif

/// A function that is called, not inlined: its part of the stack is free when it returns.
#define COMPILER_NOINLINE __attribute__((noinline))

/// A function that is inlined into every caller: its constant arguments are constants there, and functions among them
/// are inlined too.
#define COMPILER_INLINED static inline __attribute__((always_inline))

/// A function whose argument number `format_at` is that of printf, for those from `first` on. (mingw has two printfs;
/// ours is C's.)
#if defined(__MINGW32__)
#define COMPILER_PRINTF(format_at, first) __attribute__((format(gnu_printf, format_at, first)))
#else
#define COMPILER_PRINTF(format_at, first) __attribute__((format(printf, format_at, first)))
#endif

/// The number of zeros below the lowest one; the number above the highest. bits is not 0.
static inline unsigned compiler_count_low_zeros(uint32_t bits) { return (unsigned)__builtin_ctz(bits); }
static inline unsigned compiler_count_low_zeros_64(uint64_t bits) { return (unsigned)__builtin_ctzll(bits); }
static inline unsigned compiler_count_high_zeros(uint32_t bits) { return (unsigned)__builtin_clz(bits); }

/// Prefetches the memory at an address. The empty asm statement keeps it: gcc 12 takes a function that only prefetches
/// for one without effects, and removes the calls of it.
static inline void compiler_prefetch(const void *at) {
    __builtin_prefetch(at);
    __asm__ volatile("");
}

/// What lies at an address and is needed after this is read from there again, not kept in registers.
static inline void compiler_forget(const void *at) { __asm__ volatile("" : : "r"(at) : "memory"); }

#endif
