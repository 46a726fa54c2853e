// Shapes from any vertices and any faces: refused with a reason, or the shape that the vertices alone give.
#include "take.h"

enum { VERTICES_MOST = 24, FACES_MOST = 40, CORNERS_MOST = 200 };

static void check_same_hull(const ovoid_shape *shape, const ovoid_faces *faces, const ovoid_shape_options *options) {
    ovoid_shape *hull = ovoid_shape_create_from_points(faces->vertices, faces->vertex_count, options, NULL);
    fuzz_require(hull != NULL);
    ovoid_polytope p = ovoid_shape_get_polytope(shape), q = ovoid_shape_get_polytope(hull);
    fuzz_require(p.vertex_count == q.vertex_count && p.triangle_count == q.triangle_count && p.rank == q.rank);
    fuzz_require(memcmp(p.vertices, q.vertices, 3 * p.vertex_count * sizeof(double)) == 0);
    ovoid_shape_destroy(hull);
}

// A tetrahedron or a box whose bytes the input then changes: faces at random are hardly ever closed.
static const uint32_t tetrahedron[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
static const uint32_t box[] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};

static uint32_t fill_start(int what, double *vertices, uint32_t *indices, uint32_t *sizes, uint32_t *face_count) {
    int is_box = what == 2;
    for (int i = 0; i < 24 * is_box; i++) vertices[i] = (i / 3) >> (i % 3) & 1;
    for (int i = 0; i < 12 && what == 1; i++) vertices[i] = i / 3 == i % 3 + 1;
    if (what == 1) memcpy(indices, tetrahedron, sizeof tetrahedron);
    if (is_box) memcpy(indices, box, sizeof box);
    *face_count = is_box ? 6 : what == 1 ? 4 : 0;
    for (uint32_t i = 0; i < *face_count; i++) sizes[i] = is_box ? 4 : 3;
    return is_box ? 8 : what == 1 ? 4 : 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes from = {data, size};
    double vertices[3 * VERTICES_MOST] = {0};
    uint32_t indices[CORNERS_MOST] = {0}, sizes[FACES_MOST] = {0}, face_count;
    uint32_t count = fill_start((unsigned)take_byte(&from) % 3, vertices, indices, sizes, &face_count);
    if (!count) {
        count = (uint32_t)take_byte(&from) % (VERTICES_MOST + 1);
        face_count = (uint32_t)take_byte(&from) % (FACES_MOST + 1);
        for (uint32_t i = 0; i < face_count; i++) sizes[i] = (uint32_t)take_byte(&from) % 8;
        for (uint32_t i = 0; i < CORNERS_MOST / 2; i++) indices[i] = (uint32_t)take_byte(&from);
        for (uint32_t i = 0; i < 3 * count; i++) vertices[i] = take_double(&from);
    }
    // Changes of one place at a time.
    while (from.size) {
        unsigned what = (unsigned)take_byte(&from) % 8, place = (uint8_t)take_byte(&from);
        if (what < 4) vertices[place % (3 * VERTICES_MOST)] = take_double(&from);
        if (what == 4 || what == 5) indices[place % CORNERS_MOST] = (uint32_t)take_byte(&from);
        if (what == 6) sizes[place % FACES_MOST] = (uint32_t)take_byte(&from) % 6;
        if (what == 7) face_count = place % (FACES_MOST + 1);
    }
    // The corners are as many as the sizes say, and no more than there are.
    uint32_t corners = 0, kept = 0;
    while (kept < face_count && corners + sizes[kept] <= CORNERS_MOST) corners += sizes[kept++];
    uint32_t *exact = malloc((corners + 1) * sizeof *exact); // so that a sanitizer sees its end
    fuzz_require(exact != NULL);
    memcpy(exact, indices, corners * sizeof *exact);
    ovoid_faces faces = {vertices, count, exact, sizes, kept};
    ovoid_shape_options options = {0};
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_shape *shape = ovoid_shape_create_from_faces(&faces, &options, &error);
    if (shape)
        check_same_hull(shape, &faces, &options);
    else
        fuzz_require_error(&error);
    ovoid_shape_destroy(shape);
    free(exact);
    return 0;
}
