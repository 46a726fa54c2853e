#include "pairs/balls.h"

#include "tools/hash.h"

#include <math.h>
#include <stdlib.h>

cli_balls balls_create(size_t objects) {
    size_t count = 64;
    while (count < 2 * objects) count *= 2;
    return (cli_balls){calloc(count, sizeof(cli_ball)), count};
}

void balls_destroy(cli_balls *balls) {
    free(balls->slots);
    balls->slots = NULL;
}

/// The radius around a point of the local frame that holds a shape that is the hull of its vertices, rounded; infinite
/// of others.
static double find_reach(const ovoid_shape *shape, ovoid_vec3 center) {
    ovoid_allowance allowance = ovoid_shape_get_allowance(shape);
    if (ovoid_shape_get_round(shape).kind != OVOID_ROUND_NONE || allowance.outside > 0 || allowance.inside > 0)
        return HUGE_VAL;
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    double reach = 0;
    for (size_t i = 0; i < p.vertex_count; i++) {
        const double *v = &p.vertices[3 * i];
        double d[3] = {v[0] + p.origin.x - center.x, v[1] + p.origin.y - center.y, v[2] + p.origin.z - center.z};
        reach = fmax(reach, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    }
    return sqrt(reach) + ovoid_shape_get_radius(shape);
}

static cli_ball make_ball(const ovoid_body *body, const void *name) {
    const ovoid_moving_body still = {.shape = body->shape,
                                     .compound = body->compound,
                                     .solid = body->solid,
                                     .motion = ovoid_motion_make_still(ovoid_pose_make_identity())};
    ovoid_box b = ovoid_moving_body_compute_box(&still, 0, 0);
    ovoid_vec3 center = {(b.min.x + b.max.x) / 2, (b.min.y + b.max.y) / 2, (b.min.z + b.max.z) / 2};
    ovoid_vec3 half = {b.max.x - center.x, b.max.y - center.y, b.max.z - center.z};
    double radius = sqrt(half.x * half.x + half.y * half.y + half.z * half.z);
    if (body->shape) radius = fmin(radius, find_reach(body->shape, center));
    return (cli_ball){name, center, radius};
}

static int is_end(const void *table, size_t slot, const void *key) {
    const cli_balls *b = table;
    return !b->slots[slot].body || b->slots[slot].body == key;
}

const cli_ball *balls_find(cli_balls *b, const ovoid_body *body) {
    const void *name = body->shape      ? (const void *)body->shape
                       : body->compound ? (const void *)body->compound
                                        : (const void *)body->solid;
    cli_ball *slot = &b->slots[hash_find(hash_number((uintptr_t)name), b->count, b, name, is_end)];
    if (!slot->body) *slot = make_ball(body, name);
    return slot;
}
