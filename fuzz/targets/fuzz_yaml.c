// MoveIt's scenes, in YAML and as text, its requests and its trajectories.
#include "robot.h"

#include <math.h>

static void read_obstacles(const char *path, const ovoid_robot_read_options *options) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_obstacles *o = ovoid_obstacles_read(path, options, &error);
    if (!o) fuzz_require_error(&error);
    for (size_t i = 0; o && i < ovoid_obstacles_get_count(o); i++) {
        ovoid_obstacle obstacle = ovoid_obstacles_get(o, i);
        fuzz_require(obstacle.name[0] != 0 && obstacle.shape != NULL);
        fuzz_require(ovoid_pose_validate(&obstacle.pose) == OVOID_OK);
    }
    ovoid_obstacles_destroy(o);
}

static void read_trajectory(const char *path, const ovoid_robot_read_options *options) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_trajectory *t = ovoid_trajectory_read(path, options, &error);
    if (!t) {
        fuzz_require_error(&error);
        return;
    }
    size_t count, points = ovoid_trajectory_get_count(t);
    const ovoid_joint_position *start = ovoid_trajectory_get_start(t, &count);
    for (size_t k = 0; k < count; k++) fuzz_require(start[k].joint != NULL && isfinite(start[k].position));
    fuzz_require(points > 0);
    for (size_t i = 0; i < points; i++) {
        const ovoid_joint_position *point = ovoid_trajectory_get_point(t, i, &count);
        for (size_t k = 0; k < count; k++) fuzz_require(point[k].joint != NULL && isfinite(point[k].position));
        fuzz_require(isnan(ovoid_trajectory_get_time(t, i)) == isnan(ovoid_trajectory_get_time(t, 0)));
    }
    ovoid_trajectory_destroy(t);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ovoid_error error = {OVOID_OK, -1, ""};
    size_t notes = 0, count;
    ovoid_robot_read_options options = {.note = fuzz_count_note, .context = &notes};
    const char *path = fuzz_write_file("scene.yaml", data, size);
    read_obstacles(path, &options);
    read_obstacles(fuzz_write_file("text.scene", data, size), &options);
    read_trajectory(path, &options);
    path = fuzz_write_file("request.yaml", data, size);
    ovoid_motion_request *r = ovoid_motion_request_read(path, &options, &error);
    if (!r) {
        fuzz_require_error(&error);
        return 0;
    }
    const ovoid_joint_position *start = ovoid_motion_request_get_start(r, &count);
    for (size_t i = 0; i < count; i++) fuzz_require(start[i].joint != NULL && isfinite(start[i].position));
    for (size_t i = 0; i < ovoid_motion_request_get_goal_count(r); i++) {
        const ovoid_joint_position *goal = ovoid_motion_request_get_goal(r, i, &count);
        for (size_t k = 0; k < count; k++) fuzz_require(goal[k].joint != NULL && isfinite(goal[k].position));
    }
    ovoid_motion_request_destroy(r);
    return 0;
}
