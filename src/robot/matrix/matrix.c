// The collision matrix: all pairs of links that have elements, sampled (sample.c), then proven
// (prove.c). What a pair may be left out for follows MoveIt's setup assistant, whose matrix is sampled alone
// (I. A. Sucan, S. Chitta, MoveIt, 2013).
#include "robot/matrix/matrix.h"

#include "base/environment.h"
#include "base/error.h"
#include "robot/model/pair_table.h"

#include <string.h>

enum { SAMPLES = 10000, BUDGET = 100000 };

const char *ovoid_robot_touch_get_name(ovoid_robot_touch touch) {
    static const char *const names[] = {"open",           "never",     "sampled never", "always",
                                        "sampled always", "sometimes", "rigid"};
    return (size_t)touch < sizeof names / sizeof *names ? names[touch] : "unknown";
}

const char *ovoid_robot_matrix_pair_get_reason(const ovoid_robot_matrix_pair *p, int with_sampled) {
    if (p->is_neighbour) return "Adjacent";
    if (p->touch == OVOID_ROBOT_TOUCH_NEVER || (with_sampled && p->touch == OVOID_ROBOT_TOUCH_SAMPLED_NEVER))
        return "Never";
    if (p->touch == OVOID_ROBOT_TOUCH_ALWAYS || (with_sampled && p->touch == OVOID_ROBOT_TOUCH_SAMPLED_ALWAYS))
        return "Always";
    return NULL;
}

// ---- pairs

static uint32_t get_top_above(const ovoid_robot_cell *c, uint32_t top) {
    return c->rigid[c->robot->joints[c->robot->parent_joint[top]].parent];
}

// How many tops are above each top.
static void count_depths(const ovoid_robot_cell *c, uint32_t *depths) {
    const ovoid_robot *r = c->robot;
    depths[r->root] = 0;
    for (uint32_t i = 0; i < r->joint_count; i++) {
        const ovoid_robot_joint *j = &r->joints[r->order[i]];
        depths[j->child] = depths[c->rigid[j->parent]] + (j->type != OVOID_JOINT_FIXED);
    }
}

// What is known of tops, each of which stands for all that is fixed to it.
typedef struct tops {
    unsigned char *has_elements;
    uint32_t *depths;
} tops;

// 1 where nothing that has elements is on the way from one link to the other.
static int are_neighbours(const ovoid_robot_cell *c, const tops *of, uint32_t a, uint32_t b) {
    uint32_t at[2] = {c->rigid[a], c->rigid[b]};
    while (at[0] != at[1]) {
        int k = of->depths[at[1]] > of->depths[at[0]];
        at[k] = get_top_above(c, at[k]);
        if (of->has_elements[at[k]] && at[k] != c->rigid[a] && at[k] != c->rigid[b]) return 0;
    }
    return 1;
}

// Rigid pairs are not among the cell's; all others are, in the same order.
static ovoid_code list_pairs(matrix_work *w, const tops *of, ovoid_error *error) {
    const ovoid_robot_cell *c = w->cell;
    ovoid_robot_matrix *m = w->matrix;
    size_t groups = c->groups.count, next = 0, count = groups * (groups - (groups > 0)) / 2;
    m->pairs = allocator_allocate(&w->allocator, count, sizeof *m->pairs);
    w->of_group_pair = allocator_allocate(&w->allocator, c->group_pairs.count, sizeof *w->of_group_pair);
    if (!m->pairs || !w->of_group_pair) return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a matrix");
    for (size_t i = 0; i < groups; i++)
        for (size_t k = i + 1; k < groups; k++) {
            uint32_t a = cell_groups(c)[i].link, b = cell_groups(c)[k].link;
            ovoid_robot_matrix_pair p = {.a = a, .b = b, .touch = OVOID_ROBOT_TOUCH_RIGID};
            p.is_neighbour = are_neighbours(c, of, a, b);
            if (c->rigid[a] != c->rigid[b]) {
                p.touch = OVOID_ROBOT_TOUCH_OPEN;
                w->of_group_pair[next++] = (uint32_t)m->count;
            }
            m->pairs[m->count++] = p;
        }
    return OVOID_OK;
}

ovoid_code matrix_keep_state(const matrix_work *w, const double **kept, const double *q) {
    if (*kept) return OVOID_OK;
    size_t size = w->cell->robot->variable_count * sizeof *q;
    double *copy = allocator_allocate(&w->allocator, 1, size);
    if (!copy) return OVOID_ERROR_MEMORY;
    *kept = memcpy(copy, q, size);
    return OVOID_OK;
}

// ---- limits

// The double above pi: a box between it and its negative holds all angles.
#define HALF_TURN 0x1.921fb54442d19p+1

static int has_follower(const ovoid_robot *r, uint32_t joint) {
    for (uint32_t i = 0; i < r->joint_count; i++)
        if (r->joints[i].mimic == joint) return 1;
    return 0;
}

// A joint that turns by more than once around, and that no other follows, is everywhere that it can be within half a
// turn: these states are within its limits, and they stand for all.
static void set_limits(const matrix_work *w) {
    const ovoid_robot *r = w->cell->robot;
    for (uint32_t i = 0; i < r->variable_count; i++) {
        const ovoid_robot_variable *v = &r->variables[i];
        ovoid_joint_type type = r->joints[v->joint].type;
        w->low[i] = v->lower, w->high[i] = v->upper;
        int is_around = type == OVOID_JOINT_REVOLUTE && v->lower <= -HALF_TURN && v->upper >= HALF_TURN;
        if (type == OVOID_JOINT_CONTINUOUS || (is_around && !has_follower(r, v->joint)))
            w->low[i] = -HALF_TURN, w->high[i] = HALF_TURN;
        if (type == OVOID_JOINT_PLANAR || type == OVOID_JOINT_FLOATING)
            w->low[i] = w->high[i] = type == OVOID_JOINT_FLOATING && v->component == 3 ? 1 : 0;
    }
}

// ---- create, destroy

// A hit and a free state are proof enough, whatever joints are between.
static void name_touch(ovoid_robot_matrix_pair *p) {
    if (p->hit && p->free) p->touch = OVOID_ROBOT_TOUCH_SOMETIMES;
}

static ovoid_code fill(matrix_work *w, ovoid_error *error) {
    const ovoid_robot_cell *c = w->cell;
    tops of = {allocator_allocate(&w->allocator, c->robot->link_count, 1),
               allocator_allocate(&w->allocator, c->robot->link_count, sizeof *of.depths)};
    w->low = allocator_allocate(&w->allocator, c->robot->variable_count, sizeof *w->low);
    w->high = allocator_allocate(&w->allocator, c->robot->variable_count, sizeof *w->high);
    ovoid_code code = OVOID_OK;
    if (!of.has_elements || !of.depths || !w->low || !w->high)
        code = error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a matrix");
    if (code == OVOID_OK) {
        memset(of.has_elements, 0, c->robot->link_count);
        count_depths(c, of.depths);
        for (size_t i = 0; i < c->groups.count; i++) of.has_elements[c->rigid[cell_groups(c)[i].link]] = 1;
        set_limits(w);
        code = list_pairs(w, &of, error);
    }
    allocator_release(&w->allocator, of.has_elements);
    allocator_release(&w->allocator, of.depths);
    if (code == OVOID_OK) code = matrix_sample(w, error);
    if (code == OVOID_OK) code = matrix_prove(w, error);
    for (size_t i = 0; i < w->matrix->count; i++) name_touch(&w->matrix->pairs[i]);
    allocator_release(&w->allocator, w->of_group_pair);
    allocator_release(&w->allocator, w->low);
    allocator_release(&w->allocator, w->high);
    return code;
}

static void destroy(ovoid_robot_matrix *m) {
    ovoid_allocator memory = m->allocator;
    for (size_t i = 0; i < m->count; i++) {
        allocator_release(&memory, (void *)m->pairs[i].hit);
        allocator_release(&memory, (void *)m->pairs[i].free);
    }
    allocator_release(&memory, m->pairs);
    allocator_release(&memory, m);
}

// The robot that leaves no pair out, and the cell of it alone.
static ovoid_code fill_with_cell(matrix_work *w, const ovoid_robot *robot, ovoid_error *error) {
    ovoid_robot_description all = ovoid_robot_get_description(robot);
    all.disabled = NULL, all.disabled_count = 0;
    ovoid_error why = {.code = OVOID_OK};
    ovoid_robot *copy = ovoid_robot_create(&all, &(ovoid_robot_options){.allocator = &w->allocator}, &why);
    // Tables of all pairs take as long as some ten thousand states.
    if (copy) robot_leave_out_pair_tables(copy);
    ovoid_robot_cell *cell =
        copy ? ovoid_robot_cell_create(copy, &(ovoid_robot_cell_options){&w->allocator}, &why) : NULL;
    ovoid_code code = why.code;
    if (cell) {
        w->cell = cell;
        code = fill(w, error);
    } else if (error) {
        *error = why;
    }
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(copy);
    return code;
}

static ovoid_robot_matrix *create(const ovoid_robot *robot, const ovoid_robot_matrix_options *options,
                                  ovoid_error *error) {
    if (!robot) {
        error_write(error, OVOID_ERROR_ARGUMENT, -1, "a matrix needs a robot");
        return NULL;
    }
    matrix_work w = {.allocator = allocator_make(options ? options->allocator : NULL)};
    if (options) w.options = *options;
    if (!w.options.samples) w.options.samples = SAMPLES;
    if (!w.options.budget) w.options.budget = BUDGET;
    w.matrix = allocator_allocate(&w.allocator, 1, sizeof *w.matrix);
    if (!w.matrix) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for a matrix");
        return NULL;
    }
    *w.matrix = (ovoid_robot_matrix){.allocator = w.allocator};
    if (fill_with_cell(&w, robot, error) == OVOID_OK) return w.matrix;
    destroy(w.matrix);
    return NULL;
}

ovoid_robot_matrix *ovoid_robot_matrix_create(const ovoid_robot *robot, const ovoid_robot_matrix_options *options,
                                              ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_robot_matrix *, robot, create(robot, options, error));
}

void ovoid_robot_matrix_destroy(ovoid_robot_matrix *matrix) {
    if (!matrix) return;
    ENVIRONMENT_RUN(destroy(matrix));
}

// ---- what it holds

size_t ovoid_robot_matrix_get_count(const ovoid_robot_matrix *matrix) { return matrix->count; }

ovoid_robot_matrix_pair ovoid_robot_matrix_get_pair(const ovoid_robot_matrix *matrix, size_t i) {
    return matrix->pairs[i];
}

const ovoid_robot_matrix_pair *ovoid_robot_matrix_find_pair(const ovoid_robot_matrix *m, uint32_t a, uint32_t b) {
    uint64_t key = cell_make_key(a < b ? a : b, a < b ? b : a);
    size_t low = 0, high = m->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (cell_make_key(m->pairs[middle].a, m->pairs[middle].b) < key)
            low = middle + 1;
        else
            high = middle;
    }
    if (low == m->count || cell_make_key(m->pairs[low].a, m->pairs[low].b) != key) return NULL;
    return &m->pairs[low];
}
