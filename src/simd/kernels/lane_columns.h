// Columns of lane groups (pair8.h) as lanes, from the lane `at` on.
#ifndef OVOID_SIMD_KERNELS_LANE_COLUMNS_H
#define OVOID_SIMD_KERNELS_LANE_COLUMNS_H

#include "simd/kernels/lanes.h"
#include "simd/pair8.h"

LANES_INLINE lane get(const lane_column *c, int at) { return lane_load(c->lane + at); }
LANES_INLINE void put(lane_column *c, int at, lane v) { lane_store(c->lane + at, v); }
LANES_INLINE lane3 get3(const lane_column *c, int at) { return (lane3){get(c, at), get(c + 1, at), get(c + 2, at)}; }
LANES_INLINE void put3(lane_column *c, int at, lane3 v) {
    put(c, at, v.x);
    put(c + 1, at, v.y);
    put(c + 2, at, v.z);
}

#endif
