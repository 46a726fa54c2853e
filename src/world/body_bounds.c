// A body's enclosing sphere and box, with bounds of rounding.
#include "world/body_bounds.h"

#include "compound/compound.h"
#include "linear/rotation.h"
#include "simd/support.h"
#include "solid/solid.h"

body_sphere body_compute_sphere(const ovoid_body *body) {
    const ovoid_shape *s = body->shape;
    if (body->compound) {
        // The pose of a part is the rounded product of two poses: off by 46 u of the extent (compound.h), and by a few
        // u of the position. Four times the extent covers it.
        const compound_node *root = &body->compound->nodes[0];
        return (body_sphere){root->center, root->radius, 0, 4 * body->compound->extent};
    }
    if (body->solid) return (body_sphere){body->solid->center, body->solid->reach, 0, body->solid->extent};
    vec3 local = vec3_add(s->origin, s->center);
    double size = vec3_max_abs(s->origin) + s->span + s->lower_radius;
    if (!shape_has_axis(s)) return (body_sphere){local, s->reach, s->lower_radius, size};
    // The excess of the true body across an axis turns with the body.
    return (body_sphere){local, nextafter(s->reach + s->allowance.outside, INFINITY), s->radius, size};
}

static double find_center_error(const body_sphere *ball, const ovoid_pose *pose) {
    return BODY_CENTER_ERROR * (vec3_max_abs(pose->position) + ball->size) + OVOID_LENGTH_MIN;
}

vec3 body_compute_center(const body_sphere *ball, const ovoid_pose *pose, double *center_error) {
    *center_error = find_center_error(ball, pose);
    return vec3_add(pose->position, mat3_mul_vec3(quat_to_mat3(pose->rotation), ball->local));
}

static int has_own_box(const ovoid_body *body) { return body->compound || body->solid; }

// The box around a compound's or a solid's own box, rotated; no larger than that of its enclosing sphere.
static box find_own_box(const ovoid_body *body, const body_sphere *ball, mat3 r, vec3 at, double center_error) {
    vec3 half;
    if (body->compound) {
        half = body->compound->nodes[0].half;
    } else {
        const box *b = &body->solid->report.box;
        half = vec3_scale(vec3_sub(b->max, b->min), 0.5);
    }
    double pad = center_error + 128 * 0x1p-53 * ball->reach + 4 * 0x1p-53 * vec3_max_abs(at);
    vec3 e = {min2(vec3_dot(vec3_abs(r.r0), half), ball->reach) + pad,
              min2(vec3_dot(vec3_abs(r.r1), half), ball->reach) + pad,
              min2(vec3_dot(vec3_abs(r.r2), half), ball->reach) + pad};
    return (box){vec3_sub(at, e), vec3_add(at, e)};
}

box body_compute_box(const ovoid_body *body, const body_sphere *ball) {
    const ovoid_shape *s = body->shape;
    mat3 r = quat_to_mat3(body->pose.rotation);
    double center_error, pad, radius;
    vec3 at = body_compute_center(ball, &body->pose, &center_error);
    if (has_own_box(body)) return find_own_box(body, ball, r, at, center_error);
    radius = s->lower_radius;
    pad = radius + center_error + 128 * 0x1p-53 * (s->extent + radius) + 4 * 0x1p-53 * vec3_max_abs(at);
    // The extent from r along a row of R: max and min over the vertices v of row.v - row.c. Dots are off by 42 u |v|
    // and 3 u |v|, v and c below the extent: the pad of 128 u is above it.
    simd_points points = shape_get_points(s);
    simd_extents e = simd_find_extents(&points, &r);
    vec3 c = mat3_mul_vec3(r, s->center);
    return (box){{at.x + (e.low[0] - c.x) - pad, at.y + (e.low[1] - c.y) - pad, at.z + (e.low[2] - c.z) - pad},
                 {at.x + (e.high[0] - c.x) + pad, at.y + (e.high[1] - c.y) + pad, at.z + (e.high[2] - c.z) + pad}};
}

static vec3 least(vec3 a, vec3 b) { return (vec3){min2(a.x, b.x), min2(a.y, b.y), min2(a.z, b.z)}; }
static vec3 most(vec3 a, vec3 b) { return (vec3){max2(a.x, b.x), max2(a.y, b.y), max2(a.z, b.z)}; }
static vec3 make_even(double x) { return (vec3){x, x, x}; }

// The box of the shape's vertices, with the middle m and half sizes h, turned: along a row of R it reaches to row.m +
// |row|.h. Entries of R are off by 12 u, the numbers of m and h below the extent: 36 u of it, and 12 u for the sums. m
// is at most as far from the frame's origin as the centre may be, so its place in the world is no worse.
static box find_turned_box(const ovoid_shape *s, mat3 r, vec3 position, double center_error) {
    const box *own = &s->measures.box;
    vec3 m = vec3_add(s->origin, vec3_scale(vec3_add(own->min, own->max), 0.5));
    vec3 h = vec3_scale(vec3_sub(own->max, own->min), 0.5), at = vec3_add(position, mat3_mul_vec3(r, m));
    double pad =
        s->lower_radius + center_error + 128 * 0x1p-53 * (s->extent + s->lower_radius) + 4 * 0x1p-53 * vec3_max_abs(at);
    vec3 e = {vec3_dot(vec3_abs(r.r0), h) + pad, vec3_dot(vec3_abs(r.r1), h) + pad, vec3_dot(vec3_abs(r.r2), h) + pad};
    return (box){vec3_sub(at, e), vec3_add(at, e)};
}

body_outline body_compute_outline(const ovoid_body *body, const body_sphere *ball) {
    mat3 r = quat_to_mat3(body->pose.rotation);
    double center_error = find_center_error(ball, &body->pose);
    vec3 at = vec3_add(body->pose.position, mat3_mul_vec3(r, ball->local));
    body_outline outline = {.at = at, .reach = (ball->reach + ball->radius) * (1 + 0x1p-48) + center_error};
    if (has_own_box(body)) {
        outline.bounds = find_own_box(body, ball, r, at, center_error);
        outline.is_tight = 1;
        return outline;
    }
    box turned = find_turned_box(body->shape, r, body->pose.position, center_error);
    double around = outline.reach + 4 * 0x1p-53 * vec3_max_abs(at);
    outline.bounds.min = most(turned.min, vec3_sub(at, make_even(around)));
    outline.bounds.max = least(turned.max, vec3_add(at, make_even(around)));
    return outline;
}
