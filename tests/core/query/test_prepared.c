// Prepared shapes answer with the bits of the queries of the pair itself: verdict, proof, points and whole answer, cold
// and with an earlier proof, whatever evidence is asked for. Truth: ovoid_collide and its sisters. Bodies: 4 to 82
// vertices, rounded, with an allowance, flat, far from their frame's origin; gaps from deep to far; quaternions of any
// length. Poses and shapes that are refused there are refused here.
//
// Shapes prepared at a rotation matrix: the answer is proven by ovoid_answer_verify of the pose that the shape has, and
// its bracket is that of the query of that pose to 2^-40 of the size, with all evidence, the points alone, or none.
#include "check.h"
#include "ovoid/ovoid.h"

enum { SHAPES = 40, PAIRS = 30000, QUESTIONS = 4 };

static ovoid_shape *shapes[SHAPES];

static int make_shapes(uint64_t *s) {
    for (int i = 0; i < SHAPES; i++) {
        double xyz[3 * (2 * SHAPES + 4)];
        size_t count = 4 + (size_t)i * 2;
        ovoid_vec3 at = i % 10 == 9 ? (ovoid_vec3){1e9, -3e8, 7} : (ovoid_vec3){0, 0, 0};
        for (size_t k = 0; k < count; k++) {
            xyz[3 * k] = at.x + random_uniform(s, -1, 1);
            xyz[3 * k + 1] = at.y + random_uniform(s, -1, 1);
            xyz[3 * k + 2] = at.z + (i % 10 == 8 ? 0 : random_uniform(s, -1, 1));
        }
        ovoid_shape_options o = {.radius = i % 4 == 3 ? 0.1 : 0};
        if (i % 10 == 7) o.allowance = (ovoid_allowance){.outside = 1e-3, .inside = 2e-3};
        shapes[i] = ovoid_shape_create_from_points(xyz, count, &o, NULL);
        if (!CHECK(shapes[i] != NULL)) return 0;
    }
    return 1;
}

static ovoid_pose draw_pose(uint64_t *s, const ovoid_shape *shape, double far) {
    double scale = random_next(s) % 8 ? 1 : 1e-7;
    ovoid_pose p = {
        {far * random_normal(s), far * random_normal(s), far * random_normal(s)},
        {scale * random_normal(s), scale * random_normal(s), scale * random_normal(s), scale * random_normal(s)}};
    // So that the body, not its frame's origin, is there.
    ovoid_vec3 c = ovoid_shape_get_measures(shape).box.min;
    ovoid_vec3 moved = ovoid_pose_compute_point(&p, c);
    p.position.x += p.position.x - moved.x;
    p.position.y += p.position.y - moved.y;
    p.position.z += p.position.z - moved.z;
    return p;
}

static ovoid_answer ask(int question, const ovoid_pair *p, double margin, const ovoid_options *o,
                        const ovoid_proof *earlier) {
    switch (question) {
    case 0: return ovoid_collide(p, o, earlier);
    case 1: return ovoid_within(p, margin, o, earlier);
    case 2: return ovoid_distance(p, o, earlier);
    default: return ovoid_depth(p, o, earlier, NULL);
    }
}

static ovoid_verdict ask_prepared(int question, const ovoid_prepared_shape *x, double margin, const ovoid_options *o,
                                  const ovoid_evidence *e) {
    switch (question) {
    case 0: return ovoid_prepared_collide((ovoid_prepared_pair){x, x + 1}, o, e);
    case 1: return ovoid_prepared_within((ovoid_prepared_pair){x, x + 1}, margin, o, e);
    case 2: return ovoid_prepared_distance((ovoid_prepared_pair){x, x + 1}, o, e);
    default: return ovoid_prepared_depth((ovoid_prepared_pair){x, x + 1}, o, e);
    }
}

static int is_same(const void *a, const void *b, size_t size) { return memcmp(a, b, size) == 0; }

static int is_verdict(const ovoid_verdict *v, const ovoid_answer *x) {
    return v->status == x->status && v->stage == x->stage && v->limit == x->limit && v->iterations == x->iterations &&
           is_same(&v->lower, &x->lower, sizeof v->lower) && is_same(&v->upper, &x->upper, sizeof v->upper);
}

static int is_witness(const ovoid_witness *w, const ovoid_answer *x) {
    return is_same(&w->point_a, &x->point_a, sizeof w->point_a) &&
           is_same(&w->point_b, &x->point_b, sizeof w->point_b) && is_same(&w->normal, &x->normal, sizeof w->normal);
}

static void compare(int question, const ovoid_pair *p, double margin, const ovoid_options *o) {
    ovoid_prepared_shape x[2];
    ovoid_prepared_shape_make(&(ovoid_posed_shape){p->shape_a, p->pose_a}, &x[0]);
    ovoid_prepared_shape_make(&(ovoid_posed_shape){p->shape_b, p->pose_b}, &x[1]);
    ovoid_answer cold = ask(question, p, margin, o, NULL), warm = ask(question, p, margin, o, &cold.proof);
    ovoid_verdict alone = ask_prepared(question, x, margin, o, NULL);
    CHECK(is_verdict(&alone, &cold));
    CHECK_EQ(ovoid_verdict_is_within(&alone, margin), ovoid_answer_is_within(&cold, margin));
    ovoid_proof proof = {0};
    ovoid_witness points;
    ovoid_answer whole;
    ovoid_evidence e = {.witness = &points};
    ovoid_verdict v = ask_prepared(question, x, margin, o, &e);
    CHECK(is_verdict(&v, &cold) && is_witness(&points, &cold));
    e = (ovoid_evidence){&proof, NULL, &whole};
    v = ask_prepared(question, x, margin, o, &e);
    CHECK(is_verdict(&v, &cold) && is_verdict(&v, &whole) &&
          is_witness(&(ovoid_witness){whole.point_a, whole.point_b, whole.normal}, &cold));
    CHECK(is_same(&proof.normal, &cold.proof.normal, sizeof proof.normal) && proof.kind == cold.proof.kind);
    e.answer = NULL;
    v = ask_prepared(question, x, margin, o, &e);
    CHECK(is_verdict(&v, &warm));
    CHECK(is_same(&proof.normal, &warm.proof.normal, sizeof proof.normal) && proof.count == warm.proof.count);
}

static void compare_random(uint64_t *s) {
    static const double reach[5] = {0.2, 0.5, 1, 2, 8};
    for (int i = 0; i < PAIRS; i++) {
        check_seed = (uint64_t)i;
        const ovoid_shape *a = shapes[random_next(s) % SHAPES], *b = shapes[random_next(s) % SHAPES];
        ovoid_pair p = {a, b, draw_pose(s, a, 0), draw_pose(s, b, reach[i % 5])};
        ovoid_options o = {.relative_tolerance = 1e-6, .cap = i % 7 == 0 ? 0.5 : 0};
        compare(i % QUESTIONS, &p, 0.3, i % 3 ? NULL : &o);
    }
}

// ---- by matrices

enum { ROUND_SHAPES = 4, MATRIX_PAIRS = 20000 };

static void make_round_shapes(ovoid_shape *of[ROUND_SHAPES]) {
    of[0] = ovoid_shape_create_sphere(0.5, NULL, NULL);
    of[1] = ovoid_shape_create_capsule(0.3, 0.4, NULL, NULL);
    of[2] = ovoid_shape_create_box((ovoid_vec3){0.45, 0.4, 0.35}, NULL, NULL);
    of[3] = ovoid_shape_create_cylinder(0.4, 0.45, NULL, NULL);
}

static const ovoid_shape *draw_shape(uint64_t *s, ovoid_shape *of[ROUND_SHAPES]) {
    return random_next(s) % 2 ? of[random_next(s) % ROUND_SHAPES] : shapes[random_next(s) % SHAPES];
}

// A rotation, or one that is off by roundings of many products, or by more, up to what a pose takes.
static void draw_matrix(uint64_t *s, const ovoid_pose *pose, double m[9]) {
    static const double noise[4] = {0, 2e-16, 1e-13, 1e-9};
    double size = noise[random_next(s) % 4];
    ovoid_pose_compute_matrix(pose, m);
    for (int i = 0; i < 9; i++) m[i] += size * random_uniform(s, -1, 1);
}

static ovoid_prepared_shape prepare_by_matrix(const ovoid_shape *shape, const ovoid_pose *pose, const double *m) {
    ovoid_prepared_shape x;
    CHECK_EQ(ovoid_prepared_shape_make_matrix(shape, m, pose->position, &x), OVOID_OK);
    double back[9];
    ovoid_pose_compute_matrix(&x.body.pose, back);
    for (int i = 0; i < 9; i++) CHECK(fabs(back[i] - m[i]) < 3e-9);
    CHECK(is_same(&x.body.pose.position, &pose->position, sizeof pose->position) && x.body.shape == shape);
    return x;
}

static void compare_matrices(int question, const ovoid_prepared_shape *x, double size) {
    ovoid_pair p = {x[0].body.shape, x[1].body.shape, x[0].body.pose, x[1].body.pose};
    ovoid_answer cold = ask(question, &p, 0.3, NULL, NULL), whole;
    ovoid_proof proof = {0};
    ovoid_witness points;
    ovoid_verdict alone = ask_prepared(question, x, 0.3, NULL, NULL);
    ovoid_verdict at = ask_prepared(question, x, 0.3, NULL, &(ovoid_evidence){.witness = &points});
    ovoid_verdict v = ask_prepared(question, x, 0.3, NULL, &(ovoid_evidence){&proof, NULL, &whole});
    CHECK(is_verdict(&v, &whole) && is_verdict(&alone, &whole) && is_verdict(&at, &whole));
    CHECK(is_witness(&points, &whole));
    CHECK(proof.kind == whole.proof.kind && is_same(&proof.normal, &whole.proof.normal, sizeof proof.normal));
    ovoid_error error = {0};
    // A depth is verified by its cover, which these queries do not write.
    if (question < 3 || whole.lower > 0) CHECK_EQ(ovoid_answer_verify(&p, &whole, NULL, &error), OVOID_OK);
    CHECK_EQ(whole.status, cold.status);
    double off = 0x1p-40 * size;
    CHECK(whole.lower <= cold.upper + off && cold.lower <= whole.upper + off);
    if (whole.limit == OVOID_LIMIT_NONE && cold.limit == OVOID_LIMIT_NONE)
        CHECK(fabs(whole.lower - cold.lower) <= 1.1e-9 * size && fabs(whole.upper - cold.upper) <= 1.1e-9 * size);
}

static void compare_by_matrices(uint64_t *s) {
    ovoid_shape *of[ROUND_SHAPES];
    make_round_shapes(of);
    for (int i = 0; i < MATRIX_PAIRS; i++) {
        check_seed = (uint64_t)i;
        const ovoid_shape *a = draw_shape(s, of), *b = draw_shape(s, of);
        ovoid_pose pose[2] = {draw_pose(s, a, 1), draw_pose(s, b, 1)};
        double m[2][9];
        ovoid_prepared_shape x[2];
        for (int k = 0; k < 2; k++) draw_matrix(s, &pose[k], m[k]);
        x[0] = prepare_by_matrix(a, &pose[0], m[0]);
        x[1] = prepare_by_matrix(b, &pose[1], m[1]);
        ovoid_vec3 p = pose[0].position, q = pose[1].position;
        double far = fabs(p.x) + fabs(p.y) + fabs(p.z) + fabs(q.x) + fabs(q.y) + fabs(q.z);
        compare_matrices(i % QUESTIONS, x, 10 + 2 * far);
    }
    for (int i = 0; i < ROUND_SHAPES; i++) ovoid_shape_destroy(of[i]);
}

// A matrix that is used as it is, for the shapes that are queried most: no other path gives its entries back.
static void keep_matrix(void) {
    ovoid_pose pose = {{1, 2, 3}, {0.3, -0.2, 0.9, 0.4}};
    double m[9];
    ovoid_pose_compute_matrix(&pose, m);
    ovoid_prepared_shape x = prepare_by_matrix(shapes[0], &pose, m), y;
    CHECK(x.is_ready == 3 && is_same(x.rotation, m, sizeof m));
    for (int i = 0; i < 9; i++) m[i] += i == 4 ? 1e-12 : 0;
    x = prepare_by_matrix(shapes[0], &pose, m);
    CHECK(x.is_ready == 1 && !is_same(x.rotation, m, sizeof m));
    CHECK_EQ(ovoid_prepared_shape_make_matrix(shapes[0], NULL, pose.position, &x), OVOID_OK);
    ovoid_prepared_shape_make(&(ovoid_posed_shape){shapes[0], {pose.position, {1, 0, 0, 0}}}, &y);
    CHECK(is_same(&x.body, &y.body, sizeof x.body) && is_same(x.rotation, y.rotation, sizeof x.rotation));
    CHECK(is_same(&x.center, &y.center, sizeof x.center) && is_same(&x.first, &y.first, sizeof x.first));
}

static void refuse_matrix(const double *m, ovoid_vec3 at, ovoid_code code) {
    ovoid_prepared_shape x[2];
    CHECK_EQ(ovoid_prepared_shape_make_matrix(shapes[0], m, at, &x[0]), code);
    ovoid_prepared_shape_make(&(ovoid_posed_shape){shapes[1], {{0, 0, 0}, {1, 0, 0, 0}}}, &x[1]);
    for (int question = 0; question < QUESTIONS; question++)
        CHECK_EQ(ask_prepared(question, x, 0.3, NULL, NULL).limit, OVOID_LIMIT_POSE_A);
}

static void refuse_matrices(void) {
    static const ovoid_vec3 here = {0, 0, 0}, nowhere = {0, NAN, 0}, far = {0, 0, 2 * OVOID_LENGTH_MAX};
    double turned[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    refuse_matrix(NULL, nowhere, OVOID_ERROR_NOT_FINITE);
    refuse_matrix(NULL, far, OVOID_ERROR_RANGE);
    refuse_matrix(turned, nowhere, OVOID_ERROR_NOT_FINITE);
    refuse_matrix(turned, far, OVOID_ERROR_RANGE);
    turned[8] = -1;
    refuse_matrix(turned, here, OVOID_ERROR_ROTATION);
    turned[8] = 1.01;
    refuse_matrix(turned, here, OVOID_ERROR_ROTATION);
    turned[8] = NAN;
    refuse_matrix(turned, here, OVOID_ERROR_NOT_FINITE);
    CHECK_EQ(ovoid_prepared_shape_make_matrix(shapes[0], NULL, here, NULL), OVOID_ERROR_ARGUMENT);
    ovoid_prepared_shape x[2];
    CHECK_EQ(ovoid_prepared_shape_make_matrix(NULL, NULL, here, &x[0]), OVOID_OK);
    CHECK_EQ(ovoid_prepared_shape_make_matrix(shapes[0], NULL, here, &x[1]), OVOID_OK);
    CHECK_EQ(ask_prepared(0, x, 0.3, NULL, NULL).limit, OVOID_LIMIT_SHAPE_A);
}

static void refuse(void) {
    ovoid_pair good = {shapes[0], shapes[1], {{0, 0, 0}, {1, 0, 0, 0}}, {{3, 0, 0}, {1, 0, 0, 0}}}, p = good;
    ovoid_options wrong = {.absolute_tolerance = NAN};
    for (int question = 0; question < QUESTIONS; question++) {
        compare(question, &good, 0.3, &wrong);
        p.shape_b = NULL;
        compare(question, &p, 0.3, NULL);
        p = good;
        p.pose_a.rotation = (ovoid_quat){0, 0, 0, 0};
        compare(question, &p, 0.3, NULL);
        p = good;
        p.pose_b.position.y = NAN;
        compare(question, &p, 0.3, NULL);
        p = good;
    }
    compare(1, &good, NAN, NULL);
    compare(1, &good, -1, NULL);
    ovoid_verdict open = {.lower = 0, .upper = 1};
    CHECK_EQ(ovoid_verdict_is_within(&open, 0.5), -1);
    CHECK_EQ(ovoid_verdict_is_within(&open, 1), 1);
}

int main(void) {
    uint64_t s = 20;
    if (make_shapes(&s)) {
        compare_random(&s);
        refuse();
        compare_by_matrices(&s);
        keep_matrix();
        refuse_matrices();
    }
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
