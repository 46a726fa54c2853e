// A box that slides over a level floor of many triangles, in a world. Truth: closed form (four points at the depth of
// the box), and the manifolds of the pair alone, bit for bit.

#include "solids.h"
#include <ovoid/world_manifolds.h>

static double level(double x, double y) { return 0 * x * y; }
static ovoid_world_manifolds compute(ovoid_world *w, const ovoid_world_manifold_query *q) {
    ovoid_error error = {.message = ""};
    ovoid_world_manifolds found = {.count = 0};
    if (!CHECK_EQ(ovoid_world_compute_manifolds(w, q, &found, &error), OVOID_OK)) printf("  %s\n", error.message);
    return found;
}

static void test_slide(void) {
    const ovoid_pose here = {{0, 0, 0}, {1, 0, 0, 0}};
    uint64_t seed = check_seed = 5;
    const ground of = {20, 4, -1, level, 0.2};
    ovoid_solid *floor = ground_make(&of, &seed);
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){0.5, 0.6, 0.3}, NULL, NULL);
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_pose pose = {{-2, 0.1, 0.299}, {1, 0, 0, 0.2}};
    ovoid_world_body bodies[2] = {{.body = {.shape = box, .pose = pose}}, {.body = {.solid = floor, .pose = here}}};
    ovoid_id ids[2];
    CHECK(ovoid_world_add_many(w, &(ovoid_world_additions){bodies, 2, ids}, NULL) == OVOID_OK);
    ovoid_world_manifold_query q = {.options = {.margin = 0.01}};
    for (int f = 0; f < 40; f++) {
        ovoid_world_manifolds found = compute(w, &q);
        if (!CHECK_EQ(found.count, 1) || !CHECK_EQ(found.part_count, 1)) break;
        const ovoid_world_manifold *m = found.items;
        CHECK_EQ(m->verdict.status, OVOID_OVERLAPPING);
        CHECK_EQ(m->event, f ? OVOID_MANIFOLD_STAY : OVOID_MANIFOLD_BEGIN);
        CHECK_EQ(found.points[0].count, 4);
        const ovoid_body_pair pair = {{.shape = box, .pose = pose}, {.solid = floor, .pose = here}};
        ovoid_body_manifold alone[4];
        ovoid_body_manifolds room = {.items = alone, .capacity = 4};
        CHECK_EQ(ovoid_body_manifolds_find(&pair, &q.options, &room), OVOID_LIMIT_NONE);
        CHECK_EQ(room.count, 1);
        CHECK(memcmp(&alone[0], found.parts, sizeof *alone) == 0);
        CHECK_EQ(ovoid_body_manifold_verify(&pair, found.parts, &q.options, NULL), OVOID_OK);
        for (uint32_t i = 0; i < 4; i++) CHECK_NEAR(found.points[0].points[i].separation, -0.001, 1e-12);
        pose.position.x += 0.1;
        CHECK(ovoid_world_move(w, ids[0], &pose, NULL) == OVOID_OK);
    }
    ovoid_world_destroy(w);
    ovoid_shape_destroy(box);
    ovoid_solid_destroy(floor);
}

int main(void) {
    test_slide();
    return check_end();
}
