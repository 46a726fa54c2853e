// The real bodies that some trials use, in files that are not part of the project: 3378 point clouds of a game, records
// of a 32-bit little-endian count n and n times three 32-bit floats; and the parts of compounds, OBJ files of an `o`
// line and the part's own `v` lines each.
#ifndef OVOID_TRIALS_CLOUDS_H
#define OVOID_TRIALS_CLOUDS_H

#include <stddef.h>
#include <stdint.h>

typedef struct cloud {
    double *xyz;
    uint32_t count;
    uint32_t object; // of a part: which compound
} cloud;

typedef struct clouds {
    cloud *items;
    size_t count;
} clouds;

/// pieces/game_hulls.bin of the data folder; none where it is absent.
clouds clouds_read(void);
/// The parts of all compounds/*.obj of the data folder, object after object.
clouds clouds_read_compounds(void);
void clouds_destroy(clouds all);

#endif
