// Joints' numbers of a robot's state (moveit_msgs/RobotState, sensor_msgs/JointState). Cost: linear in the state.
#include "robot/read/scene/positions.h"

#include <string.h>

ovoid_code position_list_make(const message_reader *r, size_t most, position_list *out) {
    out->items = pool_get(r->memory, most, sizeof *out->items);
    out->count = 0;
    return out->items ? OVOID_OK : io_fail_memory(r->error, r->path);
}

ovoid_code position_list_add(const message_reader *r, const char *name, const yaml_value *number, position_list *out) {
    ovoid_joint_position *item = &out->items[out->count++];
    item->joint = name;
    return message_read_number(r, number, &item->position);
}

ovoid_code position_list_copy_name(const message_reader *r, const yaml_value *value, const char **name) {
    if (value->kind != YAML_TEXT) return message_fail(r, value, OVOID_ERROR_FORMAT, "a joint's name must be a text");
    *name = pool_copy(r->memory, value->text, strlen(value->text));
    return *name ? OVOID_OK : io_fail_memory(r->error, r->path);
}

ovoid_code position_list_read_joints(const message_reader *r, const yaml_value *state, position_list *out) {
    const yaml_value *names = NULL, *positions = NULL;
    *out = (position_list){NULL, 0};
    ovoid_code code = message_refuse_others(r, state, "header|name|position|velocity|effort");
    if (!code) code = message_find_kind(r, state, "name", YAML_LIST, &names);
    if (!code) code = message_find_kind(r, state, "position", YAML_LIST, &positions);
    if (code || !names || !positions) return code;
    if (names->count != positions->count)
        return message_fail(r, positions, OVOID_ERROR_FORMAT, "there are %zu names but %zu positions", names->count,
                            positions->count);
    code = position_list_make(r, names->count, out);
    const yaml_value *number = positions->first;
    for (const yaml_value *v = names->first; v && !code; v = v->next, number = number->next) {
        const char *name = NULL;
        code = position_list_copy_name(r, v, &name);
        if (!code) code = position_list_add(r, name, number, out);
    }
    return code;
}

// The numbers here are those of joints with one variable, so a base must be where it is by default.
static ovoid_code validate_bases(const message_reader *r, const yaml_value *robot) {
    const yaml_value *state, *list = NULL;
    double values[7];
    ovoid_code code = message_find_kind(r, robot, "multi_dof_joint_state", YAML_MAP, &state);
    if (!code && state) code = message_refuse_others(r, state, "header|joint_names|transforms|twist|wrench");
    if (!code && state) code = message_find_kind(r, state, "transforms", YAML_LIST, &list);
    for (const yaml_value *v = list ? list->first : NULL; v && !code; v = v->next) {
        code = message_read_transform(r, v, values);
        if (!code && !transform_is_identity(values))
            code = message_fail(r, v, OVOID_ERROR_FORMAT,
                                "multi_dof_joint_state: a base that is not where its frame is cannot be told here");
    }
    return code;
}

ovoid_code position_list_read_state(const message_reader *r, const yaml_value *state, const char *owner,
                                    position_list *out) {
    const yaml_value *joints = NULL;
    char why[128];
    *out = (position_list){NULL, 0};
    (void)snprintf(why, sizeof why,
                   "of %s are not read: put them into the scene's robot_state, or name what is held by --attach",
                   owner);
    ovoid_code code =
        message_refuse_others(r, state, "joint_state|multi_dof_joint_state|attached_collision_objects|is_diff");
    if (!code) code = message_refuse_filled(r, state, "attached_collision_objects", why);
    if (!code) code = validate_bases(r, state);
    if (!code) code = message_find_kind(r, state, "joint_state", YAML_MAP, &joints);
    return code || !joints ? code : position_list_read_joints(r, joints, out);
}
