// A body is moved to a wanted clearance: Newton steps on the smooth bracket's outer value, along its gradient, and the
// exact distance beside it at each step.
#include <ovoid/ovoid.h>

#include <math.h>
#include <stdio.h>

int main(void) {
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 0.6, 0.3}, NULL, &error);
    ovoid_shape *capsule = ovoid_shape_create_capsule(0.2, 0.8, NULL, &error);
    if (!box || !capsule) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }

    const double clearance = 0.5;
    ovoid_pair pair = {box, capsule, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    pair.pose_b = ovoid_pose_make_rpy((ovoid_vec3){0.9, 0.8, 0.7}, (ovoid_vec3){0.3, 1.1, 0.2});
    double off = 1;
    int wrong = 0;
    for (int step = 0; step < 8 && fabs(off) > 1e-12; step++) {
        ovoid_smooth s = ovoid_pair_compute_smooth(&pair, 1);
        ovoid_answer exact = ovoid_depth(&pair, NULL, NULL, NULL);
        ovoid_gradient g = ovoid_answer_compute_gradient(&pair, &exact, NULL);
        printf("%.6f <= %.6f <= %.6f, exact normal %.3f %.3f %.3f\n", s.outer.value, exact.lower, s.inner.value,
               g.gradient[6], g.gradient[7], g.gradient[8]);
        wrong += s.outer.value > exact.upper || s.inner.value < exact.lower || !s.outer.is_smooth;

        // The capsule's translation: the shortest change that makes the linearised outer value the clearance.
        off = clearance - s.outer.value;
        pair.pose_b.position.x += off * s.outer.gradient[6];
        pair.pose_b.position.y += off * s.outer.gradient[7];
        pair.pose_b.position.z += off * s.outer.gradient[8];
    }

    ovoid_answer last = ovoid_distance(&pair, NULL, NULL);
    printf("outer value %.12f, so the bodies are at least that far apart; they are %.6f\n", clearance, last.upper);
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(capsule);
    return wrong || fabs(off) > 1e-12 || last.lower < clearance - 1e-12 ? 1 : 0;
}
