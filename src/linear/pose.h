// Poses, for the floors above.
#ifndef OVOID_LINEAR_POSE_H
#define OVOID_LINEAR_POSE_H

#include "ovoid/linear.h"

/// ovoid_pose_compute_check, for callers that have set up the floating-point environment.
ovoid_code pose_compute_check(const ovoid_pose *pose);

#endif
