// The kernel of extents (support.h), written once over lanes.
#ifndef OVOID_SIMD_KERNELS_EXTENTS_H
#define OVOID_SIMD_KERNELS_EXTENTS_H

#include "simd/kernels/lanes.h"
#include "simd/support.h"

LANES_TARGET static simd_extents run_extents(const simd_points *p, const mat3 *m) {
    const vec3 rows[3] = {m->r0, m->r1, m->r2};
    lane low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = lane_set(INFINITY);
        high[k] = lane_set(-INFINITY);
    }
    for (uint32_t i = 0; i < p->padded_count; i += LANES) {
        lane3 v = {lane_load(p->x + i), lane_load(p->y + i), lane_load(p->z + i)};
        for (int k = 0; k < 3; k++) {
            lane dot = lane3_dot(v, (lane3){lane_set(rows[k].x), lane_set(rows[k].y), lane_set(rows[k].z)});
            low[k] = lane_min(low[k], dot);
            high[k] = lane_top(high[k], dot);
        }
    }
    simd_extents out;
    for (int k = 0; k < 3; k++) {
        out.low[k] = -lane_first(lane_find_max(-low[k]));
        out.high[k] = lane_first(lane_find_max(high[k]));
    }
    return out;
}

#endif
