// Proofs about all states: the box of the joints between two links is divided until each cell is decided by the state
// in its middle.
//
// No point of a body comes farther in a cell than path_set_item says, joint by joint, from where it is in the middle.
// The signed distance is the largest gap of the supports over all directions, so it changes by no more than both bodies
// move (docs/robot-matrix.md): a distance above that proves the cell free, a depth above it proves contact in all of
// it. Branch and bound after A. H. Land, A. G. Doig, An automatic method of solving discrete programming problems,
// 1960; the motion bound after F. Schwarzer, M. Saha, J.-C. Latombe, Adaptive dynamic collision checking for single and
// multiple articulated robots, 2005.
#include "base/error.h"
#include "base/watch.h"
#include "robot/matrix/matrix.h"
#include "robot/path/motion.h"

#include <string.h>

enum { DEPTH = 192 };

// What a cell's middle says of a goal: the whole cell has it, or it must be divided, or the middle has it not.
typedef enum cell_verdict { CELL_PROVEN, CELL_OPEN, CELL_REFUTED } cell_verdict;

// A division on the way down to the cell that is looked at: which half that is in, and the variable's bounds above.
typedef struct division {
    uint32_t variable;
    int is_second;
    double low, middle, high;
} division;

typedef struct prover {
    matrix_work *work;
    path_work w;
    void *memory;        ///< of the state
    path_state at;       ///< the middle of the cell
    ovoid_proof *proofs; ///< of the pairs of items of the pair of groups
    unsigned char *has_proof;
    double *q0, *q1; ///< the cell
    const group_pair *of;
    int is_state;    ///< 1: the middle is one, also for joints that follow others
    uint32_t widest; ///< the pair of items by whose motion an open cell is divided
    division divisions[DEPTH];
} prover;

// ---- a cell

static const ovoid_proof *get_proof(const prover *p, uint32_t pair) {
    return p->has_proof[pair - p->of->first] ? &p->proofs[pair - p->of->first] : NULL;
}

static void remember(prover *p, uint32_t pair, const ovoid_proof *proof) {
    p->proofs[pair - p->of->first] = *proof;
    p->has_proof[pair - p->of->first] = 1;
}

static int is_far(const prover *p, uint32_t pair) {
    return path_is_far_pair(&p->w, pair, 0) || path_is_far_by_boxes(&p->w, pair, &p->at, 0);
}

// 1 where the middle is proven in contact.
static int is_proven(const path_pair *at, double upper) {
    return upper + at->error + 0x1p-51 * (fabs(upper) + at->error) <= 0;
}

static int is_hit(prover *p, uint32_t pair, const path_pair *at) {
    ovoid_answer answer = ovoid_within(&at->pair, at->error, NULL, get_proof(p, pair));
    if (!sides_have_solid(&at->solids)) return is_proven(at, answer.upper);
    if (is_proven(at, solid_sides_raise(&at->solids, answer.upper))) return 1;
    return is_proven(at, solid_pair_within(&at->pair, &at->solids, at->error, &answer, at->error).upper);
}

static cell_verdict look_for_free(prover *p) {
    cell_verdict verdict = CELL_PROVEN;
    for (uint32_t i = p->of->first; i < p->of->end; i++) {
        if (is_far(p, i)) continue;
        path_pair at = path_make_pair(&p->w, i, p->at.frames);
        double margin = add_up(at.motion.moved, at.error, 0);
        ovoid_answer answer = ovoid_within(&at.pair, margin, NULL, get_proof(p, i));
        remember(p, i, &answer.proof);
        if (sides_have_solid(&at.solids) && !(answer.lower > margin))
            answer = solid_pair_within(&at.pair, &at.solids, margin, &answer, at.error);
        if (answer.lower > margin) continue;
        if (p->is_state && !(answer.lower > at.error) && is_hit(p, i, &at)) return CELL_REFUTED;
        if (verdict == CELL_PROVEN) p->widest = i;
        verdict = CELL_OPEN;
    }
    return verdict;
}

// One pair of items that overlaps all over the cell is enough.
static cell_verdict look_for_contact(prover *p) {
    double deepest = INFINITY;
    int is_free = 1;
    for (uint32_t i = p->of->first; i < p->of->end; i++) {
        if (is_far(p, i)) continue;
        path_pair at = path_make_pair(&p->w, i, p->at.frames);
        ovoid_cover cover;
        ovoid_answer answer = ovoid_depth(&at.pair, NULL, get_proof(p, i), &cover);
        remember(p, i, &answer.proof);
        if (sides_have_solid(&at.solids) && !(answer.lower > at.error))
            answer = solid_pair_distance(&at.pair, &at.solids, NULL, &answer, at.error);
        if (answer.upper < -add_up(at.motion.moved, at.error, 0)) return CELL_PROVEN;
        is_free &= answer.lower > at.error;
        if (answer.upper < deepest) deepest = answer.upper, p->widest = i;
    }
    return is_free && p->is_state ? CELL_REFUTED : CELL_OPEN;
}

static cell_verdict look(prover *p, int wants_contact) {
    // A refused corner, as of a mimic beyond all lengths: nothing is proven of this cell, nor of its parts.
    if (path_set_segment(&p->w, p->q0, p->q1, INFINITY, NULL) != OVOID_OK) return CELL_OPEN;
    path_compute_state(&p->w, p->q0, p->q1, 0.5, &p->at);
    p->is_state = state_is_within_limits(p->work->cell->robot, p->w.state, 0);
    p->widest = p->of->first;
    const cell_group *a = &cell_groups(p->work->cell)[p->of->a], *b = &cell_groups(p->work->cell)[p->of->b];
    for (uint32_t i = a->first; i < a->end; i++) path_set_item(&p->w, &p->at, i, 0.5);
    for (uint32_t i = b->first; i < b->end; i++) path_set_item(&p->w, &p->at, i, 0.5);
    return wants_contact ? look_for_contact(p) : look_for_free(p);
}

// ---- dividing

// A variable, and what it moves.
typedef struct variable_motion {
    uint32_t variable;
    double most;
} variable_motion;

static void find_most(const prover *p, uint32_t item, uint32_t count, variable_motion *best) {
    const item_link *links = p->w.links + p->w.first[item];
    double before = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t variable = p->work->cell->robot->joint_variable[p->w.joints[links[i].step]];
        double by = links[i].moved - before;
        before = links[i].moved;
        if (by > best->most && p->q0[variable] < p->q1[variable]) *best = (variable_motion){variable, by};
    }
}

// Goes to the first half of the cell, by the variable that moves the widest pair most; 0: it cannot be divided.
static int divide(prover *p, uint32_t depth) {
    item_pair of = cell_pairs(p->work->cell)[p->widest];
    const pair_chain *k = &p->w.pairs[p->widest];
    variable_motion best = {OVOID_ROBOT_NONE, 0};
    find_most(p, of.a, k->count_a, &best);
    find_most(p, of.b, k->count_b, &best);
    if (depth == DEPTH || best.variable == OVOID_ROBOT_NONE) return 0;
    double low = p->q0[best.variable], high = p->q1[best.variable], middle = low + 0.5 * (high - low);
    if (!(middle > low && middle < high)) return 0;
    p->divisions[depth] = (division){best.variable, 0, low, middle, high};
    p->q1[best.variable] = middle;
    return 1;
}

// Goes to the next cell after a proven one; the depth there, 0: there is none.
static uint32_t go_on(prover *p, uint32_t depth) {
    for (; depth > 0; depth--) {
        division *d = &p->divisions[depth - 1];
        p->q1[d->variable] = d->high;
        if (!d->is_second) {
            d->is_second = 1;
            p->q0[d->variable] = d->middle;
            return depth;
        }
        p->q0[d->variable] = d->low;
    }
    return 0;
}

// Depth first, so that the memory is that of one way down.
static cell_verdict search(prover *p, int wants_contact, size_t *cells) {
    uint32_t depth = 0;
    while (*cells < p->work->options.budget && !watch_is_stopped(&p->work->options.watch)) {
        ++*cells;
        cell_verdict verdict = look(p, wants_contact);
        if (verdict == CELL_REFUTED) return verdict;
        if (verdict == CELL_PROVEN) {
            depth = go_on(p, depth);
            if (depth == 0) return CELL_PROVEN;
        } else {
            if (!divide(p, depth)) return CELL_OPEN;
            depth++;
        }
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
    const item_link *links = p->w.links + p->w.first[item];
    for (uint32_t i = 0; i < count; i++)
        if (!is_bounded(p->work->cell->robot, p->w.joints[links[i].step])) return 0;
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
        return matrix_keep_state(p->work, wants_contact ? &pair->free : &pair->hit, p->w.state);
    return OVOID_OK;
}

static ovoid_code prove_pair(prover *p, uint32_t which) {
    const ovoid_robot_cell *c = p->work->cell;
    p->of = &cell_group_pairs(c)[which];
    p->widest = p->of->first;
    item_pair items = cell_pairs(c)[p->of->first];
    const pair_chain *k = &p->w.pairs[p->of->first];
    if (!are_bounded(p, items.a, k->count_a) || !are_bounded(p, items.b, k->count_b)) return OVOID_OK;
    memset(p->has_proof, 0, p->of->end - p->of->first);
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
    p->q0 = allocator_allocate(memory, c->robot->variable_count, sizeof *p->q0);
    p->q1 = allocator_allocate(memory, c->robot->variable_count, sizeof *p->q1);
    ovoid_code code = OVOID_ERROR_MEMORY;
    if (p->memory && p->proofs && p->has_proof && p->q0 && p->q1) {
        p->at = path_place_state(c, p->memory);
        code = prove_all(p);
    }
    void *all[] = {p->memory, p->proofs, p->has_proof, p->q0, p->q1};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) allocator_release(memory, all[i]);
    return code;
}

ovoid_code matrix_prove(matrix_work *w, ovoid_error *error) {
    prover *p = allocator_allocate(&w->allocator, 1, sizeof *p);
    ovoid_code code = OVOID_ERROR_MEMORY;
    if (p) {
        *p = (prover){.work = w};
        code = path_work_create(&p->w, w->cell, &w->allocator, NULL);
        if (code == OVOID_OK) {
            code = prove(p);
            path_work_destroy(&p->w);
        }
    }
    allocator_release(&w->allocator, p);
    return code == OVOID_OK ? OVOID_OK : error_set(error, code, -1, "no memory for the proofs of a matrix");
}
