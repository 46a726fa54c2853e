// Worlds of bodies that come, move and go. Truth: the query of every pair alone (worlds.h), whose answers have proofs
// that other tests check; counts that follow from how the scene was made.
#include "world_life.h"

static void test_life(uint64_t seed, double scale, int frames) {
    check_seed = seed;
    ovoid_shape *shapes[WORLD_SHAPES];
    life l;
    life_begin(&l, seed, scale, shapes);
    ovoid_contact_query q = {.kind = (ovoid_query_kind)(seed % 4), .margin = seed % 4 ? 0.3 * scale : 0};
    for (int f = 0; f < frames; f++) {
        life_frame(&l, &q);
        life_step(&l);
    }
    life_end(&l);
}

static const ovoid_pose here = {{0, 0, 0}, {1, 0, 0, 0}};

// Boxes in a lattice of their own size: each touches 26 others exactly, which no rounding may hide.
static void test_lattice(void) {
    check_seed = 0;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){0.5, 0.5, 0.5}, NULL, NULL);
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    size_t expected = 0;
    for (int x = 0; x < 5; x++)
        for (int y = 0; y < 5; y++)
            for (int z = 0; z < 5; z++) {
                ovoid_world_body b = {.body = {.shape = box, .pose = here}};
                b.body.pose.position = (ovoid_vec3){x, y, z};
                CHECK(ovoid_world_add(w, &b, NULL) != 0);
            }
    // Pairs of neighbours along 13 directions.
    for (int d = 0; d < 27; d++) {
        int dx = d / 9 - 1, dy = d / 3 % 3 - 1, dz = d % 3 - 1;
        if (d > 13) expected += (size_t)((5 - abs(dx)) * (5 - abs(dy)) * (5 - abs(dz)));
    }
    for (int f = 0; f < 2; f++) {
        ovoid_contacts frame;
        ovoid_contact_query q = {.kind = OVOID_QUERY_COLLIDE};
        CHECK(ovoid_world_compute_contacts(w, &q, &frame, NULL) == OVOID_OK);
        CHECK_EQ(frame.count, expected);
        for (size_t i = 0; i < frame.count; i++) CHECK_EQ(frame.items[i].verdict.status, OVOID_TOUCHING);
        // Where nothing moves nothing is asked.
        CHECK_EQ(frame.queried, f ? 0 : frame.pairs);
    }
    ovoid_world_destroy(w);
    ovoid_shape_destroy(box);
}

// All bodies at one place, of one pose: every pair overlaps.
static void test_one_place(void) {
    ovoid_shape *shapes[WORLD_SHAPES];
    uint64_t s = 4;
    world_make_shapes(&s, 1, shapes);
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    static ovoid_world_body bodies[300];
    for (int i = 0; i < 300; i++) bodies[i] = (ovoid_world_body){.body = {.shape = shapes[i % 3], .pose = here}};
    CHECK(ovoid_world_add_many(w, &(ovoid_world_additions){bodies, 300, NULL}, NULL) == OVOID_OK);
    ovoid_contacts frame;
    ovoid_contact_query q = {.kind = OVOID_QUERY_COLLIDE};
    CHECK(ovoid_world_compute_contacts(w, &q, &frame, NULL) == OVOID_OK);
    CHECK_EQ(frame.count, 300 * 299 / 2);
    for (size_t i = 0; i < frame.count; i++) CHECK_EQ(frame.items[i].verdict.status, OVOID_OVERLAPPING);
    ovoid_world_destroy(w);
    world_destroy_shapes(shapes);
}

// Spheres on a line, one after another 1 apart, each of radius 0.5 + 1e-9: each overlaps the next; then all are spread
// out.
static void test_many(void) {
    enum { MANY = 100000 };
    ovoid_shape *ball = ovoid_shape_create_sphere(0.5 + 1e-9, NULL, NULL);
    ovoid_world *w = ovoid_world_create(&(ovoid_world_options){.threads = 2}, NULL);
    ovoid_world_body *bodies = calloc(MANY, sizeof *bodies);
    ovoid_pose *poses = calloc(MANY, sizeof *poses);
    ovoid_id *ids = calloc(MANY, sizeof *ids);
    for (int i = 0; i < MANY; i++) {
        // In an order that is not that of the line.
        poses[i] = (ovoid_pose){{(double)((uint64_t)i * 7919 % MANY), 0, 0}, {1, 0, 0, 0}};
        bodies[i].body = (ovoid_body){.shape = ball, .pose = poses[i]};
    }
    CHECK(ovoid_world_add_many(w, &(ovoid_world_additions){bodies, MANY, ids}, NULL) == OVOID_OK);
    ovoid_contacts f;
    ovoid_contact_query q = {.kind = OVOID_QUERY_COLLIDE};
    CHECK(ovoid_world_compute_contacts(w, &q, &f, NULL) == OVOID_OK);
    CHECK_EQ(f.count, MANY - 1);
    for (size_t i = 1; i < f.count; i++)
        if (f.items[i - 1].a > f.items[i].a || (f.items[i - 1].a == f.items[i].a && f.items[i - 1].b >= f.items[i].b))
            CHECK(!"sorted");
    for (int i = 0; i < MANY; i++) poses[i].position.x *= 1.25;
    CHECK(ovoid_world_move_many(w, &(ovoid_world_moves){ids, poses, MANY}, NULL) == OVOID_OK);
    CHECK(ovoid_world_compute_contacts(w, &q, &f, NULL) == OVOID_OK);
    CHECK_EQ(f.count, 0);
    CHECK_EQ(f.bodies, MANY);
    CHECK(ovoid_world_remove_many(w, ids, MANY / 2, NULL) == OVOID_OK);
    CHECK(ovoid_world_compute_contacts(w, &q, &f, NULL) == OVOID_OK);
    CHECK_EQ(ovoid_world_get_count(w), MANY / 2);
    ovoid_world_destroy(w);
    ovoid_shape_destroy(ball);
    free(bodies);
    free(poses);
    free(ids);
}

int main(void) {
    for (uint64_t seed = 1; seed <= 8; seed++) test_life(seed, 1, 24);
    test_life(9, 1e-9, 16);
    test_life(10, 1e9, 16);
    test_lattice();
    test_one_place();
    test_many();
    return check_end();
}
