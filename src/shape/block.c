// The layout of a shape's block; getters, copy and destruction of a shape.
#include "shape/block.h"

#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "polytope/hull.h"
#include "polytope/sphere.h"
#include "shape/floats.h"
#include "shape/gauss_map.h"
#include "shape/loops.h"
#include "simd/support.h"

#include <string.h>

// The next 64-byte boundary after size bytes from `at`.
static uint64_t advance(uint64_t *at, uint64_t size) {
    uint64_t start = *at;
    *at = (start + size + 63) / 64 * 64;
    return start;
}

block_offsets block_compute_offsets(block_counts c) {
    block_offsets o;
    uint64_t at = SHAPE_FLOATS + shape_floats_get_size(c.vertices), lane = simd_get_padded(c.vertices) * sizeof(double);
    o.x = advance(&at, lane);
    o.y = advance(&at, lane);
    o.z = advance(&at, lane);
    o.gauss = advance(&at, gauss_map_get_size(&c));
    o.vertices = advance(&at, (uint64_t)c.vertices * 3 * sizeof(double));
    o.planes = advance(&at, (uint64_t)c.facets * sizeof(ovoid_plane));
    o.triangles = advance(&at, (uint64_t)c.triangles * 3 * sizeof(uint32_t));
    o.triangle_facets = advance(&at, (uint64_t)c.triangles * sizeof(uint32_t));
    o.neighbor_starts = advance(&at, ((uint64_t)c.vertices + 1) * sizeof(uint32_t));
    o.neighbors = advance(&at, (uint64_t)c.neighbors * sizeof(uint32_t));
    o.cells = advance(&at, (uint64_t)c.cells * sizeof(simd_cell));
    o.edge_tails = advance(&at, (uint64_t)c.neighbors * sizeof(uint32_t));
    o.edge_facets = advance(&at, (uint64_t)c.neighbors * sizeof(uint32_t));
    o.loop_starts = advance(&at, ((uint64_t)c.facets + 2) * sizeof(uint32_t));
    o.loop_vertices = advance(&at, ((uint64_t)c.neighbors + 1) * sizeof(uint32_t));
    o.loop_edges = advance(&at, ((uint64_t)c.neighbors + 1) * sizeof(uint32_t));
    o.size = at;
    return o;
}

// Clears the header and the padding between arrays, less than 64 bytes before each, so that equal shapes are equal
// blocks.
static void clear_padding(ovoid_shape *shape, const block_offsets *at) {
    const uint64_t ends[] = {at->y,          at->z,         at->gauss,           at->vertices,
                             at->planes,     at->triangles, at->triangle_facets, at->neighbor_starts,
                             at->neighbors,  at->cells,     at->edge_tails,      at->edge_facets,
                             at->loop_starts};
    memset(shape, 0, at->x);
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) memset((char *)shape + ends[i] - 64, 0, 64);
    memset((char *)shape + at->loop_starts, 0, at->size - at->loop_starts);
    if (at->vertices > at->gauss) memset((char *)shape + at->gauss, 0, sizeof(gauss_map));
}

ovoid_shape *block_create(block_counts counts, const ovoid_allocator *given, ovoid_error *error) {
    ovoid_allocator allocator = allocator_make(given);
    block_offsets at = block_compute_offsets(counts);
    ovoid_shape *shape = allocator_allocate(&allocator, 1, at.size);
    if (!shape) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for a shape of %llu bytes", (unsigned long long)at.size);
        return NULL;
    }
    clear_padding(shape, &at);
    shape->at = at;
    shape->counts = counts;
    shape->allocator = allocator;
    shape->vertex_count = counts.vertices;
    shape->padded_count = (uint32_t)simd_get_padded(counts.vertices);
    return shape;
}

static void copy_array(ovoid_shape *shape, uint64_t at, const void *from, uint64_t size) {
    if (size) memcpy((char *)shape + at, from, size);
}

void block_fill(ovoid_shape *shape, const hull *polytope, uint32_t *room) {
    const ovoid_polytope view = hull_get_polytope(polytope), *p = &view;
    const closed_form *form = &polytope->form;
    const block_offsets *at = &shape->at;
    const block_counts *c = &shape->counts;
    copy_array(shape, at->vertices, p->vertices, (uint64_t)c->vertices * 3 * sizeof(double));
    copy_array(shape, at->planes, p->planes, (uint64_t)c->facets * sizeof(ovoid_plane));
    copy_array(shape, at->triangles, p->triangles, (uint64_t)c->triangles * 3 * sizeof(uint32_t));
    copy_array(shape, at->triangle_facets, p->triangle_facets, (uint64_t)c->triangles * sizeof(uint32_t));
    copy_array(shape, at->neighbor_starts, p->neighbor_starts, ((uint64_t)c->vertices + 1) * sizeof(uint32_t));
    copy_array(shape, at->neighbors, p->neighbors, (uint64_t)c->neighbors * sizeof(uint32_t));
    double *lane[3] = {(double *)((char *)shape + at->x), (double *)((char *)shape + at->y),
                       (double *)((char *)shape + at->z)};
    for (uint32_t i = 0; i < shape->padded_count; i++)
        for (int k = 0; k < 3; k++) lane[k][i] = p->vertices[3 * (size_t)(i < c->vertices ? i : 0) + k];
    shape->rank = (uint16_t)p->rank;
    shape->origin = p->origin;
    shape->has_origin = p->origin.x != 0 || p->origin.y != 0 || p->origin.z != 0;
    int has_form = form->kind != FORM_NONE;
    shape->measures = has_form ? closed_form_compute_measures(form, p) : ovoid_polytope_compute_measures(p);
    shape->center = shape->measures.sphere_center;
    shape->reach = shape->measures.sphere_radius;
    shape->first = (ovoid_vec3){p->vertices[0], p->vertices[1], p->vertices[2]};
    shape->extent = shape->reach;
    if (vec3_max_abs(shape->center) > 0)
        shape->extent = sphere_compute_radius(p->vertices, p->vertex_count, (ovoid_vec3){0, 0, 0});
    shape_floats_fill_vertices(shape);
    loops_fill(shape, polytope, room);
    shape->box = form->kind == FORM_BOX
                     ? parallelepiped_make_centered(form->half)
                     : parallelepiped_find(p->vertices, p->rank == 3 ? p->vertex_count : 0, shape->extent);
}

void block_set_radius(ovoid_shape *s, double radius, ovoid_allowance allowance) {
    s->radius = s->lower_radius = s->upper_radius = radius;
    s->allowance = allowance;
    s->round = (ovoid_round){.kind = OVOID_ROUND_NONE};
    s->span = s->extent;
    if (allowance.outside > 0) s->lower_radius = nextafter(radius + allowance.outside, INFINITY);
    // No point of the polyhedron is farther from a point of the true body than its own diameter and `outside`.
    double most = 2 * (s->extent + s->lower_radius);
    if (allowance.inside > most) s->allowance.inside = most;
    double inside = s->allowance.inside;
    s->has_allowance = allowance.outside + inside > 0 ? ALLOWANCE_ANY : 0;
    if (vec3_norm_squared(allowance.axis) > 0) s->has_allowance |= ALLOWANCE_AXIS;
    s->is_plain = !(radius > 0) && !s->has_allowance && !s->has_origin;
    if (!(inside > 0)) return;
    s->upper_radius = nextafter(radius - inside, -INFINITY);
    s->span += 2 * inside;
}

double shape_compute_lower_radius(const ovoid_shape *s, ovoid_vec3 n, double error) {
    if (!shape_has_axis(s)) return s->lower_radius;
    double most = nextafter(s->radius + shape_compute_across(s, n, error), INFINITY);
    return most < s->lower_radius ? most : s->lower_radius;
}

static ovoid_shape *copy(const ovoid_shape *shape, const ovoid_allocator *allocator, ovoid_error *error) {
    if (!shape) {
        error_write(error, OVOID_ERROR_ARGUMENT, -1, "no shape to copy");
        return NULL;
    }
    ovoid_shape *to = block_create(shape->counts, allocator, error);
    if (!to) return NULL;
    ovoid_allocator own = to->allocator;
    memcpy(to, shape, shape->at.size);
    to->allocator = own;
    return to;
}

ovoid_shape *ovoid_shape_create_copy(const ovoid_shape *shape, const ovoid_shape_options *options, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_shape *, shape, copy(shape, options ? options->allocator : NULL, error));
}

void ovoid_shape_destroy(ovoid_shape *shape) {
    if (!shape) return;
    ovoid_allocator allocator = shape->allocator;
    ENVIRONMENT_RUN(allocator_release(&allocator, shape));
}

ovoid_polytope ovoid_shape_get_polytope(const ovoid_shape *s) {
    const char *base = (const char *)s;
    return (ovoid_polytope){.vertices = shape_vertices(s),
                            .triangles = (const uint32_t *)(base + s->at.triangles),
                            .triangle_facets = (const uint32_t *)(base + s->at.triangle_facets),
                            .planes = (const ovoid_plane *)(base + s->at.planes),
                            .neighbor_starts = (const uint32_t *)(base + s->at.neighbor_starts),
                            .neighbors = (const uint32_t *)(base + s->at.neighbors),
                            .origin = s->origin,
                            .vertex_count = s->counts.vertices,
                            .triangle_count = s->counts.triangles,
                            .facet_count = s->counts.facets,
                            .rank = s->rank};
}

simd_extreme shape_find_extreme(const ovoid_shape *s, ovoid_vec3 n) {
    simd_extreme x;
    if (s->support.k && support_table_find(&s->support, shape_cells(s), n, &x)) return x;
    simd_points points = shape_get_points(s);
    support_result r = simd_find_support(&points, &n);
    ovoid_vec3 v = {shape_x(s)[r.index], shape_y(s)[r.index], shape_z(s)[r.index]};
    return (simd_extreme){r.value, v.x, v.y, v.z, r.index};
}

double ovoid_shape_get_radius(const ovoid_shape *shape) { return shape->radius; }
ovoid_allowance ovoid_shape_get_allowance(const ovoid_shape *shape) { return shape->allowance; }
ovoid_round ovoid_shape_get_round(const ovoid_shape *shape) { return shape->round; }
ovoid_report ovoid_shape_get_report(const ovoid_shape *shape) { return shape->report; }
ovoid_fit ovoid_shape_get_outer(const ovoid_shape *shape) { return shape->outer_fit; }
ovoid_fit ovoid_shape_get_inner(const ovoid_shape *shape) { return shape->inner_fit; }
ovoid_measures ovoid_shape_get_measures(const ovoid_shape *shape) { return shape->measures; }
int ovoid_shape_is_lean(const ovoid_shape *shape) { return shape->counts.is_lean != 0; }
size_t ovoid_shape_get_size(const ovoid_shape *shape) { return shape->at.size; }
