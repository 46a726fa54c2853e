// How far apart are two mesh files? Loads convex meshes (libovoid_io), poses the second, prints the distance
// and the nearest points, and checks the proof. Two files of one's own: mesh_distance A B
#include <ovoid/io.h>
#include <ovoid/ovoid.h>

#include <stdio.h>

// Millimetres in the files, metres here: ovoid_unit_get_scale("mm", "m") is 0.001.
static ovoid_shape *load(const char *path) {
    ovoid_error error;
    ovoid_read_options read = {.scale = ovoid_unit_get_scale("mm", "m")};
    ovoid_shape *shape = ovoid_shape_read_file(path, &read, NULL, &error);
    if (!shape) fprintf(stderr, "%s\n", error.message); // the message says what is wrong, where, and what to do
    return shape;
}

int main(int count, char **arguments) {
    ovoid_shape *a = load(count > 1 ? arguments[1] : "cube.off");
    ovoid_shape *b = load(count > 2 ? arguments[2] : "tetra.obj");
    int code = 1;
    if (a && b) {
        ovoid_pose aside = ovoid_pose_make_rpy((ovoid_vec3){0.003, 0, 0}, (ovoid_vec3){0, 0, 0.5});
        ovoid_pair pair = {a, b, ovoid_pose_make_identity(), aside};
        static char memory[OVOID_COVER_SIZE];
        ovoid_cover cover = {.memory = memory, .size = sizeof memory}; // the proof of a depth, if they overlap
        ovoid_answer answer = ovoid_depth(&pair, NULL, NULL, &cover);
        ovoid_vec3 p = answer.point_a, q = answer.point_b;
        printf("%s, distance %.9g m\n", ovoid_status_get_name(answer.status), ovoid_answer_get_distance(&answer));
        printf("from %.6g %.6g %.6g to %.6g %.6g %.6g\n", p.x, p.y, p.z, q.x, q.y, q.z);
        code = ovoid_answer_verify(&pair, &answer, &(ovoid_answer_basis){.cover = &cover}, NULL) != OVOID_OK;
    }
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    return code;
}
