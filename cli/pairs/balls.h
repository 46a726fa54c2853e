// Enclosing balls of bodies, in their own frames; bodies that share a shape, compound or solid share the ball.
#ifndef OVOID_CLI_PAIRS_BALLS_H
#define OVOID_CLI_PAIRS_BALLS_H

#include <ovoid/ovoid.h>

/// The enclosing ball of a body in its own frame.
typedef struct cli_ball {
    const void *body; ///< its shape, compound or solid; NULL: a free slot
    ovoid_vec3 center;
    double radius;
} cli_ball;

typedef struct cli_balls {
    cli_ball *slots; ///< NULL: there was no memory
    size_t count;    ///< of the slots, a power of two
} cli_balls;

/// Room for the balls of so many objects.
cli_balls balls_create(size_t objects);
void balls_destroy(cli_balls *balls);

/// The ball of a body, found once for all objects that share it.
const cli_ball *balls_find(cli_balls *balls, const ovoid_body *body);

#endif
