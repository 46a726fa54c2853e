// Eight states side by side: their frames and spheres, and which groups their spheres and boxes part, all of which is
// the same arithmetic as for one state, in lanes (simd/robot/robot8.h). What is left goes state by state.
#include "base/compiler.h"
#include "robot/cell/checker.h"

// One state of the eight, and what is wrong with it.
static void place_values(ovoid_robot_checker *checker, const double *q, double slack, uint32_t k, lane_state *state) {
    const ovoid_robot *r = checker->cell->robot;
    ovoid_error refused;
    state->code = OVOID_OK;
    if (slack < INFINITY && !state_is_within_limits(r, q, slack))
        state->code = ovoid_robot_validate_limits(r, q, slack, &refused);
    if (state->code == OVOID_OK)
        state->code = robot_compute_values(r, q, checker->values8[0] + k, ROBOT8, &state->magnitude, &refused);
    if (state->code != OVOID_OK) state->variable = (uint32_t)refused.place;
}

// The states in which a variable is beyond its limits; NaN is nowhere.
static unsigned find_outside(const ovoid_robot *r, const double *const q[ROBOT8], double slack) {
    unsigned char is_outside[ROBOT8] = {0};
    for (uint32_t i = 0; i < r->variable_count; i++) {
        double low = r->variables[i].lower - slack, high = r->variables[i].upper + slack;
        for (int k = 0; k < ROBOT8; k++) is_outside[k] |= !(q[k][i] >= low) | !(q[k][i] <= high);
    }
    unsigned outside = 0;
    for (int k = 0; k < ROBOT8; k++) outside |= (unsigned)is_outside[k] << k;
    return outside;
}

// The values of all eight, as robot_compute_values has them where nothing is wrong; the states of which something is.
static unsigned compute_values(ovoid_robot_checker *checker, const double *const q[ROBOT8], double magnitudes[ROBOT8]) {
    const ovoid_robot *r = checker->cell->robot;
    unsigned char is_bad[ROBOT8] = {0};
    for (uint32_t i = 0; i < r->value_count; i++) {
        const value_source from = r->sources[i];
        double *values = checker->values8[i];
        for (int k = 0; k < ROBOT8; k++) {
            double variable = q[k][from.variable], value = from.factor * variable + from.offset;
            is_bad[k] |= !(fabs(value) <= from.most);
            values[k] = value;
        }
        if (from.scale > 0)
            for (int k = 0; k < ROBOT8; k++) magnitudes[k] = max2(fabs(q[k][from.variable]), magnitudes[k]);
    }
    unsigned bad = 0;
    for (int k = 0; k < ROBOT8; k++) bad |= (unsigned)is_bad[k] << k;
    return bad;
}

// States of which something is wrong, or whose quaternions or followers are to be looked at, one by one.
static void place_all(ovoid_robot_checker *checker, const double *q, size_t count, double slack,
                      lane_state states[ROBOT8]) {
    const ovoid_robot *r = checker->cell->robot;
    const double *each[ROBOT8];
    double magnitudes[ROBOT8] = {0};
    for (uint32_t k = 0; k < ROBOT8; k++) each[k] = q + (k < count ? k : 0) * r->variable_count;
    unsigned bad = compute_values(checker, each, magnitudes);
    if (slack < INFINITY) bad |= r->follower_count ? ~0u : find_outside(r, each, slack);
    if (r->free_count) bad = ~0u;
    for (uint32_t k = 0; k < count; k++) {
        states[k] = (lane_state){OVOID_OK, 0, magnitudes[k]};
        if (bad >> k & 1) place_values(checker, each[k], slack, k, &states[k]);
    }
}

void checker_place_lanes(ovoid_robot_checker *checker, const double *q, size_t count, double limit_slack,
                         lane_state states[ROBOT8]) {
    const ovoid_robot_cell *c = checker->cell;
    uint32_t first = ROBOT8;
    place_all(checker, q, count, limit_slack, states);
    for (uint32_t k = (uint32_t)count; k-- > 0;)
        if (states[k].code == OVOID_OK) first = k;
    checker->filter.is_made = 0;
    checker->has_limits = limit_slack == 0;
    if (first == ROBOT8) return;
    // The errors of the first; states of another level have their spheres made again.
    checker_set_level(checker, states[first].magnitude);
    checker->filter.level = checker->level;
    checker->kernels->chain(c->steps.items, (uint32_t)c->steps.count, (const double(*)[ROBOT8])checker->values8,
                            checker->frames8);
    for (size_t i = 0; i < c->groups.count; i++) {
        const cell_group *g = &cell_groups(c)[i];
        const double center[3] = {g->center.x, g->center.y, g->center.z};
        checker->kernels->place(&checker->frames8[g->link], center, g->reach + checker->group_errors[i],
                                &checker->spheres8[i]);
    }
}

// ---- the filter

static void filter_parts(ovoid_robot_checker *checker, double margin) {
    const ovoid_robot_cell *c = checker->cell;
    checker_renew_masks(checker, margin);
    size_t count = 0;
    for (uint32_t i = 0; i < c->groups.count; i++) {
        const double more[2] = {margin, c->padding[cell_groups(c)[i].link]};
        for (uint32_t block = 0; block < c->boxes.count; block++) {
            unsigned mask = checker_get_mask(checker, i, block);
            unsigned char near[ROBOT8];
            if (!mask) continue;
            checker->kernels->near_boxes8(&cell_boxes(c)[block], mask, &checker->spheres8[i], more, near);
            for (uint32_t k = 0; k < ROBOT8; k++)
                if (near[k]) checker->filter.parts[count++] = (near_lanes){i, block * ROBOT8 + k, near[k]};
        }
    }
    checker->filter.part_count = count;
}

static linked_box8 get_linked_box(const ovoid_robot_checker *checker, uint32_t group) {
    const cell_group *g = &cell_groups(checker->cell)[group];
    return (linked_box8){&checker->frames8[g->link], g->middle, g->half, g->radius + checker->group_errors[group]};
}

// The states in which a table does not part a pair.
static unsigned leave_open(const ovoid_robot_checker *checker, const pair_table *table, unsigned near, double margin) {
    unsigned open = near;
    for (; table && near; near &= near - 1) {
        unsigned k = compiler_count_low_zeros(near);
        if (pair_table_is_far(table, checker->values8[0] + k, ROBOT8, margin)) open &= ~(1u << k);
    }
    return open;
}

static void filter_pairs(ovoid_robot_checker *checker, double margin) {
    const ovoid_robot_cell *c = checker->cell;
    size_t count = 0;
    for (uint32_t i = 0; i < c->group_pairs.count; i++) {
        const group_pair *p = &cell_group_pairs(c)[i];
        unsigned near = checker->kernels->near_spheres(&checker->spheres8[p->a], &checker->spheres8[p->b], margin);
        near = leave_open(checker, checker->group_tables[i], near, margin);
        if (!near) continue;
        linked_box8 a = get_linked_box(checker, p->a), b = get_linked_box(checker, p->b);
        near &= checker->kernels->near_linked_boxes(&a, &b, margin);
        if (near) checker->filter.pairs[count++] = (near_lanes){p->a, i, near};
    }
    checker->filter.pair_count = count;
}

void checker_filter_lanes(ovoid_robot_checker *checker, const ovoid_robot_query_options *options) {
    if (!options->without_obstacles) filter_parts(checker, options->margin);
    if (!options->without_self) filter_pairs(checker, options->margin);
    checker->filter.is_made = 1;
}

void checker_take_lane(ovoid_robot_checker *checker, uint32_t which, const lane_state *state) {
    checker_set_level(checker, state->magnitude);
    checker->state++;
    checker->lane = (int)which;
    checker->filter.is_on = checker->filter.is_made && checker->level == checker->filter.level;
    if (checker->filter.is_on) return;
    for (size_t i = 0; i < checker->cell->groups.count; i++) {
        double(*c)[ROBOT8] = checker->spheres8[i].column;
        vec3 center = {c[0][which], c[1][which], c[2][which]};
        checker->places[i] = sphere_place_make(center, cell_groups(checker->cell)[i].reach + checker->group_errors[i]);
    }
}
