// Scenes: JSON of named bodies with poses, and pairs to ignore. Strict: what is not understood is refused with its
// line, so that no misspelt key is silently without effect. docs/scene.md describes the format. Cost: linear in the
// file, plus the shapes; n log n for the names.
#include "io/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// An object, and what its shape was made from, so that equal ones share it.
typedef struct scene_entry {
    char *name;
    ovoid_shape *shape;
    ovoid_pose pose;
    char *mesh; ///< path, NULL for primitives
    double scale, radius;
    int is_shared; ///< an earlier entry owns the shape
} scene_entry;

struct ovoid_scene {
    scene_entry *entries;
    size_t count;
    size_t *by_name;   ///< entries in the order of their names
    uint64_t *ignored; ///< pairs as (smaller << 32 | larger), ascending
    size_t ignored_count;
};

/// What is being read.
typedef struct scene_reader {
    const char *path;
    bytes file;
    ovoid_scene *scene;
    const ovoid_shape_options *options;
    ovoid_error *error;
    size_t index;     ///< the object at hand
    const char *name; ///< its name; NULL while it is not known
} scene_reader;

// ---- failing

// "path:line: object "name": sentence", with the line of the object's member `key`, or of the object itself.
static ovoid_code fail_object(scene_reader *r, ovoid_code code, const char *key, const char *sentence) {
    const json_step steps[] = {{"objects", 0}, {NULL, r->index}, {key, 0}};
    where at = {r->path, json_find_line(r->file, steps, key ? 3 : 2), -1};
    if (r->name) return io_fail(r->error, code, at, "object \"%.60s\": %s", r->name, sentence);
    return io_fail(r->error, code, at, "object %zu: %s", r->index, sentence);
}

// Likewise for a member that is not what it must be.
static ovoid_code fail_member(scene_reader *r, ovoid_code code, const char *key, const char *what) {
    char sentence[160];
    snprintf(sentence, sizeof sentence, "\"%.60s\" %s", key, what);
    return fail_object(r, code, key, sentence);
}

// ---- values

// Finite numbers only; JSON has no others.
static int read_numbers(const json_t *value, double *numbers, size_t count) {
    if (!json_is_array(value) || json_array_size(value) != count) return 0;
    for (size_t i = 0; i < count; i++) {
        const json_t *item = json_array_get(value, i);
        if (!json_is_number(item)) return 0;
        numbers[i] = json_number_value(item);
    }
    return 1;
}

// 1 if every key of the object is among the words (a list that ends with NULL); else *unknown is the first other one.
static int has_only(json_t *object, const char *const *words, const char **unknown) {
    const char *key;
    json_t *value;
    json_object_foreach(object, key, value) {
        size_t i = 0;
        while (words[i] && strcmp(words[i], key) != 0) i++;
        *unknown = key;
        if (!words[i]) return 0;
    }
    return 1;
}

// The number >= 0 under the key, or the fallback where there is none; a negative fallback: it must be there.
static ovoid_code read_size(scene_reader *r, const json_t *object, const char *kind, const char *key, double fallback,
                            double *value) {
    const json_t *item = json_object_get(object, key);
    *value = fallback;
    if (!item && fallback >= 0) return OVOID_OK;
    char what[80];
    snprintf(what, sizeof what, "needs \"%s\", a number >= 0", key);
    if (!json_is_number(item) || !(json_number_value(item) >= 0)) return fail_member(r, OVOID_ERROR_FORMAT, kind, what);
    *value = json_number_value(item);
    return OVOID_OK;
}

// ---- shapes

/// The geometry of an object: its kind, its value, the rounding radius and scale beside it.
typedef struct geometry {
    const char *kind;
    json_t *value;
    ovoid_shape_options options;
    ovoid_read_options read;
} geometry;

// What the core says of a shape that it refuses, with the place of the object. NULL is passed on.
static ovoid_shape *name_failure(scene_reader *r, const geometry *g, ovoid_shape *shape, const ovoid_error *why) {
    if (!shape) fail_member(r, why->code, g->kind, why->message);
    return shape;
}

static ovoid_shape *make_box(scene_reader *r, const geometry *g) {
    double size[3];
    if (!read_numbers(g->value, size, 3) || !(size[0] >= 0 && size[1] >= 0 && size[2] >= 0)) {
        fail_member(r, OVOID_ERROR_FORMAT, g->kind, "must be three sizes >= 0");
        return NULL;
    }
    ovoid_error why = {OVOID_OK, -1, ""};
    ovoid_vec3 half = {size[0] / 2, size[1] / 2, size[2] / 2};
    return name_failure(r, g, ovoid_shape_create_box(half, &g->options, &why), &why);
}

static ovoid_shape *make_sphere(scene_reader *r, const geometry *g) {
    double radius = json_is_number(g->value) ? json_number_value(g->value) : -1;
    if (!(radius >= 0)) {
        fail_member(r, OVOID_ERROR_FORMAT, g->kind, "must be a radius >= 0");
        return NULL;
    }
    ovoid_error why = {OVOID_OK, -1, ""};
    return name_failure(r, g, ovoid_shape_create_sphere(radius, &g->options, &why), &why);
}

// Capsule, cylinder, cone: {"radius", "length", and "sides" of the last two}.
static ovoid_shape *make_round(scene_reader *r, const geometry *g) {
    int is_capsule = strcmp(g->kind, "capsule") == 0;
    static const char *const capsule_words[] = {"radius", "length", NULL};
    static const char *const words[] = {"radius", "length", "sides", NULL};
    const char *unknown;
    double radius, length, sides;
    if (!json_is_object(g->value) || !has_only(g->value, is_capsule ? capsule_words : words, &unknown)) {
        fail_member(r, OVOID_ERROR_FORMAT, g->kind,
                    is_capsule ? "must be {\"radius\", \"length\"}" : "must be {\"radius\", \"length\", \"sides\"}");
        return NULL;
    }
    if (read_size(r, g->value, g->kind, "radius", -1, &radius) ||
        read_size(r, g->value, g->kind, "length", -1, &length) || read_size(r, g->value, g->kind, "sides", 32, &sides))
        return NULL;
    ovoid_error why = {OVOID_OK, -1, ""};
    if (is_capsule) return name_failure(r, g, ovoid_shape_create_capsule(length / 2, radius, &g->options, &why), &why);
    if (sides < 3 || sides > 4096 || sides != floor(sides)) {
        fail_member(r, OVOID_ERROR_FORMAT, g->kind, "needs a whole number of sides from 3 to 4096");
        return NULL;
    }
    uint32_t n = (uint32_t)sides;
    ovoid_shape *shape = strcmp(g->kind, "cone") == 0
                             ? ovoid_shape_create_cone(radius, length / 2, n, &g->options, &why)
                             : ovoid_shape_create_cylinder(radius, length / 2, n, &g->options, &why);
    return name_failure(r, g, shape, &why);
}

static ovoid_shape *make_points(scene_reader *r, const geometry *g) {
    size_t count = json_array_size(g->value);
    double *xyz = malloc((3 * count + 1) * sizeof *xyz);
    if (!xyz) {
        io_fail_memory(r->error, r->path);
        return NULL;
    }
    int good = json_is_array(g->value) && count > 0;
    for (size_t i = 0; i < count && good; i++) {
        good = read_numbers(json_array_get(g->value, i), xyz + 3 * i, 3);
        for (int k = 0; k < 3; k++) xyz[3 * i + (size_t)k] *= g->read.scale;
    }
    ovoid_error why = {OVOID_OK, -1, ""};
    ovoid_shape *shape = NULL;
    if (good)
        shape = name_failure(r, g, ovoid_shape_create_from_points(xyz, count, &g->options, &why), &why);
    else
        fail_member(r, OVOID_ERROR_FORMAT, g->kind, "must be a list of points [x, y, z], at least one");
    free(xyz);
    return shape;
}

// The entry before the one at hand that has the same file, scale and radius, or NULL.
static const scene_entry *find_same(const scene_reader *r, const scene_entry *entry) {
    for (size_t i = 0; i < r->index; i++) {
        const scene_entry *e = &r->scene->entries[i];
        if (e->mesh && strcmp(e->mesh, entry->mesh) == 0 && e->scale == entry->scale && e->radius == entry->radius)
            return e;
    }
    return NULL;
}

static ovoid_code read_mesh_shape(scene_reader *r, const geometry *g, scene_entry *entry) {
    const char *name = json_string_value(g->value);
    if (!name || !name[0]) return fail_member(r, OVOID_ERROR_FORMAT, g->kind, "must be the path of a file");
    entry->mesh = path_join(r->path, name);
    if (!entry->mesh) return io_fail_memory(r->error, r->path);
    entry->scale = g->read.scale;
    entry->radius = g->options.radius;
    const scene_entry *same = find_same(r, entry);
    entry->is_shared = same != NULL;
    ovoid_error why = {OVOID_OK, -1, ""};
    entry->shape = same ? same->shape : ovoid_shape_read_file(entry->mesh, &g->read, &g->options, &why);
    if (entry->shape) return OVOID_OK;
    // A file that cannot be opened is the scene's fault; what is wrong inside it has its own path and line.
    if (why.code == OVOID_ERROR_FILE || why.code == OVOID_ERROR_ARGUMENT)
        return fail_object(r, why.code, g->kind, why.message);
    if (r->error) *r->error = why;
    return why.code;
}

// The one member that names the geometry.
static ovoid_code find_geometry(scene_reader *r, json_t *object, geometry *g) {
    static const char *const kinds[] = {"mesh", "box", "sphere", "capsule", "cylinder", "cone", "points"};
    *g = (geometry){.kind = NULL};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        json_t *value = json_object_get(object, kinds[i]);
        if (value && g->kind) return fail_member(r, OVOID_ERROR_FORMAT, kinds[i], "is a second geometry");
        if (value) *g = (geometry){.kind = kinds[i], .value = value};
    }
    if (g->kind) return OVOID_OK;
    return fail_object(r, OVOID_ERROR_FORMAT, NULL,
                       "no geometry: one of mesh, box, sphere, capsule, cylinder, cone, points");
}

// "scale" times "unit", of meshes and points.
static ovoid_code read_scale(scene_reader *r, const json_t *object, geometry *g) {
    const json_t *scale = json_object_get(object, "scale"), *unit = json_object_get(object, "unit");
    g->read.scale = 1;
    int is_scaled = strcmp(g->kind, "mesh") == 0 || strcmp(g->kind, "points") == 0;
    if ((scale || unit) && !is_scaled)
        return fail_member(r, OVOID_ERROR_FORMAT, scale ? "scale" : "unit", "is for meshes and points only");
    if (scale) {
        if (!json_is_number(scale) || !(json_number_value(scale) > 0))
            return fail_member(r, OVOID_ERROR_FORMAT, "scale", "must be a number > 0");
        g->read.scale = json_number_value(scale);
    }
    if (unit) {
        double metres = json_is_string(unit) ? ovoid_unit_get_scale(json_string_value(unit)) : 0;
        if (metres == 0) return fail_member(r, OVOID_ERROR_FORMAT, "unit", "must be m, cm, mm, in or ft");
        g->read.scale *= metres;
    }
    return OVOID_OK;
}

static ovoid_code read_shape(scene_reader *r, json_t *object, scene_entry *entry) {
    geometry g;
    ovoid_code code = find_geometry(r, object, &g);
    if (!code) code = read_scale(r, object, &g);
    if (code) return code;
    if (r->options) g.options = *r->options;
    const json_t *radius = json_object_get(object, "radius");
    if (radius && (!json_is_number(radius) || !(json_number_value(radius) >= 0)))
        return fail_member(r, OVOID_ERROR_RADIUS, "radius", "must be a number >= 0");
    g.options.radius = radius ? json_number_value(radius) : 0;
    if (strcmp(g.kind, "mesh") == 0) return read_mesh_shape(r, &g, entry);
    if (strcmp(g.kind, "box") == 0)
        entry->shape = make_box(r, &g);
    else if (strcmp(g.kind, "sphere") == 0)
        entry->shape = make_sphere(r, &g);
    else if (strcmp(g.kind, "points") == 0)
        entry->shape = make_points(r, &g);
    else
        entry->shape = make_round(r, &g);
    return entry->shape ? OVOID_OK : OVOID_ERROR_FORMAT;
}

// ---- objects

static ovoid_code read_pose(scene_reader *r, json_t *value, ovoid_pose *pose) {
    *pose = ovoid_pose_make_identity();
    if (!value) return OVOID_OK;
    static const char *const words[] = {"xyz", "quat_wxyz", "rpy", NULL};
    const char *unknown;
    if (!json_is_object(value) || !has_only(value, words, &unknown))
        return fail_member(r, OVOID_ERROR_FORMAT, "pose", "must be {\"xyz\", and \"quat_wxyz\" or \"rpy\"}");
    json_t *xyz = json_object_get(value, "xyz"), *quat = json_object_get(value, "quat_wxyz");
    json_t *rpy = json_object_get(value, "rpy");
    double p[3] = {0, 0, 0}, q[4] = {1, 0, 0, 0}, angles[3];
    if (quat && rpy) return fail_member(r, OVOID_ERROR_FORMAT, "pose", "has both quat_wxyz and rpy");
    if (xyz && !read_numbers(xyz, p, 3))
        return fail_member(r, OVOID_ERROR_FORMAT, "pose", "needs three numbers in xyz");
    if (quat && !read_numbers(quat, q, 4))
        return fail_member(r, OVOID_ERROR_FORMAT, "pose", "needs four numbers in quat_wxyz");
    if (rpy && !read_numbers(rpy, angles, 3))
        return fail_member(r, OVOID_ERROR_FORMAT, "pose", "needs three numbers in rpy");
    *pose = (ovoid_pose){{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
    if (rpy) *pose = ovoid_pose_make_rpy(pose->position, (ovoid_vec3){angles[0], angles[1], angles[2]});
    ovoid_code code = ovoid_pose_compute_check(pose);
    if (code == OVOID_ERROR_ROTATION) return fail_member(r, code, "pose", "has a quaternion of four zeros");
    return code ? fail_member(r, code, "pose", "has a number out of range") : OVOID_OK;
}

static ovoid_code read_object(scene_reader *r, json_t *object) {
    static const char *const words[] = {"name",   "pose",    "radius",   "scale", "unit",   "mesh", "box",
                                        "sphere", "capsule", "cylinder", "cone",  "points", NULL};
    scene_entry *entry = &r->scene->entries[r->index];
    r->name = NULL;
    if (!json_is_object(object)) return fail_object(r, OVOID_ERROR_FORMAT, NULL, "must be a JSON object");
    const char *name = json_string_value(json_object_get(object, "name")), *unknown;
    if (!name || !name[0]) return fail_member(r, OVOID_ERROR_FORMAT, "name", "must be a text that is not empty");
    r->name = entry->name = text_copy(name, strlen(name));
    if (!entry->name) return io_fail_memory(r->error, r->path);
    if (!has_only(object, words, &unknown))
        return fail_member(r, OVOID_ERROR_FORMAT, unknown, "is not a key of objects");
    ovoid_code code = read_pose(r, json_object_get(object, "pose"), &entry->pose);
    return code ? code : read_shape(r, object, entry);
}

/// A name and whose it is, for sorting.
typedef struct name_index {
    const char *name;
    size_t index;
} name_index;

static int compare_names(const void *a, const void *b) {
    const name_index *m = a, *n = b;
    int order = strcmp(m->name, n->name);
    return order ? order : (m->index > n->index) - (m->index < n->index);
}

// The order of the names; no two may be equal.
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
        code = fail_member(r, OVOID_ERROR_FORMAT, "name", "is that of an earlier object too");
    }
    free(names);
    return code;
}

static ovoid_code read_objects(scene_reader *r, const json_t *objects) {
    where at = {r->path, 0, -1};
    if (!json_is_array(objects))
        return io_fail(r->error, OVOID_ERROR_FORMAT, at, "the scene needs \"objects\", a list");
    size_t count = json_array_size(objects);
    if (!count) return io_fail(r->error, OVOID_ERROR_EMPTY, at, "the scene has no objects");
    if (count > UINT32_MAX) return io_fail(r->error, OVOID_ERROR_LIMIT, at, "too many objects");
    r->scene->entries = calloc(count, sizeof *r->scene->entries);
    if (!r->scene->entries) return io_fail_memory(r->error, r->path);
    for (r->index = 0; r->index < count; r->index++) {
        r->scene->count = r->index + 1;
        ovoid_code code = read_object(r, json_array_get(objects, r->index));
        if (code) return code;
    }
    return sort_names(r);
}

// ---- pairs to ignore

static uint64_t pair_key(size_t a, size_t b) { return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a; }

static int compare_keys(const void *a, const void *b) {
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

// "path:line: ignore: sentence", with the line of the pair.
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
    return OVOID_OK;
}

// ---- the scene

static ovoid_code read_root(scene_reader *r, json_t *root) {
    static const char *const words[] = {"objects", "ignore", NULL};
    const char *unknown = "";
    if (!json_is_object(root))
        return io_fail(r->error, OVOID_ERROR_FORMAT, (where){r->path, 1, -1}, "a scene must be a JSON object");
    if (!has_only(root, words, &unknown)) {
        const json_step step = {unknown, 0};
        where at = {r->path, json_find_line(r->file, &step, 1), -1};
        return io_fail(r->error, OVOID_ERROR_FORMAT, at, "\"%.60s\" is not a key of scenes", unknown);
    }
    ovoid_code code = read_objects(r, json_object_get(root, "objects"));
    return code ? code : read_ignored(r, json_object_get(root, "ignore"));
}

static ovoid_code read_scene(scene_reader *r) {
    if (r->options && r->options->radius != 0)
        return io_fail(r->error, OVOID_ERROR_ARGUMENT, (where){r->path, 0, -1},
                       "a scene gives the radius of each object itself");
    json_error_t why;
    json_t *root = json_loadb(r->file.data, r->file.size, JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL, &why);
    if (!root && json_is_memory_error(&why)) return io_fail_memory(r->error, r->path);
    if (!root) return io_fail(r->error, OVOID_ERROR_FORMAT, (where){r->path, why.line, -1}, "JSON: %s", why.text);
    ovoid_code code = read_root(r, root);
    json_decref(root);
    return code;
}

ovoid_scene *ovoid_scene_read(const char *path, const ovoid_shape_options *options, ovoid_error *error) {
    scene_reader r = {.path = path, .options = options, .error = error};
    if (bytes_read_at_most(path, OVOID_SCENE_SIZE_MAX, &r.file, error)) return NULL;
    r.scene = calloc(1, sizeof *r.scene);
    ovoid_code code = r.scene ? read_scene(&r) : io_fail_memory(error, path);
    free(r.file.data);
    if (!code) return r.scene;
    ovoid_scene_destroy(r.scene);
    return NULL;
}

void ovoid_scene_destroy(ovoid_scene *scene) {
    if (!scene) return;
    for (size_t i = 0; i < scene->count; i++) {
        scene_entry *entry = &scene->entries[i];
        if (!entry->is_shared) ovoid_shape_destroy(entry->shape);
        free(entry->name);
        free(entry->mesh);
    }
    free(scene->entries);
    free(scene->by_name);
    free(scene->ignored);
    free(scene);
}

size_t ovoid_scene_get_count(const ovoid_scene *scene) { return scene->count; }

ovoid_scene_object ovoid_scene_get(const ovoid_scene *scene, size_t i) {
    const scene_entry *entry = &scene->entries[i];
    return (ovoid_scene_object){entry->name, entry->shape, entry->pose};
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
