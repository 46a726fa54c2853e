// A spinning rod flies toward a box: when do they meet? The proof shows that they were apart at all times before.
#include <ovoid/ovoid.h>

#include <stdio.h>

enum { CAPACITY = 1000 };

int main(void) {
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error);
    ovoid_shape *rod = ovoid_shape_create_capsule(0.05, 2, NULL, &error);
    if (!box || !rod) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }

    // The rod moves 8 along -x and turns 30 radians about y within the second; the box stands still.
    ovoid_pose start = {{6, 0, 0.2}, {1, 0, 0, 0}};
    ovoid_moving_shape a = {.shape = box, .motion = ovoid_motion_make_still(ovoid_pose_make_identity())};
    ovoid_moving_shape b = {
        .shape = rod, .motion = ovoid_motion_make_velocity(start, (ovoid_vec3){-8, 0, 0}, (ovoid_vec3){0, 30, 0}, 1)};

    static ovoid_step steps[CAPACITY];
    ovoid_motion_options options = {.steps = steps, .capacity = CAPACITY};
    ovoid_impact x = ovoid_impact_find(&(ovoid_moving_pair){a, b, 0}, &options);
    printf("%s: free until %.12f, hit at %.12f, %zu steps, %u queries\n", ovoid_impact_status_get_name(x.status),
           x.free_until, x.hit_at, x.step_count, x.iterations);
    printf("at (%g, %g, %g), normal (%g, %g, %g)\n", x.free.point_a.x, x.free.point_a.y, x.free.point_a.z,
           x.free.normal.x, x.free.normal.y, x.free.normal.z);

    // The steps prove this without trusting the search.
    ovoid_code code = ovoid_impact_verify(&(ovoid_moving_pair){a, b, 0}, &x,
                                          &(ovoid_motion_basis){.options = &options, .steps = steps}, &error);
    printf("proof: %s\n", code == OVOID_OK ? "holds" : error.message);

    // How near would it come if it flew past, 3 above?
    b.motion.start.position.z = 3.5;
    ovoid_approach y = ovoid_approach_find(&(ovoid_moving_pair){a, b, 0}, NULL);
    printf("3.5 above: %.9f <= smallest distance <= %.9f, at time %.6f\n", y.lower, y.upper, y.time);
    int right = code == OVOID_OK && x.status == OVOID_IMPACT_HIT && x.hit_at - x.free_until <= 1e-9 && y.lower > 0.4;
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(rod);
    return right ? 0 : 1;
}
