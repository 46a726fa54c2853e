// The bodies of a page: chosen, then written in the order of the scene; each shape once.
#include "page/bodies.h"

#include "base/message.h"
#include "page/shapes.h"
#include "page/write.h"

#include <stdlib.h>

/// The largest numbers of bodies and pairs of a page.
enum { BODIES_MOST = 10000, PAIRS_MOST = 20000 };

page_body *page_bodies_list(const ovoid_scene *scene) {
    size_t count = ovoid_scene_get_count(scene);
    page_body *bodies = malloc((count + 1) * sizeof *bodies);
    if (!bodies) message_error("out of memory");
    for (size_t i = 0; i < count && bodies; i++) {
        ovoid_scene_object o = ovoid_scene_get(scene, i);
        bodies[i] = (page_body){.name = o.name,
                                .body = {.shape = o.shape, .compound = o.compound, .pose = o.pose},
                                .solid = o.solid,
                                .convexity = o.convexity,
                                .mesh = inputs_find_mesh(scene, i)};
    }
    return bodies;
}

// ---- choosing

/// Adds an object to the choice; 0 if there is no room.
static int take(page_choice *c, uint32_t object) {
    if (c->numbers[object] != PAGE_NO_NUMBER) return 1;
    if (c->count == BODIES_MOST) return 0;
    c->numbers[object] = 0;
    c->near[c->count++] = object;
    return 1;
}

/// Adds pairs with their objects, the nearest first.
static void take_pairs(page_choice *c, const page_couples *couples) {
    for (size_t i = 0; i < couples->count && c->pair_count < PAIRS_MOST; i++) {
        ovoid_couple couple = *(const ovoid_couple *)(const void *)((const char *)couples->items + i * couples->stride);
        if (take(c, couple.a) && take(c, couple.b)) c->pairs[c->pair_count++] = (page_pair){couple, i};
    }
}

int page_choose(cli_page *page, size_t object_count, const page_couples *couples, page_choice *c) {
    size_t most = object_count < BODIES_MOST ? object_count : BODIES_MOST;
    size_t pairs_most = couples->count < PAIRS_MOST ? couples->count : PAIRS_MOST;
    *c = (page_choice){.numbers = malloc((object_count + 1) * sizeof *c->numbers),
                       .near = malloc((most + 1) * sizeof *c->near),
                       .pairs = malloc((pairs_most + 1) * sizeof *c->pairs),
                       .object_count = object_count};
    if (!c->numbers || !c->near || !c->pairs) {
        page_choice_clear(c);
        return message_error("out of memory"), EXIT_INPUT;
    }
    for (size_t i = 0; i < object_count; i++) c->numbers[i] = PAGE_NO_NUMBER;
    take_pairs(c, couples);
    for (size_t i = 0; i < object_count && c->count < most; i++) (void)take(c, (uint32_t)i);
    // Numbers in the order of the objects.
    uint32_t number = 0;
    for (size_t i = 0; i < object_count; i++)
        if (c->numbers[i] != PAGE_NO_NUMBER) c->numbers[i] = number++;
    page->left_out.bodies += object_count - c->count;
    page->left_out.pairs += couples->count - c->pair_count;
    return 0;
}

void page_choice_clear(page_choice *c) {
    free(c->numbers);
    free(c->near);
    free(c->pairs);
    *c = (page_choice){.numbers = NULL};
}

// ---- writing

/// Adds the shapes of all bodies, and the meshes of the nearest first. 0, or EXIT_INPUT after a message.
static int add_shapes(cli_page *page, page_shapes *shapes, const page_body *bodies, const page_choice *c) {
    int code = 0;
    for (size_t i = 0; i < c->count && !code; i++) {
        const page_body *b = &bodies[c->near[i]];
        code = b->solid ? page_shapes_add_solid(shapes, page, b->body.shape, b->solid)
                        : page_shapes_add_mesh(shapes, page, &b->body, &b->mesh);
    }
    return code;
}

static int is_identity(const ovoid_pose *pose) {
    const ovoid_vec3 p = pose->position;
    const ovoid_quat q = pose->rotation;
    return p.x == 0 && p.y == 0 && p.z == 0 && q.w == 1 && q.x == 0 && q.y == 0 && q.z == 0;
}

/// Writes one part. 0 if memory runs out.
static int write_part(FILE *file, page_shapes *shapes, const ovoid_posed_shape *part) {
    size_t number;
    if (!page_shapes_add(shapes, part->shape, &number)) return 0;
    fprintf(file, "{\"shape\":%zu", number);
    if (!is_identity(&part->pose)) {
        fputs(",\"pose\":", file);
        page_write_pose(file, &part->pose);
    }
    fputc('}', file);
    return 1;
}

static int write_body(FILE *file, page_shapes *shapes, const page_body *b) {
    const ovoid_compound *compound = b->body.compound;
    const ovoid_posed_shape alone = {b->body.shape, ovoid_pose_make_identity()};
    size_t count = compound ? ovoid_compound_get_part_count(compound) : 1;
    int done = 1;
    fputs("{\"name\":", file);
    page_write_text(file, b->name);
    fputs(",\"pose\":", file);
    page_write_pose(file, &b->body.pose);
    for (size_t i = 0; i < count && done; i++) {
        const ovoid_posed_shape part = compound ? ovoid_compound_get_part(compound, i) : alone;
        fputs(i ? "," : ",\"parts\":[", file);
        done = write_part(file, shapes, &part);
    }
    fputs(b->solid ? "],\"solid\":true}" : "]}", file);
    return done;
}

/// The text of all bodies, which is written after the shapes that it adds; NULL if memory runs out.
static char *make_bodies(page_shapes *shapes, const page_body *bodies, const page_choice *c, size_t *size) {
    char *text = NULL;
    const char *before = "";
    int done = 1;
    FILE *file = open_memstream(&text, size);
    if (!file) return NULL;
    for (size_t i = 0; i < c->object_count && done; i++) {
        if (c->numbers[i] == PAGE_NO_NUMBER) continue;
        fputs(before, file);
        done = write_body(file, shapes, &bodies[i]);
        before = ",";
    }
    if (fclose(file) == 0 && done) return text;
    free(text);
    return NULL;
}

int page_write_bodies(cli_page *page, const page_body *bodies, const page_choice *choice) {
    page_shapes shapes = {.items = NULL};
    size_t size = 0;
    int code = add_shapes(page, &shapes, bodies, choice);
    char *text = code ? NULL : make_bodies(&shapes, bodies, choice, &size);
    if (!code && !text) message_error("out of memory"), code = EXIT_INPUT;
    if (!code) code = page_shapes_write(&shapes, page->file);
    if (!code) {
        fputs(",\"bodies\":[", page->file);
        fwrite(text, 1, size, page->file);
        fputc(']', page->file);
    }
    free(text);
    page_shapes_clear(&shapes);
    return code;
}
