// Upper bounds from points inside the inner ellipsoids. A shape's inner ellipsoid lies in its polyhedron, proven when
// the shape was made; so a point that is proven inside the ellipsoid is a point of the body.
//
// A point x of E with m = (x - c)' Q^-1 (x - c) < 1 has the ball of radius (1 - sqrt m) r around it inside E, where r
// is the least radius; a common point of two bodies with balls of radii ra and rb around it has d <= -ra - rb.
#include "query/inner.h"

// The least radius of the ellipsoid from below, 0 where it is too flat to be safe in doubles: with eigenvalues
// l1 <= l2 <= l3, l1 = det / (l2 l3) >= 4 det / trace^2.
static double least_radius(sym3 q) {
    double trace = sym3_trace(q);
    if (!(trace > 0)) return 0;
    double least = 4 * sym3_det(sym3_scale(q, 1 / trace));
    return least > 1e-7 ? sqrt(least * trace) * (1 - 1e-7) : 0;
}

// sqrt(m) of a point that may be off by `error`, from above; 2 where it cannot be told. The condition of Q is below
// 1e8, so that the solve is off by less than 1e-7 of m.
static double norm_in(const ovoid_ellipsoid *e, vec3 x, double radius, double error) {
    vec3 y = vec3_sub(x, e->center), z;
    if (!(radius > 0) || !sym3_solve(e->q, y, &z)) return 2;
    double m = vec3_dot(y, z);
    return m >= 0 ? sqrt(m) * (1 + 1e-6) + error / radius : 2;
}

double inner_compute_upper(const pair_frame *f, vec3 x) {
    if (f->a->rank < 3 || f->b->rank < 3 || !vec3_is_finite(x)) return 0;
    double ra = least_radius(f->a->inner.q), rb = least_radius(f->b->inner.q);
    vec3 in_b = mat3_mul_transposed_vec3(f->rotation, vec3_sub(x, f->translation));
    double a = norm_in(&f->a->inner, x, ra, 0), b = norm_in(&f->b->inner, in_b, rb, f->claim);
    if (!(a < 1 - 1e-5) || !(b < 1 - 1e-5)) return 0;
    return -0.999 * ((1 - a) * ra + (1 - b) * rb) - f->radii;
}

double inner_points_compute_upper(const pair_frame *f, vec3 a, vec3 b, double error) {
    if (f->a->rank < 3 || f->b->rank < 3 || !vec3_is_finite(a) || !vec3_is_finite(b)) return INFINITY;
    double ra = least_radius(f->a->inner.q), rb = least_radius(f->b->inner.q);
    if (!(norm_in(&f->a->inner, a, ra, 0) <= 1) || !(norm_in(&f->b->inner, b, rb, 0) <= 1)) return INFINITY;
    return vec3_norm(vec3_sub(frame_b(f, b), a)) - f->radii + error;
}
