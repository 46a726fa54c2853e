// A body moved along a straight line. Without rotation the gap along a fixed normal is linear in time, so a step of
// conservative advancement ends exactly, but for rounding, where the plane of support is reached: the ray cast of G.
// van den Bergen (Ray casting against general convex objects with application to continuous collision detection, 2004)
// against the difference body.
#include "base/environment.h"
#include "query/impact.h"

static ovoid_impact cast(const ovoid_pair *pair, ovoid_vec3 displacement, double margin,
                         const ovoid_motion_options *options) {
    const ovoid_pose none = {{0, 0, 0}, {0, 0, 0, 0}};
    ovoid_moving a = {pair->shape_a, ovoid_motion_make_still(pair->pose_a), none};
    ovoid_moving b = {pair->shape_b, ovoid_motion_make_velocity(pair->pose_b, displacement, (ovoid_vec3){0, 0, 0}, 1),
                      none};
    ovoid_impact out;
    impact_find(&a, &b, margin, options, 1e-12, &out);
    return out;
}

ovoid_impact ovoid_translation_cast(const ovoid_pair *pair, ovoid_vec3 displacement, double margin,
                                    const ovoid_motion_options *options) {
    environment before = environment_enter();
    environment_hide(margin);
    environment_hide(displacement);
    ovoid_impact out = cast(pair, displacement, margin, options);
    environment_hide(out);
    environment_leave(before);
    return out;
}
