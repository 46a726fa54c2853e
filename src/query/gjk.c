// E. G. Gilbert, D. W. Johnson, S. S. Keerthi, A fast procedure for computing the distance between complex objects in
// three-dimensional space, 1988. The simplex's nearest point bounds the distance from above, the gap along its
// direction from below; each step adds the vertex pair that the gap was measured at. On polytopes the steps are finite,
// and the stop is by the bracket, never by a tolerance on progress.
#include "query/gjk.h"

static int is_known(const simplex *x, const frame_support *p) {
    for (int i = 0; i < x->count; i++)
        if (x->p[i].a == p->a && x->p[i].b == p->b) return 1;
    return 0;
}

// Answered with the direction at hand: a bracket that is asked for is taken along the witness points' own direction,
// so that points, normal and distance agree.
static int is_answered(search *s, vec3 n, double gap) {
    double lower = gap - s->frame->radii - s->frame->claim;
    if (!search_is_done(s)) return 0;
    if (s->lower > s->ask.far || !s->ask.wants_bracket || s->upper <= s->ask.near) return 1;
    if (s->upper - lower > s->ask.tolerance) return 0;
    s->lower = lower;
    s->normal = n;
    return 1;
}

gjk_end gjk_run(search *s, simplex *x) {
    const pair_frame *f = s->frame;
    double last = INFINITY;
    for (; s->iterations < s->ask.iterations; s->iterations++) {
        // From above: the simplex's nearest point.
        vec3 n = simplex_reduce(x);
        if (vec3_norm_squared(n) == 0) {
            s->stage = OVOID_STAGE_GJK;
            evidence inside = evidence_make(x);
            if (x->count < 4 || !search_take_hull(s, &inside)) search_take_points(s, x);
            return search_is_done(s) ? GJK_ANSWERED : GJK_CONTACT;
        }
        double upper = s->upper, lower = s->lower;
        search_take_points(s, x);
        if (s->upper < upper) s->stage = OVOID_STAGE_GJK;
        if (search_is_done(s) && !s->ask.wants_bracket) return GJK_ANSWERED;
        double distance = vec3_norm(simplex_compute_point(x));
        if (distance <= f->claim) return GJK_CONTACT;
        if (!(distance < last)) return search_is_done(s) ? GJK_ANSWERED : GJK_STALLED;
        last = distance;
        // From below: the gap along its direction.
        frame_support p = search_probe(s, n);
        if (s->lower > lower) s->stage = OVOID_STAGE_GJK;
        if (is_answered(s, n, p.gap)) return GJK_ANSWERED;
        if (is_known(x, &p)) return search_is_done(s) ? GJK_ANSWERED : GJK_STALLED;
        x->p[x->count++] = (difference){p.w, p.a, p.b};
    }
    return GJK_ITERATIONS;
}
