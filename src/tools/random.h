// Random numbers, the same on every machine: SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, Fast splittable
// pseudorandom number generators, 2014).
#ifndef OVOID_TOOLS_RANDOM_H
#define OVOID_TOOLS_RANDOM_H

#include <stdint.h>

static inline uint64_t random_next(uint64_t *state) {
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/// Uniform in [0, 1).
static inline double random_share(uint64_t *state) { return (double)(random_next(state) >> 11) * 0x1p-53; }

/// Uniform in [low, high).
static inline double random_uniform(uint64_t *state, double low, double high) {
    return low + (high - low) * random_share(state);
}

#endif
