// Answers of batches before the exact judge. Truth: the judge, in rationals, for bracket, status and witness points of
// each couple; ovoid_answer_verify beside it; of verdicts alone the brackets of depths that the judge has accepted. The
// bodies are hulls of 4 to 48 vertices, round ones, needles and boxes; the gaps and overlaps of the couples are of
// every order from 1 to 1e-12 of the size. --couples N: so many couples, each with three questions.
#include "check.h"
#include "judge.h"
#include "options.h"
#include "ovoid/ovoid.h"
#include "proofs/covers.h"

enum { SHAPES = 32, COUPLES = 256, QUESTIONS = 3 };

static ovoid_shape *make_shape(int i, uint64_t *s) {
    double xyz[3 * 48];
    size_t count = 4 + random_next(s) % 45;
    // On a ball or a needle, so that all are vertices.
    for (size_t k = 0; k < count; k++) {
        double x = random_normal(s), y = random_normal(s), z = random_normal(s), norm = sqrt(x * x + y * y + z * z);
        double across = (i % 8 == 1 ? 0.02 : 1) / norm;
        xyz[3 * k] = x / norm;
        xyz[3 * k + 1] = y * across;
        xyz[3 * k + 2] = z * across;
    }
    ovoid_shape_options o = {.radius = i % 8 == 2 ? 0.125 : 0};
    if (i % 8 == 3) return ovoid_shape_create_box((ovoid_vec3){0.5, 0.75, 1}, &o, NULL);
    return ovoid_shape_create_from_points(xyz, count, &o, NULL);
}

static ovoid_pose make_pose(uint64_t *s) {
    ovoid_quat q = {random_normal(s), random_normal(s), random_normal(s), random_normal(s)};
    return (ovoid_pose){{random_normal(s), random_normal(s), random_normal(s)}, q};
}

// Moves B along the pair's normal to a gap or an overlap of a random order.
static void place(ovoid_pair *p, uint64_t *s) {
    ovoid_answer now = ovoid_depth(p, NULL, NULL, NULL);
    double wanted = pow(10, random_uniform(s, -12, 0)) * (random_next(s) % 3 ? 1 : -1);
    double step = wanted - now.lower;
    p->pose_b.position.x += step * now.normal.x;
    p->pose_b.position.y += step * now.normal.y;
    p->pose_b.position.z += step * now.normal.z;
}

static ovoid_code ask(int question, const ovoid_batch *batch) {
    if (question == 0) return ovoid_collide_batch(batch, NULL);
    return question == 1 ? ovoid_within_batch(batch, 0.01, NULL) : ovoid_distance_batch(batch, NULL);
}

static ovoid_posed_shape bodies[2 * COUPLES];
static ovoid_couple couples[COUPLES];
static ovoid_answer answers[COUPLES];
static long statuses[4];

static void check_answers(judge *court) {
    for (int i = 0; i < COUPLES; i++) {
        const ovoid_posed_shape *a = &bodies[2 * i], *b = &bodies[2 * i + 1];
        ovoid_pair pair = {a->shape, b->shape, a->pose, b->pose};
        ovoid_error error = {OVOID_OK, 0, ""};
        check_seed = (uint64_t)i;
        if (!CHECK(judge_verify_answer(court, &pair, &answers[i], NULL, &error) == OVOID_OK))
            printf("judge: %s\n", error.message);
        if (!CHECK(ovoid_answer_verify(&pair, &answers[i], NULL, &error) == OVOID_OK))
            printf("check: %s\n", error.message);
        statuses[answers[i].status]++;
    }
}

// The verdicts of a yes or no alone, which have bits of their own: their brackets have a common point with those of the
// depths, which the judge has accepted, and their statuses are those of the answers.
static void check_verdicts(int question, const ovoid_answer depths[COUPLES]) {
    static ovoid_verdict verdicts[COUPLES];
    ovoid_batch batch = {
        .bodies = bodies, .body_count = 2 * COUPLES, .couples = couples, .couple_count = COUPLES, .verdicts = verdicts};
    CHECK(ask(question, &batch) == OVOID_OK);
    for (int i = 0; i < COUPLES; i++) {
        const ovoid_verdict *v = &verdicts[i];
        check_seed = (uint64_t)i;
        CHECK(v->lower <= depths[i].upper && depths[i].lower <= v->upper);
        CHECK(v->status == answers[i].status);
        CHECK(v->status == (v->lower > 0 ? OVOID_SEPARATED : v->upper < 0 ? OVOID_OVERLAPPING : OVOID_TOUCHING));
        if (question == 1)
            CHECK((v->upper <= 0.01) - (v->lower > 0.01) == (answers[i].upper <= 0.01) - (answers[i].lower > 0.01));
    }
}

static void find_depths(judge *court, ovoid_answer depths[COUPLES]) {
    STATIC_COVER(cover);
    for (int i = 0; i < COUPLES; i++) {
        const ovoid_posed_shape *a = &bodies[2 * i], *b = &bodies[2 * i + 1];
        ovoid_pair pair = {a->shape, b->shape, a->pose, b->pose};
        depths[i] = ovoid_depth(&pair, NULL, NULL, &cover);
        CHECK(judge_verify_answer(court, &pair, &depths[i], &cover, NULL) == OVOID_OK);
    }
}

static void check_round(judge *court, ovoid_shape *const shapes[SHAPES], uint64_t *s) {
    for (uint32_t i = 0; i < COUPLES; i++) {
        ovoid_pair p = {shapes[random_next(s) % SHAPES], shapes[random_next(s) % SHAPES], make_pose(s), make_pose(s)};
        place(&p, s);
        bodies[2 * i] = (ovoid_posed_shape){p.shape_a, p.pose_a};
        bodies[2 * i + 1] = (ovoid_posed_shape){p.shape_b, p.pose_b};
        couples[i] = (ovoid_couple){2 * i, 2 * i + 1};
    }
    ovoid_batch batch = {
        .bodies = bodies, .body_count = 2 * COUPLES, .couples = couples, .couple_count = COUPLES, .answers = answers};
    static ovoid_answer depths[COUPLES];
    find_depths(court, depths);
    for (int question = 0; question < QUESTIONS; question++) {
        CHECK(ask(question, &batch) == OVOID_OK);
        check_answers(court);
        if (question < 2) check_verdicts(question, depths);
    }
}

int main(int count, char **arguments) {
    uint64_t wanted = 1000, s = 77;
    const test_option options[] = {{"couples", "so many, each with three questions", &wanted, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    ovoid_shape *shapes[SHAPES];
    for (int i = 0; i < SHAPES; i++)
        if (!CHECK((shapes[i] = make_shape(i, &s)) != NULL)) return check_end();
    judge *court = judge_create();
    for (uint64_t done = 0; done < wanted; done += COUPLES) check_round(court, shapes, &s);
    printf("undecided %ld, separated %ld, touching %ld, overlapping %ld\n", statuses[OVOID_UNDECIDED],
           statuses[OVOID_SEPARATED], statuses[OVOID_TOUCHING], statuses[OVOID_OVERLAPPING]);
    judge_destroy(court);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
