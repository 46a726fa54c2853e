// Files of shapes, for tests that change their bytes; blocks that are filled in the general way, for those of closed
// forms.
#ifndef OVOID_TESTS_SHAPE_FILES_H
#define OVOID_TESTS_SHAPE_FILES_H

#include "check.h"
#include "polytope/hull.h"
#include "shape/loops.h"

#include <stdlib.h>

static inline uint64_t shape_files_mix(uint64_t sum, uint64_t word) {
    sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
    return sum ^ sum >> 32;
}

/// The checksum of docs/polytope.md over all bytes before it, little-endian: FNV-1a of 64 bits in versions up to 8,
/// thereafter of words, in turn into four sums.
static inline void shape_files_mend(uint8_t *bytes, size_t size) {
    uint64_t h = bytes[8] > 8 ? 0 : 0xcbf29ce484222325u, sum[4] = {1, 2, 3, 4};
    for (size_t i = 0; bytes[8] <= 8 && i + 8 < size; i++) h = (h ^ bytes[i]) * 0x100000001b3u;
    for (size_t i = 0; bytes[8] > 8 && i + 16 <= size; i += 8) {
        uint64_t word = 0;
        for (size_t k = 0; k < 8; k++) word |= (uint64_t)bytes[i + k] << 8 * k;
        sum[i / 8 % 4] = shape_files_mix(sum[i / 8 % 4], word);
    }
    for (int k = 0; bytes[8] > 8 && k < 4; k++) h = shape_files_mix(h, sum[k]);
    for (int i = 0; i < 8; i++) bytes[size - 8 + (size_t)i] = (uint8_t)(h >> 8 * i);
}

/// Checks that two shapes are equal to the last bit: members one by one, since the padding between them is undefined;
/// fits and report are compared as written.
static inline void shape_files_check_same(const ovoid_shape *a, const ovoid_shape *b) {
    if (!CHECK(a && b) || !CHECK_EQ(a->at.size, b->at.size)) return;
    size_t front = offsetof(ovoid_shape, outer_fit), arrays = (sizeof(ovoid_shape) + 63) / 64 * 64;
    CHECK(!memcmp(a, b, front));
    CHECK(!memcmp(&a->measures, &b->measures, sizeof a->measures));
    CHECK(!memcmp((const char *)a + arrays, (const char *)b + arrays, a->at.size - arrays));
    size_t size = ovoid_shape_write(a, NULL, 0);
    uint8_t *bytes = malloc(2 * size);
    ovoid_shape_write(a, bytes, size);
    ovoid_shape_write(b, bytes + size, size);
    CHECK(!memcmp(bytes, bytes + size, size));
    free(bytes);
}

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
