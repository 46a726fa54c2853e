// The solid and its parts, validated, in units of their size; the distance of a point from a part, by the core's own
// answer.
#include "decompose/body.h"

#include "base/allocator.h"
#include "base/error.h"
#include "ovoid/query.h"

enum { CELLS = 1 << 18, CELLS_LEAST = 4096, WORK = 1 << 21 };

static ovoid_code validate_length(const char *name, double length, ovoid_error *error) {
    if (length >= 0 && length <= OVOID_LENGTH_MAX) return OVOID_OK;
    return error_set(error, OVOID_ERROR_ARGUMENT, -1, "the %s %g is no length: give one of at least 0", name, length);
}

ovoid_code body_validate_options(const ovoid_decomposition_options *given, ovoid_decomposition_options *options,
                                 ovoid_error *error) {
    *options = given ? *given : (ovoid_decomposition_options){0};
    ovoid_code code = validate_length("tolerance", options->tolerance, error);
    if (code == OVOID_OK) code = validate_length("error", options->error, error);
    if (code != OVOID_OK) return code;
    if (options->parts > OVOID_DECOMPOSITION_PARTS_MAX)
        return error_set(error, OVOID_ERROR_LIMIT, -1, "%zu parts, %d are allowed", options->parts,
                         OVOID_DECOMPOSITION_PARTS_MAX);
    if (!options->cells) options->cells = CELLS;
    if (!options->work) options->work = WORK;
    if (options->cells < CELLS_LEAST)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "room for %zu cells: give at least %d", options->cells,
                         CELLS_LEAST);
    return OVOID_OK;
}

static ovoid_code validate_solid(const ovoid_solid *solid, ovoid_error *error) {
    if (!solid) return error_set(error, OVOID_ERROR_ARGUMENT, -1, "no solid (NULL)");
    if (!solid->report.is_closed)
        return error_set(
            error, OVOID_ERROR_ARGUMENT, -1,
            "the mesh is not closed, %llu of its edges are not met by a triangle from each side: it has no "
            "inside that parts could fill; close it first",
            (unsigned long long)solid->report.edges_unmatched);
    return OVOID_OK;
}

static void set_unit(body *b, double reach) {
    b->unit = ldexp(1, find_unit_exponent(max2(reach, OVOID_LENGTH_MIN)));
    b->inverse = 1 / b->unit;
    b->pad = BODY_PAD;
    const ovoid_box *around = &b->solid->report.box;
    b->diagonal = vec3_norm(vec3_scale(vec3_sub(around->max, around->min), b->inverse));
}

static double find_reach(const ovoid_solid *solid) {
    const ovoid_box *around = &solid->report.box;
    return max2(vec3_max_abs(around->min), vec3_max_abs(around->max));
}

static ovoid_code open_point(body *b, ovoid_error *error) {
    static const double origin[3] = {0, 0, 0};
    b->point = ovoid_shape_create_from_points(origin, 1, &(ovoid_shape_options){.allocator = &b->memory}, error);
    return b->point ? OVOID_OK : OVOID_ERROR_MEMORY;
}

static void set_tolerance(body *b, const ovoid_decomposition_options *o) {
    double whole = o->tolerance > 0 ? o->tolerance : b->diagonal * b->unit * 1e-3;
    b->tolerance = whole / 64;
}

ovoid_code body_open(body *b, const ovoid_solid *solid, const ovoid_decomposition_options *options,
                     ovoid_error *error) {
    ovoid_code code = validate_solid(solid, error);
    if (code != OVOID_OK) return code;
    *b = (body){.solid = solid, .memory = allocator_make(options->allocator)};
    set_unit(b, find_reach(solid));
    set_tolerance(b, options);
    return open_point(b, error);
}

// ---- parts

ovoid_code body_validate_parts(const ovoid_decomposition *d, ovoid_error *error) {
    if (!d || (d->part_count && !d->parts)) return error_set(error, OVOID_ERROR_ARGUMENT, -1, "no parts (NULL)");
    if (!d->part_count) return error_set(error, OVOID_ERROR_EMPTY, -1, "there are no parts");
    if (d->part_count > OVOID_DECOMPOSITION_PARTS_MAX)
        return error_set(error, OVOID_ERROR_LIMIT, -1, "%zu parts, %d are allowed", d->part_count,
                         OVOID_DECOMPOSITION_PARTS_MAX);
    for (size_t i = 0; i < d->part_count; i++) {
        if (!d->parts[i]) return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)i, "part %zu is NULL", i);
        ovoid_allowance a = ovoid_shape_get_allowance(d->parts[i]);
        if (a.outside > 0 || a.inside > 0)
            return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)i,
                             "part %zu has an allowance: give the part itself, without one", i);
    }
    return OVOID_OK;
}

// The part's box in the user's unit.
static box find_box(const ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    box b = box_make_around(p.vertices, p.vertex_count);
    double r = ovoid_shape_get_radius(shape);
    vec3 margin = {r, r, r};
    return (box){vec3_sub(vec3_add(p.origin, b.min), margin), vec3_add(vec3_add(p.origin, b.max), margin)};
}

ovoid_code body_open_parts(body *b, const ovoid_decomposition *d, const ovoid_decomposition_options *options,
                           ovoid_error *error) {
    ovoid_code code = body_validate_parts(d, error);
    if (code == OVOID_OK) code = validate_solid(d->solid, error);
    if (code != OVOID_OK) return code;
    *b = (body){.solid = d->solid, .memory = allocator_make(options->allocator)};
    b->parts = allocator_allocate(&b->memory, d->part_count, sizeof *b->parts);
    if (!b->parts) return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for %zu parts", d->part_count);
    double reach = find_reach(d->solid);
    for (size_t i = 0; i < d->part_count; i++) {
        box around = find_box(d->parts[i]);
        vec3 origin = ovoid_shape_get_polytope(d->parts[i]).origin;
        b->parts[i] = (body_part){d->parts[i], ovoid_shape_get_radius(d->parts[i]), around};
        reach = max2(reach, max2(vec3_max_abs(around.min), vec3_max_abs(around.max)) + vec3_max_abs(origin));
    }
    set_unit(b, reach);
    set_tolerance(b, options);
    b->part_count = (uint32_t)d->part_count;
    vec3 pad = {b->pad, b->pad, b->pad};
    for (size_t i = 0; i < d->part_count; i++) {
        body_part *p = &b->parts[i];
        p->radius *= b->inverse;
        p->bounds.min = vec3_sub(vec3_scale(p->bounds.min, b->inverse), pad);
        p->bounds.max = vec3_add(vec3_scale(p->bounds.max, b->inverse), pad);
    }
    code = open_point(b, error);
    if (code != OVOID_OK) body_close(b);
    return code;
}

void body_close(body *b) {
    ovoid_shape_destroy(b->point);
    allocator_release(&b->memory, b->parts);
}

part_distance body_probe_part(const body *b, uint32_t part, vec3 x, double cap) {
    ovoid_pair pair = {b->parts[part].shape, b->point, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    pair.pose_b.position = vec3_scale(x, b->unit);
    ovoid_options options = {.absolute_tolerance = b->tolerance, .cap = cap * b->unit};
    ovoid_answer answer = ovoid_distance(&pair, &options, NULL);
    return (part_distance){max2(answer.lower * b->inverse, 0), max2(answer.upper * b->inverse, 0), answer.normal,
                           vec3_scale(answer.point_a, b->inverse)};
}

double body_find_depth(const body *b, uint32_t part, vec3 x, vec3 n) {
    ovoid_pair pair = {b->parts[part].shape, b->point, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    pair.pose_b.position = vec3_scale(x, b->unit);
    double gap = ovoid_pair_compute_gap(&pair, n);
    return isfinite(gap) ? -gap * b->inverse : INFINITY;
}
