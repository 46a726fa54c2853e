// Meshes: which reader a file gets, the mesh under construction, and the cursor of the text formats.
// A reader never trusts a count: arrays grow with what the file really holds.
#include "io/mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- the mesh under construction

static void free_part(mesh_part *part) {
    free(part->name);
    free(part->points);
    free(part->indices);
    free(part->sizes);
}

void ovoid_mesh_destroy(ovoid_mesh *mesh) {
    if (!mesh) return;
    for (size_t i = 0; i < mesh->part_count; i++) free_part(&mesh->parts[i]);
    free(mesh->parts);
    free(mesh);
}

size_t ovoid_mesh_get_part_count(const ovoid_mesh *mesh) { return mesh->part_count; }

ovoid_mesh_part ovoid_mesh_get_part(const ovoid_mesh *mesh, size_t i) {
    const mesh_part *p = &mesh->parts[i];
    return (ovoid_mesh_part){p->name, {p->points, p->point_count, p->indices, p->sizes, p->face_count}};
}

mesh_part *mesh_add_part(mesh_reader *reader, const char *name, size_t length) {
    ovoid_mesh *mesh = reader->mesh;
    if (mesh->part_count >= OVOID_MESH_PARTS_MAX) {
        io_report(reader->error, OVOID_ERROR_LIMIT, (where){reader->path, 0, -1}, "more than %d parts",
                  OVOID_MESH_PARTS_MAX);
        return NULL;
    }
    char *copy = text_copy(name, length);
    if (!copy || !array_reserve((void **)&mesh->parts, &mesh->part_capacity, mesh->part_count, sizeof(mesh_part))) {
        free(copy);
        io_fail_memory(reader->error, reader->path);
        return NULL;
    }
    mesh_part *part = &mesh->parts[mesh->part_count++];
    *part = (mesh_part){.name = copy};
    return part;
}

ovoid_code mesh_add_point(mesh_reader *reader, mesh_part *part, const double xyz[3], where at) {
    double scaled[3];
    for (int k = 0; k < 3; k++) {
        if (!isfinite(xyz[k]))
            return io_fail(reader->error, OVOID_ERROR_NOT_FINITE, at, "vertex %zu has a coordinate that is %s",
                           reader->mesh->point_count, isnan(xyz[k]) ? "not a number" : "infinite");
        scaled[k] = xyz[k] * reader->scale;
        if (!(fabs(scaled[k]) <= OVOID_LENGTH_MAX))
            return io_fail(reader->error, OVOID_ERROR_RANGE, at, "vertex %zu has the coordinate %g, beyond %g",
                           reader->mesh->point_count, scaled[k], OVOID_LENGTH_MAX);
    }
    if (reader->mesh->point_count >= OVOID_MESH_POINTS_MAX)
        return io_fail(reader->error, OVOID_ERROR_LIMIT, at, "more than %d points", OVOID_MESH_POINTS_MAX);
    if (!array_reserve((void **)&part->points, &part->point_capacity, part->point_count, 3 * sizeof(double)))
        return io_fail_memory(reader->error, reader->path);
    memcpy(part->points + 3 * part->point_count++, scaled, sizeof scaled);
    reader->mesh->point_count++;
    return OVOID_OK;
}

ovoid_code mesh_add_index(mesh_reader *reader, mesh_part *part, uint32_t index) {
    if (reader->mesh->index_count++ >= MESH_INDICES_MAX)
        return io_fail(reader->error, OVOID_ERROR_LIMIT, (where){reader->path, 0, -1}, "more than %d corners of faces",
                       MESH_INDICES_MAX);
    if (!array_reserve((void **)&part->indices, &part->index_capacity, part->index_count, sizeof(uint32_t)))
        return io_fail_memory(reader->error, reader->path);
    part->indices[part->index_count++] = index;
    return OVOID_OK;
}

ovoid_code mesh_end_face(mesh_reader *reader, mesh_part *part, uint32_t size) {
    if (size < 3) {
        part->index_count -= size;
        return OVOID_OK;
    }
    if (!array_reserve((void **)&part->sizes, &part->face_capacity, part->face_count, sizeof(uint32_t)))
        return io_fail_memory(reader->error, reader->path);
    part->sizes[part->face_count++] = size;
    return OVOID_OK;
}

// ---- which reader

typedef ovoid_code (*mesh_read_function)(mesh_reader *reader);

// 1 if the text begins with the word, followed by a blank, a line end or nothing.
static int begins_with_word(bytes file, const char *word) {
    size_t length = strlen(word);
    if (file.size < length || memcmp(file.data, word, length) != 0) return 0;
    return is_blank(file.data[length]) || file.data[length] == '\n' || file.size == length;
}

// The reader for what the first bytes or else the extension say; NULL for an unknown kind.
static mesh_read_function find_reader(const char *path, bytes file) {
    static const char *const off_words[] = {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
    if (begins_with_word(file, "ply")) return mesh_read_ply;
    for (size_t i = 0; i < sizeof off_words / sizeof *off_words; i++)
        if (begins_with_word(file, off_words[i])) return mesh_read_off;
    if (mesh_is_stl(file)) return mesh_read_stl;
    if (path_has_extension(path, "stl")) return mesh_read_stl;
    if (path_has_extension(path, "obj")) return mesh_read_obj;
    if (path_has_extension(path, "off")) return mesh_read_off;
    if (path_has_extension(path, "ply")) return mesh_read_ply;
    // Assimp's other importers are not for files that nobody has checked.
    static const char *const others[] = {"dae", "gltf", "glb", "3ds", "x3d", "fbx", "3mf"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (path_has_extension(path, others[i])) return mesh_read_assimp;
    return NULL;
}

// Leaves out the parts that no point came to. 0 where nothing is left.
static int drop_empty_parts(ovoid_mesh *mesh) {
    size_t kept = 0;
    for (size_t i = 0; i < mesh->part_count; i++) {
        if (mesh->parts[i].point_count)
            mesh->parts[kept++] = mesh->parts[i];
        else
            free_part(&mesh->parts[i]);
    }
    mesh->part_count = kept;
    return kept > 0;
}

static ovoid_code read_mesh(mesh_reader *reader) {
    where at = {reader->path, 0, -1};
    mesh_read_function read = find_reader(reader->path, reader->file);
    if (!read)
        return io_fail(reader->error, OVOID_ERROR_FORMAT, at,
                       "not a mesh that can be read: stl, obj, off, ply, dae, gltf, glb, 3ds, x3d, fbx, 3mf");
    ovoid_code code = read(reader);
    if (code) return code;
    if (!drop_empty_parts(reader->mesh)) return io_fail(reader->error, OVOID_ERROR_EMPTY, at, "the mesh has no points");
    return OVOID_OK;
}

ovoid_mesh *ovoid_mesh_read(const char *path, const ovoid_read_options *options, ovoid_error *error) {
    double scale = options && options->scale != 0 ? options->scale : 1;
    if (!(scale > 0 && scale <= OVOID_LENGTH_MAX)) {
        io_report(error, OVOID_ERROR_ARGUMENT, (where){path, 0, -1}, "the scale %g is not a number above 0", scale);
        return NULL;
    }
    mesh_reader reader = {.path = path, .scale = scale, .error = error};
    if (options) reader.parts = options->parts, reader.trusted = options->trusted;
    if (bytes_read(path, &reader.file, error)) return NULL;
    reader.mesh = calloc(1, sizeof *reader.mesh);
    ovoid_code code = reader.mesh ? read_mesh(&reader) : io_fail_memory(error, path);
    free(reader.file.data);
    if (!code) return reader.mesh;
    ovoid_mesh_destroy(reader.mesh);
    return NULL;
}

double ovoid_unit_get_scale(const char *unit) {
    static const struct {
        const char *name;
        double metres;
    } units[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (strcmp(unit, units[i].name) == 0) return units[i].metres;
    return 0;
}

// ---- the cursor of the text formats

void skip_line(cursor *c) {
    const char *end = memchr(c->at, '\n', (size_t)(c->end - c->at));
    c->at = end ? end + 1 : c->end;
    c->line += end != NULL;
}

int skip_to_text(cursor *c, char mark) {
    for (;;) {
        skip_blanks(c);
        if (c->at == c->end) return 0;
        if (*c->at != '\n' && !(mark && *c->at == mark)) return 1;
        skip_line(c);
    }
}

// 1 where a word may end.
static int is_word_end(const char *at, const char *end) { return at == end || is_blank(*at) || *at == '\n'; }

int cursor_read_number(cursor *c, double *value) {
    skip_blanks(c);
    const char *after = number_read(c->at, c->end, value);
    if (!after || !is_word_end(after, c->end)) return 0;
    c->at = after;
    return 1;
}

int cursor_read_integer(cursor *c, int64_t *value) {
    skip_blanks(c);
    const char *after = integer_read(c->at, c->end, value);
    if (!after || !is_word_end(after, c->end)) return 0;
    c->at = after;
    return 1;
}

size_t cursor_read_word(cursor *c, const char **word) {
    skip_blanks(c);
    *word = c->at;
    while (!is_word_end(c->at, c->end)) c->at++;
    return (size_t)(c->at - *word);
}

ovoid_code cursor_read_xyz(cursor *c, const char *path, double xyz[3], ovoid_error *error) {
    for (int k = 0; k < 3; k++) {
        if (cursor_read_number(c, &xyz[k])) continue;
        const char *word;
        where at = {path, c->line, -1};
        int length = (int)cursor_read_word(c, &word);
        if (!length)
            return io_fail(error, OVOID_ERROR_FORMAT, at, "the coordinate %c of a vertex is missing", "xyz"[k]);
        return io_fail(error, OVOID_ERROR_FORMAT, at, "\"%.*s\" is not a coordinate", length < 40 ? length : 40, word);
    }
    return OVOID_OK;
}

int word_is(const char *word, size_t length, const char *name) {
    for (size_t i = 0; i < length; i++) {
        char c = word[i] >= 'A' && word[i] <= 'Z' ? (char)(word[i] | 0x20) : word[i];
        if (!name[i] || c != name[i]) return 0;
    }
    return !name[length];
}
