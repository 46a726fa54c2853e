// Random robots for tests: trees of links with joints of all six types and mimics, and random states of them.
#ifndef OVOID_TESTS_ROBOTS_H
#define OVOID_TESTS_ROBOTS_H

#include "check.h"
#include "ovoid/robot.h"

enum { ROBOT_LINKS = 24 };

typedef struct random_robot {
    ovoid_robot_link links[ROBOT_LINKS];
    ovoid_robot_joint joints[ROBOT_LINKS];
    ovoid_robot_element elements[2 * ROBOT_LINKS];
    char names[ROBOT_LINKS][8];
    ovoid_robot_description d;
} random_robot;

static inline ovoid_vec3 random_vec3(uint64_t *s, double scale) {
    ovoid_vec3 v = {scale * random_normal(s), scale * random_normal(s), scale * random_normal(s)};
    return v;
}
static inline ovoid_pose random_pose(uint64_t *s, double scale) {
    ovoid_pose p = {random_vec3(s, scale), {random_normal(s), random_normal(s), random_normal(s), random_normal(s)}};
    return p;
}

static inline uint32_t random_below(uint64_t *s, uint32_t count) { return (uint32_t)(random_next(s) % count); }

static inline void make_random_joint(uint64_t *s, uint32_t i, ovoid_robot_joint *j) {
    *j = (ovoid_robot_joint){.type = (ovoid_joint_type)random_below(s, 6),
                             .origin = random_pose(s, 0.5),
                             .axis = random_vec3(s, 3),
                             .lower = -2,
                             .upper = 2.5,
                             .mimic = OVOID_ROBOT_NONE,
                             .multiplier = 1};
    if (random_below(s, 3) == 0) j->axis = (ovoid_vec3){0, 0, random_below(s, 2) ? 1 : -1};
    if (random_below(s, 4) == 0) j->origin.rotation = (ovoid_quat){1, 0, 0, 0};
    j->parent = random_below(s, 3) ? i : random_below(s, i + 1);
    j->child = i + 1;
}

static inline int has_one_variable(const ovoid_robot_joint *j) {
    return ovoid_joint_type_get_variable_count(j->type) == 1;
}

/// A tree of 2 to ROBOT_LINKS links without elements.
static inline void make_random_robot(uint64_t *s, random_robot *r) {
    uint32_t links = 2 + random_below(s, ROBOT_LINKS - 1);
    for (uint32_t i = 0; i < links; i++) {
        snprintf(r->names[i], sizeof r->names[i], "n%u", i);
        r->links[i].name = r->names[i];
    }
    for (uint32_t i = 0; i + 1 < links; i++) {
        ovoid_robot_joint *j = &r->joints[i];
        make_random_joint(s, i, j);
        j->name = r->names[i];
        uint32_t leader = random_below(s, i + 1);
        if (leader == i || !has_one_variable(j) || !has_one_variable(&r->joints[leader])) continue;
        j->mimic = leader;
        // Every value of the leading joint must be valid for the following one.
        j->lower = -1e9, j->upper = 1e9;
        j->multiplier = random_below(s, 3) ? random_uniform(s, -2, 2) : -1;
        j->offset = random_below(s, 2) ? random_uniform(s, -1, 1) : 0;
    }
    r->d = (ovoid_robot_description){
        .links = r->links, .link_count = links, .joints = r->joints, .joint_count = links - 1, .elements = r->elements};
}

/// A state: within limits if there are any, lengths up to 3, angles up to 40, some of them quarter turns.
static inline void make_random_state(uint64_t *s, const ovoid_robot *r, double *q) {
    for (size_t i = 0; i < ovoid_robot_get_variable_count(r); i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(r, i);
        ovoid_joint_type type = ovoid_robot_get_description(r).joints[v.joint].type;
        q[i] = isfinite(v.lower) ? random_uniform(s, v.lower, v.upper) : random_uniform(s, -3, 3);
        int is_angle = type == OVOID_JOINT_CONTINUOUS || (type == OVOID_JOINT_PLANAR && v.component == 2);
        if (is_angle) q[i] = random_uniform(s, -40, 40);
        if (is_angle && random_below(s, 4) == 0) q[i] = 1.5707963267948966 * (double)(int)random_below(s, 9) - 4;
    }
}

#endif
