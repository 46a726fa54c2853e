// Places are uniform in a cube whose volume grows with the number of bodies, so that each body has about as many
// neighbours in a swarm of any size. There is no reaction to contact: bodies pass through each other, a hard case for a
// broad phase.
#include "many/swarm.h"

#include "common/random.h"
#include "common/rotation.h"

#include <string.h>

enum { SHAPES = 200 };

/// Volume of the cube for each body, in cubes of the mean radius of the enclosing spheres: measured, so that about five
/// tight boxes meet that of a body.
static const double room = 5.8;

int swarm_create(swarm_motion *all, uint32_t count, uint32_t vertices) {
    *all = (swarm_motion){.set = bodies_create_hulls(vertices, SHAPES)};
    uint32_t *shape_of = malloc(sizeof *shape_of * count);
    all->poses = malloc(sizeof *all->poses * count);
    all->drifts = malloc(sizeof *all->drifts * count);
    all->what = (swarm){all->set.items, shape_of, all->set.count, count, 0, 1};
    if (!all->set.count || !shape_of || !all->poses || !all->drifts) {
        swarm_destroy(all);
        return 0;
    }
    double reach = 0;
    for (uint32_t i = 0; i < all->set.count; i++) reach += body_get_reach(&all->set.items[i]) / all->set.count;
    all->side = cbrt(room * count) * reach;
    all->what.step = 0.01 * 2 * reach;

    uint64_t state = count;
    for (uint32_t i = 0; i < count; i++) {
        shape_of[i] = i % SHAPES;
        double size = 2 * body_get_reach(&all->set.items[shape_of[i]]), side = all->side;
        ovoid_vec3 place = {random_uniform(&state, 0, side), random_uniform(&state, 0, side),
                            random_uniform(&state, 0, side)};
        all->poses[i] = (ovoid_pose){place, random_rotation(&state)};
        // The outermost points are half the size away from the middle: 0.02 radians are 1 % of the size.
        ovoid_vec3 u = random_unit(&state), axis = random_unit(&state);
        double speed = random_uniform(&state, 0, 0.01) * size;
        all->drifts[i] =
            (drift){{u.x * speed, u.y * speed, u.z * speed}, rotation_make_turn(axis, random_uniform(&state, 0, 0.02))};
    }
    return 1;
}

void swarm_destroy(swarm_motion *all) {
    free((uint32_t *)all->what.shape_of);
    free(all->poses);
    free(all->drifts);
    bodies_destroy(&all->set);
    memset(all, 0, sizeof *all);
}

static void move_along(double *x, double *speed, double side) {
    *x += *speed;
    if ((*x < 0 && *speed < 0) || (*x > side && *speed > 0)) *speed = -*speed;
}

void swarm_move(swarm_motion *all) {
    for (uint32_t i = 0; i < all->what.body_count; i++) {
        ovoid_pose *p = &all->poses[i];
        drift *d = &all->drifts[i];
        move_along(&p->position.x, &d->along.x, all->side);
        move_along(&p->position.y, &d->along.y, all->side);
        move_along(&p->position.z, &d->along.z, all->side);
        p->rotation = rotation_multiply(d->turn, p->rotation);
    }
}
