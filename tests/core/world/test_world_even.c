// No frame is slow: bodies that set out together, each along a line, leave their boxes in all frames alike. What is
// counted is ovoid_contacts.moved, so the machine does not matter.
#include "worlds.h"

enum { BODIES = 3000, BEGIN = 12, FRAMES = 90 };

typedef struct swarm {
    ovoid_world *world;
    ovoid_id ids[BODIES];
    ovoid_pose poses[BODIES];
    ovoid_vec3 ways[BODIES];
} swarm;

static void make(swarm *x, const ovoid_shape *ball, double speed, uint64_t *s) {
    x->world = ovoid_world_create(NULL, NULL);
    for (int i = 0; i < BODIES; i++) {
        // Far apart, so that there are no pairs.
        x->poses[i] = (ovoid_pose){{100.0 * (i % 60), 100.0 * floor(i / 60.0), 0}, {1, 0, 0, 0}};
        ovoid_vec3 way = random_place(s, 1);
        double size = sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
        x->ways[i] = (ovoid_vec3){speed / size * way.x, speed / size * way.y, speed / size * way.z};
        ovoid_world_body b = {.body = {.shape = ball, .pose = x->poses[i]}};
        x->ids[i] = ovoid_world_add(x->world, &b, NULL);
        CHECK(x->ids[i] != 0);
    }
}

static size_t move(swarm *x) {
    ovoid_contact_query q = {.kind = OVOID_QUERY_COLLIDE};
    ovoid_contacts f;
    for (int i = 0; i < BODIES; i++) {
        ovoid_vec3 *p = &x->poses[i].position;
        *p = (ovoid_vec3){p->x + x->ways[i].x, p->y + x->ways[i].y, p->z + x->ways[i].z};
    }
    CHECK(ovoid_world_move_many(x->world, &(ovoid_world_moves){x->ids, x->poses, BODIES}, NULL) == OVOID_OK);
    CHECK(ovoid_world_compute_contacts(x->world, &q, &f, NULL) == OVOID_OK);
    return f.moved;
}

static void test_even(double speed) {
    static swarm x;
    uint64_t s = check_seed = (uint64_t)(speed * 1000);
    ovoid_shape *ball = ovoid_shape_create_sphere(1, NULL, NULL);
    make(&x, ball, speed, &s);
    size_t most = 0, sum = 0;
    for (int frame = 0; frame < FRAMES; frame++) {
        size_t moved = move(&x);
        if (frame < BEGIN) continue;
        most = moved > most ? moved : most;
        sum += moved;
    }
    double mean = (double)sum / (FRAMES - BEGIN);
    // Boxes last for twelve steps; a body of 3000 more or less is chance.
    CHECK_LE(BODIES / 20.0, mean);
    CHECK_LE(mean, BODIES / 9.0);
    CHECK_LE((double)most, 1.6 * mean);
    ovoid_world_destroy(x.world);
    ovoid_shape_destroy(ball);
}

int main(void) {
    test_even(0.02);
    test_even(0.03);
    return check_end();
}
