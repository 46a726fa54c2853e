// Which obstacles a link may come near within its limits: found once for a cell and where obstacles were, so that
// states do not test the others.
//
// A point of a link stays within `wander` of an anchor that does not move. From the link up to the root: a turning
// joint keeps its axis, so the point is as far from the nearest point of the axis as it was, and that point takes its
// place; a sliding joint moves the point by as much as it slides. What is found so of a group's sphere is a bound for
// all states that are within the limits, and the spheres' own test, which rounds less than SLACK allows, would part the
// same pairs.
#include "robot/cell/checker.h"

#include <string.h>

#define SLACK 1e-9

// ---- anchors

// A state within the limits: zero, or the nearest limit; floating joints are not turned.
static void set_reference(const ovoid_robot *r, double *q) {
    for (uint32_t i = 0; i < r->variable_count; i++) {
        const ovoid_robot_variable *v = &r->variables[i];
        q[i] = max2(v->lower, min2(v->upper, 0));
        if (v->component == 3) q[i] = 1;
    }
}

// By how much a sliding joint may be from where it is in the reference state.
static double find_slide(const ovoid_robot *r, uint32_t joint, const double *q) {
    uint32_t variable = r->joint_variable[joint];
    const ovoid_robot_variable *v = &r->variables[variable];
    return fabs(r->leads[joint].factor) * max2(v->upper - q[variable], q[variable] - v->lower);
}

static group_reach find_reach(const ovoid_robot_checker *checker, const cell_group *g, const double *q) {
    const ovoid_robot *r = checker->cell->robot;
    const link_frame *own = &checker->frames[g->link];
    group_reach reach = {vec3_add(own->position, mat3_mul_vec3(own->matrix, g->center)), 0};
    for (uint32_t link = g->link; link != r->root; link = r->joints[r->parent_joint[link]].parent) {
        uint32_t joint = r->parent_joint[link];
        const chain_step *s = &r->steps[r->step_of[joint]];
        const link_frame *f = &checker->frames[link];
        if (s->kind == STEP_FIXED) continue;
        if (s->kind == STEP_SLIDE) reach.wander += find_slide(r, joint, q) * (1 + SLACK);
        if (s->kind == STEP_PLANE || s->kind == STEP_FREE) reach.wander = INFINITY;
        if (s->kind != STEP_TURN) continue;
        vec3 axis = mat3_mul_vec3(f->matrix, s->axis), d = vec3_sub(reach.anchor, f->position);
        vec3 on_axis = vec3_add_scaled(f->position, axis, vec3_dot(axis, d));
        reach.wander += vec3_norm(vec3_sub(reach.anchor, on_axis)) + SLACK * vec3_norm(d);
        reach.anchor = on_axis;
    }
    return reach;
}

int checker_find_reaches(ovoid_robot_checker *checker) {
    const ovoid_robot_cell *c = checker->cell;
    double magnitude, *q = checker->near_row;
    set_reference(c->robot, q);
    // A robot without a state within its limits has no reaches.
    int is_placed = robot_compute_values(c->robot, q, checker->values, 1, &magnitude, NULL) == OVOID_OK;
    if (is_placed) checker_compute_frames(checker);
    for (size_t i = 0; i < c->groups.count; i++)
        checker->reaches[i] =
            is_placed ? find_reach(checker, &cell_groups(c)[i], q) : (group_reach){{0, 0, 0}, INFINITY};
    return is_placed;
}

// ---- masks

// How far a group's sphere stays from a part's ball, at least, padding aside.
static double find_gap(const ovoid_robot_checker *checker, uint32_t group, uint32_t part) {
    const cell_group *g = &cell_groups(checker->cell)[group];
    const group_reach *reach = &checker->reaches[group];
    const double(*box)[ROBOT8] = cell_boxes(checker->cell)[part / ROBOT8].column;
    uint32_t k = part % ROBOT8;
    vec3 center = {box[BOX8_CENTER][k], box[BOX8_CENTER + 1][k], box[BOX8_CENTER + 2][k]};
    double most = reach->wander + g->reach + checker->group_errors[group] + box[BOX8_BALL][k];
    double size = vec3_norm(center) + vec3_norm(reach->anchor) + most;
    double gap = vec3_norm(vec3_sub(center, reach->anchor)) - most - SLACK * size;
    return gap > 0 ? gap * (1 - SLACK) : -INFINITY;
}

static void set_gaps(ovoid_robot_checker *checker) {
    const ovoid_robot_cell *c = checker->cell;
    for (uint32_t i = 0; i < c->groups.count; i++)
        for (uint32_t k = 0; k < c->boxes.count * ROBOT8; k++)
            checker->reach_gaps[i * c->boxes.count + k / ROBOT8][k % ROBOT8] =
                k < c->parts.count ? find_gap(checker, i, k) : INFINITY;
}

static void set_masks(ovoid_robot_checker *checker, double margin) {
    const ovoid_robot_cell *c = checker->cell;
    for (uint32_t i = 0; i < c->groups.count; i++) {
        double reach = add_up(margin, c->padding[cell_groups(c)[i].link], 0);
        for (size_t block = 0; block < c->boxes.count; block++) {
            size_t at = i * c->boxes.count + block;
            unsigned mask = 0;
            for (unsigned k = 0; k < ROBOT8; k++) mask |= (unsigned)!(checker->reach_gaps[at][k] > reach) << k;
            // A margin without end is no reason to look beyond the last part.
            if (block + 1 == c->boxes.count) mask &= (1u << (c->parts.count - block * ROBOT8)) - 1;
            checker->reach_masks[at] = (uint8_t)mask;
        }
    }
}

void checker_renew_masks(ovoid_robot_checker *checker, double margin) {
    const reach_key key = {margin, checker->level, checker->cell->moved};
    reach_key *is = &checker->reach_key;
    int is_same = is->level == key.level && is->moved == key.moved;
    if (is_same && is->margin == margin) return;
    if (!is_same) set_gaps(checker);
    set_masks(checker, margin);
    *is = key;
}
