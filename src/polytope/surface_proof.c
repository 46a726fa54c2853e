// The proof that triangles are the boundary of a hull, by looking at each of them and at each edge once.
//
// Theorem. Let triangles be given in which each directed edge occurs once, and once in the opposite direction, and a
// point c, such that
//   (1) c is strictly below the plane of each triangle, as seen from its counter-clockwise side;
//   (2) the surface winds around c once;
//   (3) at each edge the far corner of either triangle is not above the plane of the other.
// Then the triangles are the boundary of the hull of their corners, each part of it covered once.
//
// Proof. Seen from c, by (1), every triangle covers a spherical triangle, all with one orientation, and the two at an
// edge lie on either side of it: a point that moves over the sphere and crosses an edge leaves one triangle and enters
// one. So all directions but those of edges are covered equally often, and by (2) once: the triangles bound a body that
// is star-shaped about c. Take two points in its interior such that the plane through them and c meets no vertex; the
// others are limits of these. The plane cuts the body in a polygon, star-shaped about c, whose corners lie on edges, so
// that none of its angles is above 180 degrees, by (3). Such a polygon is convex, and the segment between the points
// lies in it. A body that is convex is the hull of its corners.
//
// (4) A vertex of it is extreme if and only if at least three of its edges are creases, at which the triangles are not
// coplanar: with no crease it lies inside a face, with two inside an edge; one crease alone is not possible.
//
// By (2) points that are equal are refused too: the map to the sphere is one-to-one.
//
// The conditions are those of K. Mehlhorn, S. Naeher, M. Seel, R. Seidel, T. Schilz, S. Schirra, C. Uhrig, Checking
// geometric programs or verification of geometric structures, 1999, section 2, with faces that are cut into coplanar
// triangles; that local convexity is enough goes back to H. Tietze, Ueber Konvexheit im kleinen und im grossen, 1928.
// Without (2) the great icosahedron would pass: 12 vertices and 20 triangles, as the icosahedron has, convex at each
// edge, but wound seven times around its centre. Signs are exact (linear/exact.h).
//
// Cost: linear; per triangle one sign for (1), three for (3); mostly doubles show them.
#include "polytope/surface_proof.h"

#include "base/allocator.h"
#include "linear/both.h"
#include "linear/exact.h"
#include "polytope/facets.h"
#include "polytope/winding.h"

#include <string.h>

typedef struct prover {
    const surface_claim *claim;
    const points *p;
    surface *s;
    surface_flaw *flaw;
    const ovoid_allocator *allocator;
    vec3 inside;      // in units of the grid
    uint32_t *places; // of each vertex: of the next edge to it in its list; later its edges that are no creases
    uint32_t *sides;  // of each edge: its corner
    double bound;     // of the rounding of heights over triangles
} prover;

static ovoid_code refuse(const prover *w, uint32_t triangle, const char *what) {
    *w->flaw = (surface_flaw){what, triangle, 0};
    return OVOID_ERROR_HULL;
}

static ovoid_code refuse_vertex(const prover *w, uint32_t vertex, const char *what) {
    *w->flaw = (surface_flaw){what, vertex, 1};
    return OVOID_ERROR_HULL;
}

// ---- edges ----

static uint32_t get_degree(const prover *w, uint32_t v) { return w->s->edges.starts[v + 1] - w->s->edges.starts[v]; }

static ovoid_code verify_corners(const prover *w) {
    for (uint32_t e = 0; e < 3 * w->s->triangle_count; e++)
        if (w->s->triangles[e] >= w->p->count) return refuse(w, e / 3, "a corner of a triangle is no vertex");
    return OVOID_OK;
}

// Writes for each edge its corner, 4 times the triangle + its number there.
static void list_sides(const prover *w) {
    for (uint32_t t = 0; t < w->s->triangle_count; t++)
        for (uint32_t k = 0; k < 3; k++) w->sides[w->s->edges.corners[3 * (size_t)t + k]] = 4 * t + k;
}

// Finds the triangle across each edge out of vertex v. Vertices are taken in their order, and lists of neighbors
// ascend. So the edges that lead to one vertex are met in the order of its list, if each of them has one back:
// w->places moves along each list.
static ovoid_code find_across_at(const prover *w, uint32_t v) {
    const surface_edges *edges = &w->s->edges;
    for (uint32_t i = edges->starts[v]; i < edges->starts[v + 1]; i++) {
        uint32_t to = edges->neighbors[i], side = w->sides[i], back = w->places[to]++;
        if (i > edges->starts[v] && edges->neighbors[i - 1] == to)
            return refuse(w, side / 4, "two triangles run through an edge in the same direction");
        if (back >= edges->starts[to + 1] || edges->neighbors[back] != v)
            return refuse(w, side / 4, "the surface is open: no triangle is beyond an edge");
        w->s->across[3 * (size_t)(side / 4) + side % 4] = w->sides[back];
    }
    return OVOID_OK;
}

static ovoid_code find_across(const prover *w) {
    for (uint32_t v = 0; v < w->p->count; v++)
        if (get_degree(w, v) == 0) return refuse_vertex(w, v, "a vertex is on no triangle");
    list_sides(w);
    memcpy(w->places, w->s->edges.starts, w->p->count * sizeof *w->places);
    for (uint32_t v = 0; v < w->p->count; v++) {
        ovoid_code code = find_across_at(w, v);
        if (code) return code;
    }
    return OVOID_OK;
}

// ---- convexity ----

// A plane through three corners; heights over it are bounded as those of quickhull.
typedef struct side {
    vec3 corner[3], normal;
    double bound;
} side;

// The exact sign of the height of a point over the plane.
static int get_side(const side *f, vec3 p) {
    double height = vec3_dot(f->normal, vec3_sub(p, f->corner[2]));
    if (fabs(height) > f->bound) return height > 0 ? 1 : -1;
    return -orient3d_sign(f->corner[0], f->corner[1], f->corner[2], p);
}

// 1 if the inside and the corners beyond the three edges are below the plane, as doubles show them to be mostly.
static int is_clear(const prover *w, const side *f, uint32_t t) {
    vec3 beyond[3];
    for (uint32_t k = 0; k < 3; k++) beyond[k] = vec3_at(w->p->grid, surface_get_beyond(w->s, t, k));
    both_vec3 n = both_vec3_make(f->normal, f->normal), corner = both_vec3_make(f->corner[2], f->corner[2]);
    both first = both_vec3_dot(n, both_vec3_sub(both_vec3_make(w->inside, beyond[0]), corner));
    both second = both_vec3_dot(n, both_vec3_sub(both_vec3_make(beyond[1], beyond[2]), corner));
    both bound = both_set(-f->bound);
    both_bits below = (first < bound) & (second < bound);
    return (below[0] & below[1]) != 0;
}

// (1) and (3): where doubles do not show them, each edge is looked at from the triangle with the smaller number.
static ovoid_code verify_triangle(const prover *w, uint32_t t) {
    const surface *s = w->s;
    const uint32_t *corner = s->triangles + 3 * (size_t)t;
    side f = {.bound = w->bound};
    for (int k = 0; k < 3; k++) f.corner[k] = vec3_at(w->p->grid, corner[k]);
    f.normal = vec3_cross(vec3_sub(f.corner[0], f.corner[2]), vec3_sub(f.corner[1], f.corner[2]));
    if (is_clear(w, &f, t)) return OVOID_OK;
    if (get_side(&f, w->inside) >= 0) return refuse(w, t, "a triangle does not face outward");
    for (uint32_t k = 0; k < 3; k++) {
        if (surface_get_across(s, t, k) < t) continue;
        int sign = get_side(&f, vec3_at(w->p->grid, surface_get_beyond(s, t, k)));
        if (sign > 0) return refuse(w, t, "the surface is not convex at an edge");
        if (sign < 0) continue;
        w->places[corner[k]]++;
        w->places[corner[(k + 1) % 3]]++;
    }
    return OVOID_OK;
}

static ovoid_code verify_convex(const prover *w) {
    memset(w->places, 0, w->p->count * sizeof *w->places);
    for (uint32_t t = 0; t < w->s->triangle_count; t++) {
        ovoid_code code = verify_triangle(w, t);
        if (code) return code;
    }
    ovoid_polytope p = {.vertices = w->claim->xyz,
                        .triangles = w->s->triangles,
                        .vertex_count = w->p->count,
                        .triangle_count = w->s->triangle_count};
    if (polytope_compute_winding(&p, w->claim->inside) != 1)
        return refuse(w, 0, "the surface does not wind once around its inside");
    for (uint32_t v = 0; v < w->p->count; v++)
        if (get_degree(w, v) - w->places[v] < 3) return refuse_vertex(w, v, "a vertex is not extreme");
    return OVOID_OK;
}

// ----

static ovoid_code prove(prover *w) {
    simplex_find(w->p, w->s);
    if (w->s->rank < 3) return refuse_vertex(w, 0, "the vertices lie in a plane");
    // The vertices are below 2^240 there; much farther out, signs would overflow.
    if (!(vec3_max_abs(w->inside) <= 0x1p241)) return refuse(w, 0, "the surface does not wind once around its inside");
    box whole = box_make_around(w->p->grid, w->p->count);
    whole = box_add_point(&whole, w->inside);
    w->bound = quickhull_bound_heights(&whole);
    memcpy(w->s->triangles, w->claim->triangles, 3 * (size_t)w->s->triangle_count * sizeof *w->s->triangles);
    ovoid_code code = verify_corners(w);
    if (!code && !surface_find_edges(w->s, w->p->count, w->allocator)) code = OVOID_ERROR_MEMORY;
    if (!code) code = find_across(w);
    return code ? code : verify_convex(w);
}

ovoid_code surface_create_proven(const surface_claim *claim, const points *p, const ovoid_allocator *allocator,
                                 surface *s, surface_flaw *flaw) {
    *s = (surface){.triangle_count = claim->triangle_count};
    prover w = {.claim = claim,
                .p = p,
                .s = s,
                .flaw = flaw,
                .allocator = allocator,
                .inside = points_to_grid(p, claim->inside)};
    size_t edges = 3 * (size_t)claim->triangle_count, count = p->count;
    s->triangles = allocator_allocate(allocator, edges, sizeof *s->triangles);
    s->across = allocator_allocate(allocator, edges, sizeof *s->across);
    w.places = allocator_allocate(allocator, count + edges, sizeof *w.places);
    ovoid_code code = OVOID_ERROR_MEMORY;
    if (s->triangles && s->across && w.places) {
        w.sides = w.places + count;
        code = prove(&w);
    }
    allocator_release(allocator, w.places);
    if (code) surface_destroy(s, allocator);
    return code;
}
