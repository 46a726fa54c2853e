// Where a ray meets a body: a point, or a ball, moved along a straight line (cast.c), so hulls of any rank and rounding
// radius are handled alike, with the same bracket. The direction is made a unit vector, so times are lengths; it is off
// by 4 u, and so is the point by 4 u of its way, of which motion.h leaves 16 u.
#include "base/environment.h"
#include "base/error.h"
#include "linear/rotation.h"
#include "motion/impact.h"
#include "motion/motion.h"
#include "query/answer.h"
#include "shape/point.h"

static int ray_is_sound(const ovoid_ray *r) {
    return vec3_max_abs(r->origin) <= OVOID_LENGTH_MAX && vec3_max_abs(r->direction) <= OVOID_LENGTH_MAX &&
           vec3_is_finite(r->origin) && vec3_is_finite(r->direction) && vec3_max_abs(r->direction) > 0 &&
           r->length >= 0 && r->radius >= 0 && r->radius <= OVOID_LENGTH_MAX;
}

// A length along the ray beyond which there is no point of the body.
static double find_end(const ovoid_posed_shape *body, const ovoid_ray *ray) {
    vec3 center = vec3_add(body->shape->center, body->shape->origin);
    vec3 c = vec3_add(body->pose.position, mat3_mul_vec3(quat_to_mat3(body->pose.rotation), center));
    double far = vec3_max_abs(c) + vec3_max_abs(body->shape->origin) + vec3_max_abs(ray->origin);
    double reach = body->shape->reach + body->shape->lower_radius + ray->radius;
    return 1.001 * (vec3_norm(vec3_sub(c, ray->origin)) + reach) + 64 * 0x1p-53 * far + OVOID_LENGTH_MIN;
}

static ovoid_ray_hit refuse(ovoid_limit limit) { return (ovoid_ray_hit){.limit = limit, .upper = INFINITY}; }

// A ray that begins inside: the point and the normal of the depth query.
static void take_inside(const ovoid_pair *pair, ovoid_ray_hit *out) {
    ovoid_answer depth;
    const query_goal goal = query_goal_make_depth(NULL);
    answer_find_internal(pair, &(query_request){.goal = &goal}, &depth);
    out->point = depth.point_a;
    out->normal = depth.normal;
    out->upper = 0;
}

static ovoid_ray_hit cast(const ovoid_posed_shape *body, const ovoid_ray *ray) {
    OVOID_ASSERT(body && ray);
    if (!body->shape) return refuse(OVOID_LIMIT_SHAPE_B);
    const ovoid_pose none = {{0, 0, 0}, {0, 0, 0, 0}}, at = {ray->origin, {1, 0, 0, 0}};
    ovoid_moving_shape still = {body->shape, ovoid_motion_make_still(body->pose), none}, moving;
    if (motion_validate(&still.motion, 0, 0, NULL) != OVOID_OK) return refuse(OVOID_LIMIT_POSE_B);
    if (!ray_is_sound(ray)) return refuse(OVOID_LIMIT_OPTIONS);
    point_shape point;
    ovoid_impact impact;
    point_make(&point, ray->radius);
    double most = vec3_max_abs(ray->direction);
    vec3 scaled = vec3_scale(ray->direction, 1 / most);
    double norm = vec3_norm(scaled), length = ray->length * most * norm;
    vec3 unit = vec3_scale(scaled, 1 / norm);
    moving = (ovoid_moving_shape){&point.shape, ovoid_motion_make_still(at), none};
    if (length > 0)
        moving.motion = ovoid_motion_make_velocity(at, unit, (vec3){0, 0, 0}, min2(length, find_end(body, ray)));
    impact_find((moving_shapes){&still, &moving}, 0, NULL, 1e-12, &impact);
    ovoid_ray_hit out = {.status = impact.status, .limit = impact.limit, .iterations = impact.iterations};
    if (impact.limit == OVOID_LIMIT_POSE_B) return refuse(OVOID_LIMIT_OPTIONS);
    out.point = impact.free.point_a;
    out.normal = impact.free.normal;
    out.lower = impact.free_until / norm / most * (1 - 8 * 0x1p-53);
    out.upper = impact.hit_at / norm / most * (1 + 8 * 0x1p-53);
    if (impact.status == OVOID_IMPACT_FREE) out.lower = ray->length;
    if (impact.hit_at == 0) take_inside(&(ovoid_pair){body->shape, &point.shape, body->pose, at}, &out);
    return out;
}

ovoid_ray_hit ovoid_shape_cast_ray(const ovoid_posed_shape *body, const ovoid_ray *ray) {
    ENVIRONMENT_RETURN(ovoid_ray_hit, body, cast(body, ray));
}
