// A body moved along a straight line. Without rotation the gap along a fixed normal is linear in time, so a step of
// conservative advancement ends exactly, but for rounding, where the plane of support is reached: the ray cast of G.
// van den Bergen (Ray casting against general convex objects with application to continuous collision detection, 2004)
// against the difference body.
#include "base/environment.h"
#include "motion/impact.h"

static void cast(const ovoid_pair *pair, ovoid_vec3 displacement, double margin, const ovoid_motion_options *options,
                 ovoid_impact *out) {
    const ovoid_pose none = {{0, 0, 0}, {0, 0, 0, 0}};
    ovoid_moving_shape a = {pair->shape_a, ovoid_motion_make_still(pair->pose_a), none};
    ovoid_moving_shape b = {pair->shape_b,
                            ovoid_motion_make_velocity(pair->pose_b, displacement, (ovoid_vec3){0, 0, 0}, 1), none};
    impact_find((moving_shapes){&a, &b}, margin, options, 1e-12, out);
}

ovoid_impact ovoid_shape_cast(const ovoid_pair *pair, ovoid_vec3 displacement, double margin,
                              const ovoid_motion_options *options) {
    struct {
        ovoid_vec3 displacement;
        double margin;
    } queried_at = {displacement, margin};
    ENVIRONMENT_RETURN_FILLED(ovoid_impact, out, queried_at,
                              cast(pair, queried_at.displacement, queried_at.margin, options, &out));
}
