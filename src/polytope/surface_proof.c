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
// Cost: linear; per triangle one sign for (1), one and a half for (3).
#include "polytope/surface_proof.h"

#include "base/allocator.h"
#include "linear/exact.h"
#include "polytope/winding.h"

#include <string.h>

typedef struct prover {
    const surface_claim *claim;
    const points *p;
    surface *s;
    surface_flaw *flaw;
    vec3 inside;      // in units of the grid
    uint32_t *starts; // of each vertex: its first edge in the lists below; one more at the end
    uint32_t *end;    // of each vertex: the end of its list as it grows; later its edges that are no creases
    uint32_t *edges;  // the lists
    uint64_t steps;   // along lists
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

// Edge 3 t + i goes from corner i of triangle t to the next one.
static size_t get_next(size_t e) { return e % 3 == 2 ? e - 2 : e + 1; }
static size_t get_previous(size_t e) { return e % 3 == 0 ? e + 2 : e - 1; }

// Lists the edges that go out of each vertex.
static ovoid_code list_edges(const prover *w) {
    uint32_t count = w->p->count;
    size_t edges = 3 * (size_t)w->s->triangle_count;
    memset(w->starts, 0, ((size_t)count + 1) * sizeof *w->starts);
    for (size_t e = 0; e < edges; e++) {
        uint32_t v = w->s->triangles[e];
        if (v >= count) return refuse(w, (uint32_t)(e / 3), "a corner of a triangle is no vertex");
        w->starts[v + 1]++;
    }
    for (uint32_t v = 0; v < count; v++) {
        if (w->starts[v + 1] == 0) return refuse_vertex(w, v, "a vertex is on no triangle");
        w->starts[v + 1] += w->starts[v];
    }
    memcpy(w->end, w->starts, count * sizeof *w->end);
    for (size_t e = 0; e < edges; e++) w->edges[w->end[w->s->triangles[e]]++] = (uint32_t)e;
    return OVOID_OK;
}

static uint32_t get_degree(const prover *w, uint32_t v) { return w->starts[v + 1] - w->starts[v]; }

// Counts the edges from `to` to `from` and writes one of them. They are searched at the vertex with fewer edges: each
// triangle there has one outgoing and one incoming edge.
static uint32_t count_opposite(prover *w, uint32_t from, uint32_t to, size_t *found) {
    int at_from = get_degree(w, from) < get_degree(w, to);
    uint32_t at = at_from ? from : to, count = 0;
    for (uint32_t i = w->starts[at]; i < w->starts[at + 1]; i++) {
        size_t out = w->edges[i], opposite = at_from ? get_previous(out) : out;
        uint32_t other = w->s->triangles[at_from ? opposite : get_next(out)];
        if (other == (at_from ? to : from)) *found = opposite, count++;
    }
    w->steps += w->starts[at + 1] - w->starts[at];
    return count;
}

// Finds the triangle across each edge. The edges of a hull form a planar graph, in which the sum over all edges of the
// smaller degree of their ends is at most 6 times their number (N. Chiba, T. Nishizeki, Arboricity and subgraph listing
// algorithms, 1985); here each edge is processed in both directions. So a surface that takes longer is not a hull, and
// the cost is linear for every claim.
static ovoid_code find_across(prover *w) {
    size_t edges = 3 * (size_t)w->s->triangle_count;
    for (size_t e = 0; e < edges; e++) {
        size_t opposite = 0;
        uint32_t count = count_opposite(w, w->s->triangles[e], w->s->triangles[get_next(e)], &opposite);
        if (count == 0) return refuse(w, (uint32_t)(e / 3), "the surface is open: no triangle is beyond an edge");
        if (count > 1) return refuse(w, (uint32_t)(e / 3), "two triangles run through an edge in the same direction");
        if (w->steps > 6 * (uint64_t)edges) return refuse(w, (uint32_t)(e / 3), "the edges are not those of a hull");
        w->s->across[e] = (uint32_t)(opposite / 3);
    }
    return OVOID_OK;
}

// ---- convexity ----

// (1) and (3): each edge is looked at from the triangle with the smaller number.
static ovoid_code verify_triangle(const prover *w, uint32_t t) {
    const surface *s = w->s;
    const uint32_t *corner = s->triangles + 3 * (size_t)t;
    vec3 a = vec3_at(w->p->grid, corner[0]), b = vec3_at(w->p->grid, corner[1]), c = vec3_at(w->p->grid, corner[2]);
    if (orient3d_sign(a, b, c, w->inside) <= 0) return refuse(w, t, "a triangle does not face outward");
    for (uint32_t k = 0; k < 3; k++) {
        if (s->across[3 * (size_t)t + k] < t) continue;
        int sign = orient3d_sign(a, b, c, vec3_at(w->p->grid, surface_get_beyond(s, t, k)));
        if (sign < 0) return refuse(w, t, "the surface is not convex at an edge");
        if (sign > 0) continue;
        w->end[corner[k]]++;
        w->end[corner[(k + 1) % 3]]++;
    }
    return OVOID_OK;
}

static ovoid_code verify_convex(const prover *w) {
    memset(w->end, 0, w->p->count * sizeof *w->end);
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
        if (get_degree(w, v) - w->end[v] < 3) return refuse_vertex(w, v, "a vertex is not extreme");
    return OVOID_OK;
}

// ----

static ovoid_code prove(prover *w) {
    simplex_find(w->p, w->s);
    if (w->s->rank < 3) return refuse_vertex(w, 0, "the vertices lie in a plane");
    // The vertices are below 2^240 there; much farther out, signs would overflow.
    if (!(vec3_max_abs(w->inside) <= 0x1p241)) return refuse(w, 0, "the surface does not wind once around its inside");
    memcpy(w->s->triangles, w->claim->triangles, 3 * (size_t)w->s->triangle_count * sizeof *w->s->triangles);
    ovoid_code code = list_edges(w);
    if (!code) code = find_across(w);
    return code ? code : verify_convex(w);
}

ovoid_code surface_create_proven(const surface_claim *claim, const points *p, const ovoid_allocator *allocator,
                                 surface *s, surface_flaw *flaw) {
    *s = (surface){.triangle_count = claim->triangle_count};
    prover w = {.claim = claim, .p = p, .s = s, .flaw = flaw, .inside = points_to_grid(p, claim->inside)};
    size_t edges = 3 * (size_t)claim->triangle_count, count = p->count;
    s->triangles = allocator_allocate(allocator, edges, sizeof *s->triangles);
    s->across = allocator_allocate(allocator, edges, sizeof *s->across);
    w.starts = allocator_allocate(allocator, 2 * count + 1 + edges, sizeof *w.starts);
    ovoid_code code = OVOID_ERROR_MEMORY;
    if (s->triangles && s->across && w.starts) {
        w.end = w.starts + count + 1;
        w.edges = w.end + count;
        code = prove(&w);
    }
    allocator_release(allocator, w.starts);
    if (code) surface_destroy(s, allocator);
    return code;
}
