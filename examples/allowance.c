// How far is a scanned part, known to 0.1 mm, from a true cylinder? The bracket holds for every real part within its
// allowance, and for the true cylinder, not for the prism that approximates it.
#include <ovoid/ovoid.h>

#include <stdio.h>

int main(void) {
    ovoid_error error;
    const double scanned[] = {0, 0, 0, 0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1, 0.06, 0.06, 0.06};
    ovoid_shape_options options = {.allowance = {.outside = 1e-4, .inside = 1e-4}};
    ovoid_shape *part = ovoid_shape_create_from_points(scanned, 5, &options, &error);
    ovoid_shape *post =
        part ? ovoid_shape_create_cylinder(0.05, 0.5, &(ovoid_shape_options){.tolerance = 1e-5}, &error) : NULL;
    if (!post) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }

    // The part's nearest points lie on the plane x = 0; the post stands parallel to it, its axis 0.07 away.
    ovoid_pair pair = {post, part, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    pair.pose_b.position = (ovoid_vec3){0.07, 0, 0};
    ovoid_answer answer = ovoid_distance(&pair, NULL, NULL);
    ovoid_allowance width = ovoid_shape_get_allowance(post);
    printf("the post is held to %.3g m by %u corners\n", width.outside, ovoid_shape_get_polytope(post).vertex_count);
    printf("true distance: %.6f .. %.6f m; to be safe, %.6f\n", answer.lower, answer.upper,
           ovoid_answer_get_distance(&answer));
    int is_right = answer.lower <= 0.02 - 1e-4 && answer.upper >= 0.02 + 1e-4 && answer.upper - answer.lower < 2.2e-4;
    ovoid_shape_destroy(part);
    ovoid_shape_destroy(post);
    return is_right ? 0 : 1;
}
