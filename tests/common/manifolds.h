// What is true of a contact, found without its proof: by the depth query, and by the distance of each point from each
// body.
#ifndef OVOID_TESTS_MANIFOLDS_H
#define OVOID_TESTS_MANIFOLDS_H

#include "check.h"
#include "linear/vec3.h"
#include "ovoid/ovoid.h"

/// A contact with what it was asked by.
typedef struct asked_manifold {
    ovoid_pair pair;
    ovoid_manifold_options options;
    ovoid_manifold manifold;
    ovoid_answer truth; ///< of ovoid_depth
    double size;        ///< of both bodies and what is between them
} asked_manifold;

static inline double size_of_pair(const ovoid_pair *p) {
    ovoid_measures a = ovoid_shape_get_measures(p->shape_a), b = ovoid_shape_get_measures(p->shape_b);
    ovoid_vec3 oa = ovoid_shape_get_polytope(p->shape_a).origin, ob = ovoid_shape_get_polytope(p->shape_b).origin;
    return a.sphere_radius + b.sphere_radius + vec3_norm(a.sphere_center) + vec3_norm(b.sphere_center) +
           vec3_norm(vec3_sub(p->pose_b.position, p->pose_a.position)) + vec3_norm(oa) + vec3_norm(ob) +
           ovoid_shape_get_radius(p->shape_a) + ovoid_shape_get_radius(p->shape_b);
}

/// Moves B along a random direction, by less than `far`, until the bodies are about so far apart; `want` is negative
/// for an overlap.
static inline void place_at_distance(ovoid_pair *pair, double want, double far, uint64_t *s) {
    vec3 d = vec3_unit((vec3){random_normal(s), random_normal(s), random_normal(s)});
    double near = 0;
    for (int k = 0; k < 30; k++) {
        double middle = (near + far) / 2;
        pair->pose_b.position = vec3_scale(d, middle);
        if (ovoid_depth(pair, NULL, NULL, NULL).lower > want)
            far = middle;
        else
            near = middle;
    }
}

/// How far a point is from a body, 0 inside; by a search of its own.
static inline double distance_of_point(const ovoid_shape *shape, const ovoid_pose *pose, ovoid_vec3 point) {
    static ovoid_shape *dot;
    ovoid_error error;
    if (!dot) dot = ovoid_shape_create_sphere(0, NULL, &error);
    ovoid_pair pair = {shape, dot, *pose, {point, {1, 0, 0, 0}}};
    ovoid_answer answer = ovoid_distance(&pair, NULL, NULL);
    return answer.upper > 0 ? answer.lower : 0;
}

/// The least separation of points.
static inline double find_deepest(const ovoid_manifold_point *points, uint32_t count) {
    double least = INFINITY;
    for (uint32_t i = 0; i < count; i++) least = fmin(least, points[i].separation);
    return least;
}

/// NULL, or a claim that is not true of the points.
static inline const char *find_lie_of_points(const asked_manifold *q, double slack) {
    const ovoid_manifold *m = &q->manifold;
    ovoid_manifold_points p = ovoid_manifold_compute_points(&q->pair, m);
    static ovoid_manifold_polygon polygon;
    if (p.count != m->count) return "points";
    // A corner is outside of the other facet by at most `keep` or the snap, across a normal that is steep by at
    // most 8.4.
    int is_corner = p.count && (p.points[0].id & OVOID_MANIFOLD_KIND) != OVOID_MANIFOLD_ID_NEAREST;
    if (is_corner && !(p.grown <= 8.4 * fmax(q->options.keep, 1e-6 * q->size) + slack)) return "points off the bodies";
    for (uint32_t i = 0; i < p.count; i++) {
        const ovoid_manifold_point *x = p.points + i;
        vec3 off = vec3_sub(vec3_sub(x->point_b, x->point_a), vec3_scale(m->normal, x->separation));
        if (!(vec3_norm(off) <= slack)) return "points along the normal";
        if (!(distance_of_point(q->pair.shape_a, &q->pair.pose_a, x->point_a) <= p.grown + slack)) return "point of A";
        if (!(distance_of_point(q->pair.shape_b, &q->pair.pose_b, x->point_b) <= p.grown + slack)) return "point of B";
        int is_nearest = (x->id & OVOID_MANIFOLD_KIND) == OVOID_MANIFOLD_ID_NEAREST;
        if (!is_nearest && x->separation > q->options.margin + slack) return "a point beyond the margin";
        if (!(x->separation >= m->lower - slack)) return "a point deeper than the bodies";
        for (uint32_t k = 0; k < i; k++)
            if (p.points[k].id == x->id) return "ids";
    }
    // The deepest corner is among the points, to 1e-6 of the size, which corners that are one differ by; kept points
    // may be a tenth of the tolerance less deep.
    if (ovoid_manifold_compute_polygon(&q->pair, m, &q->options, &polygon) != OVOID_OK) return "the polygon";
    double room = 4e-6 * q->size + 0.1 * q->options.tolerance;
    if (!(find_deepest(p.points, p.count) <= find_deepest(polygon.points, polygon.count) + room)) return "the deepest";
    return NULL;
}

/// NULL, or a claim that is not true. Rounding that the test's own measurements cannot see is 1e-11 of the size.
/// Whether status and limit follow from the bracket is looked at for the default tolerance, or the options'.
static inline const char *find_lie(const asked_manifold *q) {
    const ovoid_manifold *m = &q->manifold;
    double slack = 1e-11 * q->size + 0x1p-50 * vec3_norm(q->pair.pose_a.position),
           tolerance = fmax(q->options.tolerance, q->options.tolerance > 0 ? 0 : 2e-9 * q->size);
    double inside =
        ovoid_shape_get_allowance(q->pair.shape_a).inside + ovoid_shape_get_allowance(q->pair.shape_b).inside;
    double outside =
        ovoid_shape_get_allowance(q->pair.shape_a).outside + ovoid_shape_get_allowance(q->pair.shape_b).outside;
    if (!(m->lower <= q->truth.upper)) return "lower";
    if (!(m->upper >= q->truth.lower)) return "upper";
    if (!(fabs(vec3_norm(m->normal) - 1) <= 1e-11)) return "length of the normal";
    if (!(ovoid_pair_compute_gap(&q->pair, m->normal) >= m->lower - slack)) return "normal";
    ovoid_status status = m->lower > 0                       ? OVOID_SEPARATED
                          : m->upper < 0                     ? OVOID_OVERLAPPING
                          : m->upper - m->lower <= tolerance ? OVOID_TOUCHING
                                                             : OVOID_UNDECIDED;
    if (m->status != status && !(status == OVOID_TOUCHING && m->status == OVOID_UNDECIDED)) return "status";
    if (m->limit == OVOID_LIMIT_NONE && !(m->upper - m->lower <= tolerance + inside + outside + slack)) return "limit";
    if (m->axis == OVOID_MANIFOLD_NONE) return m->count || m->lower <= q->options.margin ? "no contact" : NULL;
    return find_lie_of_points(q, slack);
}

static inline asked_manifold ask_manifold(const ovoid_pair *pair, const ovoid_manifold_options *options,
                                          const ovoid_manifold *earlier) {
    asked_manifold q = {.pair = *pair, .options = *options};
    q.manifold = ovoid_manifold_find(pair, options, earlier);
    q.truth = ovoid_depth(pair, NULL, NULL, NULL);
    q.size = size_of_pair(pair);
    return q;
}

/// Checks that all that a contact claims is true, and that the verifier says so.
static inline void check_manifold(const asked_manifold *q) {
    ovoid_error error = {OVOID_OK, -1, ""};
    const char *lie = find_lie(q);
    if (!CHECK(!lie)) printf("  %s\n", lie);
    if (!CHECK_EQ(ovoid_manifold_verify(&q->pair, &q->manifold, &q->options, &error), OVOID_OK))
        printf("  %s\n", error.message);
}

// ---- solids, by brute force over all triangles

static inline void solid_read_triangle(const ovoid_solid *s, size_t i, vec3 corner[3]) {
    uint32_t points[3];
    ovoid_solid_get_triangle(s, i, points);
    for (int k = 0; k < 3; k++) corner[k] = vec3_at(ovoid_solid_get_points(s), points[k]);
}

/// The nearest point of a triangle, by projection on its plane and its edges.
static inline vec3 triangle_find_nearest(const vec3 c[3], vec3 x) {
    vec3 n = vec3_unit(vec3_cross(vec3_sub(c[1], c[0]), vec3_sub(c[2], c[0])));
    vec3 best = vec3_add_scaled(x, n, -vec3_dot(n, vec3_sub(x, c[0])));
    int is_inside = 1;
    for (int i = 0; i < 3; i++)
        is_inside &= vec3_dot(vec3_cross(vec3_sub(c[(i + 1) % 3], c[i]), vec3_sub(best, c[i])), n) >= 0;
    if (is_inside) return best;
    double least = INFINITY;
    for (int i = 0; i < 3; i++) {
        vec3 d = vec3_sub(c[(i + 1) % 3], c[i]);
        double t = vec3_dot(d, vec3_sub(x, c[i])) / vec3_norm_squared(d);
        vec3 p = vec3_add_scaled(c[i], d, t < 0 ? 0 : t > 1 ? 1 : t);
        double distance = vec3_norm(vec3_sub(p, x));
        if (distance < least) least = distance, best = p;
    }
    return best;
}

static inline double solid_measure_distance(const ovoid_solid *s, vec3 x) {
    double least = INFINITY;
    vec3 c[3];
    for (size_t i = 0; i < ovoid_solid_get_report(s).triangles; i++) {
        solid_read_triangle(s, i, c);
        least = fmin(least, vec3_norm(vec3_sub(triangle_find_nearest(c, x), x)));
    }
    return least;
}

/// By how much the steepest way from a point along the triangles that hold it rises along a direction: the sine of its
/// angle; at most 0 where the point is a top.
static inline double solid_measure_rise(const ovoid_solid *s, vec3 x, vec3 up, double near) {
    double most = -1;
    vec3 c[3];
    for (size_t i = 0; i < ovoid_solid_get_report(s).triangles; i++) {
        solid_read_triangle(s, i, c);
        if (vec3_norm(vec3_sub(triangle_find_nearest(c, x), x)) > near) continue;
        for (int k = 0; k < 3; k++) {
            vec3 d = vec3_sub(c[k], x);
            if (vec3_norm(d) > 10 * near) most = fmax(most, vec3_dot(vec3_unit(d), up));
        }
    }
    return most;
}

#endif
