// From the gradient by a body's pose to that by the robot's variables: each joint between the root and the body moves
// it (D. E. Whitney, Resolved motion rate control of manipulators and human prostheses, 1969). Joints that move both
// bodies leave their distance as it is, so those above both are not looked at.
#include "robot/cell/checker.h"

// What a small motion of a frame adds to the distance: along t, and about a point by a rotation vector w.
typedef struct motion_gradient {
    vec3 by_translation, by_rotation;
    vec3 point; ///< that the rotation is about
} motion_gradient;

// The derivative by a turn about an axis through `center`.
static double find_turn(const motion_gradient *g, vec3 axis, vec3 center) {
    return vec3_dot(g->by_translation, vec3_cross(axis, vec3_sub(g->point, center))) + vec3_dot(g->by_rotation, axis);
}

// The quaternion of a floating joint: its component k moves the rotation by 2 vec(e_k conj(q)) / |q|^2.
static void add_quaternion(const motion_gradient *g, const mat3 *matrix, vec3 center, const double *q, double *row) {
    ovoid_quat back = {q[0], -q[1], -q[2], -q[3]};
    double scale = 2 / quat_norm_squared(back);
    for (int k = 0; k < 4; k++) {
        ovoid_quat d = quat_multiply((ovoid_quat){k == 0, k == 1, k == 2, k == 3}, back);
        row[k] += find_turn(g, mat3_mul_vec3(*matrix, vec3_scale((vec3){d.x, d.y, d.z}, scale)), center);
    }
}

static void add_joint(const ovoid_robot_checker *checker, uint32_t joint, const motion_gradient *g, const double *q,
                      double *row) {
    const ovoid_robot *r = checker->cell->robot;
    const chain_step *s = &r->steps[r->step_of[joint]];
    if (s->kind == STEP_FIXED) return;
    const link_frame *child = &checker->frames[s->child];
    const link_frame *parent = &checker->frames[s->parent == OVOID_ROBOT_NONE ? r->root : s->parent];
    uint32_t lengths = step_count_lengths(s->kind), variable = r->joint_variable[joint];
    row += variable;
    for (uint32_t i = 0; i < lengths; i++)
        row[i] += r->leads[joint].factor * vec3_dot(g->by_translation, mat3_mul_vec3(parent->matrix, s->along[i]));
    if (s->kind == STEP_TURN || s->kind == STEP_PLANE) {
        vec3 axis = mat3_mul_vec3(child->matrix, s->axis);
        row[lengths] += r->leads[joint].factor * find_turn(g, axis, child->position);
    } else if (s->kind == STEP_FREE) {
        mat3 matrix = mat3_mul(parent->matrix, quat_to_mat3(s->rest));
        add_quaternion(g, &matrix, child->position, q + variable + 3, row + 3);
    }
}

// The joint above a link, and where it is in the order of joints: below zero, there is none.
static int64_t find_place_above(const ovoid_robot *r, uint32_t link) {
    uint32_t joint = link == OVOID_ROBOT_NONE ? OVOID_ROBOT_NONE : r->parent_joint[link];
    return joint == OVOID_ROBOT_NONE ? -1 : (int64_t)r->step_of[joint];
}

void checker_compute_gradient(const ovoid_robot_checker *checker, const checker_pair *p, const double gradient[12],
                              const double *q, double *row) {
    const ovoid_robot *r = checker->cell->robot;
    const double *g = gradient;
    for (uint32_t i = 0; i < r->variable_count; i++) row[i] = 0;
    motion_gradient of_a = {{g[0], g[1], g[2]}, {g[3], g[4], g[5]}, p->pair.pose_a.position};
    motion_gradient of_b = {{g[6], g[7], g[8]}, {g[9], g[10], g[11]}, p->pair.pose_b.position};
    // Goes up both chains, the later of two joints first, as parents come before children: where the chains meet no
    // joint is left that moves one body alone.
    int64_t a = find_place_above(r, p->a->link), b = find_place_above(r, p->b->link);
    while (a != b) {
        int64_t *later = a > b ? &a : &b;
        uint32_t joint = r->order[*later];
        add_joint(checker, joint, a > b ? &of_a : &of_b, q, row);
        *later = find_place_above(r, r->joints[joint].parent);
    }
}
