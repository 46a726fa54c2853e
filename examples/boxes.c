// The distance of two boxes, and a check of its proof.
#include <ovoid/ovoid.h>

#include <stdio.h>

int main(void) {
    ovoid_error error;
    ovoid_shape *cube = ovoid_shape_create_box((ovoid_vec3){0.5, 0.5, 0.5}, NULL, &error);
    if (!cube) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }

    // Two unit cubes, the second turned by 45 degrees about z: (w, x, y, z) need not be normalised.
    ovoid_pair pair = {cube, cube, ovoid_pose_make_identity(),
                       ovoid_pose_make_rpy((ovoid_vec3){2, 0, 0}, (ovoid_vec3){0, 0, 0.785398})};
    ovoid_answer answer = ovoid_distance(&pair, NULL, NULL);
    printf("%s, %.17g <= d <= %.17g\n", ovoid_status_get_name(answer.status), answer.lower, answer.upper);
    printf("from (%g, %g, %g) to (%g, %g, %g)\n", answer.point_a.x, answer.point_a.y, answer.point_a.z,
           answer.point_b.x, answer.point_b.y, answer.point_b.z);

    // The proof is data: it can be checked without trusting the search, here or by anyone else.
    ovoid_code code = ovoid_answer_verify(&pair, &answer, NULL, &error);
    printf("proof: %s\n", code == OVOID_OK ? "holds" : error.message);
    int right = code == OVOID_OK && answer.lower <= 0.79289323 && answer.upper >= 0.79289321;
    ovoid_shape_destroy(cube);
    return right ? 0 : 1;
}
