// Prepared shapes answer with the bits of the queries of the pair itself: verdict, proof, points and whole answer, cold
// and with an earlier proof, whatever evidence is asked for. Truth: ovoid_collide and its sisters. Bodies: 4 to 82
// vertices, rounded, with an allowance, flat, far from their frame's origin; gaps from deep to far; quaternions of any
// length. Poses and shapes that are refused there are refused here.
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
    }
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
