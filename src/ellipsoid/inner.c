// The maximum-volume inscribed ellipsoid. L. G. Khachiyan and M. J. Todd, On the complexity of approximating the
// maximal inscribed ellipsoid for a polytope, 1993. inscribe.c solves the problem, where the body is about as round as
// a ball; the result is mapped back, rounded, and scaled until it is proven to be inside; certificate.c bounds how much
// larger any other ellipsoid could be, which gives the reported gap.
//
// A solid that is not thin is mapped by its own second moments, its halfspaces are the planes of its facets, and the
// proofs are in doubles. Else, or if these do not reach the gap, the body is mapped so that its outer ellipsoid is
// about the unit ball: needles and slabs are then as round as other bodies. There each facet becomes one halfspace,
// with the normal of its largest triangle and the offset of its lowest vertex, so that the intersection of the
// halfspaces lies in the body; the proofs are in double-double. A flat polygon is solved as a prism over it, whose
// largest ellipsoid is the polygon's, times the height. Cost: some five steps on up to 64 halfspaces, and some ten
// passes over facets and vertices.
#include "ellipsoid/certificate.h"
#include "ellipsoid/closed_fit.h"
#include "ellipsoid/contain.h"
#include "ellipsoid/design.h"
#include "ellipsoid/factor.h"
#include "ellipsoid/fit.h"
#include "ellipsoid/frame.h"
#include "ellipsoid/inscribe.h"
#include "ellipsoid/shrink_to_fit.h"

#include "base/allocator.h"
#include "base/environment.h"
#include "polytope/polygon.h"
#include "polytope/winding.h"

// The solver's gap, as a share of the one to reach: rounding needs the rest.
#define SOLVER_SHARE 0.25

// ---- solids that are not thin

// The root of five times the covariance of the solid, which of an ellipsoid is its own matrix.
static int make_root(const ovoid_measures *m, lower3 *root) {
    double half = sym3_trace(m->inertia) / 2, part = 5 / m->volume;
    sym3 spread = sym3_add(sym3_diagonal(half, half, half), sym3_scale(m->inertia, -1));
    return m->volume > 0 && isfinite(part) && lower3_make_root(sym3_scale(spread, part), root);
}

// The planes of the facets in coordinates z, x = origin + root z.
static void map_planes(const ovoid_polytope *p, vec3 origin, lower3 root, ovoid_plane *planes) {
    for (uint32_t i = 0; i < p->facet_count; i++) {
        const ovoid_plane *plane = &p->planes[i];
        vec3 n = lower3_mul_transposed_vec3(root, plane->normal);
        double part = 1 / vec3_norm(n);
        planes[i] = (ovoid_plane){vec3_scale(n, part), (plane->offset - vec3_dot(plane->normal, origin)) * part};
    }
}

// The ellipsoid { center + map u }.
typedef struct image {
    vec3 center;
    lower3 map;
    int is_of_hull; // the polytope's triangles are the boundary of its hull
} image;

// Rounds an ellipsoid, scales it to fit, and proves it. Returns the factor, 0 if the proof fails; *size: of the factor
// of Q, in roundings.
static double scale_to_fit(const ovoid_polytope *p, const image *of, ovoid_fit *fit, double *size) {
    ovoid_ellipsoid e = {of->center, lower3_square(of->map)};
    double clear = ellipsoid_compute_clear_bound_roughly(p, &e);
    factor f;
    if (!(clear > 0x1p-10 && clear < 2)) return 0;
    e.q = sym3_scale(e.q, clear * clear * (1 - 8 * ROUNDING));
    if (!factor_make_quickly(e.q, &f, size)) return 0;
    if (!(of->is_of_hull && factor_holds_mean(&f, p, e.center)) && polytope_compute_winding(p, e.center) == 0) return 0;
    fit->ellipsoid = e;
    fit->volume =
        f.defect < FACTOR_DEFECT_MOST ? ball_get_measure(3) * factor_get_content(&f) : ellipsoid_compute_measure(&e, 3);
    return clear;
}

// The gap of the ellipsoid that scale_to_fit makes. 0 if the proofs fail or do not show it.
static int prove_quickly(const ovoid_polytope *p, const certificate *c, const image *of, ovoid_fit *fit) {
    double size, clear = scale_to_fit(p, of, fit, &size);
    if (!(clear > 0.5)) return 0;
    // The entries of Q are products of the map's, summed, scaled and rounded: 6 roundings.
    double most = certificate_compute_bound_quickly(c, p, of->center, of->map) * (1 + 16 * ROUNDING * size);
    fit->gap = most / (clear * clear * clear * (1 - 32 * ROUNDING)) - 1;
    return fit->gap >= 0;
}

// The fit in doubles; `planes` has room for the facets'. 0 if the gap is not proven.
static int fit_quickly(const ovoid_polytope *p, const fit_options *options, ovoid_plane *planes, ovoid_fit *fit) {
    lower3 root;
    ovoid_measures computed;
    const ovoid_measures *m = options->measures;
    if (!m) {
        computed = ovoid_polytope_compute_measures(p);
        m = &computed;
    }
    if (!make_root(m, &root)) return 0;
    map_planes(p, m->centroid, root, planes);
    inscribed s = inscribe_solve((halfspace_set){planes, p->facet_count}, SOLVER_SHARE * fmin(options->gap, 1));
    certificate c = {.count = s.count};
    for (int k = 0; k < s.count; k++) c.direction[k] = p->planes[s.item[k]].normal, c.weight[k] = s.weight[k];
    const image of = {vec3_add(m->centroid, lower3_mul_vec3(root, s.x)), lower3_mul(root, s.map),
                      options->measures != NULL};
    *fit = (ovoid_fit){.iterations = s.iterations, .converged = 1};
    return prove_quickly(p, &c, &of, fit) && fit->gap <= options->gap;
}

// ---- any body

// A halfspace by two normals: by the largest triangle of a facet, of that size, and by the plane of the facet.
typedef struct facet_sides {
    ovoid_plane by_triangle, by_plane;
    double size;
} facet_sides;

// The body in coordinates z, x = origin + map z, where it is round.
typedef struct work {
    const ovoid_polytope *polytope;
    double *local; // z of each vertex
    double reach;  // the largest |z| of the body
    vec3 origin;
    mat3 map, inverse;
    double height; // of the prism over a flat polygon, to either side
    vec3 normal;   // of the polygon
    facet_sides *sides;
    ovoid_plane *planes; // the halfspaces
    uint32_t count;
} work;

static mat3 mat3_scale_rows(mat3 m, vec3 s) {
    return (mat3){vec3_scale(m.r0, s.x), vec3_scale(m.r1, s.y), vec3_scale(m.r2, s.z)};
}

// Mean and root of rank times the covariance of the weighted points; the unit matrix if it has none.
static lower3 compute_spread(const design *d, vec3 *mean) {
    *mean = (vec3){0, 0, 0};
    sym3 s = sym3_diagonal(0, d->rank < 2, d->rank < 3);
    lower3 root;
    for (uint32_t i = 0; i < d->count; i++)
        *mean = vec3_add_scaled(*mean, vec3_at(d->local, d->point[i]), d->weight[i]);
    for (uint32_t i = 0; i < d->count; i++)
        s = sym3_add(s, sym3_outer(vec3_sub(vec3_at(d->local, d->point[i]), *mean), d->weight[i]));
    return lower3_make_root(sym3_scale(s, d->rank), &root) ? root : (lower3){1, 0, 1, 0, 0, 1};
}

// The map from the unit ball to a rough outer ellipsoid, and the vertices in its coordinates.
static void whiten(work *w) {
    const ovoid_polytope *p = w->polytope;
    design d = {.rank = p->rank, .point_count = p->vertex_count, .local = w->local};
    frame f = frame_compute(p, p->rank);
    frame_fill_local(&f, p, w->local);
    (void)design_solve(&d, 0.02);
    // The solver has changed the coordinates. x = f.origin + axes' half (mean + root z).
    frame_fill_local(&f, p, w->local);
    vec3 mean;
    lower3 root = compute_spread(&d, &mean), lower = lower3_inverse(root);
    vec3 moved = {mean.x * f.half.x, mean.y * f.half.y, mean.z * f.half.z};
    vec3 part = {1 / f.half.x, 1 / f.half.y, 1 / f.half.z};
    w->origin = vec3_add(f.origin, mat3_mul_transposed_vec3(f.axes, moved));
    w->map = mat3_mul(mat3_transpose(mat3_scale_rows(f.axes, f.half)), lower3_to_mat3(root));
    w->inverse = mat3_mul(lower3_to_mat3(lower), mat3_scale_rows(f.axes, part));
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        vec3 z = lower3_mul_vec3(lower, vec3_sub(vec3_at(w->local, v), mean));
        w->local[3 * (size_t)v] = z.x, w->local[3 * (size_t)v + 1] = z.y, w->local[3 * (size_t)v + 2] = z.z;
        w->reach = fmax(w->reach, vec3_norm(z));
    }
    w->normal = f.axes.r2;
    w->height = p->rank == 2 ? f.half.z * root.zz : 0;
}

// The unit normal in z of a plane with normal n in x.
static vec3 compute_local_normal(const work *w, vec3 n) { return vec3_unit(mat3_mul_transposed_vec3(w->map, n)); }

// Lowers the offset to the corners of triangle t.
static void lower(const work *w, uint32_t t, ovoid_plane *h) {
    for (int k = 0; k < 3; k++) {
        vec3 z = vec3_at(w->local, w->polytope->triangles[3 * (size_t)t + k]);
        h->offset = fmin(h->offset, vec3_dot(h->normal, z));
    }
}

// The halfspaces of a solid: one for each facet that has a triangle, by the exact normal of its largest triangle, or by
// the normal of its plane if the former cuts much deeper, as that of a sliver folded against its neighbours may.
static void build_from_facets(work *w) {
    const ovoid_polytope *p = w->polytope;
    for (uint32_t f = 0; f < p->facet_count; f++) {
        w->sides[f] = (facet_sides){.size = 0};
        w->sides[f].by_plane.normal = compute_local_normal(w, p->planes[f].normal);
        w->sides[f].by_triangle.offset = w->sides[f].by_plane.offset = INFINITY;
    }
    for (uint32_t t = 0; t < p->triangle_count; t++) {
        const uint32_t *i = p->triangles + 3 * (size_t)t;
        facet_sides *s = &w->sides[p->triangle_facets[t]];
        vec3 a = vec3_at(w->local, i[0]), b = vec3_at(w->local, i[1]), d = vec3_at(w->local, i[2]);
        double size = vec3_norm(vec3_cross(vec3_sub(b, a), vec3_sub(d, a)));
        if (!(size > s->size)) continue;
        const vec3 corner[3] = {vec3_at(p->vertices, i[0]), vec3_at(p->vertices, i[1]), vec3_at(p->vertices, i[2])};
        s->size = size;
        s->by_triangle.normal = compute_local_normal(w, triangle_compute_normal(corner));
    }
    for (uint32_t t = 0; t < p->triangle_count; t++) {
        lower(w, t, &w->sides[p->triangle_facets[t]].by_triangle);
        lower(w, t, &w->sides[p->triangle_facets[t]].by_plane);
    }
    w->count = 0;
    for (uint32_t f = 0; f < p->facet_count; f++) {
        const facet_sides *s = &w->sides[f];
        int is_folded = s->by_plane.offset > 1.01 * s->by_triangle.offset;
        if (s->size > 0) w->planes[w->count++] = is_folded ? s->by_plane : s->by_triangle;
    }
}

// The halfspaces of the prism over a flat polygon: one for each edge, and the two ends.
static void build_from_edges(work *w) {
    const ovoid_polytope *p = w->polytope;
    w->count = 0;
    for (uint32_t v = 0; v < p->vertex_count; v++)
        for (uint32_t k = p->neighbor_starts[v]; k < p->neighbor_starts[v + 1]; k++) {
            vec3 a = vec3_at(w->local, v), b = vec3_at(w->local, p->neighbors[k]), e = vec3_sub(b, a);
            vec3 n = vec3_unit((vec3){e.y, -e.x, 0});
            if (vec3_dot(n, a) < 0) n = vec3_neg(n);
            if (p->neighbors[k] > v && vec3_max_abs(n) > 0 && w->count < p->vertex_count)
                w->planes[w->count++] = (ovoid_plane){n, fmin(vec3_dot(n, a), vec3_dot(n, b))};
        }
    w->planes[w->count++] = (ovoid_plane){{0, 0, 1}, 1};
    w->planes[w->count++] = (ovoid_plane){{0, 0, -1}, 1};
    w->reach += 1;
}

// The solver's ellipsoid; a small ball if it could not start.
static inscribed solve(const work *w, double gap) {
    double least = INFINITY;
    for (uint32_t i = 0; i < w->count; i++) least = fmin(least, w->planes[i].offset);
    if (!(least > 0) || !isfinite(least)) return (inscribed){.map = {0.1, 0, 0.1, 0, 0, 0.1}};
    return inscribe_solve((halfspace_set){w->planes, w->count}, SOLVER_SHARE * fmin(gap, 1));
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

// The bound of how much larger than { center + m u } any ellipsoid in the body can be.
static double compute_bound(const work *w, const inscribed *s, vec3 center, mat3 m) {
    certificate c = {.count = s->count};
    for (int k = 0; k < s->count; k++) {
        c.direction[k] = vec3_unit(mat3_mul_transposed_vec3(w->inverse, w->planes[s->item[k]].normal));
        c.weight[k] = s->weight[k];
    }
    // |u| = |L^-1 (z - x)|; a margin for the rounding of z.
    mat3 inverse = lower3_to_mat3(lower3_inverse(s->map));
    double size = sqrt(vec3_norm_squared(inverse.r0) + vec3_norm_squared(inverse.r1) + vec3_norm_squared(inverse.r2));
    inscribed_body body = {.vertices = w->polytope->vertices,
                           .vertex_count = w->polytope->vertex_count,
                           .normal = w->normal,
                           .height = w->height,
                           .center = center,
                           .map = m,
                           .reach = 1.1 * (w->reach + vec3_norm(s->x)) * size};
    return certificate_compute_bound(&c, &body);
}

// Maps the solution back, shrinks it to fit, and bounds the gap to the optimum.
static void fill_fit(const work *w, const inscribed *s, double gap, ovoid_fit *fit) {
    uint32_t rank = w->polytope->rank;
    mat3 m = mat3_mul(w->map, lower3_to_mat3(s->map));
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
    double most = compute_bound(w, s, center, m) * compute_volume_factor(&whole);
    double error, content = sym3dd_compute_content(&reached, (int)rank, &error);
    content *= (1 - fmin(error, 1)) * (rank == 2 ? w->height * unit : 1);
    fit->gap = content > 0 ? most / content - 1 + 8 * ROUNDING : INFINITY;
    fit->converged = fit->gap <= gap;
}

static ovoid_code fit_carefully(const ovoid_polytope *p, const ovoid_allocator *memory, double gap, ovoid_fit *fit) {
    // Halfspaces of a flat polygon: its edges, each from one of its ends, and two.
    uint32_t halfspaces = p->rank == 3 ? p->facet_count : p->vertex_count + 2;
    double *local = allocator_allocate(memory, p->vertex_count, 3 * sizeof(double));
    facet_sides *sides = allocator_allocate(memory, halfspaces, sizeof(facet_sides) + sizeof(ovoid_plane));
    if (local && sides) {
        work w = {.polytope = p, .local = local, .sides = sides, .planes = (ovoid_plane *)(sides + halfspaces)};
        whiten(&w);
        if (p->rank == 3)
            build_from_facets(&w);
        else
            build_from_edges(&w);
        inscribed s = solve(&w, gap);
        fill_fit(&w, &s, gap, fit);
    }
    allocator_release(memory, sides);
    allocator_release(memory, local);
    return local && sides ? OVOID_OK : OVOID_ERROR_MEMORY;
}

static ovoid_code compute(const ovoid_polytope *p, const fit_options *options, ovoid_fit *fit) {
    ovoid_allocator memory = allocator_make(options->allocator);
    double gap = options->gap > 0 ? options->gap : 1e-6;
    closed_form form = fit_find_form(options, p);
    if (closed_fit_inner(&form, gap, fit)) return OVOID_OK;
    if (p->rank == 3) {
        ovoid_plane *planes = allocator_allocate(&memory, p->facet_count, sizeof *planes);
        if (!planes) return OVOID_ERROR_MEMORY;
        fit_options quick = *options;
        quick.gap = gap;
        int done = fit_quickly(p, &quick, planes, fit);
        allocator_release(&memory, planes);
        if (done) return OVOID_OK;
    }
    return fit_carefully(p, &memory, gap, fit);
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

ovoid_code ellipsoid_fit_inner(const ovoid_polytope *polytope, const fit_options *options, ovoid_fit *fit) {
    if (!polytope || !fit || !(options->gap >= 0) || polytope->vertex_count == 0 || polytope->rank > 3)
        return OVOID_ERROR_ARGUMENT;
    if (polytope->rank < 2) {
        *fit = compute_segment(polytope);
        return OVOID_OK;
    }
    return compute(polytope, options, fit);
}

int ellipsoid_fit_moments(const ovoid_polytope *polytope, const ovoid_measures *measures, ovoid_fit *fit) {
    lower3 root;
    double size;
    *fit = (ovoid_fit){.gap = INFINITY};
    return polytope->rank == 3 && make_root(measures, &root) &&
           scale_to_fit(polytope, &(image){measures->centroid, root, 1}, fit, &size) > 0;
}

ovoid_code ovoid_ellipsoid_compute_inner(const ovoid_polytope *polytope, const ovoid_ellipsoid_options *options,
                                         ovoid_fit *fit, ovoid_error *error) {
    fit_options o = {options ? options->gap : 0, NULL, options ? options->allocator : NULL, NULL};
    ENVIRONMENT_RETURN(ovoid_code, o, fit_explain(ellipsoid_fit_inner(polytope, &o, fit), error));
}
