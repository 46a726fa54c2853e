// The pipeline and its answer.
#include "query/answer.h"

#include "base/environment.h"
#include "base/error.h"
#include "query/epa.h"
#include "query/gjk.h"
#include "query/glance.h"
#include "query/proof.h"
#include "query/refine.h"
#include "query/stages.h"

ovoid_answer answer_make_refused(ovoid_limit limit) {
    return (ovoid_answer){.limit = limit, .lower = -INFINITY, .upper = INFINITY};
}

// The part of the proof behind the upper bound.
static void set_upper_proof(ovoid_proof *p, const search *s) {
    p->kind = s->kind;
    if (s->kind == OVOID_PROOF_INNER || s->kind == OVOID_PROOF_INNER_POINTS) {
        p->inner_a = s->inner_a;
        p->inner_b = s->inner_b;
        return;
    }
    p->count = (uint32_t)s->witness.count;
    for (int i = 0; i < s->witness.count; i++) {
        p->a[i] = s->witness.p[i].a;
        p->b[i] = s->witness.p[i].b;
        p->weight_a[i] = p->weight_b[i] = s->witness.weight[i];
    }
}

static ovoid_status find_status(const search *s) {
    if (s->lower > 0) return OVOID_SEPARATED;
    if (s->upper < 0) return OVOID_OVERLAPPING;
    return s->upper - s->lower <= s->ask.tolerance ? OVOID_TOUCHING : OVOID_UNDECIDED;
}

// Why the bracket is wider than the tolerance, if it is.
static ovoid_limit find_limit(const search *s, ovoid_status status) {
    // A common point is no witness of a depth, unless the depth is within the tolerance.
    int common = s->ask.wants_depth && s->kind == OVOID_PROOF_HULL && s->lower < -s->ask.tolerance;
    if (s->upper - s->lower <= s->ask.tolerance && !common) return OVOID_LIMIT_NONE;
    if (s->limit != OVOID_LIMIT_NONE) return s->limit;
    if (status == OVOID_UNDECIDED) return OVOID_LIMIT_PRECISION;
    if (s->lower > s->ask.far) return s->ask.beyond;
    // A distance or a depth that was asked for, and is wide.
    int is_asked = s->ask.wants_bracket && (status == OVOID_SEPARATED || s->ask.wants_depth);
    return is_asked && s->upper > s->ask.near ? OVOID_LIMIT_PRECISION : OVOID_LIMIT_ANSWERED;
}

// A lower bound for a search that has none: the enclosing spheres' gap along the line of centres.
static void take_spheres(search *s) {
    const pair_frame *f = s->frame;
    vec3 d = vec3_sub(frame_b(f, f->b->center), f->a->center), n = vec3_unit(d);
    if (!(vec3_norm_squared(n) > 0.5)) n = (vec3){1, 0, 0};
    s->lower = vec3_dot(n, d) - (f->a->reach + f->b->reach) - f->radii - f->claim;
    s->normal = n;
}

// A stage that proved one side only: spheres and any vertex pair bound the other.
static void complete(search *s) {
    if (s->lower == -INFINITY) take_spheres(s);
    if (s->upper == INFINITY) {
        simplex any = {.p = {{frame_difference(s->frame, 0, 0), 0, 0}}, .weight = {1}, .count = 1};
        search_take_points(s, &any);
    }
}

ovoid_verdict answer_make_verdict(search *s) {
    complete(s);
    ovoid_status status = find_status(s);
    return (ovoid_verdict){status, s->stage, find_limit(s, status), s->iterations, s->lower, s->upper};
}

void answer_write(search *s, ovoid_answer *out) {
    const pair_frame *f = s->frame;
    ovoid_verdict is = answer_make_verdict(s);
    *out = (ovoid_answer){.status = is.status, .stage = is.stage, .limit = is.limit, .iterations = is.iterations};
    out->lower = is.lower;
    out->upper = is.upper;
    int refined = vec3_norm_squared(s->world) > 0;
    out->normal = out->proof.normal = refined ? s->world : frame_direction_to_world(f, s->normal);
    out->proof.normal_low = s->world_low;
    set_upper_proof(&out->proof, s);
    witness_points w = witness_compute_points(f, &out->proof);
    out->point_a = frame_point_to_world(f, w.a);
    out->point_b = frame_point_to_world(f, w.b);
}

int options_make(const ovoid_options *given, ovoid_options *options) {
    *options = given ? *given : (ovoid_options){0, 0, 0, 0};
    if (!(options->absolute_tolerance >= 0) || !(options->relative_tolerance >= 0)) return 0;
    if (isnan(options->cap) || options->cap < 0) return 0;
    if (options->relative_tolerance == 0) options->relative_tolerance = 1e-9;
    if (options->cap == 0) options->cap = INFINITY;
    if (options->iterations == 0) options->iterations = 1000;
    return 1;
}

// The first look. The spheres come first, as they cost the same for any number of vertices. An overlap's proof has a
// normal that parted nothing.
static int take_glance(const pair_frame *f, const question *ask, const ovoid_proof *earlier, glance *found) {
    if (glance_at_spheres(f, ask->far, found)) return 1;
    int was_apart = earlier && ask->far < INFINITY &&
                    (earlier->kind == OVOID_PROOF_POINTS || earlier->kind == OVOID_PROOF_INNER_POINTS);
    return was_apart && glance_at_proof(f, ask->far, earlier, found);
}

static int may_overlap(const search *s) {
    const pair_frame *f = s->frame;
    double reach = f->a->reach + f->b->reach;
    return s->lower + f->radii <= 0 &&
           vec3_norm_squared(vec3_sub(frame_b(f, f->b->center), f->a->center)) < reach * reach;
}

static vec3 find_line(const pair_frame *f) {
    vec3 n = vec3_unit(vec3_sub(frame_b(f, f->b->center), f->a->center));
    return vec3_norm_squared(n) > 0.5 ? n : (vec3){1, 0, 0};
}

// The stages before the search; the simplex to start from. A depth goes to EPA at once if the spheres overlap,
// without one. A distance starts from the earlier proof's simplex; where a direction may be enough, that of the
// ellipsoids is tried.
static void run_stages(search *s, double spheres, const ovoid_proof *earlier, simplex *start) {
    stage_proof(s, earlier, start);
    if (search_is_done(s)) return;
    if (!s->ask.wants_depth) stage_inner(s);
    if (search_is_done(s) || (start->count && s->ask.far == INFINITY)) return;
    vec3 n;
    if (s->ask.wants_depth && may_overlap(s)) return;
    if (question_takes_line(&s->ask, s->frame->a, s->frame->b, spheres))
        n = find_line(s->frame);
    else
        stage_outer(s, &n);
    if (search_is_done(s)) return;
    simplex fresh;
    stage_support(s, n, start->count > 1 ? &fresh : start);
}

// GJK, and EPA where the cores touch or overlap and GJK cannot say more. A depth tries EPA first, unless the cores are
// known to be apart.
static void run_exact(search *s, simplex *start, ovoid_cover *cover) {
    int cores_apart = s->lower + s->frame->radii > 0;
    if (s->ask.wants_depth && !cores_apart && epa_run(s, start, 1, cover)) return;
    gjk_end end = gjk_run(s, start);
    if (end == GJK_ANSWERED) return;
    if (end == GJK_ITERATIONS) s->limit = OVOID_LIMIT_ITERATIONS;
    cores_apart = s->lower + s->frame->radii > 0;
    if (cores_apart || end == GJK_ITERATIONS) return;
    if (!epa_run(s, start, 0, cover) && !search_is_done(s)) s->limit = OVOID_LIMIT_PRECISION;
}

void answer_search(search *s, const ovoid_pair *pair, const ovoid_proof *earlier, simplex *start, ovoid_cover *cover) {
    if (!search_is_done(s)) run_exact(s, start, cover);
    if (!search_is_done(s)) refine_run(s, pair, earlier);
}

// How a query begins: refused, answered by the first look, or on its way.
typedef enum beginning { BEGIN_REFUSED, BEGIN_SEEN, BEGIN_SEARCH } beginning;

static inline beginning begin(const ovoid_pair *pair, const ovoid_options *given, question *ask,
                              const ovoid_proof *earlier, ovoid_cover *cover, pair_frame *frame, glance *seen,
                              ovoid_limit *refused) {
    OVOID_ASSERT(pair && pair->shape_a && pair->shape_b);
    ovoid_options options;
    if (cover) cover->point_count = cover->triangle_count = 0;
    *refused = OVOID_LIMIT_OPTIONS;
    if (options_make(given, &options) && ask->far >= 0) *refused = frame_place(pair, frame);
    if (*refused != OVOID_LIMIT_NONE) return BEGIN_REFUSED;
    ask->tolerance = max2(options.absolute_tolerance, options.relative_tolerance * frame->size) + 8 * frame->hidden;
    ask->iterations = options.iterations;
    return take_glance(frame, ask, earlier, seen) ? BEGIN_SEEN : BEGIN_SEARCH;
}

static void run_search(const ovoid_pair *pair, pair_frame *frame, double spheres, const question *ask,
                       const ovoid_proof *earlier, ovoid_cover *cover, ovoid_answer *out) {
    frame_relate(frame);
    search s;
    search_make(&s, frame, ask);
    simplex start;
    run_stages(&s, spheres, earlier, &start);
    answer_search(&s, pair, earlier, &start, cover);
    answer_write(&s, out);
}

void answer_find_inside(const ovoid_pair *pair, const ovoid_options *given, question ask, const ovoid_proof *earlier,
                        ovoid_cover *cover, ovoid_answer *out) {
    pair_frame frame;
    glance seen;
    ovoid_limit refused;
    switch (begin(pair, given, &ask, earlier, cover, &frame, &seen, &refused)) {
    case BEGIN_REFUSED: *out = answer_make_refused(refused); break;
    case BEGIN_SEEN: *out = glance_make_answer(&seen, &frame, &ask); break;
    case BEGIN_SEARCH: run_search(pair, &frame, seen.lower, &ask, earlier, cover, out); break;
    }
}

// By value, and called, not inlined: what takes no address of its answer makes it in the caller's place, and a first
// look is done sooner than its answer is copied.
__attribute__((noinline)) static ovoid_answer search_by_value(const ovoid_pair *pair, pair_frame *frame, double spheres,
                                                              const question *ask, const ovoid_proof *earlier,
                                                              ovoid_cover *cover) {
    ovoid_answer out;
    run_search(pair, frame, spheres, ask, earlier, cover, &out);
    return out;
}

__attribute__((noinline)) static ovoid_answer find_by_value(const ovoid_pair *pair, const ovoid_options *given,
                                                            const question *asked, const ovoid_proof *earlier,
                                                            ovoid_cover *cover) {
    question ask = *asked;
    pair_frame frame;
    glance seen;
    ovoid_limit refused;
    switch (begin(pair, given, &ask, earlier, cover, &frame, &seen, &refused)) {
    case BEGIN_REFUSED: return answer_make_refused(refused);
    case BEGIN_SEEN: return glance_make_answer(&seen, &frame, &ask);
    default: return search_by_value(pair, &frame, seen.lower, &ask, earlier, cover);
    }
}

static void leave(const environment *before) { environment_leave(*before); }

// All arithmetic is inside the call, which nothing of it can leave: the answer needs no hiding. It is returned as it
// comes, and the environment is put back behind that.
ovoid_answer answer_find(const ovoid_pair *pair, const ovoid_options *given, const question *ask,
                         const ovoid_proof *earlier, ovoid_cover *cover) {
    __attribute__((cleanup(leave), unused)) environment before = environment_enter();
    return find_by_value(pair, given, ask, earlier, cover);
}
