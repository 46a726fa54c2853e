// Eight states side by side: their frames and spheres, and which groups their spheres and boxes part, all of which is
// the same arithmetic as for one state, in lanes (simd/robot/robot8.h). What is left goes state by state.
#include "robot/cell/checker.h"

static void place_values(ovoid_robot_checker *x, const double *q, double slack, uint32_t k, lane_state *state) {
    const ovoid_robot *r = x->cell->robot;
    ovoid_error refused;
    state->code = OVOID_OK;
    if (slack < INFINITY && !state_is_within_limits(r, q, slack))
        state->code = ovoid_robot_validate_limits(r, q, slack, &refused);
    if (state->code == OVOID_OK)
        state->code = robot_compute_values(r, q, x->values8[0] + k, ROBOT8, &state->magnitude, &refused);
    if (state->code != OVOID_OK) state->variable = (uint32_t)refused.place;
}

void checker_place_lanes(ovoid_robot_checker *x, const double *q, size_t count, double limit_slack,
                         lane_state states[ROBOT8]) {
    const ovoid_robot_cell *c = x->cell;
    uint32_t first = ROBOT8;
    for (uint32_t k = 0; k < count; k++) {
        place_values(x, q + k * c->robot->variable_count, limit_slack, k, &states[k]);
        if (first == ROBOT8 && states[k].code == OVOID_OK) first = k;
    }
    x->filter.is_made = 0;
    if (first == ROBOT8) return;
    // The errors of the first; states of another level have their spheres made again.
    checker_set_level(x, states[first].magnitude);
    x->filter.level = x->level;
    x->kernels->chain(c->steps.items, (uint32_t)c->steps.count, (const double(*)[ROBOT8])x->values8, x->frames8);
    for (size_t i = 0; i < c->groups.count; i++) {
        const cell_group *g = &cell_groups(c)[i];
        const double center[3] = {g->center.x, g->center.y, g->center.z};
        x->kernels->place(&x->frames8[g->link], center, g->reach + x->group_errors[i], &x->spheres8[i]);
    }
}

// ---- the filter

static void filter_parts(ovoid_robot_checker *x, double margin) {
    const ovoid_robot_cell *c = x->cell;
    size_t count = 0;
    for (uint32_t i = 0; i < c->groups.count; i++) {
        const double more[2] = {margin, c->padding[cell_groups(c)[i].link]};
        for (uint32_t first = 0; first < c->parts.count; first += ROBOT8) {
            uint32_t here = c->parts.count - first < ROBOT8 ? (uint32_t)c->parts.count - first : ROBOT8;
            unsigned char near[ROBOT8];
            x->kernels->near_boxes8(&cell_boxes(c)[first / ROBOT8], here, &x->spheres8[i], more, near);
            for (uint32_t k = 0; k < here; k++)
                if (near[k]) x->filter.parts[count++] = (near_lanes){i, first + k, near[k]};
        }
    }
    x->filter.part_count = count;
}

static linked_box8 get_linked_box(const ovoid_robot_checker *x, uint32_t group) {
    const cell_group *g = &cell_groups(x->cell)[group];
    return (linked_box8){&x->frames8[g->link], g->middle, g->half, g->radius + x->group_errors[group]};
}

static void filter_pairs(ovoid_robot_checker *x, double margin) {
    const ovoid_robot_cell *c = x->cell;
    size_t count = 0;
    for (uint32_t i = 0; i < c->group_pairs.count; i++) {
        const group_pair *p = &cell_group_pairs(c)[i];
        unsigned near = x->kernels->near_spheres(&x->spheres8[p->a], &x->spheres8[p->b], margin);
        if (!near) continue;
        linked_box8 a = get_linked_box(x, p->a), b = get_linked_box(x, p->b);
        near &= x->kernels->near_linked_boxes(&a, &b, margin);
        if (near) x->filter.pairs[count++] = (near_lanes){p->a, i, near};
    }
    x->filter.pair_count = count;
}

void checker_filter_lanes(ovoid_robot_checker *x, const ovoid_robot_query_options *options) {
    if (!options->without_obstacles) filter_parts(x, options->margin);
    if (!options->without_self) filter_pairs(x, options->margin);
    x->filter.is_made = 1;
}

void checker_take_lane(ovoid_robot_checker *x, uint32_t which, const lane_state *state) {
    checker_set_level(x, state->magnitude);
    x->state++;
    x->lane = (int)which;
    x->filter.is_on = x->filter.is_made && x->level == x->filter.level;
    if (x->filter.is_on) return;
    for (size_t i = 0; i < x->cell->groups.count; i++) {
        double(*c)[ROBOT8] = x->spheres8[i].column;
        vec3 center = {c[0][which], c[1][which], c[2][which]};
        x->places[i] = sphere_place_make(center, cell_groups(x->cell)[i].reach + x->group_errors[i]);
    }
}
