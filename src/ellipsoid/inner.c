// The maximum-volume inscribed ellipsoid. L. G. Khachiyan and M. J. Todd, On the complexity of approximating the
// maximal inscribed ellipsoid for a polytope, 1993; Y. Zhang and L. Gao, On numerical solution of the maximum volume
// ellipsoid problem, 2003.
//
// The body is first mapped so that its outer ellipsoid is about the unit ball: needles and slabs are then as round as
// other bodies. There each facet becomes one halfspace, with the normal of its largest triangle and the offset of its
// lowest vertex, so that the intersection of the halfspaces lies in the body. inscribe.c solves the problem; the result
// is mapped back, rounded, and shrunk until its proof holds (shrink_to_fit.c). certificate.c bounds how much larger any
// other ellipsoid could be, which gives the reported gap. A flat polygon is solved as a prism over it, whose largest
// ellipsoid is the polygon's, times the height. Cost: some 30 iterations on a few hundred halfspaces, and some 15
// passes over facets and vertices.
#include "ellipsoid/certificate.h"
#include "ellipsoid/contain.h"
#include "ellipsoid/design.h"
#include "ellipsoid/factor.h"
#include "ellipsoid/refit.h"
#include "ellipsoid/shrink_to_fit.h"
#include "ellipsoid/working_set.h"

#include "base/allocator.h"
#include "base/environment.h"
#include "polytope/segment.h"

// The body in coordinates z, x = origin + map z, where it is round.
typedef struct work {
    const ovoid_polytope *polytope;
    const fit_start *start; // NULL: none
    double *local;          // z of each vertex
    uint32_t *candidate;    // room for the outer solver
    double reach;           // the largest |z| of the body
    vec3 origin;
    mat3 map, inverse;
    double height; // of the prism over a flat polygon, to either side
    vec3 normal;   // of the polygon
    constraint_set set;
} work;

static mat3 mat3_scale_rows(mat3 m, vec3 s) {
    return (mat3){vec3_scale(m.r0, s.x), vec3_scale(m.r1, s.y), vec3_scale(m.r2, s.z)};
}

// The lower triangular L with L L' = s, and its inverse; the identity if s is not positive definite.
static mat3 compute_root(sym3 s, mat3 *inverse) {
    double a = sqrt(s.xx), b = s.xy / a, c = s.xz / a, d = sqrt(s.yy - b * b), e = (s.yz - b * c) / d;
    double f = sqrt(s.zz - c * c - e * e);
    if (!(a > 0 && d > 0 && f > 0 && isfinite(a * d * f))) a = d = f = 1, b = c = e = 0;
    *inverse = (mat3){{1 / a, 0, 0}, {-b / (a * d), 1 / d, 0}, {(b * e - c * d) / (a * d * f), -e / (d * f), 1 / f}};
    return (mat3){{a, 0, 0}, {b, d, 0}, {c, e, f}};
}

// The map from the unit ball to a rough outer ellipsoid, and the vertices in its coordinates.
static void whiten(work *w) {
    const ovoid_polytope *p = w->polytope;
    design d = {.near = w->start ? &w->start->outer : NULL, .local = w->local, .candidate = w->candidate};
    frame f = frame_compute(p, p->rank);
    design_solve(&d, &f, p, 0.02);
    // x = f.origin + axes' half (mean + root z).
    mat3 lower, root = compute_root(sym3_scale(sym3_inverse(d.inverse), p->rank), &lower);
    vec3 mean = {d.mean.x * f.half.x, d.mean.y * f.half.y, d.mean.z * f.half.z};
    vec3 part = {1 / f.half.x, 1 / f.half.y, 1 / f.half.z};
    w->origin = vec3_add(f.origin, mat3_mul_transposed_vec3(f.axes, mean));
    w->map = mat3_mul(mat3_transpose(mat3_scale_rows(f.axes, f.half)), root);
    w->inverse = mat3_mul(lower, mat3_scale_rows(f.axes, part));
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        vec3 z = mat3_mul_vec3(lower, vec3_sub(vec3_at(d.local, v), d.mean));
        w->local[3 * (size_t)v] = z.x, w->local[3 * (size_t)v + 1] = z.y, w->local[3 * (size_t)v + 2] = z.z;
        w->reach = fmax(w->reach, vec3_norm(z));
    }
    w->normal = f.axes.r2;
    w->height = p->rank == 2 ? f.half.z * root.r2.z : 0;
}

// The unit normal in z of a plane with normal n in x.
static vec3 compute_local_normal(const work *w, vec3 n) { return vec3_unit(mat3_mul_transposed_vec3(w->map, n)); }

// Lowers the offsets b and h to the corners of triangle t along the directions n and w.
static void lower(const work *w, uint32_t t, constraint *c) {
    for (int k = 0; k < 3; k++) {
        vec3 z = vec3_at(w->local, w->polytope->triangles[3 * (size_t)t + k]);
        c->b = fmin(c->b, vec3_dot(c->n, z));
        c->h = fmin(c->h, vec3_dot(c->w, z));
    }
}

// The halfspaces of a solid: one for each facet that has a triangle, by the exact normal of its largest triangle, or by
// the normal of its plane if the former cuts much deeper, as that of a sliver folded against its neighbours may.
static void build_from_facets(work *w) {
    const ovoid_polytope *p = w->polytope;
    for (uint32_t f = 0; f < p->facet_count; f++) w->set.items[f] = (constraint){.y = 0};
    // n: by the largest triangle, whose size is in y; w: by the plane; b and h are their offsets.
    for (uint32_t t = 0; t < p->triangle_count; t++) {
        const uint32_t *i = p->triangles + 3 * (size_t)t;
        constraint *c = &w->set.items[p->triangle_facets[t]];
        vec3 a = vec3_at(w->local, i[0]), b = vec3_at(w->local, i[1]), d = vec3_at(w->local, i[2]);
        double size = vec3_norm(vec3_cross(vec3_sub(b, a), vec3_sub(d, a)));
        if (!(size > c->y)) continue;
        const vec3 corner[3] = {vec3_at(p->vertices, i[0]), vec3_at(p->vertices, i[1]), vec3_at(p->vertices, i[2])};
        c->y = size;
        c->n = compute_local_normal(w, triangle_compute_normal(corner));
    }
    for (uint32_t f = 0; f < p->facet_count; f++) {
        w->set.items[f].w = compute_local_normal(w, p->planes[f].normal);
        w->set.items[f].b = w->set.items[f].h = INFINITY;
    }
    for (uint32_t t = 0; t < p->triangle_count; t++) lower(w, t, &w->set.items[p->triangle_facets[t]]);
    w->set.count = 0;
    for (uint32_t f = 0; f < p->facet_count; f++) {
        constraint c = w->set.items[f];
        if (c.h > 1.01 * c.b) c.b = c.h, c.n = c.w;
        if (c.y > 0) w->set.items[w->set.count++] = c;
    }
}

// The halfspaces of the prism over a flat polygon: one for each edge, and the two ends.
static void build_from_edges(work *w) {
    const ovoid_polytope *p = w->polytope;
    w->set.count = 0;
    for (uint32_t v = 0; v < p->vertex_count; v++)
        for (uint32_t k = p->neighbor_starts[v]; k < p->neighbor_starts[v + 1]; k++) {
            vec3 a = vec3_at(w->local, v), b = vec3_at(w->local, p->neighbors[k]), e = vec3_sub(b, a);
            vec3 n = vec3_unit((vec3){e.y, -e.x, 0});
            if (vec3_dot(n, a) < 0) n = vec3_neg(n);
            if (p->neighbors[k] > v && vec3_max_abs(n) > 0 && w->set.count < p->vertex_count)
                w->set.items[w->set.count++] = (constraint){.n = n, .b = fmin(vec3_dot(n, a), vec3_dot(n, b))};
        }
    w->set.items[w->set.count++] = (constraint){.n = {0, 0, 1}, .b = 1};
    w->set.items[w->set.count++] = (constraint){.n = {0, 0, -1}, .b = 1};
    w->reach += 1;
}

// The first guess: the inner ellipsoid to start from, in the coordinates z, or a small ball.
static inscribed guess(const work *w) {
    const inscribed ball = {.e = sym3_diagonal(0.1, 0.1, 0.1)};
    if (!w->start || w->polytope->rank < 3) return ball;
    eigen3 q = sym3_compute_eigen(sym3_rotate(w->start->inner.q, w->inverse));
    if (!(q.value[0] > 1e-6 && q.value[2] < 1e6)) return ball;
    for (int i = 0; i < 3; i++) q.value[i] = sqrt(q.value[i]);
    vec3 x = mat3_mul_vec3(w->inverse, vec3_sub(w->start->inner.center, w->origin));
    return (inscribed){.e = sym3_from_eigen(q.value, q.v), .x = x};
}

// The solver's ellipsoid; a small ball if it failed or could not start.
static inscribed solve(const work *w, double gap) {
    double least = INFINITY;
    for (uint32_t i = 0; i < w->set.count; i++) least = fmin(least, w->set.items[i].b);
    inscribed s = {.e = sym3_diagonal(0.1, 0.1, 0.1)};
    if (!(least > 0) || !isfinite(least)) return s;
    inscribed first = guess(w);
    inscribed solved = working_set_solve(w->set, &first, fmax(0.02 * fmin(gap, 1), 1e-14));
    vec3 x;
    return vec3_is_finite(solved.x) && sym3_solve(solved.e, (vec3){0, 0, 0}, &x) ? solved : s;
}

// M M', from the columns in whose directions the body has extent.
static sym3dd compute_square(const mat3 *m, uint32_t rank) {
    const double full[3][3] = {{m->r0.x, m->r0.y, m->r0.z}, {m->r1.x, m->r1.y, m->r1.z}, {m->r2.x, m->r2.y, m->r2.z}};
    sym3dd q;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            q.m[i][j] = dd_from(0);
            for (uint32_t k = 0; k < rank; k++) q.m[i][j] = dd_add(q.m[i][j], two_product(full[i][k], full[j][k]));
        }
    return q;
}

// |det m| of entries up to 1, from above: six products in double-double, each within 2^-99.
static double compute_volume_factor(const mat3 *m) {
    dd x[3];
    const double a[3][2] = {{m->r1.y, m->r1.z}, {m->r1.z, m->r1.x}, {m->r1.x, m->r1.y}};
    const double b[3][2] = {{m->r2.z, m->r2.y}, {m->r2.x, m->r2.z}, {m->r2.y, m->r2.x}};
    for (int i = 0; i < 3; i++) x[i] = dd_sub(two_product(a[i][0], b[i][0]), two_product(a[i][1], b[i][1]));
    dd sum = dd_mul(x[0], dd_from(m->r0.x));
    sum = dd_add(sum, dd_mul(x[1], dd_from(m->r0.y)));
    return fabs(dd_add(sum, dd_mul(x[2], dd_from(m->r0.z))).high) * (1 + ROUNDING) + 0x1p-96;
}

// The bound of how much larger than { center + m u } any ellipsoid in the body can be. Halfspaces of weights far below
// the gap are left out: the bound holds for any halfspaces, and loses about the sum of their weights.
static double compute_bound(const work *w, const inscribed *s, vec3 center, mat3 m, double gap) {
    certificate c = {0};
    double total = 0;
    for (uint32_t i = 0; i < w->set.count; i++) total += w->set.items[i].y * w->set.items[i].h;
    for (uint32_t i = 0; i < w->set.count; i++) {
        const constraint *k = &w->set.items[i];
        double weight = k->y * k->h;
        if (weight > 1e-3 * gap * total) certificate_add(&c, i, weight, k->w, (k->b - vec3_dot(k->n, s->x)) / k->h);
    }
    vec3 directions[CERTIFICATE_SIZE];
    for (int i = 0; i < c.count; i++)
        directions[i] = vec3_unit(mat3_mul_transposed_vec3(w->inverse, w->set.items[c.halfspace[i]].n));
    // |u| = |E^-1 (z - x)|; a margin for the rounding of z.
    double least = sym3_compute_eigen(s->e).value[0];
    inscribed_body body = {.vertices = w->polytope->vertices,
                           .vertex_count = w->polytope->vertex_count,
                           .normal = w->normal,
                           .height = w->height,
                           .center = center,
                           .map = m,
                           .reach = 1.1 * (w->reach + vec3_norm(s->x)) / least};
    return certificate_compute_bound(&c, &body, directions);
}

// Maps the solution back, shrinks it to fit, and bounds the gap to the optimum.
static void fill_fit(const work *w, const inscribed *s, double gap, ovoid_fit *fit) {
    uint32_t rank = w->polytope->rank;
    mat3 e = {{s->e.xx, s->e.xy, s->e.xz}, {s->e.xy, s->e.yy, s->e.yz}, {s->e.xz, s->e.yz, s->e.zz}};
    mat3 m = mat3_mul(w->map, e);
    vec3 center = vec3_add(w->origin, mat3_mul_vec3(w->map, s->x));
    // The solution keeps a small distance from the halfspaces; it is enlarged until it meets the first.
    sym3dd q = compute_square(&m, rank);
    ovoid_ellipsoid loose = {center, sym3dd_round(&q)};
    double clear = rank == 3 ? ellipsoid_compute_clear_bound(w->polytope, &loose) : 1, scale = 1;
    if (clear > 1 && clear < 2) scale = clear * clear * (1 - 4 * ROUNDING);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) q.m[i][j] = dd_mul(q.m[i][j], dd_from(scale));
    *fit = (ovoid_fit){.ellipsoid = ellipsoid_shrink_to_fit(w->polytope, center, &q), .iterations = s->iterations};
    fit->volume = ellipsoid_compute_measure(&fit->ellipsoid, rank);
    // The bound is for the ellipsoid of m, for a flat polygon for that of the prism. In units of the body.
    double reach = fmax(vec3_max_abs(m.r0), fmax(vec3_max_abs(m.r1), vec3_max_abs(m.r2)));
    double unit = ldexp(1, -find_unit_exponent(reach));
    mat3 whole = mat3_scale_rows(m, (vec3){unit, unit, unit});
    sym3dd reached = sym3dd_from(sym3_scale(sym3_scale(fit->ellipsoid.q, unit), unit));
    double most = compute_bound(w, s, center, m, gap) * compute_volume_factor(&whole);
    double error, content = sym3dd_compute_content(&reached, (int)rank, &error);
    content *= (1 - fmin(error, 1)) * (rank == 2 ? w->height * unit : 1);
    fit->gap = content > 0 ? most / content - 1 + 8 * ROUNDING : INFINITY;
    fit->converged = fit->gap <= gap;
}

static ovoid_code compute(const ovoid_polytope *p, const fit_options *options, ovoid_fit *fit) {
    ovoid_allocator memory = allocator_make(options->allocator);
    double gap = options->gap > 0 ? options->gap : 1e-6;
    // Halfspaces of a flat polygon: its edges, each from one of its ends, and two.
    uint32_t halfspaces = p->rank == 3 ? p->facet_count : p->vertex_count + 2;
    double *local = allocator_allocate(&memory, p->vertex_count, 3 * sizeof(double) + sizeof(uint32_t));
    constraint *constraints = allocator_allocate(&memory, halfspaces, sizeof(constraint));
    if (local && constraints) {
        uint32_t *candidate = (uint32_t *)(local + 3 * (size_t)p->vertex_count);
        work w = {.polytope = p, .start = options->start, .local = local, .candidate = candidate};
        w.set.items = constraints;
        whiten(&w);
        if (p->rank == 3)
            build_from_facets(&w);
        else
            build_from_edges(&w);
        inscribed s = solve(&w, gap);
        fill_fit(&w, &s, gap, fit);
    }
    allocator_release(&memory, constraints);
    allocator_release(&memory, local);
    return local && constraints ? OVOID_OK : OVOID_ERROR_MEMORY;
}

// The middle of a segment, or the point.
static ovoid_fit compute_segment(const ovoid_polytope *p) {
    uint32_t end[2] = {0, 0};
    if (p->rank == 1) polytope_get_ends(p, end);
    vec3 a = vec3_at(p->vertices, end[0]), b = vec3_at(p->vertices, end[1]);
    vec3 half = vec3_sub(vec3_scale(b, 0.5), vec3_scale(a, 0.5));
    ovoid_ellipsoid e = {vec3_add_scaled(a, half, 1), sym3_outer(half, 1)};
    return (ovoid_fit){.ellipsoid = e, .volume = ellipsoid_compute_measure(&e, p->rank), .converged = 1};
}

ovoid_code ellipsoid_refit_inner(const ovoid_polytope *polytope, const fit_options *options, ovoid_fit *fit) {
    if (!polytope || !fit || !(options->gap >= 0) || polytope->vertex_count == 0 || polytope->rank > 3)
        return OVOID_ERROR_ARGUMENT;
    if (polytope->rank < 2) {
        *fit = compute_segment(polytope);
        return OVOID_OK;
    }
    return compute(polytope, options, fit);
}

ovoid_code ovoid_ellipsoid_compute_inner(const ovoid_polytope *polytope, const ovoid_ellipsoid_options *options,
                                         ovoid_fit *fit, ovoid_error *error) {
    fit_options o = {options ? options->gap : 0, NULL, options ? options->allocator : NULL};
    ENVIRONMENT_RETURN(ovoid_code, o, fit_explain(ellipsoid_refit_inner(polytope, &o, fit), error));
}
