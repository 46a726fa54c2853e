// The supports of the exact methods: a small B is brought into the frame once, which saves turning each direction and
// each vertex.
#ifndef OVOID_EXACT_PROBE_H
#define OVOID_EXACT_PROBE_H

#include "pair/search.h"
#include "simd/pair.h"

enum { PROBE_POSED = 64, PROBE_POSED_FEW = 32, PROBE_ALL = 384 };

/// What evaluates the supports of a search.
typedef struct prober {
    search *s;
    int is_posed;
    int is_small;                  ///< at most PROBE_ALL vertices each
    simd_points a, b;              ///< in the frame
    double posed[3 * PROBE_POSED]; ///< B's vertices in the frame: all x, all y, all z
} prober;

/// is_steady: 1 for EPA, whose many supports pay for more preparation than GJK's few.
void prober_make(prober *p, search *s, int is_steady);

/// The support along n, of any length, from A to B; as frame_find_support.
frame_support probe_measure(const prober *p, vec3 n);

/// The support along the unit direction n: the difference with the greatest n.w. Its gap, along -n, goes into the
/// search.
frame_support probe_find(const prober *p, vec3 n);

#endif
