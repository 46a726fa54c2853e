// Lies about the impacts of moving compounds (body_impact_liar.h).
#include "body_impact_liar.h"
#include "moving.h"

enum { PARTS = 7, SHAPES = 3 };
typedef struct bodies {
    ovoid_shape *shapes[SHAPES];
    ovoid_compound *compounds[2];
} bodies;

static leaf_shape make_leaf(const truth *t, int side, uint32_t leaf, double time) {
    ovoid_moving_shape part = ovoid_moving_body_get_part(side ? &t->b : &t->a, leaf);
    return (leaf_shape){{part.shape, ovoid_moving_shape_compute_pose(&part, time)}, NULL};
}

static void make(truth *t, uint64_t seed) {
    uint64_t s = seed * 31;
    static bodies own;
    *t = (truth){.bodies = &own, .slack = 1e-10, .margin = seed % 3 ? 0 : 0.3};
    for (int i = 0; i < SHAPES; i++)
        own.shapes[i] = bits_make_shape(i == 0 ? BITS_BALL : i == 1 ? BITS_NEEDLE : BITS_PLAIN, &s);
    for (int k = 0; k < 2; k++) {
        ovoid_posed_shape parts[PARTS];
        uint32_t count = 1 + (uint32_t)(random_next(&s) % PARTS);
        for (uint32_t i = 0; i < count; i++) {
            parts[i].shape = own.shapes[random_next(&s) % SHAPES];
            parts[i].pose = moving_make_pose(&s, 2);
        }
        own.compounds[k] = ovoid_compound_create(parts, count, NULL, NULL);
        ovoid_pose start = moving_make_pose(&s, k ? 6 : 1), end = moving_make_pose(&s, k ? 6 : 1);
        ovoid_vec3 angular = bits_vec3(&s, 6);
        ovoid_motion motion = seed % 2
                                  ? ovoid_motion_make_poses(start, end, 1)
                                  : ovoid_motion_make_velocity(start, moving_scaled(start.position, -1.5), angular, 1);
        *(k ? &t->b : &t->a) = (ovoid_moving_body){.compound = own.compounds[k], .motion = motion};
        *(k ? &t->count_b : &t->count_a) = count;
    }
    set_times(t, seed);
}

static void destroy(truth *t) {
    bodies *own = t->bodies;
    for (int k = 0; k < 2; k++) ovoid_compound_destroy(own->compounds[k]);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(own->shapes[i]);
}

int main(int count, char **arguments) { return run_cases(count, arguments, 90, make, destroy); }
