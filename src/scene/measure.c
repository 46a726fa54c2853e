// A pair whose bound has run out, before it is asked anew: what proved it last time is measured again at the present
// poses. Of bodies that are apart that is the gap along the kept normal, of bodies that overlap the common point or the
// few differences around the origin. Mostly it still holds, at a tenth of a query's cost.
#include "query/glance.h"
#include "query/hull.h"
#include "query/inner.h"
#include "scene/ask.h"

// A lower bound for a pair that overlaps: what is left of the old one, or what the spheres say.
static double find_lower(const pair_frame *f, const kept *k, double age) {
    vec3 d =
        vec3_add(f->offset, vec3_sub(mat3_mul_vec3(f->world_b, f->b->center), mat3_mul_vec3(f->world, f->a->center)));
    return max2(k->lower - age,
                vec3_norm(d) - (f->a->reach + f->b->reach) - f->radii - FRAME_GLANCE * f->size - 3 * f->hidden);
}

static double measure_hull(const pair_frame *f, const kept *k) {
    vec3 w[OVOID_PROOF_PAIRS];
    for (uint32_t i = 0; i < k->count; i++) w[i] = frame_difference(f, k->of.entry[i][0], k->of.entry[i][1]);
    double depth = k->count ? hull_compute_depth(w, k->count, f->claim) : 0;
    return depth > 0 ? -depth - f->radii : 0;
}

static int measure_overlap(pair_frame *f, kept *k, double age) {
    frame_relate(f);
    double upper = k->proof == OVOID_PROOF_INNER  ? inner_compute_upper(f, k->of.inner)
                   : k->proof == OVOID_PROOF_HULL ? measure_hull(f, k)
                                                  : 0;
    if (!(upper < 0)) return 0;
    k->lower = find_lower(f, k, age);
    k->upper = upper;
    return 1;
}

static int measure_gap(const pair_frame *f, kept *k, double margin, double age) {
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
    k->upper += age;
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
    double age = pair_compute_age(w, p, k);
    if (!(is_apart ? measure_gap(&f, k, w->margin, age) : measure_overlap(&f, k, age))) return 0;
    k->limit = OVOID_LIMIT_ANSWERED;
    k->iterations = 0;
    if (is_overlap) k->stage = OVOID_STAGE_PROOF;
    return 1;
}
