// Where the links are: the chain of joints compiled to steps, run for one state, and what rounding does to it.
//
// A step turns by the unit quaternion l = cos(a/2) o + sin(a/2) (o n) in its parent's frame, o being the origin's
// rotation, n the axis, a the angle, and moves by t. Quaternions are multiplied along the chain, R. Featherstone, Rigid
// body dynamics algorithms, 2008, has the tree; docs/robot-states.md has the bounds. Eight states at once:
// simd/robot/robot8.h.
#ifndef OVOID_ROBOT_MODEL_KINEMATICS_H
#define OVOID_ROBOT_MODEL_KINEMATICS_H

#include "linear/rotation.h"
#include "motion/motion_angle.h"
#include "robot/model/robot.h"

/// A frame in the world.
typedef struct link_frame {
    vec3 position;
    ovoid_quat rotation; ///< unit to rounding
    mat3 matrix;         ///< of it
} link_frame;

static inline link_frame frame_make_world(void) {
    return (link_frame){{0, 0, 0}, {1, 0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

static inline ovoid_quat quat_multiply(ovoid_quat a, ovoid_quat b) {
    return (ovoid_quat){
        (a.w * b.w - a.x * b.x) - (a.y * b.y + a.z * b.z), (a.w * b.x + a.x * b.w) + (a.y * b.z - a.z * b.y),
        (a.w * b.y - a.x * b.z) + (a.y * b.w + a.z * b.x), (a.w * b.z + a.x * b.y) + (a.z * b.w - a.y * b.x)};
}

/// Cosine and sine of any angle up to 1e9.
static inline turn turn_compute_signed(double x) {
    turn t = turn_compute(fabs(x));
    if (x < 0) t.sine = -t.sine;
    return t;
}

/// How many of a step's values are lengths; they come first.
static inline uint32_t step_count_lengths(step_kind kind) {
    return kind == STEP_SLIDE ? 1 : kind == STEP_PLANE ? 2 : kind == STEP_FREE ? 3 : 0;
}

/// The half turn of a step's own values.
static inline turn step_compute_half_turn(const chain_step *s, const double *values) {
    if (s->kind != STEP_TURN && s->kind != STEP_PLANE) return (turn){1, 0};
    return turn_compute_signed(0.5 * values[step_count_lengths(s->kind)]);
}

/// The child's frame from the parent's (not read where the step has none), the step's own values and their half turn.
static inline void step_apply(const chain_step *s, const link_frame *parent, const double *values, turn half,
                              link_frame *child) {
    ovoid_quat q = s->rest;
    vec3 p = s->origin;
    uint32_t lengths = step_count_lengths(s->kind);
    for (uint32_t i = 0; i < lengths; i++) p = vec3_add_scaled(p, s->along[i], values[i]);
    if (s->kind == STEP_TURN || s->kind == STEP_PLANE) {
        double c = half.cosine, d = half.sine;
        ovoid_quat o = q, t = s->turned;
        q = (ovoid_quat){c * o.w + d * t.w, c * o.x + d * t.x, c * o.y + d * t.y, c * o.z + d * t.z};
    } else if (s->kind == STEP_FREE) {
        ovoid_quat v = {values[3], values[4], values[5], values[6]};
        double scale = 1 / sqrt(quat_norm_squared(v));
        q = quat_multiply(q, (ovoid_quat){v.w * scale, v.x * scale, v.y * scale, v.z * scale});
    }
    if (s->parent != OVOID_ROBOT_NONE) {
        p = vec3_add(parent->position, mat3_mul_vec3(parent->matrix, p));
        q = quat_multiply(parent->rotation, q);
    }
    *child = (link_frame){p, q, quat_to_mat3(q)};
}

/// Runs steps, parents before children, from the values of all joints and the half turns of these.
static inline void steps_compute_frames(const chain_step *steps, size_t count, uint32_t root, const double *values,
                                        const double *cosines, const double *sines, link_frame *frames) {
    for (size_t i = 0; i < count; i++) {
        const chain_step *s = &steps[i];
        turn half = {1, 0};
        if (s->kind == STEP_TURN || s->kind == STEP_PLANE) {
            uint32_t at = s->value + step_count_lengths(s->kind);
            half = (turn){cosines[at], sines[at]};
        }
        uint32_t parent = s->parent == OVOID_ROBOT_NONE ? root : s->parent;
        step_apply(s, &frames[parent], values + s->value, half, &frames[s->child]);
    }
}

/// The values of a joint's step, mimics followed; *magnitude grows to the largest variable that errors are proportional
/// to. Refused: NOT_FINITE, RANGE, ROTATION (*component: which of the joint's).
ovoid_code joint_compute_values(const ovoid_robot *r, uint32_t joint, const double *q, double *values,
                                double *magnitude, uint32_t *component);

/// What is refused about a variable, as a sentence.
ovoid_code state_refuse(const ovoid_robot *r, ovoid_code code, uint32_t variable, ovoid_error *error);

/// The values of all joints, `stride` apart.
ovoid_code robot_compute_values(const ovoid_robot *r, const double *q, double *values, size_t stride, double *magnitude,
                                ovoid_error *error);

/// Whether a state's numbers are within limits, NaN being nowhere.
int state_is_within_limits(const ovoid_robot *r, const double *q, double slack);

/// The magnitude that errors are computed for: of the limits, or the next power of two above a state's own.
double robot_compute_level(const ovoid_robot *r, double magnitude);

/// How far a frame is from that of the exact kinematics, rounding included: its quaternion from the exact unit one, its
/// origin; and a bound of the origin's distance from the world's.
typedef struct frame_error {
    double quaternion, position, distance;
} frame_error;

/// Errors of a step's own place: its length, what that is off by, and what its quaternion is off by.
typedef struct step_error {
    double length, length_error, quaternion;
} step_error;

/// magnitude: of the variables that errors grow with. joint: NONE for an element.
step_error step_compute_error(const ovoid_robot *r, uint32_t joint, const chain_step *s, double magnitude);
/// The child's from its parent's; distance: of the child's origin from the world's.
frame_error frame_error_compute(const frame_error *parent, const step_error *s, double distance);

/// Steps with their joints; NULL: each is fixed to its parent.
typedef struct step_list {
    const ovoid_robot *robot;
    const chain_step *steps;
    const uint32_t *joints;
    size_t count;
} step_list;

/// The errors of the steps' frames, for states of that magnitude; infinite where nothing is proven. Parents' are there.
void steps_compute_errors(const step_list *list, double magnitude, frame_error *errors);

/// 1: nothing is moved or turned by it.
int pose_is_identity(const ovoid_pose *p);
/// The step of a frame that is fixed in its parent.
chain_step step_make_fixed(uint32_t parent, uint32_t child, const ovoid_pose *pose);

/// What a point may be off by that is no farther than `reach` from the frame's origin. Unit quaternions that are e
/// apart mean rotations that are at most 2 e apart.
static inline double frame_error_at(const frame_error *e, double reach) {
    return (e->position + 2 * e->quaternion * reach) * (1 + 0x1p-50);
}

#endif
