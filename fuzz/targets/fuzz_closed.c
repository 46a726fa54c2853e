// Two of spheres, capsules and boxes, sharp and rounded, of sizes on a coarse grid of any scale, in poses that are
// often the same: all five questions, the exact judge is the abort. The same pair at its rotation matrices, off by
// roundings: the answer must be proven of the poses that the shapes get. The same bodies as swept spheres, and
// cylinders, cones and ellipsoids beside them: their brackets and those of the shapes have a common point.
#include "ask.h"
#include "bodies.h"

static double take_size(fuzz_bytes *from, double scale) { return scale * (take_byte(from) & 15); }

// A body as a shape, and what a swept sphere needs of it but for its place.
typedef struct taken_body {
    ovoid_shape *shape; // NULL where it is refused
    ovoid_swept_sphere swept;
    int is_round; // a cylinder, a cone or an ellipsoid
} taken_body;

static ovoid_swept_core take_core(unsigned kind) {
    static const ovoid_swept_core closed[4] = {OVOID_SWEPT_POINT, OVOID_SWEPT_SEGMENT, OVOID_SWEPT_BOX,
                                               OVOID_SWEPT_BOX},
                                  round[3] = {OVOID_SWEPT_CYLINDER, OVOID_SWEPT_CONE, OVOID_SWEPT_ELLIPSOID};
    unsigned which = kind >> 3 & 7;
    return which > 4 ? round[which - 5] : closed[kind % 4];
}

static ovoid_shape *create_shape(const ovoid_swept_sphere *s, ovoid_error *error) {
    const ovoid_vec3 half = {s->half[0], s->half[1], s->half[2]};
    const ovoid_shape_options rounded = {.radius = s->radius}, coarse = {.tolerance = 0x1p-6 * half.y};
    switch (s->core) {
    case OVOID_SWEPT_POINT: return ovoid_shape_create_sphere(s->radius, NULL, error);
    case OVOID_SWEPT_SEGMENT: return ovoid_shape_create_capsule(s->radius, half.x, NULL, error);
    case OVOID_SWEPT_BOX: return ovoid_shape_create_box(half, &rounded, error);
    case OVOID_SWEPT_CYLINDER: return ovoid_shape_create_cylinder(half.y, half.x, &coarse, error);
    case OVOID_SWEPT_CONE: return ovoid_shape_create_cone(half.y, half.x, &coarse, error);
    default: return ovoid_shape_create_ellipsoid(half, NULL, error);
    }
}

static taken_body take_body(fuzz_bytes *from) {
    unsigned kind = (unsigned)take_byte(from);
    double scale = ldexp(1, take_byte(from) / 4), x = take_size(from, scale), y = take_size(from, scale);
    taken_body body = {.swept = {.core = take_core(kind), .half = {x, y, 0}}};
    ovoid_swept_sphere *s = &body.swept;
    body.is_round = s->core >= OVOID_SWEPT_CYLINDER && s->core != OVOID_SWEPT_BOX;
    if (s->core == OVOID_SWEPT_BOX && kind & 4) s->radius = take_size(from, scale);
    if (s->core == OVOID_SWEPT_BOX || s->core == OVOID_SWEPT_ELLIPSOID) s->half[2] = take_size(from, scale);
    if (s->core <= OVOID_SWEPT_SEGMENT) s->radius = x, s->half[0] = y;
    ovoid_error error = {OVOID_OK, -1, ""};
    body.shape = create_shape(s, &error);
    if (!body.shape) fuzz_require_error(&error);
    return body;
}

static void place_swept(const ovoid_pose *pose, ovoid_swept_sphere *s) {
    double m[9];
    ovoid_pose_compute_matrix(pose, m);
    s->center = pose->position;
    for (int k = 0; k < 3; k++) s->axis[k] = (ovoid_vec3){m[k], m[3 + k], m[6 + k]};
    if (s->core == OVOID_SWEPT_SEGMENT || s->core == OVOID_SWEPT_CYLINDER || s->core == OVOID_SWEPT_CONE)
        s->axis[0] = s->axis[2];
}

// ovoid/swept.h wants the lengths that a core has above zero.
static int has_lengths(const ovoid_swept_sphere *s) {
    static const int count[6] = {0, 1, 2, 3, 2, 3};
    int all = 1;
    for (int i = 0; i < count[s->core]; i++) all &= s->half[i] > 0;
    return all;
}

static int is_at_odds(const ovoid_verdict *v, const ovoid_answer *truth, double slack) {
    return v->status != OVOID_UNDECIDED && !(v->lower <= truth->upper + slack && truth->lower - slack <= v->upper);
}

// The axes are off by 36 roundings, which moves no point by more than 1e-14 of the lengths.
static void ask_swept(const ovoid_pair *pair, ovoid_swept_sphere *a, ovoid_swept_sphere *b) {
    const ovoid_answer depth = ovoid_depth(pair, NULL, NULL, NULL);
    if (depth.limit >= OVOID_LIMIT_POSE_A && depth.limit <= OVOID_LIMIT_SHAPE_B) return;
    place_swept(&pair->pose_a, a);
    place_swept(&pair->pose_b, b);
    if (!has_lengths(a) || !has_lengths(b)) return;
    double slack = 0;
    for (int i = 0; i < 3; i++) slack += 1e-14 * (a->half[i] + b->half[i]);
    slack += 1e-14 * (a->radius + b->radius + fabs(a->center.x - b->center.x) + fabs(a->center.y - b->center.y) +
                      fabs(a->center.z - b->center.z));
    const ovoid_swept_pair swept = {a, b};
    ovoid_witness witness;
    const ovoid_verdict found[4] = {ovoid_swept_collide(swept), ovoid_swept_depth(swept, &witness),
                                    ovoid_swept_distance(swept, &witness), ovoid_swept_contact(swept, &witness)};
    for (int i = 0; i < 4; i++)
        if (is_at_odds(&found[i], &depth, slack)) abort();
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
    taken_body a = take_body(&from), b = take_body(&from);
    if (a.shape && b.shape) {
        int is_wild = take_byte(&from) > 100;
        ovoid_pair pair = {a.shape, b.shape, take_any_pose(&from, is_wild), take_any_pose(&from, is_wild)};
        if (take_byte(&from) & 1) pair.pose_b.rotation = pair.pose_a.rotation;
        double margin = fabs(take_double(&from));
        if (!(a.is_round || b.is_round)) {
            fuzz_ask(&pair, isfinite(margin) ? margin : 0, NULL, NULL);
            ask_at_matrices(&pair, &from);
        }
        ask_swept(&pair, &a.swept, &b.swept);
    }
    ovoid_shape_destroy(a.shape);
    ovoid_shape_destroy(b.shape);
    return 0;
}
