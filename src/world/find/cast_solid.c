// Casts against solids.
//
// A ray is cast on each triangle whose boxes it meets, nearest first (motion/ray.c). A thick ray's hit of a triangle is
// proven there. A ray without a radius meets a triangle in a point, which no rounded numbers prove. But behind a point
// where it enters a closed solid it is inside, and a winding number proves that (inside.c), a small distance further,
// which is the width of the bracket. A ray that only grazes a solid stays undecided.
//
// The ray in the solid's frame is off by 91 u S, as in frame.h, S the sizes and the distance of the frames; boxes are
// enlarged by 256 u S and the ray's radius. Times at the boxes' sides are off by a few u of themselves.
#include "world/find/cast_solid.h"

#include "body/body_find.h"
#include "body/tree_frame.h"
#include "linear/rotation.h"
#include "motion/impact.h"
#include "ovoid/body_impact.h"
#include "shape/point.h"

#define WIDER 0x1p-48

/// The number of nearest crossings of a ray without a radius that are kept, to search behind them.
enum { CROSSINGS = 32 };

typedef struct ray_search {
    body_tree tree;
    const ovoid_body *body;
    const ovoid_ray *ray;
    vec3 origin, direction; ///< of the ray, in the solid's frame
    double slack;           ///< the amount by which boxes are enlarged
    part_hit hit;
    part_hit crossing[CROSSINGS]; ///< by their times
    uint32_t count;
} ray_search;

// Cuts the range of times to those at which a coordinate is between two bounds; 0 if none is left.
static int enter_slab(double low, double high, double from, double displacement, double range[2]) {
    if (!(fabs(displacement) > 0)) return from >= low && from <= high;
    double a = (low - from) / displacement, b = (high - from) / displacement;
    double first = min2(a, b), last = max2(a, b);
    range[0] = max2(range[0], first - WIDER * fabs(first));
    range[1] = min2(range[1], last + WIDER * fabs(last));
    return range[0] <= range[1];
}

// The time at which the ray meets a node's box; infinity if it does not.
static double find_entry(const ray_search *state, tree_ref ref) {
    tree_box at = body_tree_get_box(&state->tree, ref);
    vec3 grown = vec3_add(at.half, (vec3){state->slack, state->slack, state->slack});
    vec3 from = vec3_sub(vec3_sub(state->origin, state->tree.center), at.center), d = state->direction;
    double range[2] = {0, state->ray->length};
    int meets = enter_slab(-grown.x, grown.x, from.x, d.x, range) &&
                enter_slab(-grown.y, grown.y, from.y, d.y, range) && enter_slab(-grown.z, grown.z, from.z, d.z, range);
    return meets ? range[0] : INFINITY;
}

// Keeps crossings in the order of their times; if there are too many, the farthest is dropped.
static void keep_crossing(ray_search *state, const part_hit *c) {
    if (state->count == CROSSINGS && state->crossing[CROSSINGS - 1].lower <= c->lower) return;
    uint32_t at = state->count < CROSSINGS ? state->count++ : CROSSINGS - 1;
    for (; at > 0 && state->crossing[at - 1].lower > c->lower; at--) state->crossing[at] = state->crossing[at - 1];
    state->crossing[at] = *c;
}

static void visit_triangle(ray_search *state, uint32_t place) {
    triangle_shape room;
    triangle_begin(&room);
    ovoid_posed_shape leaf = body_tree_get_leaf(&state->tree, place, &room);
    ovoid_ray_hit hit = ovoid_shape_cast_ray(&leaf, state->ray);
    if (hit.status == OVOID_IMPACT_FREE) return;
    part_hit found = {
        body_tree_get_index(&state->tree, place), 0, hit.status, hit.lower, hit.upper, hit.point, hit.normal};
    double lower = min2(state->hit.lower, hit.lower);
    if (hit.status == OVOID_IMPACT_HIT && hit.upper < state->hit.upper) state->hit = found;
    if (hit.status == OVOID_IMPACT_UNDECIDED) keep_crossing(state, &found);
    if (state->hit.status == OVOID_IMPACT_FREE) state->hit.status = OVOID_IMPACT_UNDECIDED;
    state->hit.lower = lower;
}

static void traverse(ray_search *state) {
    struct {
        tree_ref ref;
        double entry;
    } stack[SOLID_DEPTH_MAX * BOX8] = {{body_tree_get_root(&state->tree), 0}};
    for (uint32_t top = 1; top > 0;) {
        tree_ref ref = stack[--top].ref, children[BOX8];
        if (!(stack[top].entry <= state->ray->length) || stack[top].entry > state->hit.upper) continue;
        if (ref_is_leaf(ref)) {
            visit_triangle(state, ref_get_index(ref));
            continue;
        }
        uint32_t more = body_tree_get_children(&state->tree, ref, children), first = top;
        for (uint32_t i = 0; i < more; i++) {
            double entry = find_entry(state, children[i]);
            uint32_t at = top++;
            // The nearest on top.
            for (; at > first && stack[at - 1].entry < entry; at--) stack[at] = stack[at - 1];
            stack[at].ref = children[i];
            stack[at].entry = entry;
        }
    }
}

// Does the solid contain the ray's point, or its ball, at a time? *answer: that of the bodies.
static int holds(const ray_search *state, double time, ovoid_body_answer *answer) {
    point_shape point;
    point_make(&point, state->ray->radius);
    vec3 at = vec3_add(state->ray->origin, vec3_scale(state->ray->direction, time));
    const ovoid_body_pair pair = {*state->body, {.shape = &point.shape, .pose = {at, {1, 0, 0, 0}}}};
    const query_goal goal = query_goal_make_collide();
    if (!(vec3_max_abs(at) <= OVOID_LENGTH_MAX)) return 0;
    body_find_internal(&pair, &(body_request){NULL, &goal, NULL, NULL}, answer);
    return answer->status == OVOID_OVERLAPPING;
}

// Handles a ray that begins inside.
static int take_beginning(ray_search *state) {
    ovoid_body_answer at;
    if (!holds(state, 0, &at)) return 0;
    state->hit = (part_hit){at.part_a, 0, OVOID_IMPACT_HIT, 0, 0, at.deciding.point_a, at.deciding.normal};
    return 1;
}

// Searches behind the crossings for a point that is inside, at growing distances, up to the next crossing.
static void take_crossings(ray_search *state) {
    double scale = vec3_norm(state->ray->direction), size = state->tree.extent + vec3_norm(state->origin);
    ovoid_body_answer at;
    for (uint32_t i = 0; i < state->count && !(state->hit.upper < INFINITY); i++) {
        double first = state->crossing[i].lower, next = state->ray->length;
        for (uint32_t k = i + 1; k < state->count && !(next < state->ray->length); k++)
            if (state->crossing[k].lower > first + 0x1p-30 * size / scale) next = state->crossing[k].lower;
        for (double step = 0x1p-42 * size / scale; step <= 0x1p-10 * size / scale; step *= 4) {
            double time = first + step;
            if (!(time < next)) break;
            if (!holds(state, time, &at)) continue;
            double lower = state->hit.lower;
            state->hit = state->crossing[i];
            state->hit.status = OVOID_IMPACT_HIT;
            state->hit.lower = lower;
            state->hit.upper = time * (1 + WIDER);
            return;
        }
    }
}

part_hit solid_cast_ray(const ovoid_body *body, const ovoid_ray *ray) {
    ray_search state = {.body = body, .ray = ray, .hit = {.lower = INFINITY, .upper = INFINITY}};
    state.hit.status = OVOID_IMPACT_FREE;
    if (!body_tree_make(body, &state.tree)) return state.hit;
    mat3 r = quat_to_mat3(body->pose.rotation);
    vec3 offset = vec3_sub(ray->origin, body->pose.position);
    state.origin = mat3_mul_transposed_vec3(r, offset);
    state.direction = mat3_mul_transposed_vec3(r, ray->direction);
    state.slack =
        ray->radius + 256 * 0x1p-53 * (vec3_norm(offset) + state.tree.extent + ray->radius) + OVOID_LENGTH_MIN;
    if (take_beginning(&state)) return state.hit;
    traverse(&state);
    if (body_tree_is_closed(&state.tree) && state.count) take_crossings(&state);
    return state.hit;
}

part_hit solid_cast_body(const ovoid_body *body, const ovoid_body *moved, vec3 displacement) {
    const ovoid_motion_options options = {.tolerance = 1e-12, .end = 1};
    const ovoid_motion still = ovoid_motion_make_still(body->pose);
    const ovoid_moving_body a = {body->shape, body->compound, still, body->solid};
    const ovoid_motion motion = ovoid_motion_make_velocity(moved->pose, displacement, (vec3){0, 0, 0}, 1);
    const ovoid_moving_body b = {moved->shape, moved->compound, motion, moved->solid};
    ovoid_body_impact impact = ovoid_body_impact_find(&(ovoid_moving_body_pair){a, b, 0}, &options);
    const ovoid_impact *i = &impact.impact;
    return (part_hit){impact.part_a, impact.part_b, i->status, i->free_until, i->hit_at, i->hit.point_a, i->hit.normal};
}
