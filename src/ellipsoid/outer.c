// The Loewner-John ellipsoid, step (a) of Su, Liu, Chen. Weights come from design.c; the returned ellipsoid and its
// promises are computed from them and the vertices alone, in double-double:
//
// Let k be the rank, c and S the weighted mean and covariance of the vertices. Any ellipsoid with matrix Q that
// contains all vertices has, by the inequality of the means, det Q >= det k S: a lower bound of the volume for any
// weights. And Q = t k S contains all of them once t is the largest (v - c)' (k S)^-1 (v - c). So the reported gap,
// sqrt(det Q / det k S) - 1 for the Q that is returned, is true. docs/ellipsoid.md has the proofs.
//
// Q is stored in six doubles. Rounding it moves a thin axis; for a body thinner than 1e-8 of its length and not along
// the axes, nothing of the thickness is left. So the check of contain.c is repeated on the stored Q, which is scaled up
// until the check holds; if it is too flat to be factored, every axis is lengthened a little first.
#include "ellipsoid/closed_fit.h"
#include "ellipsoid/contain.h"
#include "ellipsoid/design.h"
#include "ellipsoid/factor.h"
#include "ellipsoid/fit.h"
#include "ellipsoid/frame.h"
#include "ellipsoid/root.h"

#include "base/allocator.h"
#include "base/environment.h"

#include <string.h>

// Centre, rounded, and covariance of the weighted vertices about their true mean.
typedef struct moments {
    vec3 center;
    int exponent; // of the unit of `covariance`: lengths times 2^-exponent
    sym3dd covariance;
    int fixed[3]; // all vertices have the same coordinate
} moments;

// The power of two that brings the differences of the vertices to about 1, and the axes along which all differences are
// zero.
static void find_unit(const double *vertices, uint32_t count, moments *m) {
    double extent = 0;
    for (size_t i = 0; i < 3 * (size_t)count; i++) extent = fmax(extent, fabs(vertices[i] - vertices[i % 3]));
    m->exponent = find_unit_exponent(extent);
    for (int k = 0; k < 3; k++) m->fixed[k] = 1;
    for (size_t i = 0; i < 3 * (size_t)count; i++) m->fixed[i % 3] &= vertices[i] == vertices[i % 3];
}

static moments compute_moments(const design *d, const double *vertices, uint32_t count) {
    moments m;
    find_unit(vertices, count, &m);
    dd total = dd_from(0), mean[3] = {{0, 0}, {0, 0}, {0, 0}};
    double unit = ldexp(1, -m.exponent), center[3];
    for (uint32_t i = 0; i < d->count; i++) {
        total = dd_add(total, dd_from(d->weight[i]));
        for (int k = 0; k < 3; k++)
            mean[k] = dd_add(mean[k], two_product(d->weight[i], vertices[3 * (size_t)d->point[i] + k] * unit));
    }
    for (int k = 0; k < 3; k++) center[k] = m.fixed[k] ? vertices[k] : dd_div(mean[k], total).high / unit;
    m.center = vec3_at(center, 0);
    // Relative to the rounded centre, minus its rounding error.
    dd sum[3][3] = {{{0, 0}}}, rest[3] = {{0, 0}, {0, 0}, {0, 0}};
    for (uint32_t i = 0; i < d->count; i++) {
        dd x[3], w = dd_from(d->weight[i]);
        for (int k = 0; k < 3; k++) x[k] = two_sum(vertices[3 * (size_t)d->point[i] + k] * unit, -center[k] * unit);
        for (int k = 0; k < 3; k++) {
            dd wx = dd_mul(w, x[k]);
            rest[k] = dd_add(rest[k], wx);
            for (int n = 0; n <= k; n++) sum[k][n] = dd_add(sum[k][n], dd_mul(wx, x[n]));
        }
    }
    for (int k = 0; k < 3; k++)
        for (int n = 0; n <= k; n++) {
            dd out = dd_mul(dd_div(rest[k], total), dd_div(rest[n], total));
            m.covariance.m[k][n] = m.covariance.m[n][k] = dd_sub(dd_div(sum[k][n], total), out);
        }
    return m;
}

// How a matrix becomes six doubles: entry by entry, or all together (round.c); with a thickness added first.
typedef struct rounding {
    int is_plain;
    double thickness;
} rounding;

// The matrix scale S, rounded, with the thickness added on the axes along which the vertices differ.
static sym3 combine(const moments *m, double scale, const rounding *by) {
    sym3dd q;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            q.m[i][j] = dd_mul(m->covariance.m[i][j], dd_from(scale));
            if (i == j && !m->fixed[i]) q.m[i][i] = dd_add(q.m[i][i], dd_from(by->thickness));
        }
    return by->is_plain ? sym3dd_truncate(&q) : sym3dd_round(&q);
}

// An ellipsoid with the form of the covariance that is proven to enclose the vertices, by trials from a given
// thickness; in units of S.
static sym3 enclose(const ovoid_polytope *polytope, const moments *m, double rank, rounding by) {
    sym3 q = {0, 0, 0, 0, 0, 0};
    double scale = rank, unit = ldexp(1, m->exponent), slack = ROUNDING;
    for (int trial = 0; trial < 120; trial++) {
        q = combine(m, scale, &by);
        ovoid_ellipsoid e = {m->center, sym3_scale(sym3_scale(q, unit), unit)};
        double bound = ellipsoid_compute_enclosing_bound(polytope, &e);
        if (bound <= 1) break;
        // The ellipsoid is too small, or too thin since rounding destroyed its thickness.
        if (bound <= 2) {
            scale *= bound * (1 + slack);
            slack *= 2;
        } else
            by.thickness = fmax(2 * by.thickness, ROUNDING);
    }
    return q;
}

static void fill_fit(const ovoid_polytope *polytope, const design *d, double gap, ovoid_fit *fit) {
    uint32_t rank = d->rank;
    moments m = compute_moments(d, polytope->vertices, polytope->vertex_count);
    double unit = ldexp(1, m.exponent), measure = ball_get_measure((int)rank), best = INFINITY;
    // Covariances of up to 256 points are true to 2^-92 of the diagonal.
    double least_error, error, least = sym3dd_compute_content(&m.covariance, (int)rank, &least_error);
    least *= sqrt(rank == 3 ? 27 : rank == 2 ? 4 : 1) * (1 - fmin(least_error, 1));
    *fit = (ovoid_fit){.ellipsoid.center = m.center, .iterations = d->steps, .gap = INFINITY};
    // If rounding affects thin axes, a little thickness added beforehand may cost less than a larger scale afterwards.
    // A flat body has no thickness that could be lost: unless it is a needle too, a plain rounding is good enough, and
    // costs a hundredth.
    for (int i = rank < 3 ? -1 : 0; i < 5 && !fit->converged; i++) {
        const rounding by = {i < 0, i ? ldexp(ROUNDING, i < 0 ? 0 : i - 2) : 0};
        sym3 q = enclose(polytope, &m, rank, by);
        sym3dd q2 = sym3dd_from(q);
        double content = sym3dd_compute_content(&q2, (int)rank, &error);
        if (!(content < best)) continue;
        best = content;
        fit->ellipsoid.q = sym3_scale(sym3_scale(q, unit), unit);
        fit->volume = measure * ldexp(content, (int)rank * m.exponent);
        if (least > 0) fit->gap = content * (1 + error) / least - 1 + 4 * ROUNDING;
        fit->converged = fit->gap <= gap;
    }
}

// ---- solids that are not thin

// The fit in doubles from the weights of the design. 0 if the gap is not proven. docs/error-analysis.md has the bounds.
static int fit_quickly(const ovoid_polytope *p, const design *d, double gap, ovoid_fit *fit) {
    // The mean, relative to vertex 0, and three times the covariance about the centre that is stored.
    vec3 first = vec3_at(p->vertices, 0), mean = {0, 0, 0};
    double total = 0, extent = 0;
    for (uint32_t i = 0; i < d->count; i++) {
        vec3 x = vec3_sub(vec3_at(p->vertices, d->point[i]), first);
        total += d->weight[i];
        mean = vec3_add_scaled(mean, x, d->weight[i]);
        extent = max2(extent, vec3_max_abs(x));
    }
    vec3 center = vec3_add(first, vec3_scale(mean, 1 / total));
    sym3 q = {0, 0, 0, 0, 0, 0};
    for (uint32_t i = 0; i < d->count; i++)
        q = sym3_add(q, sym3_outer(vec3_sub(vec3_at(p->vertices, d->point[i]), center), 3 * (d->weight[i] / total)));
    factor f;
    double size;
    if (!factor_make_quickly(q, &f, &size)) return 0;
    // Scaled until it encloses, with room for rounding the entries.
    double scale = factor_compute_enclosing_bound(&f, p, center) * (1 + 16 * ROUNDING * size);
    // The stored centre is off the mean: in the metric of the covariance by `off` at most.
    double norm = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) norm += f.w[i][j] * f.w[i][j];
    double off = ((d->count + 8) * extent + 2 * vec3_max_abs(center)) * ROUNDING * sqrt(9 * norm);
    double error = 2 * (d->count + 16) * ROUNDING * size + off * off;
    fit->ellipsoid = (ovoid_ellipsoid){center, sym3_scale(q, scale)};
    sym3dd stored = sym3dd_from(fit->ellipsoid.q);
    double content = f.defect < FACTOR_DEFECT_MOST ? scale * sqrt(scale) * factor_get_content(&f)
                                                   : sym3dd_compute_content(&stored, 3, NULL);
    fit->volume = ball_get_measure(3) * content;
    fit->gap = scale * sqrt(scale) * (1 + 4 * error) - 1;
    fit->iterations = d->steps;
    fit->converged = fit->gap <= gap && fit->gap >= 0;
    return fit->converged;
}

// ---- any body

// The design of the vertices as they are; if they are too thin for that, in a frame in which they are round.
static void compute(const ovoid_polytope *p, design *d, double gap, ovoid_fit *fit) {
    // An excess of x makes a volume of about 1 + x (rank + 1) / 2; rounding and the last trials need the rest.
    double excess = 0.5 * fmin(gap, 1) / (d->rank + 1);
    *fit = (ovoid_fit){0};
    if (d->rank == 3) {
        memcpy(d->local, p->vertices, p->vertex_count * 3 * sizeof(double));
        if (design_solve(d, excess) && fit_quickly(p, d, gap, fit)) return;
    }
    frame f = frame_compute(p, d->rank);
    frame_fill_local(&f, p, d->local);
    (void)design_solve(d, excess);
    fill_fit(p, d, gap, fit);
}

ovoid_code ellipsoid_fit_outer(const ovoid_polytope *polytope, const fit_options *options, ovoid_fit *fit) {
    double gap = options->gap;
    if (!polytope || !fit || !(gap >= 0) || polytope->vertex_count == 0 || polytope->rank > 3)
        return OVOID_ERROR_ARGUMENT;
    if (gap == 0) gap = 1e-6;
    uint32_t count = polytope->vertex_count, rank = polytope->rank > 0 || count == 1 ? polytope->rank : 1;
    if (rank == 0) {
        *fit = (ovoid_fit){.ellipsoid.center = vec3_at(polytope->vertices, 0), .converged = 1};
        return OVOID_OK;
    }
    closed_form form = fit_find_form(options, polytope);
    if (closed_fit_outer(&form, gap, fit)) return OVOID_OK;
    ovoid_allocator memory = allocator_make(options->allocator);
    double *local = allocator_allocate(&memory, count, 3 * sizeof(double));
    if (!local) return OVOID_ERROR_MEMORY;
    compute(polytope, &(design){.rank = rank, .point_count = count, .local = local}, gap, fit);
    allocator_release(&memory, local);
    return OVOID_OK;
}

ovoid_code ovoid_ellipsoid_compute_outer(const ovoid_polytope *polytope, const ovoid_ellipsoid_options *options,
                                         ovoid_fit *fit, ovoid_error *error) {
    fit_options o = {options ? options->gap : 0, NULL, options ? options->allocator : NULL, NULL};
    ENVIRONMENT_RETURN(ovoid_code, o, fit_explain(ellipsoid_fit_outer(polytope, &o, fit), error));
}
