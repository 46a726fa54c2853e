// Sets of bodies, each with its shape and the plain arrays from which peers are made.
#include "common/bodies.h"

#include "common/random.h"

#include <stdio.h>
#include <stdlib.h>

static const double turn = 6.283185307179586;

double body_get_reach(const body *b) { return ovoid_shape_get_measures(b->shape).sphere_radius; }

/// Views into the shape, the vertices in the user's frame; takes over the shape. 0 if memory runs out.
static int fill_body(body *b, ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    double *vertices = malloc(sizeof(double) * 3 * p.vertex_count);
    if (!vertices) return 0;
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        vertices[3 * i] = p.vertices[3 * i] + p.origin.x;
        vertices[3 * i + 1] = p.vertices[3 * i + 1] + p.origin.y;
        vertices[3 * i + 2] = p.vertices[3 * i + 2] + p.origin.z;
    }
    ovoid_vec3 c = ovoid_shape_get_measures(shape).centroid;
    *b = (body){shape,       vertices,       p.triangles,      p.neighbor_starts,
                p.neighbors, p.vertex_count, p.triangle_count, {c.x + p.origin.x, c.y + p.origin.y, c.z + p.origin.z}};
    return 1;
}

int bodies_add_shape(bodies *all, ovoid_shape *shape) {
    if (shape && fill_body(&all->items[all->count], shape)) {
        all->count++;
        return 1;
    }
    ovoid_shape_destroy(shape);
    return 0;
}

void bodies_destroy(bodies *all) {
    for (uint32_t i = 0; i < all->count; i++) {
        ovoid_shape_destroy((ovoid_shape *)all->items[i].shape);
        free((double *)all->items[i].vertices);
    }
    free(all->items);
    *all = (bodies){NULL, 0};
}

static bodies make_room(uint32_t count) { return (bodies){calloc(count, sizeof(body)), 0}; }

/// All of them, or none.
static bodies expect(bodies all, uint32_t count) {
    if (all.count < count) bodies_destroy(&all);
    return all;
}

bodies bodies_create_hulls(uint32_t vertices, uint32_t count) {
    uint64_t state = vertices;
    bodies all = make_room(count);
    double *xyz = malloc(sizeof(double) * 3 * vertices);
    for (uint32_t i = 0; all.items && xyz && i < count; i++) {
        double stretch_y = random_uniform(&state, 1, 4), stretch_z = random_uniform(&state, 1, 4);
        for (uint32_t k = 0; k < vertices; k++) {
            ovoid_vec3 p = random_unit(&state);
            xyz[3 * k] = p.x;
            xyz[3 * k + 1] = p.y * stretch_y;
            xyz[3 * k + 2] = p.z * stretch_z;
        }
        if (!bodies_add_shape(&all, ovoid_shape_create_from_points(xyz, vertices, NULL, NULL))) break;
    }
    free(xyz);
    return expect(all, count);
}

bodies bodies_create_boxes(uint32_t count) {
    uint64_t state = 1;
    bodies all = make_room(count);
    for (uint32_t i = 0; all.items && i < count; i++) {
        ovoid_vec3 half = {random_uniform(&state, 1, 4), random_uniform(&state, 1, 4), random_uniform(&state, 1, 4)};
        if (!bodies_add_shape(&all, ovoid_shape_create_box(half, NULL, NULL))) break;
    }
    return expect(all, count);
}

/// r rings of k vertices and two poles: r k + 2 vertices.
static ovoid_shape *create_ringed(uint32_t rings, uint32_t sides, int round) {
    double xyz[3 * 256];
    uint32_t n = 0;
    for (uint32_t r = 0; r < rings; r++) {
        double angle = turn / 2 * (r + 1.0) / (rings + 1.0);
        double z = round ? cos(angle) : 1 - 2.0 * r / (rings - 1.0), radius = round ? sin(angle) : 0.5;
        for (uint32_t k = 0; k < sides; k++, n++) {
            xyz[3 * n] = radius * cos(turn * k / sides);
            xyz[3 * n + 1] = radius * sin(turn * k / sides);
            xyz[3 * n + 2] = z;
        }
    }
    for (int pole = -1; pole <= 1; pole += 2, n++) {
        xyz[3 * n] = xyz[3 * n + 1] = 0;
        xyz[3 * n + 2] = round ? pole : 1.3 * pole;
    }
    return ovoid_shape_create_from_points(xyz, n, NULL, NULL);
}

bodies bodies_create_paper(void) {
    bodies all = make_room(31);
    if (!all.items) return all;
    int good = bodies_add_shape(&all, ovoid_shape_create_box((ovoid_vec3){0.5, 0.4, 0.3}, NULL, NULL));
    // 14 to 62 vertices; those in the middle of the caps are not corners.
    for (uint32_t i = 0; i < 10 && good; i++)
        good = bodies_add_shape(&all, ovoid_shape_create_prism(&(ovoid_prism){0.5, 1, 6 + i * 24 / 9}, NULL, NULL));
    // 30 to 142, here with pointed caps so that all of them are corners; then spheres of 22 to 102.
    for (uint32_t i = 0; i < 10 && good; i++) good = bodies_add_shape(&all, create_ringed(2, 14 + i * 56 / 9, 0));
    for (uint32_t i = 0; i < 10 && good; i++) good = bodies_add_shape(&all, create_ringed(4 + i / 2, 5 + i * 6 / 9, 1));
    return expect(all, 31);
}

/// The next cloud of the file as doubles, to be freed; NULL at its end.
static double *read_cloud(FILE *file, uint32_t *count) {
    if (fread(count, sizeof *count, 1, file) != 1 || *count == 0 || *count > 100000) return NULL;
    float *raw = malloc(sizeof(float) * 3 * *count);
    double *xyz = malloc(sizeof(double) * 3 * *count);
    int good = raw && xyz && fread(raw, 12, *count, file) == *count;
    for (uint32_t i = 0; good && i < 3 * *count; i++) xyz[i] = raw[i];
    free(raw);
    if (good) return xyz;
    free(xyz);
    return NULL;
}

bodies bodies_create_from_clouds(const char *path, uint32_t count) {
    FILE *file = fopen(path, "rb");
    if (!file) return (bodies){NULL, 0};
    bodies all = make_room(count);
    uint32_t n;
    double *xyz;
    // Every eighth cloud, since neighbours in the file are often parts of one thing.
    for (uint32_t i = 0; all.items && all.count < count && (xyz = read_cloud(file, &n)); i++) {
        ovoid_shape *shape = i % 8 == 0 ? ovoid_shape_create_from_points(xyz, n, NULL, NULL) : NULL;
        free(xyz);
        if (shape && ovoid_shape_get_polytope(shape).rank == 3)
            (void)bodies_add_shape(&all, shape);
        else
            ovoid_shape_destroy(shape);
    }
    (void)fclose(file);
    return all;
}
