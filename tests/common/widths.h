// A check that is run with each vector width of this machine, as what the compiler's runtime knows of the processor is
// made less.
#ifndef OVOID_TESTS_WIDTHS_H
#define OVOID_TESTS_WIDTHS_H

#if defined(__x86_64__)
extern struct cpu_model { unsigned vendor, type, subtype, features[1]; } __cpu_model;

/// With the narrower ones: AVX2, then plain C.
static inline void widths_run_narrower(void (*check)(void)) {
    enum { AVX2 = 10, AVX512F = 15 };
    unsigned all = __cpu_model.features[0];
    __cpu_model.features[0] = all & ~(1u << AVX512F);
    check();
    __cpu_model.features[0] = all & ~(1u << AVX512F | 1u << AVX2);
    check();
    __cpu_model.features[0] = all;
}
#else
static inline void widths_run_narrower(void (*check)(void)) { (void)check; }
#endif

#endif
