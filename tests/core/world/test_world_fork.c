// A world with threads in a child made by fork, where none of its threads is left: it works on in the child's one
// thread, with the same bits, and can be destroyed there; a new world has threads of its own; the parent's goes on.
// Truth: the hash of what a world of one thread says. Before, the child waited for ever for threads that it did not
// have.
#include "worlds.h"

#include <sys/wait.h>
#include <unistd.h>

enum { BODIES = 1500 };

static ovoid_shape *shapes[WORLD_SHAPES];

static uint64_t add(uint64_t hash, const void *data, size_t size) {
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++) hash = (hash ^ bytes[i]) * 1099511628211u;
    return hash;
}

static ovoid_world *make(uint32_t threads) {
    static ovoid_id ids[BODIES];
    static ovoid_world_body bodies[BODIES];
    uint64_t s = 29;
    ovoid_world_options options = {.threads = threads};
    ovoid_world *world = ovoid_world_create(&options, NULL);
    for (int i = 0; i < BODIES; i++)
        bodies[i].body = (ovoid_body){.shape = shapes[random_next(&s) % WORLD_SHAPES],
                                      .pose = {random_place(&s, 12), random_quat(&s)}};
    CHECK(world && ovoid_world_add_many(world, &(ovoid_world_additions){bodies, BODIES, ids}, NULL) == OVOID_OK);
    return world;
}

/// The contacts at a margin, all boxes moved by it, as a hash; 0 where the world fails.
static uint64_t step(ovoid_world *world, double margin) {
    ovoid_contact_query query = {.kind = OVOID_QUERY_DISTANCE, .margin = margin};
    ovoid_contacts found;
    if (ovoid_world_compute_contacts(world, &query, &found, NULL) != OVOID_OK || found.count < 100) return 0;
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < found.count; i++) hash = add(hash, &found.items[i], sizeof found.items[i]);
    return hash;
}

int main(void) {
    static const double margins[3] = {0.1, 0.4, 0.2};
    uint64_t s = 3, truth[3];
    world_make_shapes(&s, 1, shapes);
    ovoid_world *one = make(1), *many = make(4);
    for (int i = 0; i < 3; i++) CHECK((truth[i] = step(one, margins[i])) != 0);
    CHECK(step(many, margins[0]) == truth[0]);
    pid_t child = fork();
    if (child == 0) {
        int same = step(many, margins[1]) == truth[1] && step(many, margins[2]) == truth[2];
        ovoid_world_destroy(many);
        ovoid_world *fresh = make(4);
        same &= step(fresh, margins[0]) == truth[0];
        ovoid_world_destroy(fresh);
        _exit(same ? 0 : 1);
    }
    int status = 1;
    CHECK(child > 0 && waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    CHECK(step(many, margins[1]) == truth[1]);
    CHECK(step(many, margins[2]) == truth[2]);
    ovoid_world_destroy(many);
    ovoid_world_destroy(one);
    world_destroy_shapes(shapes);
    return check_end();
}
