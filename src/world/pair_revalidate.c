// A pair whose kept bounds no longer answer the query: before it is queried again, its cached proof is measured at the
// present poses. For bodies that are apart this is the gap along the cached normal, for bodies that overlap the common
// point or the few differences around the origin. Mostly it still holds, at a tenth of a query's cost.
#include "pair/hull.h"
#include "pair/inner.h"
#include "pair/reject.h"
#include "simd/kept8.h"
#include "world/step.h"

static vec3 get_vertex(const ovoid_shape *s, uint32_t i) { return vec3_at(shape_vertices(s), i); }

static double measure_hull(const pair_frame *f, const pair_cache *cache) {
    vec3 w[OVOID_PROOF_PAIRS];
    for (uint32_t i = 0; i < cache->count; i++)
        w[i] =
            frame_world_difference(f, get_vertex(f->a, cache->of.entry[i][0]), get_vertex(f->b, cache->of.entry[i][1]));
    double depth = cache->count ? hull_compute_depth(w, cache->count, f->claim) : 0;
    return depth > 0 ? -depth - f->upper_radii : 0;
}

// A common point of the inner ellipsoids: the cached one, which is fixed in A, or one for the present poses.
static double measure_inner(const pair_frame *f, pair_cache *cache) {
    double upper = inner_compute_upper(f, cache->of.inner);
    vec3 x;
    double other = inner_find_common(f, &x) ? inner_compute_upper(f, x) : 0;
    if (!(other < upper)) return upper;
    cache->of.inner = x;
    return other;
}

static int measure_overlap(pair_frame *f, pair_cache *cache) {
    double upper = 0;
    if (cache->proof == OVOID_PROOF_INNER) {
        frame_relate(f);
        upper = measure_inner(f, cache);
    }
    if (cache->proof == OVOID_PROOF_HULL) upper = measure_hull(f, cache);
    if (!(upper < 0)) return 0;
    cache->upper = upper;
    return 1;
}

static int measure_gap(const pair_frame *f, pair_cache *cache, double margin) {
    rejection found;
    ovoid_proof earlier;
    if (reject_by_spheres(f, margin, &found)) {
        cache->stage = OVOID_STAGE_SPHERE;
    } else {
        earlier.normal = cache->normal;
        if (!reject_by_normal(f, margin, &earlier, &found)) return 0;
        cache->stage = OVOID_STAGE_PROOF;
    }
    cache->normal = found.normal;
    cache->lower = found.lower;
    return 1;
}

// The other bound comes from the spheres.
static void close_bracket(const ovoid_world *w, const world_pair *p, pair_cache *cache) {
    const world_body *a = &w->bodies[p->a], *b = &w->bodies[p->b];
    double d = vec3_norm(vec3_sub(w->places[p->b].at, w->places[p->a].at)),
           center_error = a->center_error + b->center_error;
    double reach = ((a->reach + b->reach) + (a->radius + b->radius)) * (1 + 0x1p-48) + center_error;
    cache->limit = OVOID_LIMIT_ANSWERED;
    cache->iterations = 0;
    if (cache->status == OVOID_SEPARATED) {
        cache->upper = (d + reach) * (1 + 0x1p-48);
    } else {
        cache->lower = d * (1 - 0x1p-48) - reach;
        cache->stage = OVOID_STAGE_PROOF;
    }
}

// What may be measured of a cached answer.
typedef enum measurable { MEASURE_NOTHING, MEASURE_GAP, MEASURE_OVERLAP } measurable;

static measurable find_measurable(const ovoid_world *w, const world_pair *p, const pair_cache *cache) {
    if (!(p->flags & PAIR_KNOWN) || !w->bodies[p->a].body.shape || !w->bodies[p->b].body.shape) return MEASURE_NOTHING;
    if (cache->status == OVOID_SEPARATED && cache->lower > w->margin + world_get_pair_range(w, p->a, p->b))
        return MEASURE_GAP;
    return cache->status == OVOID_OVERLAPPING && !world_is_measuring(w) ? MEASURE_OVERLAP : MEASURE_NOTHING;
}

// ---- one pair

int pair_revalidate(const ovoid_world *w, const world_pair *p, pair_cache *cache) {
    const world_body *a = &w->bodies[p->a], *b = &w->bodies[p->b];
    double margin = w->margin + world_get_pair_range(w, p->a, p->b);
    measurable what = find_measurable(w, p, cache);
    if (what == MEASURE_NOTHING) return 0;
    ovoid_pair both = {a->body.shape, b->body.shape, a->body.pose, b->body.pose};
    pair_frame f;
    if (frame_place(&both, &f) != OVOID_LIMIT_NONE) return 0;
    if (!(what == MEASURE_GAP ? measure_gap(&f, cache, margin) : measure_overlap(&f, cache))) return 0;
    close_bracket(w, p, cache);
    return 1;
}

// ---- many pairs, in lane groups

// The pairs of a lane group that waits to be full.
typedef struct kept_group {
    kept8_places places;
    uint16_t items[PAIR8];
} kept_group;

typedef struct revalidation {
    ovoid_world *w;
    world_pair *pairs;
    kept_group gaps, depths;
    uint16_t *open; ///< those that are not answered
    uint32_t open_count;
} revalidation;

static vec3 get_lane3(const lane_column *c, uint32_t k) { return (vec3){c[0].lane[k], c[1].lane[k], c[2].lane[k]}; }

static const kept8_errors errors = {FRAME_REJECT, FRAME_CLAIM, OVOID_LENGTH_MIN};

static void take_result(revalidation *r, uint16_t item, int is_answered) {
    world_pair *p = &r->pairs[item];
    if (is_answered)
        pair_renew(r->w, p, &r->w->pair_cache[p->slot]);
    else
        r->open[r->open_count++] = item;
}

// The gap of a lane: by the spheres, else along the normal.
static int take_gap(const ovoid_world *w, const world_pair *p, const kept8_gaps *from, uint32_t k) {
    pair_cache *cache = &w->pair_cache[p->slot];
    double margin = w->margin + world_get_pair_range(w, p->a, p->b), lower = from->sphere.lane[k];
    if (lower > margin) {
        cache->stage = OVOID_STAGE_SPHERE;
        cache->normal = vec3_scale(get_lane3(from->between, k), 1 / from->distance.lane[k]);
    } else {
        simd_pair ends = shapes_find_pair(w->bodies[p->a].body.shape, w->bodies[p->b].body.shape,
                                          get_lane3(from->in_a, k), get_lane3(from->in_b, k));
        lower = (from->along.lane[k] - ends.low.value) - ends.high.value - from->radii.lane[k] - from->claim.lane[k];
        if (!(lower > margin)) return 0;
        cache->stage = OVOID_STAGE_PROOF;
        cache->normal = get_lane3(from->n, k);
    }
    cache->lower = lower;
    close_bracket(w, p, cache);
    return 1;
}

static void measure_gaps(revalidation *r) {
    kept_group *g = &r->gaps;
    kept8_gaps found;
    unsigned odd = kept8_get_kernels(g->places.count)->gaps(&g->places, &errors, &found);
    for (uint32_t k = 0; k < g->places.count; k++) {
        const world_pair *p = &r->pairs[g->items[k]];
        take_result(r, g->items[k],
                    odd >> k & 1 ? pair_revalidate(r->w, p, &r->w->pair_cache[p->slot]) : take_gap(r->w, p, &found, k));
    }
    g->places.count = 0;
}

static int take_depth(const ovoid_world *w, const world_pair *p, double upper) {
    pair_cache *cache = &w->pair_cache[p->slot];
    if (!(upper < 0)) return 0;
    cache->upper = upper;
    close_bracket(w, p, cache);
    return 1;
}

static void measure_depths(revalidation *r) {
    kept_group *g = &r->depths;
    lane_column upper;
    unsigned odd = kept8_get_kernels(g->places.count)->depths(&g->places, &errors, &upper);
    for (uint32_t k = 0; k < g->places.count; k++) {
        const world_pair *p = &r->pairs[g->items[k]];
        take_result(r, g->items[k],
                    odd >> k & 1 ? pair_revalidate(r->w, p, &r->w->pair_cache[p->slot])
                                 : take_depth(r->w, p, upper.lane[k]));
    }
    g->places.count = 0;
}

// Sets the places of lane k. The first pair's are those of all lanes, until others take theirs.
static void set_places(const revalidation *r, kept_group *g, const world_pair *p, int is_gap, uint32_t k) {
    const pair_cache *cache = &r->w->pair_cache[p->slot];
    const ovoid_body *a = &r->w->bodies[p->a].body, *b = &r->w->bodies[p->b].body;
    kept8_places *at = &g->places;
    at->pose_a[k] = &a->pose.position.x;
    at->pose_b[k] = &b->pose.position.x;
    at->lengths_a[k] = &a->shape->lower_radius;
    at->lengths_b[k] = &b->shape->lower_radius;
    compiler_prefetch(at->lengths_a[k]);
    compiler_prefetch(at->lengths_b[k]);
    if (is_gap) {
        at->shape_a[k] = &a->shape->radius;
        at->shape_b[k] = &b->shape->radius;
        at->normal[k] = &cache->normal.x;
        return;
    }
    for (int i = 0; i < 4; i++) {
        at->vertex_a[i][k] = shape_vertices(a->shape) + (size_t)3 * cache->of.entry[i][0];
        at->vertex_b[i][k] = shape_vertices(b->shape) + (size_t)3 * cache->of.entry[i][1];
    }
}

static void add_to_group(revalidation *r, kept_group *g, uint16_t item, int is_gap) {
    const world_pair *p = &r->pairs[item];
    uint32_t count = g->places.count++;
    for (uint32_t k = count; k < (count ? count + 1 : PAIR8); k++) set_places(r, g, p, is_gap, k);
    g->items[count] = item;
    if (count + 1 < PAIR8) return;
    if (is_gap)
        measure_gaps(r);
    else
        measure_depths(r);
}

// Shapes far from their frames' origins need more digits, and allowances along an axis a gain.
static int is_common(const ovoid_shape *s) { return !s->has_origin && !shape_has_axis(s); }

static void revalidate(revalidation *r, uint16_t item) {
    const ovoid_world *w = r->w;
    const world_pair *p = &r->pairs[item];
    pair_cache *cache = &w->pair_cache[p->slot];
    measurable what = find_measurable(w, p, cache);
    int is_grouped =
        what != MEASURE_NOTHING && is_common(w->bodies[p->a].body.shape) && is_common(w->bodies[p->b].body.shape);
    if (is_grouped && what == MEASURE_GAP)
        add_to_group(r, &r->gaps, item, 1);
    else if (is_grouped && cache->proof == OVOID_PROOF_HULL && cache->count == 4)
        add_to_group(r, &r->depths, item, 0);
    else
        take_result(r, item, what != MEASURE_NOTHING && pair_revalidate(w, p, cache));
}

// Bodies and cached proofs are scattered in memory: they are prefetched some pairs ahead.
enum { AHEAD = 12 };

uint32_t pairs_revalidate(ovoid_world *w, world_pair *pairs, uint16_t *items, uint32_t count) {
    revalidation r = {.w = w, .pairs = pairs, .open = items};
    r.gaps.places.count = r.depths.places.count = 0;
    for (uint32_t i = 0; i < count && i < AHEAD; i++) step_prefetch_bodies(w, &pairs[items[i]]);
    for (uint32_t i = 0; i < count; i++) {
        if (i + AHEAD < count) step_prefetch_bodies(w, &pairs[items[i + AHEAD]]);
        revalidate(&r, items[i]);
    }
    if (r.gaps.places.count) measure_gaps(&r);
    if (r.depths.places.count) measure_depths(&r);
    return r.open_count;
}
