// What the searches of all kinds of bodies have in common: the best pair of leaves, what is left out beside it, queries
// of leaves, and the bracket that follows.
#include "body/search.h"

#include "exact/cover_memory.h"

void search_begin(body_search *state, const query_goal *goal) {
    state->whole_goal = state->goal = *goal;
    state->allowance = state->a.allowance + state->b.allowance;
    state->far = max2(goal->far, state->least_far);
    state->enough = state->lower = INFINITY;
    state->has_best = state->is_answered = 0;
    state->warm_a = state->posed_a = state->a.count;
    state->warm_b = state->posed_b = state->b.count;
    state->trouble = OVOID_LIMIT_NONE;
    exclusions_begin(state->exclusions);
}

// ---- what is left out

void search_exclude(body_search *state, const ovoid_exclusion *x) {
    state->lower = min2(state->lower, x->lower);
    if (state->exclusions) exclusions_add(state->exclusions, x);
}

void search_exclude_leaves(body_search *state, const leaf_pair *p) {
    ovoid_exclusion x = {p->place_a, p->place_a + 1, p->place_b, p->place_b + 1, p->normal, p->normal_low, p->lower};
    search_exclude(state, &x);
}

// Where the traversal ended early: one exclusion of all pairs, by the roots.
static void exclude_all(body_search *state) {
    if (state->exclusions) state->exclusions->count = 0;
    waiting_pair roots = state->kind->bound_roots(state, INFINITY);
    state->kind->leave_out(state, &roots);
}

// ---- the best pair

// Lowers the bounds from which on pairs are left out.
static void tighten(body_search *state) {
    const leaf_pair *best = &state->best;
    if (state->goal.wants_bracket) {
        state->enough = best->upper - state->slack;
        // Parts with an allowance may have a lower upper bound, whatever their lower one.
        if (!state->has_solid && !(state->allowance > 0)) state->enough = min2(best->lower, state->enough);
    }
    if (!(best->upper <= state->goal.near)) return;
    // The margin is met: only the sign is left to find. Of parts that touch no pair is looked for that touches more.
    state->goal = query_goal_make_collide();
    state->far = state->least_far;
    if (state->has_solid) state->enough = INFINITY;
}

int search_take(body_search *state, const leaf_pair *pair) {
    if (state->has_best && !(pair->upper < state->best.upper)) {
        search_exclude_leaves(state, pair);
        return 0;
    }
    if (state->has_best) search_exclude_leaves(state, &state->best);
    state->best = *pair;
    state->has_best = 1;
    state->is_answered = 0;
    tighten(state);
    return 1;
}

// ---- queries of leaves

// A leaf posed by the last call is reused.
static inline const ovoid_pair *pose_pair(body_search *state, uint32_t a, uint32_t b) {
    ovoid_pair *pair = &state->pair;
    triangle_shape *rooms = state->solids ? state->solids->rooms : NULL;
    if (state->posed_a != a) {
        ovoid_posed_shape leaf = body_tree_get_leaf(&state->a, a, rooms);
        pair->shape_a = leaf.shape;
        pair->pose_a = leaf.pose;
        state->posed_a = a;
    }
    if (state->posed_b != b) {
        ovoid_posed_shape leaf = body_tree_get_leaf(&state->b, b, rooms ? rooms + 1 : NULL);
        pair->shape_b = leaf.shape;
        pair->pose_b = leaf.pose;
        state->posed_b = b;
    }
    return pair;
}

const ovoid_pair *search_pose_leaves(body_search *state, uint32_t a, uint32_t b) { return pose_pair(state, a, b); }

static void take_trouble(body_search *state, ovoid_limit limit) {
    if (limit_is_stuck(limit) && state->trouble == OVOID_LIMIT_NONE) state->trouble = limit;
}

// What is asked of two leaves: it may stop once they are proven not to be nearer than the best pair.
static query_goal make_goal(const body_search *state) {
    query_goal goal = state->goal;
    goal.far = max2(goal.far, state->far);
    goal.has_cover = state->has_best;
    if (!state->has_best) return goal;
    // The best pair's cover is replaced by that of a deeper one only.
    goal.covered = state->best.upper;
    if (goal.wants_bracket && state->best.upper < goal.far) {
        goal.far = max2(state->enough, state->least_far);
        goal.beyond = OVOID_LIMIT_CAP;
    }
    return goal;
}

void search_query_leaves(body_search *state, uint32_t a, uint32_t b, const ovoid_proof *earlier) {
    const query_goal goal = make_goal(state);
    ovoid_cover *cover = goal.wants_depth && state->exclusions ? state->exclusions->cover : NULL;
    const ovoid_answer *x = &state->spare;
    const query_request request = {.options = &state->options, .goal = &goal, .earlier = earlier, .cover = cover};
    answer_find_internal(pose_pair(state, a, b), &request, &state->spare);
    state->out->tested++;
    take_trouble(state, x->limit);
    const leaf_pair found = {a, b, x->lower, x->upper, x->proof.normal, x->proof.normal_low};
    if (!state->kind->take(state, &found)) return;
    state->out->deciding = *x;
    state->is_answered = 1;
    if (x->proof.kind != OVOID_PROOF_COVER) cover_clear(cover);
}

void search_query_new(body_search *state, uint32_t a, uint32_t b) { search_query_leaves(state, a, b, NULL); }

// Starts with the pair of leaves that decided the earlier query. Its indices may be out of range.
static void visit_earlier(body_search *state, const ovoid_body_proof *earlier) {
    if (!earlier || earlier->part_a >= state->a.count || earlier->part_b >= state->b.count) return;
    state->warm_a = body_tree_get_place(&state->a, earlier->part_a);
    state->warm_b = body_tree_get_place(&state->b, earlier->part_b);
    search_query_leaves(state, state->warm_a, state->warm_b, &earlier->proof);
}

// ---- the end

ovoid_limit search_find_limit(const body_search *state, double lower, double upper, ovoid_status status) {
    const final_bracket b = {.lower = lower,
                             .upper = upper,
                             .tolerance = state->tolerance + state->allowance,
                             .allowance = state->allowance,
                             .status = status,
                             .kind = state->out->deciding.proof.kind};
    if (bracket_is_left_open(&b, &state->whole_goal)) return OVOID_LIMIT_ALLOWANCE;
    if (bracket_is_narrow(&b, &state->whole_goal)) return OVOID_LIMIT_NONE;
    return bracket_find_limit(&b, &state->whole_goal, state->trouble);
}

// Parts that touch within their own tolerance, in which is what far origins hide, keep their status.
static ovoid_status find_status(const body_search *state, double lower) {
    const ovoid_answer *x = &state->out->deciding;
    ovoid_status status = bracket_find_status(lower, x->upper, state->tolerance);
    int touches = !state->has_solid && x->status == OVOID_TOUCHING && lower >= x->lower;
    return status == OVOID_UNDECIDED && touches ? OVOID_TOUCHING : status;
}

// The answer of the best pair: its bracket may be known without it.
static void answer_best(body_search *state) {
    if (!state->has_best) search_query_leaves(state, 0, 0, NULL);
    if (state->is_answered) return;
    query_goal goal = state->whole_goal;
    goal.far = max2(goal.far, state->least_far);
    const query_request request = {.options = &state->options, .goal = &goal};
    answer_find_internal(pose_pair(state, state->best.place_a, state->best.place_b), &request, &state->out->deciding);
    state->out->tested++;
}

static void finish(body_search *state) {
    ovoid_body_answer *out = state->out;
    ovoid_answer *x = &out->deciding;
    answer_best(state);
    if (search_is_decided(state)) exclude_all(state);
    double lower = min2(x->lower, state->lower);
    ovoid_status status = find_status(state, lower);
    x->limit = search_find_limit(state, lower, x->upper, status);
    x->status = status;
    x->lower = lower;
    out->part_a = body_tree_get_index(&state->a, state->best.place_a);
    out->part_b = body_tree_get_index(&state->b, state->best.place_b);
    exclusions_finish(state->exclusions);
}

void search_run(body_search *state, const ovoid_body_proof *earlier) {
    visit_earlier(state, earlier);
    state->kind->traverse(state);
    finish(state);
}
