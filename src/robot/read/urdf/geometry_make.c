// The shapes of the geometry: sorted, so that equal ones are neighbours and are made once, and a mesh file is read once
// for all its scales.
#include "robot/read/body/mesh_body.h"
#include "robot/read/urdf/geometry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int compare_geometries(const geometry *a, const geometry *b) {
    int order = strcmp(a->path, b->path);
    return order ? order : primitive_compare(&a->what, &b->what);
}

static int compare_made(const void *a, const void *b) {
    const geometry *m = *(geometry *const *)a, *n = *(geometry *const *)b;
    int order = compare_geometries(m, n);
    return order ? order : (m->index > n->index) - (m->index < n->index);
}

static ovoid_code keep_shape(robot_reader *r, const geometry *g, ovoid_shape *shape, const ovoid_error *why) {
    ovoid_robot_file *file = r->file;
    if (!shape) return robot_fail(r, g->at, why->code, "%s", why->message);
    if (!array_reserve((void **)&file->shapes, &file->shape_capacity, file->shape_count, sizeof *file->shapes)) {
        ovoid_shape_destroy(shape);
        return robot_fail_memory(r);
    }
    file->shapes[file->shape_count++] = shape;
    return OVOID_OK;
}

static ovoid_code make_primitive(robot_reader *r, geometry *g) {
    ovoid_error why = {OVOID_ERROR_MEMORY, -1, ""};
    g->shape = r->file->shape_count;
    g->shape_count = 1;
    return keep_shape(r, g, primitive_create(&g->what, r->options, &why), &why);
}

/// A mesh file that is open, for its scales.
typedef struct open_mesh {
    const char *path; ///< "": none
    ovoid_mesh *mesh;
    int is_measured;
    ovoid_convexity convexity; ///< unscaled, summed over the parts
    const char **names;        ///< of the parts; NULL: one part without a name
    ovoid_solid *solid;        ///< unscaled; NULL: none is wanted yet
} open_mesh;

// The hull of a part with each coordinate multiplied by its factor, NULL for none; mirrored or not, points are points.
static ovoid_shape *create_hull(const robot_reader *r, const open_mesh *open, size_t part, const double *scale,
                                ovoid_error *why) {
    ovoid_faces faces = ovoid_mesh_get_part(open->mesh, part).faces;
    if (!scale) return ovoid_shape_create_from_points(faces.vertices, faces.vertex_count, r->options->shape, why);
    double *xyz = malloc(3 * faces.vertex_count * sizeof *xyz);
    if (!xyz) {
        (void)io_fail_memory(why, open->path);
        return NULL;
    }
    for (size_t i = 0; i < 3 * faces.vertex_count; i++) xyz[i] = scale[i % 3] * faces.vertices[i];
    ovoid_shape *shape = ovoid_shape_create_from_points(xyz, faces.vertex_count, r->options->shape, why);
    free(xyz);
    return shape;
}

static int is_unscaled(const geometry *g) {
    const double *s = g->what.size;
    return s[0] == 1 && s[1] == 1 && s[2] == 1;
}

// What the hulls of the parts add to the mesh, of its file's own size: once for all scales.
static ovoid_code measure(robot_reader *r, const geometry *g, open_mesh *open) {
    ovoid_error why = {OVOID_ERROR_MEMORY, -1, ""};
    if (open->is_measured) return OVOID_OK;
    for (size_t i = 0; i < g->shape_count; i++) {
        ovoid_shape *own = is_unscaled(g) ? NULL : create_hull(r, open, i, NULL, &why);
        if (!own && !is_unscaled(g)) return robot_fail(r, g->at, why.code, "%s: %s", g->path, why.message);
        ovoid_convexity c;
        const ovoid_shape *hull = own ? own : r->file->shapes[g->shape + i];
        ovoid_mesh_part part = ovoid_mesh_get_part(open->mesh, i);
        ovoid_code code = ovoid_mesh_part_compute_convexity(&part, hull, &c, NULL);
        ovoid_shape_destroy(own);
        if (code) return robot_fail_memory(r);
        open->convexity.mesh_volume += c.mesh_volume;
        open->convexity.hull_volume += c.hull_volume;
        if (c.kind > open->convexity.kind) open->convexity.kind = c.kind;
    }
    open->is_measured = 1;
    return OVOID_OK;
}

// ---- what a mesh is

static ovoid_code keep_solid(robot_reader *r, geometry *g, ovoid_solid *solid) {
    ovoid_robot_file *file = r->file;
    if (!solid) return OVOID_OK;
    if (!array_reserve((void **)&file->solids, &file->solid_capacity, file->solid_count, sizeof *file->solids)) {
        ovoid_solid_destroy(solid);
        return robot_fail_memory(r);
    }
    g->solid = file->solids[file->solid_count++] = solid;
    return OVOID_OK;
}

// The triangles of the file with each coordinate multiplied by its factor; mirrored ones are inside out, which does not
// matter. What the scaled triangles are is looked at anew: rounding may take them off their hull.
static ovoid_code make_scaled(const open_mesh *open, const double *scale, ovoid_shape *hull, mesh_body *body,
                              ovoid_error *why) {
    ovoid_solid_report report = ovoid_solid_get_report(open->solid);
    const double *points = ovoid_solid_get_points(open->solid);
    size_t count = (size_t)report.points, triangles = (size_t)report.triangles;
    double *xyz = malloc(3 * count * sizeof *xyz);
    uint32_t *indices = malloc(3 * triangles * sizeof *indices);
    ovoid_code code = OVOID_ERROR_MEMORY;
    if (xyz && indices) {
        for (size_t i = 0; i < 3 * count; i++) xyz[i] = scale[i % 3] * points[i];
        for (size_t i = 0; i < triangles; i++) ovoid_solid_get_triangle(open->solid, i, indices + 3 * i);
        const ovoid_triangles all = {xyz, count, indices, triangles};
        code = mesh_body_make(&all, hull, NULL, body, why);
    } else {
        ovoid_shape_destroy(hull);
        (void)io_fail_memory(why, open->path);
    }
    free(xyz);
    free(indices);
    return code;
}

// A mesh is what its triangles are, unless its hull, or hulls of parts, are asked for, as in all files.
static ovoid_code make_body(robot_reader *r, geometry *g, open_mesh *open, ovoid_shape *hull, mesh_body *body) {
    ovoid_error why = {OVOID_ERROR_MEMORY, -1, ""};
    *body = (mesh_body){.kind = OVOID_MESH_HULL, .shape = hull};
    if (r->options->hull || r->options->parts || !ovoid_mesh_get_part(open->mesh, 0).faces.face_count) return OVOID_OK;
    if (!open->solid && !(open->solid = ovoid_mesh_create_solid(open->mesh, 0, &why)))
        ovoid_shape_destroy(hull);
    else if (make_scaled(open, g->what.size, hull, body, &why) == OVOID_OK)
        return OVOID_OK;
    if (why.code == OVOID_ERROR_MEMORY) return robot_fail_memory(r);
    return robot_fail(r, g->at, why.code, "%s: %s; --hull takes its hull", g->path, why.message);
}

static void tell_surface(const robot_reader *r, const geometry *g, const mesh_body *body) {
    if (body->kind == OVOID_MESH_SURFACE)
        robot_note(r, g->at,
                   "the mesh %.200s is not closed, %llu of its edges are open: it counts as its surface, which has no "
                   "inside (--hull takes its hull)",
                   g->address, (unsigned long long)body->edges_open);
}

// ---- meshes

static ovoid_code keep_part_names(robot_reader *r, open_mesh *open) {
    size_t count = ovoid_mesh_get_part_count(open->mesh);
    if (!r->options->parts) return OVOID_OK;
    open->names = pool_get(&r->scratch, count, sizeof *open->names);
    if (!open->names) return robot_fail_memory(r);
    for (size_t i = 0; i < count; i++) {
        const char *name = ovoid_mesh_get_part(open->mesh, i).name;
        if (name[0] && !(open->names[i] = pool_copy(&r->file->memory, name, strlen(name)))) return robot_fail_memory(r);
    }
    return OVOID_OK;
}

static ovoid_code open_file(robot_reader *r, const geometry *g, open_mesh *open) {
    ovoid_error why = {OVOID_ERROR_MEMORY, -1, ""};
    ovoid_read_options read = {.parts = r->options->parts, .trusted = r->options->trusted};
    ovoid_mesh_destroy(open->mesh);
    ovoid_solid_destroy(open->solid);
    *open = (open_mesh){.path = g->path, .mesh = ovoid_mesh_read(g->path, &read, &why)};
    if (!open->mesh) return robot_fail(r, g->at, why.code, "%s", why.message);
    return keep_part_names(r, open);
}

static ovoid_code add_mesh(robot_reader *r, const geometry *g, const open_mesh *open, const mesh_body *body) {
    ovoid_robot_file *file = r->file;
    const double *s = g->what.size;
    double volume = fabs(s[0] * s[1] * s[2]);
    ovoid_robot_mesh mesh = {.path = pool_copy(&file->memory, g->path, strlen(g->path)),
                             .address = pool_copy(&file->memory, g->address, strlen(g->address)),
                             .scale = {s[0], s[1], s[2]},
                             .part_count = g->shape_count,
                             .convexity = open->convexity,
                             .kind = r->options->parts ? OVOID_MESH_PARTS : body->kind,
                             .allowance = body->allowance};
    mesh.convexity.mesh_volume *= volume;
    mesh.convexity.hull_volume *= volume;
    if (!mesh.path || !mesh.address) return robot_fail_memory(r);
    file->meshes[file->mesh_count++] = mesh;
    return OVOID_OK;
}

static ovoid_code make_mesh(robot_reader *r, geometry *g, open_mesh *open) {
    ovoid_code code = strcmp(open->path, g->path) == 0 ? OVOID_OK : open_file(r, g, open);
    if (code) return code;
    g->shape = r->file->shape_count;
    g->shape_count = ovoid_mesh_get_part_count(open->mesh);
    g->part_names = open->names;
    mesh_body body = {.kind = OVOID_MESH_HULL};
    for (size_t i = 0; i < g->shape_count && !code; i++) {
        ovoid_error why = {OVOID_ERROR_MEMORY, -1, ""};
        ovoid_shape *hull = create_hull(r, open, i, is_unscaled(g) ? NULL : g->what.size, &why);
        if (hull) code = make_body(r, g, open, hull, &body);
        if (!code) code = keep_shape(r, g, hull ? body.shape : NULL, &why);
        if (code)
            ovoid_solid_destroy(body.solid);
        else
            code = keep_solid(r, g, body.solid);
        body.solid = NULL;
        if (!code) tell_surface(r, g, &body);
    }
    if (!code) code = measure(r, g, open);
    return code ? code : add_mesh(r, g, open, &body);
}

ovoid_code geometry_make(robot_reader *r, geometry_list *list) {
    open_mesh open = {.path = ""};
    ovoid_robot_file *file = r->file;
    ovoid_code code = OVOID_OK;
    geometry_sort(list, compare_made);
    file->meshes = pool_get(&file->memory, list->count, sizeof *file->meshes);
    if (!file->meshes) return robot_fail_memory(r);
    for (size_t i = 0; i < list->count && !code; i++) {
        geometry *g = list->order[i], *before = i ? list->order[i - 1] : NULL;
        if (before && compare_geometries(before, g) == 0)
            g->shape = before->shape, g->shape_count = before->shape_count, g->solid = before->solid,
            g->part_names = before->part_names;
        else
            code = *g->path ? make_mesh(r, g, &open) : make_primitive(r, g);
        if (!code && *g->path) file->meshes[file->mesh_count - 1].use_count++;
    }
    ovoid_mesh_destroy(open.mesh);
    ovoid_solid_destroy(open.solid);
    return code;
}
