// The checksum of files, by words: every step is a bijection, so that it detects every single wrong byte or word. The
// same on all machines.
#ifndef OVOID_TOOLS_CHECKSUM_H
#define OVOID_TOOLS_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

/// Eight bytes as a word, the first one the lowest.
static inline uint64_t checksum_load_word(const uint8_t *b) {
    uint64_t low = b[0] | (uint64_t)b[1] << 8 | (uint64_t)b[2] << 16 | (uint64_t)b[3] << 24;
    uint64_t high = b[4] | (uint64_t)b[5] << 8 | (uint64_t)b[6] << 16 | (uint64_t)b[7] << 24;
    return low | high << 32;
}

/// A bijection of the sum for any word, and of the word for any sum: a product with an odd number, and a shift that
/// brings high bits down.
static inline uint64_t checksum_mix(uint64_t sum, uint64_t word) {
    uint64_t product = (sum ^ word) * 0x9e3779b97f4a7c15u;
    return product ^ product >> 32;
}

/// The checksum of bytes. The words in turn go to four sums, which do not wait for each other. size: a multiple of 8.
static inline uint64_t checksum_words(const void *from, size_t size) {
    const uint8_t *begin = from;
    uint64_t sum[4] = {1, 2, 3, 4};
    size_t i = 0;
    for (; i + 32 <= size; i += 32)
        for (size_t k = 0; k < 4; k++) sum[k] = checksum_mix(sum[k], checksum_load_word(begin + i + 8 * k));
    for (size_t k = 0; i < size; i += 8, k++) sum[k] = checksum_mix(sum[k], checksum_load_word(begin + i));
    uint64_t all = 0;
    for (size_t k = 0; k < 4; k++) all = checksum_mix(all, sum[k]);
    return all;
}

/// The checksum of any number of bytes: of its words, the rest filled with zeros, and the number of bytes.
static inline uint64_t checksum_bytes(const void *from, size_t size) {
    size_t whole = size / 8 * 8;
    uint8_t rest[16] = {0};
    for (size_t i = whole; i < size; i++) rest[i - whole] = ((const uint8_t *)from)[i];
    for (size_t i = 0; i < 8; i++) rest[8 + i] = (uint8_t)((uint64_t)size >> 8 * i);
    return checksum_mix(checksum_words(from, whole), checksum_words(rest, sizeof rest));
}

#endif
