// Batches give what the single queries give. Truth: the single queries, compared byte for byte, each with the earlier
// proof that the batch was handed; a refusal of couples that name no body.
#include "check.h"
#include "ovoid/ovoid.h"

enum { SHAPES = 12, BODIES = 40, COUPLES = 300, ROUNDS = 4, QUESTIONS = 4 };

static ovoid_shape *make_shape(uint64_t *s) {
    double xyz[3 * 30];
    size_t count = 1 + random_next(s) % 30;
    for (size_t i = 0; i < 3 * count; i++) xyz[i] = random_uniform(s, -1, 1);
    ovoid_shape_options o = {.radius = random_next(s) % 4 == 0 ? 0.125 : 0};
    return ovoid_shape_create_from_points(xyz, count, &o, NULL);
}

static ovoid_pose make_pose(uint64_t *s) {
    ovoid_vec3 p = {random_uniform(s, -3, 3), random_uniform(s, -3, 3), random_uniform(s, -3, 3)};
    ovoid_quat q = {random_uniform(s, -1, 1), random_uniform(s, -1, 1), random_uniform(s, -1, 1), 1};
    return (ovoid_pose){p, q};
}

static ovoid_answer ask_single(int question, const ovoid_pair *pair, const ovoid_options *o, const ovoid_proof *p) {
    switch (question) {
    case 0: return ovoid_collide(pair, o, p);
    case 1: return ovoid_within(pair, 0.5, o, p);
    case 2: return ovoid_distance(pair, o, p);
    default: return ovoid_depth(pair, o, p, NULL);
    }
}

static ovoid_code ask_batch(int question, const ovoid_batch *batch, ovoid_error *error) {
    switch (question) {
    case 0: return ovoid_collide_batch(batch, error);
    case 1: return ovoid_within_batch(batch, 0.5, error);
    case 2: return ovoid_distance_batch(batch, error);
    default: return ovoid_depth_batch(batch, error);
    }
}

static ovoid_body bodies[BODIES];
static ovoid_couple couples[COUPLES];
static ovoid_proof proofs[COUPLES], before[COUPLES];
static ovoid_verdict verdicts[COUPLES];
static ovoid_answer answers[COUPLES];

static void compare(int question, const ovoid_options *o, int has_proofs, int round) {
    for (int i = 0; i < COUPLES; i++) {
        const ovoid_body *a = &bodies[couples[i].a], *b = &bodies[couples[i].b];
        ovoid_pair pair = {a->shape, b->shape, a->pose, b->pose};
        ovoid_answer x = ask_single(question, &pair, o, has_proofs && round > 0 ? &before[i] : NULL);
        check_seed = (uint64_t)i;
        CHECK(memcmp(&x.proof, &answers[i].proof, sizeof x.proof) == 0);
        CHECK(x.status == answers[i].status && x.stage == answers[i].stage && x.limit == answers[i].limit);
        CHECK(memcmp(&x.lower, &answers[i].lower, sizeof x.lower) == 0);
        CHECK(memcmp(&x.upper, &answers[i].upper, sizeof x.upper) == 0);
        CHECK(memcmp(&x.point_a, &answers[i].point_a, 3 * sizeof x.point_a) == 0);
        CHECK(memcmp(&x, &verdicts[i], sizeof verdicts[i]) == 0);
        if (has_proofs) CHECK(memcmp(&x.proof, &proofs[i], sizeof x.proof) == 0);
    }
}

int main(void) {
    uint64_t s = 5;
    ovoid_shape *shapes[SHAPES];
    for (int i = 0; i < SHAPES; i++) {
        shapes[i] = make_shape(&s);
        if (!CHECK(shapes[i] != NULL)) return check_end();
    }
    for (int i = 0; i < BODIES; i++) bodies[i] = (ovoid_body){shapes[i % SHAPES], make_pose(&s)};
    bodies[3].pose.rotation = (ovoid_quat){0, 0, 0, 0}; // refused
    for (int i = 0; i < COUPLES; i++)
        couples[i] = (ovoid_couple){(uint32_t)(random_next(&s) % BODIES), (uint32_t)(random_next(&s) % BODIES)};

    ovoid_options capped = {.cap = 0.75};
    for (int question = 0; question < QUESTIONS; question++)
        for (int has_proofs = 0; has_proofs < 2; has_proofs++) {
            const ovoid_options *o = has_proofs ? NULL : &capped;
            memset(proofs, 0, sizeof proofs);
            for (int round = 0; round < ROUNDS; round++) {
                memcpy(before, proofs, sizeof proofs);
                ovoid_batch batch = {bodies,   BODIES, couples, COUPLES, o, has_proofs ? proofs : NULL,
                                     verdicts, answers};
                CHECK(ask_batch(question, &batch, NULL) == OVOID_OK);
                compare(question, o, has_proofs, round);
                // Outputs that nobody wants.
                ovoid_batch blind = {bodies, BODIES, couples, COUPLES, o, NULL, NULL, NULL};
                CHECK(ask_batch(question, &blind, NULL) == OVOID_OK);
                for (int i = 0; i < BODIES; i++) bodies[i].pose.position.x += random_uniform(&s, -0.02, 0.02);
            }
        }

    // A couple that names no body; nothing at all.
    couples[7].b = BODIES;
    ovoid_error error;
    ovoid_batch batch = {bodies, BODIES, couples, COUPLES, NULL, NULL, verdicts, NULL};
    memset(verdicts, 7, sizeof verdicts);
    ovoid_verdict first = verdicts[0];
    CHECK(ovoid_collide_batch(&batch, &error) == OVOID_ERROR_INDEX);
    CHECK(error.code == OVOID_ERROR_INDEX && error.place == 7);
    CHECK(memcmp(&first, &verdicts[0], sizeof first) == 0);
    ovoid_batch none = {0};
    CHECK(ovoid_depth_batch(&none, &error) == OVOID_OK);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
