// Reading shapes, lists and scenes; each failure becomes one message and the caller's exit code 3.
#include "base/inputs.h"

#include "base/message.h"
#include "base/progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *inputs_get_unit(const read_settings *settings) {
    static const char *const units[] = {"m", "cm", "mm", "um", "in", "ft"};
    return settings->unit == INPUTS_NO_UNIT ? "" : units[settings->unit];
}

ovoid_read_options inputs_make_options(const read_settings *settings) {
    const char *unit = inputs_get_unit(settings);
    return (ovoid_read_options){
        .scale = settings->scale, .unit = unit[0] ? unit : NULL, .hull = settings->hull, .solid = settings->solid};
}

/// The number of parts of a mesh file, if there are several and each is known to be its hull; else 0.
static size_t count_convex_parts(const char *path, const read_settings *settings) {
    ovoid_error error;
    ovoid_read_options read = inputs_make_options(settings);
    read.parts = 1;
    ovoid_shapes *parts = strcmp(path, "-") == 0 ? NULL : ovoid_shapes_read_file(path, &read, NULL, &error);
    if (!parts) return 0;
    size_t count = ovoid_shapes_get_count(parts), convex = 0;
    for (size_t i = 0; i < count; i++) {
        ovoid_convexity c = ovoid_shapes_get(parts, i).convexity;
        convex += c.kind == OVOID_MESH_HULL && c.mesh_volume > 0;
    }
    ovoid_shapes_destroy(parts);
    return count > 1 && convex == count ? count : 0;
}

/// Warns of a mesh that is queried as its hull; convex_parts: its number of parts if each is its hull, 0: not known.
static void warn_hull(const char *path, const char *part, const ovoid_convexity *c, size_t convex_parts) {
    char advice[160] = "", share[120] = "";
    if (convex_parts)
        snprintf(advice, sizeof advice,
                 "; each of its %zu parts is convex: --parts, or \"parts\": true in a scene, takes these",
                 convex_parts);
    if (c->kind == OVOID_MESH_SOLID && c->mesh_volume <= c->hull_volume)
        snprintf(share, sizeof share, ", of which it is %.3g %% (%.6g of %.6g)", 100 * c->mesh_volume / c->hull_volume,
                 c->mesh_volume, c->hull_volume);
    message_warning("%s%s%s is not %s and counts as its hull%s%s", path, *part ? ": " : "", part,
                    c->kind == OVOID_MESH_SURFACE ? "closed" : "convex", share, advice);
}

void inputs_warn_part(const char *path, const char *part, const ovoid_convexity *c) {
    if (c->kind != OVOID_MESH_HULL) warn_hull(path, part, c, 0);
}

void inputs_warn_file(const char *path, const read_settings *settings, const ovoid_convexity *c) {
    if (c->kind != OVOID_MESH_HULL) warn_hull(path, "", c, count_convex_parts(path, settings));
}

void inputs_warn_surface(const char *path, uint64_t open_edges) {
    message_warning("%s is not closed, %llu of its edges are open: it counts as its surface, which has no inside; "
                    "--hull, or \"hull\": true in a scene, takes its hull",
                    path, (unsigned long long)open_edges);
}

/// The largest number of warnings about the meshes of one list or scene.
#define WARNINGS_MAX 10

/// Warns of the meshes of a list or a scene, each name once.
static void warn_all(size_t count, ovoid_named_shape (*get)(const void *context, size_t i),
                     const ovoid_solid *(*get_solid)(const void *context, size_t i), const void *context) {
    const char *named[WARNINGS_MAX];
    size_t warned = 0, left_out = 0;
    for (size_t i = 0; i < count; i++) {
        ovoid_named_shape mesh = get(context, i);
        size_t k = 0;
        int is_surface = get_solid(context, i) && mesh.convexity.kind == OVOID_MESH_SURFACE;
        if (mesh.convexity.kind == OVOID_MESH_HULL || (get_solid(context, i) && !is_surface)) continue;
        while (k < warned && strcmp(named[k], mesh.name) != 0) k++;
        left_out += k == WARNINGS_MAX;
        if (k < warned || k == WARNINGS_MAX) continue;
        named[warned++] = mesh.name;
        if (is_surface)
            inputs_warn_surface(mesh.name, mesh.convexity.edges_unmatched);
        else
            inputs_warn_part(mesh.name, "", &mesh.convexity);
    }
    if (left_out) message_warning("%zu more meshes are not closed, or not convex and count as their hulls", left_out);
}

static ovoid_named_shape get_shape(const void *context, size_t i) { return ovoid_shapes_get(context, i); }
static const ovoid_solid *get_none(const void *context, size_t i) { return (void)context, (void)i, NULL; }
static ovoid_named_shape get_mesh(const void *context, size_t i) { return ovoid_scene_get_mesh(context, i); }
static const ovoid_solid *get_mesh_solid(const void *context, size_t i) {
    return ovoid_scene_get_mesh_solid(context, i);
}

static void warn_body(const char *path, const cli_body *body, const read_settings *settings) {
    for (size_t i = 0; i < ovoid_shapes_get_count(body->parts); i++) {
        ovoid_named_shape part = ovoid_shapes_get(body->parts, i);
        if (part.solid) continue;
        if (body->compound)
            inputs_warn_part(path, part.name, &part.convexity);
        else
            inputs_warn_file(path, settings, &part.convexity);
    }
}

void inputs_warn_bodies(const char *const *paths, const cli_body *bodies, size_t count, const read_settings *settings) {
    for (size_t i = 0; i < count; i++)
        if (!i || strcmp(paths[i], paths[i - 1]) != 0) warn_body(paths[i], &bodies[i], settings);
}

void inputs_warn_list(const ovoid_shapes *shapes) {
    warn_all(ovoid_shapes_get_count(shapes), get_shape, get_none, shapes);
}
void inputs_warn_scene(const ovoid_scene *scene) {
    warn_all(ovoid_scene_get_mesh_count(scene), get_mesh, get_mesh_solid, scene);
}

int inputs_open_body(const char *path, const read_settings *settings, int parts, cli_body *body) {
    ovoid_error error;
    *body = (cli_body){NULL, NULL, NULL};
    ovoid_read_options read = inputs_make_options(settings);
    read.parts = parts;
    progress_read(path);
    body->parts = ovoid_shapes_read_file(path, &read, NULL, &error);
    progress_hide();
    if (body->parts && parts) body->compound = ovoid_shapes_create_compound(body->parts, NULL, &error);
    if (body->parts && !parts) body->shape = ovoid_shapes_get(body->parts, 0).shape;
    if (!body->shape && !body->compound) {
        message_error("%s", error.message);
        inputs_close_body(body);
        return EXIT_INPUT;
    }
    return 0;
}

int inputs_open_pair(const char *const paths[2], const read_settings *settings, int parts, cli_body bodies[2]) {
    bodies[1] = (cli_body){NULL, NULL, NULL};
    int code = inputs_open_body(paths[0], settings, parts, &bodies[0]);
    if (!code) code = inputs_open_body(paths[1], settings, parts, &bodies[1]);
    if (!code) return 0;
    inputs_close_body(&bodies[0]);
    inputs_close_body(&bodies[1]);
    return code;
}

ovoid_body inputs_get_body(const cli_body *body, const ovoid_pose *pose) {
    return (ovoid_body){.shape = body->shape, .compound = body->compound, .pose = *pose};
}

void inputs_close_body(cli_body *body) {
    ovoid_compound_destroy(body->compound);
    ovoid_shapes_destroy(body->parts);
    *body = (cli_body){NULL, NULL, NULL};
}

ovoid_scene *inputs_read_scene(const char *path, int hulls) {
    ovoid_error error;
    ovoid_scene *scene = (hulls ? ovoid_scene_read_hulls : ovoid_scene_read)(path, NULL, &error);
    if (!scene) message_error("%s", error.message);
    return scene;
}

unsigned inputs_get_fields(const ovoid_scene *scene) {
    for (size_t i = 0; i < ovoid_scene_get_mesh_count(scene); i++)
        if (ovoid_scene_get_mesh_solid(scene, i)) return OVOID_RECORD_MESHES | OVOID_RECORD_SOLIDS;
    return 0;
}

ovoid_pose *inputs_copy_poses(const ovoid_scene *scene) {
    size_t count = ovoid_scene_get_count(scene);
    ovoid_pose *poses = malloc((count + 1) * sizeof *poses);
    if (!poses) message_error("out of memory");
    for (size_t i = 0; i < count && poses; i++) poses[i] = ovoid_scene_get(scene, i).pose;
    return poses;
}

ovoid_shapes *inputs_read_list(const char *path, const read_settings *settings) {
    ovoid_error error;
    ovoid_read_options read = inputs_make_options(settings);
    ovoid_shapes *shapes = ovoid_shapes_read_list(path, &read, NULL, &error);
    if (!shapes) message_error("%s", error.message);
    return shapes;
}

int inputs_is_scene(const char *path) {
    size_t length = strlen(path);
    return (length > 5 && strcmp(path + length - 5, ".json") == 0) ||
           (length > 7 && strcmp(path + length - 7, ".ovoids") == 0);
}

mesh_source inputs_find_mesh(const ovoid_scene *scene, size_t i) {
    ovoid_scene_object o = ovoid_scene_get(scene, i);
    return (mesh_source){.path = o.mesh, .read = o.read, .scene = scene, .object = i};
}

int inputs_has_mesh(const mesh_source *source) {
    return source->path && !ovoid_path_is_shape(source->path) && strcmp(source->path, "-") != 0;
}

ovoid_mesh *inputs_read_mesh(const mesh_source *source) {
    ovoid_error error;
    ovoid_mesh *mesh = source->scene ? ovoid_scene_read_mesh(source->scene, source->object, &error)
                                     : ovoid_mesh_read(source->path, &source->read, &error);
    if (!mesh) message_error("%s", error.message);
    return mesh;
}
