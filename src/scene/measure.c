// A pair whose bound has run out, before it is asked anew: what proved it last time is measured again at the present
// poses. Of bodies that are apart that is the gap along the kept normal, of bodies that overlap the common point or the
// few differences around the origin. Mostly it still holds, at a tenth of a query's cost.
#include "query/glance.h"
#include "query/hull.h"
#include "query/inner.h"
#include "scene/ask.h"

static double measure_hull(const pair_frame *f, const kept *k) {
    vec3 w[OVOID_PROOF_PAIRS];
    for (uint32_t i = 0; i < k->count; i++) w[i] = frame_difference(f, k->of.entry[i][0], k->of.entry[i][1]);
    double depth = k->count ? hull_compute_depth(w, k->count, f->claim) : 0;
    return depth > 0 ? -depth - f->radii : 0;
}

// A common point of the inner ellipsoids: the kept one, which is fixed in A, or the one that is best now.
static double measure_inner(const pair_frame *f, kept *k) {
    double upper = inner_compute_upper(f, k->of.inner);
    vec3 x;
    double other = inner_find_common(f, &x) ? inner_compute_upper(f, x) : 0;
    if (!(other < upper)) return upper;
    k->of.inner = x;
    return other;
}

static int measure_overlap(pair_frame *f, kept *k) {
    frame_relate(f);
    double upper = 0;
    if (k->proof == OVOID_PROOF_INNER) upper = measure_inner(f, k);
    if (k->proof == OVOID_PROOF_HULL) upper = measure_hull(f, k);
    if (!(upper < 0)) return 0;
    k->upper = upper;
    return 1;
}

static int measure_gap(const pair_frame *f, kept *k, double margin) {
    glance found;
    ovoid_proof earlier;
    if (glance_at_spheres(f, margin, &found)) {
        k->stage = OVOID_STAGE_SPHERE;
    } else {
        earlier.normal = k->normal;
        if (!glance_at_proof(f, margin, &earlier, &found)) return 0;
        k->stage = OVOID_STAGE_PROOF;
    }
    k->normal = found.normal;
    k->lower = found.lower;
    return 1;
}

int pair_measure(const ovoid_world *w, const world_pair *p, kept *k) {
    const world_body *a = &w->bodies[p->a], *b = &w->bodies[p->b];
    int is_apart = k->status == OVOID_SEPARATED && k->lower > w->margin;
    int is_overlap = k->status == OVOID_OVERLAPPING && !world_is_measuring(w);
    if (!(is_apart || is_overlap) || a->solid.compound || b->solid.compound) return 0;
    ovoid_pair both = {a->solid.shape, b->solid.shape, a->solid.pose, b->solid.pose};
    pair_frame f;
    if (frame_place(&both, &f) != OVOID_LIMIT_NONE) return 0;
    if (!(is_apart ? measure_gap(&f, k, w->margin) : measure_overlap(&f, k))) return 0;
    // The other side of the bracket is what the spheres say.
    double d = vec3_norm(vec3_sub(w->places[p->b].at, w->places[p->a].at)), blur = a->blur + b->blur;
    double reach = ((a->reach + b->reach) + (a->radius + b->radius)) * (1 + 0x1p-48) + blur;
    if (is_apart)
        k->upper = (d + reach) * (1 + 0x1p-48);
    else
        k->lower = d * (1 - 0x1p-48) - reach;
    k->limit = OVOID_LIMIT_ANSWERED;
    k->iterations = 0;
    if (is_overlap) k->stage = OVOID_STAGE_PROOF;
    return 1;
}
