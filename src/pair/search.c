// Bounds and their evidence.
#include "pair/search.h"

#include "pair/hull.h"

int search_is_sign_known(const search *s) { return s->lower > 0 || s->upper < 0; }

int search_is_done(const search *s) {
    if (!s->goal.wants_depth) return query_goal_is_met(&s->goal, s->lower, s->upper);
    if (s->lower > s->goal.far) return 1;
    if (!search_is_sign_known(s) && !query_goal_is_hopeless(&s->goal, s->lower, s->upper)) return 0;
    if (s->upper <= s->goal.near) return 1;
    // A tetrahedron around the origin may bracket a shallow depth well, but its witness is a single common point.
    return s->kind != OVOID_PROOF_HULL && s->goal.wants_bracket && s->upper - s->lower <= s->goal.tolerance;
}

void search_take_gap(search *s, vec3 n, double gap) {
    const pair_frame *f = s->frame;
    double lower = gap - f->lower_radii - f->claim;
    // A direction that underflowed to zero proves nothing.
    if (!(lower > s->lower) || !(vec3_norm_squared(n) > 0.5)) return;
    s->lower = lower;
    s->normal = n;
}

frame_support search_probe(search *s, vec3 n) {
    frame_support found = frame_find_support(s->frame, n);
    search_take_gap(s, n, found.gap);
    return found;
}

// Copies only the entries in use, a small part of the struct.
static void take_evidence(evidence *e, const simplex *points) {
    e->count = points->count;
    for (int i = 0; i < points->count; i++) {
        e->p[i] = points->p[i];
        e->weight[i] = points->weight[i];
    }
}

void search_take_points(search *s, const simplex *points) {
    const pair_frame *f = s->frame;
    double upper = vec3_norm(simplex_compute_point(points)) - f->upper_radii + f->claim;
    if (!(upper < s->upper)) return;
    s->upper = upper;
    s->kind = OVOID_PROOF_POINTS;
    take_evidence(&s->witness, points);
}

evidence evidence_make(const simplex *points) {
    evidence e;
    take_evidence(&e, points);
    return e;
}

void search_take_depth(search *s, const search_depth *depth, const evidence *witness) {
    s->upper = depth->upper;
    s->lower = depth->lower;
    s->normal = depth->normal;
    s->stage = depth->stage;
    s->kind = OVOID_PROOF_COVER;
    s->witness = *witness;
}

int search_take_hull(search *s, const evidence *hull) {
    const pair_frame *f = s->frame;
    vec3 w[OVOID_PROOF_PAIRS];
    double weight[OVOID_PROOF_PAIRS];
    for (int i = 0; i < hull->count; i++) w[i] = hull->p[i].w;
    double depth = hull_find_weights(w, hull->count, f->claim, weight);
    if (!(depth > 0)) return 0;
    double upper = -depth - f->upper_radii;
    if (upper < s->upper) {
        s->upper = upper;
        s->kind = OVOID_PROOF_HULL;
        s->witness = *hull;
        for (int i = 0; i < hull->count; i++) s->witness.weight[i] = weight[i];
    }
    return 1;
}
