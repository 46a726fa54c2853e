// A lane group of a batch: its couples, and single lanes of it.
#ifndef OVOID_QUERY_LANE_GROUP_H
#define OVOID_QUERY_LANE_GROUP_H

#include "pair/frame.h"
#include "query/goal.h"
#include "simd/pair8.h"

#include <stddef.h>

/// Eight couples, their bodies and shapes as the kernels read them.
typedef struct lane_group {
    size_t index[PAIR8];
    pair8_places at; ///< their bodies and shapes
    pair8 *lanes;
    int is_placed; ///< the columns of the spheres are filled
} lane_group;

static inline vec3 get3(const lane_column *c, unsigned k) { return (vec3){c[0].lane[k], c[1].lane[k], c[2].lane[k]}; }
static inline void put3(lane_column *c, unsigned k, vec3 v) {
    c[0].lane[k] = v.x;
    c[1].lane[k] = v.y;
    c[2].lane[k] = v.z;
}
static inline mat3 get9(const lane_column *c, unsigned k) { return (mat3){get3(c, k), get3(c + 3, k), get3(c + 6, k)}; }

/// How many lanes a mask has, of 16 at most.
static inline unsigned count_lanes(unsigned some) {
    some -= some >> 1 & 0x5555;
    some = (some & 0x3333) + (some >> 2 & 0x3333);
    some = (some + (some >> 4)) & 0x0f0f;
    return (some + (some >> 8)) & 0x1f;
}

/// The body whose pose begins at a row of numbers.
static inline const ovoid_posed_shape *get_body(const double *pose) {
    return (const void *)((const char *)pose - offsetof(ovoid_posed_shape, pose));
}
static inline const ovoid_posed_shape *get_a(const lane_group *e, unsigned k) { return get_body(e->at.pose_a[k]); }
static inline const ovoid_posed_shape *get_b(const lane_group *e, unsigned k) { return get_body(e->at.pose_b[k]); }

/// Lane k of a group.
typedef struct group_lane {
    const lane_group *e;
    unsigned k;
} group_lane;

/// The frame of a lane, as frame_place makes it. What frame_relate makes is not written.
void lane_group_place_frame(group_lane at, pair_frame *f);

#endif
