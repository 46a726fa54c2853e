// The poses of all links for one state and for many, and what is wrong with a state.
#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "robot/model/kinematics.h"

// ---- values

ovoid_code joint_compute_values(const ovoid_robot *r, uint32_t joint, const double *q, double *values,
                                double *magnitude, uint32_t *component) {
    const joint_lead *lead = &r->leads[joint];
    uint32_t count = ovoid_joint_type_get_variable_count(r->joints[joint].type);
    const double *from = q + (count ? r->joint_variable[joint] : 0);
    for (uint32_t i = 0; i < count; i++) {
        double value = count == 1 ? lead->factor * from[0] + lead->offset : from[i];
        double most = i < lead->lengths ? OVOID_LENGTH_MAX : count < 7 ? OVOID_ROBOT_ANGLE_MAX : INFINITY;
        *component = count == 1 ? 0 : i;
        if (!isfinite(value)) return OVOID_ERROR_NOT_FINITE;
        if (fabs(value) > most) return OVOID_ERROR_RANGE;
        if (i < lead->lengths || lead->error > 0) *magnitude = max2(*magnitude, fabs(from[i]));
        values[i] = value;
    }
    if (count < 7) return OVOID_OK;
    ovoid_quat v = {values[3], values[4], values[5], values[6]};
    if (v.w == 0 && v.x == 0 && v.y == 0 && v.z == 0) return OVOID_ERROR_ROTATION;
    if (!quat_is_plain(quat_norm_squared(v))) v = quat_scaled(v);
    values[3] = v.w, values[4] = v.x, values[5] = v.y, values[6] = v.z;
    return OVOID_OK;
}

ovoid_code state_refuse(const ovoid_robot *r, ovoid_code code, uint32_t variable, ovoid_error *error) {
    const char *what = code == OVOID_ERROR_ROTATION     ? "is of a quaternion of four zeros"
                       : code == OVOID_ERROR_NOT_FINITE ? "is NaN or infinite, or its joint's value is"
                                                        : "is an angle above 1e9 or a length above 1e50";
    return error_set(error, code, (int64_t)variable, "variable %u, of joint \"%.80s\", %s", variable,
                     r->joints[r->variables[variable].joint].name, what);
}

// The joints one by one: quaternions, and what is wrong.
static ovoid_code compute_values_slowly(const ovoid_robot *r, const double *q, double *values, size_t stride,
                                        double *magnitude, ovoid_error *error) {
    for (uint32_t i = 0; i < r->joint_count; i++) {
        double own[7] = {0};
        uint32_t component, count = ovoid_joint_type_get_variable_count(r->joints[i].type);
        ovoid_code code = joint_compute_values(r, i, q, own, magnitude, &component);
        if (code != OVOID_OK) return state_refuse(r, code, r->joint_variable[i] + component, error);
        for (uint32_t k = 0; k < count; k++) values[(r->value_first[i] + k) * stride] = own[k];
    }
    return OVOID_OK;
}

ovoid_code robot_compute_values(const ovoid_robot *r, const double *q, double *values, size_t stride, double *magnitude,
                                ovoid_error *error) {
    *magnitude = 0;
    int is_good = 1;
    for (uint32_t i = 0; i < r->value_count; i++) {
        const value_source *from = &r->sources[i];
        double value = from->factor * q[from->variable] + from->offset;
        is_good &= fabs(value) <= from->most;
        *magnitude = max2(from->scale * fabs(q[from->variable]), *magnitude);
        values[i * stride] = value;
    }
    for (uint32_t i = 0; i < r->free_count; i++) {
        const double *v = values + r->free_values[i] * stride;
        is_good &= quat_is_plain(quat_norm_squared((ovoid_quat){v[0], v[stride], v[2 * stride], v[3 * stride]}));
    }
    return is_good ? OVOID_OK : compute_values_slowly(r, q, values, stride, magnitude, error);
}

// ---- one state

// The error of a joint's child, from the pose itself.
static void set_error(const ovoid_robot *r, uint32_t joint, double magnitude, const ovoid_pose *poses,
                      ovoid_robot_pose_error *errors) {
    const chain_step *s = &r->steps[joint];
    step_error own = step_compute_error(r, r->order[joint], s, magnitude);
    frame_error parent = {0, 0, 0};
    if (s->parent != OVOID_ROBOT_NONE)
        parent = (frame_error){errors[s->parent].rotation / 2, errors[s->parent].position, 0};
    double distance = vec3_norm(poses[s->child].position) * (1 + 8 * ROUNDING);
    frame_error e = frame_error_compute(&parent, &own, distance);
    errors[s->child] = (ovoid_robot_pose_error){e.position, 2 * e.quaternion};
}

static ovoid_code compute_poses(const ovoid_robot *r, const double *q, ovoid_pose *poses, ovoid_error *error) {
    double magnitude = 0;
    poses[r->root] = (ovoid_pose){{0, 0, 0}, {1, 0, 0, 0}};
    for (uint32_t i = 0; i < r->joint_count; i++) {
        const chain_step *s = &r->steps[i];
        link_frame parent = frame_make_world(), child;
        double values[7] = {0};
        uint32_t component;
        ovoid_code code = joint_compute_values(r, r->order[i], q, values, &magnitude, &component);
        if (code != OVOID_OK) return state_refuse(r, code, r->joint_variable[r->order[i]] + component, error);
        if (s->parent != OVOID_ROBOT_NONE) {
            const ovoid_pose *p = &poses[s->parent];
            parent = (link_frame){p->position, p->rotation, quat_to_mat3(p->rotation)};
        }
        turn half = step_compute_half_turn(s, values);
        step_apply(s, &parent, values, half, &child);
        poses[s->child] = (ovoid_pose){child.position, child.rotation};
    }
    return OVOID_OK;
}

ovoid_code ovoid_robot_compute_poses(const ovoid_robot *robot, const double *q, ovoid_pose *poses, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, robot, compute_poses(robot, q, poses, error));
}

static void compute_pose_errors(const ovoid_robot *r, const double *q, const ovoid_pose *poses,
                                ovoid_robot_pose_error *errors) {
    double magnitude = 0;
    for (uint32_t i = 0; i < r->joint_count; i++) {
        double values[7];
        uint32_t component;
        (void)joint_compute_values(r, r->order[i], q, values, &magnitude, &component);
    }
    errors[r->root] = (ovoid_robot_pose_error){0, 0};
    for (uint32_t i = 0; i < r->joint_count; i++) set_error(r, i, magnitude, poses, errors);
}

void ovoid_robot_compute_pose_errors(const ovoid_robot *robot, const double *q, const ovoid_pose *poses,
                                     ovoid_robot_pose_error *errors) {
    ENVIRONMENT_RUN(compute_pose_errors(robot, q, poses, errors));
}

// ---- many states

// A group of up to eight states, a lane each; empty lanes repeat the first.
typedef struct lane_group {
    double (*values)[ROBOT8];
    frame8 *frames;
} lane_group;

static void write_poses(const ovoid_robot *r, const frame8 *frames, uint32_t lane, ovoid_pose *poses) {
    for (uint32_t i = 0; i < r->link_count; i++) {
        const double(*c)[ROBOT8] = frames[i].column;
        poses[i] = (ovoid_pose){{c[0][lane], c[1][lane], c[2][lane]}, {c[3][lane], c[4][lane], c[5][lane], c[6][lane]}};
    }
    poses[r->root] = (ovoid_pose){{0, 0, 0}, {1, 0, 0, 0}};
}

static ovoid_code compute_group(const ovoid_robot *r, const ovoid_robot_pose_batch *part, lane_group *g,
                                ovoid_error *error) {
    for (size_t k = 0; k < ROBOT8; k++) {
        double magnitude;
        const double *state = part->q + (k < part->count ? k : 0) * r->variable_count;
        ovoid_code code = robot_compute_values(r, state, g->values[0] + k, ROBOT8, &magnitude, error);
        if (code != OVOID_OK) return code;
    }
    robot8_get_kernels()->chain(r->steps, r->joint_count, (const double(*)[ROBOT8])g->values, g->frames);
    for (size_t k = 0; k < part->count; k++) write_poses(r, g->frames, (uint32_t)k, part->poses + k * r->link_count);
    return OVOID_OK;
}

static ovoid_code compute_poses_batch(const ovoid_robot *r, const ovoid_robot_pose_batch *batch, ovoid_error *error) {
    lane_group g = {allocator_allocate(&r->allocator, (size_t)r->value_count + 1, sizeof *g.values),
                    allocator_allocate(&r->allocator, r->link_count, sizeof *g.frames)};
    ovoid_code code = OVOID_OK;
    if (!g.values || !g.frames) code = error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for eight states");
    for (size_t i = 0; code == OVOID_OK && i < batch->count; i += ROBOT8) {
        size_t rest = batch->count - i;
        const ovoid_robot_pose_batch part = {batch->q + i * r->variable_count, rest < ROBOT8 ? rest : ROBOT8,
                                             batch->poses + i * r->link_count};
        code = compute_group(r, &part, &g, error);
    }
    allocator_release(&r->allocator, g.values);
    allocator_release(&r->allocator, g.frames);
    return code;
}

ovoid_code ovoid_robot_compute_poses_batch(const ovoid_robot *robot, const ovoid_robot_pose_batch *batch,
                                           ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, robot, compute_poses_batch(robot, batch, error));
}

// ---- limits

// 1 if a joint that follows another one is outside its own limits by more than slack and what rounding may do.
static int is_follower_outside(const ovoid_robot *r, uint32_t joint, const double *q, double slack, double *value) {
    const joint_lead *lead = &r->leads[joint];
    double leader = q[r->joint_variable[joint]];
    *value = lead->factor * leader + lead->offset;
    slack += (lead->error + 2 * ROUNDING) * (lead->spread * fabs(leader) + lead->offset_spread);
    return !(*value >= r->joints[joint].lower - slack && *value <= r->joints[joint].upper + slack);
}

int state_is_within_limits(const ovoid_robot *r, const double *q, double slack) {
    int is_within = 1;
    double value;
    for (uint32_t i = 0; i < r->follower_count; i++)
        is_within &= !is_follower_outside(r, r->followers[i], q, slack, &value);
    for (uint32_t i = 0; i < r->variable_count; i++)
        is_within &= (q[i] >= r->variables[i].lower - slack) & (q[i] <= r->variables[i].upper + slack);
    return is_within;
}

static ovoid_code validate_limits(const ovoid_robot *r, const double *q, double slack, ovoid_error *error) {
    for (uint32_t i = 0; i < r->variable_count; i++) {
        const ovoid_robot_variable *v = &r->variables[i];
        if (!isfinite(q[i])) return state_refuse(r, OVOID_ERROR_NOT_FINITE, i, error);
        if (q[i] >= v->lower - slack && q[i] <= v->upper + slack) continue;
        return error_set(error, OVOID_ERROR_RANGE, (int64_t)i,
                         "variable %u, of joint \"%.80s\", is %.9g, outside its limits %.9g to %.9g", i,
                         r->joints[v->joint].name, q[i], v->lower, v->upper);
    }
    for (uint32_t i = 0; i < r->follower_count; i++) {
        const ovoid_robot_joint *j = &r->joints[r->followers[i]];
        uint32_t variable = r->joint_variable[r->followers[i]];
        double value;
        if (is_follower_outside(r, r->followers[i], q, slack, &value))
            return error_set(error, OVOID_ERROR_RANGE, (int64_t)variable,
                             "joint \"%.60s\", which follows \"%.60s\", is %.9g, outside its limits %.9g to %.9g",
                             j->name, r->joints[j->mimic].name, value, j->lower, j->upper);
    }
    return OVOID_OK;
}

ovoid_code ovoid_robot_validate_limits(const ovoid_robot *robot, const double *q, double slack, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, slack, validate_limits(robot, q, slack, error));
}
