// What a mesh is: its hull, a solid or a surface. Exact signs decide (ovoid_triangles_compute_hull_match); volumes are
// for information: what a closed surface encloses is the sum of the signed tetrahedra that its triangles span with any
// one point (the divergence theorem). Cost: linear in the indices but for the matching of open edges.
#include "io/mesh/mesh_build.h"

#include <math.h>
#include <stdlib.h>

// The determinant of three points, seen from o.
static double compute_determinant(const double *o, const double *p, const double *q, const double *r) {
    double a[3], b[3], c[3];
    for (int k = 0; k < 3; k++) a[k] = p[k] - o[k], b[k] = q[k] - o[k], c[k] = r[k] - o[k];
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static double compute_volume(const ovoid_triangles *t) {
    double sum = 0;
    for (size_t i = 0; i < t->count; i++) {
        const uint32_t *index = t->indices + 3 * i;
        sum += compute_determinant(t->xyz, t->xyz + 3 * (size_t)index[0], t->xyz + 3 * (size_t)index[1],
                                   t->xyz + 3 * (size_t)index[2]);
    }
    return fabs(sum) / 6;
}

static ovoid_code compare(const ovoid_faces *faces, const ovoid_shape *hull, ovoid_convexity *c, ovoid_error *error) {
    ovoid_hull_match match;
    ovoid_error why = {OVOID_OK, -1, ""};
    ovoid_triangles triangles = {faces->vertices, faces->vertex_count, NULL, 0};
    uint32_t *indices = mesh_cut_polygons(faces, &triangles.count, &why);
    triangles.indices = indices;
    c->kind = OVOID_MESH_SOLID;
    if (indices && !ovoid_triangles_compute_hull_match(&triangles, hull, &match, &why)) {
        c->kind = !match.is_closed ? OVOID_MESH_SURFACE : match.is_hull ? OVOID_MESH_HULL : OVOID_MESH_SOLID;
        c->allowance = match.allowance;
        c->edges_unmatched = match.edges_unmatched;
        if (match.is_closed) c->mesh_volume = compute_volume(&triangles);
    }
    free(indices);
    // What else is wrong is said where the triangles are wanted.
    if (why.code != OVOID_ERROR_MEMORY) return OVOID_OK;
    if (error) *error = why;
    return why.code;
}

ovoid_code ovoid_mesh_part_compute_convexity(const ovoid_mesh_part *part, const ovoid_shape *hull,
                                             ovoid_convexity *convexity, ovoid_error *error) {
    *convexity = (ovoid_convexity){.mesh_volume = NAN, .hull_volume = ovoid_shape_get_measures(hull).volume};
    return part->faces.face_count ? compare(&part->faces, hull, convexity, error) : OVOID_OK;
}
