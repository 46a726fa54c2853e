// Hash tables with open addressing and linear probing (D. E. Knuth, The Art of Computer Programming 3, 6.4). The caller
// owns the slots, a power of two of them, of which at least one is free; if half of them are free, searches are short.
// The content of a slot is known only to the caller's test: an index, a key. The search is inlined into its caller, and
// the test with it.
#ifndef OVOID_TOOLS_HASH_H
#define OVOID_TOOLS_HASH_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/// 1 if the slot of the table is free, or holds the key.
typedef int hash_test(const void *table, size_t slot, const void *key);

/// The slot that holds the key, or the free one where it belongs.
static inline __attribute__((always_inline)) size_t hash_find(uint64_t hash, size_t slots, const void *table,
                                                              const void *key, hash_test *is_end) {
    size_t at = (size_t)hash & (slots - 1);
    while (!is_end(table, at, key)) at = (at + 1) & (slots - 1);
    return at;
}

/// The hash of a number: multiplication by the golden ratio, upper bits.
static inline uint64_t hash_number(uint64_t key) { return (key ^ key >> 29) * 0x9e3779b97f4a7c15u >> 20; }

/// The hash of a pair of numbers, in that order.
static inline uint64_t hash_pair(uint32_t a, uint32_t b) { return hash_number((uint64_t)a << 32 | b); }

/// The hash of a point; -0 counts as 0. Three products, none of which waits for another.
static inline uint64_t hash_point(const double point[3]) {
    static const uint64_t factors[3] = {0x9e3779b97f4a7c15u, 0xbf58476d1ce4e5b9u, 0x94d049bb133111ebu};
    uint64_t hash = 0;
    for (int k = 0; k < 3; k++) {
        double v = point[k] + 0.0;
        uint64_t bits;
        memcpy(&bits, &v, sizeof bits);
        hash ^= (bits ^ bits >> 32) * factors[k];
    }
    return (hash ^ hash >> 29) * factors[0] >> 32;
}

/// 1 if both points have the same three coordinates; 0 and -0 are equal.
static inline int hash_is_same_point(const double *a, const double *b) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

#endif
