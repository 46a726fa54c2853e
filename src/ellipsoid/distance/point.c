// The point of an ellipsoid nearest to a given one. D. Eberly, Distance from a point to an ellipse, an ellipsoid, or a
// hyperellipsoid, 2013; the form of the root's equation: J. J. More and D. C. Sorensen, Computing a trust region step,
// 1983.
//
// In the ellipsoid's axes, radii e_i and y the point from the centre, the nearest point is x_i = e_i^2 y_i / (t +
// e_i^2) where t >= 0 is the root of r(t) = |p(t)| = 1, p_i = x_i / e_i = e_i y_i / (t + e_i^2). 1 / r is a power mean
// of linear functions of t, hence concave and increasing: Newton's method on 1 / r = 1, started below the root, stays
// below, and with a single nonzero term one step solves it. It starts at the largest t for which one term alone reaches
// 1; there r is between 1 and sqrt(3), and 3 to 8 steps reach rounding. A zero radius contributes nothing to p, and x_i
// = 0: so flat ellipsoids, segments and points need no special case.
#include "base/environment.h"
#include "ellipsoid/distance/gap.h"

/// part / (t + e^2), 0 if both parts of the sum are zero.
static double find_share(double part, double t, double square) { return t + square > 0 ? part / (t + square) : 0; }

/// The root t; *rounds counts Newton's steps.
static double find_root(const double *square, vec3 y, uint32_t *rounds) {
    const double e[3] = {sqrt(square[0]), sqrt(square[1]), sqrt(square[2])};
    const double part[3] = {e[0] * fabs(y.x), e[1] * fabs(y.y), e[2] * fabs(y.z)};
    double t = 0;
    for (int i = 0; i < 3; i++) t = fmax(t, part[i] - square[i]);
    for (*rounds = 0; *rounds < 50; ++*rounds) {
        // r^2 and minus half its derivative.
        double sum = 0, slope = 0;
        for (int i = 0; i < 3; i++) {
            double below = t + square[i];
            if (!(part[i] > 0) || !(below > 0)) continue;
            double p = part[i] / below;
            sum += p * p;
            slope += p * p / below;
        }
        if (!(sum > 1)) break;
        double next = t + (sqrt(sum) - 1) * sum / slope;
        if (!(next > t)) break;
        t = next;
    }
    return t;
}

/// The outward direction at a point inside: the normal of the level set of y' Q^-1 y through it. For a flat ellipsoid,
/// and at the centre, the thinnest axis.
static vec3 find_outward(const double *square, vec3 y) {
    if (!(square[0] > 0)) return (vec3){1, 0, 0};
    vec3 n = vec3_unit((vec3){y.x, y.y * (square[0] / square[1]), y.z * (square[0] / square[2])});
    return vec3_norm_squared(n) > 0 ? n : (vec3){1, 0, 0};
}

static ovoid_nearest compute_nearest_to_point(const ovoid_ellipsoid *ellipsoid, ovoid_vec3 point) {
    // The point in the ellipsoid's axes, in units of the pair's size.
    ovoid_ellipsoid b = {point, {0, 0, 0, 0, 0, 0}};
    scaled_pair p = ellipsoids_make_scaled(ellipsoid, &b);
    eigen3 axes = sym3_compute_eigen(p.qa);
    double square[3] = {fmax(axes.value[0], 0), fmax(axes.value[1], 0), fmax(axes.value[2], 0)};
    vec3 y = mat3_mul_vec3(axes.v, p.d);

    // The nearest point x, and y - x without cancellation.
    ovoid_nearest r = {.point_b = point};
    double t = find_root(square, y, &r.iterations);
    vec3 x = {y.x * find_share(square[0], t, square[0]), y.y * find_share(square[1], t, square[1]),
              y.z * find_share(square[2], t, square[2])};
    vec3 difference = {y.x * find_share(t, t, square[0]), y.y * find_share(t, t, square[1]),
                       y.z * find_share(t, t, square[2])};
    if (!(t > 0)) difference = vec3_sub(y, x);

    r.overlap = !(vec3_norm_squared(difference) > 0);
    vec3 n = r.overlap ? find_outward(square, y) : vec3_unit(difference);
    r.normal = vec3_unit(mat3_mul_transposed_vec3(axes.v, n));
    r.point_a = point;
    if (!r.overlap) r.point_a = vec3_add_scaled(ellipsoid->center, mat3_mul_transposed_vec3(axes.v, x), p.unit);
    r.distance = vec3_norm(vec3_sub(r.point_b, r.point_a));
    r.lower = fmin(ellipsoids_compute_gap(ellipsoid, &b, r.normal), r.distance);

    // Eigenvalues are off by roundings of the largest. If that matters, in a thin body, the search for two ellipsoids,
    // which needs no eigenvalues, is used.
    if (!r.overlap && r.distance - r.lower > 1e-12 * p.unit) {
        r = ovoid_ellipsoid_compute_nearest(ellipsoid, &b);
        r.point_b = point;
    }
    return r;
}

ovoid_nearest ovoid_ellipsoid_compute_nearest_to_point(const ovoid_ellipsoid *ellipsoid, ovoid_vec3 point) {
    ENVIRONMENT_RETURN(ovoid_nearest, point, compute_nearest_to_point(ellipsoid, point));
}
