// A compound between two ellipsoids: one around all parts, and the largest one inside a part.
//
// Outer: the Loewner-John ellipsoid E of the parts' vertices (ellipsoid/outer.c), enlarged by a radius r that includes
// the rounding radii and the errors of the computed vertices. For any s > 0, with h = sqrt(n' Q n),
//     (h + r)^2 = h^2 + 2 h r + r^2 <= h^2 + h^2 r / s + r s + r^2 = n' ((1 + r / s) Q + r (r + s) I) n,
// so the ellipsoid of the matrix on the right encloses E and the ball of radius r around each of its points. The best s
// is about the ellipsoid's mean radius. If radii differ, r is the least of them; for a larger radius the corners of a
// cube around each vertex, which contains the rest of the ball, are added.
// Inner: a shape's inner ellipsoid under its pose, reduced by the rounding errors of centre and matrix.
#include "compound/compound.h"

#include "base/allocator.h"
#include "ellipsoid/fit.h"
#include "linear/rotation.h"
#include "polytope/hull.h"

// The error of a posed vertex, its radius and a centre; compound.h.
static double find_error(const ovoid_compound *c) { return 64 * 0x1p-53 * c->extent + OVOID_LENGTH_MIN; }

static double find_least_radius(const ovoid_posed_shape *parts, uint32_t count) {
    double least = INFINITY;
    for (uint32_t i = 0; i < count; i++) least = min2(least, parts[i].shape->lower_radius);
    return least;
}

// Writes points whose hull, enlarged by the least radius, contains all parts; returns their number. to NULL: only
// counts.
static size_t write_points(const ovoid_posed_shape *parts, uint32_t count, const parts_vertices *all, double *to) {
    double least = find_least_radius(parts, count);
    size_t at = 0;
    for (uint32_t i = 0; i < count; i++) {
        double rest = parts[i].shape->lower_radius - least;
        for (size_t k = all->starts[i]; k < all->starts[i + 1]; k++)
            for (int corner = 0; corner < (rest > 0 ? 8 : 1); corner++, at++) {
                if (!to) continue;
                vec3 v = vec3_at(all->xyz, k);
                to[3 * at] = v.x + (corner & 1 ? rest : -rest);
                to[3 * at + 1] = v.y + (corner & 2 ? rest : -rest);
                to[3 * at + 2] = v.z + (corner & 4 ? rest : -rest);
            }
    }
    return at;
}

// A support computed in doubles is off by 12 u of the trace under its root.
ovoid_ellipsoid ellipsoid_enlarge(ovoid_ellipsoid e, double r) {
    double s = sqrt(max2(sym3_trace(e.q), 0) / 3), mean = max2(s, r);
    if (!(mean > 0)) return e;
    double more = r * (r + mean), slack = 64 * 0x1p-53 * (sym3_trace(e.q) + more);
    e.q = sym3_add(sym3_scale(e.q, 1 + r / mean), sym3_diagonal(more + slack, more + slack, more + slack));
    return e;
}

// 1: done. 0: no memory. -1: the points have no hull.
static int fit_outer(ovoid_compound *c, const double *points, size_t count, double radius) {
    hull body_hull;
    ovoid_code code = hull_create((xyz_points){points, count}, &c->allocator, &body_hull, NULL);
    if (code != OVOID_OK) return code == OVOID_ERROR_MEMORY ? 0 : -1;
    ovoid_polytope polytope = hull_get_polytope(&body_hull);
    ovoid_fit fit;
    code = ellipsoid_fit_outer(&polytope, &(fit_options){1e-4, NULL, &c->allocator, &body_hull.form}, &fit);
    if (code == OVOID_OK) {
        c->outer = ellipsoid_enlarge(fit.ellipsoid, radius);
        c->outer.center = vec3_add(fit.ellipsoid.center, polytope.origin);
    }
    hull_destroy(&body_hull, &c->allocator);
    return code == OVOID_OK;
}

static int compute_outer(ovoid_compound *c, const ovoid_posed_shape *parts, const parts_vertices *all) {
    size_t count = write_points(parts, c->count, all, NULL);
    double radius = find_least_radius(parts, c->count) + find_error(c);
    double *points = allocator_allocate(&c->allocator, count, 3 * sizeof(double));
    if (!points) return 0;
    (void)write_points(parts, c->count, all, points);
    int done = fit_outer(c, points, count, radius);
    allocator_release(&c->allocator, points);
    // If there are too many points, or near the largest length, the sphere of the tree's root is used.
    if (done < 0) {
        double square = c->nodes->radius * c->nodes->radius * (1 + 4 * 0x1p-53);
        c->outer = (ovoid_ellipsoid){c->nodes->center, sym3_diagonal(square, square, square)};
    }
    return done != 0;
}

// A part's inner ellipsoid in the compound's frame, shrunk to stay in the part; Q is zero if the errors leave nothing.
static ovoid_ellipsoid pose_inner(const ovoid_compound *c, const ovoid_posed_shape *part) {
    const ovoid_shape *shape = part->shape;
    mat3 r = quat_to_mat3(part->pose.rotation);
    ovoid_ellipsoid e = {vec3_add(part->pose.position, mat3_mul_vec3(r, vec3_add(shape->inner.center, shape->origin))),
                         {0, 0, 0, 0, 0, 0}};
    double least = shape->inside.least, trace = sym3_trace(shape->inner.q);
    if (shape->rank < 3 || !(least > 0)) return e;
    // Errors of the centre, and of n' Q n, 128 u of the trace, relative to the least radius.
    double keep = 1 - find_error(c) / least - 128 * 0x1p-53 * (trace / (least * least));
    if (keep > 0) e.q = sym3_scale(sym3_rotate(shape->inner.q, r), keep * keep * (1 - 8 * 0x1p-53));
    return e;
}

static void find_inner(ovoid_compound *c, const ovoid_posed_shape *parts) {
    double most = -1;
    for (uint32_t i = 0; i < c->count; i++) {
        const ovoid_shape *shape = parts[i].shape;
        double volume = shape->rank < 3 ? 0 : shape->inner_fit.volume;
        if (!(volume > most)) continue;
        most = volume;
        c->inner = pose_inner(c, &parts[i]);
    }
}

int compound_compute_bounds(ovoid_compound *c, const ovoid_posed_shape *parts, const parts_vertices *all) {
    find_inner(c, parts);
    return compute_outer(c, parts, all);
}
