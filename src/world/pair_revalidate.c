// A pair whose kept bounds no longer answer the query: before it is queried again, its cached proof is measured at the
// present poses. For bodies that are apart this is the gap along the cached normal, for bodies that overlap the common
// point or the few differences around the origin. Mostly it still holds, at a tenth of a query's cost.
#include "pair/hull.h"
#include "pair/inner.h"
#include "pair/reject.h"
#include "world/pair_update.h"

static double measure_hull(const pair_frame *f, const pair_cache *cache) {
    vec3 w[OVOID_PROOF_PAIRS];
    for (uint32_t i = 0; i < cache->count; i++)
        w[i] = frame_difference(f, cache->of.entry[i][0], cache->of.entry[i][1]);
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
    frame_relate(f);
    double upper = 0;
    if (cache->proof == OVOID_PROOF_INNER) upper = measure_inner(f, cache);
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

int pair_revalidate(const ovoid_world *w, const world_pair *p, pair_cache *cache) {
    const world_body *a = &w->bodies[p->a], *b = &w->bodies[p->b];
    double margin = w->margin + world_get_pair_range(w, p->a, p->b);
    int is_apart = cache->status == OVOID_SEPARATED && cache->lower > margin;
    int is_overlap = cache->status == OVOID_OVERLAPPING && !world_is_measuring(w);
    if (!(is_apart || is_overlap) || !a->body.shape || !b->body.shape) return 0;
    ovoid_pair both = {a->body.shape, b->body.shape, a->body.pose, b->body.pose};
    pair_frame f;
    if (frame_place(&both, &f) != OVOID_LIMIT_NONE) return 0;
    if (!(is_apart ? measure_gap(&f, cache, margin) : measure_overlap(&f, cache))) return 0;
    // The other bound comes from the spheres.
    double d = vec3_norm(vec3_sub(w->places[p->b].at, w->places[p->a].at)),
           center_error = a->center_error + b->center_error;
    double reach = ((a->reach + b->reach) + (a->radius + b->radius)) * (1 + 0x1p-48) + center_error;
    if (is_apart)
        cache->upper = (d + reach) * (1 + 0x1p-48);
    else
        cache->lower = d * (1 - 0x1p-48) - reach;
    cache->limit = OVOID_LIMIT_ANSWERED;
    cache->iterations = 0;
    if (is_overlap) cache->stage = OVOID_STAGE_PROOF;
    return 1;
}
