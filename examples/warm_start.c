// A body that moves past another: the proof of one frame starts the next query, and often answers it.
#include <ovoid/ovoid.h>

#include <stdio.h>

int main(void) {
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error);
    ovoid_shape *post = ovoid_shape_create_prism(&(ovoid_prism){0.5, 2, 31}, NULL, &error);
    if (!box || !post) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }

    ovoid_pair pair = {box, post, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    ovoid_answer answer = {.proof.kind = OVOID_PROOF_NONE};
    int by_proof = 0, touching = 0, wrong = 0;
    for (int frame = 0; frame <= 200; frame++) {
        pair.pose_b.position.x = -4 + 0.04 * frame;
        pair.pose_b.position.y = 0.5;
        answer = ovoid_collide(&pair, NULL, frame > 0 ? &answer.proof : NULL);
        by_proof += answer.stage == OVOID_STAGE_PROOF;
        touching += answer.status != OVOID_SEPARATED;
        // The post reaches the box when its axis is within 1.5 of the box's centre (a little later, since it is a
        // polygon).
        double gap = (pair.pose_b.position.x < 0 ? -pair.pose_b.position.x : pair.pose_b.position.x) - 1.5;
        wrong += (gap > 1e-9 && answer.status != OVOID_SEPARATED) || (gap < -0.01 && answer.status == OVOID_SEPARATED);
    }
    printf("201 frames: %d decided by the proof of the frame before, %d in contact\n", by_proof, touching);
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(post);
    return wrong || touching == 0 ? 1 : 0;
}
