// The geometry of a scene's objects: shapes and compounds. Equal geometries are made once and shared: they are found by
// a text of all that they are made from, through a hash table. Cost: linear in the file, plus the shapes.
#include "io/mesh_file.h"
#include "io/scene/scene.h"
#include "io/scene/scene_bytes.h"
#include "tools/hash.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Reads the number >= 0 of a key, or the fallback where the key is absent; with a negative fallback the key is
// required.
static ovoid_code read_size(scene_reader *r, const json_t *object, const char *kind, const char *key, double fallback,
                            double *value) {
    const json_t *item = json_object_get(object, key);
    *value = fallback;
    if (!item && fallback >= 0) return OVOID_OK;
    char what[80];
    snprintf(what, sizeof what, "needs \"%s\", a number >= 0", key);
    if (!json_is_number(item) || !(json_number_value(item) >= 0))
        return scene_fail_member(r, OVOID_ERROR_FORMAT, kind, what);
    *value = json_number_value(item);
    return OVOID_OK;
}

// ---- shapes

/// The geometry of an object: its kind, its value, the rounding radius and scale beside it.
typedef struct geometry {
    const char *kind;
    json_t *value;
    char *mesh; ///< path; NULL for all but meshes
    ovoid_shape_options options;
    ovoid_read_options read;
    int solid;    ///< of a mesh: 1 its triangles, 0 a hull, -1 what it is
    int is_plain; ///< without a rounding radius and an allowance, and no part of a compound: it may be a solid
} geometry;

// Puts the place of the object before the core's error for its shape. A shape that is not NULL is passed on.
static ovoid_shape *name_failure(scene_reader *r, const geometry *g, ovoid_shape *shape, const ovoid_error *why) {
    if (!shape) scene_fail_member(r, why->code, g->kind, why->message);
    return shape;
}

// Reads the half sizes of a box: [x, y, z] or {"size"} are the full ones, {"half"} the half ones, as in C.
static int read_half_sizes(const json_t *value, ovoid_vec3 *half) {
    double n[3];
    json_t *halves = json_object_get(value, "half"), *sizes = json_object_get(value, "size");
    if (json_is_object(value) && (json_object_size(value) != 1 || (!halves && !sizes))) return 0;
    if (!scene_read_numbers(halves ? halves : sizes ? sizes : value, n, 3)) return 0;
    double part = halves ? 1 : 0.5;
    *half = (ovoid_vec3){part * n[0], part * n[1], part * n[2]};
    return n[0] >= 0 && n[1] >= 0 && n[2] >= 0;
}

static ovoid_shape *make_box(scene_reader *r, const geometry *g) {
    ovoid_vec3 half;
    if (!read_half_sizes(g->value, &half)) {
        scene_fail_member(r, OVOID_ERROR_FORMAT, g->kind,
                          "must be three sizes >= 0, or {\"size\"} or {\"half\"} with three");
        return NULL;
    }
    ovoid_error why = {OVOID_OK, -1, ""};
    return name_failure(r, g, ovoid_shape_create_box(half, &g->options, &why), &why);
}

static ovoid_shape *make_sphere(scene_reader *r, const geometry *g) {
    double radius = json_is_number(g->value) ? json_number_value(g->value) : -1;
    if (!(radius >= 0)) {
        scene_fail_member(r, OVOID_ERROR_FORMAT, g->kind, "must be a radius >= 0");
        return NULL;
    }
    ovoid_error why = {OVOID_OK, -1, ""};
    return name_failure(r, g, ovoid_shape_create_sphere(radius, &g->options, &why), &why);
}

// The tolerance at which a circle is held by so many sides.
static double compute_tolerance(double radius, double sides) {
    double s = sin(1.5707963267948966 / sides);
    return radius * (2 * (s * s) + 65 * 0x1p-53) * (1 + 0x1p-40);
}

// Makes a capsule, cylinder or cone: {"radius", "length", and "sides" or "tolerance" of the last two}.
static ovoid_shape *make_round(scene_reader *r, const geometry *g) {
    int is_capsule = strcmp(g->kind, "capsule") == 0;
    static const char *const capsule_words[] = {"radius", "length", NULL};
    static const char *const words[] = {"radius", "length", "sides", "tolerance", NULL};
    const char *unknown;
    double radius, length, sides, tolerance;
    if (!json_is_object(g->value) || !scene_has_only(g->value, is_capsule ? capsule_words : words, &unknown)) {
        scene_fail_member(r, OVOID_ERROR_FORMAT, g->kind,
                          is_capsule ? "must be {\"radius\", \"length\"}"
                                     : "must be {\"radius\", \"length\", and \"sides\" or \"tolerance\"}");
        return NULL;
    }
    if (read_size(r, g->value, g->kind, "radius", -1, &radius) ||
        read_size(r, g->value, g->kind, "length", -1, &length) ||
        read_size(r, g->value, g->kind, "sides", 32, &sides) ||
        read_size(r, g->value, g->kind, "tolerance", 0, &tolerance))
        return NULL;
    ovoid_error why = {OVOID_OK, -1, ""};
    if (is_capsule) return name_failure(r, g, ovoid_shape_create_capsule(radius, length / 2, &g->options, &why), &why);
    if (sides < 3 || sides > 4096 || sides != floor(sides)) {
        scene_fail_member(r, OVOID_ERROR_FORMAT, g->kind, "needs a whole number of sides from 3 to 4096");
        return NULL;
    }
    if (json_object_get(g->value, "sides") && json_object_get(g->value, "tolerance")) {
        scene_fail_member(r, OVOID_ERROR_FORMAT, g->kind, "has both \"sides\" and \"tolerance\"; one says the other");
        return NULL;
    }
    if (tolerance == 0) tolerance = compute_tolerance(radius, sides);
    ovoid_shape_options options = g->options;
    options.tolerance = tolerance;
    ovoid_shape *shape = strcmp(g->kind, "cone") == 0 ? ovoid_shape_create_cone(radius, length / 2, &options, &why)
                                                      : ovoid_shape_create_cylinder(radius, length / 2, &options, &why);
    return name_failure(r, g, shape, &why);
}

// Makes an ellipsoid: {"half_axes", "tolerance"}.
static ovoid_shape *make_ellipsoid(scene_reader *r, const geometry *g) {
    static const char *const words[] = {"half_axes", "tolerance", NULL};
    const char *unknown;
    double a[3], tolerance;
    if (!json_is_object(g->value) || !scene_has_only(g->value, words, &unknown) ||
        !scene_read_numbers(json_object_get(g->value, "half_axes"), a, 3) || !(a[0] >= 0 && a[1] >= 0 && a[2] >= 0)) {
        scene_fail_member(r, OVOID_ERROR_FORMAT, g->kind,
                          "must be {\"half_axes\", \"tolerance\"}, with three half axes >= 0");
        return NULL;
    }
    if (read_size(r, g->value, g->kind, "tolerance", 0, &tolerance)) return NULL;
    ovoid_shape_options options = g->options;
    options.tolerance = tolerance;
    ovoid_error why = {OVOID_OK, -1, ""};
    return name_failure(r, g, ovoid_shape_create_ellipsoid((ovoid_vec3){a[0], a[1], a[2]}, &options, &why), &why);
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
        good = scene_read_numbers(json_array_get(g->value, i), xyz + 3 * i, 3);
        for (int k = 0; k < 3; k++) xyz[3 * i + (size_t)k] *= g->read.scale;
    }
    ovoid_error why = {OVOID_OK, -1, ""};
    ovoid_shape *shape = NULL;
    if (good)
        shape = name_failure(r, g, ovoid_shape_create_from_points(xyz, count, &g->options, &why), &why);
    else
        scene_fail_member(r, OVOID_ERROR_FORMAT, g->kind, "must be a list of points [x, y, z], at least one");
    free(xyz);
    return shape;
}

static ovoid_shape *make_shape(scene_reader *r, const geometry *g) {
    if (strcmp(g->kind, "box") == 0) return make_box(r, g);
    if (strcmp(g->kind, "sphere") == 0) return make_sphere(r, g);
    if (strcmp(g->kind, "points") == 0) return make_points(r, g);
    if (strcmp(g->kind, "ellipsoid") == 0) return make_ellipsoid(r, g);
    return make_round(r, g);
}

// Puts the scene's line before the error of a file that cannot be opened; errors inside it have their own path and
// line.
static ovoid_code fail_mesh(scene_reader *r, const ovoid_error *why) {
    if (why->code == OVOID_ERROR_FILE || why->code == OVOID_ERROR_ARGUMENT)
        return scene_fail(r, why->code, "mesh", why->message);
    if (r->error) *r->error = *why;
    return why->code;
}

// The triangles of a mesh that is to be them: as asked, or because it is not its hull.
static ovoid_code take_solid(scene_reader *r, const geometry *g, scene_body *body) {
    ovoid_convexity c = ovoid_shapes_get(body->parts, 0).convexity;
    body->is_asked = g->solid > 0;
    if (g->solid == 0 || !(body->is_asked || c.kind != OVOID_MESH_HULL)) return OVOID_OK;
    if (!g->is_plain)
        return scene_fail_member(r, OVOID_ERROR_FORMAT, "mesh",
                                 c.kind == OVOID_MESH_SURFACE
                                     ? "is not closed: as a surface it has no radius and no allowance, and is no part "
                                       "of a compound; \"hull\": true takes its hull"
                                     : "is not convex: as a solid it has no radius and no allowance, and is no part of "
                                       "a compound; \"hull\": true takes its hull");
    body->solid = ovoid_shapes_get(body->parts, 0).solid;
    return OVOID_OK;
}

static ovoid_code read_mesh(scene_reader *r, const geometry *g, scene_body *body) {
    ovoid_error why = {OVOID_OK, -1, ""};
    body->mesh = text_copy(g->mesh, strlen(g->mesh));
    body->read = g->read;
    if (!body->mesh) return io_fail_memory(r->error, r->path);
    body->mesh_at = strlen(body->mesh) - strlen(json_string_value(g->value));
    body->parts = ovoid_shapes_read_file(g->mesh, &g->read, &g->options, &why);
    if (!body->parts) return fail_mesh(r, &why);
    body->mesh_checksum = shapes_get_checksum(body->parts);
    if (!g->read.parts) {
        body->shape = ovoid_shapes_get(body->parts, 0).shape;
        return take_solid(r, g, body);
    }
    body->compound = ovoid_shapes_create_compound(body->parts, &(ovoid_compound_options){g->options.allocator}, &why);
    return body->compound ? OVOID_OK : fail_mesh(r, &why);
}

// ---- compounds of a scene's own parts

/// Parts under construction.
typedef struct part_list {
    ovoid_posed_shape *items;
    size_t count, capacity;
} part_list;

static ovoid_code add_part(scene_reader *r, part_list *list, const ovoid_shape *shape, const ovoid_pose *pose) {
    if (!array_reserve((void **)&list->items, &list->capacity, list->count, sizeof *list->items))
        return io_fail_memory(r->error, r->path);
    list->items[list->count++] = (ovoid_posed_shape){shape, *pose};
    return OVOID_OK;
}

// Reads a part: one shape, or all parts of a mesh.
static ovoid_code read_part(scene_reader *r, json_t *object, part_list *list) {
    static const char *const words[] = {"pose",  "mesh",      "box",    "sphere", "capsule",   "cylinder",
                                        "cone",  "ellipsoid", "points", "radius", "allowance", "hull",
                                        "parts", "scale",     "unit",   NULL};
    const char *unknown;
    ovoid_pose pose;
    size_t index;
    if (!json_is_object(object)) return scene_fail(r, OVOID_ERROR_FORMAT, NULL, "must be a JSON object");
    if (!scene_has_only(object, words, &unknown)) return scene_fail_key(r, unknown, "parts", words);
    ovoid_code code = scene_read_pose(r, json_object_get(object, "pose"), &pose);
    if (!code) code = scene_read_body(r, object, &index);
    if (code) return code;
    const scene_body *body = &r->scene->bodies[index];
    if (body->shape) return add_part(r, list, body->shape, &pose);
    for (size_t i = 0; i < ovoid_shapes_get_count(body->parts) && !code; i++)
        code = add_part(r, list, ovoid_shapes_get(body->parts, i).shape, &pose);
    return code;
}

static ovoid_code make_compound(scene_reader *r, const geometry *g, scene_body *body) {
    size_t count = json_array_size(g->value);
    if (!count) return scene_fail_member(r, OVOID_ERROR_FORMAT, "compound", "must be a list of parts, at least one");
    part_list list = {NULL, 0, 0};
    ovoid_code code = OVOID_OK;
    for (size_t i = 0; i < count && !code; i++) {
        r->part = (long)i;
        code = read_part(r, json_array_get(g->value, i), &list);
    }
    r->part = NO_PART;
    ovoid_error why = {OVOID_OK, -1, ""};
    const ovoid_compound_options options = {g->options.allocator};
    if (!code) body->compound = ovoid_compound_create(list.items, list.count, &options, &why);
    free(list.items);
    if (code || body->compound) return code;
    return scene_fail_member(r, why.code, "compound", why.message);
}

// ---- members of an object

// Finds the one member that names the geometry.
static ovoid_code find_geometry(scene_reader *r, json_t *object, geometry *g) {
    static const char *const kinds[] = {"mesh", "box",       "sphere", "capsule", "cylinder",
                                        "cone", "ellipsoid", "points", "compound"};
    *g = (geometry){.kind = NULL};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        json_t *value = json_object_get(object, kinds[i]);
        if (value && g->kind) return scene_fail_member(r, OVOID_ERROR_FORMAT, kinds[i], "is a second geometry");
        if (value) *g = (geometry){.kind = kinds[i], .value = value};
    }
    if (g->kind) return OVOID_OK;
    return scene_fail(
        r, OVOID_ERROR_FORMAT, NULL,
        r->part == NO_PART
            ? "no geometry: one of mesh, box, sphere, capsule, cylinder, cone, ellipsoid, points, compound"
            : "no geometry: one of mesh, box, sphere, capsule, cylinder, cone, ellipsoid, points");
}

// Reads "scale" times "unit", of meshes and points.
static ovoid_code read_scale(scene_reader *r, const json_t *object, geometry *g) {
    const json_t *scale = json_object_get(object, "scale"), *unit = json_object_get(object, "unit");
    const char *to = r->scene->unit[0] ? r->scene->unit : "m";
    g->read.scale = 1;
    g->read.unit = r->scene->unit[0] ? r->scene->unit : NULL;
    int is_scaled = strcmp(g->kind, "mesh") == 0 || strcmp(g->kind, "points") == 0;
    if ((scale || unit) && !is_scaled)
        return scene_fail_member(r, OVOID_ERROR_FORMAT, scale ? "scale" : "unit", "is for meshes and points only");
    if (scale) {
        if (!json_is_number(scale) || !(json_number_value(scale) > 0))
            return scene_fail_member(r, OVOID_ERROR_FORMAT, "scale", "must be a number > 0");
        g->read.scale = json_number_value(scale);
    }
    if (unit) {
        double factor = json_is_string(unit) ? ovoid_unit_get_scale(json_string_value(unit), to) : 0;
        if (factor == 0) return scene_fail_member(r, OVOID_ERROR_FORMAT, "unit", "must be m, cm, mm, um, in or ft");
        const char *path = json_string_value(g->value);
        if (path && path_has_extension(path, "dae"))
            return scene_fail_member(r, OVOID_ERROR_FORMAT, "unit", "is not for COLLADA, whose files say theirs");
        g->read.scale *= factor;
    }
    return OVOID_OK;
}

static ovoid_code read_radius(scene_reader *r, const json_t *object, geometry *g) {
    if (r->options) g->options = *r->options;
    const json_t *radius = json_object_get(object, "radius");
    g->options.radius = 0;
    if (!radius) return OVOID_OK;
    if (strcmp(g->kind, "compound") == 0)
        return scene_fail_member(r, OVOID_ERROR_FORMAT, "radius", "is for the parts of a compound, each its own");
    if (!json_is_number(radius) || !(json_number_value(radius) >= 0))
        return scene_fail_member(r, OVOID_ERROR_RADIUS, "radius", "must be a number >= 0");
    g->options.radius = json_number_value(radius);
    return OVOID_OK;
}

// "axis": along which there is no allowance `outside`; none where it is not given.
static ovoid_code read_axis(scene_reader *r, const json_t *allowance, ovoid_vec3 *axis) {
    const json_t *value = json_object_get(allowance, "axis");
    double n[3];
    if (!value) return OVOID_OK;
    if (!scene_read_numbers(value, n, 3) || !(fabs(n[0]) > 0 || fabs(n[1]) > 0 || fabs(n[2]) > 0))
        return scene_fail_member(r, OVOID_ERROR_FORMAT, "axis", "of an allowance must be [x, y, z], not all zero");
    *axis = (ovoid_vec3){n[0], n[1], n[2]};
    return OVOID_OK;
}

// Reads "allowance": {"outside", "inside", "axis"}, each length 0 where it is not given.
static ovoid_code read_allowance(scene_reader *r, const json_t *object, geometry *g) {
    static const char *const words[] = {"outside", "inside", "axis", NULL};
    const char *unknown;
    json_t *allowance = json_object_get(object, "allowance");
    g->options.allowance = (ovoid_allowance){0};
    if (!allowance) return OVOID_OK;
    if (strcmp(g->kind, "compound") == 0)
        return scene_fail_member(r, OVOID_ERROR_FORMAT, "allowance", "is for the parts of a compound, each its own");
    if (!json_is_object(allowance) || !scene_has_only(allowance, words, &unknown))
        return scene_fail_member(r, OVOID_ERROR_FORMAT, "allowance",
                                 "must be {\"outside\", \"inside\", \"axis\"}, two lengths and [x, y, z]");
    ovoid_code code = read_size(r, allowance, "allowance", "outside", 0, &g->options.allowance.outside);
    if (!code) code = read_size(r, allowance, "allowance", "inside", 0, &g->options.allowance.inside);
    return code ? code : read_axis(r, allowance, &g->options.allowance.axis);
}

static ovoid_code read_parts(scene_reader *r, const json_t *object, geometry *g) {
    const json_t *parts = json_object_get(object, "parts");
    if (!parts) return OVOID_OK;
    if (strcmp(g->kind, "mesh") != 0) return scene_fail_member(r, OVOID_ERROR_FORMAT, "parts", "is for meshes only");
    if (!json_is_boolean(parts)) return scene_fail_member(r, OVOID_ERROR_FORMAT, "parts", "must be true or false");
    g->read.parts = json_is_true(parts);
    return OVOID_OK;
}

// Reads a member that is true or false, of meshes; *is_true stays as it is where there is none.
static ovoid_code read_flag(scene_reader *r, const json_t *object, const geometry *g, const char *key, int *is_true) {
    const json_t *value = json_object_get(object, key);
    if (!value) return OVOID_OK;
    if (strcmp(g->kind, "mesh") != 0) return scene_fail_member(r, OVOID_ERROR_FORMAT, key, "is for meshes only");
    if (!json_is_boolean(value)) return scene_fail_member(r, OVOID_ERROR_FORMAT, key, "must be true or false");
    *is_true = json_is_true(value);
    return OVOID_OK;
}

// Reads "hull" and "solid". "solid": false is "hull": true.
static ovoid_code read_choice(scene_reader *r, const json_t *object, geometry *g) {
    const ovoid_allowance *allowance = &g->options.allowance;
    int is_plain = !(g->options.radius > 0) && !(allowance->outside > 0) && !(allowance->inside > 0);
    const char *path = strcmp(g->kind, "mesh") == 0 ? json_string_value(g->value) : NULL;
    int is_mesh = path && !g->read.parts && !ovoid_path_is_shape(path), hull = -1, solid = -1;
    ovoid_code code = read_flag(r, object, g, "hull", &hull);
    if (!code) code = read_flag(r, object, g, "solid", &solid);
    if (code) return code;
    g->is_plain = is_plain && r->part == NO_PART;
    if (is_mesh && hull < 0 && solid < 0) r->scene->has_choice = 1;
    g->solid = is_mesh && !r->hulls ? -1 : 0;
    if (hull > 0 || solid == 0) g->solid = 0;
    if (hull == 0 && is_mesh) g->solid = -1;
    g->read.hull = g->solid == 0;
    if (solid <= 0) return OVOID_OK;
    g->solid = g->read.solid = 1;
    g->read.hull = 0;
    if (hull > 0) return scene_fail_member(r, OVOID_ERROR_FORMAT, "solid", "excludes \"hull\"");
    if (g->read.parts)
        return scene_fail_member(r, OVOID_ERROR_FORMAT, "solid", "excludes \"parts\", whose hulls are the body");
    if (!is_plain) return scene_fail_member(r, OVOID_ERROR_FORMAT, "solid", "has no radius and no allowance");
    if (path && ovoid_path_is_shape(path))
        return scene_fail_member(r, OVOID_ERROR_FORMAT, "solid", "is for meshes; a .ovoid file has a hull");
    return OVOID_OK;
}

static ovoid_code read_path(scene_reader *r, geometry *g) {
    if (strcmp(g->kind, "mesh") != 0) return OVOID_OK;
    const char *name = json_string_value(g->value);
    if (!name || !name[0]) return scene_fail_member(r, OVOID_ERROR_FORMAT, "mesh", "must be the path of a file");
    g->mesh = path_join(r->path, name);
    return g->mesh ? OVOID_OK : io_fail_memory(r->error, r->path);
}

// ---- bodies by their keys

// All bits of a number: printing it would take most of the time that a box of a scene of a million takes.
static void add_number(scene_bytes *k, double number) {
    static const char digits[] = "0123456789abcdef";
    char text[17] = " ";
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    for (int i = 0; i < 16; i++) text[16 - i] = digits[bits >> 4 * i & 15];
    scene_bytes_add(k, text, sizeof text);
}

// Numbers and lists of them by their bits, all else as JSON.
static void add_value(scene_bytes *k, const json_t *value) {
    if (json_is_number(value)) {
        add_number(k, json_number_value(value));
    } else if (json_is_array(value)) {
        scene_bytes_add(k, "[", 1);
        for (size_t i = 0; i < json_array_size(value); i++) add_value(k, json_array_get(value, i));
        scene_bytes_add(k, "]", 1);
    } else {
        char *text = json_dumps(value, JSON_COMPACT | JSON_SORT_KEYS | JSON_ENCODE_ANY);
        if (text) scene_bytes_add(k, text, strlen(text));
        k->is_failed |= !text;
        free(text);
    }
}

// The key of a geometry: a text of all that the body is made from; NULL where there is no memory.
static char *make_key(const geometry *g) {
    scene_bytes k = {NULL, 0, 0, 0};
    scene_bytes_add(&k, g->kind, strlen(g->kind));
    const ovoid_allowance *allowance = &g->options.allowance;
    const ovoid_vec3 axis = allowance->axis;
    const double numbers[] = {g->options.radius, allowance->outside, allowance->inside, axis.x, axis.y, axis.z,
                              g->read.scale,     g->read.parts,      g->solid};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) add_number(&k, numbers[i]);
    if (g->mesh)
        scene_bytes_add(&k, g->mesh, strlen(g->mesh));
    else
        add_value(&k, g->value);
    scene_bytes_add(&k, "", 1);
    if (!k.is_failed) return k.data;
    free(k.data);
    return NULL;
}

static int is_end(const void *table, size_t slot, const void *key) {
    const scene_reader *r = table;
    return !r->slots[slot] || strcmp(r->scene->bodies[r->slots[slot] - 1].key, key) == 0;
}

// The slot of the body with that key, or the free slot where it belongs. There always is a free one.
static size_t *find_slot(const scene_reader *r, uint64_t hash, const char *key) {
    return &r->slots[hash_find(hash, r->slot_count, r, key, is_end)];
}

// Doubles the slots where they are half full.
static int grow_slots(scene_reader *r) {
    if (2 * (r->scene->body_count + 1) <= r->slot_count) return 1;
    size_t count = r->slot_count ? 2 * r->slot_count : 64, *slots = calloc(count, sizeof *slots);
    if (!slots) return 0;
    free(r->slots);
    r->slots = slots;
    r->slot_count = count;
    for (size_t i = 0; i < r->scene->body_count; i++)
        *find_slot(r, r->scene->bodies[i].hash, r->scene->bodies[i].key) = i + 1;
    return 1;
}

// Adds a body as the last one. What it owns is freed where there is no memory.
static ovoid_code add_body(scene_reader *r, scene_body *body) {
    ovoid_scene *scene = r->scene;
    if (grow_slots(r) &&
        array_reserve((void **)&scene->bodies, &scene->body_capacity, scene->body_count, sizeof *body)) {
        scene->bodies[scene->body_count++] = *body;
        *find_slot(r, body->hash, body->key) = scene->body_count;
        return OVOID_OK;
    }
    scene_body_clear(body);
    return io_fail_memory(r->error, r->path);
}

static ovoid_code make_body(scene_reader *r, const geometry *g, scene_body *body) {
    if (g->mesh) return read_mesh(r, g, body);
    if (strcmp(g->kind, "compound") == 0) return make_compound(r, g, body);
    body->shape = body->made = make_shape(r, g);
    return body->shape ? OVOID_OK : OVOID_ERROR_FORMAT;
}

static ovoid_code find_or_make_body(scene_reader *r, const geometry *g, size_t *index) {
    scene_body body = {.key = make_key(g)};
    if (!body.key) return io_fail_memory(r->error, r->path);
    body.hash = text_hash(body.key);
    size_t *slot = r->slot_count ? find_slot(r, body.hash, body.key) : NULL;
    if (slot && *slot) {
        *index = *slot - 1;
        free(body.key);
        return OVOID_OK;
    }
    ovoid_code code = make_body(r, g, &body);
    if (code) {
        scene_body_clear(&body);
        return code;
    }
    code = add_body(r, &body);
    *index = r->scene->body_count - 1;
    return code;
}

ovoid_code scene_read_body(scene_reader *r, json_t *object, size_t *body) {
    geometry g;
    ovoid_code code = find_geometry(r, object, &g);
    if (!code) code = read_scale(r, object, &g);
    if (!code) code = read_parts(r, object, &g);
    if (!code) code = read_radius(r, object, &g);
    if (!code) code = read_allowance(r, object, &g);
    if (!code) code = read_choice(r, object, &g);
    if (!code) code = read_path(r, &g);
    if (!code) code = find_or_make_body(r, &g, body);
    free(g.mesh);
    return code;
}

void scene_body_clear(scene_body *body) {
    ovoid_compound_destroy(body->compound);
    ovoid_shape_destroy(body->made);
    ovoid_shapes_destroy(body->parts);
    free(body->hulls);
    free(body->mesh);
    free(body->key);
    *body = (scene_body){.key = NULL};
}

size_t scene_body_count_hulls(const scene_body *body) {
    return body->parts ? ovoid_shapes_get_count(body->parts) : body->hull_count;
}

ovoid_named_shape scene_body_get_hull(const scene_body *body, size_t i) {
    return body->parts ? ovoid_shapes_get(body->parts, i) : body->hulls[i];
}
