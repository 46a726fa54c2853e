// Between two states a joint's speed is its difference over that of the times; one that follows another is as fast as
// that times its factor. Planar and floating joints have no one number: they are not looked at.
#include "robot/path/speed.h"

#include "base/message.h"

#include <math.h>

/// Times and numbers of a file are rounded: a joint at its limit is not too fast.
#define ALLOWED 1e-9

/// By what a joint's number goes when that of the variable which moves it goes by 1.
static double get_factor(const ovoid_robot_description *d, uint32_t joint) {
    double factor = 1;
    for (; d->joints[joint].mimic != OVOID_ROBOT_NONE; joint = d->joints[joint].mimic)
        factor *= d->joints[joint].multiplier;
    return factor;
}

int speed_report(const cli_cell *cell, const cli_states *states, size_t i) {
    const ovoid_robot_description *d = &cell->description;
    size_t n = states->variable_count;
    const double *q0 = states->q + i * n, *q1 = q0 + n;
    double seconds = states->times[i + 1] - states->times[i];
    int is_too_fast = 0;
    for (uint32_t k = 0; k < d->joint_count; k++) {
        const ovoid_robot_joint *j = &d->joints[k];
        if (!(j->velocity > 0) || ovoid_joint_type_get_variable_count(j->type) != 1) continue;
        uint32_t v = ovoid_robot_get_joint_variable(cell->robot.robot, k);
        double speed = fabs(get_factor(d, k) * (q1[v] - q0[v])) / seconds;
        if (speed <= j->velocity * (1 + ALLOWED)) continue;
        is_too_fast = 1;
        message_warning("from state %zu to state %zu: joint %s goes %.6g per second, its limit is %.6g", i, i + 1,
                        j->name, speed, j->velocity);
    }
    return is_too_fast;
}
