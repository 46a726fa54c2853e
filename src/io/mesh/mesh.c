// Meshes as their users see them, and which reader a file gets.
#include "io/mesh/cursor.h"
#include "io/mesh/readers.h"
#include "io/mesh_file.h"
#include "tools/checksum.h"

#include <stdlib.h>
#include <string.h>

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

uint64_t mesh_get_checksum(const ovoid_mesh *mesh) { return mesh->checksum; }

size_t ovoid_mesh_get_part_count(const ovoid_mesh *mesh) { return mesh->part_count; }

ovoid_mesh_part ovoid_mesh_get_part(const ovoid_mesh *mesh, size_t i) {
    const mesh_part *p = &mesh->parts[i];
    return (ovoid_mesh_part){p->name, {p->points, p->point_count, p->indices, p->sizes, p->face_count}};
}

typedef ovoid_code (*mesh_read_function)(mesh_reader *reader);

// 1 if the text begins with the word, followed by a blank, a line end or nothing.
static int begins_with_word(bytes file, const char *word) {
    size_t length = strlen(word);
    if (file.size < length || memcmp(file.data, word, length) != 0) return 0;
    return is_blank(file.data[length]) || file.data[length] == '\n' || file.size == length;
}

// The reader for what the first bytes or else the extension say; of standard input OBJ, the only text without a first
// word. NULL for an unknown kind.
static mesh_read_function find_reader(const char *path, bytes file) {
    static const char *const off_words[] = {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
    if (begins_with_word(file, "ply")) return mesh_read_ply;
    for (size_t i = 0; i < sizeof off_words / sizeof *off_words; i++)
        if (begins_with_word(file, off_words[i])) return mesh_read_off;
    if (mesh_is_stl(file)) return mesh_read_stl;
    if (path_has_extension(path, "stl")) return mesh_read_stl;
    if (path_has_extension(path, "obj") || strcmp(path, "-") == 0) return mesh_read_obj;
    if (path_has_extension(path, "off")) return mesh_read_off;
    if (path_has_extension(path, "ply")) return mesh_read_ply;
    // Assimp's other importers are not enabled: they have not been tested.
    static const char *const others[] = {"dae", "gltf", "glb", "3ds", "x3d", "fbx", "3mf"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (path_has_extension(path, others[i])) return mesh_read_assimp;
    return NULL;
}

// Drops the parts without points. 0 where none is left.
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
    double metre = options && options->unit ? ovoid_unit_get_scale("m", options->unit) : 1;
    if (!(scale > 0 && scale <= OVOID_LENGTH_MAX)) {
        io_report(error, OVOID_ERROR_ARGUMENT, (where){path, 0, -1}, "the scale %g must be above 0 and at most %g",
                  scale, OVOID_LENGTH_MAX);
        return NULL;
    }
    if (metre == 0) {
        io_report(error, OVOID_ERROR_ARGUMENT, (where){path, 0, -1},
                  "the unit \"%.20s\" is none of m, cm, mm, um, in, ft", options->unit);
        return NULL;
    }
    if (path_has_extension(path, "dae")) scale *= metre;
    mesh_reader reader = {.path = path, .scale = scale, .error = error};
    if (options) reader.parts = options->parts, reader.trusted = options->trusted;
    bytes file;
    if (bytes_read_input(path, OVOID_FILE_SIZE_MAX, &file, error)) return NULL;
    reader.file = mesh_is_stl(file) ? file : bytes_skip_mark(file);
    reader.mesh = calloc(1, sizeof *reader.mesh);
    ovoid_code code = reader.mesh ? read_mesh(&reader) : io_fail_memory(error, path);
    if (!code) reader.mesh->checksum = checksum_bytes(file.data, file.size);
    free(file.data);
    if (!code) return reader.mesh;
    ovoid_mesh_destroy(reader.mesh);
    return NULL;
}

// The micrometres of a unit, which are whole numbers; 0 for an unknown one.
static double get_micrometres(const char *unit) {
    static const struct {
        const char *name;
        double micrometres;
    } units[] = {{"m", 1e6}, {"cm", 1e4}, {"mm", 1e3}, {"um", 1}, {"in", 25400}, {"ft", 304800}};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (strcmp(unit, units[i].name) == 0) return units[i].micrometres;
    return 0;
}

double ovoid_unit_get_scale(const char *from, const char *to) {
    double one = get_micrometres(from), other = get_micrometres(to);
    return one > 0 && other > 0 ? one / other : 0;
}
