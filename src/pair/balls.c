// Theorem. If the ball of radius r about a is in A and that of radius s about b is in B, the ball of radius r + s about
// b - a is in the difference B - A, so that the signed distance is at most |b - a| - r - s. Where r is negative and a
// point of A is within -r of a, the bound holds as well, by the triangle inequality.
//
// In the half plane of the distance from the axis and the height z, a cylinder is a rectangle and a cone a triangle.
// The largest ball about a point inside reaches to the nearest side. A point outside is no farther from the body than
// from the point that it becomes when its height, then its distance from the axis is cut off at the body.
#include "pair/balls.h"

// The distance from the axis to the side at a height from -half to half.
static double find_width(const ovoid_round *round, double z) {
    if (round->kind == OVOID_ROUND_CYLINDER || !(round->half_length > 0)) return round->radius;
    return round->radius * (0.5 - 0.5 * (z / round->half_length));
}

static double find_room_in_round(const ovoid_round *round, vec3 v) {
    double half = round->half_length, inward = round->radius - vec3_norm((vec3){v.x, v.y, 0});
    if (round->kind == OVOID_ROUND_CYLINDER) return min2(inward, half - fabs(v.z));
    vec3 side = vec3_unit((vec3){2 * half, round->radius, 0});
    return min2(half + v.z, side.x * inward - side.y * (half + v.z));
}

static vec3 cut_off_at_round(const ovoid_round *round, vec3 v) {
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
    // Where the centres are about as far apart as rounding radii reach, their difference is the better direction.
    if (vec3_norm(d) > 0.5 * max2(0, reach_a + reach_b)) n = vec3_unit(d);
    return (witness_points){vec3_add_scaled(c.a, n, reach_a), vec3_add_scaled(b, n, -reach_b)};
}
