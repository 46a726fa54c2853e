// Proximity of solids and shapes: which pair of triangles decides, what of the others is left out, and what lies inside
// what.
#include "base/compiler.h"
#include "body/body_find.h"
#include "body/first_look.h"
#include "body/solid_search.h"

// ---- the end of a query

// 1, 0, or -1 where it is open: nearer than half the claim the point's rounding may cross a surface.
static int find_inside(body_search *state) {
    if (!body_tree_is_closed(&state->a) && !body_tree_is_closed(&state->b)) return 0;
    if (!(state->out->deciding.lower > state->frame.claim / 2)) return -1;
    contained_component found;
    int is_inside = trees_find_inside(&state->a, &state->b, 0, &found);
    if (is_inside > 0) {
        state->out->inside = found.inside;
        state->out->component = found.component;
    }
    return is_inside;
}

// What parts the bodies: of a distance, which is asked for its bracket, and of bodies that touch, by all points.
static void find_parting(body_search *state) {
    ovoid_body_answer *out = state->out;
    int is_distance = state->whole_goal.wants_bracket && state->whole_goal.near == -INFINITY;
    const framed_pair pair = {&state->frame, &state->a, &state->b};
    box_gap gap = is_distance || !(out->upper < 0) ? framed_pair_find_parting(&pair, out->deciding.normal)
                                                   : tree_frame_find_parting(&state->frame, &state->a, &state->b);
    out->lower = min2(gap.lower, min2(out->upper, 0));
    out->parting = gap.normal;
}

// Surfaces that touch leave open how deep the bodies are in each other: a point of both may show it.
static void find_common_point(body_search *state) {
    ovoid_body_answer *out = state->out;
    const framed_pair pair = {&state->frame, &state->a, &state->b};
    common_point found;
    if (!framed_pair_find_common_point(&pair, &state->solids->flush, &found)) return;
    out->inside = OVOID_BODY_COMMON_POINT;
    out->common = found.point;
    out->upper = -found.depth;
    out->lower = min2(out->lower, out->upper);
}

static void take_deciding(ovoid_body_answer *out) {
    const ovoid_answer *x = &out->deciding;
    out->status = x->status;
    out->limit = x->limit;
    out->lower = x->lower;
    out->upper = x->upper;
}

// From the surfaces to the bodies: what is inside what, and how deep an overlap may be.
static void finish(body_search *state) {
    ovoid_body_answer *out = state->out;
    const ovoid_answer *x = &out->deciding;
    take_deciding(out);
    int is = x->lower > 0 ? find_inside(state) : -1;
    if (is == 0) return;
    if (is > 0) out->upper = -x->lower;
    find_parting(state);
    // What the bodies' allowances leave open no point shows.
    int is_wide = out->upper - out->lower > state->tolerance + state->allowance;
    if (is_wide && !(out->upper < 0)) find_common_point(state);
    out->status = bracket_find_status(out->lower, out->upper, state->tolerance);
    out->limit = out->status == OVOID_OVERLAPPING ? OVOID_LIMIT_NONE
                                                  : search_find_limit(state, out->lower, out->upper, out->status);
}

// ---- the beginning

// The frame, and the boxes of the roots.
static void begin_frame(body_search *state) {
    tree_frame_make(&state->a, &state->b, &state->frame);
    state->solids->normals[0] = (vec3){0, 0, 0};
    state->solids->normal_count = 1;
    state->solids->roots = solids_find_roots_gap(state);
}

static void begin(body_search *state, const query_goal *goal) {
    state->tolerance = tree_frame_compute_tolerance(&state->frame, &state->options);
    // Half for a pair, half for what is left out beside it.
    state->slack = state->options.absolute_tolerance = state->tolerance / 2;
    state->options.relative_tolerance = OVOID_LENGTH_MIN;
    state->least_far = state->frame.claim;
    search_begin(state, goal);
    solids_state *solids = state->solids;
    solids->flush.count = 0;
    solids->filter_support = -INFINITY;
    solids->kernels = solid8_get_kernels();
    if (state->a.solid) triangle_begin(&solids->rooms[0]);
    if (state->b.solid) triangle_begin(&solids->rooms[1]);
}

// The whole query; the limit is that of a refusal.
static ovoid_limit search_from(body_search *state, const ovoid_body_pair *pair, const body_request *request) {
    *state->out = (ovoid_body_answer){.status = OVOID_UNDECIDED};
    exclusions_begin(state->exclusions);
    const query_goal *goal = request->goal;
    if (!options_make(request->options, &state->options) || !(goal->far >= 0)) return OVOID_LIMIT_OPTIONS;
    ovoid_limit refused = body_trees_make(pair, &state->a, &state->b);
    if (refused != OVOID_LIMIT_NONE) return refused;
    int is_seen = goal->far < INFINITY && first_look(state, goal, NULL);
    if (!is_seen) {
        begin_frame(state);
        // The balls' look is not made again where the boxes cannot say more.
        is_seen = state->solids->roots.lower > goal->far && first_look(state, goal, &state->solids->roots);
    }
    if (is_seen) {
        take_deciding(state->out);
        return OVOID_LIMIT_NONE;
    }
    begin(state, goal);
    search_run(state, request->earlier);
    finish(state);
    return OVOID_LIMIT_NONE;
}

// A search that began elsewhere might do better.
static int is_improvable(const ovoid_body_answer *x) {
    return answer_is_improvable(&x->deciding) || limit_is_stuck(x->limit) || x->status == OVOID_TOUCHING ||
           x->status == OVOID_UNDECIDED;
}

static int is_better(ovoid_status status, double width, const ovoid_body_answer *than) {
    if ((status == OVOID_UNDECIDED) != (than->status == OVOID_UNDECIDED)) return status != OVOID_UNDECIDED;
    return status == than->status && width < than->upper - than->lower;
}

COMPILER_NOINLINE void solid_find_internal(const ovoid_body_pair *pair, const body_request *request,
                                           ovoid_body_answer *out) {
    solids_state solids;
    body_search state;
    query_goal goal = *request->goal;
    goal.wants_depth = 0;
    body_request warm = *request, cold;
    warm.goal = &goal;
    cold = warm;
    cold.earlier = NULL;
    state.kind = &solids_kind;
    state.has_solid = 1;
    state.parts = NULL;
    state.solids = &solids;
    state.out = out;
    state.exclusions = request->exclusions;
    ovoid_limit refused = search_from(&state, pair, &warm);
    if (refused != OVOID_LIMIT_NONE) {
        out->deciding = answer_make_refused(refused);
        out->limit = refused;
        out->lower = -INFINITY;
        out->upper = INFINITY;
        return;
    }
    if (!request->earlier || !is_improvable(out)) return;
    // No earlier proof makes an answer worse: the query alone, unless the one from the proof says more.
    ovoid_status status = out->status;
    double width = out->upper - out->lower;
    (void)search_from(&state, pair, &cold);
    if (is_better(status, width, out)) (void)search_from(&state, pair, &warm);
}
