// Balls that cover a body, in closed form: of a hull cut into pieces along its axes, the ball around each piece.
#ifndef OVOID_ROBOT_MODEL_OUTER_BALLS_H
#define OVOID_ROBOT_MODEL_OUTER_BALLS_H

#include "base/allocator.h"
#include "linear/vec3.h"
#include "robot/model/slabs.h"
#include "shape/block.h"

enum { OUTER_BALLS = 8 };

typedef struct outer_ball {
    vec3 center;
    double radius;
} outer_ball;

/// What is known to hold a shape, or the solid that it is the hull of, in its user's frame; radius and allowance
/// counted.
typedef struct outer_balls {
    balls8 lanes; ///< the balls side by side
    body_slabs slabs;
    outer_ball one;                ///< around all of it
    outer_ball balls[OUTER_BALLS]; ///< each point of the body is in one of them
    uint32_t count;                ///< of the balls, at least 1
} outer_balls;

/// Cost: seven cuts of the hull's triangles, and a smallest ball for each piece. 0: no memory.
int outer_balls_find(const ovoid_shape *shape, const ovoid_allocator *memory, outer_balls *outer);

#endif
