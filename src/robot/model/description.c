// What can be said of a description item by item: names, numbers, indices. The sentence names the item.
#include "base/error.h"
#include "linear/pose.h"
#include "linear/vec3.h"
#include "robot/model/robot.h"

#include <string.h>

const char *ovoid_joint_type_get_name(ovoid_joint_type type) {
    switch (type) {
    case OVOID_JOINT_FIXED: return "fixed";
    case OVOID_JOINT_REVOLUTE: return "revolute";
    case OVOID_JOINT_CONTINUOUS: return "continuous";
    case OVOID_JOINT_PRISMATIC: return "prismatic";
    case OVOID_JOINT_PLANAR: return "planar";
    case OVOID_JOINT_FLOATING: return "floating";
    }
    return "unknown type";
}

uint32_t ovoid_joint_type_get_variable_count(ovoid_joint_type type) {
    switch (type) {
    case OVOID_JOINT_FIXED: return 0;
    case OVOID_JOINT_PLANAR: return 3;
    case OVOID_JOINT_FLOATING: return 7;
    default: return 1;
    }
}

static const char *name_or_empty(const char *name) { return name ? name : ""; }

// The pose of a joint's origin or of an element.
static ovoid_code validate_pose(const ovoid_pose *pose, const char *what, size_t i, const char *name,
                                ovoid_error *error) {
    ovoid_code code = ovoid_pose_validate(pose);
    if (code == OVOID_OK) return OVOID_OK;
    const char *wrong = code == OVOID_ERROR_ROTATION     ? "a quaternion of four zeros"
                        : code == OVOID_ERROR_NOT_FINITE ? "NaN or infinity"
                                                         : "a length above 1e50";
    return error_set(error, code, (int64_t)i, "the pose of %s %zu \"%.80s\" has %s", what, i, name_or_empty(name),
                     wrong);
}

static int is_limited(ovoid_joint_type type) { return type == OVOID_JOINT_REVOLUTE || type == OVOID_JOINT_PRISMATIC; }

static ovoid_code validate_limits(const ovoid_robot_joint *j, size_t i, ovoid_error *error) {
    if (isnan(j->lower) || isnan(j->upper) || !isfinite(j->velocity) || !isfinite(j->multiplier) ||
        !isfinite(j->offset))
        return error_set(error, OVOID_ERROR_NOT_FINITE, (int64_t)i,
                         "joint \"%.80s\": a limit, a velocity or a number of its mimic is NaN or infinite", j->name);
    if (is_limited(j->type) && !(j->lower <= j->upper))
        return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)i,
                         "joint \"%.80s\": its lower limit %g is above its upper limit %g", j->name, j->lower,
                         j->upper);
    if (j->velocity < 0)
        return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)i, "joint \"%.80s\": a velocity below zero", j->name);
    return OVOID_OK;
}

static ovoid_code validate_axis(const ovoid_robot_joint *j, size_t i, ovoid_error *error) {
    if (j->type == OVOID_JOINT_FIXED || j->type == OVOID_JOINT_FLOATING) return OVOID_OK;
    if (!vec3_is_finite(j->axis))
        return error_set(error, OVOID_ERROR_NOT_FINITE, (int64_t)i, "joint \"%.80s\": its axis has NaN or infinity",
                         j->name);
    if (!(vec3_max_abs(j->axis) > 0))
        return error_set(error, OVOID_ERROR_ROTATION, (int64_t)i, "joint \"%.80s\": its axis is zero", j->name);
    return OVOID_OK;
}

static ovoid_code validate_joint(const ovoid_robot_description *d, size_t i, ovoid_error *error) {
    const ovoid_robot_joint *j = &d->joints[i];
    if (!j->name || !*j->name) return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)i, "joint %zu has no name", i);
    if ((unsigned)j->type > OVOID_JOINT_FLOATING)
        return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)i, "joint \"%.80s\": there is no such type: %d", j->name,
                         (int)j->type);
    if (j->parent >= d->link_count || j->child >= d->link_count)
        return error_set(error, OVOID_ERROR_INDEX, (int64_t)i, "joint \"%.80s\": its %s link is %u, there are %zu",
                         j->name, j->parent >= d->link_count ? "parent" : "child",
                         j->parent >= d->link_count ? j->parent : j->child, d->link_count);
    if (j->mimic != OVOID_ROBOT_NONE && j->mimic >= d->joint_count)
        return error_set(error, OVOID_ERROR_INDEX, (int64_t)i, "joint \"%.80s\" mimics joint %u, there are %zu",
                         j->name, j->mimic, d->joint_count);
    ovoid_code code = validate_pose(&j->origin, "joint", i, j->name, error);
    if (code == OVOID_OK) code = validate_axis(j, i, error);
    return code == OVOID_OK ? validate_limits(j, i, error) : code;
}

static ovoid_code validate_element(const ovoid_robot_description *d, size_t i, ovoid_error *error) {
    const ovoid_robot_element *e = &d->elements[i];
    if (e->link >= d->link_count)
        return error_set(error, OVOID_ERROR_INDEX, (int64_t)i, "element %zu \"%.80s\" is of link %u, there are %zu", i,
                         name_or_empty(e->name), e->link, d->link_count);
    if (!e->shape)
        return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)i,
                         "element %zu \"%.80s\" of link \"%.80s\" has no shape", i, name_or_empty(e->name),
                         d->links[e->link].name);
    return validate_pose(&e->pose, "element", i, e->name, error);
}

static ovoid_code validate_counts(const ovoid_robot_description *d, ovoid_error *error) {
    if (!d->links || d->link_count == 0) return error_set(error, OVOID_ERROR_EMPTY, -1, "a robot needs a link");
    if (d->link_count > OVOID_ROBOT_LINKS_MAX || d->joint_count > OVOID_ROBOT_LINKS_MAX ||
        d->element_count > OVOID_ROBOT_LINKS_MAX || d->disabled_count > (size_t)1 << 30)
        return error_set(error, OVOID_ERROR_LIMIT, -1, "%zu links, %zu joints, %zu elements: at most %zu are allowed",
                         d->link_count, d->joint_count, d->element_count, OVOID_ROBOT_LINKS_MAX);
    if ((d->joint_count && !d->joints) || (d->element_count && !d->elements) || (d->disabled_count && !d->disabled))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a list of the description is NULL");
    return OVOID_OK;
}

ovoid_code description_validate(const ovoid_robot_description *d, ovoid_error *error) {
    if (!d) return error_set(error, OVOID_ERROR_ARGUMENT, -1, "there is no description");
    ovoid_code code = validate_counts(d, error);
    for (size_t i = 0; code == OVOID_OK && i < d->link_count; i++)
        if (!d->links[i].name || !*d->links[i].name)
            code = error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)i, "link %zu has no name", i);
    for (size_t i = 0; code == OVOID_OK && i < d->joint_count; i++) code = validate_joint(d, i, error);
    for (size_t i = 0; code == OVOID_OK && i < d->element_count; i++) code = validate_element(d, i, error);
    for (size_t i = 0; code == OVOID_OK && i < d->disabled_count; i++)
        if (d->disabled[i].a >= d->link_count || d->disabled[i].b >= d->link_count)
            code = error_set(error, OVOID_ERROR_INDEX, (int64_t)i, "disabled pair %zu is of links %u and %u of %zu", i,
                             d->disabled[i].a, d->disabled[i].b, d->link_count);
    return code;
}
