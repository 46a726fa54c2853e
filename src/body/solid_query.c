// Proximity of solids and shapes: which pair of triangles decides, what of the others is left out, and what lies inside
// what.
#include "base/compiler.h"
#include "body/body_find.h"
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

// The options and the trees; why the query is refused.
static ovoid_limit begin_trees(body_search *state, const ovoid_body_pair *pair, const body_request *request) {
    exclusions_begin(state->exclusions);
    if (!options_make(request->options, &state->options) || !(request->goal->far >= 0)) return OVOID_LIMIT_OPTIONS;
    return body_trees_make(pair, &state->a, &state->b);
}

// The frame, and the boxes of the roots.
static void begin_frame(body_search *state) {
    tree_frame_make(&state->a, &state->b, &state->frame);
    state->solids->normals[0] = (vec3){0, 0, 0};
    state->solids->normal_count = 1;
    state->solids->roots = solids_find_roots_gap(state);
}

// 1 where the balls, or the boxes of the roots, are farther apart than was asked; else the frame is made.
static int look(body_search *state, const query_goal *goal, far_bodies *far) {
    int is_asked = goal->far < INFINITY;
    if (is_asked && first_look(state, goal, NULL, far)) return 1;
    begin_frame(state);
    return is_asked && state->solids->roots.lower > goal->far && first_look(state, goal, &state->solids->roots, far);
}

static void begin_tolerances(body_search *state) {
    state->tolerance = tree_frame_compute_tolerance(&state->frame, &state->options);
    // Half for a pair, half for what is left out beside it.
    state->slack = state->options.absolute_tolerance = state->tolerance / 2;
    state->options.relative_tolerance = OVOID_LENGTH_MIN;
    state->least_far = state->frame.claim;
}

// ---- the whole query

static void search_from(body_search *state, const query_goal *goal, const ovoid_body_proof *earlier) {
    *state->out = (ovoid_body_answer){.status = OVOID_UNDECIDED};
    search_begin(state, goal);
    solids_state *solids = state->solids;
    solids->normal_count = 1;
    solids->flush.count = 0;
    solids->filter_support = -INFINITY;
    solids->kernels = solid8_get_kernels();
    if (state->a.solid) triangle_begin(&solids->rooms[0]);
    if (state->b.solid) triangle_begin(&solids->rooms[1]);
    search_run(state, earlier);
    finish(state);
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

static void search_solids(body_search *state, const query_goal *goal, const ovoid_body_proof *earlier) {
    const ovoid_body_answer *out = state->out;
    begin_tolerances(state);
    search_from(state, goal, earlier);
    if (!earlier || !is_improvable(out)) return;
    // No earlier proof makes an answer worse: the query alone, unless the one from the proof says more.
    ovoid_status status = out->status;
    double width = out->upper - out->lower;
    search_from(state, goal, NULL);
    if (is_better(status, width, out)) search_from(state, goal, earlier);
}

static void refuse(ovoid_limit refused, ovoid_body_answer *out) {
    *out = (ovoid_body_answer){.limit = refused, .lower = -INFINITY, .upper = INFINITY};
    out->deciding = answer_make_refused(refused);
}

COMPILER_NOINLINE int solid_find(const ovoid_body_pair *pair, const body_request *request, ovoid_body_answer *out,
                                 far_bodies *far) {
    solids_state solids;
    body_search state;
    state.kind = &solids_kind;
    state.has_solid = 1;
    state.parts = NULL;
    state.solids = &solids;
    state.out = out;
    state.exclusions = request->exclusions;
    ovoid_limit refused = begin_trees(&state, pair, request);
    if (refused != OVOID_LIMIT_NONE) {
        refuse(refused, out);
        return 0;
    }
    if (look(&state, request->goal, far)) return 1;
    query_goal goal = *request->goal;
    goal.wants_depth = 0;
    search_solids(&state, &goal, request->earlier);
    return 0;
}
