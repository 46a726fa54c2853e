// The real hulls that some trials use: 3378 point clouds of a game, in a file that is not part of the project. Records
// of a 32-bit little-endian count n and n times three 32-bit floats.
#ifndef OVOID_TRIALS_CLOUDS_H
#define OVOID_TRIALS_CLOUDS_H

#include <stddef.h>
#include <stdint.h>

typedef struct cloud {
    double *xyz;
    uint32_t count;
} cloud;

typedef struct clouds {
    cloud *items;
    size_t count;
} clouds;

/// pieces/game_hulls.bin of the data folder; none where it is absent.
clouds clouds_read(void);
void clouds_destroy(clouds all);

#endif
