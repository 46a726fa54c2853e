// The online steps of the paper for one pair, and its criterion, for study and comparison. W.-K. Su, J.-S. Liu, I-F.
// Chen, Enhancing Collision Detection Method Based on Enclosed Ellipsoid by Facial Areas Splitting, phase 4 and 3.3.
//
// Step (e): X* and Y* of the inner ellipsoids by the sphere transform. Step (f): the gap of the outer ellipsoids along
// the normal that the same transform finds for them, rounding and rounding radii subtracted: a true lower bound. Step
// (g): where the rays from the inner centres through X* and Y* leave the polyhedra: Q1 and Q2, points of the bodies, so
// that |Q1 Q2| is an upper bound of the distance (to rounding; the library's own upper bounds are
// ovoid_pair_compute_bounds and ovoid_distance).
//
// The paper speaks of one line through X* and Y*. By the transform it passes through A's inner centre, but not through
// B's. Areas are seen from the centre, so B's ray is that from its own centre through Y*. Both rays point into the
// front half as the rule of signs requires: A's since the mapped b is convex, B's since Y* - cb = -Qb n / sqrt(n' Qb n)
// has the product n . (cb - ca) / sqrt(n' Qb n) > 0 with the other centre, n the separating normal.
#include "ovoid/paper.h"

#include "base/environment.h"
#include "pair/frame.h"
#include "pair/stages.h"

/// The rays of one body, in its body frame.
typedef struct body_ray {
    const ovoid_areas *areas; ///< NULL: no tables, a flat body
    const ovoid_ellipsoid *outer;
    vec3 start, direction, toward;
} body_ray;

/// The length, in units of the direction, of the ray inside an ellipsoid that contains its start: the larger root of a
/// t^2 + 2 b t + c = 0. 0 if the ellipsoid is flat.
static double find_ellipsoid_exit(const ovoid_ellipsoid *e, vec3 start, vec3 direction) {
    vec3 y = vec3_sub(start, e->center), qu, qy;
    if (!sym3_solve(e->q, direction, &qu) || !sym3_solve(e->q, y, &qy)) return 0;
    double a = vec3_dot(direction, qu), b = vec3_dot(direction, qy), c = vec3_dot(y, qy) - 1;
    double t = (sqrt(fmax(b * b - a * c, 0)) - b) / a;
    return isfinite(t) ? fmax(t, 0) : 0;
}

/// Q in *exit, P in *outer; without tables both are the far end of the ray.
static uint32_t find_exits(const body_ray *r, ovoid_area_rule rule, vec3 *exit, vec3 *outer) {
    *exit = *outer = vec3_add(r->start, r->direction);
    if (!r->areas || !(vec3_norm_squared(r->direction) > 0)) return 0;
    ovoid_exit e = ovoid_areas_find_exit(r->areas, r->direction, r->toward, rule);
    if (isfinite(e.t)) *exit = e.point;
    *outer = vec3_add_scaled(r->start, r->direction, find_ellipsoid_exit(r->outer, r->start, r->direction));
    return e.touched;
}

/// Step (f).
static double find_lower(const pair_frame *f) {
    const ovoid_ellipsoid *a = &f->a->outer;
    ovoid_ellipsoid b = {frame_b(f, f->b->outer.center), sym3_rotate(f->b->outer.q, f->rotation)};
    vec3 n = ovoid_ellipsoid_compute_nearest_by_sphere(a, &b).normal;
    double sa = sqrt(ellipsoid_compute_spread(a->q, n)), sb = sqrt(ellipsoid_compute_spread(b.q, n));
    return vec3_dot(n, vec3_sub(b.center, a->center)) - sa - sb - f->lower_radii - f->claim;
}

/// The arguments of the study: the tables of both bodies, the rule, and the criterion's threshold.
typedef struct study {
    const ovoid_areas *const *areas;
    ovoid_area_rule rule;
    double threshold;
} study;

/// Step (g) and the criterion, from the rays to X* and Y* (both in A's frame).
static void find_upper(ovoid_paper_bounds *r, const pair_frame *f, const ovoid_nearest *inner, const study *s) {
    vec3 a_center = f->a->inner.center, b_center = f->b->inner.center, b_in_a = frame_b(f, b_center);
    vec3 between = vec3_sub(b_in_a, a_center);
    body_ray a = {s->areas[0], &f->a->outer, a_center, vec3_sub(inner->point_a, a_center), between};
    body_ray b = {s->areas[1], &f->b->outer, b_center,
                  mat3_mul_transposed_vec3(f->rotation, vec3_sub(inner->point_b, b_in_a)),
                  mat3_mul_transposed_vec3(f->rotation, vec3_neg(between))};
    vec3 q1, p1, q2, p2;
    r->faces = find_exits(&a, s->rule, &q1, &p1) + find_exits(&b, s->rule, &q2, &p2);
    q2 = frame_b(f, q2);
    p2 = frame_b(f, p2);

    // The criterion. Exits that have passed each other along the way from X* to Y* say "collides" as well.
    vec3 offset = vec3_sub(q2, q1);
    double gap = vec3_norm(offset), p1q1 = vec3_norm(vec3_sub(q1, p1)), p2q2 = vec3_norm(vec3_sub(q2, p2));
    int has_passed = inner->overlap || !(vec3_dot(offset, vec3_sub(inner->point_b, inner->point_a)) > 0);
    r->collides = has_passed || !(gap > fmin(fmin(p1q1, p2q2), s->threshold));
    r->upper = fmax((inner->overlap ? 0 : gap) - f->upper_radii, 0);
    r->q1 = frame_point_to_world(f, q1);
    r->q2 = frame_point_to_world(f, q2);
    r->p1 = frame_point_to_world(f, p1);
    r->p2 = frame_point_to_world(f, p2);
}

static ovoid_paper_bounds compute_bounds(const ovoid_pair *pair, const study *s) {
    ovoid_paper_bounds r = {.lower = -INFINITY, .upper = INFINITY};
    pair_frame f;
    if (frame_make(pair, &f) != OVOID_LIMIT_NONE) return r;

    const ovoid_ellipsoid *a = &f.a->inner;
    ovoid_ellipsoid b = {frame_b(&f, f.b->inner.center), sym3_rotate(f.b->inner.q, f.rotation)};
    ovoid_nearest inner = ovoid_ellipsoid_compute_nearest_by_sphere(a, &b);
    r.lower = find_lower(&f);
    find_upper(&r, &f, &inner, s);

    r.nearest = inner;
    r.nearest.point_a = frame_point_to_world(&f, inner.point_a);
    r.nearest.point_b = frame_point_to_world(&f, inner.point_b);
    r.nearest.normal = frame_direction_to_world(&f, inner.normal);
    return r;
}

ovoid_paper_bounds ovoid_paper_compute_bounds(const ovoid_pair *pair, const ovoid_areas *areas[2], ovoid_area_rule rule,
                                              double threshold) {
    study s = {areas, rule, threshold};
    ENVIRONMENT_RETURN(ovoid_paper_bounds, s, compute_bounds(pair, &s));
}
