// Values from the bytes of a fuzz input, zeros when they are used up.
#ifndef OVOID_FUZZ_TAKE_H
#define OVOID_FUZZ_TAKE_H

#include "fuzz.h"

#include <math.h>

/// The bytes that are left.
typedef struct fuzz_bytes {
    const uint8_t *data;
    size_t size;
} fuzz_bytes;

static inline int take_byte(fuzz_bytes *from) {
    if (!from->size) return 0;
    from->size--;
    return (int8_t)*from->data++;
}

static inline void take_raw(fuzz_bytes *from, void *to, size_t size) {
    for (size_t i = 0; i < size; i++) ((uint8_t *)to)[i] = (uint8_t)take_byte(from);
}

/// Any double whatever, or, so that equal and simple ones are met, a small whole number times a power of two. The first
/// byte says which.
static inline double take_double(fuzz_bytes *from) {
    int how = take_byte(from);
    double value;
    if (how == 127) {
        take_raw(from, &value, sizeof value);
        return value;
    }
    if (how > 100) {
        int16_t digits = 0;
        take_raw(from, &digits, sizeof digits);
        return ldexp(digits, take_byte(from));
    }
    int eighths = how / 8;
    return eighths;
}

#endif
