// Bodies that move a little from query to query, small and larger ones, each asked with its last proof. Truth: the
// query without one, whose bracket must meet that with it, with the same sign; and the checker. 17 of 20 answers come
// without a step of the search. Proofs of other pairs, cut off, or with any numbers change nothing but the way.
#include "check.h"
#include "ovoid/ovoid.h"
#include "places.h"

enum { SHAPES = 24, PAIRS = 60, FRAMES = 40, QUESTIONS = 3 };

static const double margin = 0.2;
static ovoid_shape *shapes[SHAPES];

static int make_shapes(uint64_t *s) {
    for (int i = 0; i < SHAPES; i++) {
        double xyz[3 * 300];
        size_t count = i % 6 == 5 ? 100 + random_next(s) % 201 : 4 + random_next(s) % 29;
        for (size_t k = 0; k < 3 * count; k++) xyz[k] = random_uniform(s, -1, 1);
        ovoid_shape_options o = {.radius = i % 4 == 3 ? 0.1 : 0};
        shapes[i] = ovoid_shape_create_from_points(xyz, count, &o, NULL);
        if (!CHECK(shapes[i] != NULL)) return 0;
    }
    return 1;
}

static ovoid_answer ask(int question, const ovoid_pair *p, const ovoid_proof *earlier) {
    if (question == 0) return ovoid_collide(p, NULL, earlier);
    return question == 1 ? ovoid_within(p, margin, NULL, earlier) : ovoid_distance(p, NULL, earlier);
}

// The weights of a tetrahedron around the origin give a common point: both witnesses are it, to rounding of bodies
// smaller than 10.
static void check_common(const ovoid_answer *x) {
    if (x->proof.kind != OVOID_PROOF_HULL) return;
    ovoid_vec3 a = x->point_a, b = x->point_b;
    CHECK_LE(fabs(b.x - a.x) + fabs(b.y - a.y) + fabs(b.z - a.z), 1e-12);
}

// The answer with a proof says what that without says, and proves it.
static void compare(int question, const ovoid_pair *p, const ovoid_answer *warm) {
    ovoid_answer cold = ask(question, p, NULL);
    CHECK_EQ(ovoid_answer_verify(p, warm, NULL, NULL), OVOID_OK);
    CHECK_EQ(warm->status, cold.status);
    check_common(&cold);
    check_common(warm);
    CHECK(warm->lower <= cold.upper && cold.lower <= warm->upper);
    if (question == 1) CHECK_EQ(ovoid_answer_is_within(warm, margin), ovoid_answer_is_within(&cold, margin));
    if (question == 2 && cold.status == OVOID_SEPARATED) CHECK_EQ(warm->limit, cold.limit);
}

static ovoid_proof make_strange(uint64_t *s, const ovoid_proof *last) {
    ovoid_proof p = *last;
    switch (random_next(s) % 6) {
    case 0: p.count = (uint32_t)(random_next(s) % (OVOID_PROOF_PAIRS + 3)); break;
    case 1: p.a[random_next(s) % 3] = UINT32_MAX; break;
    case 2: p.normal = (ovoid_vec3){NAN, INFINITY, 1e300}; break;
    case 3: p.normal = p.inner_a = (ovoid_vec3){0, 0, 0}; break;
    case 4: p.kind = (ovoid_proof_kind)(random_next(s) % 8); break;
    default: p.a[1] = p.a[0], p.b[1] = p.b[0], p.weight_a[0] = -1;
    }
    return p;
}

static void move(uint64_t *s, ovoid_pose *p, double far) {
    double step = 0.02 * far;
    p->position.x += random_uniform(s, -step, step);
    p->position.y += random_uniform(s, -step, step);
    p->rotation.x += random_uniform(s, -0.01, 0.01);
    p->rotation.z += random_uniform(s, -0.01, 0.01);
}

// One pair's motion; counts the answers that the proof gave at once, by question.
static void follow(uint64_t *s, int pair, double far, int question, long at_once[QUESTIONS]) {
    ovoid_pair p = {shapes[pair % SHAPES],
                    shapes[random_next(s) % SHAPES],
                    {{0, 0, 0}, random_quat(s)},
                    {{far, 0.1 * far, 0}, random_quat(s)}};
    ovoid_proof last = ask(question, &p, NULL).proof;
    for (int i = 0; i < FRAMES; i++) {
        check_seed = (uint64_t)(pair * FRAMES + i);
        move(s, &p.pose_b, far);
        ovoid_proof strange = make_strange(s, &last);
        ovoid_answer x = ask(question, &p, &strange);
        compare(question, &p, &x);
        x = ask(question, &p, &last);
        compare(question, &p, &x);
        at_once[question] += x.iterations == 0 && (x.stage == OVOID_STAGE_PROOF || x.stage == OVOID_STAGE_SPHERE);
        last = x.proof;
    }
}

int main(void) {
    uint64_t s = 3;
    if (!make_shapes(&s)) return 1;
    static const double places[4] = {0.3, 1.2, 1.7, 2.2};
    for (int place = 0; place < 4; place++) {
        long at_once[QUESTIONS] = {0};
        for (int question = 0; question < QUESTIONS; question++)
            for (int i = 0; i < PAIRS; i++) follow(&s, i, places[place], question, at_once);
        for (int question = 0; question < QUESTIONS; question++) {
            printf("at %g, question %d: %ld of %d at once\n", places[place], question, at_once[question],
                   PAIRS * FRAMES);
            CHECK_LE(0.85 * PAIRS * FRAMES, at_once[question]);
        }
    }
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
