// Shapes by number: a table of their addresses (open addressing), and the text of each.
#include "page/shapes.h"

#include "base/message.h"
#include "page/areas.h"
#include "page/write.h"
#include "tools/hash.h"

#include <stdlib.h>

// ---- the table

static int is_end(const void *table, size_t slot, const void *key) {
    const page_shapes *s = table;
    return !s->slots[slot] || s->items[s->slots[slot] - 1] == key;
}

static size_t *find_slot(const page_shapes *s, const ovoid_shape *shape) {
    return &s->slots[hash_find(hash_number((uint64_t)(uintptr_t)shape >> 4), s->slot_count, s, shape, is_end)];
}

/// Room for one more shape; 0 if memory runs out.
static int grow(page_shapes *s) {
    if (s->count < s->capacity) return 1;
    size_t capacity = s->capacity ? 2 * s->capacity : 64;
    const ovoid_shape **items = realloc(s->items, capacity * sizeof *items);
    if (items) s->items = items;
    page_mesh *meshes = realloc(s->meshes, capacity * sizeof *meshes);
    if (meshes) s->meshes = meshes;
    unsigned char *seen = realloc(s->seen, capacity);
    if (seen) s->seen = seen;
    size_t *slots = calloc(2 * capacity, sizeof *slots);
    if (!items || !meshes || !seen || !slots) {
        free(slots);
        return 0;
    }
    free(s->slots);
    s->slots = slots;
    s->slot_count = 2 * capacity;
    s->capacity = capacity;
    for (size_t i = 0; i < s->count; i++) *find_slot(s, s->items[i]) = i + 1;
    return 1;
}

int page_shapes_add(page_shapes *s, const ovoid_shape *shape, size_t *number) {
    if (!grow(s)) return 0;
    size_t *slot = find_slot(s, shape);
    if (!*slot) {
        s->items[s->count] = shape;
        s->meshes[s->count] = (page_mesh){.points = NULL};
        s->seen[s->count] = 0;
        *slot = ++s->count;
    }
    *number = *slot - 1;
    return 1;
}

void page_shapes_clear(page_shapes *s) {
    for (size_t i = 0; i < s->count; i++) {
        free(s->meshes[i].points);
        free(s->meshes[i].triangles);
    }
    free(s->items);
    free(s->meshes);
    free(s->seen);
    free(s->slots);
    *s = (page_shapes){.items = NULL};
}

// ---- writing

static int write_bytes(FILE *file, const ovoid_shape *shape) {
    size_t size = ovoid_shape_write(shape, NULL, 0);
    unsigned char *bytes = malloc(size + 1);
    if (!bytes) return 0;
    (void)ovoid_shape_write(shape, bytes, size);
    fputs("{\"bytes\":", file);
    page_base64 to = page_base64_begin(file);
    page_base64_add_bytes(&to, bytes, size);
    page_base64_end(&to);
    free(bytes);
    return 1;
}

static void write_mesh(FILE *file, const page_mesh *mesh) {
    fputs(",\"mesh\":{\"points\":", file);
    page_base64 to = page_base64_begin(file);
    for (size_t i = 0; i < 3 * mesh->point_count; i++) page_base64_add_float(&to, mesh->points[i]);
    page_base64_end(&to);
    fputs(",\"triangles\":", file);
    to = page_base64_begin(file);
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++) page_base64_add_uint32(&to, mesh->triangles[i]);
    page_base64_end(&to);
    fputc('}', file);
}

/// Writes the points and triangles of a solid as its proofs name them: in full precision and in their order.
static void write_solid(FILE *file, const ovoid_solid *solid) {
    ovoid_solid_report report = ovoid_solid_get_report(solid);
    const double *points = ovoid_solid_get_points(solid);
    fputs(",\"solid\":{\"points\":", file);
    page_base64 to = page_base64_begin(file);
    for (size_t i = 0; i < 3 * (size_t)report.points; i++) page_base64_add_double(&to, points[i]);
    page_base64_end(&to);
    fputs(",\"triangles\":", file);
    to = page_base64_begin(file);
    for (size_t t = 0; t < (size_t)report.triangles; t++) {
        uint32_t corners[3];
        ovoid_solid_get_triangle(solid, t, corners);
        for (int i = 0; i < 3; i++) page_base64_add_uint32(&to, corners[i]);
    }
    page_base64_end(&to);
    fputc('}', file);
}

static ovoid_vec3 get_middle(const ovoid_polytope *p, const uint32_t *corners) {
    ovoid_vec3 sum = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        const double *x = p->vertices + 3 * (size_t)corners[i];
        sum.x += x[0] / 3, sum.y += x[1] / 3, sum.z += x[2] / 3;
    }
    return sum;
}

/// Writes the area that contains the middle of each triangle.
static void write_areas(FILE *file, const ovoid_shape *shape) {
    page_areas areas = page_areas_make(shape);
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    if (!areas.is_there || !p.triangle_count) return;
    fputs(",\"areas\":", file);
    page_base64 to = page_base64_begin(file);
    for (size_t t = 0; t < p.triangle_count; t++) {
        unsigned char octant = (unsigned char)page_areas_get_octant(&areas, get_middle(&p, p.triangles + 3 * t));
        page_base64_add_bytes(&to, &octant, 1);
    }
    page_base64_end(&to);
}

int page_shapes_write(const page_shapes *s, FILE *file) {
    fputs(",\"shapes\":[", file);
    for (size_t i = 0; i < s->count; i++) {
        if (i) fputc(',', file);
        if (!write_bytes(file, s->items[i])) return message_error("out of memory"), EXIT_INPUT;
        if (s->meshes[i].points) write_mesh(file, &s->meshes[i]);
        if (s->meshes[i].solid) write_solid(file, s->meshes[i].solid);
        write_areas(file, s->items[i]);
        fputc('}', file);
    }
    fputc(']', file);
    return 0;
}
