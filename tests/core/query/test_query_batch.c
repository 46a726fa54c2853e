// What a batch promises. A couple's results have the same bits, whatever is beside it. Truth: those of the whole batch,
// compared byte for byte with those of batches of every length up to two eights and a half, cut anywhere, in another
// order, among other couples, with every set of outputs, from every vector width of this machine; the verdicts of a yes
// or no alone have bits of their own (test_query_floats.c). Beside the single
// query, with the earlier proof that the batch was handed: the same status, brackets with a common point, an end for
// the same reason, and a proof that ovoid_answer_verify accepts. Couples that name no body are refused.
#include "bits.h"

enum { SHAPES = 12, BODIES = 40, COUPLES = 300, ROUNDS = 4, QUESTIONS = 4, LENGTHS = 21 };

static double scale = 1; // of the bodies and their places

static ovoid_shape *make_shape(uint64_t *s) {
    double xyz[3 * 30];
    size_t count = 1 + random_next(s) % 30;
    for (size_t i = 0; i < 3 * count; i++) xyz[i] = scale * random_uniform(s, -1, 1);
    ovoid_shape_options o = {.radius = random_next(s) % 4 == 0 ? 0.125 * scale : 0};
    return ovoid_shape_create_from_points(xyz, count, &o, NULL);
}

static ovoid_pose make_pose(uint64_t *s) {
    ovoid_vec3 p = {random_uniform(s, -3, 3), random_uniform(s, -3, 3), random_uniform(s, -3, 3)};
    ovoid_quat q = {random_uniform(s, -1, 1), random_uniform(s, -1, 1), random_uniform(s, -1, 1), 1};
    return (ovoid_pose){{scale * p.x, scale * p.y, scale * p.z}, q};
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

static ovoid_posed_shape bodies[BODIES];
static ovoid_couple couples[COUPLES];
static ovoid_proof proofs[COUPLES], before[COUPLES];
static ovoid_verdict verdicts[COUPLES];
static ovoid_answer answers[COUPLES];

// The limits of a query that did what it was asked for are one reason: a bracket may be narrower than was needed.
static ovoid_limit get_reason(ovoid_limit limit) {
    return limit == OVOID_LIMIT_ANSWERED || limit == OVOID_LIMIT_CAP ? OVOID_LIMIT_NONE : limit;
}

static void check_beside_single(int question, const ovoid_options *o, const ovoid_answer *batch, int i) {
    const ovoid_posed_shape *a = &bodies[couples[i].a], *b = &bodies[couples[i].b];
    ovoid_pair pair = {a->shape, b->shape, a->pose, b->pose};
    ovoid_answer single = ask_single(question, &pair, o, &before[i]);
    CHECK(single.status == batch->status);
    CHECK(get_reason(single.limit) == get_reason(batch->limit));
    CHECK(single.lower <= batch->upper && batch->lower <= single.upper);
    // A distance that one query narrows to the tolerance the other does not leave wide; of an overlap it proves the
    // sign.
    int is_exact = question == 3 || (question == 2 && single.status != OVOID_OVERLAPPING);
    if (is_exact && single.lower <= 0.75 * scale) CHECK(single.limit == batch->limit);
    if (question == 1) CHECK(ovoid_answer_is_within(&single, 0.5) == ovoid_answer_is_within(batch, 0.5));
    // A batch returns no covers, so the depth's proof cannot be verified.
    if (batch->proof.kind == OVOID_PROOF_COVER) return;
    CHECK(ovoid_answer_verify(&pair, batch, &(ovoid_answer_basis){.options = o}, NULL) == OVOID_OK);
}

static void compare(int question, const ovoid_options *o, int has_proofs) {
    for (int i = 0; i < COUPLES; i++) {
        check_seed = (uint64_t)i;
        check_beside_single(question, o, &answers[i], i);
        CHECK(memcmp(&answers[i], &verdicts[i], sizeof verdicts[i]) == 0);
        if (has_proofs) CHECK(memcmp(&answers[i].proof, &proofs[i], sizeof proofs[i]) == 0);
    }
}

// Every other couple, backwards, then the rest: each has other neighbours.
static void check_order(int question, const ovoid_options *o) {
    static ovoid_couple other[COUPLES];
    static ovoid_answer found[COUPLES];
    static int place[COUPLES];
    for (int i = 0; i < COUPLES; i++) {
        place[i] = i < COUPLES / 2 ? COUPLES - 1 - 2 * i : 2 * (i - COUPLES / 2);
        other[i] = couples[place[i]];
    }
    ovoid_batch batch = {bodies, BODIES, other, COUPLES, o, NULL, NULL, found, NULL};
    CHECK(ask_batch(question, &batch, NULL) == OVOID_OK);
    for (int i = 0; i < COUPLES; i++) CHECK(memcmp(&found[i], &answers[place[i]], sizeof found[i]) == 0);
}

// The answers' bits whatever else is wanted, and however the couples are cut.
static void check_outputs(int question, const ovoid_options *o) {
    static ovoid_verdict alone[COUPLES];
    static ovoid_proof fresh[COUPLES];
    static ovoid_answer cut[LENGTHS];
    memset(alone, 0, sizeof alone);
    memset(fresh, 0, sizeof fresh);
    static ovoid_verdict truth[COUPLES];
    ovoid_batch batch = {bodies, BODIES, couples, COUPLES, o, NULL, alone, NULL, NULL};
    CHECK(ask_batch(question, &batch, NULL) == OVOID_OK);
    if (question > 1) CHECK(memcmp(alone, verdicts, sizeof alone) == 0);
    memcpy(truth, alone, sizeof truth);
    for (int i = 0; i < COUPLES; i++) {
        CHECK(truth[i].status == verdicts[i].status);
        CHECK(get_reason(truth[i].limit) == get_reason(verdicts[i].limit));
        CHECK(truth[i].lower <= verdicts[i].upper && verdicts[i].lower <= truth[i].upper);
    }
    batch.verdicts = NULL;
    batch.proofs = fresh;
    CHECK(ask_batch(question, &batch, NULL) == OVOID_OK);
    for (int i = 0; i < COUPLES; i++) CHECK(memcmp(&fresh[i], &answers[i].proof, sizeof fresh[i]) == 0);
    // Points and normals alone: the three vectors lie side by side in an answer.
    static ovoid_witness points[COUPLES];
    batch.proofs = NULL;
    batch.witnesses = points;
    CHECK(ask_batch(question, &batch, NULL) == OVOID_OK);
    for (int i = 0; i < COUPLES; i++) CHECK(memcmp(&points[i], &answers[i].point_a, sizeof points[i]) == 0);

    // From every place on, so many; what lies behind is not touched.
    for (size_t count = 0; count < LENGTHS; count++)
        for (size_t from = 0; from < 16; from++) {
            memset(alone, 7, sizeof alone);
            ovoid_batch part = {bodies, BODIES, couples + from, count, o, NULL, alone, NULL, NULL};
            CHECK(ask_batch(question, &part, NULL) == OVOID_OK);
            CHECK(memcmp(alone, truth + from, count * sizeof *alone) == 0);
            CHECK(alone[count].iterations == 0x07070707);
        }
    // The whole answers of all couples, few at a time, which are not searched in lanes.
    for (size_t count = 1; count < 10; count += 2)
        for (size_t from = 0; from + count <= COUPLES; from += count) {
            ovoid_batch part = {bodies, BODIES, couples + from, count, o, NULL, NULL, cut, NULL};
            CHECK(ask_batch(question, &part, NULL) == OVOID_OK);
            CHECK(memcmp(cut, answers + from, count * sizeof *cut) == 0);
        }
}

// The bits of all answers so far, of each vector width the same.
static uint64_t truth[QUESTIONS * 2 * ROUNDS];
static size_t asked;
static int is_widest;

static void check_bits(void) {
    uint64_t hash = bits_add(BITS_START, answers, sizeof answers);
    if (is_widest) truth[asked] = hash;
    CHECK(truth[asked++] == hash);
}

static void check_question(int question, int has_proofs, uint64_t *s) {
    ovoid_options capped = {.cap = 0.75 * scale};
    const ovoid_options *o = has_proofs ? NULL : &capped;
    memset(proofs, 0, sizeof proofs);
    for (int round = 0; round < ROUNDS; round++) {
        memcpy(before, proofs, sizeof proofs);
        ovoid_batch batch = {bodies, BODIES, couples, COUPLES, o, has_proofs ? proofs : NULL, verdicts, answers, NULL};
        CHECK(ask_batch(question, &batch, NULL) == OVOID_OK);
        compare(question, o, has_proofs);
        check_bits();
        if (!has_proofs && round == 0) check_outputs(question, o);
        if (!has_proofs) check_order(question, o);
        // Outputs that nobody wants.
        ovoid_batch blind = {bodies, BODIES, couples, COUPLES, o, NULL, NULL, NULL, NULL};
        CHECK(ask_batch(question, &blind, NULL) == OVOID_OK);
        for (int i = 0; i < BODIES; i++) bodies[i].pose.position.x += scale * random_uniform(s, -0.02, 0.02);
    }
}

static void check_all(int widest) {
    static ovoid_posed_shape start[BODIES];
    uint64_t s = 6;
    memcpy(start, bodies, sizeof start);
    is_widest = widest;
    asked = 0;
    for (int question = 0; question < QUESTIONS; question++)
        for (int has_proofs = 0; has_proofs < 2; has_proofs++) check_question(question, has_proofs, &s);
    memcpy(bodies, start, sizeof start);
}

// Refused poses, a quaternion that has to be scaled, a shape with its origin far away, lengths without a square,
// centres in one place, bodies that are far away: what the lanes must leave to the single query.
static void make_bodies(ovoid_shape *const shapes[SHAPES], uint64_t *s) {
    for (int i = 0; i < BODIES; i++) bodies[i] = (ovoid_posed_shape){shapes[i % SHAPES], make_pose(s)};
    bodies[3].pose.rotation = (ovoid_quat){0, 0, 0, 0};
    bodies[4].pose.position.y = NAN;
    bodies[5].pose.rotation = (ovoid_quat){1e-30, 2e-30, 0, 0};
    bodies[6].pose.position.x = 1e60;
    bodies[7].pose.rotation.w = INFINITY;
    bodies[8].pose = bodies[9].pose;
    bodies[8].shape = bodies[9].shape;
    bodies[10].pose.position.z = 1e6;
}

// Shapes 0 to 2: a point, a ball, a body whose frame is brought near.
static int make_shapes(ovoid_shape *shapes[SHAPES], uint64_t *s) {
    static const double point[3] = {0.5, 0.25, 0}, away[12] = {1e6, 0, 0, 1e6 + 1, 0, 0, 1e6, 1, 0, 1e6, 0, 1};
    ovoid_shape_options ball = {.radius = 0.5};
    shapes[0] = ovoid_shape_create_from_points(point, 1, NULL, NULL);
    shapes[1] = ovoid_shape_create_from_points(point, 1, &ball, NULL);
    shapes[2] = ovoid_shape_create_from_points(away, 4, NULL, NULL);
    for (int i = 3; i < SHAPES; i++) shapes[i] = make_shape(s);
    for (int i = 0; i < SHAPES; i++)
        if (!CHECK(shapes[i] != NULL)) return 0;
    return 1;
}

// Needles of too many vertices for the kernel of small bodies, side by side, every third one rounded: the outer
// ellipsoids part many of them, and each lane's answer has that lane's normal.
static ovoid_shape *make_needle(uint64_t *s, double radius) {
    double xyz[3 * 80];
    for (int i = 0; i < 3 * 80; i++) xyz[i] = random_normal(s) * (i % 3 ? 0.04 : 0.5);
    const ovoid_shape_options o = {.radius = radius};
    return ovoid_shape_create_from_points(xyz, 80, &o, NULL);
}

static void check_needles(uint64_t *s) {
    ovoid_shape *shapes[SHAPES];
    long parted[3] = {0, 0, 0};
    memset(before, 0, sizeof before);
    for (int i = 0; i < SHAPES; i++)
        if (!CHECK((shapes[i] = make_needle(s, i % 3 ? 0 : 0.05)) != NULL)) return;
    for (int i = 0; i < BODIES; i++) {
        bodies[i] = (ovoid_posed_shape){shapes[i % SHAPES], make_pose(s)};
        bodies[i].pose.position.x *= 0.2, bodies[i].pose.position.y *= 0.2, bodies[i].pose.position.z *= 0.2;
    }
    for (int question = 0; question < 3; question++) {
        ovoid_batch batch = {bodies, BODIES, couples, COUPLES, NULL, NULL, verdicts, answers, NULL};
        CHECK(ask_batch(question, &batch, NULL) == OVOID_OK);
        compare(question, NULL, 0);
        check_outputs(question, NULL);
        check_order(question, NULL);
        for (int i = 0; i < COUPLES; i++) parted[question] += answers[i].stage == OVOID_STAGE_OUTER;
    }
    CHECK(parted[0] >= 50 && parted[1] >= 10);
    printf("outer ellipsoids part %ld of %d touching or not, %ld within a margin\n", parted[0], COUPLES, parted[1]);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
}

// A hull of so many vertices.
static ovoid_shape *make_ball(uint64_t *s, size_t count, double radius) {
    double xyz[3 * 60];
    for (size_t i = 0; i < count; i++) {
        double x = random_normal(s), y = random_normal(s), z = random_normal(s), norm = sqrt(x * x + y * y + z * z);
        xyz[3 * i] = x / norm, xyz[3 * i + 1] = y / norm, xyz[3 * i + 2] = z / norm;
    }
    const ovoid_shape_options o = {.radius = radius};
    return ovoid_shape_create_from_points(xyz, count, &o, NULL);
}

// Near pairs of small rounded bodies, of large rounded ones and of large ones, which single precision leaves open:
// those that wait have one room, in turn.
static void check_mixed(uint64_t *s) {
    ovoid_shape *small = make_ball(s, 20, 0.05), *round = make_ball(s, 60, 0.05), *large = make_ball(s, 60, 0);
    if (!CHECK(small && round && large)) return;
    static ovoid_posed_shape pairs[2 * COUPLES];
    static ovoid_couple all[COUPLES];
    for (int i = 0; i < COUPLES; i++) {
        ovoid_shape *shape = i % 5 == 0 ? small : i % 5 < 3 ? round : large;
        ovoid_posed_shape *a = &pairs[2 * i], *b = a + 1;
        *a = (ovoid_posed_shape){shape, make_pose(s)};
        *b = (ovoid_posed_shape){shape, make_pose(s)};
        all[i] = (ovoid_couple){2 * (uint32_t)i, 2 * (uint32_t)i + 1};
        ovoid_pair pair = {a->shape, b->shape, a->pose, b->pose};
        ovoid_answer now = ovoid_depth(&pair, NULL, NULL, NULL);
        b->pose.position.x -= (now.lower - 1e-3) * now.normal.x;
        b->pose.position.y -= (now.lower - 1e-3) * now.normal.y;
        b->pose.position.z -= (now.lower - 1e-3) * now.normal.z;
    }
    memset(verdicts, 7, sizeof verdicts);
    ovoid_batch batch = {pairs, 2 * COUPLES, all, COUPLES, NULL, NULL, verdicts, NULL, NULL};
    CHECK(ovoid_collide_batch(&batch, NULL) == OVOID_OK);
    for (int i = 0; i < COUPLES; i++) {
        const ovoid_posed_shape *a = &pairs[2 * i], *b = a + 1;
        ovoid_pair pair = {a->shape, b->shape, a->pose, b->pose};
        ovoid_answer single = ovoid_distance(&pair, NULL, NULL);
        check_seed = (uint64_t)i;
        CHECK(verdicts[i].status == single.status);
        CHECK(single.lower <= verdicts[i].upper && verdicts[i].lower <= single.upper);
    }
    ovoid_shape_destroy(small);
    ovoid_shape_destroy(round);
    ovoid_shape_destroy(large);
}

// A body whose frame's origin is not in it, and a point beyond one of its vertices, on the line of both origins: this
// line gives the whole gap, the line of the spheres' centres does not.
static void check_origins(void) {
    static const double xyz[12] = {1, 1, 0, 1, -1, 0, 1, 0, 0.5, 1, 0, -0.5}, point[3] = {0, 0, 0};
    ovoid_shape *hull = ovoid_shape_create_from_points(xyz, 4, NULL, NULL),
                *other = ovoid_shape_create_from_points(point, 1, NULL, NULL);
    if (!CHECK(hull && other)) return;
    ovoid_posed_shape both[2] = {{hull, {{0, 0, 0}, {1, 0, 0, 0}}}, {other, {{3, 3, 0}, {1, 0, 0, 0}}}};
    ovoid_couple couple = {0, 1};
    ovoid_answer found;
    ovoid_batch batch = {both, 2, &couple, 1, NULL, NULL, NULL, &found, NULL};
    ovoid_pair pair = {hull, other, both[0].pose, both[1].pose};
    CHECK(ovoid_collide_batch(&batch, NULL) == OVOID_OK);
    CHECK(found.stage == OVOID_STAGE_SPHERE);
    // The constants of the bound are some 1e-13 of the size.
    CHECK_NEAR(found.lower, 2 * sqrt(2), 1e-12);
    CHECK_NEAR(found.upper, 4 * sqrt(2), 1e-12);
    CHECK_NEAR(found.normal.x, sqrt(0.5), 1e-15);
    CHECK(ovoid_answer_verify(&pair, &found, NULL, NULL) == OVOID_OK);
    ovoid_shape_destroy(hull);
    ovoid_shape_destroy(other);
}

// A couple that names no body; nothing at all.
static void check_refusals(void) {
    couples[7].b = BODIES;
    ovoid_error error;
    ovoid_batch batch = {bodies, BODIES, couples, COUPLES, NULL, NULL, verdicts, NULL, NULL};
    memset(verdicts, 7, sizeof verdicts);
    ovoid_verdict first = verdicts[0];
    CHECK(ovoid_collide_batch(&batch, &error) == OVOID_ERROR_INDEX);
    CHECK(error.code == OVOID_ERROR_INDEX && error.place == 7);
    CHECK(memcmp(&first, &verdicts[0], sizeof first) == 0);
    ovoid_batch none = {0};
    CHECK(ovoid_depth_batch(&none, &error) == OVOID_OK);
}

static void check_narrower(void) { check_all(0); }

int main(void) {
    uint64_t s = 5;
    ovoid_shape *shapes[SHAPES];
    if (!make_shapes(shapes, &s)) return check_end();
    make_bodies(shapes, &s);
    for (int i = 0; i < COUPLES; i++)
        couples[i] = (ovoid_couple){(uint32_t)(random_next(&s) % BODIES), (uint32_t)(random_next(&s) % BODIES)};
    check_all(1);
    bits_run_narrower(check_narrower);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    check_needles(&s);
    check_mixed(&s);
    check_origins();
    // So small that what underflow can hide is a part of every bound, then most of it.
    for (scale = 1e-115; scale > 1e-130; scale *= 1e-12) {
        if (!make_shapes(shapes, &s)) return check_end();
        make_bodies(shapes, &s);
        check_all(1);
        bits_run_narrower(check_narrower);
        for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    }
    check_refusals();
    return check_end();
}
