// Upper bounds from points inside the inner ellipsoids. A shape's inner ellipsoid lies in its polyhedron, proven when
// the shape was made; so a point that is proven inside the ellipsoid is a point of the body.
//
// A point x of E with m = (x - c)' Q^-1 (x - c) < 1 has the ball of radius (1 - sqrt m) r around it inside E, where r
// is the least radius; a common point of two bodies with balls of radii ra and rb around it has d <= -ra - rb - radii.
// A point of the segment between the centres is often common to both: with norms ka and kb of the whole segment, the
// one at kb / (ka + kb) of it has norm ka kb / (ka + kb) in each.
#include "pair/inner.h"

// |W y|
static double norm_of(const shape_inner *in, vec3 y) {
    const double *w = in->w;
    return vec3_norm((vec3){w[0] * y.x, w[1] * y.x + w[2] * y.y, (w[3] * y.x + w[4] * y.y) + w[5] * y.z});
}

// An upper bound of the norm of a point with an error of `error`; 2 for an ellipsoid too thin to decide.
static double norm_in(const ovoid_shape *s, vec3 x, double error) {
    const shape_inner *in = &s->inside;
    if (!(in->least > 0)) return 2;
    return norm_of(in, vec3_sub(x, s->inner.center)) * (1 + 1e-6) + error / in->least;
}

// The bound by a point whose norms are a and b.
static double upper_of(const pair_frame *f, double a, double b) {
    if (!(a < 1 - 1e-5) || !(b < 1 - 1e-5)) return 0;
    return -0.999 * ((1 - a) * f->a->inside.least + (1 - b) * f->b->inside.least) - f->upper_radii;
}

double inner_compute_upper(const pair_frame *f, vec3 x) {
    if (!vec3_is_finite(x)) return 0;
    vec3 in_b = mat3_mul_transposed_vec3(f->rotation, vec3_sub(x, f->translation));
    return upper_of(f, norm_in(f->a, x, 0), norm_in(f->b, in_b, f->claim));
}

double inner_points_compute_upper(const pair_frame *f, vec3 a, vec3 b, double error) {
    if (!vec3_is_finite(a) || !vec3_is_finite(b)) return INFINITY;
    if (!(norm_in(f->a, a, 0) <= 1) || !(norm_in(f->b, b, 0) <= 1)) return INFINITY;
    return vec3_norm(vec3_sub(frame_b(f, b), a)) - f->upper_radii + error;
}

// The share of the way from A's centre to B's at which a point of the segment is common to both; ka, kb: the norms of
// the whole segment. 0 if there is none; *is_common.
static double find_share(double ka, double kb, int *is_common) {
    *is_common = ka * kb < 0.999 * (ka + kb);
    return kb / (ka + kb);
}

double inner_compute_upper_at(const pair_frame *f, vec3 x) {
    if (!vec3_is_finite(x)) return 0;
    vec3 in_b = mat3_mul_transposed_vec3(f->world_b, vec3_sub(mat3_mul_vec3(f->world, x), f->offset));
    return upper_of(f, norm_in(f->a, x, 0), norm_in(f->b, in_b, 2 * f->claim));
}

double inner_compute_upper_in_world(const pair_frame *f, vec3 *x) {
    const shape_inner *a = &f->a->inside, *b = &f->b->inside;
    vec3 c = f->a->inner.center, d = frame_world_difference(f, c, f->b->inner.center);
    double reach = a->reach + b->reach;
    if (!(a->least > 0) || !(b->least > 0) || !(vec3_norm_squared(d) < reach * reach)) return 0;
    vec3 segment = mat3_mul_transposed_vec3(f->world, d);
    int is_common;
    double share = find_share(norm_of(a, segment), norm_of(b, mat3_mul_transposed_vec3(f->world_b, d)), &is_common);
    if (!is_common) return 0;
    *x = vec3_add_scaled(c, segment, share);
    return inner_compute_upper_at(f, *x);
}

int inner_find_common(const pair_frame *f, vec3 *x) {
    const shape_inner *a = &f->a->inside, *b = &f->b->inside;
    vec3 d = vec3_sub(frame_b(f, f->b->inner.center), f->a->inner.center);
    double reach = a->reach + b->reach;
    if (!(a->least > 0) || !(b->least > 0) || !(vec3_norm_squared(d) < reach * reach)) return 0;
    double ka = norm_of(a, d), kb = norm_of(b, mat3_mul_transposed_vec3(f->rotation, d));
    int is_common;
    double share = find_share(ka, kb, &is_common);
    if (!is_common) {
        // Concentric ellipsoids have their centre in common.
        if (ka > 0) return 0;
        *x = f->a->inner.center;
        return 1;
    }
    *x = vec3_add_scaled(f->a->inner.center, d, share);
    return 1;
}
