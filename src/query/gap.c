// The gap of a pair along a direction that the caller gives.
#include "base/environment.h"
#include "pair/round.h"

static double compute_gap(const ovoid_pair *pair, vec3 direction) {
    pair_frame f;
    vec3 n = vec3_unit(direction);
    if (!vec3_is_finite(direction) || !(vec3_norm_squared(n) > 0.5)) return -INFINITY;
    if (frame_make(pair, &f) != OVOID_LIMIT_NONE) return -INFINITY;
    vec3 in_a = frame_direction_from_world(&f, n);
    if (frame_has_round(&f)) frame_make_true(&f);
    double lower = frame_find_support(&f, in_a).gap - f.lower_radii - f.claim;
    vec3 in_b = mat3_mul_transposed_vec3(f.rotation, in_a);
    return frame_take_gain(lower, frame_compute_gain(&f, in_a, in_b, AXIS_CLAIM));
}

double ovoid_pair_compute_gap(const ovoid_pair *pair, ovoid_vec3 direction) {
    ENVIRONMENT_RETURN(double, direction, compute_gap(pair, direction));
}
