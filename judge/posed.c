// Posed shapes in exact arithmetic: the rational pose, its points, supports over every vertex.
#include "posed.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

static int is_length(double x) { return isfinite(x) && fabs(x) <= OVOID_LENGTH_MAX; }

int judge_is_pose_valid(const ovoid_pose *pose) {
    ovoid_quat q = pose->rotation;
    return is_length(pose->position.x) && is_length(pose->position.y) && is_length(pose->position.z) && isfinite(q.w) &&
           isfinite(q.x) && isfinite(q.y) && isfinite(q.z) && (q.w != 0 || q.x != 0 || q.y != 0 || q.z != 0);
}

// |q|^2 and the rows of |q|^2 R(q).
static void set_rotation(pool *p, body *b, ovoid_quat q) {
    num w = number_from(p, q.w), x = number_from(p, q.x), y = number_from(p, q.y), z = number_from(p, q.z);
    num ww = num_mul(p, w, w), xx = num_mul(p, x, x), yy = num_mul(p, y, y), zz = num_mul(p, z, z);
    num xy = num_scaled(p, num_mul(p, x, y), 1), xz = num_scaled(p, num_mul(p, x, z), 1),
        yz = num_scaled(p, num_mul(p, y, z), 1);
    num wx = num_scaled(p, num_mul(p, w, x), 1), wy = num_scaled(p, num_mul(p, w, y), 1),
        wz = num_scaled(p, num_mul(p, w, z), 1);
    num plus = num_add(p, ww, xx), minus = num_sub(p, ww, xx), sum = num_add(p, yy, zz),
        difference = num_sub(p, yy, zz);
    b->rows[0] = (nvec){num_trimmed(p, num_sub(p, plus, sum)), num_sub(p, xy, wz), num_add(p, xz, wy)};
    b->rows[1] = (nvec){num_add(p, xy, wz), num_trimmed(p, num_add(p, minus, difference)), num_sub(p, yz, wx)};
    b->rows[2] = (nvec){num_sub(p, xz, wy), num_add(p, yz, wx), num_trimmed(p, num_sub(p, minus, difference))};
    b->n = num_trimmed(p, num_add(p, plus, sum));
}

static double sum_abs(ovoid_vec3 v) { return fabs(v.x) + fabs(v.y) + fabs(v.z); }

double judge_find_extent(const ovoid_polytope *polytope) {
    double extent = 0;
    for (uint32_t i = 0; i < polytope->vertex_count; i++) {
        const double *v = polytope->vertices + 3 * (size_t)i;
        extent = fmax(extent, hypot(hypot(v[0], v[1]), v[2]));
    }
    return extent;
}

body body_make_hull(pool *p, const ovoid_polytope *polytope, const ovoid_pose *pose) {
    body b = {.shape = NULL, .polytope = *polytope};
    set_rotation(p, &b, pose->rotation);
    b.position = nvec_from(p, pose->position);
    b.origin = nvec_from(p, b.polytope.origin);
    b.radius = b.outside = b.inside = b.across = number_from_integer(p, 0);
    b.axis = nvec_zero(p);
    b.extent = judge_find_extent(&b.polytope);
    b.reach = sum_abs(pose->position) + sum_abs(b.polytope.origin) + b.extent;
    return b;
}

body body_make(pool *p, const ovoid_shape *shape, const ovoid_pose *pose) {
    ovoid_polytope polytope = ovoid_shape_get_polytope(shape);
    body b = body_make_hull(p, &polytope, pose);
    b.shape = shape;
    b.radius = number_from(p, ovoid_shape_get_radius(shape));
    ovoid_allowance allowance = ovoid_shape_get_allowance(shape);
    b.inside = number_from(p, allowance.inside);
    b.axis = nvec_from(p, allowance.axis);
    ovoid_round round = ovoid_shape_get_round(shape);
    b.round = round.kind;
    // What a true body's polyhedron leaves out is no part of its bounds.
    if (!nvec_is_zero(b.axis))
        b.across = number_from(p, allowance.outside);
    else if (round.kind == OVOID_ROUND_NONE)
        b.outside = number_from(p, allowance.outside);
    b.round_radius = number_from(p, round.radius);
    b.half_length = number_from(p, round.half_length);
    b.half_axes = round.half_axes;
    return b;
}

posed posed_make(pool *p, const ovoid_pair *pair) {
    return posed_join(p, body_make(p, pair->shape_a, &pair->pose_a), body_make(p, pair->shape_b, &pair->pose_b));
}

posed posed_join(pool *p, body a, body b) {
    posed s = {.p = p, .a = a, .b = b};
    s.k = num_mul(p, s.a.n, s.b.n);
    s.radii = num_add(p, s.a.radius, s.b.radius);
    s.outside = num_add(p, s.a.outside, s.b.outside);
    s.inside = num_add(p, s.a.inside, s.b.inside);
    num outside = num_add(p, s.outside, num_add(p, s.a.across, s.b.across));
    s.allowed = num_to_double(outside) + 2 * num_to_double(s.inside);
    // The frames' distance: exact difference, rounded.
    nvec t = posed_difference(&s, body_point(p, &s.a, nvec_zero(p)), body_point(p, &s.b, nvec_zero(p)));
    num square = num_quotient_below(p, nvec_norm_squared(p, t), num_mul(p, s.k, s.k), 60);
    s.size = sqrt(num_to_double(square)) + s.a.extent + s.b.extent + num_to_double(s.radii);
    return s;
}

nvec body_rotate(pool *p, const body *b, nvec v) {
    return (nvec){nvec_dot(p, b->rows[0], v), nvec_dot(p, b->rows[1], v), nvec_dot(p, b->rows[2], v)};
}

nvec body_rotate_back(pool *p, const body *b, nvec v) {
    nvec x = nvec_scale(p, b->rows[0], v.x), y = nvec_scale(p, b->rows[1], v.y), z = nvec_scale(p, b->rows[2], v.z);
    return nvec_add(p, nvec_add(p, x, y), z);
}

nvec body_point(pool *p, const body *b, nvec local) {
    nvec user = nvec_add(p, b->origin, local);
    return nvec_add(p, nvec_scale(p, b->position, b->n), body_rotate(p, b, user));
}

static nvec vertex_at(pool *p, const ovoid_polytope *polytope, uint32_t i) {
    const double *v = polytope->vertices + 3 * (size_t)i;
    return nvec_from(p, (ovoid_vec3){v[0], v[1], v[2]});
}

enum { GRID_STEPS = 23169, GRID_SIDE = 2 * GRID_STEPS + 1 };

// The point of an ellipsoid that a proof's number names, by the operations in doubles that query.h defines it by.
static ovoid_vec3 find_grid_point(ovoid_vec3 half, uint32_t place) {
    int i = (int)(place / GRID_SIDE) - GRID_STEPS, j = (int)(place % GRID_SIDE) - GRID_STEPS;
    int z = GRID_STEPS - abs(i) - abs(j), x = i, y = j;
    if (z < 0) {
        x = (i < 0 ? -1 : 1) * (GRID_STEPS - abs(j));
        y = (j < 0 ? -1 : 1) * (GRID_STEPS - abs(i));
    }
    double l = sqrt((double)x * x + (double)y * y + (double)z * z);
    return (ovoid_vec3){half.x * (x / l), half.y * (y / l), half.z * (z / l)};
}

static ovoid_vec3 move_by_origin(const body *b, ovoid_vec3 v) {
    ovoid_vec3 origin = b->polytope.origin;
    return (ovoid_vec3){v.x - origin.x, v.y - origin.y, v.z - origin.z};
}

// The point of a rim that a proof's number names, by the operations in doubles that query.h defines it by.
static ovoid_vec3 find_rim_point(const body *b, uint32_t i) {
    if (b->round == OVOID_ROUND_ELLIPSOID) return move_by_origin(b, find_grid_point(b->half_axes, i & 0x7fffffffu));
    ovoid_round round = ovoid_shape_get_round(b->shape);
    double t = (double)(i & 0xfffffff) / 0x1p28, part = round.radius / (1 + t * t);
    double v[2] = {(1 - t * t) * part, 2 * t * part};
    for (uint32_t quarter = i >> 28 & 3; quarter; quarter--) {
        double x = v[0];
        v[0] = -v[1];
        v[1] = x;
    }
    double z = i & 0x40000000u ? round.half_length : -round.half_length;
    return move_by_origin(b, (ovoid_vec3){v[0], v[1], z});
}

int body_has_vertex(const body *b, uint32_t i) {
    if (i < b->polytope.vertex_count) return 1;
    if (!(i >> 31)) return 0;
    switch (b->round) {
    case OVOID_ROUND_CYLINDER: return 1;
    case OVOID_ROUND_CONE: return !(i & 0x40000000u);
    case OVOID_ROUND_ELLIPSOID: return (i & 0x7fffffffu) < (uint32_t)GRID_SIDE * GRID_SIDE;
    default: return 0;
    }
}

nvec body_vertex(pool *p, const body *b, uint32_t i) {
    return body_point(p, b, i >> 31 ? nvec_from(p, find_rim_point(b, i)) : vertex_at(p, &b->polytope, i));
}

// A direction in doubles, its largest part about 1, and the factor that scales vertices to at most 1, so that dot
// products of both are off by less than 2^-48 (each part by a rounding of 2^-52, three products and two sums).
#define COARSE_ERROR 0x1p-48
typedef struct coarse {
    double x, y, z, unit;
} coarse;

static coarse coarse_make(pool *p, const body *b, nvec direction, int side) {
    const num parts[3] = {direction.x, direction.y, direction.z};
    double out[3];
    long top = LONG_MIN;
    for (int i = 0; i < 3; i++)
        if (num_sign(parts[i]) != 0 && num_get_exponent(parts[i]) > top) top = num_get_exponent(parts[i]);
    for (int i = 0; i < 3; i++) out[i] = num_sign(parts[i]) ? side * num_to_double(num_scaled(p, parts[i], -top)) : 0;
    int e = 0;
    (void)frexp(b->extent, &e);
    // All vertices of a tiny body count as about equally far.
    return (coarse){out[0], out[1], out[2], ldexp(1, e > -1000 ? -e : 1000)};
}

static double coarse_dot(const coarse *c, const double *v) {
    return c->x * (v[0] * c->unit) + c->y * (v[1] * c->unit) + c->z * (v[2] * c->unit);
}

// |M'direction x axis| is n |direction x R axis|, R the rotation: over |axis|, which is 1 to rounding only.
num body_find_across(pool *p, const body *b, nvec direction) {
    enum { BITS = 240 };
    if (num_sign(b->across) == 0 || b->round != OVOID_ROUND_NONE) return number_from_integer(p, 0);
    nvec across = nvec_cross(p, body_rotate_back(p, b, direction), b->axis);
    num square = num_quotient_below(p, nvec_norm_squared(p, across), nvec_norm_squared(p, b->axis), BITS);
    num above = num_add(p, square, num_scaled(p, square, 1 - BITS));
    return num_mul(p, b->across, num_root_above(p, above, BITS));
}

static num find_top(pool *p, const body *b, nvec direction, int side) {
    slot best = slot_make(p);
    // In the body frame the direction is M' direction. Vertices are compared there: first in doubles, and exactly only
    // if these do not show that another vertex is farther.
    nvec local = body_rotate_back(p, b, direction);
    const double *vertices = b->polytope.vertices;
    coarse c = coarse_make(p, b, local, side);
    double most = -INFINITY;
    int is_first = 1;
    for (uint32_t i = 0; i < b->polytope.vertex_count; i++) most = fmax(most, coarse_dot(&c, vertices + 3 * (size_t)i));
    for (uint32_t i = 0; i < b->polytope.vertex_count; i++) {
        if (coarse_dot(&c, vertices + 3 * (size_t)i) < most - 2 * COARSE_ERROR) continue;
        size_t mark = pool_get_mark(p);
        num value = nvec_dot(p, local, vertex_at(p, &b->polytope, i));
        if (is_first || num_compare(p, value, best) * side > 0) slot_set(best, value);
        is_first = 0;
        pool_release(p, mark);
    }
    num at_position = num_mul(p, nvec_dot(p, direction, b->position), b->n);
    return num_add(p, num_add(p, at_position, nvec_dot(p, local, b->origin)), best);
}

// The squares of the parts of v times those of the half axes.
static num find_scaled_square(pool *p, const body *b, nvec v) {
    nvec half = nvec_from(p, b->half_axes);
    return nvec_norm_squared(p, (nvec){num_mul(p, v.x, half.x), num_mul(p, v.y, half.y), num_mul(p, v.z, half.z)});
}

// An upper bound of what a round body around the origin of the user's frame reaches along the direction, or against
// it, times n |direction|: with z along the axis and r across, of a cylinder h |z| + R r, of a cone the larger of h z
// and R r - h z; of an ellipsoid the length of the direction times its half axes.
static num find_round_top(pool *p, const body *b, nvec direction, int side) {
    enum { BITS = 240 };
    nvec local = body_rotate_back(p, b, direction);
    if (b->round == OVOID_ROUND_ELLIPSOID) return num_root_above(p, find_scaled_square(p, b, local), BITS);
    num z = num_mul(p, b->half_length, side > 0 ? local.z : num_neg(p, local.z));
    num square = num_add(p, num_mul(p, local.x, local.x), num_mul(p, local.y, local.y));
    num rim = num_mul(p, b->round_radius, num_root_above(p, square, BITS));
    if (b->round == OVOID_ROUND_CYLINDER) return num_add(p, num_sign(z) < 0 ? num_neg(p, z) : z, rim);
    num base = num_sub(p, rim, z);
    return num_compare(p, base, z) > 0 ? base : z;
}

// ---- balls in ellipsoids
//
// The ball of radius r about c is in the ellipsoid if r^2 <= m (1 - sum c_i^2 / (a_i^2 - m)) for some m from 0 to the
// least a_i^2 (S-lemma). m is sought in doubles, where the derivative's sum of a_i^2 c_i^2 / (a_i^2 - m)^2 becomes 1,
// and any m is as true.

static double compute_slope_sum(const double *a, const double *c, double m) {
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        double part = c[i] == 0 ? 0 : a[i] * c[i] / (a[i] * a[i] - m);
        sum += part * part;
    }
    return sum;
}

static double find_multiplier(const double *a, const double *c) {
    double low = 0, high = INFINITY;
    for (int i = 0; i < 3; i++) high = fmin(high, a[i] * (a[i] - fabs(c[i])));
    if (!(high > 0)) return 0;
    if (compute_slope_sum(a, c, high) <= 1) return high * (1 - 0x1p-50);
    for (int i = 0; i < 100; i++) {
        double middle = low + (high - low) / 2;
        *(compute_slope_sum(a, c, middle) < 1 ? &low : &high) = middle;
    }
    return low;
}

// The sum of v_i^2 / (a_i^2 - m) from above.
static num find_quotients_above(pool *p, const body *b, nvec v, num m) {
    const num part[3] = {v.x, v.y, v.z};
    const double half[3] = {b->half_axes.x, b->half_axes.y, b->half_axes.z};
    num sum = number_from_integer(p, 0);
    for (int i = 0; i < 3; i++) {
        num a = number_from(p, half[i]), below = num_sub(p, num_mul(p, a, a), m);
        num least = num_quotient_below(p, num_neg(p, num_mul(p, part[i], part[i])), below, 240);
        sum = num_sub(p, sum, least);
    }
    return sum;
}

// n times the distance of a point outside from the point of the surface on its line to the centre: with t^2 the sum of
// (v_i / a_i)^2, |v| (t - 1) / t. local is nn v.
static num find_way_out(pool *p, const body *b, nvec local, num nn) {
    enum { BITS = 240 };
    num zero = number_from_integer(p, 0), square = find_quotients_above(p, b, local, zero);
    num t = num_root_above(p, square, BITS), beyond = num_sub(p, t, nn);
    if (num_sign(beyond) <= 0) return zero;
    num far = num_mul(p, num_root_above(p, nvec_norm_squared(p, local), BITS), beyond);
    return num_neg(p, num_quotient_below(p, num_neg(p, far), num_mul(p, nn, b->n), BITS));
}

// local is nn v, v the ball's centre in the ellipsoid's frame.
static num find_ellipsoid_room(pool *p, const body *b, nvec local) {
    enum { BITS = 240 };
    num nn = num_mul(p, b->n, b->n);
    const num part[3] = {local.x, local.y, local.z};
    const double half[3] = {b->half_axes.x, b->half_axes.y, b->half_axes.z};
    double c[3];
    for (int i = 0; i < 3; i++) c[i] = num_to_double(num_quotient_below(p, part[i], nn, 64));
    double multiplier = find_multiplier(half, c);
    num m = number_from(p, multiplier), rest = num_mul(p, nn, nn);
    if (multiplier > 0) {
        rest = num_sub(p, rest, find_quotients_above(p, b, local, m));
        if (num_sign(rest) > 0) return num_quotient_below(p, num_root_below(p, num_mul(p, m, rest), BITS), b->n, BITS);
    }
    return num_neg(p, find_way_out(p, b, local, nn));
}

// n lengths along the axis, z, and across it, r. Inside: the nearest side. Outside: the point's z is cut off at the
// ends, then its r at the side.
num body_find_room(pool *p, const body *b, nvec point) {
    enum { BITS = 240 };
    nvec local = nvec_sub(p, point, nvec_scale(p, b->position, b->n));
    local = body_rotate_back(p, b, local);
    if (b->round == OVOID_ROUND_ELLIPSOID) return find_ellipsoid_room(p, b, local);
    // M' (n x - n position) = n (n v): divided by n.
    num square = num_add(p, num_mul(p, local.x, local.x), num_mul(p, local.y, local.y)), nn = num_mul(p, b->n, b->n);
    num r = num_root_above(p, square, BITS), radius = num_mul(p, b->round_radius, nn),
        half = num_mul(p, b->half_length, nn), z = local.z, zero = number_from_integer(p, 0);
    num end = num_sign(z) < 0 ? num_neg(p, half) : half, over = num_sub(p, num_sign(z) < 0 ? num_neg(p, z) : z, half);
    num clipped = num_sign(over) > 0 ? end : z;
    // beyond = (r - width) factor, factor = 1 of cylinders and 2 half of cones with a height.
    int is_cone = b->round == OVOID_ROUND_CONE && num_sign(half) > 0;
    num factor = is_cone ? num_scaled(p, half, 1) : number_from_integer(p, 1);
    num width = is_cone ? num_mul(p, radius, num_sub(p, half, clipped)) : radius;
    num beyond = num_sub(p, num_mul(p, r, factor), width);
    if (num_sign(over) > 0 || num_sign(beyond) > 0) {
        num b2 = num_sign(beyond) > 0 ? num_mul(p, beyond, beyond) : zero, o = num_mul(p, over, factor);
        num o2 = num_sign(over) > 0 ? num_mul(p, o, o) : zero;
        num away = num_neg(p, num_root_above(p, num_add(p, b2, o2), BITS)), scale = num_mul(p, factor, b->n);
        return num_quotient_below(p, away, scale, BITS);
    }
    num to_end = is_cone ? num_add(p, half, z) : num_neg(p, over), to_side = num_neg(p, beyond);
    if (is_cone) {
        num slope = num_add(p, num_mul(p, factor, factor), num_mul(p, radius, radius));
        to_side = num_quotient_below(p, to_side, num_root_above(p, slope, BITS), BITS);
    }
    return num_quotient_below(p, num_compare(p, to_end, to_side) < 0 ? to_end : to_side, b->n, BITS);
}

num body_support(pool *p, const body *b, nvec direction, int side) {
    if (b->round != OVOID_ROUND_NONE) {
        num at_position = num_mul(p, nvec_dot(p, direction, b->position), b->n);
        num reach = find_round_top(p, b, direction, side);
        return side > 0 ? num_add(p, at_position, reach) : num_sub(p, at_position, reach);
    }
    num top = find_top(p, b, direction, side), across = body_find_across(p, b, direction);
    return side > 0 ? num_add(p, top, across) : num_sub(p, top, across);
}

nvec posed_difference(const posed *s, nvec xa, nvec xb) {
    return nvec_sub(s->p, nvec_scale(s->p, xb, s->a.n), nvec_scale(s->p, xa, s->b.n));
}

nvec posed_vertex_difference(const posed *s, uint32_t a, uint32_t b) {
    return posed_difference(s, body_vertex(s->p, &s->a, a), body_vertex(s->p, &s->b, b));
}
