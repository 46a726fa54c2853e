// Scenes: JSON of named bodies with poses, and pairs to ignore. Strict: anything unknown is refused with its line, so
// that no misspelt key is silently without effect. docs/scene.md describes the format. Cost: linear in the file, plus
// the shapes; n log n for the names.
#include "io/mesh_file.h"
#include "io/scene/scene_packed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- failing

static ovoid_code fail_syntax(const scene_reader *r, const json_error_t *why) {
    ovoid_code code = json_get_failure(why);
    if (code == OVOID_ERROR_MEMORY) return io_fail_memory(r->error, r->path);
    return io_fail(r->error, code, (where){r->path, why->line, -1}, "JSON: %s", why->text);
}

// ---- objects

static ovoid_code read_object(scene_reader *r, json_t *object) {
    static const char *const words[] = {"name",  "pose",      "mesh",   "box",      "sphere", "capsule",   "cylinder",
                                        "cone",  "ellipsoid", "points", "compound", "radius", "allowance", "hull",
                                        "solid", "parts",     "scale",  "unit",     NULL};
    scene_entry *entry = &r->scene->entries[r->index];
    r->name = NULL;
    if (!json_is_object(object)) return scene_fail(r, OVOID_ERROR_FORMAT, NULL, "must be a JSON object");
    const char *name = json_string_value(json_object_get(object, "name")), *unknown;
    if (!name || !name[0]) return scene_fail_member(r, OVOID_ERROR_FORMAT, "name", "must be a text that is not empty");
    r->name = entry->name = text_copy(name, strlen(name));
    if (!entry->name) return io_fail_memory(r->error, r->path);
    if (!scene_has_only(object, words, &unknown)) return scene_fail_key(r, unknown, "objects", words);
    ovoid_code code = scene_read_pose(r, json_object_get(object, "pose"), &entry->pose);
    return code ? code : scene_read_body(r, object, &entry->body);
}

/// A name and its object, for sorting.
typedef struct name_index {
    const char *name;
    size_t index;
} name_index;

static int compare_names(const void *a, const void *b) {
    const name_index *m = a, *n = b;
    int order = strcmp(m->name, n->name);
    return order ? order : (m->index > n->index) - (m->index < n->index);
}

// Sorts the names; no two may be equal.
static ovoid_code sort_names(scene_reader *r) {
    ovoid_scene *scene = r->scene;
    name_index *names = malloc((scene->count + 1) * sizeof *names);
    scene->by_name = malloc((scene->count + 1) * sizeof *scene->by_name);
    ovoid_code code = names && scene->by_name ? OVOID_OK : io_fail_memory(r->error, r->path);
    if (!code) {
        for (size_t i = 0; i < scene->count; i++) names[i] = (name_index){scene->entries[i].name, i};
        qsort(names, scene->count, sizeof *names, compare_names);
        for (size_t i = 0; i < scene->count; i++) scene->by_name[i] = names[i].index;
    }
    for (size_t i = 1; i < scene->count && !code; i++) {
        if (strcmp(names[i - 1].name, names[i].name) != 0) continue;
        r->index = names[i].index;
        r->name = names[i].name;
        code = scene_fail_member(r, OVOID_ERROR_FORMAT, "name", "is that of an earlier object too");
    }
    free(names);
    return code;
}

static ovoid_code read_objects(scene_reader *r, const json_t *objects) {
    where at = {r->path, 0, -1};
    if (!json_is_array(objects))
        return io_fail(r->error, OVOID_ERROR_FORMAT, at, "the scene needs \"objects\", a list");
    ovoid_scene *scene = r->scene;
    json_t *object;
    json_error_t why;
    size_t capacity = 0;
    int found;
    ovoid_code code = OVOID_OK;
    while (!code && (found = json_next(&r->objects, &object, &why)) > 0) {
        r->index = scene->count;
        if (array_reserve((void **)&scene->entries, &capacity, scene->count, sizeof *scene->entries)) {
            scene->entries[scene->count++] = (scene_entry){.name = NULL};
            code = read_object(r, object);
        } else
            code = io_fail_memory(r->error, r->path);
        json_decref(object);
    }
    if (!code && found < 0) return fail_syntax(r, &why);
    if (!code && !scene->count) return io_fail(r->error, OVOID_ERROR_EMPTY, at, "the scene has no objects");
    return code ? code : sort_names(r);
}

// ---- pairs to ignore

static uint64_t pair_key(size_t a, size_t b) { return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a; }

static int compare_keys(const void *a, const void *b) {
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

// Fails with "path:line: ignore: sentence", and the line of the pair.
static ovoid_code fail_ignored(scene_reader *r, size_t i, const char *sentence) {
    const json_step steps[] = {{"ignore", 0}, {NULL, i}};
    where at = {r->path, json_find_line(r->file, steps, 2), -1};
    return io_fail(r->error, OVOID_ERROR_FORMAT, at, "ignore: %s", sentence);
}

static ovoid_code read_ignored_pair(scene_reader *r, const json_t *pair, size_t i) {
    size_t found[2];
    const char *name[2] = {json_string_value(json_array_get(pair, 0)), json_string_value(json_array_get(pair, 1))};
    if (json_array_size(pair) != 2 || !name[0] || !name[1]) return fail_ignored(r, i, "a pair must be two names");
    for (size_t k = 0; k < 2; k++) {
        found[k] = ovoid_scene_find(r->scene, name[k]);
        char sentence[120];
        snprintf(sentence, sizeof sentence, "there is no object \"%.60s\"", name[k]);
        if (found[k] == (size_t)-1) return fail_ignored(r, i, sentence);
    }
    if (found[0] == found[1]) return fail_ignored(r, i, "the pair names one object twice");
    r->scene->ignored[r->scene->ignored_count++] = pair_key(found[0], found[1]);
    return OVOID_OK;
}

static ovoid_code read_ignored(scene_reader *r, const json_t *ignore) {
    if (!ignore) return OVOID_OK;
    const json_step steps[] = {{"ignore", 0}};
    where at = {r->path, json_find_line(r->file, steps, 1), -1};
    if (!json_is_array(ignore)) return io_fail(r->error, OVOID_ERROR_FORMAT, at, "\"ignore\" must be a list of pairs");
    size_t count = json_array_size(ignore);
    r->scene->ignored = malloc((count + 1) * sizeof *r->scene->ignored);
    if (!r->scene->ignored) return io_fail_memory(r->error, r->path);
    for (size_t i = 0; i < count; i++) {
        ovoid_code code = read_ignored_pair(r, json_array_get(ignore, i), i);
        if (code) return code;
    }
    qsort(r->scene->ignored, count, sizeof *r->scene->ignored, compare_keys);
    // Each pair once.
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (!i || r->scene->ignored[i] != r->scene->ignored[i - 1]) r->scene->ignored[kept++] = r->scene->ignored[i];
    r->scene->ignored_count = kept;
    return OVOID_OK;
}

// ---- the scene

// The unit of all lengths, which is a word of at most two letters.
static ovoid_code read_unit(scene_reader *r, const json_t *unit) {
    const char *word = json_string_value(unit);
    if (!unit) return OVOID_OK;
    if (word && ovoid_unit_get_scale(word, "m") > 0) {
        memcpy(r->scene->unit, word, strlen(word) + 1);
        return OVOID_OK;
    }
    const json_step step = {"unit", 0};
    where at = {r->path, json_find_line(r->file, &step, 1), -1};
    return io_fail(r->error, OVOID_ERROR_FORMAT, at, "\"unit\" must be m, cm, mm, um, in or ft");
}

static ovoid_code read_root(scene_reader *r, json_t *root) {
    static const char *const words[] = {"unit", "objects", "ignore", NULL};
    const char *unknown = "";
    if (!json_is_object(root))
        return io_fail(r->error, OVOID_ERROR_FORMAT, (where){r->path, 1, -1}, "a scene must be a JSON object");
    if (!scene_has_only(root, words, &unknown)) {
        const json_step step = {unknown, 0};
        where at = {r->path, json_find_line(r->file, &step, 1), -1};
        return io_fail(r->error, OVOID_ERROR_FORMAT, at,
                       "\"%.60s\" is not a key of scenes, which have \"objects\", \"unit\" and \"ignore\"", unknown);
    }
    ovoid_code code = read_unit(r, json_object_get(root, "unit"));
    if (!code) code = read_objects(r, json_object_get(root, "objects"));
    return code ? code : read_ignored(r, json_object_get(root, "ignore"));
}

static ovoid_code read_scene(scene_reader *r) {
    if (r->options && r->options->radius != 0)
        return io_fail(r->error, OVOID_ERROR_ARGUMENT, (where){r->path, 0, -1},
                       "a scene gives the radius of each object itself");
    if (r->file.size >= 6 && memcmp(r->file.data, "\x89OVOID", 6) == 0)
        return io_fail(r->error, OVOID_ERROR_FORMAT, (where){r->path, 0, -1},
                       "a file of a shape (.ovoid), not a scene, which is JSON and may name it as a \"mesh\"");
    const int flags = JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL;
    json_error_t why;
    json_t *root = json_load_around(r->file, "objects", flags, &r->objects, &why);
    ovoid_code code = root ? read_root(r, root) : fail_syntax(r, &why);
    json_decref(root);
    if (!code || code == OVOID_ERROR_MEMORY || !r->objects.at) return code;
    // What is no JSON comes before all else, with its line in the whole text.
    json_t *whole = json_load(r->file, flags, &why);
    if (!whole) return fail_syntax(r, &why);
    json_decref(whole);
    return code;
}

static ovoid_scene *read_file(const char *path, const ovoid_shape_options *options, int hulls, ovoid_error *error) {
    scene_reader r = {.path = path, .options = options, .error = error, .part = NO_PART, .hulls = hulls};
    bytes file;
    // A packed scene may be larger than one of JSON.
    size_t most = bytes_begin_file(path, PACKED_MAGIC, 8) ? OVOID_FILE_SIZE_MAX : OVOID_SCENE_SIZE_MAX;
    if (bytes_read_input(path, most, &file, error)) return NULL;
    r.file = bytes_skip_mark(file);
    r.scene = calloc(1, sizeof *r.scene);
    if (r.scene) r.scene->hulls = hulls;
    int is_packed = r.scene && packed_is(file);
    ovoid_code code = is_packed ? scene_unpack(&r, file) : r.scene ? read_scene(&r) : io_fail_memory(error, path);
    if (!is_packed) free(file.data);
    free(r.slots);
    if (!code) return r.scene;
    ovoid_scene_destroy(r.scene);
    return NULL;
}

ovoid_scene *ovoid_scene_read(const char *path, const ovoid_shape_options *options, ovoid_error *error) {
    return read_file(path, options, 0, error);
}

ovoid_scene *ovoid_scene_read_hulls(const char *path, const ovoid_shape_options *options, ovoid_error *error) {
    return read_file(path, options, 1, error);
}

void ovoid_scene_destroy(ovoid_scene *scene) {
    if (!scene) return;
    for (size_t i = 0; i < scene->count && !scene->packed; i++) free(scene->entries[i].name);
    // A compound may have parts of earlier bodies, so bodies are destroyed from the last to the first.
    for (size_t i = scene->body_count; i-- > 0;) scene_body_clear(&scene->bodies[i]);
    free(scene->bodies);
    free(scene->entries);
    free(scene->by_name);
    free(scene->ignored);
    for (size_t i = 0; i < scene->shape_count; i++) ovoid_shape_destroy(scene->shapes[i]);
    for (size_t i = 0; i < scene->solid_count; i++) ovoid_solid_destroy(scene->solids[i]);
    free(scene->shapes);
    free(scene->solids);
    free(scene->packed);
    free(scene);
}

size_t ovoid_scene_get_mesh_count(const ovoid_scene *scene) {
    size_t count = 0;
    for (size_t i = 0; i < scene->body_count; i++) count += scene_body_count_hulls(&scene->bodies[i]);
    return count;
}

// The body of mesh *i, and which of its hulls it is.
static const scene_body *find_mesh(const ovoid_scene *scene, size_t *i) {
    const scene_body *body = scene->bodies;
    for (; *i >= scene_body_count_hulls(body); body++) *i -= scene_body_count_hulls(body);
    return body;
}

ovoid_named_shape ovoid_scene_get_mesh(const ovoid_scene *scene, size_t i) {
    const scene_body *body = find_mesh(scene, &i);
    return scene_body_get_hull(body, i);
}

const ovoid_solid *ovoid_scene_get_mesh_solid(const ovoid_scene *scene, size_t i) {
    return find_mesh(scene, &i)->solid;
}

const char *ovoid_scene_get_unit(const ovoid_scene *scene) { return scene->unit; }

size_t ovoid_scene_get_count(const ovoid_scene *scene) { return scene->count; }

ovoid_scene_object ovoid_scene_get(const ovoid_scene *scene, size_t i) {
    const scene_entry *entry = &scene->entries[i];
    const scene_body *body = &scene->bodies[entry->body];
    ovoid_scene_object o = {.name = entry->name,
                            .shape = body->shape,
                            .compound = body->compound,
                            .pose = entry->pose,
                            .mesh = body->mesh,
                            .read = body->read,
                            .solid = body->solid,
                            .convexity = {.mesh_volume = NAN, .hull_volume = NAN},
                            .is_asked = body->is_asked};
    if (body->solid)
        o.kind = ovoid_solid_get_report(body->solid).is_closed ? OVOID_MESH_SOLID : OVOID_MESH_SURFACE;
    else
        o.kind = body->compound ? OVOID_MESH_PARTS : OVOID_MESH_HULL;
    if (body->mesh && body->shape) o.convexity = scene_body_get_hull(body, 0).convexity;
    return o;
}

ovoid_mesh *ovoid_scene_read_mesh(const ovoid_scene *scene, size_t i, ovoid_error *error) {
    const scene_body *body = &scene->bodies[scene->entries[i].body];
    if (!body->mesh || ovoid_path_is_shape(body->mesh)) {
        io_report(error, OVOID_ERROR_ARGUMENT, (where){scene->entries[i].name, 0, -1}, "the object has no mesh");
        return NULL;
    }
    ovoid_mesh *mesh = ovoid_mesh_read(body->mesh, &body->read, error);
    if (!mesh || mesh_get_checksum(mesh) == body->mesh_checksum) return mesh;
    ovoid_mesh_destroy(mesh);
    io_report(error, OVOID_ERROR_FORMAT, (where){body->mesh, 0, -1}, "the file was changed since the scene was %s",
              scene->packed ? "packed; pack the scene again" : "read");
    return NULL;
}

ovoid_body ovoid_scene_get_body(const ovoid_scene *scene, size_t i, const ovoid_pose *pose) {
    const scene_body *body = &scene->bodies[scene->entries[i].body];
    return (ovoid_body){
        .shape = body->solid ? NULL : body->shape, .compound = body->compound, .pose = *pose, .solid = body->solid};
}

size_t ovoid_scene_find(const ovoid_scene *scene, const char *name) {
    size_t low = 0, high = scene->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        int order = strcmp(scene->entries[scene->by_name[middle]].name, name);
        if (order == 0) return scene->by_name[middle];
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return (size_t)-1;
}

int ovoid_scene_is_ignored(const ovoid_scene *scene, size_t a, size_t b) {
    uint64_t key = pair_key(a, b);
    return scene->ignored_count && bsearch(&key, scene->ignored, scene->ignored_count, sizeof key, compare_keys);
}

size_t ovoid_scene_get_pair_count(const ovoid_scene *scene) {
    size_t count = scene->count;
    return count ? count * (count - 1) / 2 - scene->ignored_count : 0;
}
