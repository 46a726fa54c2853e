// Two of spheres, capsules and boxes, sharp and rounded, of sizes on a coarse grid of any scale, in poses that are
// often the same: all five questions, the exact judge is the abort. The same pair at its rotation matrices, off by
// roundings: the answer must be proven of the poses that the shapes get.
#include "ask.h"
#include "bodies.h"

static double take_size(fuzz_bytes *from, double scale) { return scale * (take_byte(from) & 15); }

static ovoid_shape *take_body(fuzz_bytes *from) {
    unsigned kind = (unsigned)take_byte(from);
    double scale = ldexp(1, take_byte(from) / 4), x = take_size(from, scale), y = take_size(from, scale);
    const ovoid_shape_options rounded = {.radius = kind & 4 ? take_size(from, scale) : 0};
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_shape *shape = kind % 4 == 0 ? ovoid_shape_create_sphere(x, NULL, &error)
                         : kind % 4 == 1
                             ? ovoid_shape_create_capsule(x, y, NULL, &error)
                             : ovoid_shape_create_box((ovoid_vec3){x, y, take_size(from, scale)}, &rounded, &error);
    if (!shape) fuzz_require_error(&error);
    return shape;
}

static void ask_at_matrices(const ovoid_pair *pair, fuzz_bytes *from) {
    ovoid_prepared_shape x[2];
    const ovoid_posed_shape bodies[2] = {{pair->shape_a, pair->pose_a}, {pair->shape_b, pair->pose_b}};
    for (int k = 0; k < 2; k++) {
        double m[9];
        ovoid_pose_compute_matrix(&bodies[k].pose, m);
        m[(unsigned)take_byte(from) % 9] += ldexp(take_byte(from), -55);
        if (ovoid_prepared_shape_make_matrix(bodies[k].shape, m, bodies[k].pose.position, &x[k]) != OVOID_OK) return;
    }
    const ovoid_pair moved = {pair->shape_a, pair->shape_b, x[0].body.pose, x[1].body.pose};
    ovoid_answer answer;
    ovoid_error error;
    (void)ovoid_prepared_distance((ovoid_prepared_pair){&x[0], &x[1]}, NULL, &(ovoid_evidence){.answer = &answer});
    fuzz_require_code(ovoid_answer_verify(&moved, &answer, NULL, &error), &error);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes from = {data, size};
    ovoid_shape *a = take_body(&from), *b = take_body(&from);
    if (a && b) {
        int is_wild = take_byte(&from) > 100;
        ovoid_pair pair = {a, b, take_any_pose(&from, is_wild), take_any_pose(&from, is_wild)};
        if (take_byte(&from) & 1) pair.pose_b.rotation = pair.pose_a.rotation;
        double margin = fabs(take_double(&from));
        fuzz_ask(&pair, isfinite(margin) ? margin : 0, NULL, NULL);
        ask_at_matrices(&pair, &from);
    }
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    return 0;
}
