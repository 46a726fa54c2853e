// Radix sort of 64-bit keys by bytes.
#include "world/tree/radix_sort.h"

#include <string.h>

enum { VALUES = 256 };

void radix_sort(uint64_t *keys, uint64_t *scratch, size_t count) {
    uint64_t all = 0, common = UINT64_MAX;
    for (size_t i = 0; i < count; i++) {
        all |= keys[i];
        common &= keys[i];
    }
    uint64_t *from = keys, *to = scratch;
    for (unsigned shift = 0; shift < 64; shift += 8) {
        if (((all ^ common) >> shift & (VALUES - 1)) == 0) continue;
        size_t place[VALUES] = {0}, at = 0;
        for (size_t i = 0; i < count; i++) place[from[i] >> shift & (VALUES - 1)]++;
        for (int v = 0; v < VALUES; v++) {
            size_t here = place[v];
            place[v] = at;
            at += here;
        }
        for (size_t i = 0; i < count; i++) to[place[from[i] >> shift & (VALUES - 1)]++] = from[i];
        uint64_t *swapped = from;
        from = to;
        to = swapped;
    }
    if (from != keys) memcpy(keys, from, count * sizeof *keys);
}
