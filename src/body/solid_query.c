// Proximity of solids and shapes: which pair of triangles decides, what of the others is left out, and what lies inside
// what.
#include "base/compiler.h"
#include "body/body_find.h"
#include "body/exclusions.h"
#include "body/search.h"

// ---- the end of a query

// Where the traversal ended early: one exclusion of all pairs, by the roots.
static void exclude_all(solid_search *h) {
    if (h->exclusions) h->exclusions->count = 0;
    waiting_pair all = search_make_roots(h);
    search_exclude_boxes(h, &all);
}

static ovoid_limit find_limit(const solid_search *h, double lower, double upper, ovoid_status status) {
    final_bracket b = {.lower = lower, .upper = upper, .status = status, .kind = h->out->deciding.proof.kind};
    b.tolerance = h->tolerance + h->allowance;
    b.allowance = h->allowance;
    if (bracket_is_left_open(&b, &h->whole_goal)) return OVOID_LIMIT_ALLOWANCE;
    return bracket_is_narrow(&b, &h->whole_goal) ? OVOID_LIMIT_NONE
                                                 : bracket_find_limit(&b, &h->whole_goal, h->trouble);
}

// The bracket of the surfaces, with the answer of the pair that decides it.
static void finish_surfaces(solid_search *h) {
    ovoid_body_answer *out = h->out;
    if (!h->has_best) {
        search_visit_leaves(h, 0, 0, NULL);
    } else if (!h->is_answered) {
        // The kernel found the deciding pair without a proof: the pair is queried for one.
        ovoid_pair pair = search_get_pair(h, h->best.place_a, h->best.place_b);
        query_goal goal = h->whole_goal;
        goal.far = max2(goal.far, h->frame.claim);
        answer_find_internal(&pair, &h->options, goal, NULL, NULL, &out->deciding);
        out->tested++;
    }
    if (search_is_decided(h)) exclude_all(h);
    ovoid_answer *x = &out->deciding;
    x->lower = min2(x->lower, h->lower);
    x->status = bracket_find_status(x->lower, x->upper, h->tolerance);
    x->limit = find_limit(h, x->lower, x->upper, x->status);
    out->part_a = solid_view_get_index(&h->a, h->best.place_a);
    out->part_b = solid_view_get_index(&h->b, h->best.place_b);
    exclusions_finish(h->exclusions);
}

// 1, 0, or -1 where it is open: nearer than half the claim the point's rounding may cross a surface.
static int find_inside(solid_search *h) {
    if (!solid_view_is_closed(&h->a) && !solid_view_is_closed(&h->b)) return 0;
    if (!(h->out->deciding.lower > h->frame.claim / 2)) return -1;
    return solid_find_inside(&h->a, &h->b, 0, &h->out->inside, &h->out->component);
}

// What parts the bodies: of a distance, which is asked for its bracket, and of bodies that touch, by all points.
static void find_parting(solid_search *h) {
    ovoid_body_answer *out = h->out;
    int is_distance = h->whole_goal.wants_bracket && h->whole_goal.near == -INFINITY;
    box_gap gap = is_distance || !(out->upper < 0) ? solid_find_parting(&h->frame, &h->a, &h->b, out->deciding.normal)
                                                   : solid_frame_find_parting(&h->frame, &h->a, &h->b);
    out->lower = min2(gap.lower, min2(out->upper, 0));
    out->parting = gap.normal;
}

// Surfaces that touch leave open how deep the bodies are in each other: a point of both may show it.
static void find_common_point(solid_search *h) {
    ovoid_body_answer *out = h->out;
    const framed_pair pair = {&h->frame, &h->a, &h->b};
    common_point found;
    if (!framed_pair_find_common_point(&pair, &h->flush, &found)) return;
    out->inside = OVOID_BODY_COMMON_POINT;
    out->common = found.point;
    out->upper = -found.depth;
    out->lower = min2(out->lower, out->upper);
}

// From the surfaces to the bodies: what is inside what, and how deep an overlap may be.
static void finish(solid_search *h) {
    ovoid_body_answer *out = h->out;
    finish_surfaces(h);
    const ovoid_answer *x = &out->deciding;
    out->status = x->status;
    out->limit = x->limit;
    out->lower = x->lower;
    out->upper = x->upper;
    int is = x->lower > 0 ? find_inside(h) : -1;
    if (is == 0) return;
    if (is > 0) out->upper = -x->lower;
    find_parting(h);
    // What the bodies' allowances leave open no point shows.
    int is_wide = out->upper - out->lower > h->tolerance + h->allowance;
    if (is_wide && !(out->upper < 0)) find_common_point(h);
    out->status = bracket_find_status(out->lower, out->upper, h->tolerance);
    out->limit =
        out->status == OVOID_OVERLAPPING ? OVOID_LIMIT_NONE : find_limit(h, out->lower, out->upper, out->status);
}

// ---- the beginning

static void visit_earlier(solid_search *h, const ovoid_body_proof *earlier) {
    h->warm_a = h->a.count;
    h->warm_b = h->b.count;
    if (!earlier || earlier->part_a >= h->a.count || earlier->part_b >= h->b.count) return;
    uint32_t a = solid_view_get_place(&h->a, earlier->part_a), b = solid_view_get_place(&h->b, earlier->part_b);
    search_visit_leaves(h, a, b, &earlier->proof);
    h->warm_a = a;
    h->warm_b = b;
}

static ovoid_limit begin(solid_search *h, const ovoid_body_pair *pair, const ovoid_options *options,
                         const query_goal *goal) {
    if (!options_make(options, &h->options) || !(goal->far >= 0)) return OVOID_LIMIT_OPTIONS;
    if (!body_is_one(&pair->a)) return OVOID_LIMIT_SHAPE_A;
    if (!body_is_one(&pair->b)) return OVOID_LIMIT_SHAPE_B;
    if (!solid_view_make(&pair->a, &h->a)) return OVOID_LIMIT_POSE_A;
    if (!solid_view_make(&pair->b, &h->b)) return OVOID_LIMIT_POSE_B;
    solid_frame_make(&h->a, &h->b, &h->frame);
    h->tolerance = solid_frame_compute_tolerance(&h->frame, &h->options);
    // Half for a pair, half for what is left out beside it.
    h->options.absolute_tolerance = h->tolerance / 2;
    h->options.relative_tolerance = OVOID_LENGTH_MIN;
    h->allowance = h->a.allowance + h->b.allowance;
    h->whole_goal = h->goal = *goal;
    h->far = max2(goal->far, h->frame.claim);
    h->enough = h->lower = INFINITY;
    h->trouble = OVOID_LIMIT_NONE;
    h->has_best = h->is_answered = 0;
    h->flush.count = 0;
    h->filter_support = -INFINITY;
    h->normals[0] = (vec3){1, 0, 0};
    h->normal_count = 1;
    h->kernels = solid8_get_kernels();
    if (h->a.solid) triangle_begin(&h->room_a);
    if (h->b.solid) triangle_begin(&h->room_b);
    return OVOID_LIMIT_NONE;
}

// The whole query; the limit is that of a refusal.
static ovoid_limit search_from(solid_search *h, const ovoid_body_pair *pair, const ovoid_options *options,
                               const query_goal *goal, const ovoid_body_proof *earlier) {
    *h->out = (ovoid_body_answer){.status = OVOID_UNDECIDED};
    exclusions_begin(h->exclusions);
    ovoid_limit refused = begin(h, pair, options, goal);
    if (refused != OVOID_LIMIT_NONE) return refused;
    visit_earlier(h, earlier);
    search_traverse(h);
    finish(h);
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

COMPILER_NOINLINE void solid_find_internal(const ovoid_body_pair *pair, const ovoid_options *options,
                                           const query_goal *goal, const ovoid_body_proof *earlier,
                                           ovoid_exclusions *exclusions, ovoid_body_answer *out) {
    solid_search h;
    query_goal own = *goal;
    own.wants_depth = 0;
    h.out = out;
    h.exclusions = exclusions;
    ovoid_limit refused = search_from(&h, pair, options, &own, earlier);
    if (refused != OVOID_LIMIT_NONE) {
        out->deciding = answer_make_refused(refused);
        out->limit = refused;
        out->lower = -INFINITY;
        out->upper = INFINITY;
        return;
    }
    if (!earlier || !is_improvable(out)) return;
    // No earlier proof makes an answer worse: the query alone, unless the one from the proof says more.
    ovoid_status status = out->status;
    double width = out->upper - out->lower;
    (void)search_from(&h, pair, options, &own, NULL);
    if (is_better(status, width, out)) (void)search_from(&h, pair, options, &own, earlier);
}
