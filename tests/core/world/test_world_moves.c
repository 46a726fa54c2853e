// Bodies that are moved together have the bits of bodies that are moved one by one: two worlds, the same motions, the
// contacts of each step compared bit for bit, adjusted bounds included, and which bodies got new boxes. Truth: a single
// body is moved without lanes (place_body in world/move.c).
#include "check.h"
#include "ovoid/ovoid.h"

#include <string.h>

enum { BODIES = 203, STEPS = 60, SHAPES = 5 };

static ovoid_world *together, *apart;
static ovoid_id ids[2][BODIES];
static ovoid_pose poses[BODIES];
static ovoid_vec3 drift[BODIES];
static ovoid_shape *shapes[SHAPES];

static int make_worlds(uint64_t *s) {
    ovoid_world_body list[BODIES];
    memset(list, 0, sizeof list);
    for (int i = 0; i < SHAPES; i++) {
        double xyz[3 * 10];
        for (int k = 0; k < 30; k++) xyz[k] = random_uniform(s, -1, 1);
        shapes[i] = ovoid_shape_create_from_points(xyz, 10, NULL, NULL);
        if (!CHECK(shapes[i] != NULL)) return 0;
    }
    for (int i = 0; i < BODIES; i++) {
        poses[i] =
            (ovoid_pose){{random_uniform(s, 0, 9), random_uniform(s, 0, 9), random_uniform(s, 0, 9)}, {1, 0, 0, 0}};
        drift[i] = (ovoid_vec3){random_uniform(s, -0.05, 0.05), random_uniform(s, -0.05, 0.05), 0};
        list[i].body = (ovoid_body){.shape = shapes[i % SHAPES], .pose = poses[i]};
    }
    together = ovoid_world_create(NULL, NULL);
    apart = ovoid_world_create(NULL, NULL);
    return CHECK(together && apart) &&
           CHECK_EQ(ovoid_world_add_many(together, &(ovoid_world_additions){list, BODIES, ids[0]}, NULL), OVOID_OK) &&
           CHECK_EQ(ovoid_world_add_many(apart, &(ovoid_world_additions){list, BODIES, ids[1]}, NULL), OVOID_OK);
}

// Most bodies move and turn; some stay, some jump, and some quaternions have another length.
static void move(uint64_t *s) {
    for (int i = 0; i < BODIES; i++) {
        ovoid_pose *p = &poses[i];
        if (random_next(s) % 8 == 0) continue;
        p->position = (ovoid_vec3){p->position.x + drift[i].x, p->position.y + drift[i].y, p->position.z};
        if (random_next(s) % 100 == 0) p->position.z = random_uniform(s, 0, 9);
        double a = random_uniform(s, 0, 0.02);
        ovoid_quat q = p->rotation;
        p->rotation = (ovoid_quat){q.w - a * q.x, q.x + a * q.w, q.y + a * q.z, q.z - a * q.y};
        if (random_next(s) % 8 == 0) continue;
        ovoid_quat r = p->rotation;
        double n = 1 / sqrt((r.w * r.w + r.x * r.x) + (r.y * r.y + r.z * r.z));
        p->rotation = (ovoid_quat){r.w * n, r.x * n, r.y * n, r.z * n};
    }
}

int main(void) {
    uint64_t s = 5, adjusted = 0, moved = 0;
    if (!make_worlds(&s)) return check_end();
    const ovoid_contact_query query = {.kind = OVOID_QUERY_WITHIN, .margin = 0.3};
    for (int step = 0; step < STEPS; step++) {
        check_seed = (uint64_t)step;
        move(&s);
        // Also a batch that begins elsewhere and is no multiple of eight.
        size_t first = random_next(&s) % 20;
        CHECK_EQ(
            ovoid_world_move_many(together, &(ovoid_world_moves){ids[0] + first, poses + first, BODIES - first}, NULL),
            OVOID_OK);
        CHECK_EQ(ovoid_world_move_many(together, &(ovoid_world_moves){ids[0], poses, first}, NULL), OVOID_OK);
        for (size_t i = first; i < BODIES; i++) CHECK_EQ(ovoid_world_move(apart, ids[1][i], &poses[i], NULL), OVOID_OK);
        for (size_t i = 0; i < first; i++) CHECK_EQ(ovoid_world_move(apart, ids[1][i], &poses[i], NULL), OVOID_OK);
        ovoid_contacts a, b;
        CHECK_EQ(ovoid_world_compute_contacts(together, &query, &a, NULL), OVOID_OK);
        CHECK_EQ(ovoid_world_compute_contacts(apart, &query, &b, NULL), OVOID_OK);
        CHECK_EQ(a.moved, b.moved);
        CHECK_EQ(a.queried, b.queried);
        if (!CHECK_EQ(a.count, b.count)) break;
        CHECK(memcmp(a.items, b.items, a.count * sizeof *a.items) == 0);
        for (size_t i = 0; i < a.count; i++) adjusted += a.items[i].verdict.iterations == 0;
        moved += a.moved;
    }
    CHECK(adjusted > 1000 && moved > 300);
    ovoid_world_destroy(together);
    ovoid_world_destroy(apart);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
