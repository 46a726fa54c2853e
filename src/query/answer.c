// The pipeline of every query, and its answer.
#include "query/answer.h"

#include "base/compiler.h"
#include "base/environment.h"
#include "base/error.h"
#include "exact/boxes.h"
#include "exact/cores.h"
#include "exact/cover_memory.h"
#include "exact/epa.h"
#include "exact/epa_lanes.h"
#include "exact/gauss/gauss.h"
#include "exact/gjk.h"
#include "exact/inside.h"
#include "exact/refine.h"
#include "exact/round.h"
#include "pair/proof.h"
#include "pair/reject.h"
#include "pair/round.h"
#include "pair/stages.h"
#include "query/begin.h"
#include "query/spheres.h"

#include <string.h>

ovoid_answer answer_make_refused(ovoid_limit limit) {
    return (ovoid_answer){.limit = limit, .lower = -INFINITY, .upper = INFINITY};
}

// The part of the proof that shows the upper bound.
static void set_upper_proof(ovoid_proof *p, const search *s) {
    if (s->kind == OVOID_PROOF_INNER || s->kind == OVOID_PROOF_INNER_POINTS) {
        p->inner_a = s->inner_a;
        p->inner_b = s->inner_b;
        return;
    }
    if (s->kind == OVOID_PROOF_BALLS) {
        p->inner_a = s->inner_a;
        p->inner_b = s->inner_b;
    }
    p->count = (uint32_t)s->witness.count;
    for (int i = 0; i < s->witness.count; i++) {
        p->a[i] = s->witness.p[i].a;
        p->b[i] = s->witness.p[i].b;
        p->weight_a[i] = p->weight_b[i] = s->witness.weight[i];
    }
}

static ovoid_status find_status(double lower, double upper, const query_goal *goal) {
    return bracket_find_status(lower, upper, goal->tolerance - goal->allowance);
}

// Why the bracket is wider than the tolerance, if it is.
static ovoid_limit find_limit(const search *s, ovoid_status status) {
    final_bracket b = {s->lower, s->upper, s->goal.tolerance, s->goal.allowance, status, s->kind};
    if (bracket_is_left_open(&b, &s->goal)) return OVOID_LIMIT_ALLOWANCE;
    if (bracket_is_narrow(&b, &s->goal)) return OVOID_LIMIT_NONE;
    return s->limit != OVOID_LIMIT_NONE ? s->limit : bracket_find_limit(&b, &s->goal, OVOID_LIMIT_NONE);
}

// A lower bound for a search that has none: the enclosing spheres' gap along the line of centres.
static void take_spheres(search *s) {
    const pair_frame *f = s->frame;
    vec3 d = vec3_sub(frame_b(f, f->b->center), f->a->center), n = vec3_unit(d);
    if (!(vec3_norm_squared(n) > 0.5)) n = (vec3){1, 0, 0};
    s->lower = vec3_dot(n, d) - (f->a->reach + f->b->reach) - (f->lower_radii + f->beyond) - f->claim;
    s->normal = n;
}

// A stage may prove one bound only: the other one comes from the spheres (lower) or from any pair of vertices (upper).
static void complete(search *s) {
    if (s->lower == -INFINITY) take_spheres(s);
    if (s->upper == INFINITY) {
        simplex any = {.p = {{frame_difference(s->frame, 0, 0), 0, 0}}, .weight = {1}, .count = 1};
        search_take_points(s, &any);
    }
}

// ---- allowances along an axis
//
// The search is that of the shapes, with all of the allowances subtracted. Its lower bound is along a normal, and where
// an allowance is along an axis it loses less there (block.h): that is given back once the search has ended.

static double compute_gain(const search *s, vec3 n) {
    return frame_compute_gain(s->frame, n, mat3_mul_transposed_vec3(s->frame->rotation, n), AXIS_CLAIM);
}

// The normal of the lower bound, in the frame.
static vec3 get_normal(const search *s) {
    return vec3_norm_squared(s->world) > 0 ? frame_direction_from_world(s->frame, s->world) : s->normal;
}

// Takes a shape's axis for the normal where the lower bound is better along it. Bodies that touch have many normals,
// and one that stands on its base has its axis among them.
static void try_axis(search *s, vec3 axis) {
    const pair_frame *f = s->frame;
    if (!(vec3_norm_squared(axis) > 0.5)) return;
    vec3 n = vec3_dot(axis, get_normal(s)) < 0 ? vec3_neg(axis) : axis;
    double lower = frame_find_support(f, n).gap - f->lower_radii - f->claim;
    lower = frame_take_gain(lower, compute_gain(s, n));
    if (!(lower > s->lower)) return;
    s->lower = lower;
    s->normal = n;
    s->world = s->world_low = (vec3){0, 0, 0};
}

static void drop_gain(search *s, double gain) {
    s->goal.has_axis = 0;
    s->goal.tolerance -= gain;
    s->goal.allowance -= gain;
    s->lower = frame_take_gain(s->lower, gain);
}

// The lower bound with what it gains along its normal; the normal may become an axis where the sign is open still. The
// goal's allowance is then what is left of it along the normal that was found.
static void take_gain(search *s) {
    if (!s->goal.has_axis) return;
    const pair_frame *f = s->frame;
    drop_gain(s, compute_gain(s, get_normal(s)));
    if (search_is_sign_known(s)) return;
    try_axis(s, f->a->allowance.axis);
    try_axis(s, mat3_mul_vec3(f->rotation, f->b->allowance.axis));
}

ovoid_verdict answer_make_verdict(search *s) {
    complete(s);
    take_gain(s);
    ovoid_status status = find_status(s->lower, s->upper, &s->goal);
    return (ovoid_verdict){status, s->stage, find_limit(s, status), s->iterations, s->lower, s->upper};
}

// The bracket with its normal, and the kind of the proof; all else stays as it is.
static void write_bare(search *s, ovoid_answer *out) {
    ovoid_verdict verdict = answer_make_verdict(s);
    out->status = verdict.status;
    out->stage = verdict.stage;
    out->limit = verdict.limit;
    out->iterations = verdict.iterations;
    out->lower = verdict.lower;
    out->upper = verdict.upper;
    int refined = vec3_norm_squared(s->world) > 0;
    out->normal = refined ? s->world : frame_direction_to_world(s->frame, s->normal);
    out->proof.kind = s->kind;
}

void answer_write(search *s, ovoid_answer *out) {
    const pair_frame *f = s->frame;
    memset(out, 0, sizeof *out);
    write_bare(s, out);
    out->proof.normal = out->normal;
    out->proof.normal_low = s->world_low;
    set_upper_proof(&out->proof, s);
    witness_points w = witness_compute_points(f, &out->proof);
    out->point_a = frame_point_to_world(f, w.a);
    out->point_b = frame_point_to_world(f, w.b);
}

COMPILER_NOINLINE static void write_wanted(const open_query *q, search *s, ovoid_answer *out) {
    if (q->placed.is_bare != BARE_ANSWER) {
        answer_write(s, out);
        return;
    }
    write_bare(s, out);
    out->proof.a[0] = s->witness.count ? s->witness.p[0].a : UINT32_MAX;
    out->proof.b[0] = s->witness.count ? s->witness.p[0].b : UINT32_MAX;
}

// A weighted vertex.
static inline vec3 get_share(const double *vertices, uint32_t i, double weight) {
    return vec3_scale(vec3_at(vertices, i), weight);
}

// Returned by value, into the place of what is written: nothing is copied. There are always three terms, which is
// faster than a loop of as many as count: terms without weight add zeros.
static inline __attribute__((always_inline)) small_points find_small_points(const small_end *end, const pair_frame *f) {
    if (end->has_witness) return (small_points){end->point_a, end->point_b};
    if (end->kind == OVOID_PROOF_INNER) {
        vec3 p = frame_point_to_world(f, end->inner);
        return (small_points){p, p};
    }
    const difference *p = end->points.p;
    const double *w = end->points.weight, *of_a = shape_vertices(f->a), *of_b = shape_vertices(f->b);
    vec3 a =
        vec3_add(vec3_add(get_share(of_a, p[0].a, w[0]), get_share(of_a, p[1].a, w[1])), get_share(of_a, p[2].a, w[2]));
    vec3 b =
        vec3_add(vec3_add(get_share(of_b, p[0].b, w[0]), get_share(of_b, p[1].b, w[1])), get_share(of_b, p[2].b, w[2]));
    if (end->points.count > 3) {
        a = vec3_add(a, get_share(of_a, p[3].a, w[3]));
        b = vec3_add(b, get_share(of_b, p[3].b, w[3]));
    }
    small_points found = {mat3_mul_vec3(f->world, a), vec3_add(f->offset, mat3_mul_vec3(f->world_b, b))};
    if (end->kind == OVOID_PROOF_POINTS) small_points_add_radii(&found, f, end->normal);
    return (small_points){vec3_add(f->world_origin, found.a), vec3_add(f->world_origin, found.b)};
}

void answer_write_small_witness(const small_end *end, const pair_frame *f, ovoid_witness *to) {
    small_points p = find_small_points(end, f);
    to->point_a = p.a;
    to->point_b = p.b;
    to->normal = end->normal;
}

void answer_write_small_proof(const small_end *end, ovoid_proof *to) { *to = (ovoid_proof)SMALL_PROOF(end); }

ovoid_answer answer_make_small(const small_end *end, const pair_frame *f, const query_goal *goal) {
    ovoid_verdict verdict = answer_make_small_verdict(end, goal);
    small_points p = find_small_points(end, f);
    return (ovoid_answer)SMALL_ANSWER(end, verdict, p);
}

static int may_overlap(const search *s) {
    const pair_frame *f = s->frame;
    double reach = f->a->reach + f->b->reach;
    return s->lower + f->lower_radii <= 0 &&
           vec3_norm_squared(vec3_sub(frame_b(f, f->b->center), f->a->center)) < reach * reach;
}

static vec3 find_line(const pair_frame *f) {
    vec3 n = vec3_unit(vec3_sub(frame_b(f, f->b->center), f->a->center));
    return vec3_norm_squared(n) > 0.5 ? n : (vec3){1, 0, 0};
}

// Of a depth of many vertices: the corners of the last nearest face make a thin tetrahedron, from which the growth
// takes more steps, and comes upon more slivers, than from the line of centres.
enum { PROOF_VERTICES = 512 }; // of both together
static int starts_afresh(const search *s) {
    uint32_t vertices = s->frame->a->vertex_count + s->frame->b->vertex_count;
    return s->goal.wants_depth && vertices > PROOF_VERTICES && may_overlap(s);
}

// The stages before the exact search, and the simplex that it starts from. A depth query whose spheres overlap goes to
// EPA at once. A distance query starts from the earlier proof's simplex; where a separating direction may end the
// query, that of the ellipsoids is tried.
static void run_stages(search *s, double sphere_gap, const ovoid_proof *earlier, simplex *start) {
    stage_proof(s, earlier, start);
    if (search_is_done(s)) return;
    if (starts_afresh(s)) start->count = 0;
    if (!s->goal.wants_depth) stage_inner(s);
    if (search_is_done(s) || (start->count && s->goal.far == INFINITY)) return;
    vec3 n;
    if (s->goal.wants_depth && may_overlap(s)) return;
    if (query_goal_takes_line(&s->goal, s->frame->a, s->frame->b, sphere_gap))
        n = find_line(s->frame);
    else
        stage_outer(s, &n);
    if (search_is_done(s)) return;
    // One vertex of a polyhedron is found again if it still is the nearest one, one point of a rim is not.
    int is_kept = start->count > 1 || (start->count && s->frame->is_true);
    simplex fresh;
    stage_support(s, n, is_kept ? &fresh : start);
}

// The closed forms of a box and another body.
static int take_closed_depth(search *s, ovoid_cover *cover) {
    if (!(s->frame->a->box.is_present | s->frame->b->box.is_present)) return 0;
    return !s->frame->is_true && (boxes_take_depth(s, cover) || inside_take_depth(s, cover));
}

// GJK, then EPA where the cores touch or overlap and GJK cannot narrow the bracket. A depth query tries EPA first,
// unless the cores are known to be apart. kept: a surface that a depth was to start from; it has bits of its own
// anyway, and EPA has its cover sooner.
static void run_exact(search *s, simplex *start, ovoid_cover *cover, const ovoid_cover *kept) {
    if (s->frame->is_true && frame_has_ellipsoid(s->frame) && cores_run(s)) return;
    int cores_apart = s->lower + s->frame->lower_radii > 0;
    // A depth of overlapping spheres begins without a simplex; the ellipsoids' cores may have parted the bodies since.
    if (cores_apart && start->count == 0) stage_support(s, s->normal, start);
    if (s->goal.wants_depth && !cores_apart &&
        (take_closed_depth(s, cover) || (!kept && gauss_take_depth(s, cover)) || epa_run(s, start, 1, cover)))
        return;
    gjk_end end = gjk_run(s, start);
    if (end == GJK_ANSWERED) return;
    if (end == GJK_ITERATIONS) s->limit = OVOID_LIMIT_ITERATIONS;
    cores_apart = s->lower + s->frame->lower_radii > 0;
    if (cores_apart || end == GJK_ITERATIONS) return;
    if (!epa_run(s, start, 0, cover) && !search_is_done(s)) s->limit = OVOID_LIMIT_PRECISION;
}

static void take_small_overlap(search *s, const small_end *end) {
    s->upper = end->upper;
    s->kind = end->kind;
    s->witness = evidence_make(&end->points);
    s->inner_a = end->inner;
    s->stage = end->stage;
}

// Of a depth whose search got stuck without a sign, as of lengths of whose squares' squares nothing is left: the sign,
// as a yes or no finds it, by inner ellipsoids or a few differences. All exact methods together stay within twice the
// goal's iterations; there are two of them here.
COMPILER_NOINLINE static void find_sign(search *s) {
    uint64_t most = 2 * (uint64_t)s->goal.iterations;
    if (s->iterations + 2 > most) return;
    query_goal sign = query_goal_make_collide();
    sign.tolerance = s->goal.tolerance;
    sign.allowance = s->goal.allowance;
    sign.iterations = (uint32_t)((most - s->iterations) / 2);
    rejection found;
    simplex start;
    search t;
    small_end end;
    (void)reject_by_spheres(s->frame, INFINITY, &found);
    search_make(&t, s->frame, &sign);
    const placed_query placed = {s->frame, &sign, NULL, found.lower, 0};
    if (begin_after_spheres(&placed, &found, &end) == BEGIN_SMALL) {
        s->iterations += end.iterations;
        if (end.upper < 0) take_small_overlap(s, &end);
        return;
    }
    run_stages(&t, found.lower, NULL, &start);
    if (!search_is_done(&t)) run_exact(&t, &start, NULL, NULL);
    s->iterations += t.iterations;
    if (!(t.upper < 0)) return;
    s->upper = t.upper;
    s->kind = t.kind;
    s->witness = t.witness;
    s->inner_a = t.inner_a;
    s->stage = t.stage;
}

// The last stage, and what a depth that it leaves open falls back on.
static void search_on(search *s, const ovoid_pair *pair) {
    if (search_is_done(s)) return;
    refine_run(s, pair);
    int is_open = s->lower <= 0 && s->upper >= 0 && s->upper - s->lower > s->goal.tolerance - s->goal.allowance;
    if (s->goal.wants_depth && is_open) find_sign(s);
}

void answer_search(search *s, const ovoid_pair *pair, simplex *start) {
    if (!search_is_done(s)) run_exact(s, start, NULL, NULL);
    search_on(s, pair);
}

// A query as it begins: the goal with the pair's own numbers, the frame, and what its first stages find.
typedef struct query_start {
    query_goal goal;
    pair_frame frame;
    ovoid_limit refused;
    rejection found;
    small_end end;
    placed_query placed; ///< of goal and frame
} query_start;

// A query from its arguments on.
static inline beginning begin(const ovoid_pair *pair, const query_request *request, query_start *s) {
    OVOID_ASSERT(pair);
    ovoid_options options;
    s->goal = *request->goal;
    if (!s->goal.has_cover) cover_clear(request->cover);
    s->refused = OVOID_LIMIT_OPTIONS;
    if (options_make(request->options, &options) && s->goal.far >= 0) s->refused = frame_place(pair, &s->frame);
    if (s->refused != OVOID_LIMIT_NONE) return BEGIN_REFUSED;
    set_numbers(&s->goal, &options, &s->frame);
    if (reject_by_spheres(&s->frame, s->goal.far, &s->found)) return BEGIN_REJECTED;
    s->placed = (placed_query){&s->frame, &s->goal, request->earlier, s->found.lower, 0};
    return begin_after_spheres(&s->placed, &s->found, &s->end);
}

// The stages in doubles, from the earlier proof or without it.
static void search_in_doubles(const open_query *q, const ovoid_proof *earlier, search *s) {
    simplex start;
    search_make(s, q->placed.frame, q->placed.goal);
    if (s->frame->is_true && round_take_point(s)) return;
    run_stages(s, q->placed.sphere_gap, earlier, &start);
    if (!search_is_done(s)) run_exact(s, &start, q->cover, q->kept);
}

// The query as it is without an earlier proof, from the beginning that the spheres left open.
static void search_afresh(const open_query *q, ovoid_answer *out) {
    placed_query cold = q->placed;
    rejection found = {.lower = cold.sphere_gap};
    small_end end;
    search s;
    cold.earlier = NULL;
    if (begin_after_spheres(&cold, &found, &end) == BEGIN_SMALL) {
        *out = answer_make_small(&end, cold.frame, cold.goal);
        return;
    }
    search_in_doubles(q, NULL, &s);
    search_on(&s, q->pair);
    write_wanted(q, &s, out);
}

// Few iterations are all that was allowed: the next call goes on where this one ended.
static int is_better(const ovoid_answer *warm, const ovoid_answer *cold) {
    if (warm->status != OVOID_UNDECIDED && cold->status == OVOID_UNDECIDED) return 1;
    return cold->limit == OVOID_LIMIT_ITERATIONS && warm->status == cold->status &&
           warm->upper - warm->lower < cold->upper - cold->lower;
}

// A search from an earlier proof that did not answer is followed by the query without that proof: no proof, whatever it
// holds, makes an answer worse. What the proof decided and the query alone does not is kept, with its cover.
COMPILER_NOINLINE static void search_again(const open_query *q, search *s, ovoid_answer *out) {
    ovoid_answer warm;
    write_wanted(q, s, &warm);
    cover_clear(q->cover);
    search_afresh(q, out);
    if (!is_better(&warm, out)) return;
    cover_clear(q->cover);
    search_in_doubles(q, q->placed.earlier, s);
    *out = warm;
}

// A depth from the surface of an earlier one, or where the bodies have a closed form, from that. 0 if it does not
// answer the query, which is then as without the surface.
static int run_kept(const open_query *q, search *s) {
    search_make(s, q->placed.frame, q->placed.goal);
    return take_closed_depth(s, q->cover) || epa_lanes_run_kept(s, q->kept, q->cover) ? search_is_done(s) : 0;
}

static void run_search(const open_query *q, ovoid_answer *out) {
    const ovoid_proof *earlier = q->placed.earlier;
    search s;
    if (q->kept && run_kept(q, &s)) {
        write_wanted(q, &s, out);
        return;
    }
    search_in_doubles(q, earlier, &s);
    if (!search_is_done(&s) && earlier) {
        search_again(q, &s, out);
        return;
    }
    search_on(&s, q->pair);
    write_wanted(q, &s, out);
    // Another normal of the same gap may decide what this one leaves to the allowances.
    if (earlier && q->placed.goal->has_axis && out->status == OVOID_UNDECIDED) search_again(q, &s, out);
}

// The same with the supports of true bodies.
COMPILER_NOINLINE static void run_true_search(const open_query *q, ovoid_answer *out) {
    pair_frame f = *q->placed.frame;
    query_goal goal = *q->placed.goal;
    open_query of_true = *q;
    frame_make_true(&f);
    goal.tolerance -= goal.allowance;
    goal.allowance = frame_get_allowance(&f);
    goal.tolerance += goal.allowance;
    goal.has_axis = frame_has_axis(&f);
    of_true.placed.frame = &f;
    of_true.placed.goal = &goal;
    run_search(&of_true, out);
}

void answer_run_search(const open_query *q, ovoid_answer *out) {
    if (frame_has_round(q->placed.frame))
        run_true_search(q, out);
    else
        run_search(q, out);
}

static open_query make_open(const ovoid_pair *pair, const query_request *request, query_start *s) {
    frame_relate(&s->frame);
    return (open_query){pair, s->placed, request->cover, request->kept};
}

void answer_find_internal(const ovoid_pair *pair, const query_request *request, ovoid_answer *out) {
    query_start s;
    open_query q;
    switch (begin(pair, request, &s)) {
    case BEGIN_REFUSED: *out = answer_make_refused(s.refused); break;
    case BEGIN_REJECTED: *out = rejection_make_answer(&s.found, &s.frame, &s.goal); break;
    case BEGIN_SMALL: *out = answer_make_small(&s.end, &s.frame, &s.goal); break;
    case BEGIN_SEARCH:
        q = make_open(pair, request, &s);
        answer_run_search(&q, out);
        break;
    }
}

// Returned by value from functions that are not inlined: where no address of the answer is taken, it is made in the
// caller's place, and a rejection ends sooner than its answer could be copied.
COMPILER_NOINLINE static ovoid_answer search_by_value(const ovoid_pair *pair, const query_request *request,
                                                      query_start *s) {
    ovoid_answer out;
    const open_query q = make_open(pair, request, s);
    answer_run_search(&q, &out);
    return out;
}

ovoid_answer answer_find_by_value(const ovoid_pair *pair, const query_request *request) {
    query_start s;
    switch (begin(pair, request, &s)) {
    case BEGIN_REFUSED: return answer_make_refused(s.refused);
    case BEGIN_REJECTED: return rejection_make_answer(&s.found, &s.frame, &s.goal);
    case BEGIN_SMALL: return answer_make_small(&s.end, &s.frame, &s.goal);
    default: return search_by_value(pair, request, &s);
    }
}

// All arithmetic is inside the call and cannot be moved out of it, so the answer needs no environment_hide. The
// environment is restored after the answer has been made.
ovoid_answer answer_find(const ovoid_pair *pair, const query_request *request) {
    ENVIRONMENT_RETURN_CALL(spheres_fit(pair) ? spheres_find(pair, request) : answer_find_by_value(pair, request));
}
