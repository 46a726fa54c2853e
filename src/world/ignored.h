// A set of pairs of indices: open addressing with linear probing, deletion by shifting back (D. E. Knuth, The Art of
// Computer Programming 3, algorithm 6.4 R).
#ifndef OVOID_WORLD_IGNORED_H
#define OVOID_WORLD_IGNORED_H

#include <stddef.h>
#include <stdint.h>

/// A pair of indices as one number, the lower index in the upper half; never all ones.
static inline uint64_t key_make(uint32_t a, uint32_t b) {
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}
static inline uint32_t key_get_a(uint64_t key) { return (uint32_t)(key >> 32); }
static inline uint32_t key_get_b(uint64_t key) { return (uint32_t)key; }

#define IGNORED_NONE UINT64_MAX

/// capacity is a power of two, or 0. The memory is the owner's.
typedef struct ignored {
    uint64_t *keys;
    size_t capacity, count;
} ignored;

int ignored_is_in(const ignored *set, uint64_t key);
/// Adds a key; there must be room: count below half the capacity. 1 if it is new.
int ignored_add(ignored *set, uint64_t key);
/// Removes a key. 1 if it was in the set.
int ignored_remove(ignored *set, uint64_t key);
/// Removes all pairs of a body. Cost: linear in the capacity.
void ignored_remove_body(ignored *set, uint32_t body);

#endif
