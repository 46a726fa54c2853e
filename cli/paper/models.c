// Meshes with the paper's counts. A cylinder of k sides: two rings of k and the centres of the caps, 2 k + 2 vertices
// and 4 k triangles, k = 6 to 30. A closed mesh of r rings of k and two poles: r k + 2 vertices, 2 r k triangles; as a
// complex cylinder (r = 4, edges bevelled, k = 7 to 35) and as a sphere (r = 4 to 10).
#include "paper/models.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/// The height and radius of a ring.
typedef struct ring {
    double z, radius;
} ring;

enum { RINGS_MAX = 10 };

/// Fills the mesh: south pole, rings from below, north pole.
static void fill_rings(paper_model *m, const ring *rings, uint32_t ring_count, uint32_t sides, double reach) {
    uint32_t last = m->vertex_count - 1, *t = m->triangles;
    m->xyz[2] = -reach;
    m->xyz[3 * (size_t)last + 2] = reach;
    for (uint32_t i = 0; i < ring_count * sides; i++) {
        double angle = 2 * PI * (i % sides) / sides, *to = m->xyz + 3 * (1 + (size_t)i);
        to[0] = rings[i / sides].radius * cos(angle);
        to[1] = rings[i / sides].radius * sin(angle);
        to[2] = rings[i / sides].z;
    }
    for (uint32_t i = 0; i < sides; i++) {
        uint32_t next = (i + 1) % sides, top = last - sides;
        *t++ = 0, *t++ = 1 + next, *t++ = 1 + i;
        *t++ = top + i, *t++ = top + next, *t++ = last;
        for (uint32_t r = 0; r + 1 < ring_count; r++) {
            uint32_t below = 1 + r * sides, above = below + sides;
            *t++ = below + i, *t++ = below + next, *t++ = above + next;
            *t++ = below + i, *t++ = above + next, *t++ = above + i;
        }
    }
}

static int allocate(paper_model *m, uint32_t vertices, uint32_t triangles) {
    if (!vertices || !triangles) return 0;
    m->vertex_count = vertices;
    m->triangle_count = triangles;
    m->xyz = calloc(vertices, 3 * sizeof *m->xyz);
    m->triangles = calloc(triangles, 3 * sizeof *m->triangles);
    return m->xyz && m->triangles;
}

static int make_box(paper_model *m) {
    static const uint32_t faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                          {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    if (!allocate(m, 8, 12)) return 0;
    for (int i = 0; i < 8; i++) {
        m->xyz[3 * i] = i & 1 ? 1 : -1;
        m->xyz[3 * i + 1] = i & 2 ? 0.7 : -0.7;
        m->xyz[3 * i + 2] = i & 4 ? 0.5 : -0.5;
    }
    memcpy(m->triangles, faces, sizeof faces);
    return 1;
}

static int make_rings(paper_model *m, const ring *rings, uint32_t ring_count, uint32_t sides, double reach) {
    if (!allocate(m, ring_count * sides + 2, 2 * ring_count * sides)) return 0;
    fill_rings(m, rings, ring_count, sides, reach);
    return 1;
}

static int make_cylinder(paper_model *m, int i) {
    const ring rings[] = {{-1, 0.7}, {1, 0.7}};
    return make_rings(m, rings, 2, (uint32_t)lround(6 + 24.0 * i / 9), 1);
}

static int make_complex(paper_model *m, int i) {
    const ring rings[] = {{-1, 0.6}, {-0.8, 0.7}, {0.8, 0.7}, {1, 0.6}};
    return make_rings(m, rings, 4, (uint32_t)lround(7 + 28.0 * i / 9), 1);
}

static int make_sphere(paper_model *m, int i) {
    static const uint32_t sizes[MODELS_EACH][2] = {{4, 5}, {4, 7},  {5, 7},  {5, 9},  {6, 9},
                                                   {7, 9}, {7, 10}, {8, 10}, {9, 10}, {10, 10}};
    ring rings[RINGS_MAX];
    uint32_t count = sizes[i][0];
    for (uint32_t r = 0; r < count; r++) {
        double angle = PI * (r + 1) / (count + 1);
        rings[r] = (ring){-0.9 * cos(angle), 0.9 * sin(angle)};
    }
    return make_rings(m, rings, count, sizes[i][1], 0.9);
}

const char *paper_family_get_name(paper_family family) {
    static const char *const names[FAMILY_COUNT] = {"box", "cylinders", "complex cylinders", "spheres"};
    return names[family];
}

ovoid_polytope paper_model_get_mesh(const paper_model *m) {
    return (ovoid_polytope){.vertices = m->xyz,
                            .triangles = m->triangles,
                            .vertex_count = m->vertex_count,
                            .triangle_count = m->triangle_count,
                            .rank = 3};
}

static int finish(paper_model *m) {
    static const char *const names[FAMILY_COUNT] = {"box", "cylinder", "complex", "sphere"};
    snprintf(m->name, sizeof m->name, "%s %u", names[m->family], m->vertex_count);
    m->shape = ovoid_shape_create_from_points(m->xyz, m->vertex_count, NULL, NULL);
    if (!m->shape) return 0;
    ovoid_polytope p = ovoid_shape_get_polytope(m->shape);
    ovoid_ellipsoid inner = ovoid_shape_get_inner(m->shape).ellipsoid;
    m->areas = ovoid_areas_create(&p, &inner, NULL, NULL);
    return m->areas != NULL;
}

paper_model *paper_models_create(void) {
    paper_model *models = calloc(MODEL_COUNT, sizeof *models);
    int good = models != NULL;
    for (int i = 0; i < MODEL_COUNT && good; i++) {
        paper_model *m = &models[i];
        int number = (i - 1) % MODELS_EACH;
        m->family = i == 0 ? FAMILY_BOX : (paper_family)(1 + (i - 1) / MODELS_EACH);
        switch (m->family) {
        case FAMILY_BOX: good = make_box(m); break;
        case FAMILY_CYLINDER: good = make_cylinder(m, number); break;
        case FAMILY_COMPLEX: good = make_complex(m, number); break;
        default: good = make_sphere(m, number); break;
        }
        good = good && finish(m);
    }
    if (good) return models;
    paper_models_destroy(models);
    return NULL;
}

void paper_models_destroy(paper_model *models) {
    for (int i = 0; models && i < MODEL_COUNT; i++) {
        free(models[i].xyz);
        free(models[i].triangles);
        ovoid_areas_destroy(models[i].areas);
        ovoid_shape_destroy(models[i].shape);
    }
    free(models);
}
