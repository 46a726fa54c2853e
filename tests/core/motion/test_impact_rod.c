// A rod that spins about its middle and a point that passes: the distance in closed form, at 4000 times of each motion,
// before the time until which an impact is free. The curvature of a step (motion/motion_gap.h) is in the search and in
// its verifier alike, so that one too small leaves both agreed: 11 of these 600 motions are then told to be free too
// long where it is halved, and none of those with bodies that have an extent across the axis.
#include "check.h"

#include <ovoid/ovoid.h>

enum { MOTIONS = 600, TIMES = 4000, STEPS = 1000 };
static const double margin = 0.05;

typedef struct passing {
    double spin, speed;
    ovoid_vec3 from; ///< of the point, which goes along -y
} passing;

// The distance of the point from the rod between (-1, 0, 0) and (1, 0, 0) of the rod's frame, which has turned by spin
// t.
static double compute_distance(const passing *p, double t) {
    double c = cos(p->spin * t), s = sin(p->spin * t), y = p->from.y - p->speed * t;
    double along = p->from.x * c + y * s, across = y * c - p->from.x * s;
    return hypot(fmax(fabs(along) - 1, 0), across);
}

static void try_passing(const passing *p, const ovoid_shape *rod, const ovoid_shape *point) {
    static ovoid_step steps[STEPS];
    const ovoid_vec3 none = {0, 0, 0};
    ovoid_pose there = {p->from, {1, 0, 0, 0}};
    ovoid_moving_shape a = {
        .shape = rod,
        .motion = ovoid_motion_make_velocity(ovoid_pose_make_identity(), none, (ovoid_vec3){0, 0, p->spin}, 1)};
    ovoid_moving_shape b = {.shape = point,
                            .motion = ovoid_motion_make_velocity(there, (ovoid_vec3){0, -p->speed, 0}, none, 1)};
    ovoid_moving_pair pair = {a, b, margin};
    ovoid_motion_options options = {.steps = steps, .capacity = STEPS};
    ovoid_impact impact = ovoid_impact_find(&pair, &options);
    CHECK(ovoid_impact_verify(&pair, &impact, &(ovoid_motion_basis){&options, steps, NULL}, NULL) == OVOID_OK);
    CHECK(impact.status != OVOID_IMPACT_UNDECIDED);
    // Sines and cosines of libm and sums of lengths below 3: off by less than 1e-14.
    double least = INFINITY;
    for (int i = 0; i <= TIMES && (double)i / TIMES <= impact.free_until; i++)
        least = fmin(least, compute_distance(p, (double)i / TIMES));
    CHECK_LE(margin - 1e-13, least);
    if (impact.status == OVOID_IMPACT_HIT) CHECK_LE(compute_distance(p, impact.hit_at), margin + 1e-13);
}

int main(void) {
    static const double ends[6] = {-1, 0, 0, 1, 0, 0}, origin[3];
    ovoid_shape *rod = ovoid_shape_create_from_points(ends, 2, NULL, NULL);
    ovoid_shape *point = ovoid_shape_create_from_points(origin, 1, NULL, NULL);
    for (int i = 0; i < MOTIONS; i++) {
        passing p = {0.5 + 6 * (i * 31 % 97) / 97.0,
                     0.2 * (i * 17 % 29),
                     {0.2 + 0.79 * (i * 7919 % 4000) / 4000.0, 0.3 + 1.5 * (i * 104729 % 4000) / 4000.0, 0}};
        try_passing(&p, rod, point);
    }
    ovoid_shape_destroy(rod);
    ovoid_shape_destroy(point);
    return check_end();
}
