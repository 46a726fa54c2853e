// Checks the proof of a path: each step is measured again, and the steps of each pair must join up.
#include "base/environment.h"
#include "base/error.h"
#include "robot/path/motion.h"

#include <stdlib.h>
#include <string.h>

typedef struct path_checker {
    path_work w;
    const ovoid_robot_path *path;
    const ovoid_robot_path_options *options;
    size_t segment;       // that was set last; SIZE_MAX: none
    path_state states[3]; // at the beginning, in the middle, at the end
    double begin, end;    // that these are at
} path_checker;

// What a step says of one pair.
typedef struct covered {
    uint32_t pair;
    double begin, end;
} covered;

// ---- one step

static ovoid_code refuse(ovoid_error *error, size_t step, const char *what) {
    return error_set(error, OVOID_ERROR_PROOF, (int64_t)step, "step %zu: %s", step, what);
}

static ovoid_code set_segment(path_checker *state, size_t index, ovoid_error *error) {
    size_t count = state->w.cell->robot->variable_count;
    const double *q0 = state->path->states + index * count, *q1 = index + 1 < state->path->count ? q0 + count : q0;
    if (state->segment == index) return OVOID_OK;
    state->segment = SIZE_MAX;
    state->begin = state->end = -1;
    ovoid_code code = path_set_segment(&state->w, q0, q1, state->options->query.limit_slack, error);
    if (code == OVOID_OK) state->segment = index;
    return code;
}

// The frames of an interval within the segment, and its motions. The half width is that of the wider half.
static void set_interval(path_checker *state, double begin, double end) {
    if (begin == state->begin && end == state->end) return;
    size_t count = state->w.cell->robot->variable_count;
    const double *q0 = state->path->states + state->segment * count,
                 *q1 = state->segment + 1 < state->path->count ? q0 + count : q0;
    double middle = 0.5 * (begin + end), half = max2(middle - begin, end - middle) * (1 + 0x1p-50);
    path_compute_state(&state->w, q0, q1, begin, &state->states[0]);
    path_compute_state(&state->w, q0, q1, middle, &state->states[1]);
    path_compute_state(&state->w, q0, q1, end, &state->states[2]);
    path_set_interval(&state->w, &state->states[1], half);
    state->begin = begin;
    state->end = end;
}

static int is_far(const path_checker *state, uint32_t number) {
    pair_parts of = pair_take_apart(state->w.cell, number);
    double margin = state->options->query.margin;
    if (of.part == OVOID_ROBOT_NONE) {
        if (path_is_far_pair(&state->w, of.pair, margin)) return 1;
    } else if (path_find_far_parts(&state->w, of.item, of.part / ROBOT8, margin) >> of.part % ROBOT8 & 1)
        return 1;
    return path_is_far_by_boxes(&state->w, number, &state->states[1], margin);
}

static ovoid_code verify_outer(const path_checker *state, size_t index, const ovoid_robot_step *s, ovoid_error *error) {
    for (uint32_t k = 0; k < ROBOT8; k++)
        if ((s->mask >> k & 1) && !is_far(state, s->pair + k))
            return refuse(error, index, "spheres and boxes are not as far apart as it says");
    return OVOID_OK;
}

static ovoid_code verify_gap(const path_checker *state, size_t index, const ovoid_robot_step *s, ovoid_error *error) {
    double margin = state->options->query.margin, gaps[3];
    path_pair p[3];
    if (s->kind == OVOID_ROBOT_STEP_SOLID) {
        p[1] = path_make_pair(&state->w, s->pair, state->states[1].frames);
        return path_is_solid_far(&p[1], margin)
                   ? OVOID_OK
                   : refuse(error, index, "the solids in its middle are not as far apart as the bodies may move");
    }
    for (int i = 0; i < 3; i++) {
        p[i] = path_make_pair(&state->w, s->pair, state->states[i].frames);
        gaps[i] = path_measure(&state->w, &p[i], state->states[i].frames, s->normal);
    }
    if (s->kind == OVOID_ROBOT_STEP_MIDDLE)
        return path_is_above(gaps[1], margin, p[1].motion.moved)
                   ? OVOID_OK
                   : refuse(error, index, "the gap in its middle is not as wide as the bodies may move");
    double rounded = p[1].motion.rounded;
    return path_is_free_between(gaps[0] - rounded, gaps[2] - rounded, margin, p[1].motion.curved,
                                state->end - state->begin)
               ? OVOID_OK
               : refuse(error, index, "the gaps at its ends do not keep the bodies apart in between");
}

static ovoid_code verify_step(path_checker *state, size_t index, const ovoid_robot_step *s, ovoid_error *error) {
    const ovoid_robot_cell *c = state->w.cell;
    size_t segments = state->path->count > 1 ? state->path->count - 1 : 1;
    double last = (double)segments;
    if (!(s->begin >= 0 && s->end > s->begin && s->end <= last))
        return refuse(error, index, "it is not an interval of the path");
    size_t segment = (size_t)s->begin;
    if (!(s->end <= (double)(segment + 1))) return refuse(error, index, "it is of two segments");
    size_t pairs = ovoid_robot_cell_get_pair_count(c);
    unsigned mask = s->kind == OVOID_ROBOT_STEP_OUTER ? s->mask : 1, top = 0;
    for (unsigned k = 0; k < 16; k++)
        if (s->mask >> k & 1) top = k;
    if (s->mask == 0 || top >= ROBOT8 || (s->kind != OVOID_ROBOT_STEP_OUTER && s->mask != mask) ||
        (uint64_t)s->pair + top >= pairs)
        return refuse(error, index, "it names pairs that there are not");
    if (s->kind < OVOID_ROBOT_STEP_OUTER || s->kind > OVOID_ROBOT_STEP_SOLID)
        return refuse(error, index, "it is of no kind that there is");
    ovoid_code code = set_segment(state, segment, error);
    if (code != OVOID_OK) return code;
    set_interval(state, s->begin - (double)segment, s->end - (double)segment);
    return s->kind == OVOID_ROBOT_STEP_OUTER ? verify_outer(state, index, s, error)
                                             : verify_gap(state, index, s, error);
}

// ---- all of them

static int compare_covered(const void *a, const void *b) {
    const covered *x = a, *y = b;
    if (x->pair != y->pair) return x->pair < y->pair ? -1 : 1;
    return (x->begin > y->begin) - (x->begin < y->begin);
}

static int is_queried(const path_checker *state, uint32_t pair) {
    pair_parts of = pair_take_apart(state->w.cell, pair);
    if (of.part == OVOID_ROBOT_NONE) return !state->options->query.without_self;
    return !state->options->query.without_obstacles && path_is_queried(&state->w, of.item, of.part);
}

// The steps of each queried pair follow one another from 0 up to `until`.
static ovoid_code verify_cover(const path_checker *state, const covered *items, size_t count, double until,
                               ovoid_error *error) {
    const ovoid_robot_cell *c = state->w.cell;
    size_t pairs = ovoid_robot_cell_get_pair_count(c);
    size_t at = 0;
    for (uint64_t pair = 0; pair < pairs; pair++) {
        double reached = 0;
        for (; at < count && items[at].pair == pair; at++)
            if (items[at].begin <= reached) reached = max2(reached, items[at].end);
        if (reached < until && is_queried(state, pair))
            return error_set(error, OVOID_ERROR_PROOF, -1, "the steps of pair %llu end at %.9g, not at %.9g",
                             (unsigned long long)pair, reached, until);
    }
    return OVOID_OK;
}

static ovoid_code verify_steps(path_checker *state, const ovoid_robot_step *steps, size_t count, double until,
                               ovoid_error *error) {
    covered *items = allocator_allocate(&state->w.allocator, count * ROBOT8 + 1, sizeof *items);
    if (!items) return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for the steps of a path");
    ovoid_code code = OVOID_OK;
    size_t made = 0;
    for (size_t i = 0; code == OVOID_OK && i < count; i++) {
        code = verify_step(state, i, &steps[i], error);
        for (uint32_t k = 0; k < ROBOT8; k++)
            if (steps[i].mask >> k & 1) items[made++] = (covered){steps[i].pair + k, steps[i].begin, steps[i].end};
    }
    if (code == OVOID_OK && made) qsort(items, made, sizeof *items, compare_covered);
    if (code == OVOID_OK) code = verify_cover(state, items, made, until, error);
    allocator_release(&state->w.allocator, items);
    return code;
}

// The state at hit_at: its pair is within the margin, and the bracket that is claimed holds the one that is found
// there.
static ovoid_code verify_hit(path_checker *state, const ovoid_robot_path_answer *answer, ovoid_error *error) {
    double last = state->path->count > 1 ? (double)(state->path->count - 1) : 1, margin = state->options->query.margin;
    if (!(answer->hit_at >= answer->free_until && answer->hit_at <= last))
        return error_set(error, OVOID_ERROR_PROOF, -1, "the hit is not after the free part, or not on the path");
    path_place place = path_find_place(state->w.cell, state->path, answer->hit_at);
    ovoid_code code = set_segment(state, place.segment, error);
    if (code != OVOID_OK) return code;
    uint32_t number = path_find_number(state->w.cell, &answer->hit.a, &answer->hit.b);
    if (number == OVOID_ROBOT_NONE || !is_queried(state, number))
        return error_set(error, OVOID_ERROR_PROOF, -1, "the hit is of no pair that is queried");
    state->begin = state->end = -1;
    ovoid_robot_answer result = path_ask_hit(&state->w, &place, number, &state->states[1]);
    if (!(result.upper <= margin))
        return error_set(error, OVOID_ERROR_PROOF, -1, "the pair of the hit is not within the margin there");
    if (answer->hit.lower <= result.lower && answer->hit.upper >= result.upper && answer->hit.upper <= margin)
        return OVOID_OK;
    return error_set(error, OVOID_ERROR_PROOF, -1,
                     "the bracket of the hit, %.9g .. %.9g, does not hold what is found there, %.9g .. %.9g",
                     answer->hit.lower, answer->hit.upper, result.lower, result.upper);
}

static ovoid_code verify(path_checker *state, const ovoid_robot_path_answer *answer, const ovoid_robot_step *steps,
                         ovoid_error *error) {
    if (answer->status == OVOID_ROBOT_REFUSED)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a path that was refused has no proof");
    int is_hit = answer->status == OVOID_ROBOT_HIT;
    if (!is_hit && answer->status != OVOID_ROBOT_FREE && answer->status != OVOID_ROBOT_UNDECIDED)
        return error_set(error, OVOID_ERROR_PROOF, -1, "there is no status %d", (int)answer->status);
    if (!is_hit && answer->hit_at != INFINITY)
        return error_set(error, OVOID_ERROR_PROOF, -1, "hit_at is told where nothing is hit");
    double last = (double)(state->path->count - 1);
    if (!(answer->free_until >= 0 && answer->free_until <= last) ||
        (answer->status == OVOID_ROBOT_FREE && answer->free_until < last))
        return error_set(error, OVOID_ERROR_PROOF, -1, "the free part is not of the path");
    if (answer->status != OVOID_ROBOT_UNDECIDED && !cell_has_pairs(state->w.cell, &state->options->query))
        return error_set(error, OVOID_ERROR_PROOF, -1, "no pair is queried: nothing is free or hit");
    // A path of one state is a segment in which nothing moves.
    double until = state->path->count == 1 && answer->status == OVOID_ROBOT_FREE ? 1 : answer->free_until;
    ovoid_code code = verify_steps(state, steps, answer->step_count, until, error);
    if (code == OVOID_OK && answer->status == OVOID_ROBOT_HIT) code = verify_hit(state, answer, error);
    return code;
}

static ovoid_code run(const ovoid_robot_cell *cell, const ovoid_robot_path_answer *answer,
                      const ovoid_robot_path_basis *basis, ovoid_error *error) {
    static const ovoid_robot_path_options none;
    const ovoid_robot_path *path = basis->query.path;
    const ovoid_robot_path_options *options = basis->query.options;
    const ovoid_robot_step *steps = basis->steps;
    path_checker state = {
        .path = path, .options = options ? options : &none, .segment = SIZE_MAX, .begin = -1, .end = -1};
    if (!path->states || path->count < 1 || path->count > OVOID_ROBOT_PATH_STATES_MAX || (answer->step_count && !steps))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a path of 1 to 2^20 states with all its steps is wanted");
    ovoid_code code = query_options_validate(&state.options->query, error);
    if (code == OVOID_OK) code = path_work_create(&state.w, cell, &cell->allocator, error);
    if (code != OVOID_OK) return code;
    size_t size = path_get_state_size(cell);
    char *states = allocator_allocate(&cell->allocator, 3, size);
    for (size_t i = 0; states && i < 3; i++) state.states[i] = path_place_state(cell, states + i * size);
    code = states ? verify(&state, answer, steps, error)
                  : error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a path");
    allocator_release(&cell->allocator, states);
    path_work_destroy(&state.w);
    return code;
}

ovoid_code ovoid_robot_path_verify(const ovoid_robot_cell *cell, const ovoid_robot_path_answer *answer,
                                   const ovoid_robot_path_basis *basis, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, cell, run(cell, answer, basis, error));
}

// ---- pairs by number

size_t ovoid_robot_cell_get_pair_count(const ovoid_robot_cell *cell) {
    return cell->items.count * cell->parts.count + cell->pairs.count;
}

ovoid_code ovoid_robot_cell_get_pair(const ovoid_robot_cell *cell, size_t pair, ovoid_robot_sides *sides,
                                     ovoid_error *error) {
    size_t count = ovoid_robot_cell_get_pair_count(cell);
    if (pair >= count)
        return error_set(error, OVOID_ERROR_INDEX, (int64_t)pair, "there is no pair %zu of %zu", pair, count);
    pair_parts of = pair_take_apart(cell, (uint32_t)pair);
    sides->a = cell_items(cell)[of.item].side;
    sides->b = of.part != OVOID_ROBOT_NONE ? cell_parts(cell)[of.part].side : cell_items(cell)[of.other].side;
    return OVOID_OK;
}
