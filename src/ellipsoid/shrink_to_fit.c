// Rounding a candidate to doubles and shrinking it until contain.c proves it inside.
#include "ellipsoid/shrink_to_fit.h"

#include "ellipsoid/contain.h"
#include "polytope/winding.h"

double ellipsoid_compute_measure(const ovoid_ellipsoid *ellipsoid, uint32_t rank) {
    if (rank == 0) return 0;
    sym3dd q = sym3dd_from(ellipsoid->q);
    return ball_get_measure((int)rank) * sym3dd_compute_content(&q, (int)rank, NULL);
}

static sym3 round_scaled(const sym3dd *q, double scale) {
    sym3dd s;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) s.m[i][j] = dd_mul(q->m[i][j], dd_from(scale));
    return sym3dd_round(&s);
}

// Shrinks the ellipsoid until it crosses no triangle. 0 if Q is not positive definite after rounding, or would lose
// half its size.
static int shrink(const ovoid_polytope *polytope, const sym3dd *q, ovoid_ellipsoid *e) {
    double scale = 1;
    factor f;
    for (int trial = 0; trial < 44; trial++) {
        e->q = round_scaled(q, scale);
        if (!factor_make(e->q, &f) || f.count < 3) return 0;
        double clear = ellipsoid_compute_clear_bound(polytope, e);
        if (clear >= 1) return 1;
        if (!(clear > 0.5)) return 0;
        scale *= clear * clear * (1 - ldexp(ROUNDING, 1 + trial));
    }
    return 0;
}

// For candidates whose thin axes were destroyed by rounding: cuts the radii to smaller and smaller bounds, down to a
// ball, and takes the largest ellipsoid that is proven.
static int shorten(const ovoid_polytope *polytope, ovoid_ellipsoid *e) {
    eigen3 axes = sym3_compute_eigen(e->q);
    double best = 0, cut = axes.value[2];
    for (int step = 0; step < 40 && cut > 0; step++, cut /= 16) {
        double value[3];
        for (int i = 0; i < 3; i++) value[i] = fmin(fmax(axes.value[i], 0x1p-52 * cut), cut);
        ovoid_ellipsoid shortened = {e->center, sym3_from_eigen(value, axes.v)};
        double clear = ellipsoid_compute_clear_bound(polytope, &shortened);
        if (!(clear > 0)) continue;
        sym3dd q = sym3dd_from(sym3_scale(shortened.q, fmin(clear * clear, 1)));
        if (!shrink(polytope, &q, &shortened)) continue;
        double volume = ellipsoid_compute_measure(&shortened, 3);
        if (volume > best) best = volume, e->q = shortened.q;
    }
    return best > 0;
}

ovoid_ellipsoid ellipsoid_shrink_to_fit(const ovoid_polytope *polytope, ovoid_vec3 center, const sym3dd *q) {
    ovoid_ellipsoid e = {center, sym3dd_round(q)};
    if (polytope->rank < 3) return e;
    if (polytope_compute_winding(polytope, center) != 0) {
        if (shrink(polytope, q, &e)) return e;
        e.q = sym3dd_round(q);
        if (shorten(polytope, &e)) return e;
    }
    return (ovoid_ellipsoid){vec3_at(polytope->vertices, 0), {0, 0, 0, 0, 0, 0}};
}
