// The smooth bracket: the signed distance of the outer ellipsoids from below, that of the inner ones from above, and
// their derivatives.
//
// For bodies A, B and ellipsoids around them, the gap of supports along any n of the ellipsoids is at most that of the
// bodies, so its maximum is at most d; with ellipsoids inside, at least. The value claimed is what one direction proves
// (outer) or what a point of each body, or a depth that no direction exceeds, proves (inner).
//
// Errors (u = 2^-53, s the sum of the ellipsoids' reach, their frames' distance and the radii): supports of the rotated
// roots are off by 60 u s as in reject.h, the roots by their pads, the sums, norms and the enclosed ellipsoid of
// smooth_depth.c by less than 100 u s. Together below CLAIM s and the pads.
// Cost: 0.3 to 0.8 microseconds a pair of ellipsoids that are apart, docs/smooth.md.
#include "smooth/smooth.h"

#include "base/environment.h"
#include "base/error.h"

#define CLAIM (192 * 0x1p-53)

static double compute_reach(const smooth_body *x) {
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += vec3_norm_squared(x->root.axis[k]);
    return sqrt(sum) + vec3_norm(x->center);
}

static smooth_pair make_pair(const pair_frame *f, int is_inner, double unit) {
    smooth_pair s = {.unit = unit};
    s.a = is_inner ? smooth_body_make_inner(f->a, &f->world, unit) : smooth_body_make(&f->a->outer, &f->world, unit);
    s.b =
        is_inner ? smooth_body_make_inner(f->b, &f->world_b, unit) : smooth_body_make(&f->b->outer, &f->world_b, unit);
    vec3 offset = vec3_scale(f->offset, 1 / unit);
    s.d = vec3_add(offset, vec3_sub(s.b.center, s.a.center));
    s.size = ((vec3_norm(offset) + compute_reach(&s.a)) + compute_reach(&s.b)) + f->lower_radii / unit;
    s.claim = CLAIM * s.size + (s.a.pad + s.b.pad) + f->hidden / unit;
    return s;
}

// The arm from the pose's position to the centre of the ellipsoid.
static vec3 find_lever(const ovoid_shape *shape, const mat3 *rotation, const smooth_body *x, double unit) {
    if (!shape->has_origin) return x->center;
    return vec3_add(x->center, vec3_scale(mat3_mul_vec3(*rotation, shape->origin), 1 / unit));
}

static void fill_value(const pair_frame *f, int is_inner, int order, double unit, ovoid_smooth_value *out) {
    smooth_pair s = make_pair(f, is_inner, unit);
    smooth_state state;
    double upper, lower;
    smooth_search(&s, &state, &upper, &out->iterations);
    lower = state.gap - s.claim;
    out->error = (upper - lower) * unit;
    out->value = is_inner ? upper * unit - f->upper_radii : lower * unit - f->lower_radii;
    out->normal = state.n;
    vec3 from_a = vec3_add(s.a.center, state.xa), from_b = vec3_sub(s.b.center, state.xb);
    out->point_a = vec3_add_scaled(f->world_origin, from_a, unit);
    out->point_b = vec3_add(f->world_origin, vec3_add_scaled(f->offset, from_b, unit));
    vec3 levers[2] = {vec3_add(find_lever(f->a, &f->world, &s.a, unit), state.xa),
                      vec3_sub(find_lever(f->b, &f->world_b, &s.b, unit), state.xb)};
    smooth_derive(&s, &state, levers, order, out);
}

static void compute(const ovoid_pair *pair, int order, ovoid_smooth *out) {
    OVOID_ASSERT(pair);
    *out = (ovoid_smooth){.limit = OVOID_LIMIT_NONE};
    pair_frame f;
    out->limit = order >= 0 && order <= 2 ? frame_place(pair, &f) : OVOID_LIMIT_OPTIONS;
    if (out->limit != OVOID_LIMIT_NONE) {
        out->outer.value = -INFINITY;
        out->inner.value = INFINITY;
        return;
    }
    double unit = ldexp(1, find_unit_exponent(f.size));
    fill_value(&f, 0, order, unit, &out->outer);
    fill_value(&f, 1, order, unit, &out->inner);
}

ovoid_smooth ovoid_pair_compute_smooth(const ovoid_pair *pair, int order) {
    ENVIRONMENT_RETURN_FILLED(ovoid_smooth, out, order, compute(pair, order, &out));
}
