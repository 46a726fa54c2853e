// From points to a shape: the hull, the ellipsoids, one block.
#include "shape/create.h"

#include "base/allocator.h"
#include "base/arena.h"
#include "base/environment.h"
#include "base/error.h"
#include "ellipsoid/contain.h"
#include "ellipsoid/factor.h"
#include "ellipsoid/fit.h"
#include "ellipsoid/halfspaces.h"
#include "linear/vec3.h"
#include "polytope/hull.h"
#include "shape/block.h"
#include "shape/floats.h"
#include "shape/gauss_map.h"
#include "shape/loops.h"

#include <string.h>

int shape_tolerance_is_length(double tolerance, ovoid_error *error) {
    if (tolerance >= 0) return 1;
    error_write(error, OVOID_ERROR_ARGUMENT, -1, "the tolerance %g is not a length >= 0", tolerance);
    return 0;
}

int allowance_is_normal(const ovoid_allowance *allowance) {
    if (!(vec3_max_abs(allowance->axis) > 0)) return 1;
    return allowance->outside > 0 && fabs(vec3_norm_squared(allowance->axis) - 1) <= 8 * 0x1p-53;
}

// The axis as a shape stores it: none, or of length 1. An axis that a shape stores already is not changed.
static vec3 make_axis(const ovoid_allowance *allowance) {
    if (!(allowance->outside > 0)) return (vec3){0, 0, 0};
    return allowance_is_normal(allowance) ? allowance->axis : vec3_unit(allowance->axis);
}

ovoid_code shape_options_make(const ovoid_shape_options *given, ovoid_shape_options *o, ovoid_error *error) {
    *o = given ? *given : (ovoid_shape_options){0};
    if (!isfinite(o->radius)) return error_set(error, OVOID_ERROR_NOT_FINITE, -1, "the radius is not finite");
    if (o->radius < 0) return error_set(error, OVOID_ERROR_RADIUS, -1, "the radius %g is negative", o->radius);
    if (o->radius > OVOID_LENGTH_MAX)
        return error_set(error, OVOID_ERROR_RANGE, -1, "the radius %g is above %g", o->radius, OVOID_LENGTH_MAX);
    const double lengths[2] = {o->allowance.outside, o->allowance.inside};
    for (int i = 0; i < 2; i++)
        if (!(lengths[i] >= 0 && lengths[i] <= OVOID_LENGTH_MAX))
            return error_set(error, isfinite(lengths[i]) ? OVOID_ERROR_RANGE : OVOID_ERROR_NOT_FINITE, -1,
                             "the allowance %s, %g, is not in [0, %g]", i ? "inside" : "outside", lengths[i],
                             OVOID_LENGTH_MAX);
    if (!vec3_is_finite(o->allowance.axis))
        return error_set(error, OVOID_ERROR_NOT_FINITE, -1, "the axis of the allowance is not finite");
    o->allowance.axis = make_axis(&o->allowance);
    if (!(o->gap >= 0 && o->gap < 1))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "the ellipsoids' gap %g is not in [0, 1)", o->gap);
    if (o->inner < OVOID_INNER_MAXIMUM || o->inner > OVOID_INNER_LEAN)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "no such inner method: %d", (int)o->inner);
    return OVOID_OK;
}

// The paper's three phases, one after another.
static ovoid_fit compute_phases(const ovoid_polytope *p, const ovoid_ellipsoid *outer) {
    ovoid_fit shrunk = ovoid_ellipsoid_compute_shrunk(p, outer);
    ovoid_fit stretched = ovoid_ellipsoid_compute_stretched(p, &shrunk.ellipsoid);
    return ovoid_ellipsoid_compute_enlarged(p, &stretched.ellipsoid);
}

// No proof rests on the inner ellipsoid of a flat body, and a tilted one cannot be stored flatter than the root of a
// rounding, 1e-8 of its size. So it is tested with ten times that, against the edges and the sides of the box.
static int is_flat_inner(const ovoid_polytope *p, const ovoid_measures *m, const ovoid_ellipsoid *e, double slack) {
    halfspaces w = halfspaces_make(p);
    for (uint32_t i = 0; i < w.count; i++) {
        ovoid_plane halfspace = halfspaces_get(&w, i);
        if (!(ellipsoid_compute_support(e, halfspace.normal) <= halfspace.offset + slack)) return 0;
    }
    const double low[3] = {m->box.min.x, m->box.min.y, m->box.min.z};
    const double high[3] = {m->box.max.x, m->box.max.y, m->box.max.z};
    for (int i = 0; i < 3; i++) {
        vec3 axis = {i == 0, i == 1, i == 2};
        if (!(ellipsoid_compute_support(e, axis) <= high[i] + slack) ||
            !(ellipsoid_compute_support(e, vec3_neg(axis)) <= slack - low[i]))
            return 0;
    }
    return 1;
}

int shape_is_inner(const ovoid_shape *shape, const ovoid_ellipsoid *e) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    if (p.rank == 3) return ellipsoid_is_enclosed(&p, e);
    // One that is only a vertex lies inside, even if the rounded halfspaces do not show it (they do not for a ribbon of
    // 1e40 by 1e25).
    return ellipsoid_is_vertex(&p, e) || is_flat_inner(&p, &shape->measures, e, 1e-7 * shape->extent);
}

// The outer ellipsoid of a lean shape, which is not improved to the last.
#define LEAN_GAP 0.1

static ovoid_code fit_ellipsoids(ovoid_shape *shape, const ovoid_shape_options *o, const closed_form *form,
                                 const ovoid_allocator *work) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    ovoid_fit outer, inner;
    double gap = o->inner == OVOID_INNER_LEAN && !(o->gap > 0) ? LEAN_GAP : o->gap;
    fit_options options = {gap, &shape->measures, work, form};
    ovoid_code code = ellipsoid_fit_outer(&p, &options, &outer);
    if (code != OVOID_OK) return code;
    // A closed form has the largest one at once; of thin bodies the moments' is not proven.
    int is_done =
        o->inner == OVOID_INNER_LEAN && form->kind == FORM_NONE && ellipsoid_fit_moments(&p, &shape->measures, &inner);
    if (o->inner == OVOID_INNER_PHASES)
        inner = compute_phases(&p, &outer.ellipsoid);
    else if (!is_done)
        code = ellipsoid_fit_inner(&p, &options, &inner);
    if (code != OVOID_OK) return code;
    // That of a solid is proven. Ribbons thinner than 1e-8 of their length may have none that can be stored; a vertex
    // always can be.
    if (p.rank < 3 && !shape_is_inner(shape, &inner.ellipsoid))
        inner = (ovoid_fit){.ellipsoid.center = vec3_at(p.vertices, 0), .gap = INFINITY};
    shape_set_fits(shape, &outer, &inner);
    return OVOID_OK;
}

// A lower bound of the least radius of the ellipsoid, 0 if it is too flat to be safe in doubles: with eigenvalues
// l1 <= l2 <= l3, l1 = det / (l2 l3) >= 4 det / trace^2. Condition below 1e8.
static double least_radius(sym3 q) {
    double trace = sym3_trace(q);
    if (!(trace > 0)) return 0;
    double least = 4 * sym3_det(sym3_scale(q, 1 / trace));
    return least > 1e-7 ? sqrt(least * trace) * (1 - 1e-7) : 0;
}

// W of an ellipsoid along the axes, within three roundings. 0 if it is not along them, or not solid.
static int fill_upright(sym3 q, double w[6]) {
    int is_along = q.xy == 0 && q.xz == 0 && q.yz == 0;
    if (!is_along || !(fmin(q.xx, fmin(q.yy, q.zz)) >= 0x1p-1000)) return 0;
    w[0] = 1 / sqrt(q.xx);
    w[2] = 1 / sqrt(q.yy);
    w[5] = 1 / sqrt(q.zz);
    return 1;
}

// W from the proven factor, whose units are powers of two: (1 - defect) x' Q^-1 x <= |W x|^2, and 1e-7 is far more than
// a defect of 1e-12 and the rounding of W x, 8 u times the root of the condition.
static shape_inner make_inside(sym3 q, uint32_t rank) {
    shape_inner in = {.reach = sqrt(sym3_trace(q)) * (1 + 1e-7)};
    factor f;
    double size;
    if (rank < 3) return in;
    if (fill_upright(q, in.w)) {
        in.least = least_radius(q);
        return in;
    }
    if (!(factor_make_quickly(q, &f, &size) && f.defect < FACTOR_DEFECT_MOST) &&
        !(factor_make(q, &f) && f.count == 3 && f.defect < FACTOR_DEFECT_MOST))
        return in;
    in.least = least_radius(q);
    for (int i = 0, k = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) in.w[k++] = f.w[i][j] * f.scale[j];
    return in;
}

void shape_set_fits(ovoid_shape *shape, const ovoid_fit *outer, const ovoid_fit *inner) {
    shape->outer_fit = *outer;
    shape->inner_fit = *inner;
    shape->outer = outer->ellipsoid;
    shape->inner = inner->ellipsoid;
    shape->inside = make_inside(inner->ellipsoid.q, shape->rank);
    shape_floats_fill_ellipsoids(shape);
    shape_gauss_map_fill(shape);
}

ovoid_shape *shape_create_block(const hull *polytope, const block_making *how, ovoid_error *error) {
    ovoid_polytope p = hull_get_polytope(polytope);
    support_table support = {.k = 0};
    support_block *blocks = NULL;
    ovoid_code code = how->is_lean ? OVOID_OK : support_table_create(&p, how->work, &support, &blocks);
    if (code != OVOID_OK) {
        error_write(error, code, -1, "no memory for the table of supports of %u vertices", p.vertex_count);
        return NULL;
    }
    block_counts counts = {polytope->vertex_count, polytope->triangle_count,
                           polytope->facet_count,  polytope->neighbor_starts[polytope->vertex_count],
                           support.cell_count,     how->is_lean};
    uint32_t *room = allocator_allocate(how->work, loops_get_room(counts), sizeof *room);
    if (!room) error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for the loops of %u facets", counts.facets);
    ovoid_shape *shape = room ? block_create(counts, how->allocator, error) : NULL;
    if (shape) {
        block_fill(shape, polytope, room);
        shape->support = support;
        support_table_fill(p.vertices, blocks, support.cell_count, (simd_cell *)((char *)shape + shape->at.cells));
    }
    allocator_release(how->work, room);
    allocator_release(how->work, blocks);
    return shape;
}

ovoid_shape *shape_create_from_hull(const hull *polytope, const ovoid_shape_options *o, const ovoid_allocator *work,
                                    ovoid_error *error) {
    const block_making how = {o->allocator, work, o->inner == OVOID_INNER_LEAN};
    ovoid_shape *shape = shape_create_block(polytope, &how, error);
    if (!shape) return NULL;
    block_set_radius(shape, o->radius, o->allowance);
    shape->report = polytope->report;
    ovoid_code code = fit_ellipsoids(shape, o, &polytope->form, work);
    if (code == OVOID_OK) return shape;
    error_write(error, code, -1, "no memory for the ellipsoids of %u vertices", polytope->vertex_count);
    ovoid_shape_destroy(shape);
    return NULL;
}

ovoid_shape *shape_create_from_points(xyz_points given, const ovoid_shape_options *options, ovoid_error *error) {
    ovoid_shape_options o;
    if (shape_options_make(options, &o, error) != OVOID_OK) return NULL;
    if (!given.xyz && given.count) {
        error_write(error, OVOID_ERROR_ARGUMENT, -1, "the array of points is NULL");
        return NULL;
    }
    _Alignas(64) char buffer[SHAPE_WORK_SIZE];
    ovoid_allocator allocator = allocator_make(o.allocator);
    arena a;
    ovoid_allocator work = arena_make(&a, &allocator, buffer, sizeof buffer);
    hull polytope;
    if (hull_create(given, &work, &polytope, error) != OVOID_OK) return NULL;
    ovoid_shape *shape = shape_create_from_hull(&polytope, &o, &work, error);
    hull_destroy(&polytope, &work);
    return shape;
}

ovoid_shape *ovoid_shape_create_from_points(const double *xyz, size_t count, const ovoid_shape_options *options,
                                            ovoid_error *error) {
    const xyz_points given = {xyz, count};
    ENVIRONMENT_RETURN(ovoid_shape *, xyz, shape_create_from_points(given, options, error));
}
