// What the targets of robots share: a look at all that was read.
#ifndef OVOID_FUZZ_ROBOT_H
#define OVOID_FUZZ_ROBOT_H

#include "fuzz.h"

#include <ovoid/robot_io.h>

static inline void fuzz_count_note(void *context, const ovoid_robot_note *note) {
    fuzz_require(note->path != NULL && note->text[0] != 0);
    ++*(size_t *)context;
}

/// Indices in range, and a robot can be made of it.
static inline void fuzz_walk_robot(const ovoid_robot_file *file) {
    ovoid_robot_description d = ovoid_robot_file_get_description(file);
    fuzz_require(d.link_count > 0 && d.joint_count + 1 == d.link_count);
    for (size_t i = 0; i < d.element_count; i++)
        fuzz_require(d.elements[i].link < d.link_count && d.elements[i].shape != NULL);
    for (size_t i = 0; i < d.disabled_count; i++)
        fuzz_require(d.disabled[i].a < d.disabled[i].b && d.disabled[i].b < d.link_count);
    for (size_t i = 0; i < ovoid_robot_file_get_group_count(file); i++) {
        ovoid_robot_group g = ovoid_robot_file_get_group(file, i);
        for (size_t k = 0; k < g.joint_count; k++) fuzz_require(g.joints[k] < d.joint_count);
        for (size_t k = 0; k < g.link_count; k++) fuzz_require(g.links[k] < d.link_count);
    }
    for (size_t i = 0; i < ovoid_robot_file_get_state_count(file); i++) {
        ovoid_robot_state s = ovoid_robot_file_get_state(file, i);
        for (size_t k = 0; k < s.value_count; k++) fuzz_require(s.values[k].joint < d.joint_count);
    }
    for (size_t i = 0; i < ovoid_robot_file_get_ignored_count(file); i++)
        fuzz_require(ovoid_robot_file_get_ignored(file, i).count > 0);
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_robot *robot = ovoid_robot_create(&d, NULL, &error);
    // What the reader lets through is a robot.
    fuzz_require(robot != NULL);
    ovoid_robot_destroy(robot);
}

#endif
