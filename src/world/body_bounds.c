// A body's enclosing sphere and box, with what rounding can do to them.
#include "world/body_bounds.h"

#include "compound/compound.h"
#include "linear/rotation.h"
#include "simd/pair.h"

// u = 2^-53. R(q) is off by 36 u, a product with it by 6 u more, the sum by u of itself: 43 u |local| + u |r|, and
// local itself, a sum, by u. The largest coordinate times sqrt 3 bounds a length: 64 u 2 (max|p| + max|local|) is above
// it.
#define CENTER_ERROR (128 * 0x1p-53)

body_sphere body_compute_sphere(const ovoid_body *body) {
    const ovoid_shape *s = body->shape;
    if (body->compound) {
        // The pose of a part is the rounded product of two poses: off by 46 u of the extent (compound.h), and by a few
        // u of the position. Four times the extent covers it.
        const compound_node *root = &body->compound->nodes[0];
        return (body_sphere){root->center, root->radius, 0, 4 * body->compound->extent};
    }
    vec3 local = vec3_add(s->origin, s->center);
    return (body_sphere){local, s->reach, s->lower_radius, vec3_max_abs(s->origin) + s->span + s->lower_radius};
}

vec3 body_compute_center(const body_sphere *ball, const ovoid_pose *pose, double *center_error) {
    *center_error = CENTER_ERROR * (vec3_max_abs(pose->position) + ball->size) + OVOID_LENGTH_MIN;
    return vec3_add(pose->position, mat3_mul_vec3(quat_to_mat3(pose->rotation), ball->local));
}

// The extent of a shape along a row of R, from r: max and min over the vertices v of row.(v - c). Dots are off by 42 u
// |v| and 3 u |v|, v and c below the extent: the pad of 128 u is above it.
static void find_extent(const ovoid_shape *s, vec3 row, double *low, double *high) {
    simd_points points = {shape_x(s), shape_y(s), shape_z(s), s->padded_count};
    double up[3] = {row.x, row.y, row.z}, down[3] = {-row.x, -row.y, -row.z};
    simd_pair x = simd_find_pair(&points, up, &points, down);
    double c = vec3_dot(row, s->center);
    *high = x.high.value - c;
    *low = -x.low.value - c;
}

static vec3 absolute(vec3 v) { return (vec3){fabs(v.x), fabs(v.y), fabs(v.z)}; }

// The box around a compound's own box, turned, no larger than that of its enclosing sphere.
static box find_compound_box(const ovoid_compound *c, const body_sphere *ball, mat3 r, vec3 at, double center_error) {
    vec3 half = c->nodes[0].half;
    double pad = center_error + 128 * 0x1p-53 * ball->reach + 4 * 0x1p-53 * vec3_max_abs(at);
    vec3 e = {min2(vec3_dot(absolute(r.r0), half), ball->reach) + pad,
              min2(vec3_dot(absolute(r.r1), half), ball->reach) + pad,
              min2(vec3_dot(absolute(r.r2), half), ball->reach) + pad};
    return (box){vec3_sub(at, e), vec3_add(at, e)};
}

box body_compute_box(const ovoid_body *body, const body_sphere *ball) {
    const ovoid_shape *s = body->shape;
    mat3 r = quat_to_mat3(body->pose.rotation);
    double center_error, pad, radius;
    vec3 at = body_compute_center(ball, &body->pose, &center_error);
    if (body->compound) return find_compound_box(body->compound, ball, r, at, center_error);
    radius = s->lower_radius;
    pad = radius + center_error + 128 * 0x1p-53 * (s->extent + radius) + 4 * 0x1p-53 * vec3_max_abs(at);
    vec3 low, high;
    find_extent(s, r.r0, &low.x, &high.x);
    find_extent(s, r.r1, &low.y, &high.y);
    find_extent(s, r.r2, &low.z, &high.z);
    return (box){{at.x + low.x - pad, at.y + low.y - pad, at.z + low.z - pad},
                 {at.x + high.x + pad, at.y + high.y + pad, at.z + high.z + pad}};
}
