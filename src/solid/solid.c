// A solid from triangles: points that are equal become one, then the report and the tree, in one block.
#include "solid/solid.h"

#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "polytope/sphere.h"

#include <string.h>

// ---- the input

static ovoid_code check_input(const double *xyz, size_t points, const uint32_t *indices, size_t count,
                              ovoid_error *error) {
    if ((!xyz && points) || (!indices && count))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "the array of %s is NULL", xyz ? "indices" : "points");
    if (count == 0) return error_set(error, OVOID_ERROR_EMPTY, -1, "a solid of no triangles");
    if (count > OVOID_SOLID_TRIANGLES_MAX)
        return error_set(error, OVOID_ERROR_LIMIT, -1, "%zu triangles, %zu are allowed", count,
                         OVOID_SOLID_TRIANGLES_MAX);
    if (points > 3 * OVOID_SOLID_TRIANGLES_MAX)
        return error_set(error, OVOID_ERROR_LIMIT, -1, "%zu points, %zu are allowed", points,
                         3 * OVOID_SOLID_TRIANGLES_MAX);
    for (size_t i = 0; i < points; i++) {
        vec3 p = vec3_at(xyz, i);
        if (!vec3_is_finite(p))
            return error_set(error, OVOID_ERROR_NOT_FINITE, (int64_t)i, "point %zu is not finite", i);
        if (vec3_max_abs(p) > OVOID_LENGTH_MAX)
            return error_set(error, OVOID_ERROR_RANGE, (int64_t)i, "point %zu is beyond %g", i, OVOID_LENGTH_MAX);
    }
    for (size_t i = 0; i < 3 * count; i++)
        if (indices[i] >= points)
            return error_set(error, OVOID_ERROR_INDEX, (int64_t)(i / 3), "triangle %zu: there is no point %u, only %zu",
                             i / 3, indices[i], points);
    return OVOID_OK;
}

// ---- equal points

// The points that triangles use, each once, in the order of their first use, by a table of open addresses.
typedef struct merger {
    double *points;
    solid_triangle *triangles;
    uint32_t *table;  ///< a point, or UINT32_MAX
    uint32_t *merged; ///< of each point given, or UINT32_MAX
    uint32_t mask, count;
} merger;

// Coordinates as they are stored.
typedef struct point_bits {
    uint64_t bits[3];
} point_bits;

static point_bits get_bits(const double p[3]) {
    point_bits b;
    memcpy(&b, p, sizeof b);
    return b;
}

static int is_same(point_bits a, point_bits b) {
    return a.bits[0] == b.bits[0] && a.bits[1] == b.bits[1] && a.bits[2] == b.bits[2];
}

static uint64_t hash(point_bits p) {
    uint64_t h = 0;
    for (int k = 0; k < 3; k++) {
        h = (h ^ p.bits[k]) * 0x9e3779b97f4a7c15u;
        h ^= h >> 32;
    }
    return h;
}

static uint32_t merge_point(merger *m, const double *xyz) {
    // Zeros of both signs are one.
    const double p[3] = {xyz[0] + 0.0, xyz[1] + 0.0, xyz[2] + 0.0};
    point_bits bits = get_bits(p);
    uint32_t at = (uint32_t)hash(bits) & m->mask;
    for (; m->table[at] != UINT32_MAX; at = (at + 1) & m->mask)
        if (is_same(get_bits(m->points + 3 * (size_t)m->table[at]), bits)) return m->table[at];
    memcpy(m->points + 3 * (size_t)m->count, p, sizeof p);
    return m->table[at] = m->count++;
}

static void merger_destroy(merger *m, const ovoid_allocator *a) {
    allocator_release(a, m->points);
    allocator_release(a, m->triangles);
    allocator_release(a, m->table);
    allocator_release(a, m->merged);
}

static int merge(const double *xyz, size_t points, const uint32_t *indices, size_t count, const ovoid_allocator *a,
                 merger *m) {
    size_t most = points < 3 * count ? points : 3 * count, slots = 4;
    while (slots < 2 * most) slots *= 2;
    *m = (merger){allocator_allocate(a, most, 3 * sizeof(double)),
                  allocator_allocate(a, count, sizeof(solid_triangle)),
                  allocator_allocate(a, slots, sizeof(uint32_t)),
                  allocator_allocate(a, points, sizeof(uint32_t)),
                  (uint32_t)(slots - 1),
                  0};
    if (!m->points || !m->triangles || !m->table || !m->merged) {
        merger_destroy(m, a);
        return 0;
    }
    memset(m->table, 0xff, slots * sizeof(uint32_t));
    memset(m->merged, 0xff, points * sizeof(uint32_t));
    for (size_t i = 0; i < 3 * count; i++) {
        uint32_t *known = &m->merged[indices[i]];
        if (*known == UINT32_MAX) *known = merge_point(m, xyz + 3 * (size_t)indices[i]);
        m->triangles[i / 3].point[i % 3] = *known;
    }
    return 1;
}

// ---- the block

typedef struct layout {
    size_t boxes, points, triangles, order, places, nodes, components, size;
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
    l.points = advance(&at, points, 3 * sizeof(double));
    l.triangles = advance(&at, triangles, sizeof(solid_triangle));
    l.order = advance(&at, triangles, sizeof(uint32_t));
    l.places = advance(&at, triangles, sizeof(uint32_t));
    l.nodes = advance(&at, nodes, sizeof(solid_node));
    l.components = advance(&at, components, sizeof(uint32_t));
    l.size = at;
    return l;
}

static void place_arrays(ovoid_solid *s, const layout *l) {
    char *base = (char *)s;
    s->boxes = (box8 *)(base + l->boxes);
    s->points = (double *)(base + l->points);
    s->triangles = (solid_triangle *)(base + l->triangles);
    s->order = (uint32_t *)(base + l->order);
    s->places = (uint32_t *)(base + l->places);
    s->nodes = (solid_node *)(base + l->nodes);
    s->components = (uint32_t *)(base + l->components);
    s->size = l->size;
}

// What is known before the tree, in a header that owns nothing but points and components.
static void set_header(ovoid_solid *s, const merger *m, uint32_t triangles) {
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

// The tree in arrays of its own, since the number of its nodes is known only afterwards; then the block.
static ovoid_solid *assemble(ovoid_solid *made, const merger *m, const uint32_t *components) {
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
        }
    }
    allocator_release(a, made->boxes);
    allocator_release(a, made->nodes);
    allocator_release(a, made->order);
    return s;
}

static ovoid_solid *create(const double *xyz, size_t points, const uint32_t *indices, size_t count,
                           const ovoid_allocator *given, ovoid_error *error) {
    if (check_input(xyz, points, indices, count, error) != OVOID_OK) return NULL;
    ovoid_solid made = {.allocator = allocator_make(given)}, *s = NULL;
    merger m;
    if (merge(xyz, points, indices, count, &made.allocator, &m)) {
        set_header(&made, &m, (uint32_t)count);
        uint32_t *components = allocator_allocate(&made.allocator, m.count, sizeof *components);
        solid_parts parts = {m.points, m.triangles, m.count, (uint32_t)count};
        if (components) {
            made.component_count = solid_compute_report(&parts, &made.allocator, components, &made.report);
            if (made.component_count) s = assemble(&made, &m, components);
        }
        allocator_release(&made.allocator, components);
        merger_destroy(&m, &made.allocator);
    }
    if (!s) error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for a solid of %zu triangles", count);
    return s;
}

ovoid_solid *ovoid_solid_create_from_triangles(const double *xyz, size_t point_count, const uint32_t *indices,
                                               size_t count, const ovoid_allocator *allocator, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_solid *, xyz, create(xyz, point_count, indices, count, allocator, error));
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
