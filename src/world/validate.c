// Validation of ids and of bodies that a caller passes.
#include "world/state.h"

#include "base/error.h"
#include "body/body_tree.h"
#include "compound/compound.h"
#include "linear/pose.h"
#include "solid/solid.h"

uint32_t world_find_body(const ovoid_world *w, ovoid_id id) {
    uint64_t i = id >> 32;
    if (i >= w->used || w->leaf_of[i] == NONE || w->generations[i] != (uint32_t)id) return NONE;
    return (uint32_t)i;
}

ovoid_code world_refuse_id(ovoid_error *error, int64_t place, ovoid_id id) {
    return error_set(error, OVOID_ERROR_INDEX, place,
                     "id %llu (index %u, generation %u) names no body of this world: it was removed, or never added",
                     (unsigned long long)id, (unsigned)(id >> 32), (unsigned)(uint32_t)id);
}

static ovoid_code refuse_pose(ovoid_error *error, int64_t place, ovoid_code code) {
    static const char *const what[] = {"a position or quaternion is NaN or infinite",
                                       "a position is farther than OVOID_LENGTH_MAX", "the quaternion is zero"};
    int k = code == OVOID_ERROR_NOT_FINITE ? 0 : code == OVOID_ERROR_RANGE ? 1 : 2;
    return error_set(error, code, place, "the pose is refused: %s; nothing is moved", what[k]);
}

double world_get_extent(const ovoid_body *body) {
    return body->compound ? body->compound->extent : body->solid ? body->solid->extent : 0;
}

ovoid_code world_validate_body(const ovoid_body *body, int64_t place, ovoid_error *error) {
    if (!body_is_one(body))
        return error_set(error, OVOID_ERROR_ARGUMENT, place,
                         "a body needs exactly one of a shape, a compound and a solid");
    ovoid_code code = pose_validate(&body->pose);
    double extent = world_get_extent(body);
    if (code == OVOID_OK && extent > 0 && !(vec3_norm(body->pose.position) + extent <= OVOID_LENGTH_MAX))
        code = OVOID_ERROR_RANGE;
    return code == OVOID_OK ? code : refuse_pose(error, place, code);
}
