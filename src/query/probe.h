// The supports of EPA: a small B is brought into the frame once, which saves turning each direction and each vertex.
#ifndef OVOID_QUERY_PROBE_H
#define OVOID_QUERY_PROBE_H

#include "query/search.h"
#include "simd/pair.h"

enum { PROBE_POSED = 64, PROBE_ALL = 384 };

typedef struct prober {
    search *s;
    int is_posed;
    int is_small;                  ///< at most PROBE_ALL vertices each
    simd_points a, b;              ///< in the frame
    double posed[3 * PROBE_POSED]; ///< B's vertices in the frame: all x, all y, all z
} prober;

void prober_make(prober *p, search *s);

/// The support along the unit direction n: the difference with the greatest n.w. Its gap, along -n, goes into the
/// search.
frame_support probe_find(const prober *p, vec3 n);

#endif
