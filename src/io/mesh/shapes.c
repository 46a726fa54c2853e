// Shapes from files and into files, one or a list of them.
#include "io/mesh/mesh_build.h"

#include "io/mesh/cursor.h"
#include "io/mesh_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int ovoid_path_is_shape(const char *path) { return path_has_extension(path, "ovoid"); }

// ---- one shape

static ovoid_shape *read_shape_bytes(const char *path, const ovoid_read_options *read,
                                     const ovoid_shape_options *options, ovoid_error *error) {
    where at = {path, 0, -1};
    if ((read && read->scale != 0 && read->scale != 1) ||
        (options && (options->radius != 0 || options->allowance.outside != 0 || options->allowance.inside != 0))) {
        io_report(error, OVOID_ERROR_ARGUMENT, at,
                  "a .ovoid file has its scale, radius and allowance already; fit the mesh anew");
        return NULL;
    }
    bytes file;
    if (bytes_read(path, &file, error)) return NULL;
    ovoid_shape *shape = ovoid_shape_read(file.data, file.size, options, error);
    free(file.data);
    if (!shape) io_prefix_path(error, path);
    return shape;
}

static const ovoid_convexity no_mesh = {.mesh_volume = NAN, .hull_volume = NAN};

/// A hull, and what its mesh is.
typedef struct mesh_hull {
    ovoid_shape *shape;
    ovoid_convexity convexity;
    ovoid_solid *solid; ///< its triangles, where they are wanted
    uint64_t checksum;  ///< of the file
} mesh_hull;

/// How a file's hulls are made.
typedef struct hull_options {
    const ovoid_read_options *read;   ///< may be NULL
    const ovoid_shape_options *shape; ///< may be NULL
    int is_compared;                  ///< 1: with the mesh
    int is_list;                      ///< 1: no triangles are wanted
} hull_options;

// Gives the hull of a mesh that is so only nearly the allowance for it. 0 where there is no memory.
static int allow(mesh_hull *hull, const hull_options *o, ovoid_error *error) {
    if (!(hull->convexity.allowance > 0)) return 1;
    if (o->read && (o->read->hull || o->read->parts)) {
        hull->convexity.allowance = 0;
        return 1;
    }
    ovoid_shape_options options = {.allowance = ovoid_shape_get_allowance(hull->shape),
                                   .allocator = o->shape ? o->shape->allocator : NULL};
    options.allowance.inside = nextafter(options.allowance.inside + hull->convexity.allowance, INFINITY);
    ovoid_shape *allowed = ovoid_shape_create_allowed(hull->shape, &options, error);
    if (!allowed) return 0;
    ovoid_shape_destroy(hull->shape);
    hull->shape = allowed;
    return 1;
}

static int wants_triangles(const hull_options *o, ovoid_mesh_kind kind) {
    if (o->is_list || (o->read && (o->read->hull || o->read->parts))) return 0;
    return kind != OVOID_MESH_HULL || (o->read && o->read->solid);
}

static void mesh_hull_clear(mesh_hull *hull) {
    ovoid_shape_destroy(hull->shape);
    ovoid_solid_destroy(hull->solid);
}

static mesh_hull hull_of_part(const ovoid_mesh *mesh, size_t i, const hull_options *o, const char *path,
                              ovoid_error *error) {
    ovoid_mesh_part part = ovoid_mesh_get_part(mesh, i);
    ovoid_faces faces = part.faces;
    mesh_hull hull = {ovoid_shape_create_from_points(faces.vertices, faces.vertex_count, o->shape, error), no_mesh,
                      NULL, mesh->checksum};
    int is_made = hull.shape != NULL;
    if (is_made && o->is_compared) {
        is_made = ovoid_mesh_part_compute_convexity(&part, hull.shape, &hull.convexity, error) == OVOID_OK;
        if (is_made && wants_triangles(o, hull.convexity.kind))
            is_made = (hull.solid = ovoid_mesh_create_solid(mesh, i, error)) != NULL;
        is_made = is_made && allow(&hull, o, error);
    }
    if (is_made) return hull;
    io_prefix_path(error, path);
    mesh_hull_clear(&hull);
    return (mesh_hull){.convexity = no_mesh};
}

// The shape of a whole file.
static mesh_hull read_hull(const char *path, const hull_options *o, ovoid_error *error) {
    if (ovoid_path_is_shape(path))
        return (mesh_hull){.shape = read_shape_bytes(path, o->read, o->shape, error), .convexity = no_mesh};
    ovoid_read_options whole = {.scale = 0};
    if (o->read) whole = *o->read;
    whole.parts = 0;
    const hull_options options = {&whole, o->shape, o->is_compared, o->is_list};
    ovoid_mesh *mesh = ovoid_mesh_read(path, &whole, error);
    if (!mesh) return (mesh_hull){.convexity = no_mesh};
    mesh_hull hull = hull_of_part(mesh, 0, &options, path, error);
    ovoid_mesh_destroy(mesh);
    return hull;
}

static ovoid_code refuse_kind(const char *path, const ovoid_convexity *c, ovoid_error *error) {
    const where at = {path, 0, -1};
    static const char advice[] = "read it as a solid, or ask for its convex hull (hull)";
    if (c->kind == OVOID_MESH_SOLID)
        return io_fail(error, OVOID_ERROR_NOT_CONVEX, at, "the mesh is closed and not convex; %s", advice);
    return io_fail(error, OVOID_ERROR_NOT_CONVEX, at, "the mesh is not closed, %llu of its edges are open; %s",
                   (unsigned long long)c->edges_unmatched, advice);
}

ovoid_shape *ovoid_shape_read_file(const char *path, const ovoid_read_options *read, const ovoid_shape_options *options,
                                   ovoid_error *error) {
    int is_compared = !(read && read->hull);
    mesh_hull hull = read_hull(path, &(hull_options){read, options, is_compared, 1}, error);
    if (!hull.shape || hull.convexity.kind == OVOID_MESH_HULL) return hull.shape;
    refuse_kind(path, &hull.convexity, error);
    mesh_hull_clear(&hull);
    return NULL;
}

ovoid_code ovoid_shape_write_file(const ovoid_shape *shape, const char *path, ovoid_error *error) {
    size_t size = ovoid_shape_write(shape, NULL, 0);
    void *buffer = malloc(size);
    if (!buffer) return io_fail_memory(error, path);
    ovoid_shape_write(shape, buffer, size);
    ovoid_output *output = ovoid_output_open(path, error);
    ovoid_code code = output ? OVOID_OK : OVOID_ERROR_FILE;
    if (output) {
        (void)fwrite(buffer, 1, size, ovoid_output_get_file(output)); // ovoid_output_commit checks ferror
        code = ovoid_output_commit(output, error);
    }
    ovoid_output_close(output);
    free(buffer);
    return code;
}

// ---- lists

/// A shape and its name; some entries share the shape of an earlier one.
typedef struct shape_entry {
    char *name;
    mesh_hull hull;
    uint64_t hash; ///< of the name
    int is_shared;
} shape_entry;

struct ovoid_shapes {
    shape_entry *entries;
    size_t count, capacity;
};

void ovoid_shapes_destroy(ovoid_shapes *shapes) {
    if (!shapes) return;
    for (size_t i = 0; i < shapes->count; i++) {
        free(shapes->entries[i].name);
        if (!shapes->entries[i].is_shared) mesh_hull_clear(&shapes->entries[i].hull);
    }
    free(shapes->entries);
    free(shapes);
}

size_t ovoid_shapes_get_count(const ovoid_shapes *shapes) { return shapes->count; }

ovoid_named_shape ovoid_shapes_get(const ovoid_shapes *shapes, size_t i) {
    const mesh_hull *hull = &shapes->entries[i].hull;
    return (ovoid_named_shape){shapes->entries[i].name, hull->shape, hull->convexity, hull->solid};
}

uint64_t shapes_get_checksum(const ovoid_shapes *shapes) { return shapes->entries[0].hull.checksum; }

/// Shapes under construction, and how their files are read.
typedef struct shapes_reader {
    ovoid_shapes *shapes;
    const ovoid_read_options *read;     ///< may be NULL
    const ovoid_shape_options *options; ///< may be NULL
    ovoid_error *error;                 ///< may be NULL
} shapes_reader;

// Adds an entry that owns the shape and copies the name. The shape is destroyed where there is no memory.
static ovoid_code add_entry(shapes_reader *r, const char *name, mesh_hull hull, int is_shared) {
    ovoid_shapes *shapes = r->shapes;
    char *copy = text_copy(name, strlen(name));
    if (!copy || !array_reserve((void **)&shapes->entries, &shapes->capacity, shapes->count, sizeof(shape_entry))) {
        free(copy);
        if (!is_shared) mesh_hull_clear(&hull);
        return io_fail_memory(r->error, name);
    }
    shapes->entries[shapes->count++] = (shape_entry){copy, hull, text_hash(name), is_shared};
    return OVOID_OK;
}

static hull_options get_hull_options(const shapes_reader *r, int is_list) {
    return (hull_options){r->read, r->options, 1, is_list};
}

static ovoid_code add_parts(shapes_reader *r, const ovoid_mesh *mesh, const char *path) {
    hull_options options = get_hull_options(r, 0);
    for (size_t i = 0; i < ovoid_mesh_get_part_count(mesh); i++) {
        char number[40];
        snprintf(number, sizeof number, "part %zu", i);
        const char *name = ovoid_mesh_get_part(mesh, i).name;
        mesh_hull hull = hull_of_part(mesh, i, &options, path, r->error);
        ovoid_code code = OVOID_ERROR_HULL;
        if (hull.shape) code = add_entry(r, name[0] ? name : number, hull, 0);
        if (code) return code;
    }
    return OVOID_OK;
}

static ovoid_code fill_from_file(shapes_reader *r, const char *path) {
    if (!r->read || !r->read->parts || ovoid_path_is_shape(path)) {
        hull_options options = get_hull_options(r, 0);
        mesh_hull hull = read_hull(path, &options, r->error);
        return hull.shape ? add_entry(r, path, hull, 0) : OVOID_ERROR_FILE;
    }
    ovoid_mesh *mesh = ovoid_mesh_read(path, r->read, r->error);
    if (!mesh) return OVOID_ERROR_FILE;
    ovoid_code code = add_parts(r, mesh, path);
    ovoid_mesh_destroy(mesh);
    return code;
}

ovoid_shapes *ovoid_shapes_read_file(const char *path, const ovoid_read_options *read,
                                     const ovoid_shape_options *options, ovoid_error *error) {
    ovoid_shapes *shapes = calloc(1, sizeof *shapes);
    if (!shapes) {
        io_fail_memory(error, path);
        return NULL;
    }
    if (!fill_from_file(&(shapes_reader){shapes, read, options, error}, path)) return shapes;
    ovoid_shapes_destroy(shapes);
    return NULL;
}

ovoid_compound *ovoid_shapes_create_compound(const ovoid_shapes *shapes, const ovoid_compound_options *options,
                                             ovoid_error *error) {
    ovoid_posed_shape *parts = malloc((shapes->count + 1) * sizeof *parts);
    if (!parts) {
        io_fail_memory(error, shapes->count ? shapes->entries[0].name : "compound");
        return NULL;
    }
    for (size_t i = 0; i < shapes->count; i++)
        parts[i] = (ovoid_posed_shape){shapes->entries[i].hull.shape, ovoid_pose_make_identity()};
    ovoid_compound *compound = ovoid_compound_create(parts, shapes->count, options, error);
    free(parts);
    return compound;
}

// ---- LIST files

// The shape of a line: read, or shared with the first line of the same path.
static ovoid_code add_line(shapes_reader *r, const char *path) {
    const ovoid_shapes *shapes = r->shapes;
    uint64_t hash = text_hash(path);
    for (size_t i = 0; i < shapes->count; i++)
        if (shapes->entries[i].hash == hash && strcmp(shapes->entries[i].name, path) == 0)
            return add_entry(r, path, shapes->entries[i].hull, 1);
    hull_options options = get_hull_options(r, 1);
    mesh_hull hull = read_hull(path, &options, r->error);
    return hull.shape ? add_entry(r, path, hull, 0) : OVOID_ERROR_FILE;
}

// Puts the list's path and line before the error of a file that cannot be opened.
static ovoid_code name_line(const char *list, int64_t line, ovoid_error *error) {
    if (!error || error->code != OVOID_ERROR_FILE) return OVOID_ERROR_FILE;
    ovoid_error inner = *error;
    return io_fail(error, inner.code, (where){list, line, -1}, "%s", inner.message);
}

static ovoid_code fill_from_list(shapes_reader *r, const char *list, bytes file) {
    ovoid_error *error = r->error;
    cursor c = {file.data, file.data + file.size, 1};
    for (; skip_to_text(&c, '#'); skip_line(&c)) {
        // The line without the blanks at its ends.
        const char *begin = c.at;
        while (!is_line_end(&c)) c.at++;
        const char *end = c.at;
        while (is_blank(end[-1])) end--;
        if (memchr(begin, 0, (size_t)(end - begin)))
            return io_fail(error, OVOID_ERROR_FORMAT, (where){list, c.line, -1}, "the path holds a zero byte");
        char *name = text_copy(begin, (size_t)(end - begin));
        char *path = name ? path_join(list, name) : NULL;
        ovoid_code code = path ? add_line(r, path) : io_fail_memory(error, list);
        free(name);
        free(path);
        if (code) return name_line(list, c.line, error);
    }
    if (!r->shapes->count) return io_fail(error, OVOID_ERROR_EMPTY, (where){list, 0, -1}, "the list names no files");
    return OVOID_OK;
}

ovoid_shapes *ovoid_shapes_read_list(const char *path, const ovoid_read_options *read,
                                     const ovoid_shape_options *options, ovoid_error *error) {
    bytes file;
    if (bytes_read_input(path, OVOID_FILE_SIZE_MAX, &file, error)) return NULL;
    ovoid_shapes *shapes = calloc(1, sizeof *shapes);
    shapes_reader r = {shapes, read, options, error};
    ovoid_code code = shapes ? fill_from_list(&r, path, bytes_skip_mark(file)) : io_fail_memory(error, path);
    free(file.data);
    if (!code) return shapes;
    ovoid_shapes_destroy(shapes);
    return NULL;
}
