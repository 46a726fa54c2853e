// A mesh in the place of its hull: the faces that look away from the eye, then those toward it, each from far to near
// (the painter's algorithm, by the depth of their middles). Of a closed surface the second hide the first. Faces that
// cut each other, and very long ones, may be painted in the wrong order.
// Cost: n log n in the faces.
#include "io/draw/picture_parts.h"

#include "io/text.h"
#include "linear/rotation.h"

#include <stdlib.h>

/// A face of the mesh: where its indices begin, and how it is seen.
typedef struct mesh_face {
    size_t first;
    uint32_t size;
    int is_front; ///< its outer side is seen
    double depth;
    vec3 normal; ///< toward the eye
} mesh_face;

// The sum of the cross products of a polygon's edges: twice its area along its normal (M. E. Newell, 1972).
static vec3 compute_normal(const vec3 *points, const uint32_t *corners, uint32_t size) {
    vec3 sum = {0, 0, 0};
    for (uint32_t i = 1; i + 1 < size; i++)
        sum = vec3_add(sum, vec3_cross(vec3_sub(points[corners[i]], points[corners[0]]),
                                       vec3_sub(points[corners[i + 1]], points[corners[0]])));
    return sum;
}

static int compare_faces(const void *a, const void *b) {
    const mesh_face *p = a, *q = b;
    if (p->is_front != q->is_front) return p->is_front - q->is_front;
    if (p->depth != q->depth) return p->depth < q->depth ? -1 : 1;
    return (p->first > q->first) - (p->first < q->first);
}

// 1 where most faces are turned outward, -1 where inward: the sign of the volume that they enclose.
static double find_side(const ovoid_faces *mesh, const vec3 *points) {
    double sum = 0;
    for (size_t i = 0, first = 0; i < mesh->face_count; first += mesh->sizes[i++]) {
        vec3 normal = compute_normal(points, mesh->indices + first, mesh->sizes[i]);
        sum += mesh->sizes[i] ? vec3_dot(normal, vec3_sub(points[mesh->indices[first]], points[0])) : 0;
    }
    return sum < 0 ? -1 : 1;
}

// Fills in the faces, sorted in the order of painting.
static void sort_faces(const ovoid_faces *mesh, const vec3 *points, const camera *c, mesh_face *faces) {
    double side = find_side(mesh, points);
    for (size_t i = 0, first = 0; i < mesh->face_count; first += mesh->sizes[i++]) {
        const uint32_t *corners = mesh->indices + first;
        uint32_t size = mesh->sizes[i];
        vec3 normal = compute_normal(points, corners, size);
        double depth = 0, toward = vec3_dot(normal, c->eye);
        for (uint32_t k = 0; k < size; k++) depth += camera_get_depth(c, points[corners[k]]) / size;
        faces[i] = (mesh_face){first, size, side * toward > 0, depth, toward < 0 ? vec3_neg(normal) : normal};
    }
    qsort(faces, mesh->face_count, sizeof *faces, compare_faces);
}

static void write_faces(const figure *f, const drawing *d, const vec3 *points, const mesh_face *faces) {
    const ovoid_faces *mesh = f->body->mesh;
    fputs("<g fill=\"currentColor\" stroke=\"currentColor\" stroke-width=\".6\" stroke-linejoin=\"round\">\n", d->file);
    for (size_t i = 0; i < mesh->face_count; i++) {
        char hex[8];
        if (f->body->is_mesh == OVOID_PICTURE_CLOSED && !faces[i].is_front) continue;
        color_write(facet_get_color(f->base, vec3_unit(faces[i].normal), &d->camera), hex);
        svg_path path = {d->file, 0, 0};
        fprintf(d->file, "<path color=\"%s\" d=\"", hex);
        for (uint32_t k = 0; k < faces[i].size; k++) {
            vec2 p = camera_project(&d->camera, points[mesh->indices[faces[i].first + k]]);
            (k ? svg_line : svg_move)(&path, p);
        }
        svg_close(&path);
        fputs("\"/>\n", d->file);
    }
    fputs("</g>\n", d->file);
}

ovoid_code figure_draw_mesh(const figure *f, const drawing *d, ovoid_error *error) {
    const ovoid_faces *mesh = f->body->mesh;
    vec3 *points = malloc((mesh->vertex_count + 1) * sizeof *points);
    mesh_face *faces = malloc((mesh->face_count + 1) * sizeof *faces);
    ovoid_code code = points && faces ? OVOID_OK : io_fail_memory(error, "picture");
    if (!code) {
        mat3 rotation = quat_to_mat3(f->body->pose.rotation);
        for (size_t i = 0; i < mesh->vertex_count; i++)
            points[i] = vec3_add(f->body->pose.position, mat3_mul_vec3(rotation, vec3_at(mesh->vertices, (uint32_t)i)));
        sort_faces(mesh, points, &d->camera, faces);
        write_faces(f, d, points, faces);
    }
    free(points);
    free(faces);
    return code;
}
