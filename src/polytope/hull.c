// From points to a polytope: points.h makes them distinct, quickhull.h finds the extreme ones and then the hull of
// these alone, so that triangles, facets and adjacency depend only on the vertices; some bodies have a closed form.
// Bodies whose thickness is only rounding get a lower rank, but keep every extreme point.
#include "polytope/hull.h"

#include "base/allocator.h"
#include "base/error.h"
#include "polytope/centered_box.h"
#include "polytope/facets.h"
#include "polytope/points.h"
#include "polytope/polygon.h"
#include "polytope/quickhull.h"
#include "polytope/surface_proof.h"

#include <string.h>

typedef struct builder {
    const double *xyz; // as given
    points p;          // the distinct points; in the end the vertices
    surface s;         // their hull
    hull *hull;        // the result
    ovoid_report report;
    const ovoid_allocator *allocator;
    ovoid_error *error;
} builder;

// ---- which points are extreme ----

// Drops the points that are not extreme and finds the hull of the rest again, until all are.
static ovoid_code find_solid(builder *b) {
    points *p = &b->p;
    surface *s = &b->s;
    for (;;) {
        ovoid_code code = quickhull_create(p, b->allocator, s, b->error);
        if (code || s->rank < 3) return code;
        uint32_t extreme = 0;
        for (uint32_t i = 0; i < p->count; i++) {
            b->report.coplanar += s->state[i] == POINT_ON_FACE;
            extreme += s->state[i] == POINT_EXTREME;
            s->state[i] = s->state[i] == POINT_EXTREME;
        }
        if (extreme == p->count) return OVOID_OK;
        points_keep(p, s->state);
        surface_destroy(s, b->allocator);
    }
}

// Keeps the listed points; all others lie on the body's boundary.
static ovoid_code keep_only(builder *b, const uint32_t *list, uint32_t count) {
    uint8_t *keep = allocator_allocate(b->allocator, b->p.count, 1);
    if (!keep) return OVOID_ERROR_MEMORY;
    memset(keep, 0, b->p.count);
    for (uint32_t i = 0; i < count; i++) keep[list[i]] = 1;
    b->report.coplanar += b->p.count - count;
    points_keep(&b->p, keep);
    allocator_release(b->allocator, keep);
    return OVOID_OK;
}

// The axis for the projection of a flat body: among those along which three points do not appear collinear, by exact
// signs, the one along which they span the largest area, to rounding. Any axis if the points are collinear.
static int find_axis(const points *p, const uint32_t corner[3]) {
    vec3 c[3];
    for (int i = 0; i < 3; i++) c[i] = vec3_at(p->grid, corner[i]);
    vec3 n = compute_area(c[0], c[1], c[2]);
    int best = vec3_find_largest(vec3_abs(n));
    for (int i = 0; i < 3; i++)
        if (orient2d_sign(c[0], c[1], c[2], (best + i) % 3)) return (best + i) % 3;
    return best;
}

// The corners of an exactly flat body.
static ovoid_code find_flat(builder *b) {
    uint32_t *loop = allocator_allocate(b->allocator, b->p.count, sizeof *loop);
    if (!loop) return OVOID_ERROR_MEMORY;
    uint32_t count = polygon_find_loop(&b->p, find_axis(&b->p, b->s.corner), loop, b->allocator);
    ovoid_code code = count ? keep_only(b, loop, count) : OVOID_ERROR_MEMORY;
    allocator_release(b->allocator, loop);
    return code;
}

// Drops all points that are not extreme; the surface is that of the others.
static ovoid_code find_extreme(builder *b) {
    ovoid_code code = find_solid(b);
    if (code || b->s.rank == 3) return code;
    code = b->s.rank == 2 ? find_flat(b) : keep_only(b, b->s.corner, b->s.rank + 1);
    if (code) return error_set(b->error, code, -1, "no memory for a flat hull of %u points", b->p.count);
    return quickhull_create(&b->p, b->allocator, &b->s, b->error);
}

// ---- rank, facets and adjacency ----

// The largest distance of a vertex from the line through the first two corners of the simplex.
static double compute_line_distance(const points *p, const uint32_t end[2]) {
    vec3 a = vec3_at(p->grid, end[0]), n = vec3_unit(vec3_sub(vec3_at(p->grid, end[1]), a));
    double width = 0;
    for (uint32_t i = 0; i < p->count; i++)
        width = max2(width, vec3_norm(vec3_cross(n, vec3_sub(vec3_at(p->grid, i), a))));
    return width;
}

// 1 if the ball in the first simplex, of diameter 6 volume / surface, shows that no width of the body is near the
// flatness. Six volumes are computed to 10 roundings of a product of edges, which are at most 2 sqrt(3) extents.
static int is_thick(const points *p, const uint32_t corner[4], double extent) {
    vec3 a = vec3_at(p->grid, corner[0]), e[3], faces[4];
    for (int i = 0; i < 3; i++) e[i] = vec3_sub(vec3_at(p->grid, corner[i + 1]), a);
    for (int i = 0; i < 3; i++) faces[i] = vec3_cross(e[i], e[(i + 1) % 3]);
    faces[3] = vec3_add(faces[0], vec3_add(faces[1], faces[2]));
    double area = 0, volume = fabs(vec3_dot(faces[0], e[2])), size = extent * extent * extent;
    for (int i = 0; i < 4; i++) area += vec3_norm(faces[i]);
    return 2 * volume > 4 * FACET_FLATNESS * extent * area + 0x1p-40 * size;
}

// The rank to rounding, and the normal of a nearly flat body.
static uint32_t find_rank(const points *p, const surface *s, vec3 *normal) {
    double extent = compute_extent(p->grid, p->count), flatness = FACET_FLATNESS * extent;
    if (s->rank < 2) return s->rank;
    if (s->rank == 3 && is_thick(p, s->corner, extent)) return 3;
    if (compute_line_distance(p, s->corner) <= flatness) return 1;
    vec3 c[3];
    for (int i = 0; i < 3; i++) c[i] = vec3_at(p->grid, s->corner[i]);
    *normal = vec3_unit(compute_area(c[0], c[1], c[2]));
    if (s->rank == 2) return 2;
    thickness thin = surface_compute_thickness(s, p->grid, p->count);
    *normal = thin.normal;
    return thin.width <= flatness ? 2 : 3;
}

static int fill_vertices(const builder *b) {
    hull *polytope = b->hull;
    const points *p = &b->p;
    polytope->vertex_count = p->count;
    polytope->origin = p->origin;
    polytope->vertices = allocator_allocate(b->allocator, p->count, 3 * sizeof *polytope->vertices);
    if (!polytope->vertices) return 0;
    for (size_t i = 0; i < p->count; i++) {
        // + 0.0 makes every zero a positive one.
        vec3 v = vec3_sub(vec3_at(b->xyz, p->source[i]), p->origin);
        polytope->vertices[3 * i] = v.x + 0.0;
        polytope->vertices[3 * i + 1] = v.y + 0.0;
        polytope->vertices[3 * i + 2] = v.z + 0.0;
    }
    return 1;
}

// The edges of the surface become those of the hull.
static void take_edges(hull *polytope, surface *s) {
    polytope->neighbor_starts = s->edges.starts;
    polytope->neighbors = s->edges.neighbors;
    polytope->corner_edges = s->edges.corners;
    s->edges = (surface_edges){0};
}

static ovoid_code fill_solid(builder *b) {
    hull *polytope = b->hull;
    surface *s = &b->s;
    polytope->triangle_count = s->triangle_count;
    polytope->triangle_facets =
        allocator_allocate(b->allocator, polytope->triangle_count, sizeof *polytope->triangle_facets);
    if (!polytope->triangle_facets) return OVOID_ERROR_MEMORY;
    facets f = {.vertices = polytope->vertices, .of = polytope->triangle_facets};
    if (!facets_create(s, &b->p, &f, b->allocator)) return OVOID_ERROR_MEMORY;
    polytope->planes = f.planes;
    polytope->facet_count = f.count;
    // A proven surface has them.
    if (!s->edges.starts && !surface_find_edges(s, polytope->vertex_count, b->allocator)) return OVOID_ERROR_MEMORY;
    take_edges(polytope, s);
    polytope->triangles = s->triangles;
    s->triangles = NULL;
    return OVOID_OK;
}

// Joins each corner of a loop to the one before and the one after; if there are two, to each other.
static void join_loop(hull *polytope, const uint32_t *loop, uint32_t count) {
    uint32_t degree = count > 2 ? 2 : count - 1;
    for (uint32_t i = 0; i < count; i++) polytope->neighbor_starts[loop[i] + 1] = degree;
    for (uint32_t v = 0; v < polytope->vertex_count; v++)
        polytope->neighbor_starts[v + 1] += polytope->neighbor_starts[v];
    for (uint32_t i = 0; i < count && degree; i++) {
        uint32_t *neighbor = polytope->neighbors + polytope->neighbor_starts[loop[i]];
        neighbor[0] = loop[(i + count - 1) % count];
        neighbor[degree - 1] = loop[(i + 1) % count];
    }
}

// A fan of triangles from the first corner, and the plane on its side.
static ovoid_code fill_fan(const builder *b, const uint32_t *loop, uint32_t count, vec3 normal) {
    hull *polytope = b->hull;
    polytope->triangle_count = count - 2;
    polytope->facet_count = 1;
    polytope->triangles = allocator_allocate(b->allocator, polytope->triangle_count, 3 * sizeof *polytope->triangles);
    polytope->triangle_facets =
        allocator_allocate(b->allocator, polytope->triangle_count, sizeof *polytope->triangle_facets);
    polytope->planes = allocator_allocate(b->allocator, 1, sizeof *polytope->planes);
    if (!polytope->triangles || !polytope->triangle_facets || !polytope->planes) return OVOID_ERROR_MEMORY;
    for (uint32_t t = 0; t < polytope->triangle_count; t++) {
        polytope->triangles[3 * (size_t)t] = loop[0];
        polytope->triangles[3 * (size_t)t + 1] = loop[t + 1];
        polytope->triangles[3 * (size_t)t + 2] = loop[t + 2];
        polytope->triangle_facets[t] = 0;
    }
    double offset = -INFINITY;
    for (uint32_t i = 0; i < polytope->vertex_count; i++)
        offset = fmax(offset, vec3_dot(normal, vec3_at(polytope->vertices, i)));
    polytope->planes[0] = (ovoid_plane){normal, offset};
    return OVOID_OK;
}

// The loop of a flat body runs counter-clockwise as seen from the positive end of the axis nearest to its normal, so
// the normal is turned to that end too. Only a nearly flat body has vertices off the loop.
static ovoid_code fill_polygon(const builder *b, vec3 normal, uint32_t *loop) {
    int axis = vec3_find_largest(vec3_abs(normal));
    double side = vec3_get(normal, axis);
    uint32_t count = polygon_find_loop(&b->p, axis, loop, b->allocator);
    if (count < 3) return count ? OVOID_ERROR_HULL : OVOID_ERROR_MEMORY;
    join_loop(b->hull, loop, count);
    return fill_fan(b, loop, count, side < 0 ? vec3_neg(normal) : normal);
}

// Rank 0 to 2.
static ovoid_code fill_flat(const builder *b, vec3 normal) {
    hull *polytope = b->hull;
    size_t starts = (size_t)b->p.count + 1;
    uint32_t *loop = allocator_allocate(b->allocator, b->p.count, sizeof *loop);
    polytope->neighbor_starts = allocator_allocate(b->allocator, starts, sizeof *polytope->neighbor_starts);
    polytope->neighbors = allocator_allocate(b->allocator, b->p.count, 2 * sizeof *polytope->neighbors);
    ovoid_code code = loop && polytope->neighbor_starts && polytope->neighbors ? OVOID_OK : OVOID_ERROR_MEMORY;
    if (!code) memset(polytope->neighbor_starts, 0, starts * sizeof *polytope->neighbor_starts);
    if (!code && polytope->rank == 2) code = fill_polygon(b, normal, loop);
    if (!code && polytope->rank < 2) join_loop(polytope, b->s.corner, polytope->rank + 1);
    allocator_release(b->allocator, loop);
    return code;
}

static ovoid_code fill(builder *b) {
    vec3 normal = {0, 0, 0};
    ovoid_code code = OVOID_ERROR_MEMORY;
    int good = b->s.rank < 3 || surface_compute_areas(&b->s, b->p.grid, b->allocator);
    if (good) b->hull->rank = find_rank(&b->p, &b->s, &normal);
    if (good && fill_vertices(b)) code = b->hull->rank == 3 ? fill_solid(b) : fill_flat(b, normal);
    if (!code) return OVOID_OK;
    hull_destroy(b->hull, b->allocator);
    if (code == OVOID_ERROR_HULL)
        return error_set(b->error, code, -1, "no polygon is seen of a flat body of %u vertices", b->p.count);
    return error_set(b->error, code, -1, "no memory for a hull of %u vertices", b->p.count);
}

// Makes the hull from the remaining points and their surface, unless computing these failed; both are destroyed.
static ovoid_code finish(builder *b, size_t count, ovoid_code code) {
    hull *polytope = b->hull;
    if (!code) code = fill(b);
    if (!code) {
        polytope->report = b->report;
        polytope->report.points = count;
        polytope->report.duplicates = b->p.duplicates;
        polytope->report.vertices = b->p.count;
        polytope->report.interior = count - b->p.count - b->p.duplicates;
        polytope->report.rank = polytope->rank;
    }
    surface_destroy(&b->s, b->allocator);
    points_destroy(&b->p, b->allocator);
    return code;
}

// ---- closed forms ----

// The edges of an ellipsoid's grid are found.
static int allocate(hull *polytope, const ovoid_allocator *allocator) {
    uint32_t triangles = polytope->triangle_count;
    int has_edges = polytope->form.kind != FORM_ELLIPSOID;
    polytope->vertices = allocator_allocate(allocator, polytope->vertex_count, 3 * sizeof *polytope->vertices);
    polytope->triangles = allocator_allocate(allocator, triangles, 3 * sizeof *polytope->triangles);
    polytope->triangle_facets = allocator_allocate(allocator, triangles, sizeof *polytope->triangle_facets);
    polytope->planes = allocator_allocate(allocator, polytope->facet_count, sizeof *polytope->planes);
    if (!polytope->vertices || !polytope->triangles || !polytope->triangle_facets || !polytope->planes) return 0;
    if (!has_edges) return 1;
    polytope->neighbor_starts =
        allocator_allocate(allocator, (size_t)polytope->vertex_count + 1, sizeof *polytope->neighbor_starts);
    polytope->neighbors = allocator_allocate(allocator, triangles, 3 * sizeof *polytope->neighbors);
    return polytope->neighbor_starts && polytope->neighbors;
}

static void fill_box(hull *polytope) {
    memcpy(polytope->triangles, centered_box_triangles, sizeof centered_box_triangles);
    memcpy(polytope->triangle_facets, centered_box_triangle_facets, sizeof centered_box_triangle_facets);
    memcpy(polytope->neighbor_starts, centered_box_neighbor_starts, sizeof centered_box_neighbor_starts);
    memcpy(polytope->neighbors, centered_box_neighbors, sizeof centered_box_neighbors);
    centered_box_fill_planes(polytope->form.half, polytope->planes);
}

static void fill_regular(hull *polytope) {
    const regular_solid *s = &polytope->form.solid;
    regular_solid_fill_triangles(s, polytope->triangles, polytope->triangle_facets);
    regular_solid_fill_neighbors(s, polytope->neighbor_starts, polytope->neighbors);
    regular_solid_fill_planes(s, polytope->vertices, polytope->planes);
}

static int fill_ellipsoid(hull *polytope, const ovoid_allocator *allocator) {
    const ellipsoid_grid *g = &polytope->form.grid;
    ellipsoid_grid_fill_triangles(g, polytope->triangles, polytope->triangle_facets);
    ellipsoid_grid_fill_planes(g, polytope->triangles, polytope->vertices, polytope->planes);
    surface s = {.triangles = polytope->triangles, .triangle_count = polytope->triangle_count};
    int is_done = surface_find_edges(&s, polytope->vertex_count, allocator);
    take_edges(polytope, &s);
    return is_done;
}

// 0 if there is no memory.
static int fill_closed(const builder *b) {
    hull *polytope = b->hull;
    // + 0.0 makes every zero a positive one.
    for (size_t i = 0; i < 3 * (size_t)polytope->vertex_count; i++) polytope->vertices[i] = b->xyz[i] + 0.0;
    if (polytope->form.kind == FORM_ELLIPSOID) return fill_ellipsoid(polytope, b->allocator);
    if (polytope->form.kind == FORM_BOX)
        fill_box(polytope);
    else
        fill_regular(polytope);
    return 1;
}

static void count_closed(hull *polytope) {
    const closed_form *form = &polytope->form;
    if (form->kind == FORM_BOX) {
        polytope->triangle_count = BOX_TRIANGLES;
        polytope->facet_count = BOX_FACETS;
    } else if (form->kind == FORM_ELLIPSOID) {
        polytope->triangle_count = polytope->facet_count = ellipsoid_grid_count_triangles(form->grid.steps);
    } else {
        polytope->triangle_count = regular_solid_count_triangles(&form->solid);
        polytope->facet_count = regular_solid_count_facets(&form->solid);
    }
}

static ovoid_code create_closed(const builder *b, size_t count, const closed_form *form) {
    hull *polytope = b->hull;
    polytope->form = *form;
    polytope->vertex_count = (uint32_t)count;
    count_closed(polytope);
    polytope->rank = 3;
    polytope->report = (ovoid_report){.points = count, .vertices = count, .rank = 3};
    if (!allocate(polytope, b->allocator) || !fill_closed(b)) {
        hull_destroy(polytope, b->allocator);
        return error_set(b->error, OVOID_ERROR_MEMORY, -1, "no memory for a hull of %zu vertices", count);
    }
    return OVOID_OK;
}

// Makes the hull in closed form if the claim is that of the closed form, which needs no proof. 0 if it is another one.
static int create_if_closed(const builder *b, const surface_claim *claim, ovoid_code *code) {
    closed_form form = closed_form_find(claim->xyz, claim->count);
    if (form.kind == FORM_NONE) return 0;
    *code = create_closed(b, claim->count, &form);
    size_t size = 3 * sizeof *claim->triangles * claim->triangle_count;
    if (*code != OVOID_OK) return 1;
    if (b->hull->triangle_count == claim->triangle_count && memcmp(b->hull->triangles, claim->triangles, size) == 0)
        return 1;
    hull_destroy(b->hull, b->allocator);
    return 0;
}

ovoid_code hull_create(xyz_points given, const ovoid_allocator *allocator, hull *polytope, ovoid_error *error) {
    *polytope = (hull){0};
    builder b = {.xyz = given.xyz, .hull = polytope, .allocator = allocator, .error = error};
    closed_form form = closed_form_find(given.xyz, given.count);
    if (form.kind != FORM_NONE) return create_closed(&b, given.count, &form);
    ovoid_code code = points_create(given, allocator, &b.p, error);
    return code ? code : finish(&b, given.count, find_extreme(&b));
}

ovoid_code hull_create_proven(const surface_claim *claim, const ovoid_allocator *allocator, hull *polytope,
                              surface_flaw *flaw) {
    *polytope = (hull){0};
    *flaw = (surface_flaw){"the vertices have no hull", 0, 1};
    builder b = {.xyz = claim->xyz, .hull = polytope, .allocator = allocator};
    ovoid_code code;
    if (create_if_closed(&b, claim, &code)) return code;
    code = points_create_distinct((xyz_points){claim->xyz, claim->count}, allocator, &b.p, NULL);
    if (code) return code == OVOID_ERROR_MEMORY ? code : OVOID_ERROR_HULL;
    return finish(&b, claim->count, surface_create_proven(claim, &b.p, allocator, &b.s, flaw));
}

void hull_destroy(hull *polytope, const ovoid_allocator *allocator) {
    allocator_release(allocator, polytope->vertices);
    allocator_release(allocator, polytope->triangles);
    allocator_release(allocator, polytope->triangle_facets);
    allocator_release(allocator, polytope->neighbor_starts);
    allocator_release(allocator, polytope->neighbors);
    allocator_release(allocator, polytope->planes);
    allocator_release(allocator, polytope->corner_edges);
    *polytope = (hull){0};
}

ovoid_polytope hull_get_polytope(const hull *polytope) {
    return (ovoid_polytope){.vertices = polytope->vertices,
                            .triangles = polytope->triangles,
                            .triangle_facets = polytope->triangle_facets,
                            .planes = polytope->planes,
                            .neighbor_starts = polytope->neighbor_starts,
                            .neighbors = polytope->neighbors,
                            .origin = polytope->origin,
                            .vertex_count = polytope->vertex_count,
                            .triangle_count = polytope->triangle_count,
                            .facet_count = polytope->facet_count,
                            .rank = polytope->rank};
}
