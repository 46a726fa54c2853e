// The boundaries of facets from triangles that know their facet: an edge is on the boundary where the facets of its two
// sides differ. Around the end of a boundary edge, from triangle to triangle of the same facet, is the next one.
//
// Lists of neighbors ascend. So if the edges are taken in the order of the vertices they begin at, those that lead to
// one vertex come in the order of its list, and a place that moves along each list finds the edges back without a
// search.
#include "shape/loops.h"

#include "polytope/centered_box.h"
#include "polytope/hull.h"
#include "shape/regular_loops.h"

#include <string.h>

#define NOTHING UINT32_MAX

typedef struct tables {
    ovoid_shape *shape;
    const ovoid_polytope *p;
    uint32_t *tails;                               // of directed edges
    uint32_t *facets;                              // of directed edges, to the left
    uint32_t *next;                                // of directed edges, the next of the triangle or side to the left
    uint32_t *reverse;                             // of directed edges, the one back
    const uint32_t *corners;                       // of the corners of triangles, the edge that begins there
    uint32_t *places;                              // of vertices, working memory
    uint32_t *starts, *loop_vertices, *loop_edges; // of loops
} tables;

static uint32_t *get_table(ovoid_shape *shape, uint64_t at) { return (uint32_t *)((char *)shape + at); }

static int is_boundary(const tables *t, uint32_t edge) { return t->facets[t->reverse[edge]] != t->facets[edge]; }

// An edge in both directions has one name: that from its lower vertex, whose edges have the lower numbers.
static uint32_t get_name(const tables *t, uint32_t edge) {
    uint32_t back = t->reverse[edge];
    return edge < back ? edge : back;
}

static void start_lists(const tables *t) {
    memcpy(t->places, t->p->neighbor_starts, t->p->vertex_count * sizeof *t->places);
}

// 1 if each facet is one triangle.
static int has_triangles_alone(const tables *t) { return t->p->rank == 3 && t->p->facet_count == t->p->triangle_count; }

static void link_solid(tables *t) {
    start_lists(t);
    uint32_t count = t->shape->counts.neighbors, *reverse = t->reverse, *places = t->places;
    const uint32_t *neighbors = t->p->neighbors;
    for (uint32_t i = 0; i < count; i++) reverse[i] = places[neighbors[i]]++;
    int needs_next = !has_triangles_alone(t);
    for (uint32_t i = 0; i < t->p->triangle_count; i++) {
        const uint32_t *edge = t->corners + 3 * (size_t)i, *corner = t->p->triangles + 3 * (size_t)i;
        for (int k = 0; k < 3; k++) {
            if (needs_next) t->next[edge[k]] = edge[k == 2 ? 0 : k + 1];
            t->facets[edge[k]] = t->p->triangle_facets[i];
            t->tails[edge[k]] = corner[k];
        }
    }
}

// Of a polygon the lists of neighbors hold the corner before, then the corner after; it has two sides.
static void link_flat(tables *t) {
    const ovoid_polytope *p = t->p;
    for (uint32_t v = 0; v < p->vertex_count; v++)
        for (uint32_t i = p->neighbor_starts[v]; i < p->neighbor_starts[v + 1]; i++) t->tails[i] = v;
    for (uint32_t i = 0; i < t->shape->counts.neighbors; i++) {
        t->facets[i] = p->rank == 2 && i == p->neighbor_starts[t->tails[i]];
        t->next[i] = p->neighbor_starts[p->neighbors[i]] + (t->facets[i] == 0);
        t->reverse[i] = shape_find_edge(t->shape, p->neighbors[i], t->tails[i]);
    }
}

static void link_edges(tables *t) {
    if (t->p->rank == 3)
        link_solid(t);
    else
        link_flat(t);
}

// The edge of the facet's boundary that begins where this one ends.
static uint32_t find_next(const tables *t, uint32_t edge) {
    uint32_t next = t->next[edge];
    while (!is_boundary(t, next)) next = t->next[t->reverse[next]];
    return next;
}

// Appends the loop through a directed edge; returns the number of corners so far.
static uint32_t append_loop(tables *t, uint32_t first, uint32_t count) {
    uint32_t most = t->shape->counts.neighbors, edge = first;
    do {
        t->loop_vertices[count] = t->tails[edge];
        t->loop_edges[count++] = get_name(t, edge);
        edge = find_next(t, edge);
    } while (edge != first && count < most);
    return count;
}

static vec3 get_side(const tables *t, const uint32_t *loop, uint32_t i, uint32_t count) {
    const double *x = t->p->vertices;
    return vec3_sub(vec3_at(x, loop[(i + 1) % count]), vec3_at(x, loop[i]));
}

// 1 if a loop is convex and counter-clockwise about the normal, to rounding. The boundary of a facet is, unless its
// flatness hides a hole.
static int is_convex(const tables *t, const uint32_t *loop, uint32_t count, vec3 normal) {
    vec3 first = vec3_at(t->p->vertices, loop[0]);
    double area = 0;
    for (uint32_t i = 0; i < count; i++) {
        vec3 side = get_side(t, loop, i, count), next = get_side(t, loop, (i + 1) % count, count);
        double turn = vec3_dot(vec3_cross(side, next), normal);
        if (turn < 0 && turn < -1e-9 * vec3_norm(side) * vec3_norm(next)) return 0;
        area += vec3_dot(vec3_cross(vec3_sub(vec3_at(t->p->vertices, loop[i]), first), side), normal);
    }
    return area > 0;
}

// Puts the triangle to the left of a directed edge at `start`.
static uint32_t put_triangle(tables *t, uint32_t edge, uint32_t start) {
    for (uint32_t i = 0; i < 3; i++, edge = t->next[edge]) {
        t->loop_vertices[start + i] = t->tails[edge];
        t->loop_edges[start + i] = get_name(t, edge);
    }
    return start + 3;
}

// 1 if the loop through a directed edge is the triangle to its left.
static int is_triangle(const tables *t, uint32_t edge) {
    return is_boundary(t, t->next[edge]) && is_boundary(t, t->next[t->next[edge]]);
}

// The loops where each facet is one triangle, from its edge of the lowest number.
static void fill_triangles(tables *t) {
    for (uint32_t i = 0; i < t->p->triangle_count; i++) {
        const uint32_t *edges = t->corners + 3 * (size_t)i, *corner = t->p->triangles + 3 * (size_t)i;
        uint32_t start = 3 * t->p->triangle_facets[i], k = edges[1] < edges[0];
        k = edges[2] < edges[k] ? 2 : k;
        const uint32_t after = k == 2 ? 0 : k + 1, order[3] = {k, after, 3 - k - after};
        for (uint32_t j = 0; j < 3; j++) {
            t->loop_vertices[start + j] = corner[order[j]];
            t->loop_edges[start + j] = get_name(t, edges[order[j]]);
        }
    }
    for (uint32_t f = 0; f <= t->p->facet_count; f++) t->starts[f] = 3 * f;
}

static void fill_loops(tables *t, uint32_t loop_count) {
    if (has_triangles_alone(t)) {
        fill_triangles(t);
        return;
    }
    for (uint32_t f = 0; f <= loop_count; f++) t->starts[f] = NOTHING;
    for (uint32_t i = t->shape->counts.neighbors; i-- > 0;)
        if (is_boundary(t, i)) t->starts[t->facets[i]] = i;
    uint32_t count = 0;
    for (uint32_t f = 0; f < loop_count; f++) {
        uint32_t first = t->starts[f], start = count;
        t->starts[f] = start;
        if (first == NOTHING) continue;
        if (t->p->rank == 3 && is_triangle(t, first)) {
            count = put_triangle(t, first, start);
            continue;
        }
        count = append_loop(t, first, start);
        vec3 normal = shape_get_facet_normal(t->shape, f);
        if (t->p->rank == 3 && !is_convex(t, t->loop_vertices + start, count - start, normal))
            count = put_triangle(t, first, start);
    }
    t->starts[loop_count] = count;
}

// A segment or a point.
static void fill_thin(tables *t) {
    uint32_t v = 0;
    while (v + 1 < t->p->vertex_count && t->p->neighbor_starts[v + 1] == t->p->neighbor_starts[v]) v++;
    int is_segment = t->p->rank == 1;
    t->starts[0] = 0;
    t->starts[1] = is_segment ? 2 : 1;
    t->loop_vertices[0] = is_segment ? v : 0;
    if (is_segment) {
        t->loop_edges[0] = t->loop_edges[1] = t->p->neighbor_starts[v];
        t->loop_vertices[1] = t->p->neighbors[t->p->neighbor_starts[v]];
    }
}

// ---- boxes, whose tables are constants ----

enum { BOX_CORNERS = 4 * BOX_FACETS };
static const uint32_t box_tails[BOX_NEIGHBORS] = {0, 0, 0, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 3, 3, 3,
                                                  4, 4, 4, 4, 4, 4, 5, 5, 5, 6, 6, 6, 7, 7, 7, 7, 7, 7};
static const uint32_t box_facets[BOX_NEIGHBORS] = {2, 1, 5, 1, 1, 3, 2, 2, 3, 5, 1, 1, 5, 4, 4, 1, 4, 3,
                                                   2, 2, 5, 0, 5, 0, 3, 2, 0, 5, 0, 4, 3, 4, 4, 0, 3, 0};
static const uint32_t box_loop_vertices[BOX_CORNERS] = {4, 5, 7, 6, 0, 2, 3, 1, 0, 1, 5, 4,
                                                        1, 3, 7, 5, 2, 6, 7, 3, 0, 4, 6, 2};
static const uint32_t box_loop_edges[BOX_CORNERS] = {21, 26, 29, 22, 1,  11, 5,  0,  0, 7,  21, 2,
                                                     5,  17, 26, 7,  13, 29, 17, 11, 2, 22, 13, 1};

static void fill_box(const tables *t) {
    memcpy(t->tails, box_tails, sizeof box_tails);
    memcpy(t->facets, box_facets, sizeof box_facets);
    memcpy(t->loop_vertices, box_loop_vertices, sizeof box_loop_vertices);
    memcpy(t->loop_edges, box_loop_edges, sizeof box_loop_edges);
    for (uint32_t f = 0; f <= BOX_FACETS; f++) t->starts[f] = 4 * f;
}

static void fill_regular(const tables *t, const regular_solid *solid) {
    regular_loops_fill(solid, &(regular_tables){.neighbor_starts = t->p->neighbor_starts,
                                                .neighbors = t->p->neighbors,
                                                .tails = t->tails,
                                                .facets = t->facets,
                                                .starts = t->starts,
                                                .loop_vertices = t->loop_vertices,
                                                .loop_edges = t->loop_edges,
                                                .room = t->next});
}

size_t loops_get_room(block_counts counts) { return 2 * (size_t)counts.neighbors + counts.vertices; }

void loops_fill(ovoid_shape *s, const hull *polytope, uint32_t *room) {
    const block_offsets *at = &s->at;
    const ovoid_polytope view = hull_get_polytope(polytope), *p = &view;
    const closed_form *form = &polytope->form;
    tables t = {.shape = s, .p = p, .corners = polytope->corner_edges};
    t.tails = get_table(s, at->edge_tails);
    t.facets = get_table(s, at->edge_facets);
    t.next = room;
    t.reverse = t.next + s->counts.neighbors;
    t.places = t.reverse + s->counts.neighbors;
    t.starts = get_table(s, at->loop_starts);
    t.loop_vertices = get_table(s, at->loop_vertices);
    t.loop_edges = get_table(s, at->loop_edges);
    if (form->kind == FORM_BOX) {
        fill_box(&t);
        return;
    }
    if (form->kind == FORM_REGULAR) {
        fill_regular(&t, &form->solid);
        return;
    }
    link_edges(&t);
    if (p->rank < 2)
        fill_thin(&t);
    else
        fill_loops(&t, loops_get_count(p->rank, p->facet_count));
}
