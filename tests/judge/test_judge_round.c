// Pairs with true cylinders, cones and ellipsoids before the exact judge and the check without a search. Truth:
// rational arithmetic with the supports of the round bodies, their roots rounded up. A lower bound that is raised by
// more than its rounding is refused by both; near bodies that are apart, no direction in reach has a larger gap than
// the answer's, to the query's tolerance; and a shape that was written to a file and read gives the same answer.
#include "check.h"
#include "judge.h"
#include "options.h"
#include "places.h"
#include "proofs/covers.h"

#include "ovoid/ovoid.h"

#include <string.h>

static long accepted, refused, compared;

static ovoid_quat random_turn(uint64_t *s) {
    static const ovoid_quat simple[] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 0, 1e-6, 0}, {0, 1, 0, 0}, {1, 1, 1, 1}};
    if (random_next(s) % 3 == 0) return simple[random_next(s) % 5];
    return random_quat(s);
}

static ovoid_shape *make_ellipsoid(uint64_t *s) {
    double least = random_next(s) % 2 ? -2 : -7;
    ovoid_vec3 half = {exp(random_uniform(s, least, 0)), exp(random_uniform(s, least, 0)),
                       exp(random_uniform(s, least, 0))};
    ovoid_shape_options o = {.radius = random_next(s) % 4 ? 0 : 0.125};
    if (random_next(s) % 8 == 0) half.y = half.x;
    if (random_next(s) % 8 == 0) half.z = half.x;
    return ovoid_shape_create_ellipsoid(half, &o, NULL);
}

static ovoid_shape *make_round(uint64_t *s) {
    if (random_next(s) % 3 == 0) return make_ellipsoid(s);
    double radius = random_uniform(s, 0.1, 1), half = random_next(s) % 8 ? random_uniform(s, 0.05, 1) : 0;
    // 3 to 7, 16 and 32 sides.
    uint64_t sides = random_next(s) % 4;
    ovoid_shape_options o = {.tolerance = sides == 0   ? random_uniform(s, 0.1, 0.5) * radius
                                          : sides == 1 ? 0.02 * radius
                                                       : 0};
    if (random_next(s) % 4 == 0) o.radius = 0.125;
    return (random_next(s) % 2 ? ovoid_shape_create_cylinder : ovoid_shape_create_cone)(radius, half, &o, NULL);
}

static ovoid_shape *make_other(uint64_t *s) {
    double xyz[36], a = random_uniform(s, 0.2, 1);
    ovoid_shape_options known = {.allowance = {.outside = 0.01, .inside = 0.02}};
    for (int i = 0; i < 36; i++) xyz[i] = random_uniform(s, -1, 1);
    switch (random_next(s) % 6) {
    case 0: return ovoid_shape_create_sphere(a, NULL, NULL);
    case 1: return ovoid_shape_create_capsule(0.25, a, NULL, NULL);
    case 2: return ovoid_shape_create_box((ovoid_vec3){a, 1, 0.5}, NULL, NULL);
    case 3: return ovoid_shape_create_from_points(xyz, 12, NULL, NULL);
    case 4: return ovoid_shape_create_from_points(xyz, 12, &known, NULL);
    default: return make_round(s);
    }
}

static void check_accepted(judge *context, const ovoid_pair *p, const ovoid_answer *x, const ovoid_cover *cover) {
    ovoid_error error = {.message = ""};
    if (!CHECK_EQ(judge_verify_answer(context, p, x, cover, &error), OVOID_OK)) printf("  %s\n", error.message);
    if (!CHECK_EQ(ovoid_answer_verify(p, x, &(ovoid_answer_basis){.cover = cover}, &error), OVOID_OK))
        printf("  %s\n", error.message);
    accepted++;
}

// Balls, points and covers show no more than 2e-12 above their claim.
static void check_upper_lie(judge *context, const ovoid_pair *p, const ovoid_answer *x, const ovoid_cover *cover) {
    ovoid_answer lie = *x;
    lie.upper -= 2e-12;
    int is_sharp =
        x->proof.kind == OVOID_PROOF_BALLS || x->proof.kind == OVOID_PROOF_POINTS || x->proof.kind == OVOID_PROOF_COVER;
    if (!(lie.lower <= lie.upper) || !is_sharp) return;
    lie.status = lie.lower > 0 ? OVOID_SEPARATED : lie.upper < 0 ? OVOID_OVERLAPPING : OVOID_UNDECIDED;
    CHECK(judge_verify_answer(context, p, &lie, cover, NULL) != OVOID_OK);
    CHECK(ovoid_answer_verify(p, &lie, &(ovoid_answer_basis){.cover = cover}, NULL) != OVOID_OK);
    refused++;
}

// A gap is claimed with room for 320 roundings of the pair's size, which is below 16; 2e-12 more is a lie.
static void check_lie(judge *context, const ovoid_pair *p, const ovoid_answer *x, const ovoid_cover *cover) {
    ovoid_answer lie = *x;
    lie.lower += 2e-12;
    if (!(lie.lower <= lie.upper) || x->limit == OVOID_LIMIT_PRECISION) return;
    lie.status = lie.lower > 0 ? OVOID_SEPARATED : lie.upper < 0 ? OVOID_OVERLAPPING : OVOID_UNDECIDED;
    CHECK(judge_verify_answer(context, p, &lie, cover, NULL) != OVOID_OK);
    CHECK(ovoid_answer_verify(p, &lie, &(ovoid_answer_basis){.cover = cover}, NULL) != OVOID_OK);
    refused++;
}

// A ball's centre in a box must be a point of the box: with a weight below zero it is beyond it, nearer to the
// cylinder.
static void check_weights(void) {
    judge *context = judge_create();
    ovoid_shape *a = ovoid_shape_create_cylinder(0.5, 0.5, NULL, NULL),
                *b = ovoid_shape_create_box((ovoid_vec3){0.2, 0.2, 0.2}, NULL, NULL);
    ovoid_pair p = {a, b, {{0, 0, 0}, {1, 0, 0, 0}}, {{2, 0, 0}, {1, 0, 0, 0}}};
    ovoid_polytope box = ovoid_shape_get_polytope(b);
    ovoid_answer lie = ovoid_distance(&p, NULL, NULL);
    uint32_t near = 0, far = 0;
    while (box.vertices[3 * near] > 0) near++;
    while (box.vertices[3 * far] < 0 || box.vertices[3 * far + 1] != box.vertices[3 * near + 1] ||
           box.vertices[3 * far + 2] != box.vertices[3 * near + 2])
        far++;
    lie.proof.kind = OVOID_PROOF_BALLS;
    lie.proof.count = 2;
    lie.proof.inner_a = (ovoid_vec3){0, 0, 0};
    const double weights[3][2] = {{2.5, -1.5}, {NAN, 1}, {INFINITY, 1}};
    for (int i = 0; i < 3; i++) {
        ovoid_error error = {.message = ""};
        for (int k = 0; k < 2; k++) {
            lie.proof.a[k] = 0;
            lie.proof.b[k] = k ? far : near;
            lie.proof.weight_a[k] = 1;
            lie.proof.weight_b[k] = weights[i][k];
        }
        // The lower bound stays below what is claimed.
        lie.lower = 0.5;
        lie.upper = 1;
        CHECK_EQ(judge_verify_answer(context, &p, &lie, NULL, &error), OVOID_ERROR_PROOF);
        CHECK(strstr(error.message, "is not a finite number of at least zero") != NULL);
        CHECK(ovoid_answer_verify(&p, &lie, NULL, NULL) != OVOID_OK);
    }
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    judge_destroy(context);
}

// The support in the world, in closed form or by all vertices.
static double find_support(const ovoid_shape *shape, const ovoid_pose *pose, ovoid_vec3 n) {
    ovoid_pose turn = {{0, 0, 0}, pose->rotation};
    ovoid_vec3 m = ovoid_pose_compute_local_point(&turn, n);
    ovoid_round round = ovoid_shape_get_round(shape);
    double along = round.half_length * m.z, rim = round.radius * sqrt(m.x * m.x + m.y * m.y), top = -INFINITY;
    if (round.kind == OVOID_ROUND_CYLINDER) top = fabs(along) + rim;
    if (round.kind == OVOID_ROUND_CONE) top = fmax(along, rim - along);
    ovoid_vec3 half = round.half_axes;
    if (round.kind == OVOID_ROUND_ELLIPSOID)
        top = sqrt(half.x * m.x * half.x * m.x + half.y * m.y * half.y * m.y + half.z * m.z * half.z * m.z);
    ovoid_polytope polytope = ovoid_shape_get_polytope(shape);
    ovoid_vec3 o = polytope.origin;
    for (uint32_t i = 0; i < polytope.vertex_count && round.kind == OVOID_ROUND_NONE; i++) {
        const double *v = polytope.vertices + 3 * (size_t)i;
        top = fmax(top, m.x * (v[0] + o.x) + m.y * (v[1] + o.y) + m.z * (v[2] + o.z));
    }
    ovoid_vec3 t = pose->position;
    ovoid_allowance allowance = ovoid_shape_get_allowance(shape);
    double beyond = round.kind == OVOID_ROUND_NONE ? allowance.outside : 0;
    return (n.x * t.x + n.y * t.y + n.z * t.z) + top + ovoid_shape_get_radius(shape) + beyond;
}

static double find_gap(const ovoid_pair *p, ovoid_vec3 n) {
    ovoid_vec3 back = {-n.x, -n.y, -n.z};
    return -find_support(p->shape_b, &p->pose_b, back) - find_support(p->shape_a, &p->pose_a, n);
}

// The gap along a direction is a concave function about the largest one of bodies that are apart, so that a larger one
// would be seen in the normal's neighbourhood.
static void check_best(const ovoid_pair *p, const ovoid_answer *x, uint64_t *s) {
    if (!(x->lower > 1e-6)) return;
    for (int i = 0; i < 60; i++) {
        double size = pow(10, -1 - i % 6);
        ovoid_vec3 turn = random_vec3(s, size), n = x->normal;
        n = (ovoid_vec3){n.x + turn.x, n.y + turn.y, n.z + turn.z};
        double length = sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        CHECK_LE(find_gap(p, (ovoid_vec3){n.x / length, n.y / length, n.z / length}), x->lower + 2e-8);
        compared++;
    }
}

static void check_file(const ovoid_pair *p, const ovoid_answer *x) {
    static unsigned char bytes[1 << 16];
    ovoid_pair q = *p;
    size_t size = ovoid_shape_write(p->shape_a, bytes, sizeof bytes);
    ovoid_shape *again = ovoid_shape_read(bytes, size, NULL, NULL);
    if (!CHECK(again != NULL)) return;
    ovoid_round a = ovoid_shape_get_round(p->shape_a), b = ovoid_shape_get_round(again);
    CHECK(a.kind == b.kind && !memcmp(&a.radius, &b.radius, sizeof a - offsetof(ovoid_round, radius)));
    q.shape_a = again;
    ovoid_answer y = ovoid_distance(&q, NULL, NULL);
    CHECK(!memcmp(&x->lower, &y.lower, sizeof y.lower) && !memcmp(&x->upper, &y.upper, sizeof y.upper));
    ovoid_shape_destroy(again);
}

static void check_pair(judge *context, const ovoid_pair *p, uint64_t *s) {
    STATIC_COVER(cover);
    ovoid_answer x = ovoid_depth(p, NULL, NULL, &cover);
    check_accepted(context, p, &x, &cover);
    check_lie(context, p, &x, &cover);
    check_upper_lie(context, p, &x, &cover);
    int is_found = x.limit == OVOID_LIMIT_NONE || x.limit == OVOID_LIMIT_ALLOWANCE;
    ovoid_allowance known = ovoid_shape_get_allowance(p->shape_b), other = ovoid_shape_get_allowance(p->shape_a);
    int has_width = known.outside + other.outside > 0 && (known.axis.z == 0 || other.axis.z == 0);
    if (!has_width) CHECK_LE(x.upper - x.lower, 1e-9 * 16);
    if (is_found) CHECK_EQ(judge_verify_points(context, p, &x, NULL), OVOID_OK);
    check_best(p, &x, s);
    ovoid_proof earlier = x.proof;
    x = ovoid_distance(p, NULL, NULL);
    check_accepted(context, p, &x, NULL);
    check_best(p, &x, s);
    check_file(p, &x);
    double depth = fabs(x.lower);
    x = ovoid_distance(p, NULL, &earlier);
    check_accepted(context, p, &x, NULL);
    check_best(p, &x, s);
    x = ovoid_collide(p, NULL, NULL);
    check_accepted(context, p, &x, NULL);
    x = ovoid_within(p, depth, NULL, NULL);
    check_accepted(context, p, &x, NULL);
}

int main(int count, char **arguments) {
    uint64_t s = 29, rounds = 600;
    const test_option options[] = {{"rounds", "so many, some 7 answers each", &rounds, NULL, NULL, NULL},
                                   {"seed", "of the pairs", &s, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    for (uint64_t i = 0; i < rounds; i++) {
        check_seed = s;
        // A judge knows shapes by their addresses.
        judge *context = judge_create();
        ovoid_shape *a = make_round(&s), *b = make_other(&s);
        double far = i % 3 == 0 ? 0.6 : 2;
        ovoid_pair p = {a, b, {random_vec3(&s, 1), random_turn(&s)}, {random_vec3(&s, far), random_turn(&s)}};
        // Some about 1e-7 apart or deep.
        if (i % 4 == 0) {
            ovoid_answer x = ovoid_distance(&p, NULL, NULL);
            double move = -x.lower + 1e-7 * random_uniform(&s, -1, 1);
            ovoid_vec3 n = x.normal, *to = &p.pose_b.position;
            *to = (ovoid_vec3){to->x + move * n.x, to->y + move * n.y, to->z + move * n.z};
        }
        if (CHECK(context && a && b)) check_pair(context, &p, &s);
        if (i % 2) {
            ovoid_pair q = {b, a, p.pose_b, p.pose_a};
            check_pair(context, &q, &s);
        }
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
        judge_destroy(context);
    }
    check_seed = 0;
    check_weights();
    printf("%ld answers accepted, %ld lies refused, %ld directions compared\n", accepted, refused, compared);
    CHECK(refused > (long)rounds && compared > 33 * (long)rounds);
    return check_end();
}
