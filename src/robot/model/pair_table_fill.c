// A table of a pair of links. The two are posed in the middle of a range of the variables between them and their
// distance is queried. Within the range no point of one link moves against the other by more than
//
//     sum over the variables of rate * (half the range's width),    rate: the lever of a joint, 1 if it slides
//
// so where the distance exceeds that, all cells of the range are proven, each with what is left at its farthest corner.
// Else the range is halved along the variable that moves more, down to single cells. Halves in which the links overlap
// by more than the motion are not looked into: nothing in them is free.
//
// A lever is the largest distance of the link's points from the joint's axis: of the last joint before the link that of
// its vertices; of an earlier one the way to the next joint, what it slides included, and from there to the farthest
// vertex. Cells are proven with their edges a little farther out than they are looked up with.
#include "robot/model/pair_table_fill.h"

#include "base/allocator.h"
#include "ovoid/query.h"

#include <string.h>

// Rounding of lengths, levers and widths.
#define UP (1 + 1e-9)
// By how much a cell's half width is more than half a cell.
#define WIDER (1 + 1e-6)
// Turns are reduced up to this many radians, lengths may be this many times their range.
#define TURN_MOST 64.0
#define LENGTH_MOST 1e4
#define WHOLE_TURN 6.283185307179586
#define SPHERE_SLACK 0x1p-40
enum { ROW_MOST = 1 << 12 };

// ---- the chain between two links

static uint32_t get_parent(const ovoid_robot *r, uint32_t link) { return r->joints[r->parent_joint[link]].parent; }

static uint32_t find_depth(const ovoid_robot *r, uint32_t link) {
    uint32_t depth = 0;
    for (; link != r->root; link = get_parent(r, link)) depth++;
    return depth;
}

static uint32_t find_common(const ovoid_robot *r, uint32_t a, uint32_t b) {
    uint32_t deep_a = find_depth(r, a), deep_b = find_depth(r, b);
    while (a != b) {
        if (deep_a >= deep_b)
            a = get_parent(r, a), deep_a--;
        else
            b = get_parent(r, b), deep_b--;
    }
    return a;
}

// Takes the variable of a joint as an axis; 0: there is no room for it, or the joint has more than one.
static int add_variable(table_maker *m, uint32_t joint) {
    uint32_t count = ovoid_joint_type_get_variable_count(m->r->joints[joint].type);
    if (count != 1) return count == 0;
    uint32_t variable = m->r->joint_variable[joint];
    for (int k = 0; k < 2; k++) {
        if (m->axes[k].variable == variable) return 1;
        if (m->axes[k].variable != OVOID_ROBOT_NONE) continue;
        m->axes[k].variable = variable;
        m->axes[k].value = m->r->value_first[m->r->variables[variable].joint];
        return 1;
    }
    return 0;
}

// The joints from the common link to one of the two; 0: too many variables.
static int add_steps(table_maker *m, table_side *side, uint32_t common) {
    const ovoid_robot *r = m->r;
    uint32_t count = 0;
    for (uint32_t link = side->link; link != common; link = get_parent(r, link)) count++;
    side->first_step = m->step_count;
    side->end_step = m->step_count += count;
    uint32_t at = side->end_step;
    for (uint32_t link = side->link; link != common; link = get_parent(r, link)) {
        uint32_t joint = r->parent_joint[link];
        if (!add_variable(m, joint)) return 0;
        m->joints[--at] = joint;
    }
    for (; at < side->end_step; at++) {
        m->steps[at] = r->steps[r->step_of[m->joints[at]]];
        m->steps[at].parent = at == side->first_step ? OVOID_ROBOT_NONE : at;
        m->steps[at].child = at + 1;
    }
    side->frame = count ? side->end_step : 0;
    return 1;
}

// ---- bodies

static void add_body(table_maker *m, const table_side *side, const ovoid_robot_element *e) {
    uint32_t parent = side->frame == 0 ? OVOID_ROBOT_NONE : side->frame, frame = m->step_count + 1;
    m->joints[m->step_count] = OVOID_ROBOT_NONE;
    m->steps[m->step_count++] = step_make_fixed(parent, frame, &e->pose);
    m->bodies[m->body_count++] = (table_body){.shape = e->shape,
                                              .frame = frame,
                                              .center = vec3_add(e->shape->center, e->shape->origin),
                                              .reach = e->shape->reach + e->shape->lower_radius};
}

static void add_bodies(table_maker *m, table_side *side) {
    side->first_body = m->body_count;
    for (uint32_t i = 0; i < m->r->element_count; i++)
        if (m->r->elements[i].link == side->link) add_body(m, side, &m->r->elements[i]);
    side->end_body = m->body_count;
}

// ---- where the bodies are

// 0: the state is refused.
static int place(table_maker *m, const double at[2]) {
    const ovoid_robot *r = m->r;
    ovoid_code code = OVOID_OK;
    for (int k = 0; k < 2; k++)
        if (m->axes[k].variable != OVOID_ROBOT_NONE) m->q[m->axes[k].variable] = at[k];
    for (uint32_t i = 0; i < m->step_count; i++) {
        const chain_step *s = &m->steps[i];
        const double *values = m->values + s->value;
        double magnitude = 0;
        uint32_t component;
        if (m->joints[i] != OVOID_ROBOT_NONE && s->kind != STEP_FIXED)
            code = joint_compute_values(r, m->joints[i], m->q, m->values + s->value, &magnitude, &component);
        if (code != OVOID_OK) return 0;
        step_apply(s, &m->frames[s->parent == OVOID_ROBOT_NONE ? 0 : s->parent], values,
                   step_compute_half_turn(s, values), &m->frames[s->child]);
    }
    return 1;
}

// What bodies may be off by, in all states of the table; 0: that has no bound.
static int set_errors(table_maker *m) {
    double magnitude = 0;
    for (int k = 0; k < 2; k++)
        magnitude = max2(magnitude, (fabs(m->axes[k].low) + m->widths[k] * m->axes[k].count) * UP);
    m->errors[0] = (frame_error){0, 0, 0};
    for (uint32_t i = 0; i < m->step_count; i++) {
        const chain_step *s = &m->steps[i];
        const frame_error *parent = &m->errors[s->parent == OVOID_ROBOT_NONE ? 0 : s->parent];
        step_error own = step_compute_error(m->r, m->joints[i], s, magnitude);
        m->errors[s->child] = frame_error_compute(parent, &own, (parent->distance + own.length) * UP);
    }
    for (uint32_t i = 0; i < m->body_count; i++) {
        table_body *b = &m->bodies[i];
        b->error = frame_error_at(&m->errors[b->frame], (vec3_norm(b->center) + b->reach) * UP);
        if (!(b->error < INFINITY)) return 0;
    }
    return 1;
}

// ---- axes and rates

// Is every joint that the variable moves, between the links, one that turns as fast as it?
static int is_plain_turn(const table_maker *m, uint32_t variable) {
    for (uint32_t i = 0; i < m->step_count; i++) {
        uint32_t joint = m->joints[i];
        if (joint == OVOID_ROBOT_NONE || m->r->joint_variable[joint] != variable) continue;
        if (m->steps[i].kind == STEP_FIXED) continue;
        if (m->steps[i].kind != STEP_TURN || fabs(m->r->leads[joint].factor) != 1) return 0;
    }
    return 1;
}

// The range of an axis, and half its width; 0: there is none.
static int set_range(const table_maker *m, table_axis *x, double *width) {
    const ovoid_robot_variable *v = &m->r->variables[x->variable];
    double range = v->upper - v->lower;
    x->low = v->lower;
    x->most = INFINITY;
    if (is_plain_turn(m, x->variable) && !(range < WHOLE_TURN)) {
        x->period = range = WHOLE_TURN;
        x->low = -0.5 * WHOLE_TURN;
        x->most = TURN_MOST;
    }
    *width = range;
    return range > 0 && range < INFINITY && max2(fabs(x->low), fabs(x->low + range)) < LENGTH_MOST * range;
}

static double find_spread(const table_maker *m, uint32_t step) {
    const joint_lead *lead = &m->r->leads[m->joints[step]];
    uint32_t variable = m->r->joint_variable[m->joints[step]];
    for (int k = 0; k < 2; k++)
        if (m->axes[k].variable == variable) return 0.5 * fabs(lead->factor) * m->widths[k] * m->axes[k].count;
    return 0;
}

// The farthest vertex of a side from a point, or from the line through it along a unit vector.
static double find_farthest(const table_maker *m, const table_side *side, vec3 from, const vec3 *along) {
    double most = 0;
    for (uint32_t i = side->first_body; i < side->end_body; i++) {
        const ovoid_shape *s = m->bodies[i].shape;
        const link_frame *f = &m->frames[m->bodies[i].frame];
        for (uint32_t k = 0; k < s->vertex_count; k++) {
            vec3 own = vec3_add(s->origin, vec3_at(shape_vertices(s), k));
            vec3 d = vec3_sub(vec3_add(f->position, mat3_mul_vec3(f->matrix, own)), from);
            most = max2(most, vec3_norm(along ? vec3_cross(*along, d) : d) + s->lower_radius);
        }
    }
    return most * UP;
}

// The rates of the joints of a side, with the state in the middle of both ranges placed.
static void add_rates(table_maker *m, const table_side *side) {
    double reach = -1, spread = 0;
    vec3 next = {0, 0, 0};
    for (uint32_t i = side->end_step; i-- > side->first_step;) {
        const chain_step *s = &m->steps[i];
        if (s->kind == STEP_FIXED) continue;
        const link_frame *f = &m->frames[s->child];
        vec3 axis = mat3_mul_vec3(f->matrix, s->axis), to = vec3_sub(next, f->position);
        double size = vec3_norm(to) * UP;
        double lever = reach < 0 ? find_farthest(m, side, f->position, &axis)
                                 : vec3_norm(vec3_cross(axis, to)) + size * 1e-9 + spread + reach;
        reach = reach < 0 ? find_farthest(m, side, f->position, NULL) : size + spread + reach;
        spread = s->kind == STEP_SLIDE ? find_spread(m, i) * UP : 0;
        next = f->position;
        double rate = (s->kind == STEP_SLIDE ? 1 : lever) * fabs(m->r->leads[m->joints[i]].factor) * UP;
        m->rates[m->axes[0].variable == m->r->joint_variable[m->joints[i]] ? 0 : 1] += rate;
    }
}

// As many cells as there are, so that each variable moves the links about as much in one.
static void set_counts(table_maker *m, const double ranges[2]) {
    uint32_t counts[2] = {1, 1};
    for (int cells = 1; cells < TABLE_CELLS; cells *= 2) {
        double first = m->rates[0] * ranges[0] / counts[0], second = m->rates[1] * ranges[1] / counts[1];
        int along = first >= second ? 0 : 1;
        if (counts[along] == ROW_MOST) break;
        counts[along] *= 2;
    }
    m->unit = 0;
    for (int k = 0; k < 2; k++) {
        m->axes[k].count = counts[k];
        m->widths[k] = ranges[k] / counts[k];
        m->axes[k].scale = m->widths[k] > 0 ? 1 / m->widths[k] : 0;
        m->unit += 0.5 * m->rates[k] * m->widths[k];
    }
}

static int set_axes(table_maker *m) {
    double ranges[2] = {0, 0}, middle[2] = {0, 0};
    for (int k = 0; k < 2; k++) {
        m->axes[k].count = 1;
        if (m->axes[k].variable == OVOID_ROBOT_NONE) {
            m->axes[k].value = m->axes[0].value;
            m->axes[k].most = INFINITY;
            continue;
        }
        if (!set_range(m, &m->axes[k], &ranges[k])) return 0;
        m->widths[k] = ranges[k];
        middle[k] = m->axes[k].low + 0.5 * ranges[k];
    }
    if (!set_errors(m) || !place(m, middle)) return 0;
    for (int k = 0; k < 2; k++) add_rates(m, &m->sides[k]);
    set_counts(m, ranges);
    return m->unit > 0 && m->unit < INFINITY;
}

int table_maker_set_pair(table_maker *m, uint32_t a, uint32_t b) {
    uint32_t common = find_common(m->r, a, b);
    m->step_count = m->body_count = 0;
    m->rates[0] = m->rates[1] = m->widths[0] = m->widths[1] = 0;
    m->axes[0] = m->axes[1] = (table_axis){.variable = OVOID_ROBOT_NONE};
    for (int k = 0; k < 2; k++) {
        m->sides[k] = (table_side){.link = k ? b : a};
        if (!add_steps(m, &m->sides[k], common)) return 0;
    }
    if (m->axes[0].variable == OVOID_ROBOT_NONE) return 0;
    for (int k = 0; k < 2; k++) add_bodies(m, &m->sides[k]);
    size_t pairs = (size_t)m->sides[0].end_body * (m->sides[1].end_body - m->sides[1].first_body);
    if (pairs == 0 || pairs > TABLE_BODY_PAIRS) return 0;
    memset(m->have_proofs, 0, sizeof m->have_proofs);
    return set_axes(m);
}

// ---- distances

// A range of cells.
typedef struct cell_range {
    uint32_t first[2], end[2];
} cell_range;

// What the spheres around two bodies leave between them, at least.
static double find_sphere_gap(const table_maker *m, const table_body *a, const table_body *b) {
    const link_frame *f = &m->frames[a->frame], *g = &m->frames[b->frame];
    vec3 x = vec3_add(f->position, mat3_mul_vec3(f->matrix, a->center)),
         y = vec3_add(g->position, mat3_mul_vec3(g->matrix, b->center));
    double apart = vec3_norm(vec3_sub(x, y)), reach = a->reach + b->reach;
    double size = apart + reach + 2 * (vec3_norm(x) + vec3_norm(y) + vec3_norm(a->center) + vec3_norm(b->center));
    return apart - reach - SPHERE_SLACK * size;
}

// How far two bodies are apart at least; not above zero: they may overlap, below it by how much at least.
static double measure_pair(table_maker *m, uint32_t first, uint32_t second, double motion) {
    const table_body *a = &m->bodies[first], *b = &m->bodies[second];
    double error = a->error + b->error, gap = find_sphere_gap(m, a, b) - error;
    if (gap > motion) return gap;
    const link_frame *f = &m->frames[a->frame], *g = &m->frames[b->frame];
    const ovoid_pair pair = {a->shape, b->shape, {f->position, f->rotation}, {g->position, g->rotation}};
    size_t at = (size_t)first * (m->body_count - m->sides[1].first_body) + (second - m->sides[1].first_body);
    const ovoid_options options = {.absolute_tolerance = 0.02 * m->unit};
    m->queries++;
    ovoid_answer answer = ovoid_distance(&pair, &options, m->have_proofs[at] ? &m->proofs[at] : NULL);
    m->proofs[at] = answer.proof;
    m->have_proofs[at] = 1;
    // A single cell is not divided, however deep they overlap.
    if (answer.lower > 0 || !(motion > 1.25 * m->unit)) return answer.lower - error;
    return min2(ovoid_depth(&pair, &options, NULL, NULL).upper + error, 0);
}

static double measure(table_maker *m, const double at[2], double motion) {
    double least = INFINITY;
    if (!place(m, at)) return -INFINITY;
    for (uint32_t i = m->sides[0].first_body; i < m->sides[0].end_body; i++)
        for (uint32_t k = m->sides[1].first_body; k < m->sides[1].end_body && least > -motion; k++)
            least = min2(least, measure_pair(m, i, k, motion));
    return least;
}

// ---- cells

static void set_codes(table_maker *m, const cell_range *range, const double at[2], double gap) {
    for (uint32_t k = range->first[1]; k < range->end[1]; k++) {
        double y = fabs(m->axes[1].low + (k + 0.5) * m->widths[1] - at[1]) + 0.5 * m->widths[1];
        for (uint32_t i = range->first[0]; i < range->end[0]; i++) {
            double x = fabs(m->axes[0].low + (i + 0.5) * m->widths[0] - at[0]) + 0.5 * m->widths[0];
            double left = gap - (m->rates[0] * x + m->rates[1] * y) * WIDER;
            double steps = left / m->unit * (1 - 1e-9);
            m->codes[(size_t)k * m->axes[0].count + i] = (uint8_t)(!(left > 0) ? 0 : steps < 254 ? 1 + steps : 255);
        }
    }
}

static void divide(table_maker *m, const cell_range *range) {
    double at[2], moves[2], motion = 0;
    for (int k = 0; k < 2; k++) {
        double half = 0.5 * (range->end[k] - range->first[k]);
        at[k] = m->axes[k].low + (range->first[k] + half) * m->widths[k];
        moves[k] = range->end[k] - range->first[k] > 1 ? m->rates[k] * half * m->widths[k] : 0;
        motion += m->rates[k] * half * m->widths[k] * WIDER;
    }
    double gap = measure(m, at, motion);
    if (gap > motion) {
        set_codes(m, range, at, gap);
        return;
    }
    if (gap < -motion || !(max2(moves[0], moves[1]) > 0) || m->queries > m->most) return;
    int along = moves[0] >= moves[1] ? 0 : 1;
    cell_range halves[2] = {*range, *range};
    halves[0].end[along] = halves[1].first[along] = range->first[along] + (range->end[along] - range->first[along]) / 2;
    for (int k = 0; k < 2; k++) divide(m, &halves[k]);
}

void table_maker_fill(table_maker *m) {
    const cell_range all = {{0, 0}, {m->axes[0].count, m->axes[1].count}};
    memset(m->codes, 0, TABLE_CELLS);
    divide(m, &all);
}

// ---- memory

int table_maker_create(table_maker *m, const ovoid_robot *r) {
    size_t steps = (size_t)r->joint_count + r->element_count + 1;
    const ovoid_allocator *memory = &r->allocator;
    *m = (table_maker){.r = r};
    m->steps = allocator_allocate(memory, steps, sizeof *m->steps);
    m->joints = allocator_allocate(memory, steps, sizeof *m->joints);
    m->frames = allocator_allocate(memory, steps + 1, sizeof *m->frames);
    m->errors = allocator_allocate(memory, steps + 1, sizeof *m->errors);
    m->q = allocator_allocate(memory, (size_t)r->variable_count + 1, sizeof *m->q);
    m->values = allocator_allocate(memory, (size_t)r->value_count + 1, sizeof *m->values);
    m->bodies = allocator_allocate(memory, (size_t)r->element_count + 1, sizeof *m->bodies);
    m->proofs = allocator_allocate(memory, TABLE_BODY_PAIRS, sizeof *m->proofs);
    m->codes = allocator_allocate(memory, TABLE_CELLS, 1);
    if (!m->steps || !m->joints || !m->frames || !m->errors || !m->q || !m->values || !m->bodies || !m->proofs ||
        !m->codes) {
        table_maker_destroy(m);
        return 0;
    }
    m->frames[0] = frame_make_world();
    memset(m->q, 0, sizeof *m->q * ((size_t)r->variable_count + 1));
    memset(m->values, 0, sizeof *m->values * ((size_t)r->value_count + 1));
    return 1;
}

void table_maker_destroy(table_maker *m) {
    const ovoid_allocator *memory = &m->r->allocator;
    void *all[] = {m->steps, m->joints, m->frames, m->errors, m->q, m->values, m->bodies, m->proofs, m->codes};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) allocator_release(memory, all[i]);
}
