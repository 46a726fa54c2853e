// A swarm of hulls in a box with walls, made and moved by random numbers of its own.
#ifndef OVOID_BENCH_MANY_SWARM_H
#define OVOID_BENCH_MANY_SWARM_H

#include "common/bodies.h"
#include "peers/many_peer.h"

/// The motion of a body: along a line, and around its own axis by the same rotation in each frame.
typedef struct drift {
    ovoid_vec3 along; ///< per frame
    ovoid_quat turn;
} drift;

typedef struct swarm_motion {
    swarm what;
    bodies set;
    ovoid_pose *poses; ///< now
    drift *drifts;
    double side; ///< the positions stay in the cube [0, side]^3
} swarm_motion;

/// Hulls of so many vertices at random places, at a density at which the boxes of a body meet those of about five
/// others. 0 if memory runs out.
int swarm_create(swarm_motion *all, uint32_t count, uint32_t vertices);
/// Advances one frame: each body moves and turns by up to 1 % of its size; at a wall it bounces back.
void swarm_move(swarm_motion *all);
void swarm_destroy(swarm_motion *all);

#endif
