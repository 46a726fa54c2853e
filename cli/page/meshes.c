// The meshes of a page: read again, since only their hulls are in memory, and cut into triangles.
#include "base/message.h"
#include "page/shapes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// The largest number of bytes of the meshes of a page.
#define BYTES_MOST 30000000u

static size_t count_triangles(const ovoid_faces *faces) {
    size_t count = 0;
    for (size_t f = 0; f < faces->face_count; f++) count += faces->sizes[f] > 2 ? faces->sizes[f] - 2 : 0;
    return count;
}

static size_t get_bytes(size_t points, size_t triangles) { return 12 * (points + triangles); }

/// Numbers the points that faces use, in their order; returns how many there are. numbers: of all points, SIZE_MAX: not
/// used.
static size_t number_points(const ovoid_faces *faces, size_t corners, uint32_t *numbers) {
    uint32_t count = 0;
    for (size_t i = 0; i < faces->vertex_count; i++) numbers[i] = UINT32_MAX;
    for (size_t i = 0; i < corners; i++) numbers[faces->indices[i]] = 0;
    for (size_t i = 0; i < faces->vertex_count; i++)
        if (numbers[i] != UINT32_MAX) numbers[i] = count++;
    return count;
}

/// Cuts each polygon from its first corner.
static void cut_polygons(const ovoid_faces *faces, const uint32_t *numbers, uint32_t *triangle) {
    const uint32_t *face = faces->indices;
    for (size_t f = 0; f < faces->face_count; face += faces->sizes[f++])
        for (uint32_t i = 1; i + 1 < faces->sizes[f]; i++) {
            *triangle++ = numbers[face[0]];
            *triangle++ = numbers[face[i]];
            *triangle++ = numbers[face[i + 1]];
        }
}

static int copy_mesh(const ovoid_faces *faces, page_mesh *mesh) {
    size_t corners = 0;
    for (size_t f = 0; f < faces->face_count; f++) corners += faces->sizes[f];
    uint32_t *numbers = malloc((faces->vertex_count + 1) * sizeof *numbers);
    mesh->triangle_count = count_triangles(faces);
    mesh->triangles = malloc((3 * mesh->triangle_count + 1) * sizeof *mesh->triangles);
    mesh->points = malloc((3 * faces->vertex_count + 1) * sizeof *mesh->points);
    int is_made = numbers && mesh->triangles && mesh->points;
    if (is_made) {
        mesh->point_count = number_points(faces, corners, numbers);
        cut_polygons(faces, numbers, mesh->triangles);
        for (size_t i = 0; i < faces->vertex_count; i++)
            for (size_t k = 0; k < 3 && numbers[i] != UINT32_MAX; k++)
                mesh->points[3 * (size_t)numbers[i] + k] = (float)faces->vertices[3 * i + k];
    }
    free(numbers);
    return is_made;
}

/// Keeps a part of a mesh for its shape, unless the part is its hull. 0, or EXIT_INPUT after a message.
static int keep(page_shapes *shapes, cli_page *page, const ovoid_mesh *mesh, size_t part, const ovoid_shape *shape) {
    size_t number;
    if (!page_shapes_add(shapes, shape, &number)) return message_error("out of memory"), EXIT_INPUT;
    ovoid_mesh_part one = ovoid_mesh_get_part(mesh, part);
    ovoid_faces faces = one.faces;
    ovoid_convexity convexity;
    if (ovoid_mesh_part_compute_convexity(&one, shape, &convexity, NULL))
        return message_error("out of memory"), EXIT_INPUT;
    int is_hull = convexity.kind == OVOID_MESH_HULL;
    if (is_hull || !faces.face_count || shapes->meshes[number].points) return 0;
    size_t bytes = get_bytes(faces.vertex_count, count_triangles(&faces));
    if (shapes->mesh_bytes + bytes > BYTES_MOST) {
        page->left_out.meshes++;
        return 0;
    }
    shapes->mesh_bytes += bytes;
    if (copy_mesh(&faces, &shapes->meshes[number])) return 0;
    return message_error("out of memory"), EXIT_INPUT;
}

int page_shapes_add_solid(page_shapes *shapes, cli_page *page, const ovoid_shape *hull, const ovoid_solid *solid) {
    size_t number;
    if (!page_shapes_add(shapes, hull, &number)) return message_error("out of memory"), EXIT_INPUT;
    if (shapes->seen[number] & PAGE_SEEN_SOLID) return 0;
    shapes->seen[number] |= PAGE_SEEN_SOLID;
    ovoid_solid_report report = ovoid_solid_get_report(solid);
    size_t bytes = 24 * (size_t)report.points + 12 * (size_t)report.triangles;
    if (shapes->mesh_bytes + bytes > BYTES_MOST) {
        page->left_out.meshes++;
        return 0;
    }
    shapes->mesh_bytes += bytes;
    shapes->meshes[number].solid = solid;
    return 0;
}

/// Part i of a body.
static const ovoid_shape *get_part(const ovoid_body *body, size_t i) {
    return body->shape ? body->shape : ovoid_compound_get_part(body->compound, i).shape;
}

int page_shapes_add_mesh(page_shapes *shapes, cli_page *page, const ovoid_body *body, const mesh_source *source) {
    size_t number, count = body->shape ? 1 : ovoid_compound_get_part_count(body->compound);
    if (!inputs_has_mesh(source)) return 0;
    // Bodies of one geometry share their shapes.
    if (!page_shapes_add(shapes, get_part(body, 0), &number)) return message_error("out of memory"), EXIT_INPUT;
    if (shapes->seen[number] & PAGE_SEEN_MESH) return 0;
    shapes->seen[number] |= PAGE_SEEN_MESH;
    ovoid_mesh *mesh = inputs_read_mesh(source);
    if (!mesh) return EXIT_INPUT;
    int code = 0;
    for (size_t i = 0; i < count && i < ovoid_mesh_get_part_count(mesh) && !code; i++)
        code = keep(shapes, page, mesh, i, get_part(body, i));
    ovoid_mesh_destroy(mesh);
    return code;
}
