// The contact of two bodies: from the features of an earlier one, as long as the bracket that they show is narrow
// enough; else from a search for the depth or the distance.
#include "base/environment.h"
#include "base/error.h"
#include "exact/cover_memory.h"
#include "manifold/manifold.h"
#include "query/answer.h"
#include "query/begin.h"

#include <string.h>

// A query in the order of order.c.
typedef struct task {
    ovoid_pair pair;
    pair_frame frame;
    manifold_terms terms;
    const ovoid_manifold *earlier; ///< or NULL
    int is_exchanged;
} task;

// The cosine of an angle of at most a quarter turn, to 1e-4, with the same bits on every machine.
static double compute_cosine(double angle) {
    double x = angle * angle;
    return 1 - x / 2 * (1 - x / 12 * (1 - x / 30 * (1 - x / 56)));
}

int manifold_options_are_valid(const ovoid_manifold_options *o) {
    return o->margin >= 0 && isfinite(o->margin) && o->tolerance >= 0 && o->keep >= 0 && o->angle >= 0 &&
           o->angle <= MANIFOLD_ANGLE;
}

int manifold_terms_make(const ovoid_manifold_options *given, const pair_frame *f, manifold_terms *t) {
    static const ovoid_manifold_options none;
    const ovoid_manifold_options *o = given ? given : &none;
    double tolerance = o->tolerance > 0 ? o->tolerance : 1e-9 * f->size,
           angle = o->angle > 0 ? o->angle : MANIFOLD_ANGLE;
    *t = (manifold_terms){o->margin, o->keep,  tolerance + 8 * f->hidden, 0.1 * tolerance, compute_cosine(angle),
                          o->cover,  o->points};
    return manifold_options_are_valid(o);
}

// ---- what the features show ----

static double compute_lower(const pair_frame *f, const gap_along *g) {
    double lower = g->gap - f->lower_radii - f->claim;
    return frame_take_gain(lower, frame_compute_gain(f, g->n, g->n_in_b, AXIS_CLAIM));
}

double manifold_compute_points_upper(const manifold_state *s) {
    return s->polygon.least + 2 * manifold_compute_rounding(s) - s->frame.pair->upper_radii;
}

void manifold_clip(const manifold_terms *t, const manifold_axis *axis, const ovoid_manifold *earlier,
                   manifold_state *s) {
    const pair_frame *f = s->frame.pair;
    clip_rules rules = {
        .snap = MANIFOLD_SNAP * f->size, .most = t->margin + f->a->radius + f->b->radius, .keep = t->keep};
    rules.most += 2 * manifold_compute_rounding(s);
    if (earlier && rules.keep > rules.snap)
        rules.kept = earlier->id, rules.kept_count = earlier->count < 4 ? earlier->count : 4;
    patches_clip(s, &rules);
    if (s->polygon.count) return;
    manifold_corner c = manifold_make_nearest(s, axis);
    s->polygon.corners[s->polygon.count++] = c;
    s->polygon.least = min2(s->polygon.least, fabs(c.separation) + 2 * manifold_compute_excess(s, &c));
}

// Patches and polygon about the normal along which a gap was measured.
static void build(const task *t, const manifold_axis *axis, const gap_along *along, manifold_state *s) {
    const pair_frame *f = &t->frame;
    const ovoid_manifold *e = t->earlier;
    manifold_frame_make(f, along, &s->frame);
    facet_choice a = {along->n, axis->a, along->low_a, e ? e->facet_a : 0, e != NULL, t->terms.least};
    facet_choice b = {vec3_neg(along->n_in_b), axis->b, along->low_b, e ? e->facet_b : 0, e != NULL, t->terms.least};
    s->facet_a = facet_choose(f->a, &a);
    s->facet_b = facet_choose(f->b, &b);
    patch_make_a(&s->frame, s->facet_a, &s->a);
    patch_make_b(&s->frame, s->facet_b, &s->b);
    manifold_clip(&t->terms, axis, e, s);
}

// ---- the contact ----

// A bracket with the evidence of its upper end.
typedef struct bracket {
    double lower, upper;
    ovoid_manifold_proof proof;
} bracket;

static void take_upper(bracket *b, double upper, ovoid_manifold_proof proof) {
    if (!(upper < b->upper)) return;
    b->upper = upper;
    b->proof = proof;
}

// How wide a bracket may be, beside the allowances; what an earlier search left, or NULL; and up to where an upper
// bound is of use that leaves the bracket wider: that of the present search, else -infinity.
typedef struct demand {
    double width;
    const ovoid_manifold_memory *memory;
    double useful;
} demand;

// The upper bound that the features show; of overlaps, where they show less than enough, also the one that is left of
// an earlier search.
static void measure(const task *t, const manifold_state *s, const manifold_axis *axis, const demand *d, bracket *b) {
    const pair_frame *f = &t->frame;
    double enough = b->lower + d->width + frame_get_allowance(f);
    take_upper(b, manifold_compute_points_upper(s), OVOID_MANIFOLD_PROOF_POINTS);
    if (!(s->frame.gap < 0) || b->upper <= enough) return;
    const depth_demand depths = {-max2(enough, d->useful) - f->upper_radii, -enough - f->upper_radii};
    double depth = manifold_prove_depth(s, axis, &depths);
    if (depth > 0) take_upper(b, -depth - f->upper_radii, OVOID_MANIFOLD_PROOF_FACETS);
    if (b->upper > enough && d->memory) take_upper(b, memory_compute_upper(d->memory, f), OVOID_MANIFOLD_PROOF_SEARCH);
}

static int is_narrow(const task *t, const bracket *b) {
    return b->upper - b->lower <= t->terms.tolerance + frame_get_allowance(&t->frame);
}

static void write_bracket(const task *t, const bracket *b, ovoid_limit limit, ovoid_manifold *out) {
    out->lower = b->lower;
    out->upper = max2(b->upper, b->lower);
    out->proof = (uint8_t)b->proof;
    out->status = bracket_find_status(out->lower, out->upper, t->terms.tolerance);
    int is_reason = limit != OVOID_LIMIT_NONE && limit != OVOID_LIMIT_CAP;
    out->limit = is_narrow(t, b) ? OVOID_LIMIT_NONE : is_reason ? limit : OVOID_LIMIT_PRECISION;
}

// No points: proven farther apart than the margin, along n.
static void write_apart(double lower, vec3 normal, ovoid_manifold *out) {
    *out = (ovoid_manifold){
        .status = OVOID_SEPARATED, .limit = OVOID_LIMIT_CAP, .lower = lower, .upper = INFINITY, .normal = normal};
}

static int is_unit(vec3 n) { return fabs(vec3_norm(n) - 1) <= 1e-13; }

static int is_given_normal(const task *t, const manifold_state *s, const manifold_axis *axis, vec3 given) {
    if (axis->kind != OVOID_MANIFOLD_FREE || !is_unit(given)) return 0;
    vec3 n = vec3_unit(frame_direction_from_world(&t->frame, given));
    return n.x == s->frame.n.x && n.y == s->frame.n.y && n.z == s->frame.n.z;
}

// given: the world normal that was kept or searched for; where no feature makes another, it is the contact's, so that
// what is computed from it later has the same bits.
static void write_points(const task *t, const manifold_state *s, const manifold_axis *axis, vec3 given,
                         ovoid_manifold *out) {
    corner_choice chosen = corners_choose(s, t->earlier, t->terms.slack);
    out->normal = is_given_normal(t, s, axis, given) ? given : frame_direction_to_world(&t->frame, s->frame.n);
    out->axis = axis->kind;
    out->feature_a = axis->a;
    out->feature_b = axis->b;
    out->facet_a = s->facet_a;
    out->facet_b = s->facet_b;
    corner_choice_write(&chosen, &s->polygon, out);
    if (t->terms.points) manifold_write_points(s, &chosen, t->is_exchanged, t->terms.points);
}

// ---- a guess ----

// Of the facets around a vertex the one that a ray along d from the inner centre meets first.
static uint32_t find_exit(const ovoid_shape *s, uint32_t vertex, vec3 d) {
    const uint32_t *starts = shape_neighbor_starts(s);
    uint32_t best = UINT32_MAX;
    double most = 0;
    for (uint32_t i = starts[vertex]; i < starts[vertex + 1]; i++) {
        uint32_t facet = shape_edge_facets(s)[i];
        const ovoid_plane *plane = shape_planes(s) + facet;
        double rate = vec3_dot(plane->normal, d) / (plane->offset - vec3_dot(plane->normal, s->inner.center));
        if (rate > most) most = rate, best = facet;
    }
    return best;
}

// 1 if one of the facets around a vertex has that normal, and the ray meets none of them sooner.
static int is_exit(const ovoid_shape *s, uint32_t vertex, vec3 d, vec3 normal) {
    const uint32_t *starts = shape_neighbor_starts(s), *facets = shape_edge_facets(s);
    for (uint32_t i = starts[vertex]; i < starts[vertex + 1]; i++)
        if (vec3_dot(shape_planes(s)[facets[i]].normal, normal) >= 1 - 1e-12)
            return facets[i] == find_exit(s, vertex, d);
    return 0;
}

static double get_largest(const mat3 *m) {
    return max2(vec3_max_abs(m->r0), max2(vec3_max_abs(m->r1), vec3_max_abs(m->r2)));
}

// 0 if no facets of the bodies can be on one another: of boxes, an axis of one would be one of the other.
static int may_be_opposite(const pair_frame *f) {
    if (f->a->rank < 3 || f->b->rank < 3) return 0;
    return !(f->a->box.is_upright && f->b->box.is_upright) || get_largest(&f->rotation) >= 1 - 2e-12;
}

// The facets that the line of centres meets, if they are on one another. Of most pairs no facet of B is opposite that
// of A.
static int guess_facets(const pair_frame *f, manifold_axis *axis, vec3 *n) {
    if (!may_be_opposite(f)) return 0;
    vec3 d = vec3_sub(frame_b(f, f->b->inner.center), f->a->inner.center);
    vec3 in_b = vec3_neg(mat3_mul_transposed_vec3(f->rotation, d));
    simd_pair ends = frame_find_pair(f, d, in_b);
    uint32_t a = find_exit(f->a, ends.high.index, d);
    if (a == UINT32_MAX) return 0;
    *n = shape_get_facet_normal(f->a, a);
    *axis = (manifold_axis){OVOID_MANIFOLD_FACE_A, OVOID_MANIFOLD_FACET | a, OVOID_MANIFOLD_VERTEX | ends.low.index};
    return is_exit(f->b, ends.low.index, in_b, vec3_neg(mat3_mul_transposed_vec3(f->rotation, *n)));
}

// 1 if facets that are on one another show the contact as exactly as a search would.
COMPILER_NOINLINE static int find_guess(const task *t, ovoid_manifold *out) {
    manifold_state state, *s = &state;
    manifold_axis axis;
    vec3 n;
    if (!guess_facets(&t->frame, &axis, &n)) return 0;
    gap_along along = gap_measure_along(&t->frame, n);
    bracket b = {compute_lower(&t->frame, &along), INFINITY, OVOID_MANIFOLD_PROOF_NONE};
    if (b.lower > t->terms.margin) {
        write_apart(b.lower, frame_direction_to_world(&t->frame, n), out);
        return 1;
    }
    axis.b = OVOID_MANIFOLD_VERTEX | along.low_b;
    build(t, &axis, &along, s);
    double width = min2(t->terms.tolerance, 1e-9 * t->frame.size);
    measure(t, s, &axis, &(demand){width, NULL, -INFINITY}, &b);
    if (!(b.upper - b.lower <= width + frame_get_allowance(&t->frame))) return 0;
    write_points(t, s, &axis, n, out);
    write_bracket(t, &b, OVOID_LIMIT_NONE, out);
    // Where a cover is wanted an upper bound that ages is one that the cover shows.
    if (!t->terms.cover && b.upper < 0) memory_set_search(&out->memory, &t->pair, &t->frame, b.upper);
    return 1;
}

// ---- the earlier contact's features ----

// 1 if the bodies are farther apart than the margin along the direction that showed it last.
static int find_apart(const task *t, ovoid_manifold *out) {
    const ovoid_manifold *e = t->earlier;
    const pair_frame *f = &t->frame;
    if (!e || e->axis != OVOID_MANIFOLD_NONE || e->status != OVOID_SEPARATED || !is_unit(e->normal)) return 0;
    gap_along along = gap_measure_along(f, vec3_unit(frame_direction_from_world(f, e->normal)));
    double lower = compute_lower(f, &along);
    if (!(lower > t->terms.margin)) return 0;
    write_apart(lower, e->normal, out);
    return 1;
}

// 1 if the earlier contact's features, measured again, are the contact.
COMPILER_NOINLINE static int find_warm(const task *t, ovoid_manifold *out) {
    manifold_state state, *s = &state;
    const ovoid_manifold *e = t->earlier;
    const pair_frame *f = &t->frame;
    if (!e || e->axis == OVOID_MANIFOLD_NONE) return 0;
    manifold_axis axis = {e->axis, e->feature_a, e->feature_b};
    vec3 given = e->normal, n = {0, 0, 0};
    if (axis.kind == OVOID_MANIFOLD_FREE) {
        if (!is_unit(given)) given = vec3_unit(given);
        n = vec3_unit(frame_direction_from_world(f, given));
    }
    if (!axis_compute_normal(f, &axis, &n) || !(fabs(vec3_norm_squared(n) - 1) < 1e-9)) return 0;
    gap_along along = gap_measure_along(f, n);
    bracket b = {compute_lower(f, &along), INFINITY, OVOID_MANIFOLD_PROOF_NONE};
    if (b.lower > t->terms.margin) {
        write_apart(b.lower, frame_direction_to_world(f, n), out);
        return 1;
    }
    build(t, &axis, &along, s);
    measure(t, s, &axis, &(demand){t->terms.tolerance, &e->memory, -INFINITY}, &b);
    if (!is_narrow(t, &b)) return 0;
    write_points(t, s, &axis, given, out);
    write_bracket(t, &b, OVOID_LIMIT_NONE, out);
    out->memory = e->memory;
    return 1;
}

// ---- a search ----

// What a contact needs of a search for the depth or the distance.
typedef struct search_end {
    double lower, upper;
    vec3 normal; ///< world
    ovoid_limit limit;
    int has_cover;         ///< a surface around the origin proves `upper`
    uint32_t low_a, low_b; ///< vertices of the surface's nearest face; UINT32_MAX where there are none
} search_end;

// The query of ovoid_depth, in the frame that is there. A state is as large as a search: neither is on the stack while
// the other is.
COMPILER_NOINLINE static search_end search_pair(const task *t) {
    const pair_frame *f = &t->frame;
    const ovoid_options given = {.relative_tolerance = 0.5 * min2(1e-9, max2(t->terms.tolerance / f->size, 1e-15)),
                                 .iterations = cover_get_iterations(t->terms.cover, 0)};
    ovoid_options options;
    query_goal goal = query_goal_make_depth(NULL);
    rejection found;
    small_end small;
    ovoid_answer answer;
    (void)options_make(&given, &options);
    goal.far = t->terms.margin;
    goal.wants_corner = !t->terms.cover;
    set_numbers(&goal, &options, f);
    cover_clear(t->terms.cover);
    if (reject_by_spheres(f, goal.far, &found))
        return (search_end){found.lower, INFINITY, found.normal, OVOID_LIMIT_CAP, 0, UINT32_MAX, UINT32_MAX};
    const open_query open = {
        .pair = &t->pair, .placed = {f, &goal, NULL, found.lower, BARE_ANSWER}, .cover = t->terms.cover};
    if (begin_after_spheres(&open.placed, &found, &small) == BEGIN_SMALL)
        return (search_end){.lower = small.lower,
                            .upper = small.upper,
                            .normal = small.normal,
                            .limit = answer_make_small_verdict(&small, &goal).limit,
                            .has_cover = small.kind == OVOID_PROOF_COVER,
                            .low_a = UINT32_MAX,
                            .low_b = UINT32_MAX};
    answer_run_search(&open, &answer);
    return (search_end){.lower = answer.lower,
                        .upper = answer.upper,
                        .normal = answer.normal,
                        .limit = answer.limit,
                        .has_cover = answer.proof.kind == OVOID_PROOF_COVER,
                        .low_a = answer.proof.a[0],
                        .low_b = answer.proof.b[0]};
}

// The gap along the direction of a search. A face's vertices are extreme along its normal: where their gap is the one
// that the search measured, to rounding, they need not be found again.
static gap_along measure_search(const pair_frame *f, const search_end *end, vec3 n) {
    if (!end->has_cover || end->low_a >= f->a->vertex_count || end->low_b >= f->b->vertex_count)
        return gap_measure_along(f, n);
    gap_along g = {n, mat3_mul_transposed_vec3(f->rotation, n), vec3_dot(n, f->translation), 0, end->low_a, end->low_b};
    double high = vec3_dot(n, frame_vertex_a(f, g.low_a)),
           low = vec3_dot(g.n_in_b, vec3_at(shape_vertices(f->b), g.low_b));
    g.gap = (g.tn + low) - high;
    return g.gap <= end->lower + f->lower_radii + 2 * f->claim ? g : gap_measure_along(f, n);
}

COMPILER_NOINLINE static void take_search(const task *t, const search_end *end, ovoid_manifold *out) {
    const pair_frame *f = &t->frame;
    manifold_state state, *s = &state;
    vec3 given = end->normal, n = vec3_unit(frame_direction_from_world(f, given));
    if (!(vec3_norm_squared(n) > 0.5)) {
        given = (vec3){0, 0, 1};
        n = vec3_unit(frame_direction_from_world(f, given));
    }
    gap_along along = measure_search(f, end, n);
    // A search in pairs of doubles may show more than its normal in doubles.
    double lower = min2(end->lower, compute_lower(f, &along));
    if (lower > t->terms.margin) {
        write_apart(lower, given, out);
        return;
    }
    if (end->has_cover) memory_set_search(&out->memory, &t->pair, f, end->upper);
    manifold_axis axis = axis_choose(f, 0.25 * min2(1e-9 * f->size, t->terms.tolerance), &along);
    build(t, &axis, &along, s);
    bracket b = {compute_lower(f, &along), INFINITY, OVOID_MANIFOLD_PROOF_NONE};
    double searched = end->has_cover ? end->upper : INFINITY;
    measure(t, s, &axis, &(demand){t->terms.tolerance, NULL, searched}, &b);
    if (!is_narrow(t, &b)) take_upper(&b, searched, OVOID_MANIFOLD_PROOF_SEARCH);
    write_points(t, s, &axis, given, out);
    write_bracket(t, &b, end->limit, out);
}

static void find_cold(const task *t, ovoid_manifold *out) {
    search_end end = search_pair(t);
    take_search(t, &end, out);
}

static ovoid_manifold make_refused(ovoid_limit limit) {
    return (ovoid_manifold){.limit = limit, .lower = -INFINITY, .upper = INFINITY};
}

// The pair in its order, and the options. Refused pairs have no order.
static ovoid_limit open_task(const ovoid_pair *pair, const ovoid_manifold_options *options,
                             const ovoid_manifold *earlier, task *t) {
    if (!pair->shape_a) return OVOID_LIMIT_SHAPE_A;
    if (!pair->shape_b) return OVOID_LIMIT_SHAPE_B;
    t->is_exchanged = order_is_exchanged(pair, earlier);
    t->pair = t->is_exchanged ? pair_make_exchanged(pair) : *pair;
    ovoid_limit refused = frame_make(&t->pair, &t->frame);
    if (refused != OVOID_LIMIT_NONE) return frame_make(pair, &t->frame);
    if (!manifold_terms_make(options, &t->frame, &t->terms)) return OVOID_LIMIT_OPTIONS;
    return !t->terms.cover || cover_has_memory(t->terms.cover) ? OVOID_LIMIT_NONE : OVOID_LIMIT_MEMORY;
}

void manifold_find_internal(const ovoid_pair *pair, const ovoid_manifold_options *options,
                            const ovoid_manifold *earlier, ovoid_manifold *out) {
    OVOID_ASSERT(pair);
    task t;
    ovoid_manifold before;
    if (options && options->points) options->points->count = 0, options->points->grown = 0;
    ovoid_limit refused = open_task(pair, options, earlier, &t);
    if (refused != OVOID_LIMIT_NONE) {
        *out = make_refused(refused);
        return;
    }
    t.earlier = earlier;
    if (t.is_exchanged && earlier) before = ovoid_manifold_make_swapped(earlier), t.earlier = &before;
    memset(out, 0, sizeof *out);
    if (!find_apart(&t, out) && !find_warm(&t, out) && !find_guess(&t, out)) find_cold(&t, out);
    out->memory.flags &= ~(uint32_t)MANIFOLD_EXCHANGED;
    if (t.is_exchanged) *out = ovoid_manifold_make_swapped(out);
}

ovoid_manifold ovoid_manifold_find(const ovoid_pair *pair, const ovoid_manifold_options *options,
                                   const ovoid_manifold *earlier) {
    ENVIRONMENT_RETURN_FILLED(ovoid_manifold, manifold, pair,
                              manifold_find_internal(pair, options, earlier, &manifold));
}
