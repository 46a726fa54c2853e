// Blocks of shapes that are filled in the general way, for tests of closed forms.
#ifndef OVOID_TESTS_GENERAL_BLOCK_H
#define OVOID_TESTS_GENERAL_BLOCK_H

#include "check.h"
#include "polytope/hull.h"
#include "shape/loops.h"

#include <stdlib.h>

/// The block of a solid's triangles at other vertices, filled in the general way; the edge that begins at a corner of a
/// triangle is searched for.
static inline ovoid_shape *fill_in_general(const ovoid_shape *from, double *vertices) {
    ovoid_shape *to = block_create(from->counts, NULL, NULL), *same = ovoid_shape_create_copy(from, NULL, NULL);
    uint32_t count = from->counts.triangles;
    uint32_t *corners = malloc(3 * count * sizeof *corners),
             *room = malloc(loops_get_room(from->counts) * sizeof *room);
    CHECK(to && same && corners && room);
    char *base = (char *)same;
    hull h = {.vertices = vertices,
              .triangles = (uint32_t *)(base + same->at.triangles),
              .triangle_facets = (uint32_t *)(base + same->at.triangle_facets),
              .neighbor_starts = (uint32_t *)(base + same->at.neighbor_starts),
              .neighbors = (uint32_t *)(base + same->at.neighbors),
              .planes = (ovoid_plane *)(base + same->at.planes),
              .corner_edges = corners,
              .vertex_count = from->counts.vertices,
              .triangle_count = count,
              .facet_count = from->counts.facets,
              .rank = 3};
    for (uint32_t i = 0; i < 3 * count; i++)
        corners[i] = shape_find_edge(from, h.triangles[i], h.triangles[i % 3 == 2 ? i - 2 : i + 1]);
    block_fill(to, &h, room);
    ovoid_shape_destroy(same);
    free(corners);
    free(room);
    return to;
}

#endif
