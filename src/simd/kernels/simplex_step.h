// The step of GJK's simplex to a new corner, written once over lanes of doubles (gjk8.h) and of floats (float_gjk.h).
#ifndef OVOID_SIMD_KERNELS_SIMPLEX_STEP_H
#define OVOID_SIMD_KERNELS_SIMPLEX_STEP_H

#include "simd/kernels/lanes.h"

// What the step finds: the next heading, which old corners stay, and the least |n|^2 of a face that is no sliver.
typedef struct lane_step {
    lane3 n;
    lane least;
    lane_mask keeps[3], inside;
    lane_mask goes; // the lanes that take it: known when its gain is
} lane_step;

LANES_INLINE lane_step step_lanes(const lane3 old[3], const lane_mask valid[3], lane3 w) {
    lane3 e[3], c[3], n[3];
    lane_mask behind[3], first[3], next[3], before[3], flip[3], face[3], edge[3];
    for (int i = 0; i < 3; i++) {
        e[i] = lane3_sub(old[i], w);
        c[i] = lane3_cross(w, e[i]);
        before[i] = lane_and(lane_sign(lane3_dot(w, e[i])), valid[i]);
    }
    lane_mask all = lane_and(lane_and(valid[0], valid[1]), valid[2]);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        lane_mask both = lane_and(valid[i], valid[j]);
        n[i] = lane3_cross(e[i], e[j]);
        flip[i] = lane_sign(lane3_dot(n[i], w));
        lane_mask side = lane_sign(lane3_dot(n[i], e[(i + 2) % 3]));
        behind[i] = lane_and(all, lane_or(lane_and(flip[i], lane_not(side)), lane_and(side, lane_not(flip[i]))));
        first[i] = lane_and(both, lane_not(lane_sign(lane3_dot(n[i], c[i]))));
        next[i] = lane_and(both, lane_sign(lane3_dot(n[i], c[j])));
        face[i] = lane_and(lane_and(first[i], next[i]), lane_not(behind[i]));
    }
    lane_step s = {w,
                   lane_set(-1),
                   {lane_none(), lane_none(), lane_none()},
                   lane_and(lane_and(behind[0], behind[1]), behind[2]),
                   lane_none()};
    // One of them, the first of the faces, else of the edges, else the new corner: the last one written.
    for (int i = 2; i >= 0; i--) {
        edge[i] = lane_and(before[i], lane_not(lane_or(first[i], next[(i + 2) % 3])));
        s.n = lane3_select(edge[i], lane3_cross(e[i], c[i]), s.n);
        for (int j = 0; j < 3; j++) s.keeps[j] = lane_and(s.keeps[j], lane_not(edge[i]));
        s.keeps[i] = lane_or(s.keeps[i], edge[i]);
    }
    for (int i = 2; i >= 0; i--) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        s.n = lane3_select(face[i], lane3_select(flip[i], lane3_neg(n[i]), n[i]), s.n);
        s.least = lane_select(face[i], lane_set(1e-4) * (lane3_dot(e[i], e[i]) * lane3_dot(e[j], e[j])), s.least);
        s.keeps[i] = lane_or(s.keeps[i], face[i]);
        s.keeps[j] = lane_or(s.keeps[j], face[i]);
        s.keeps[k] = lane_and(s.keeps[k], lane_not(face[i]));
    }
    return s;
}

#endif
