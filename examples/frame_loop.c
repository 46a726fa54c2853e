// A frame loop: a block of boxes that sink at different speeds, every pair's proof kept from frame to frame.
#include <ovoid/ovoid.h>

#include <stdio.h>

enum { BODIES = 1000, FRAMES = 60 };

int main(void) {
    static ovoid_world_body bodies[BODIES];
    static ovoid_id ids[BODIES];
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){0.5, 0.4, 0.3}, NULL, &error);
    ovoid_world *world = ovoid_world_create(&(ovoid_world_options){.threads = 2}, &error);
    if (!box || !world) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    for (int i = 0; i < BODIES; i++) {
        bodies[i].body.shape = box;
        int x = i % 10, y = i / 10 % 10, z = i / 100;
        bodies[i].body.pose = (ovoid_pose){{x, y, z}, {1, 0.1 * (i % 7), 0.2, 0}};
    }
    if (ovoid_world_add_many(world, &(ovoid_world_additions){bodies, BODIES, ids}, &error) != OVOID_OK) return 1;

    size_t aged = 0, queried = 0, wrong = 0;
    for (int f = 0; f < FRAMES; f++) {
        ovoid_contact_query query = {.kind = OVOID_QUERY_COLLIDE};
        ovoid_contacts frame;
        if (ovoid_world_compute_contacts(world, &query, &frame, &error) != OVOID_OK) return 1;
        aged += frame.aged;
        queried += frame.queried;
        // Computes the whole answer of a contact, with its proof, if it is wanted.
        if (frame.count) {
            ovoid_contact_proof proof = {.exclusions = NULL};
            ovoid_world_body a, b;
            ovoid_world_compute_proof(world, &frame.items[0], &proof, NULL);
            ovoid_world_get(world, frame.items[0].a, &a, NULL);
            ovoid_world_get(world, frame.items[0].b, &b, NULL);
            ovoid_pair pair = {a.body.shape, b.body.shape, a.body.pose, b.body.pose};
            wrong += ovoid_answer_verify(&pair, &proof.answer.deciding, NULL, NULL) != OVOID_OK;
        }
        for (int i = 0; i < BODIES; i++) {
            ovoid_pose *pose = &bodies[i].body.pose;
            pose->position.z -= 0.002 * (i % 5);
            if (ovoid_world_move(world, ids[i], pose, &error) != OVOID_OK) return 1;
        }
    }
    printf("%d frames: %zu pairs answered by earlier proofs, %zu asked anew\n", FRAMES, aged, queried);
    ovoid_world_destroy(world);
    ovoid_shape_destroy(box);
    return wrong || aged < queried;
}
