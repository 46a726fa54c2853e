// Creating a solid from triangles: equal points are merged, then the report and the tree are made, in one block.
#include "solid/solid.h"

#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "polytope/sphere.h"
#include "solid/merge.h"

#include <string.h>

typedef struct layout {
    size_t boxes, turned, points, triangles, order, places, nodes, frames, components, facets, bends, size;
} layout;

static size_t advance(size_t *at, size_t count, size_t size) {
    size_t start = *at;
    *at = (start + count * size + 63) / 64 * 64;
    return start;
}

static layout make_layout(uint32_t points, uint32_t triangles, uint32_t nodes, uint32_t components) {
    layout l;
    size_t at = (sizeof(ovoid_solid) + 63) / 64 * 64;
    l.boxes = advance(&at, nodes, sizeof(box8));
    l.turned = advance(&at, nodes, sizeof(box8));
    l.points = advance(&at, points, 3 * sizeof(double));
    l.triangles = advance(&at, triangles, sizeof(solid_triangle));
    l.order = advance(&at, triangles, sizeof(uint32_t));
    l.places = advance(&at, triangles, sizeof(uint32_t));
    l.nodes = advance(&at, nodes, sizeof(solid_node));
    l.frames = advance(&at, nodes, sizeof(node_frame));
    l.components = advance(&at, components, sizeof(uint32_t));
    l.facets = advance(&at, triangles, sizeof(uint32_t));
    l.bends = advance(&at, triangles, sizeof(uint8_t));
    l.size = at;
    return l;
}

static void place_arrays(ovoid_solid *s, const layout *l) {
    char *base = (char *)s;
    s->boxes = (box8 *)(base + l->boxes);
    s->turned = (box8 *)(base + l->turned);
    s->points = (double *)(base + l->points);
    s->triangles = (solid_triangle *)(base + l->triangles);
    s->order = (uint32_t *)(base + l->order);
    s->places = (uint32_t *)(base + l->places);
    s->nodes = (solid_node *)(base + l->nodes);
    s->frames = (node_frame *)(base + l->frames);
    s->components = (uint32_t *)(base + l->components);
    s->facets = (uint32_t *)(base + l->facets);
    s->bends = (uint8_t *)(base + l->bends);
    s->size = l->size;
}

// Sets the parts of the header that precede the tree; the header owns only points and components.
static void set_header(ovoid_solid *s, const solid_merger *m, uint32_t triangles) {
    s->point_count = m->count;
    s->triangle_count = triangles;
    s->report.box = box_make_around(m->points, m->count);
    s->center = vec3_scale(vec3_add(s->report.box.min, s->report.box.max), 0.5);
    double reach = max2(vec3_max_abs(vec3_sub(s->report.box.max, s->center)),
                        vec3_max_abs(vec3_sub(s->report.box.min, s->center)));
    s->unit = ldexp(1, find_unit_exponent(max2(reach, OVOID_LENGTH_MIN)));
    s->extent = sphere_compute_radius(m->points, m->count, (vec3){0, 0, 0});
    s->reach = sphere_compute_radius(m->points, m->count, s->center);
}

// Builds the tree in arrays of its own, since the number of its nodes is known only afterwards; then the block.
static ovoid_solid *assemble(ovoid_solid *made, const solid_merger *m, const uint32_t *components) {
    const ovoid_allocator *a = &made->allocator;
    uint32_t most = tree_get_most_nodes(made->triangle_count);
    made->points = m->points;
    made->boxes = allocator_allocate(a, most, sizeof(box8));
    made->nodes = allocator_allocate(a, most, sizeof(solid_node));
    made->order = allocator_allocate(a, made->triangle_count, sizeof(uint32_t));
    ovoid_solid *s = NULL;
    if (made->boxes && made->nodes && made->order && solid_build_tree(made, m->triangles)) {
        layout l = make_layout(made->point_count, made->triangle_count, made->node_count, made->component_count);
        s = allocator_allocate(a, 1, l.size);
        if (s) {
            memset(s, 0, l.size);
            *s = *made;
            place_arrays(s, &l);
            memcpy(s->boxes, made->boxes, s->node_count * sizeof(box8));
            memcpy(s->nodes, made->nodes, s->node_count * sizeof(solid_node));
            memcpy(s->points, m->points, s->point_count * 3 * sizeof(double));
            memcpy(s->components, components, s->component_count * sizeof(uint32_t));
            memcpy(s->order, made->order, s->triangle_count * sizeof(uint32_t));
            for (uint32_t i = 0; i < s->triangle_count; i++) {
                s->triangles[i] = m->triangles[s->order[i]];
                s->places[s->order[i]] = i;
            }
            solid_make_frames(s);
            if (!solid_find_facets(s)) {
                allocator_release(a, s);
                s = NULL;
            }
        }
    }
    allocator_release(a, made->boxes);
    allocator_release(a, made->nodes);
    allocator_release(a, made->order);
    return s;
}

static ovoid_solid *create(const ovoid_triangles *given, const ovoid_solid_options *options, ovoid_error *error) {
    if (solid_validate_triangles(given, error) != OVOID_OK) return NULL;
    ovoid_solid made = {.allocator = allocator_make(options ? options->allocator : NULL)}, *s = NULL;
    solid_merger m;
    if (merger_make(&m, given, &made.allocator)) {
        set_header(&made, &m, (uint32_t)given->count);
        uint32_t *components = allocator_allocate(&made.allocator, m.count, sizeof *components);
        solid_parts parts = {m.points, m.triangles, m.count, (uint32_t)given->count};
        if (components) {
            made.component_count = solid_compute_report(&parts, &made.allocator, components, &made.report);
            if (made.component_count) s = assemble(&made, &m, components);
        }
        allocator_release(&made.allocator, components);
        merger_destroy(&m, &made.allocator);
    }
    if (!s) error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for a solid of %zu triangles", given->count);
    return s;
}

ovoid_solid *ovoid_solid_create_from_triangles(const ovoid_triangles *triangles, const ovoid_solid_options *options,
                                               ovoid_error *error) {
    OVOID_ASSERT(triangles);
    ENVIRONMENT_RETURN(ovoid_solid *, triangles, create(triangles, options, error));
}

void ovoid_solid_destroy(ovoid_solid *solid) {
    if (!solid) return;
    ovoid_allocator allocator = solid->allocator;
    allocator_release(&allocator, solid);
}

ovoid_solid_report ovoid_solid_get_report(const ovoid_solid *solid) { return solid->report; }
const double *ovoid_solid_get_points(const ovoid_solid *solid) { return solid->points; }
void ovoid_solid_get_triangle(const ovoid_solid *solid, size_t i, uint32_t points[3]) {
    memcpy(points, solid->triangles[solid->places[i]].point, sizeof(solid_triangle));
}
const uint32_t *ovoid_solid_get_order(const ovoid_solid *solid) { return solid->order; }
size_t ovoid_solid_get_size(const ovoid_solid *solid) { return solid->size; }
