// Mesh files as solids: the triangles themselves, in the place of their hull.
//
// A polygon is cut into the triangles of a fan, from its first corner from which all of them face as the whole of it
// does; one that no corner sees so is refused, since another cut would be another body.
#include "io/mesh/mesh_build.h"

#include <stdlib.h>

typedef struct vector {
    double x, y, z;
} vector;

static vector get_difference(const double *a, const double *b) {
    return (vector){a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
static vector get_normal(const double *xyz, uint32_t a, uint32_t b, uint32_t c) {
    vector u = get_difference(xyz + 3 * (size_t)b, xyz + 3 * (size_t)a);
    vector v = get_difference(xyz + 3 * (size_t)c, xyz + 3 * (size_t)a);
    return (vector){u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

/// The corner from which a polygon is cut into triangles that all face the same way; size where there is none.
static uint32_t find_apex(const double *xyz, const uint32_t *face, uint32_t size) {
    vector n = {0, 0, 0};
    for (uint32_t i = 1; i + 1 < size; i++) {
        vector t = get_normal(xyz, face[0], face[i], face[i + 1]);
        n = (vector){n.x + t.x, n.y + t.y, n.z + t.z};
    }
    double least = -1e-12 * (n.x * n.x + n.y * n.y + n.z * n.z);
    for (uint32_t apex = 0; apex < size; apex++) {
        uint32_t i = 1;
        for (; i + 1 < size; i++) {
            vector t = get_normal(xyz, face[apex], face[(apex + i) % size], face[(apex + i + 1) % size]);
            if (!(t.x * n.x + t.y * n.y + t.z * n.z >= least)) break;
        }
        if (i + 1 >= size) return apex;
    }
    return size;
}

// An error without a path, which the caller may know. format has one %zu.
static void report(ovoid_error *error, ovoid_code code, int64_t place, const char *format, size_t count) {
    if (!error) return;
    error->code = code;
    error->place = place;
    snprintf(error->message, sizeof error->message, format, count);
}

uint32_t *mesh_cut_polygons(const ovoid_faces *faces, size_t *count, ovoid_error *error) {
    size_t room = 0;
    for (size_t f = 0; f < faces->face_count; f++) room += faces->sizes[f] - 2;
    uint32_t *triangles = malloc((3 * room + 1) * sizeof *triangles);
    *count = 0;
    if (!triangles) report(error, OVOID_ERROR_MEMORY, -1, "no memory for %zu triangles", room);
    const uint32_t *face = faces->indices;
    for (size_t f = 0; f < faces->face_count && triangles; face += faces->sizes[f++]) {
        uint32_t size = faces->sizes[f], apex = find_apex(faces->vertices, face, size);
        if (apex == size) {
            report(error, OVOID_ERROR_FORMAT, (int64_t)f,
                   "face %zu cannot be cut into triangles from one of its corners: triangulate the mesh", f);
            free(triangles);
            return NULL;
        }
        for (uint32_t i = 1; i + 1 < size; i++) {
            uint32_t *t = triangles + 3 * (*count)++;
            t[0] = face[apex];
            t[1] = face[(apex + i) % size];
            t[2] = face[(apex + i + 1) % size];
        }
    }
    return triangles;
}

ovoid_solid *ovoid_mesh_create_solid(const ovoid_mesh *mesh, size_t part, ovoid_error *error) {
    ovoid_faces faces = ovoid_mesh_get_part(mesh, part).faces;
    if (faces.face_count == 0) {
        report(error, OVOID_ERROR_EMPTY, -1, "no faces, %zu points alone: they are no solid", faces.vertex_count);
        return NULL;
    }
    size_t count;
    uint32_t *triangles = mesh_cut_polygons(&faces, &count, error);
    if (!triangles) return NULL;
    const ovoid_triangles given = {faces.vertices, faces.vertex_count, triangles, count};
    ovoid_solid *solid = ovoid_solid_create_from_triangles(&given, NULL, error);
    free(triangles);
    return solid;
}

ovoid_solid *ovoid_solid_read_file(const char *path, const ovoid_read_options *read, ovoid_error *error) {
    ovoid_read_options whole = {.scale = 0};
    if (read) whole = *read;
    whole.parts = 0;
    ovoid_mesh *mesh = ovoid_mesh_read(path, &whole, error);
    if (!mesh) return NULL;
    ovoid_solid *solid = ovoid_mesh_create_solid(mesh, 0, error);
    if (!solid) io_prefix_path(error, path);
    ovoid_mesh_destroy(mesh);
    return solid;
}
