// Reading a packed scene. Every number is checked, also behind a checksum that agrees: what follows trusts none of
// them. Names stay in the bytes of the file. Cost: linear in the objects, plus reading the shapes and making solids.
#include "io/scene/scene_packed.h"

#include <math.h>
#include <stdlib.h>

/// The state of reading: what is left of the file.
typedef struct unpacker {
    scene_reader *r;
    const char *begin, *at, *end;
    const ovoid_allocator *allocator;
    const packed_header *header;
    unsigned char *is_owned; ///< of each shape: 1 once it is a body's own, and not only a part of a compound
} unpacker;

static ovoid_code refuse(const unpacker *u, const char *what) {
    return io_fail(u->r->error, OVOID_ERROR_FORMAT, (where){u->r->path, 0, u->at - u->begin},
                   "packed scene, byte %zu: %s", (size_t)(u->at - u->begin), what);
}

static ovoid_code fail_memory(const unpacker *u) { return io_fail_memory(u->r->error, u->r->path); }

// The next bytes, of `count` items, and what fills them up to a multiple of 8; NULL where there are not so many.
static const void *take(unpacker *u, uint64_t count, size_t size) {
    size_t left = (size_t)(u->end - u->at);
    if (count > left / size || packed_round((size_t)count * size) > left) return NULL;
    const char *taken = u->at;
    u->at += packed_round((size_t)count * size);
    return taken;
}

// The next word; 0, and *good is 0, where there is none.
static uint64_t take_word(unpacker *u, int *good) {
    const uint64_t *word = take(u, 1, sizeof *word);
    *good &= word != NULL;
    return word ? *word : 0;
}

static double take_number(unpacker *u, int *good) {
    uint64_t word = take_word(u, good);
    double number;
    memcpy(&number, &word, sizeof number);
    return number;
}

// The next text; NULL where there is none, or it has not its length.
static const char *take_text(unpacker *u) {
    int good = 1;
    uint64_t size = take_word(u, &good);
    const char *text = good && size ? take(u, size, 1) : NULL;
    return text && strlen(text) + 1 == size ? text : NULL;
}

static ovoid_pose make_pose(const double n[7]) { return (ovoid_pose){{n[0], n[1], n[2]}, {n[3], n[4], n[5], n[6]}}; }

// ---- the header

static ovoid_code check_header(unpacker *u, size_t size) {
    const packed_header *h = u->header;
    if (size < sizeof *h) return refuse(u, "it ends within its header");
    if (h->order != PACKED_ORDER) return refuse(u, "it is of a machine with another byte order: pack the scene here");
    if (h->version != PACKED_VERSION) return refuse(u, "it is of another version of the format: pack the scene anew");
    if (h->size != size) return refuse(u, h->size > size ? "it is cut off" : "there are bytes behind its end");
    // A whole file is padded to words.
    if (size % 8 || h->checksum != packed_compute_checksum(h))
        return refuse(u, "the checksum does not agree: it is damaged");
    if (h->choice > PACKED_EITHER || !memchr(h->unit, 0, sizeof h->unit) ||
        (h->unit[0] && !(ovoid_unit_get_scale(h->unit, "m") > 0)))
        return refuse(u, "its choice of meshes or its unit is none");
    if (h->choice != PACKED_EITHER && (h->choice == PACKED_HULLS) != u->r->hulls)
        return io_fail(u->r->error, OVOID_ERROR_ARGUMENT, (where){u->r->path, 0, -1},
                       u->r->hulls
                           ? "packed scene: meshes that are not convex are its solids; pack the scene with "
                             "--hull to read it so"
                           : "packed scene: its meshes are hulls; read it with --hull, or pack the scene without");
    return OVOID_OK;
}

// ---- objects

static ovoid_code read_names(unpacker *u, const packed_object *objects, const uint32_t *order, const char *names) {
    ovoid_scene *scene = u->r->scene;
    const packed_header *h = u->header;
    if (!names || !h->name_size || names[h->name_size - 1]) return refuse(u, "its names have no end");
    for (size_t i = 0; i < scene->count; i++) {
        const packed_object *o = &objects[i];
        scene_entry *entry = &scene->entries[i];
        if (o->name >= h->name_size || !names[o->name] || o->body >= h->body_count)
            return refuse(u, "an object has no name or no body");
        *entry = (scene_entry){(char *)names + o->name, make_pose(o->pose), o->body};
        if (ovoid_pose_validate(&entry->pose)) return refuse(u, "the pose of an object is out of range");
    }
    for (size_t i = 0; i < scene->count; i++) {
        if (order[i] >= scene->count) return refuse(u, "the order of its names is none");
        scene->by_name[i] = order[i];
        if (i && strcmp(scene->entries[order[i - 1]].name, scene->entries[order[i]].name) >= 0)
            return refuse(u, "its names are not in their order, or one is there twice");
    }
    return OVOID_OK;
}

static ovoid_code read_ignored(unpacker *u, const uint64_t *ignored) {
    ovoid_scene *scene = u->r->scene;
    size_t count = (size_t)u->header->ignored_count;
    scene->ignored = malloc((count + 1) * sizeof *ignored);
    if (!scene->ignored) return fail_memory(u);
    for (size_t i = 0; i < count; i++) {
        uint64_t low = ignored[i] >> 32, high = ignored[i] & UINT32_MAX;
        if (low >= high || high >= scene->count || (i && ignored[i - 1] >= ignored[i]))
            return refuse(u, "its pairs to ignore are none, or not in their order");
        scene->ignored[i] = ignored[i];
    }
    scene->ignored_count = count;
    return OVOID_OK;
}

static ovoid_code read_objects(unpacker *u) {
    const packed_header *h = u->header;
    ovoid_scene *scene = u->r->scene;
    const packed_object *objects = take(u, h->object_count, sizeof *objects);
    const uint32_t *order = objects ? take(u, h->object_count, sizeof *order) : NULL;
    const uint64_t *ignored = order ? take(u, h->ignored_count, sizeof *ignored) : NULL;
    const char *names = ignored ? take(u, h->name_size, 1) : NULL;
    if (!names || !h->object_count || h->object_count > UINT32_MAX) return refuse(u, "it has not the objects it says");
    scene->count = (size_t)h->object_count;
    scene->entries = calloc(scene->count, sizeof *scene->entries);
    scene->by_name = malloc(scene->count * sizeof *scene->by_name);
    if (!scene->entries || !scene->by_name) return fail_memory(u);
    ovoid_code code = read_names(u, objects, order, names);
    return code ? code : read_ignored(u, ignored);
}

// ---- shapes

static ovoid_code read_shapes(unpacker *u) {
    ovoid_scene *scene = u->r->scene;
    uint64_t count = u->header->shape_count;
    // Each has at least its size.
    if (count > (uint64_t)(u->end - u->at) / 8) return refuse(u, "it has not the shapes it says");
    scene->shapes = calloc((size_t)count + 1, sizeof *scene->shapes);
    if (!scene->shapes) return fail_memory(u);
    const ovoid_shape_options options = {.allocator = u->allocator};
    for (size_t i = 0; i < count; i++) {
        int good = 1;
        uint64_t size = take_word(u, &good);
        const void *bytes_of = good ? take(u, size, 1) : NULL;
        if (!bytes_of) return refuse(u, "it ends within a shape");
        scene->shapes[i] = ovoid_shape_read(bytes_of, (size_t)size, &options, u->r->error);
        if (scene->shapes[i]) {
            scene->shape_count++;
            continue;
        }
        io_prefix_path(u->r->error, u->r->path);
        return OVOID_ERROR_FORMAT;
    }
    return OVOID_OK;
}

// ---- bodies

// A shape by its number, of a body or (is_part) of a compound, whose parts are those of bodies before it; NULL.
static const ovoid_shape *take_shape(unpacker *u, int is_part) {
    int good = 1;
    uint64_t number = take_word(u, &good);
    if (!good || number >= u->r->scene->shape_count || (is_part && !u->is_owned[number])) return NULL;
    u->is_owned[number] = 1;
    return u->r->scene->shapes[number];
}

static ovoid_code read_solid(unpacker *u, const ovoid_solid **solid) {
    int good = 1;
    uint64_t has = take_word(u, &good);
    if (!good || has > 1) return refuse(u, "whether a mesh has triangles is not said");
    if (!has) return OVOID_OK;
    uint64_t points = take_word(u, &good), count = take_word(u, &good);
    const double *xyz = good ? take(u, points, 3 * sizeof *xyz) : NULL;
    const uint32_t *indices = xyz ? take(u, count, 3 * sizeof *indices) : NULL;
    if (!indices) return refuse(u, "it ends within triangles");
    ovoid_scene *scene = u->r->scene;
    const ovoid_triangles triangles = {xyz, (size_t)points, indices, (size_t)count};
    void *solids = scene->solids;
    if (!array_reserve(&solids, &scene->solid_capacity, scene->solid_count, sizeof *scene->solids))
        return fail_memory(u);
    scene->solids = solids;
    ovoid_solid *made =
        ovoid_solid_create_from_triangles(&triangles, &(ovoid_solid_options){u->allocator}, u->r->error);
    if (!made) {
        io_prefix_path(u->r->error, u->r->path);
        return OVOID_ERROR_FORMAT;
    }
    *solid = scene->solids[scene->solid_count++] = made;
    return OVOID_OK;
}

static ovoid_code read_hull(unpacker *u, const scene_body *body, ovoid_named_shape *hull) {
    int good = 1;
    hull->name = body->read.parts ? take_text(u) : body->mesh;
    ovoid_convexity *c = &hull->convexity;
    c->kind = (ovoid_mesh_kind)take_word(u, &good);
    c->allowance = take_number(u, &good);
    c->edges_unmatched = take_word(u, &good);
    c->mesh_volume = take_number(u, &good);
    c->hull_volume = take_number(u, &good);
    if (!good || !hull->name || (unsigned)c->kind > OVOID_MESH_SURFACE || !(c->allowance >= 0))
        return refuse(u, "what a mesh is, is not said");
    return read_solid(u, &hull->solid);
}

static ovoid_code create_compound(unpacker *u, scene_body *body, const ovoid_posed_shape *parts, size_t count) {
    body->compound = ovoid_compound_create(parts, count, &(ovoid_compound_options){u->allocator}, u->r->error);
    if (body->compound) return OVOID_OK;
    io_prefix_path(u->r->error, u->r->path);
    return OVOID_ERROR_FORMAT;
}

// The compound of a mesh's parts, as ovoid_shapes_create_compound makes it.
static ovoid_code join_parts(unpacker *u, scene_body *body) {
    ovoid_posed_shape *parts = malloc((body->hull_count + 1) * sizeof *parts);
    if (!parts) return fail_memory(u);
    for (size_t i = 0; i < body->hull_count; i++)
        parts[i] = (ovoid_posed_shape){body->hulls[i].shape, ovoid_pose_make_identity()};
    ovoid_code code = create_compound(u, body, parts, body->hull_count);
    free(parts);
    return code;
}

static ovoid_code read_mesh_head(unpacker *u, scene_body *body, uint64_t *first, uint64_t *flags) {
    int good = 1;
    ovoid_scene *scene = u->r->scene;
    *first = take_word(u, &good);
    uint64_t count = take_word(u, &good);
    *flags = take_word(u, &good);
    body->read = (ovoid_read_options){.scale = take_number(u, &good),
                                      .unit = scene->unit[0] ? scene->unit : NULL,
                                      .parts = (*flags & PACKED_PARTS) != 0,
                                      .hull = (*flags & PACKED_HULL) != 0,
                                      .solid = (*flags & PACKED_SOLID) != 0};
    body->mesh_checksum = take_word(u, &good);
    const char *name = take_text(u);
    if (!good || !name || !name[0] || !(body->read.scale > 0 && isfinite(body->read.scale)) || !count ||
        *first >= scene->shape_count || count > scene->shape_count - *first || (!body->read.parts && count > 1))
        return refuse(u, "a mesh has no name, or not the shapes it says");
    body->mesh = path_join(u->r->path, name);
    body->hulls = calloc((size_t)count, sizeof *body->hulls);
    if (!body->mesh || !body->hulls) return fail_memory(u);
    body->mesh_at = strlen(body->mesh) - strlen(name);
    body->hull_count = (size_t)count;
    memset(u->is_owned + *first, 1, (size_t)count);
    return OVOID_OK;
}

static ovoid_code read_mesh(unpacker *u, scene_body *body) {
    uint64_t first, flags;
    ovoid_code code = read_mesh_head(u, body, &first, &flags);
    for (size_t i = 0; i < body->hull_count && !code; i++) {
        body->hulls[i].shape = u->r->scene->shapes[first + i];
        code = read_hull(u, body, &body->hulls[i]);
    }
    if (code) return code;
    body->is_asked = (flags & PACKED_ASKED) != 0;
    // Parts are hulls.
    if (body->read.parts && flags & (PACKED_ASKED | PACKED_TRIANGLES))
        return refuse(u, "a mesh has not the triangles it says");
    if (body->read.parts) return join_parts(u, body);
    body->shape = body->hulls[0].shape;
    body->solid = flags & PACKED_TRIANGLES ? body->hulls[0].solid : NULL;
    if (body->is_asked > (body->solid != NULL) || (flags & PACKED_TRIANGLES && !body->solid))
        return refuse(u, "a mesh has not the triangles it says");
    return OVOID_OK;
}

static ovoid_code read_compound(unpacker *u, scene_body *body) {
    int good = 1;
    uint64_t count = take_word(u, &good);
    // Each part has 64 bytes.
    if (!good || !count || count > (uint64_t)(u->end - u->at) / 64) return refuse(u, "a compound has not its parts");
    ovoid_posed_shape *parts = malloc((size_t)count * sizeof *parts);
    if (!parts) return fail_memory(u);
    for (size_t i = 0; i < count && good; i++) {
        parts[i].shape = take_shape(u, 1);
        const double *numbers = take(u, 7, sizeof *numbers);
        good = parts[i].shape && numbers;
        if (good) parts[i].pose = make_pose(numbers);
    }
    ovoid_code code = good ? create_compound(u, body, parts, (size_t)count) : refuse(u, "a compound has not its parts");
    free(parts);
    return code;
}

static ovoid_code read_body(unpacker *u, scene_body *body) {
    int good = 1;
    uint64_t kind = take_word(u, &good);
    if (good && kind == PACKED_MESH) return read_mesh(u, body);
    if (good && kind == PACKED_COMPOUND) return read_compound(u, body);
    body->shape = good && kind == PACKED_SHAPE ? take_shape(u, 0) : NULL;
    return body->shape ? OVOID_OK : refuse(u, "a body is of no kind, or has no shape");
}

static ovoid_code read_bodies(unpacker *u) {
    ovoid_scene *scene = u->r->scene;
    uint64_t count = u->header->body_count;
    // Each has at least its kind.
    if (count > (uint64_t)(u->end - u->at) / 8) return refuse(u, "it has not the bodies it says");
    scene->bodies = calloc((size_t)count + 1, sizeof *scene->bodies);
    u->is_owned = calloc(scene->shape_count + 1, 1);
    if (!scene->bodies || !u->is_owned) return fail_memory(u);
    ovoid_code code = OVOID_OK;
    for (size_t i = 0; i < count && !code; i++) code = read_body(u, &scene->bodies[scene->body_count++]);
    if (!code && u->at != u->end) return refuse(u, "there is more than it says");
    return code;
}

ovoid_code scene_unpack(scene_reader *r, bytes file) {
    unpacker u = {.r = r,
                  .begin = file.data,
                  .at = file.data,
                  .end = file.data + file.size,
                  .allocator = r->options ? r->options->allocator : NULL,
                  .header = (const packed_header *)(const void *)file.data};
    r->scene->packed = file.data;
    ovoid_code code = check_header(&u, file.size);
    if (code) return code;
    memcpy(r->scene->unit, u.header->unit, sizeof r->scene->unit);
    r->scene->hulls = r->hulls;
    r->scene->has_choice = u.header->choice != PACKED_EITHER;
    (void)take(&u, 1, sizeof *u.header);
    code = read_objects(&u);
    if (!code) code = read_shapes(&u);
    if (!code) code = read_bodies(&u);
    free(u.is_owned);
    return code;
}
