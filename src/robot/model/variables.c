// The numbers of a state: which joint each belongs to, and which moves each joint. Also the tables of names.
#include "base/error.h"
#include "robot/model/robot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int compare_names(const void *x, const void *y) {
    const robot_name *a = x, *b = y;
    int order = strcmp(a->name, b->name);
    return order ? order : (a->index > b->index) - (a->index < b->index);
}

uint32_t names_sort(robot_name *names, uint32_t count) {
    qsort(names, count, sizeof *names, compare_names);
    for (uint32_t i = 1; i < count; i++)
        if (strcmp(names[i - 1].name, names[i].name) == 0) return names[i].index;
    return OVOID_ROBOT_NONE;
}

uint32_t names_find(const robot_name *names, uint32_t count, const char *name) {
    uint32_t low = 0, high = count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        int order = strcmp(names[middle].name, name);
        if (order == 0) return names[middle].index;
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return OVOID_ROBOT_NONE;
}

static ovoid_robot_variable make_variable(const ovoid_robot_joint *j, uint32_t joint, uint32_t component) {
    int is_limited = j->type == OVOID_JOINT_REVOLUTE || j->type == OVOID_JOINT_PRISMATIC;
    return (ovoid_robot_variable){joint, component, is_limited ? j->lower : -INFINITY, is_limited ? j->upper : INFINITY,
                                  j->velocity};
}

// Stands for a variable that is not known yet, since the joint follows another.
#define OPEN (OVOID_ROBOT_NONE - 1)

// Sets the variable of a joint that follows another, and of those that it follows: each chain is walked once.
static ovoid_code follow(ovoid_robot *r, uint32_t i, ovoid_error *error) {
    const ovoid_robot_joint *j = &r->joints[i];
    if (ovoid_joint_type_get_variable_count(j->type) != 1)
        return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)i,
                         "joint \"%.80s\" is %s: only joints of one variable mimic", j->name,
                         ovoid_joint_type_get_name(j->type));
    uint32_t leader = i;
    for (uint32_t steps = 0; r->joint_variable[leader] == OPEN; leader = r->joints[leader].mimic)
        if (steps++ > r->joint_count)
            return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)i, "joint \"%.80s\" mimics itself%s", j->name,
                             j->mimic == i ? "" : ", or others that mimic one another");
    if (ovoid_joint_type_get_variable_count(r->joints[leader].type) != 1)
        return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)i,
                         "joint \"%.80s\" mimics \"%.80s\", which is %s and has not one variable", j->name,
                         r->joints[leader].name, ovoid_joint_type_get_name(r->joints[leader].type));
    for (uint32_t k = i; k != leader; k = r->joints[k].mimic) r->joint_variable[k] = r->joint_variable[leader];
    return OVOID_OK;
}

ovoid_code variables_find(ovoid_robot *r, ovoid_error *error) {
    r->variable_count = 0;
    for (uint32_t i = 0; i < r->joint_count; i++) {
        const ovoid_robot_joint *j = &r->joints[i];
        uint32_t count = ovoid_joint_type_get_variable_count(j->type);
        r->joint_variable[i] = j->mimic != OVOID_ROBOT_NONE ? OPEN : OVOID_ROBOT_NONE;
        if (j->mimic != OVOID_ROBOT_NONE || count == 0) continue;
        r->joint_variable[i] = r->variable_count;
        for (uint32_t k = 0; k < count; k++) r->variables[r->variable_count++] = make_variable(j, i, k);
    }
    ovoid_code code = OVOID_OK;
    for (uint32_t i = 0; code == OVOID_OK && i < r->joint_count; i++)
        if (r->joint_variable[i] == OPEN) code = follow(r, i, error);
    return code;
}
