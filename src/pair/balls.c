// Theorem. If the ball of radius r about a is in A and that of radius s about b is in B, the ball of radius r + s about
// b - a is in the difference B - A, so that the signed distance is at most |b - a| - r - s. Where r is negative and a
// point of A is within -r of a, the bound holds as well, by the triangle inequality.
//
// In the half plane of the distance from the axis and the height z, a cylinder is a rectangle and a cone a triangle.
// The largest ball about a point inside reaches to the nearest side. A point outside is no farther from the body than
// from the point that it becomes when its height, then its distance from the axis is cut off at the body.
//
// A ball of radius r about c is in an ellipsoid with half axes a_i if and only if, for some m from 0 to the least
// a_i^2,
//     r^2 <= m (1 - sum c_i^2 / (a_i^2 - m)):
// the quadratic form 1 - sum x_i^2 / a_i^2 is then at least (r^2 - |x - c|^2) / m for every x. (S-lemma: V. A.
// Yakubovich, S-procedure in nonlinear control theory, 1971.) So each m shows a ball. The right side is concave and is
// largest where g(m) = sum a_i^2 c_i^2 / (a_i^2 - m)^2 is 1; Newton's steps from above, along the convex g, end there.
#include "pair/balls.h"

#include "linear/nearest.h"

enum { BALL_STEPS = 40 };

static double square(double x) { return x * x; }

// Where no term of g is above 1: there the sum is 1 or more, unless the centre is that of the ellipsoid.
static double find_multiplier_above(vec3 a, vec3 c) {
    double x = a.x * (a.x - fabs(c.x)), y = a.y * (a.y - fabs(c.y)), z = a.z * (a.z - fabs(c.z));
    return min2(x, min2(y, z));
}

// A term of the sum in r^2, and with it that of g and of the slope of g. Where c is zero, all are.
typedef struct ball_sums {
    double value, g, slope;
} ball_sums;

static void add_term(ball_sums *sums, double a, double c, double m) {
    if (!(fabs(c) > 0)) return;
    double part = c / (a * a - m), term = a * part;
    sums->value += c * part;
    sums->g += term * term;
    sums->slope += 2 * (term * term) / (a * a - m);
}

static ball_sums find_sums(vec3 a, vec3 c, double m) {
    ball_sums sums = {0, 0, 0};
    add_term(&sums, a.x, c.x, m);
    add_term(&sums, a.y, c.y, m);
    add_term(&sums, a.z, c.z, m);
    return sums;
}

static vec3 cut_off_at_ellipsoid(vec3 a, vec3 c) {
    double part = sqrt(square(c.x / a.x) + square(c.y / a.y) + square(c.z / a.z));
    return part > 1 ? vec3_scale(c, (1 - 8 * ROUNDING) / part) : c;
}

// Rounding: a^2 - m is off by u a^2 beside its own rounding, so that a term is off by 4 u of itself and u of that of g.
// While g is at most 2, the sum is off by less than 8 u, and the radius by less than 16 u of the largest half axis.
static double find_room_in_ellipsoid(vec3 a, vec3 c) {
    double m = find_multiplier_above(a, c);
    if (!(m > 0)) return -1;
    ball_sums sums = find_sums(a, c, m);
    for (int i = 0; i < BALL_STEPS && sums.g > 1 + 0x1p-30; i++) {
        m = max2(m - (sums.g - 1) / sums.slope, 0);
        sums = find_sums(a, c, m);
    }
    double rest = 1 - sums.value - 16 * ROUNDING;
    return sums.g <= 2 && rest > 0 ? sqrt(m * rest) * (1 - 4 * ROUNDING) : -1;
}

// The distance from the axis to the side at a height from -half to half.
static double find_width(const ovoid_round *round, double z) {
    if (round->kind == OVOID_ROUND_CYLINDER || !(round->half_length > 0)) return round->radius;
    return round->radius * (0.5 - 0.5 * (z / round->half_length));
}

static double find_room_in_round(const ovoid_round *round, vec3 v) {
    if (round->kind == OVOID_ROUND_ELLIPSOID) return find_room_in_ellipsoid(round->half_axes, v);
    double half = round->half_length, inward = round->radius - vec3_norm((vec3){v.x, v.y, 0});
    if (round->kind == OVOID_ROUND_CYLINDER) return min2(inward, half - fabs(v.z));
    vec3 side = vec3_unit((vec3){2 * half, round->radius, 0});
    return min2(half + v.z, side.x * inward - side.y * (half + v.z));
}

static vec3 cut_off_at_round(const ovoid_round *round, vec3 v) {
    if (round->kind == OVOID_ROUND_ELLIPSOID) return cut_off_at_ellipsoid(round->half_axes, v);
    double half = round->half_length, z = max2(-half, min2(half, v.z));
    double r = vec3_norm((vec3){v.x, v.y, 0}), width = find_width(round, z), part = r > width ? width / r : 1;
    return (vec3){v.x * part, v.y * part, z};
}

vec3 balls_cut_off(const ovoid_shape *s, vec3 x) {
    return vec3_sub(cut_off_at_round(&s->round, vec3_add(x, s->origin)), s->origin);
}

// The radius of the largest ball about x, in the body frame; of a body that is not round 0, as x is a point of it.
static double find_room(const ovoid_shape *s, vec3 x) {
    if (!shape_is_round(s)) return 0;
    double room = find_room_in_round(&s->round, vec3_add(x, s->origin));
    return room >= 0 ? room : -vec3_norm(vec3_sub(balls_cut_off(s, x), x));
}

// A centre far away would have a greater error.
static int is_near(const pair_frame *f, vec3 x) { return vec3_is_finite(x) && vec3_max_abs(x) <= f->size; }

double balls_measure(const pair_frame *f, const ball_centers *c, double error) {
    if (!is_near(f, c->a) || !is_near(f, c->b)) return INFINITY;
    return vec3_norm(vec3_sub(frame_b(f, c->b), c->a)) - find_room(f->a, c->a) - find_room(f->b, c->b) + error;
}

static double find_radius(const ovoid_shape *s) { return shape_is_round(s) ? s->radius : s->upper_radius; }

double balls_compute_radii(const pair_frame *f) { return find_radius(f->a) + find_radius(f->b); }

static vec3 find_mean(const ovoid_shape *s, const uint32_t *v, const double *w, uint32_t count) {
    vec3 sum = {0, 0, 0};
    double all = 0;
    for (uint32_t i = 0; i < count; i++) {
        sum = vec3_add_scaled(sum, shape_get_vertex(s, v[i]), w[i]);
        all += w[i];
    }
    return vec3_scale(sum, 1 / all);
}

ball_centers balls_find_centers(const pair_frame *f, const ovoid_proof *p) {
    ball_centers c = {p->inner_a, p->inner_b};
    if (!shape_is_round(f->a)) c.a = find_mean(f->a, p->a, p->weight_a, p->count);
    if (!shape_is_round(f->b)) c.b = find_mean(f->b, p->b, p->weight_b, p->count);
    return c;
}

double balls_compute_upper(const pair_frame *f, const ovoid_proof *p, double error) {
    int are_round = shape_is_round(f->a) & shape_is_round(f->b);
    if (!frame_has_round(f) || (!are_round && p->count == 0)) return INFINITY;
    ball_centers c = balls_find_centers(f, p);
    return balls_measure(f, &c, error) - balls_compute_radii(f);
}

witness_points balls_compute_points(const pair_frame *f, const ovoid_proof *p) {
    ball_centers c = balls_find_centers(f, p);
    double reach_a = f->a->radius + find_room(f->a, c.a), reach_b = f->b->radius + find_room(f->b, c.b);
    vec3 b = frame_b(f, c.b), d = vec3_sub(b, c.a), n = vec3_unit(frame_direction_from_world(f, p->normal));
    if (nearest_takes_difference(vec3_norm(d), max2(0, reach_a + reach_b))) n = vec3_unit(d);
    return (witness_points){vec3_add_scaled(c.a, n, reach_a), vec3_add_scaled(b, n, -reach_b)};
}
