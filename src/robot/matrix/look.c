// What is proven of a cell from the state in its middle.
//
// No point of a body comes farther in a cell than path_set_item says, joint by joint, from where it is in the middle.
// The signed distance is the largest gap of the supports over all directions, so it changes by no more than both bodies
// move (docs/robot-matrix.md): a distance above that proves the cell free, a depth above it proves contact in all of
// it. Along the direction of the distance in the middle, or that of the cell before, cell_gap.c has a closer bound of
// the least gap, and cell_contact.c looks for a point that both bodies have in the whole cell. The motion bound is that
// of F. Schwarzer, M. Saha, J.-C. Latombe, Adaptive dynamic collision checking for single and multiple articulated
// robots, 2005.
#include "robot/matrix/look.h"

#include "robot/matrix/cell_gap.h"

#include <string.h>

/// A search for a common point costs some tens of cells: it ends where it finds none that often, more often than it
/// does. Of open cells, one in PROBES is asked at a corner too, and those that are small.
enum { SEARCHES = 64, PROBES = 4 };

// ---- pairs of items

static const ovoid_proof *get_proof(const prover *p, uint32_t pair) {
    return p->has_proof[pair - p->of->first] ? &p->proofs[pair - p->of->first] : NULL;
}

static void remember(prover *p, uint32_t pair, const ovoid_proof *proof) {
    p->proofs[pair - p->of->first] = *proof;
    p->has_proof[pair - p->of->first] = 1;
}

static int is_far(const prover *p, uint32_t pair) {
    return path_is_far_pair(p->w, pair, 0) || path_is_far_by_boxes(p->w, pair, &p->at, 0);
}

// 1 where the state at hand is proven in contact.
static int is_proven(const path_pair *at, double upper) {
    return upper + at->error + 0x1p-51 * (fabs(upper) + at->error) <= 0;
}

static int is_hit(prover *p, uint32_t pair, const path_pair *at) {
    ovoid_answer answer = ovoid_within(&at->pair, at->error, NULL, get_proof(p, pair));
    if (!sides_have_solid(&at->solids)) return is_proven(at, answer.upper);
    if (answer.lower > at->error) return 0;
    if (is_proven(at, solid_sides_raise(&at->solids, answer.upper))) return 1;
    return is_proven(at, solid_pair_within(&at->pair, &at->solids, at->error, &answer, at->error).upper);
}

static void clear_shares(prover *p) {
    size_t size = p->work->cell->robot->variable_count * sizeof *p->shares;
    memset(p->shares, 0, size);
    memset(p->slopes, 0, size);
    p->has_shares = 1;
}

// ---- free cells

static int is_parted(const cell_gap *g, const path_pair *at, vec3 normal) {
    double needed = at->error * (1 + 0x1p-40);
    return cell_gap_compute(g, normal, needed) > needed;
}

// The bodies where their hulls are not enough.
static cell_verdict look_at_solids(prover *p, uint32_t pair, const path_pair *at, ovoid_answer *answer) {
    double margin = add_up(at->motion.moved, at->error, 0);
    int is_apart = answer->lower > at->error;
    // Bodies are no farther apart than that: not enough for the cell.
    if (is_apart && solid_sides_raise(&at->solids, answer->upper) <= margin) return CELL_OPEN;
    *answer = solid_pair_within(&at->pair, &at->solids, margin, answer, at->error);
    if (answer->lower > margin) return CELL_PROVEN;
    if (answer->lower > at->error || !p->is_state) return CELL_OPEN;
    return is_proven(at, answer->upper) || is_hit(p, pair, at) ? CELL_REFUTED : CELL_OPEN;
}

// What the middle of the cell says of a pair of items.
static cell_verdict look_at_pair(prover *p, uint32_t pair) {
    if (is_far(p, pair)) return CELL_PROVEN;
    path_pair at = path_make_pair(p->w, pair, p->at.frames);
    cell_gap g;
    int has_gap = cell_gap_make(&g, p->w, &p->at, pair);
    if (has_gap && p->has_proof[pair - p->of->first]) {
        vec3 earlier = p->proofs[pair - p->of->first].normal;
        if (vec3_norm_squared(earlier) > 0.5 && is_parted(&g, &at, earlier)) return CELL_PROVEN;
    }
    double margin = add_up(at.motion.moved, at.error, 0);
    ovoid_options coarse = {.absolute_tolerance = 0.125 * margin};
    ovoid_answer answer = ovoid_distance(&at.pair, &coarse, get_proof(p, pair));
    remember(p, pair, &answer.proof);
    if (answer.lower > margin) return CELL_PROVEN;
    int is_apart = answer.lower > at.error;
    vec3 normal = answer.normal;
    if (has_gap && is_apart && is_parted(&g, &at, normal)) return CELL_PROVEN;
    cell_verdict verdict = CELL_OPEN;
    if (sides_have_solid(&at.solids))
        verdict = look_at_solids(p, pair, &at, &answer);
    else if (p->is_state && !is_apart && is_hit(p, pair, &at))
        verdict = CELL_REFUTED;
    if (verdict != CELL_OPEN || !is_apart || !has_gap || p->has_shares) return verdict;
    clear_shares(p);
    cell_gap_add_shares(&g, normal, &(cell_gap_shares){p->shares, p->slopes});
    return verdict;
}

// The corner of the cell towards which the gap of the widest pair falls: is it a hit there? The first hits in the order
// of the cells are at such corners, never in a middle.
static cell_verdict probe_corner(prover *p) {
    const ovoid_robot *r = p->work->cell->robot;
    for (uint32_t i = 0; i < r->variable_count; i++)
        p->corner[i] = p->slopes[i] > 0 ? p->q1[i] : p->slopes[i] < 0 ? p->q0[i] : p->w->state[i];
    if (!state_is_within_limits(r, p->corner, 0)) return CELL_OPEN;
    path_compute_frames(p->w, p->corner, p->corner, 0, &p->at);
    path_pair at = path_make_pair(p->w, p->widest, p->at.frames);
    if (!is_hit(p, p->widest, &at)) return CELL_OPEN;
    p->refuting = p->corner;
    return CELL_REFUTED;
}

static cell_verdict look_for_free(prover *p) {
    uint32_t open = 0;
    for (uint32_t i = 0; i < p->open_count; i++) {
        uint32_t pair = p->open[i];
        cell_verdict verdict = look_at_pair(p, pair);
        if (verdict == CELL_REFUTED) return CELL_REFUTED;
        if (verdict == CELL_PROVEN) continue;
        if (open == 0) p->widest = pair;
        p->open[i] = p->open[open];
        p->open[open++] = pair;
    }
    p->open_count = open;
    if (open == 0) return CELL_PROVEN;
    return p->has_shares && p->opens++ % PROBES == 0 ? probe_corner(p) : CELL_OPEN;
}

// ---- cells in contact

// The upper end of the signed distance that a pair has in the middle; of solids also that of their hulls, raised.
static ovoid_answer find_depth(prover *p, uint32_t pair, const path_pair *at) {
    ovoid_answer answer = ovoid_depth(&at->pair, NULL, get_proof(p, pair), NULL);
    remember(p, pair, &answer.proof);
    if (!sides_have_solid(&at->solids) || answer.lower > at->error) return answer;
    double raised = solid_sides_raise(&at->solids, answer.upper);
    if (!(raised < 0)) answer = solid_pair_within(&at->pair, &at->solids, at->error, &answer, at->error);
    answer.upper = min2(answer.upper, raised);
    return answer;
}

// One pair of items that overlaps all over the cell is enough; the one that did so last is asked first.
static cell_verdict look_at_depths(prover *p, ovoid_answer *deepest) {
    int is_free = 1;
    for (uint32_t i = 0; i < p->open_count; i++) {
        uint32_t pair = p->open[i];
        if (is_far(p, pair)) continue;
        path_pair at = path_make_pair(p->w, pair, p->at.frames);
        ovoid_answer answer = find_depth(p, pair, &at);
        is_free &= answer.lower > at.error;
        if (!(answer.upper < deepest->upper)) continue;
        *deepest = answer, p->widest = pair;
        p->open[i] = p->open[0], p->open[0] = pair;
        if (answer.upper < -add_up(at.motion.moved, at.error, 0)) return CELL_PROVEN;
    }
    return is_free && p->is_state ? CELL_REFUTED : CELL_OPEN;
}

static cell_verdict look_for_contact(prover *p) {
    if (p->searches > 0 && cell_contact_is_proven(&p->contact)) {
        p->searches += 2;
        return CELL_PROVEN;
    }
    ovoid_answer deepest = {.upper = INFINITY};
    cell_verdict verdict = look_at_depths(p, &deepest);
    if (verdict != CELL_OPEN || p->searches <= 0) return verdict;
    if (deepest.upper < 0 && cell_contact_find(&p->contact, p->widest, &deepest)) return CELL_PROVEN;
    p->searches--;
    if (p->contact.pair == OVOID_ROBOT_NONE) return CELL_OPEN;
    clear_shares(p);
    cell_contact_add_shares(&p->contact, p->shares);
    return CELL_OPEN;
}

// ---- the cell

static void place_group(prover *p, uint32_t which) {
    const cell_group *g = &cell_groups(p->work->cell)[which];
    for (uint32_t i = g->first; i < g->end; i++) {
        path_place_item(p->w, &p->at, i);
        path_set_item(p->w, &p->at, i, 0.5);
    }
}

cell_verdict prover_look(prover *p, int wants_contact) {
    p->has_shares = 0;
    p->widest = p->of->first;
    // A refused corner, as of a mimic beyond all lengths: nothing is proven of this cell, nor of its parts.
    if (path_set_segment(p->w, p->q0, p->q1, INFINITY, NULL) != OVOID_OK) return CELL_OPEN;
    path_compute_frames(p->w, p->q0, p->q1, 0.5, &p->at);
    p->is_state = state_is_within_limits(p->work->cell->robot, p->w->state, 0);
    p->refuting = p->w->state;
    place_group(p, p->of->a);
    place_group(p, p->of->b);
    return wants_contact ? look_for_contact(p) : look_for_free(p);
}

void prover_begin(prover *p) {
    narrow_choose(&p->narrow, p->of->a, p->of->b);
    p->open_count = p->of->end - p->of->first;
    memset(p->has_proof, 0, p->open_count);
    for (uint32_t i = 0; i < p->open_count; i++) p->open[i] = p->of->first + i;
    p->contact = (cell_contact){p->w, &p->at, p->point, OVOID_ROBOT_NONE, {0, 0, 0}, -INFINITY};
    p->searches = SEARCHES;
    p->opens = 0;
}
