// Proofs about all states: the box of the joints between two links is divided until each cell is decided by the state
// in its middle (look.c), or a state refutes. Branch and bound after A. H. Land, A. G. Doig, An automatic method of
// solving discrete programming problems, 1960.
#include "base/error.h"
#include "base/watch.h"
#include "robot/matrix/look.h"
#include "robot/model/inner_balls.h"

#include <string.h>

enum { DEPTH = 192, CELLS_LEAST = 1000 };

// A division on the way down to the cell that is looked at: which half that is in, and the variable's bounds above.
typedef struct division {
    uint32_t variable;
    int is_second;
    uint32_t open_count; ///< pairs of items that the cell above left open
    double low, middle, high;
} division;

// The way down, and how much of the box is proven.
typedef struct division_stack {
    division items[DEPTH];
    uint32_t depth;
    double proven; ///< the share of the box
} division_stack;

// ---- dividing

// A variable, and what it moves.
typedef struct variable_motion {
    uint32_t variable;
    double most;
} variable_motion;

static void find_most(const prover *p, uint32_t item, uint32_t count, variable_motion *best) {
    const item_link *links = p->w->links + p->w->first[item];
    double before = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t variable = p->work->cell->robot->joint_variable[p->w->joints[links[i].step]];
        double by = links[i].moved - before;
        before = links[i].moved;
        if (by > best->most && p->q0[variable] < p->q1[variable]) *best = (variable_motion){variable, by};
    }
}

// The variable that moves the widest pair most.
static variable_motion choose_variable(const prover *p) {
    variable_motion best = {OVOID_ROBOT_NONE, 0};
    if (p->has_shares) {
        for (uint32_t i = 0; i < p->work->cell->robot->variable_count; i++)
            if (p->shares[i] > best.most && p->q0[i] < p->q1[i]) best = (variable_motion){i, p->shares[i]};
        return best;
    }
    item_pair of = cell_pairs(p->work->cell)[p->widest];
    const pair_chain *k = &p->w->pairs[p->widest];
    find_most(p, of.a, k->count_a, &best);
    find_most(p, of.b, k->count_b, &best);
    return best;
}

// Goes to the first half of the cell; 0: it cannot be divided.
static int divide(prover *p, division_stack *s) {
    variable_motion best = choose_variable(p);
    if (s->depth == DEPTH || best.variable == OVOID_ROBOT_NONE) return 0;
    double low = p->q0[best.variable], high = p->q1[best.variable], middle = low + 0.5 * (high - low);
    if (!(middle > low && middle < high)) return 0;
    s->items[s->depth++] = (division){best.variable, 0, p->open_count, low, middle, high};
    p->q1[best.variable] = middle;
    return 1;
}

// Goes to the next cell after a proven one; 0: there is none.
static int go_on(prover *p, division_stack *s) {
    s->proven += ldexp(1, -(int)s->depth);
    for (; s->depth > 0; s->depth--) {
        division *d = &s->items[s->depth - 1];
        p->q1[d->variable] = d->high;
        if (!d->is_second) {
            d->is_second = 1;
            p->open_count = d->open_count;
            p->q0[d->variable] = d->middle;
            return 1;
        }
        p->q0[d->variable] = d->low;
    }
    return 0;
}

// States that touch or nearly do take all the cells: at this pace ten times the budget would be needed.
static int is_hopeless(const prover *p, const division_stack *s, size_t cells) {
    return cells >= CELLS_LEAST && s->proven * (double)p->work->options.budget < 0.1 * (double)cells;
}

// Depth first, so that the memory is that of one way down.
static cell_verdict search(prover *p, int wants_contact, size_t *cells) {
    division_stack s = {.depth = 0};
    size_t budget = p->work->options.budget;
    while (*cells < budget && !is_hopeless(p, &s, *cells) && !watch_is_stopped(&p->work->options.watch)) {
        ++*cells;
        cell_verdict verdict = prover_look(p, wants_contact);
        if (verdict == CELL_REFUTED) return verdict;
        if (verdict == CELL_PROVEN && !go_on(p, &s)) return CELL_PROVEN;
        if (verdict == CELL_OPEN && !divide(p, &s)) return CELL_OPEN;
    }
    return CELL_OPEN;
}

// ---- pairs

// 1 where the box between its limits holds all that a joint does.
static int is_bounded(const ovoid_robot *r, uint32_t joint) {
    uint32_t variable = r->joint_variable[joint];
    const ovoid_robot_joint *j = &r->joints[joint], *leader = &r->joints[r->variables[variable].joint];
    if (j->type == OVOID_JOINT_PLANAR || j->type == OVOID_JOINT_FLOATING) return 0;
    return leader == j || leader->type != OVOID_JOINT_CONTINUOUS;
}

static int are_bounded(const prover *p, uint32_t item, uint32_t count) {
    const item_link *links = p->w->links + p->w->first[item];
    for (uint32_t i = 0; i < count; i++)
        if (!is_bounded(p->work->cell->robot, p->w->joints[links[i].step])) return 0;
    return 1;
}

// What stands in the pair now is true of its samples; a proof, or the middle of a cell, says more.
static ovoid_code decide(prover *p, ovoid_robot_matrix_pair *pair) {
    int wants_contact = pair->hits > 0;
    if (pair->hits && pair->frees) return OVOID_OK;
    cell_verdict verdict = search(p, wants_contact, &pair->cells);
    pair->touch =
        wants_contact || verdict == CELL_REFUTED ? OVOID_ROBOT_TOUCH_SAMPLED_ALWAYS : OVOID_ROBOT_TOUCH_SAMPLED_NEVER;
    if (verdict == CELL_PROVEN) pair->touch = wants_contact ? OVOID_ROBOT_TOUCH_ALWAYS : OVOID_ROBOT_TOUCH_NEVER;
    if (verdict == CELL_REFUTED)
        return matrix_keep_state(p->work, wants_contact ? &pair->free : &pair->hit, p->refuting);
    return OVOID_OK;
}

static ovoid_code prove_pair(prover *p, uint32_t which) {
    const ovoid_robot_cell *c = p->work->cell;
    p->of = &cell_group_pairs(c)[which];
    prover_begin(p);
    item_pair items = cell_pairs(c)[p->of->first];
    const pair_chain *k = &p->w->pairs[p->of->first];
    if (!are_bounded(p, items.a, k->count_a) || !are_bounded(p, items.b, k->count_b)) return OVOID_OK;
    memcpy(p->q0, p->work->low, c->robot->variable_count * sizeof *p->q0);
    memcpy(p->q1, p->work->high, c->robot->variable_count * sizeof *p->q1);
    // Joints above both move neither against the other.
    return decide(p, &p->work->matrix->pairs[p->work->of_group_pair[which]]);
}

static ovoid_code prove_all(prover *p) {
    ovoid_code code = OVOID_OK;
    for (uint32_t i = 0; code == OVOID_OK && i < p->work->cell->group_pairs.count; i++) code = prove_pair(p, i);
    return code;
}

static ovoid_code prove(prover *p) {
    const ovoid_robot_cell *c = p->work->cell;
    const ovoid_allocator *memory = &p->work->allocator;
    size_t most = 0;
    for (size_t i = 0; i < c->group_pairs.count; i++) {
        const group_pair *g = &cell_group_pairs(c)[i];
        if (g->end - g->first > most) most = g->end - g->first;
    }
    p->memory = allocator_allocate(memory, 1, path_get_state_size(c));
    p->proofs = allocator_allocate(memory, most, sizeof *p->proofs);
    p->has_proof = allocator_allocate(memory, most, 1);
    p->open = allocator_allocate(memory, most, sizeof *p->open);
    p->point = shape_create_point(memory);
    p->shares = allocator_allocate(memory, c->robot->variable_count, sizeof *p->shares);
    p->slopes = allocator_allocate(memory, c->robot->variable_count, sizeof *p->slopes);
    p->corner = allocator_allocate(memory, c->robot->variable_count, sizeof *p->corner);
    p->q0 = allocator_allocate(memory, c->robot->variable_count, sizeof *p->q0);
    p->q1 = allocator_allocate(memory, c->robot->variable_count, sizeof *p->q1);
    ovoid_code code = OVOID_ERROR_MEMORY;
    if (p->memory && p->proofs && p->has_proof && p->open && p->point && p->shares && p->slopes && p->corner &&
        narrow_create(&p->narrow, &p->whole) && p->q0 && p->q1) {
        p->at = path_place_state(c, p->memory);
        p->w = &p->narrow.w;
        code = prove_all(p);
    }
    void *all[] = {p->memory, p->proofs, p->has_proof, p->open, p->shares, p->slopes, p->corner, p->q0, p->q1};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) allocator_release(memory, all[i]);
    ovoid_shape_destroy(p->point);
    narrow_destroy(&p->narrow);
    return code;
}

ovoid_code matrix_prove(matrix_work *w, ovoid_error *error) {
    prover *p = allocator_allocate(&w->allocator, 1, sizeof *p);
    ovoid_code code = OVOID_ERROR_MEMORY;
    if (p) {
        *p = (prover){.work = w};
        code = path_work_create(&p->whole, w->cell, &w->allocator, NULL);
        if (code == OVOID_OK) {
            code = prove(p);
            path_work_destroy(&p->whole);
        }
    }
    allocator_release(&w->allocator, p);
    return code == OVOID_OK ? OVOID_OK : error_set(error, code, -1, "no memory for the proofs of a matrix");
}
