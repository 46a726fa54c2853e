// Writing a packed scene: all that was read of a scene and its meshes, in one file.
#include "io/scene/scene_packed.h"

#include <stdlib.h>

/// The state of writing.
typedef struct packer {
    const ovoid_scene *scene;
    scene_bytes out;
    const ovoid_shape **shapes; ///< in the order of the file
    size_t shape_count, shape_capacity;
    int is_failed; ///< no memory
} packer;

static void put_word(packer *p, uint64_t word) { scene_bytes_add(&p->out, &word, sizeof word); }
static void put_number(packer *p, double number) { scene_bytes_add(&p->out, &number, sizeof number); }

static void pad(packer *p) {
    static const char zeros[8];
    scene_bytes_add(&p->out, zeros, packed_round(p->out.length) - p->out.length);
}

static void put_bytes(packer *p, const void *from, size_t size) {
    scene_bytes_add(&p->out, from, size);
    pad(p);
}

// A text behind the number of its bytes, with the zero byte at its end.
static void put_text(packer *p, const char *text) {
    put_word(p, strlen(text) + 1);
    put_bytes(p, text, strlen(text) + 1);
}

static void put_pose(packer *p, const ovoid_pose *pose) {
    const double numbers[7] = {pose->position.x, pose->position.y, pose->position.z, pose->rotation.w,
                               pose->rotation.x, pose->rotation.y, pose->rotation.z};
    scene_bytes_add(&p->out, numbers, sizeof numbers);
}

// ---- objects

static void put_objects(packer *p, packed_header *h) {
    const ovoid_scene *scene = p->scene;
    for (size_t i = 0; i < scene->count; i++) {
        const uint32_t words[2] = {(uint32_t)h->name_size, (uint32_t)scene->entries[i].body};
        put_pose(p, &scene->entries[i].pose);
        scene_bytes_add(&p->out, words, sizeof words);
        h->name_size += strlen(scene->entries[i].name) + 1;
    }
    for (size_t i = 0; i < scene->count; i++) scene_bytes_add(&p->out, &(uint32_t){(uint32_t)scene->by_name[i]}, 4);
    pad(p);
    scene_bytes_add(&p->out, scene->ignored, scene->ignored_count * sizeof *scene->ignored);
    for (size_t i = 0; i < scene->count; i++)
        scene_bytes_add(&p->out, scene->entries[i].name, strlen(scene->entries[i].name) + 1);
    pad(p);
}

// ---- shapes

// Lists the shapes that are a body's own: the hulls of a mesh, or the one that was made.
static void list_shapes(packer *p, const scene_body *body) {
    int is_made = !body->mesh && body->shape;
    size_t count = is_made ? 1 : scene_body_count_hulls(body);
    for (size_t i = 0; i < count && !p->is_failed; i++) {
        p->is_failed = !array_reserve((void **)&p->shapes, &p->shape_capacity, p->shape_count, sizeof(void *));
        if (p->is_failed) return;
        p->shapes[p->shape_count++] = is_made ? body->shape : scene_body_get_hull(body, i).shape;
    }
}

static void put_shape(packer *p, const ovoid_shape *shape) {
    size_t size = ovoid_shape_write(shape, NULL, 0);
    void *room = malloc(size);
    p->is_failed |= !room;
    if (!room) return;
    (void)ovoid_shape_write(shape, room, size);
    put_word(p, size);
    put_bytes(p, room, size);
    free(room);
}

/// A shape and its number, for sorting by address.
typedef struct shape_number {
    const ovoid_shape *shape;
    uint64_t number;
} shape_number;

static int compare_shapes(const void *a, const void *b) {
    uintptr_t x = (uintptr_t)((const shape_number *)a)->shape, y = (uintptr_t)((const shape_number *)b)->shape;
    return (x > y) - (x < y);
}

// ---- bodies

static void put_solid(packer *p, const ovoid_solid *solid) {
    put_word(p, solid != NULL);
    if (!solid) return;
    ovoid_solid_report report = ovoid_solid_get_report(solid);
    put_word(p, report.points);
    put_word(p, report.triangles);
    scene_bytes_add(&p->out, ovoid_solid_get_points(solid), (size_t)report.points * 3 * sizeof(double));
    for (size_t i = 0; i < report.triangles; i++) {
        uint32_t corners[3];
        ovoid_solid_get_triangle(solid, i, corners);
        scene_bytes_add(&p->out, corners, sizeof corners);
    }
    pad(p);
}

static void put_hull(packer *p, const scene_body *body, size_t i) {
    ovoid_named_shape hull = scene_body_get_hull(body, i);
    if (body->read.parts) put_text(p, hull.name);
    put_word(p, (uint64_t)hull.convexity.kind);
    put_number(p, hull.convexity.allowance);
    put_word(p, hull.convexity.edges_unmatched);
    put_number(p, hull.convexity.mesh_volume);
    put_number(p, hull.convexity.hull_volume);
    put_solid(p, hull.solid);
}

static void put_mesh(packer *p, const scene_body *body, uint64_t first_shape) {
    const ovoid_read_options *read = &body->read;
    size_t count = scene_body_count_hulls(body);
    put_word(p, PACKED_MESH);
    put_word(p, first_shape);
    put_word(p, count);
    put_word(p, (read->parts ? PACKED_PARTS : 0) | (read->hull ? PACKED_HULL : 0) | (read->solid ? PACKED_SOLID : 0) |
                    (body->is_asked ? PACKED_ASKED : 0) | (body->solid ? PACKED_TRIANGLES : 0));
    put_number(p, read->scale);
    put_word(p, body->mesh_checksum);
    put_text(p, body->mesh + body->mesh_at);
    for (size_t i = 0; i < count; i++) put_hull(p, body, i);
}

static void put_compound(packer *p, const ovoid_compound *compound, const shape_number *numbers) {
    size_t count = ovoid_compound_get_part_count(compound);
    put_word(p, PACKED_COMPOUND);
    put_word(p, count);
    for (size_t i = 0; i < count; i++) {
        ovoid_posed_shape part = ovoid_compound_get_part(compound, i);
        const shape_number wanted = {part.shape, 0};
        const shape_number *found = bsearch(&wanted, numbers, p->shape_count, sizeof wanted, compare_shapes);
        put_word(p, found->number);
        put_pose(p, &part.pose);
    }
}

static void put_bodies(packer *p, const shape_number *numbers) {
    uint64_t shape = 0;
    for (size_t i = 0; i < p->scene->body_count; i++) {
        const scene_body *body = &p->scene->bodies[i];
        if (body->mesh) {
            put_mesh(p, body, shape);
            shape += scene_body_count_hulls(body);
        } else if (body->compound) {
            put_compound(p, body->compound, numbers);
        } else {
            put_word(p, PACKED_SHAPE);
            put_word(p, shape++);
        }
    }
}

static void put_shapes_and_bodies(packer *p) {
    for (size_t i = 0; i < p->scene->body_count; i++) list_shapes(p, &p->scene->bodies[i]);
    shape_number *numbers = malloc((p->shape_count + 1) * sizeof *numbers);
    p->is_failed |= !numbers;
    if (p->is_failed) {
        free(numbers);
        return;
    }
    for (size_t i = 0; i < p->shape_count; i++) {
        put_shape(p, p->shapes[i]);
        numbers[i] = (shape_number){p->shapes[i], i};
    }
    qsort(numbers, p->shape_count, sizeof *numbers, compare_shapes);
    put_bodies(p, numbers);
    free(numbers);
}

// ---- the file

static int pack(packer *p) {
    const ovoid_scene *scene = p->scene;
    packed_header h = {.magic = "",
                       .version = PACKED_VERSION,
                       .order = PACKED_ORDER,
                       .choice = !scene->has_choice ? PACKED_EITHER
                                 : scene->hulls     ? PACKED_HULLS
                                                    : PACKED_SOLIDS,
                       .object_count = scene->count,
                       .ignored_count = scene->ignored_count,
                       .body_count = scene->body_count};
    memcpy(h.magic, PACKED_MAGIC, sizeof h.magic);
    memcpy(h.unit, scene->unit, sizeof h.unit);
    scene_bytes_add(&p->out, &h, sizeof h);
    put_objects(p, &h);
    put_shapes_and_bodies(p);
    if (p->is_failed || p->out.is_failed) return 0;
    h.shape_count = p->shape_count;
    h.size = p->out.length;
    memcpy(p->out.data, &h, sizeof h);
    h.checksum = packed_compute_checksum((const packed_header *)(const void *)p->out.data);
    memcpy(p->out.data, &h, sizeof h);
    return 1;
}

ovoid_code ovoid_scene_write(const ovoid_scene *scene, const char *path, ovoid_error *error) {
    packer p = {.scene = scene};
    ovoid_code code = pack(&p) ? OVOID_OK : io_fail_memory(error, path);
    ovoid_output *output = code ? NULL : ovoid_output_open(path, error);
    if (output) {
        (void)fwrite(p.out.data, 1, p.out.length, ovoid_output_get_file(output)); // the stream keeps its error state
        code = ovoid_output_commit(output, error);
        ovoid_output_close(output);
    } else if (!code) {
        code = OVOID_ERROR_FILE;
    }
    free(p.out.data);
    free(p.shapes);
    return code;
}
