// A motion planning request in YAML (moveit_msgs/MotionPlanRequest): where the joints begin, and the goals that are
// given by the joints' numbers. Cost: linear in the file.
#include "robot/read/scene/positions.h"

#include <stdlib.h>
#include <string.h>

struct ovoid_motion_request {
    pool memory;
    const char *group;
    position_list start, *goals;
    size_t goal_count;
};

static const ovoid_robot_read_options no_options;

// start_state: joint_state: name and position, two lists of one length.
static ovoid_code read_start(const message_reader *r, const yaml_value *root, position_list *out) {
    const yaml_value *start;
    ovoid_code code = message_find_kind(r, root, "start_state", YAML_MAP, &start);
    if (!code && start) code = position_list_read_state(r, start, "a request", out);
    if (code || out->items) return code;
    return message_fail(r, root, OVOID_ERROR_FORMAT, "a request needs start_state: joint_state: name and position");
}

static ovoid_code read_constraint(const message_reader *r, const yaml_value *value, position_list *out) {
    const yaml_value *name, *number;
    ovoid_code code = message_refuse_others(r, value, "joint_name|position|tolerance_above|tolerance_below|weight");
    if (!code) code = message_find_kind(r, value, "joint_name", YAML_TEXT, &name);
    if (!code) code = message_find(r, value, "position", &number);
    if (!code && (!name || !number))
        code = message_fail(r, value, OVOID_ERROR_FORMAT, "a joint constraint needs joint_name and position");
    const char *kept = NULL;
    if (!code) code = position_list_copy_name(r, name, &kept);
    return code ? code : position_list_add(r, kept, number, out);
}

static ovoid_code read_goal(const message_reader *r, const yaml_value *value, position_list *out) {
    static const char *const others[3] = {"position_constraints", "orientation_constraints", "visibility_constraints"};
    const yaml_value *constraints;
    ovoid_code code = message_find_kind(r, value, "joint_constraints", YAML_LIST, &constraints);
    if (code) return code;
    code = message_refuse_others(r, value,
                                 "joint_constraints|name|position_constraints|orientation_constraints|"
                                 "visibility_constraints");
    for (int i = 0; i < 3 && !code; i++)
        code = message_refuse_filled(r, value, others[i], "of a goal are not read: its states are not known by joints");
    if (code) return code;
    if (!constraints || !constraints->first)
        return message_fail(r, value, OVOID_ERROR_FORMAT, "a goal without joint_constraints: nothing says where it is");
    code = position_list_make(r, constraints->count, out);
    for (const yaml_value *v = constraints->first; v && !code; v = v->next) code = read_constraint(r, v, out);
    return code;
}

// What a planner is told of how to search means nothing here.
static ovoid_code refuse_others(const message_reader *r, const yaml_value *root) {
    return message_refuse_others(
        r, root,
        "group_name|start_state|goal_constraints|path_constraints|trajectory_constraints|reference_trajectories|"
        "workspace_parameters|pipeline_id|planner_id|num_planning_attempts|allowed_planning_time|"
        "max_velocity_scaling_factor|max_acceleration_scaling_factor|cartesian_speed_end_effector_link|"
        "cartesian_speed_limited_link|max_cartesian_speed");
}

// 1: there is a text or a number that is not zero in the value, or in what it holds.
static int is_filled(const yaml_value *value) {
    if (value->kind == YAML_TEXT) return value->text[0] && value->text[strspn(value->text, "0.-~")];
    for (const yaml_value *v = value->first; v; v = v->next)
        if (is_filled(v)) return 1;
    return 0;
}

// What a path must do beside being free is not checked here: a note names it.
static ovoid_code tell_unread(const message_reader *r, const yaml_value *root) {
    static const char *const keys[] = {"path_constraints", "trajectory_constraints", "reference_trajectories"};
    for (int i = 0; i < 3; i++) {
        const yaml_value *value;
        ovoid_code code = message_find(r, root, keys[i], &value);
        if (code) return code;
        if (value && is_filled(value))
            message_note(r, value, "%s of a request are not read: no state is checked against them", keys[i]);
    }
    return OVOID_OK;
}

static ovoid_code read_request(const message_reader *r, const yaml_value *root, ovoid_motion_request *out) {
    const yaml_value *goals;
    ovoid_code code = refuse_others(r, root);
    if (!code) code = read_start(r, root, &out->start);
    if (!code) code = tell_unread(r, root);
    if (!code) code = message_read_text(r, root, "group_name", &out->group);
    if (!code) code = message_find_kind(r, root, "goal_constraints", YAML_LIST, &goals);
    if (code || !goals) return code;
    out->goals = pool_get(r->memory, goals->count, sizeof *out->goals);
    if (!out->goals) return io_fail_memory(r->error, r->path);
    for (const yaml_value *v = goals->first; v && !code; v = v->next)
        code = read_goal(r, v, &out->goals[out->goal_count++]);
    return code;
}

ovoid_motion_request *ovoid_motion_request_read(const char *path, const ovoid_robot_read_options *options,
                                                ovoid_error *error) {
    ovoid_motion_request *request = calloc(1, sizeof *request);
    if (!request) {
        (void)io_fail_memory(error, path);
        return NULL;
    }
    message_reader r = {
        .path = path, .options = options ? options : &no_options, .error = error, .memory = &request->memory};
    yaml_value *root;
    ovoid_code code = yaml_read(path, &r.scratch, &root, error);
    if (!code) code = read_request(&r, root, request);
    pool_clear(&r.scratch);
    if (!code) return request;
    ovoid_motion_request_destroy(request);
    return NULL;
}

void ovoid_motion_request_destroy(ovoid_motion_request *request) {
    if (!request) return;
    pool_clear(&request->memory);
    free(request);
}

const char *ovoid_motion_request_get_group(const ovoid_motion_request *request) { return request->group; }

const ovoid_joint_position *ovoid_motion_request_get_start(const ovoid_motion_request *request, size_t *count) {
    *count = request->start.count;
    return request->start.items;
}

size_t ovoid_motion_request_get_goal_count(const ovoid_motion_request *request) { return request->goal_count; }

const ovoid_joint_position *ovoid_motion_request_get_goal(const ovoid_motion_request *request, size_t i,
                                                          size_t *count) {
    *count = request->goals[i].count;
    return request->goals[i].items;
}
