// The chain of joints compiled to steps, and the bounds of its rounding. docs/robot-states.md derives the numbers.
#include "robot/model/kinematics.h"

#include "linear/rotation.h"

#include <float.h>

#define U ROUNDING

// A unit quaternion along q, off by 4 u.
static ovoid_quat quat_unit(ovoid_quat q) {
    q = quat_scaled(q);
    double n = sqrt(quat_norm_squared(q));
    return (ovoid_quat){q.w / n, q.x / n, q.y / n, q.z / n};
}

// The two directions of the plane normal to a unit vector; of z and -z, the first is x. T. Duff, J. Burgess, P.
// Christensen, C. Hery, A. Kensler, M. Liani, R. Villemin, Building an orthonormal basis, revisited, 2017.
static void find_plane(vec3 n, vec3 *x, vec3 *y) {
    double sign = copysign(1, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    *x = (vec3){1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    *y = (vec3){b, sign + n.y * n.y * a, -n.y};
}

static step_kind find_kind(ovoid_joint_type type) {
    switch (type) {
    case OVOID_JOINT_REVOLUTE:
    case OVOID_JOINT_CONTINUOUS: return STEP_TURN;
    case OVOID_JOINT_PRISMATIC: return STEP_SLIDE;
    case OVOID_JOINT_PLANAR: return STEP_PLANE;
    case OVOID_JOINT_FLOATING: return STEP_FREE;
    default: return STEP_FIXED;
    }
}

static void set_directions(chain_step *s, vec3 axis, const mat3 *origin) {
    vec3 x, y;
    switch (s->kind) {
    case STEP_SLIDE: s->along[0] = mat3_mul_vec3(*origin, axis); break;
    case STEP_PLANE:
        find_plane(axis, &x, &y);
        s->along[0] = mat3_mul_vec3(*origin, x);
        s->along[1] = mat3_mul_vec3(*origin, y);
        break;
    case STEP_FREE:
        for (int i = 0; i < 3; i++) s->along[i] = mat3_mul_vec3(*origin, vec3_make(i == 0, i == 1, i == 2));
        break;
    default: break;
    }
}

static chain_step make_step(const ovoid_robot *r, uint32_t joint) {
    const ovoid_robot_joint *j = &r->joints[joint];
    mat3 origin = quat_to_mat3(j->origin.rotation);
    chain_step s = {.kind = find_kind(j->type),
                    .parent = j->parent == r->root ? OVOID_ROBOT_NONE : j->parent,
                    .child = j->child,
                    .value = r->value_first[joint],
                    .rest = quat_unit(j->origin.rotation),
                    .origin = j->origin.position};
    if (s.kind == STEP_FIXED) return s;
    s.axis = s.kind == STEP_FREE ? (vec3){0, 0, 1} : vec3_unit(j->axis);
    s.turned = quat_multiply(s.rest, (ovoid_quat){0, s.axis.x, s.axis.y, s.axis.z});
    set_directions(&s, s.axis, &origin);
    return s;
}

// Stands for what a joint follows, before that is known.
#define OPEN UINT32_MAX

// What a joint follows, from what the joint that it mimics follows: m (f q + c) + o. Each mimic composed costs both
// numbers some roundings, the value itself two.
static joint_lead find_lead(const ovoid_robot *r, uint32_t joint) {
    const ovoid_robot_joint *j = &r->joints[joint];
    joint_lead lead = {.factor = 1, .spread = 1, .lengths = step_count_lengths(find_kind(j->type))};
    if (j->mimic == OVOID_ROBOT_NONE) return lead;
    const joint_lead *up = &r->leads[j->mimic];
    lead.factor = j->multiplier * up->factor;
    lead.spread = fabs(j->multiplier) * up->spread;
    lead.offset = j->multiplier * up->offset + j->offset;
    lead.offset_spread = fabs(j->multiplier) * up->offset_spread + fabs(j->offset);
    int is_exact = fabs(j->multiplier) == 1 && j->offset == 0;
    lead.error = up->error > 0 ? up->error + 4 * U : is_exact ? 0 : 8 * U;
    return lead;
}

// All leads, those that are followed first: the way up from a joint is kept as a list in step_of, which is not set yet.
// Linear.
static void find_leads(ovoid_robot *r) {
    for (uint32_t i = 0; i < r->joint_count; i++) r->leads[i].lengths = OPEN;
    for (uint32_t i = 0; i < r->joint_count; i++) {
        uint32_t first = OVOID_ROBOT_NONE;
        for (uint32_t k = i; k != OVOID_ROBOT_NONE && r->leads[k].lengths == OPEN; k = r->joints[k].mimic) {
            r->step_of[k] = first;
            first = k;
        }
        for (; first != OVOID_ROBOT_NONE; first = r->step_of[first]) r->leads[first] = find_lead(r, first);
    }
}

static void find_followers(ovoid_robot *r) {
    r->follower_count = 0;
    for (uint32_t i = 0; i < r->joint_count; i++) {
        const ovoid_robot_joint *j = &r->joints[i];
        int is_limited = j->type == OVOID_JOINT_REVOLUTE || j->type == OVOID_JOINT_PRISMATIC;
        if (j->mimic != OVOID_ROBOT_NONE && is_limited) r->followers[r->follower_count++] = i;
    }
}

static void find_magnitude(ovoid_robot *r) {
    r->magnitude = 0;
    for (uint32_t i = 0; i < r->joint_count; i++) {
        if (!lead_is_scaled(&r->leads[i])) continue;
        const ovoid_robot_variable *v = &r->variables[r->joint_variable[i]];
        if (isfinite(v->lower) && isfinite(v->upper))
            r->magnitude = max2(r->magnitude, max2(fabs(v->lower), fabs(v->upper)));
    }
}

int pose_is_identity(const ovoid_pose *p) {
    return p->position.x == 0 && p->position.y == 0 && p->position.z == 0 && p->rotation.w > 0 && p->rotation.x == 0 &&
           p->rotation.y == 0 && p->rotation.z == 0;
}

chain_step step_make_fixed(uint32_t parent, uint32_t child, const ovoid_pose *pose) {
    return (chain_step){.kind = STEP_FIXED,
                        .parent = parent,
                        .child = child,
                        .rest = quat_unit(pose->rotation),
                        .origin = pose->position};
}

static void set_sources(ovoid_robot *r, uint32_t joint) {
    const joint_lead *lead = &r->leads[joint];
    uint32_t count = ovoid_joint_type_get_variable_count(r->joints[joint].type);
    if (count == 7) r->free_values[r->free_count++] = r->value_first[joint] + 3;
    for (uint32_t i = 0; i < count; i++) {
        int is_length = i < lead->lengths;
        r->sources[r->value_first[joint] + i] = (value_source){.factor = lead->factor,
                                                               .offset = lead->offset,
                                                               .most = is_length   ? OVOID_LENGTH_MAX
                                                                       : count < 7 ? OVOID_ROBOT_ANGLE_MAX
                                                                                   : DBL_MAX,
                                                               .scale = is_length || lead->error > 0,
                                                               .variable = r->joint_variable[joint] + i};
    }
}

void chain_compile(ovoid_robot *r) {
    r->value_count = 0;
    for (uint32_t i = 0; i < r->joint_count; i++) {
        r->value_first[i] = r->value_count;
        r->value_count += ovoid_joint_type_get_variable_count(r->joints[i].type);
    }
    find_leads(r);
    find_followers(r);
    for (uint32_t i = 0; i < r->joint_count; i++) set_sources(r, i);
    find_magnitude(r);
    for (uint32_t i = 0; i < r->joint_count; i++) {
        r->steps[i] = make_step(r, r->order[i]);
        r->step_of[r->order[i]] = i;
    }
}

// ---- errors

step_error step_compute_error(const ovoid_robot *r, uint32_t joint, const chain_step *s, double magnitude) {
    double origin = vec3_norm(s->origin) * (1 + 8 * U), lengths = 0, value_error = 0;
    if (joint != OVOID_ROBOT_NONE) {
        const joint_lead *lead = &r->leads[joint];
        uint32_t count = step_count_lengths(s->kind);
        double value = lead->spread * magnitude + lead->offset_spread;
        lengths = count > 1 ? 2 * magnitude : count ? value : 0;
        value_error = lead->error > 0 ? lead->error * value : 0;
    }
    step_error e = {.length = origin + lengths, .length_error = 96 * U * lengths, .quaternion = 4 * U};
    if (lengths > 0) e.length_error += 4 * U * origin;
    if (s->kind == STEP_SLIDE) e.length_error += 1.01 * value_error;
    if (s->kind == STEP_TURN || s->kind == STEP_PLANE) e.quaternion = 32 * U + 0.51 * value_error;
    if (s->kind == STEP_FREE) e.quaternion = 32 * U;
    return e;
}

frame_error frame_error_compute(const frame_error *parent, const step_error *s, double distance) {
    frame_error e = {.distance = distance};
    e.quaternion = parent->quaternion * (1 + s->quaternion) + s->quaternion + 9 * U;
    e.position = parent->position + (2 * parent->quaternion + 44 * U) * s->length + 1.01 * s->length_error +
                 2 * U * distance + OVOID_LENGTH_MIN;
    // What the products of errors may add was counted for small ones only.
    if (!(e.quaternion <= 0x1p-10)) e.quaternion = e.position = INFINITY;
    return e;
}

void steps_compute_errors(const step_list *list, double magnitude, frame_error *errors) {
    static const frame_error world = {0, 0, 0};
    for (size_t i = 0; i < list->count; i++) {
        const chain_step *s = &list->steps[i];
        const frame_error parent = s->parent == OVOID_ROBOT_NONE ? world : errors[s->parent];
        uint32_t joint = list->joints ? list->joints[i] : OVOID_ROBOT_NONE;
        step_error own = step_compute_error(list->robot, joint, s, magnitude);
        errors[s->child] = frame_error_compute(&parent, &own, (parent.distance + own.length) * (1 + 4 * U));
    }
}

double robot_compute_level(const ovoid_robot *r, double magnitude) {
    if (magnitude <= r->magnitude) return r->magnitude;
    int exponent;
    (void)frexp(magnitude, &exponent);
    return ldexp(1, exponent);
}
