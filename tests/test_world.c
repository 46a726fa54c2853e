// Worlds of bodies that come, move and go. Truth: the query of every pair alone (worlds.h), whose answers have proofs
// that other tests check; counts that follow from how the scene was made.
#include "countdown.h"
#include "worlds.h"

// ---- random lives

typedef struct life {
    ovoid_world *world;
    ovoid_shape **shapes;
    ovoid_compound *compound;
    ovoid_id ids[64];
    size_t count;
    double side, scale;
    uint64_t s;
} life;

static ovoid_world_body make_body(life *l) {
    ovoid_world_body b = {.solid = {.shape = l->shapes[random_next(&l->s) % WORLD_SHAPES]}};
    if (random_next(&l->s) % 8 == 0) b.solid = (ovoid_solid){.compound = l->compound};
    b.solid.pose = (ovoid_pose){random_place(&l->s, l->side), random_quat(&l->s)};
    if (random_next(&l->s) % 4 == 0) {
        b.group = 1u << random_next(&l->s) % 3;
        b.mask = (uint32_t)random_next(&l->s) % 7 + 1;
    }
    b.user = random_next(&l->s);
    return b;
}

static void add_body(life *l) {
    ovoid_world_body b = make_body(l);
    ovoid_id id = ovoid_world_add(l->world, &b, NULL);
    CHECK(id != 0);
    l->ids[l->count++] = id;
}

static void move_body(life *l, ovoid_id id) {
    ovoid_world_body b;
    CHECK(ovoid_world_get(l->world, id, &b, NULL) == OVOID_OK);
    ovoid_pose p = b.solid.pose;
    double step = random_next(&l->s) % 16 == 0 ? l->side : 0.02 * l->scale;
    ovoid_vec3 d = random_place(&l->s, step);
    p.position = (ovoid_vec3){p.position.x + d.x, p.position.y + d.y, p.position.z + d.z};
    if (random_next(&l->s) % 2) p.rotation.w += random_uniform(&l->s, -0.03, 0.03);
    CHECK(ovoid_world_move(l->world, id, &p, NULL) == OVOID_OK);
}

static void live(life *l) {
    for (size_t k = 0; k < l->count; k++)
        if (random_next(&l->s) % 3) move_body(l, l->ids[k]);
    if (l->count < 60 && random_next(&l->s) % 2) add_body(l);
    if (l->count > 5 && random_next(&l->s) % 3 == 0) {
        size_t k = random_next(&l->s) % l->count;
        CHECK(ovoid_world_remove(l->world, l->ids[k], NULL) == OVOID_OK);
        l->ids[k] = l->ids[--l->count];
    }
    if (l->count > 2 && random_next(&l->s) % 4 == 0) {
        ovoid_id a = l->ids[random_next(&l->s) % l->count], b = l->ids[random_next(&l->s) % l->count];
        if (a != b) CHECK(ovoid_world_set_ignored(l->world, a, b, random_next(&l->s) % 2, NULL) == OVOID_OK);
    }
}

static void test_life(uint64_t seed, double scale, ovoid_vec3 where, int frames) {
    check_seed = seed;
    ovoid_shape *shapes[WORLD_SHAPES];
    life l = {.world = ovoid_world_create(NULL, NULL), .shapes = shapes, .side = 4 * scale, .scale = scale, .s = seed};
    (void)where;
    world_make_shapes(&l.s, scale, shapes);
    l.compound = world_make_compound(&l.s, shapes, scale);
    for (int i = 0; i < 40; i++) add_body(&l);
    ovoid_frame_query q = {.question = (ovoid_question)(seed % 4), .margin = seed % 4 ? 0.3 * scale : 0};
    for (int f = 0; f < frames; f++) {
        if (f % 8 == 7) {
            q.question = (ovoid_question)(random_next(&l.s) % 4);
            q.margin = q.question ? random_uniform(&l.s, 0, 0.5) * scale : 0;
        }
        ovoid_frame frame;
        CHECK(ovoid_world_compute_frame(l.world, &q, &frame, NULL) == OVOID_OK);
        world_check_frame(l.world, &q, &frame);
        live(&l);
    }
    ovoid_world_destroy(l.world);
    ovoid_compound_destroy(l.compound);
    world_destroy_shapes(shapes);
}

int main(void) {
    const ovoid_vec3 here = {0, 0, 0};
    for (uint64_t seed = 1; seed <= 8; seed++) test_life(seed, 1, here, 24);
    test_life(9, 1e-9, here, 16);
    test_life(10, 1e9, here, 16);
    return check_end();
}
