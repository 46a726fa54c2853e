// A shape from vertices and faces that are stated to be a convex polyhedron. The checks:
//
// (1) Indices are in range, faces have three corners or more, no corner twice. Equal points count as one.
// (2) The surface is closed and oriented: every edge occurs once in each direction.
// (3) Every face supports the body: no vertex is farther above the face's plane than the largest distance of the face's
// own corners from it, or than 64 roundings of the largest coordinate if that is more. The plane is Newell's, through
// the mean corner. A face lower than that has no plane of its own and is not tested.
//
// By (3) every face lies on the boundary of the hull, as far as it is flat itself, and a closed oriented surface in
// that boundary that uses no edge twice covers it once. The shape is then the hull of the vertices.
//
// The vertex that is highest above a face is found by climbing from edge to edge of the hull, which is exactly convex.
// Cost: linear in the faces' corners, times the climb.
#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "linear/vec3.h"
#include "polytope/facets.h"
#include "polytope/hull.h"
#include "polytope/points.h"
#include "shape/create.h"
#include "tools/hash.h"

#include <string.h>

#define NOTHING UINT32_MAX

// The largest number of corners of all faces together: a hash table holds as many directed edges.
#define CORNERS_MAX ((size_t)1 << 28)

typedef struct checker {
    const ovoid_faces *faces;
    const hull *hull;
    const ovoid_allocator *allocator;
    ovoid_error *error;
    uint32_t *first; // for each vertex the first one that equals it
    size_t corners;  // of all faces
    double scale;    // 1 over the body's size, a power of two, so that no area underflows
} checker;

// ---- (1) ----

static ovoid_code validate_face(const ovoid_faces *f, size_t face, size_t at, ovoid_error *error) {
    int64_t place = (int64_t)face;
    if (f->sizes[face] < 3)
        return error_set(error, OVOID_ERROR_NOT_CONVEX, place, "face %zu has %u corners; at least 3 are needed", face,
                         f->sizes[face]);
    for (size_t i = at; i < at + f->sizes[face]; i++)
        if (f->indices[i] >= f->vertex_count)
            return error_set(error, OVOID_ERROR_INDEX, place, "face %zu: vertex %u of %zu does not exist", face,
                             f->indices[i], f->vertex_count);
    return OVOID_OK;
}

static ovoid_code validate_indices(checker *c) {
    const ovoid_faces *f = c->faces;
    for (size_t face = 0; face < f->face_count; face++) {
        if (f->sizes[face] > CORNERS_MAX - c->corners)
            return error_set(c->error, OVOID_ERROR_LIMIT, (int64_t)face, "more than %zu corners of faces", CORNERS_MAX);
        ovoid_code code = validate_face(f, face, c->corners, c->error);
        if (code) return code;
        c->corners += f->sizes[face];
    }
    return OVOID_OK;
}

// ---- (2) ----

// A directed edge of a face.
typedef struct edge {
    uint32_t from, to, face;
} edge;

typedef struct edge_table {
    edge *slots; // face is NOTHING in an empty slot
    size_t mask;
} edge_table;

static int is_end(const void *table, size_t slot, const void *key) {
    const edge *held = (const edge *)table + slot, *wanted = key;
    return held->face == NOTHING || (held->from == wanted->from && held->to == wanted->to);
}

// The slot of the edge, or the empty slot where it belongs.
static edge *find_edge(const edge_table *t, uint32_t from, uint32_t to) {
    return &t->slots[hash_find(hash_pair(from, to), t->mask + 1, t->slots, &(edge){from, to, 0}, is_end)];
}

static ovoid_code add_edges(const checker *c, edge_table *t) {
    const uint32_t *corner = c->faces->indices;
    for (size_t face = 0; face < c->faces->face_count; corner += c->faces->sizes[face++])
        for (uint32_t i = 0; i < c->faces->sizes[face]; i++) {
            uint32_t from = c->first[corner[i]], to = c->first[corner[i + 1 < c->faces->sizes[face] ? i + 1 : 0]];
            if (from == to)
                return error_set(c->error, OVOID_ERROR_NOT_CONVEX, (int64_t)face,
                                 "face %zu has the same corner, vertex %u, twice in a row", face, corner[i]);
            edge *e = find_edge(t, from, to);
            if (e->face != NOTHING)
                return error_set(c->error, OVOID_ERROR_NOT_CONVEX, (int64_t)face,
                                 "faces %u and %zu run through the edge from vertex %u to %u in the same direction",
                                 e->face, face, from, to);
            *e = (edge){from, to, (uint32_t)face};
        }
    return OVOID_OK;
}

// Refuses the first face, in the given order, that has an edge without a face beyond it.
static ovoid_code validate_edges(const checker *c, const edge_table *t) {
    const uint32_t *corner = c->faces->indices;
    for (size_t face = 0; face < c->faces->face_count; corner += c->faces->sizes[face++])
        for (uint32_t i = 0; i < c->faces->sizes[face]; i++) {
            uint32_t from = c->first[corner[i]], to = c->first[corner[i + 1 < c->faces->sizes[face] ? i + 1 : 0]];
            if (find_edge(t, to, from)->face == NOTHING)
                return error_set(c->error, OVOID_ERROR_NOT_CONVEX, (int64_t)face,
                                 "the surface is open: no face is beyond the edge from vertex %u to %u of face %zu",
                                 from, to, face);
        }
    return OVOID_OK;
}

static ovoid_code validate_closed(const checker *c) {
    edge_table t = {NULL, 16};
    while (t.mask < 2 * c->corners) t.mask *= 2;
    t.slots = allocator_allocate(c->allocator, t.mask, sizeof *t.slots);
    if (!t.slots) return error_set(c->error, OVOID_ERROR_MEMORY, -1, "no memory for %zu edges", c->corners);
    memset(t.slots, 0xff, t.mask * sizeof *t.slots);
    t.mask--;
    ovoid_code code = add_edges(c, &t);
    if (!code) code = validate_edges(c, &t);
    allocator_release(c->allocator, t.slots);
    return code;
}

// ---- (3) ----

// Corners of faces and vertices of the hull, in units of the body's size.
static vec3 get_corner(const checker *c, uint32_t corner) {
    return vec3_scale(vec3_sub(vec3_at(c->faces->vertices, corner), c->hull->origin), c->scale);
}

static vec3 get_vertex(const checker *c, uint32_t vertex) {
    return vec3_scale(vec3_at(c->hull->vertices, vertex), c->scale);
}

// The plane of a face.
typedef struct face_plane {
    vec3 normal, middle; // unit; the mean corner
    double flatness;     // the largest distance of a corner from it
    double height, area; // twice the area over the face's length; twice the area
} face_plane;

static face_plane make_plane(const checker *c, const uint32_t *corner, uint32_t count) {
    face_plane p = {{0, 0, 0}, {0, 0, 0}, 0, 0, 0};
    vec3 start = get_corner(c, corner[0]), sum = {0, 0, 0}, area = {0, 0, 0};
    double reach = 0;
    for (uint32_t i = 1; i < count; i++) {
        vec3 d = vec3_sub(get_corner(c, corner[i]), start);
        sum = vec3_add_scaled(sum, d, 1.0 / count);
        reach = fmax(reach, vec3_norm(d));
        if (i + 1 < count) area = vec3_add(area, vec3_cross(d, vec3_sub(get_corner(c, corner[i + 1]), start)));
    }
    p.middle = vec3_add(start, sum);
    p.normal = vec3_unit(area);
    p.area = vec3_norm(area);
    p.height = reach > 0 ? p.area / reach : 0;
    for (uint32_t i = 0; i < count; i++)
        p.flatness = fmax(p.flatness, fabs(vec3_dot(p.normal, vec3_sub(get_corner(c, corner[i]), p.middle))));
    return p;
}

// The vertex of the hull that is highest along n, by climbing from `start`; for a flat body by a search of all
// vertices.
static uint32_t find_highest(const checker *c, vec3 n, uint32_t start) {
    const hull *polytope = c->hull;
    uint32_t best = start, from;
    double top = vec3_dot(n, get_vertex(c, best));
    do {
        from = best;
        uint32_t first = polytope->rank < 3 ? 0 : polytope->neighbor_starts[from];
        uint32_t end = polytope->rank < 3 ? polytope->vertex_count : polytope->neighbor_starts[from + 1];
        for (uint32_t i = first; i < end; i++) {
            uint32_t v = polytope->rank < 3 ? i : polytope->neighbors[i];
            double height = vec3_dot(n, get_vertex(c, v));
            if (height > top) top = height, best = v;
        }
    } while (best != from && polytope->rank == 3);
    return best;
}

// Six times the volume, as the sum of the cones from the hull's first vertex: negative if faces are clockwise from
// outside.
static double compute_volume(const checker *c) {
    double volume = 0;
    const uint32_t *corner = c->faces->indices;
    vec3 apex = get_vertex(c, 0);
    for (size_t face = 0; face < c->faces->face_count; corner += c->faces->sizes[face++]) {
        face_plane p = make_plane(c, corner, c->faces->sizes[face]);
        volume += vec3_dot(p.normal, vec3_sub(p.middle, apex)) * p.area;
    }
    return volume;
}

static ovoid_code validate_face_plane(const checker *c, size_t face, const face_plane *p, uint32_t *highest) {
    if (p->height <= FACET_FLATNESS) return OVOID_OK;
    *highest = find_highest(c, p->normal, *highest);
    double above = vec3_dot(p->normal, vec3_sub(get_vertex(c, *highest), p->middle));
    if (above <= fmax(p->flatness, FACET_FLATNESS)) return OVOID_OK;
    return error_set(c->error, OVOID_ERROR_NOT_CONVEX, (int64_t)face,
                     "face %zu is not part of the hull: a vertex is %g above its plane, its own corners are within %g",
                     face, above / c->scale, p->flatness / c->scale);
}

static ovoid_code validate_convex(checker *c) {
    c->scale = ldexp(1, -find_unit_exponent(compute_extent(c->hull->vertices, c->hull->vertex_count)));
    if (compute_volume(c) < -FACET_FLATNESS)
        return error_set(c->error, OVOID_ERROR_NOT_CONVEX, -1,
                         "the faces are inside out: corners must run counter-clockwise as seen from outside");
    const uint32_t *corner = c->faces->indices;
    uint32_t highest = 0;
    ovoid_code code = OVOID_OK;
    for (size_t face = 0; face < c->faces->face_count && !code; corner += c->faces->sizes[face++]) {
        face_plane p = make_plane(c, corner, c->faces->sizes[face]);
        code = validate_face_plane(c, face, &p, &highest);
    }
    return code;
}

// ----

static ovoid_code validate_surface(checker *c) {
    size_t count = c->faces->vertex_count;
    c->first = allocator_allocate(c->allocator, count, sizeof *c->first);
    ovoid_code code = OVOID_ERROR_MEMORY;
    if (c->first && points_find_first(c->faces->vertices, count, c->allocator, c->first))
        code = validate_closed(c);
    else
        error_write(c->error, code, -1, "no memory for %zu vertices", count);
    if (!code) code = validate_convex(c);
    allocator_release(c->allocator, c->first);
    return code;
}

static int is_argument(const ovoid_faces *f, ovoid_error *error) {
    if (!f)
        error_write(error, OVOID_ERROR_ARGUMENT, -1, "the faces are NULL");
    else if (f->vertex_count == 0)
        error_write(error, OVOID_ERROR_EMPTY, -1, "no points");
    else if (f->face_count == 0)
        error_write(error, OVOID_ERROR_EMPTY, -1, "no faces");
    else if (!f->vertices || !f->indices || !f->sizes)
        error_write(error, OVOID_ERROR_ARGUMENT, -1, "an array of the faces is NULL");
    else if (f->vertex_count > POINTS_MAX || f->face_count > CORNERS_MAX / 3)
        error_write(error, OVOID_ERROR_LIMIT, -1, "%zu vertices and %zu faces; at most %zu and %zu are taken",
                    f->vertex_count, f->face_count, POINTS_MAX, CORNERS_MAX / 3);
    else
        return 1;
    return 0;
}

static ovoid_shape *create_from_faces(const ovoid_faces *faces, const ovoid_shape_options *options,
                                      ovoid_error *error) {
    ovoid_shape_options o;
    if (shape_options_make(options, &o, error) || !is_argument(faces, error)) return NULL;
    ovoid_allocator allocator = allocator_make(o.allocator);
    checker c = {.faces = faces, .allocator = &allocator, .error = error};
    hull polytope;
    const xyz_points given = {faces->vertices, faces->vertex_count};
    if (validate_indices(&c) || hull_create(given, &allocator, &polytope, error)) return NULL;
    c.hull = &polytope;
    polytope.report.faces = faces->face_count;
    ovoid_shape *shape = validate_surface(&c) ? NULL : shape_create_from_hull(&polytope, &o, &allocator, error);
    hull_destroy(&polytope, &allocator);
    return shape;
}

ovoid_shape *ovoid_shape_create_from_faces(const ovoid_faces *faces, const ovoid_shape_options *options,
                                           ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_shape *, faces, create_from_faces(faces, options, error));
}
