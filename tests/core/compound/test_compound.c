// Compounds against brute force over all pairs of parts, and every answer through its own check. Truth: the pair query,
// whose brackets are judged elsewhere by exact arithmetic; both brackets hold d, so they must meet, and both are
// narrow.
#include "compounds.h"
#include "proofs/covers.h"

enum { CAPACITY = 40000 };
static ovoid_exclusion items[CAPACITY];
STATIC_COVER(cover);

// Everything that an answer claims.
static void check_answer(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_exclusions *all,
                         bracket truth) {
    ovoid_error error = {.message = ""};
    ovoid_code code = ovoid_body_verify(pair, x, &(ovoid_body_basis){.exclusions = all}, &error);
    if (!CHECK_EQ(code, OVOID_OK)) printf("  %s\n", error.message);
    CHECK_LE(x->lower, truth.upper);
    CHECK_LE(truth.lower, x->upper);
    CHECK_LE(x->lower, x->upper);
    CHECK(x->part_a < get_count(&pair->a) && x->part_b < get_count(&pair->b));
}

static double get_size(const ovoid_body_pair *pair) {
    ovoid_vec3 p = pair->a.pose.position, q = pair->b.pose.position;
    double size = sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z));
    for (int side = 0; side < 2; side++) {
        const ovoid_body *s = side ? &pair->b : &pair->a;
        double most = 0;
        for (size_t i = 0; i < get_count(s); i++) {
            ovoid_body here = *s;
            here.pose = ovoid_pose_make_identity();
            ovoid_posed_shape part = get_part(&here, i);
            ovoid_measures m = ovoid_shape_get_measures(part.shape);
            ovoid_vec3 o = ovoid_shape_get_polytope(part.shape).origin, at = part.pose.position;
            double reach =
                m.sphere_radius + sqrt(m.sphere_center.x * m.sphere_center.x + m.sphere_center.y * m.sphere_center.y +
                                       m.sphere_center.z * m.sphere_center.z);
            most = fmax(most, sqrt(at.x * at.x + at.y * at.y + at.z * at.z) + sqrt(o.x * o.x + o.y * o.y + o.z * o.z) +
                                  reach + ovoid_shape_get_radius(part.shape));
        }
        size += most;
    }
    return size;
}

// All questions about one pair of bodies.
static void check_pair(const ovoid_body_pair *pair, uint64_t *s) {
    bracket truth = find_brute(pair, 1);
    double tolerance = 1.001e-9 * get_size(pair);
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY, .cover = &cover};

    ovoid_body_answer depth = ovoid_body_depth(pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    check_answer(pair, &depth, &all, truth);
    if (depth.limit == OVOID_LIMIT_NONE) CHECK_LE(depth.upper - depth.lower, tolerance);
    CHECK(depth.limit == OVOID_LIMIT_NONE || truth.upper - truth.lower > 1e-12);
    CHECK(all.count <= CAPACITY);

    ovoid_body_answer distance = ovoid_body_distance(pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    check_answer(pair, &distance, &all, truth);
    if (truth.lower > 0) CHECK_LE(distance.upper - distance.lower, tolerance);
    if (truth.lower > 0) CHECK_EQ(distance.status, OVOID_SEPARATED);
    if (truth.upper < 0) CHECK(distance.status == OVOID_OVERLAPPING || truth.upper > -tolerance);

    ovoid_body_answer collide = ovoid_body_collide(pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    check_answer(pair, &collide, &all, truth);
    if (truth.lower > 0) CHECK_EQ(collide.status, OVOID_SEPARATED);
    if (truth.upper < 0) CHECK_EQ(collide.status, OVOID_OVERLAPPING);

    double margin = fmax(truth.lower, 0) * random_uniform(s, 0.5, 2) + tolerance;
    ovoid_body_answer within = ovoid_body_within(pair, margin, NULL, &(ovoid_body_evidence){.exclusions = &all});
    check_answer(pair, &within, &all, truth);
    int is = ovoid_answer_is_within(&within.deciding, margin);
    if (truth.upper <= margin) CHECK(is == 1 || (is == -1 && truth.upper > margin - tolerance));
    if (truth.lower > margin) CHECK(is == 0 || (is == -1 && truth.lower <= margin + tolerance));
    if (is == 1 && fabs(truth.lower) > tolerance) CHECK(within.status != OVOID_UNDECIDED);

    // Again, from what is known; and from nonsense.
    ovoid_body_proof known = {depth.part_a, depth.part_b, depth.deciding.proof};
    ovoid_body_answer again =
        ovoid_body_depth(pair, NULL, &(ovoid_body_evidence){.earlier = &known, .exclusions = &all});
    check_answer(pair, &again, &all, truth);
    CHECK_LE(again.visited, depth.visited);
    known.part_a = (uint32_t)(random_next(s) % (2 * get_count(&pair->a)));
    known.part_b = (uint32_t)random_next(s) % 3;
    again = ovoid_body_distance(pair, NULL, &(ovoid_body_evidence){.earlier = &known, .exclusions = &all});
    check_answer(pair, &again, &all, truth);

    // A cap below the distance: proven farther.
    ovoid_options options = {.cap = 0.5 * truth.lower};
    if (truth.lower > tolerance) {
        again = ovoid_body_distance(pair, &options, &(ovoid_body_evidence){.exclusions = &all});
        check_answer(pair, &again, &all, truth);
        CHECK_LE(options.cap, again.lower);
        CHECK(again.limit == OVOID_LIMIT_CAP || again.limit == OVOID_LIMIT_NONE);
    }
}

static void check_random(int rounds, double scale, uint64_t seed) {
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = seed + (uint64_t)i;
        ovoid_shape *shapes[SHAPES];
        if (!make_shapes(shapes, scale, &s)) return;
        size_t counts[2] = {1 + random_next(&s) % 24, 1 + random_next(&s) % 24};
        double reach = scale * pow(10, random_uniform(&s, -0.5, 1.3));
        ovoid_compound *a = make_compound(shapes, counts[0], reach, &s),
                       *b = make_compound(shapes, counts[1], reach, &s);
        if (CHECK(a && b)) {
            double apart = reach * random_uniform(&s, 0, 4);
            ovoid_body_pair pair = {{.compound = a, .pose = {random_vec3(&s, apart), random_quat(&s)}},
                                    {.compound = b, .pose = {random_vec3(&s, apart), random_quat(&s)}}};
            if (i % 3 == 1) pair.b = (ovoid_body){.shape = shapes[i % SHAPES], .pose = pair.b.pose};
            if (i % 8 == 2) pair.a = (ovoid_body){.shape = shapes[i % SHAPES], .pose = pair.a.pose};
            if (i % 11 == 3) pair.b.pose = pair.a.pose; // identical poses
            check_pair(&pair, &s);
        }
        ovoid_compound_destroy(a);
        ovoid_compound_destroy(b);
        destroy_shapes(shapes);
    }
    check_seed = 0;
}

// ---- named ones

// 10 000 cubes of half size 0.3 at the points of a grid, and a ball: the distance in closed form.
static void check_grid(void) {
    enum { SIDE = 100 };
    ovoid_shape *cube = ovoid_shape_create_box((ovoid_vec3){0.3, 0.3, 0.3}, NULL, NULL);
    ovoid_shape *ball = ovoid_shape_create_sphere(0.25, NULL, NULL);
    ovoid_posed_shape *parts = malloc(sizeof *parts * SIDE * SIDE);
    for (int i = 0; i < SIDE * SIDE; i++) {
        int x = i % SIDE, y = i / SIDE;
        parts[i] = (ovoid_posed_shape){cube, {{x, y, (x * 7 + y * 3) % 5}, {1, 0, 0, 0}}};
    }
    ovoid_compound *grid = ovoid_compound_create(parts, (size_t)SIDE * SIDE, NULL, NULL);
    uint64_t s = 77;
    for (int i = 0; grid && i < 300; i++) {
        check_seed = s;
        ovoid_vec3 at = {random_uniform(&s, -20, 120), random_uniform(&s, -20, 120), random_uniform(&s, -3, 8)};
        double truth = INFINITY;
        for (int k = 0; k < SIDE * SIDE; k++) {
            ovoid_vec3 p = parts[k].pose.position;
            double x = fmax(fabs(at.x - p.x) - 0.3, 0), y = fmax(fabs(at.y - p.y) - 0.3, 0);
            double z = fmax(fabs(at.z - p.z) - 0.3, 0);
            truth = fmin(truth, sqrt(x * x + y * y + z * z) - 0.25);
        }
        ovoid_body_pair pair = {{.compound = grid, .pose = {{0, 0, 0}, {1, 0, 0, 0}}},
                                {.shape = ball, .pose = {at, {0, 3, 4, 0}}}};
        ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
        ovoid_body_answer x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        // With its centre in a cube the ball is deeper than this formula says.
        bracket known = {truth > -0.25 ? truth - 1e-12 : -INFINITY, truth + 1e-12};
        check_answer(&pair, &x, &all, known);
        CHECK_LE(x.visited, 2000);
        x = ovoid_body_collide(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        check_answer(&pair, &x, &all, known);
        CHECK_EQ(x.status, truth > 0 ? OVOID_SEPARATED : OVOID_OVERLAPPING);
    }
    check_seed = 0;
    CHECK(grid != NULL);
    ovoid_compound_destroy(grid);
    free(parts);
    ovoid_shape_destroy(cube);
    ovoid_shape_destroy(ball);
}

// A cup of five walls: what is in it touches nothing; moved by exactly the gap it touches, a little on it overlaps by
// what it was moved. Truth: the gaps by construction, in binary fractions, so that nothing is rounded.
static void check_cup(void) {
    ovoid_shape *halfspace = ovoid_shape_create_box((ovoid_vec3){0.25, 2, 2}, NULL, NULL);
    ovoid_shape *floor = ovoid_shape_create_box((ovoid_vec3){2, 2, 0.25}, NULL, NULL);
    ovoid_shape *ball = ovoid_shape_create_box((ovoid_vec3){0.5, 0.5, 0.5}, NULL, NULL);
    const ovoid_quat none = {1, 0, 0, 0}, quarter = {1, 0, 0, 1};
    ovoid_posed_shape parts[5] = {{halfspace, {{2, 0, 0}, none}},
                                  {halfspace, {{-2, 0, 0}, none}},
                                  {halfspace, {{0, 2, 0}, quarter}},
                                  {halfspace, {{0, -2, 0}, quarter}},
                                  {floor, {{0, 0, -2}, none}}};
    ovoid_compound *cup = ovoid_compound_create(parts, 5, NULL, NULL);
    ovoid_posed_shape inside = {ball, {{0, 0, 0}, none}};
    ovoid_compound *one = ovoid_compound_create(&inside, 1, NULL, NULL);
    // Free space: from 0.5 to 1.75 along x. The second number is the gap.
    static const double moves[6][2] = {{0, 1.25}, {1, 0.25}, {1.25, 0}, {1.5, -0.25}, {-1.25, 0}, {-1.125, 0.125}};
    for (int i = 0; cup && one && i < 6; i++)
        for (int as_shape = 0; as_shape < 2; as_shape++) {
            ovoid_body_pair pair = {{.compound = cup, .pose = {{0, 0, 0}, none}},
                                    {.compound = one, .pose = {{moves[i][0], 0, 0}, none}}};
            if (as_shape) pair.b.shape = ball, pair.b.compound = NULL;
            ovoid_exclusions all = {.items = items, .capacity = CAPACITY, .cover = &cover};
            ovoid_body_answer x = ovoid_body_depth(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
            double gap = moves[i][1];
            check_answer(&pair, &x, &all, (bracket){gap, gap});
            CHECK_NEAR(x.upper, gap, 1e-8);
            CHECK_EQ(x.status, gap > 0 ? OVOID_SEPARATED : gap < 0 ? OVOID_OVERLAPPING : OVOID_TOUCHING);
            if (i) CHECK_EQ(x.part_a, moves[i][0] > 0 ? 0 : 1);
            x = ovoid_body_collide(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
            check_answer(&pair, &x, &all, (bracket){gap, gap});
            CHECK_EQ(x.status, gap > 0 ? OVOID_SEPARATED : gap < 0 ? OVOID_OVERLAPPING : OVOID_TOUCHING);
        }
    CHECK(cup && one);
    ovoid_compound_destroy(cup);
    ovoid_compound_destroy(one);
    ovoid_shape_destroy(halfspace);
    ovoid_shape_destroy(floor);
    ovoid_shape_destroy(ball);
}

// ---- what "touching" means

// Two boxes, one 1 apart from a third body and one far away: of a true bracket around 0 the options decide. The
// relative tolerance is of the bodies' size, not of the deciding parts'.
static void check_touching(void) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_posed_shape parts[2] = {{box, {{0, 0, 0}, {1, 0, 0, 0}}}, {box, {{0, 100, 0}, {1, 0, 0, 0}}}};
    ovoid_compound *c = ovoid_compound_create(parts, 2, NULL, NULL);
    const ovoid_body_pair pair = {{.compound = c, .pose = parts[0].pose},
                                  {.shape = box, .pose = {{3, 0, 0}, {1, 0, 0, 0}}}};
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
    ovoid_body_answer x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    CHECK_EQ(x.status, OVOID_SEPARATED);
    x.deciding.proof.normal = x.deciding.normal = (ovoid_vec3){0.8, 0.6, 0};
    x.deciding.lower = -0.5;
    x.deciding.limit = OVOID_LIMIT_PRECISION;
    x.deciding.status = OVOID_UNDECIDED;
    x = ovoid_body_answer_make(&x.deciding, x.part_a, x.part_b);
    CHECK_EQ(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_OK);
    x.deciding.status = x.status = OVOID_TOUCHING;
    CHECK_EQ(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_ERROR_PROOF);
    double width = x.upper - x.lower, size = 100 + 2 * sqrt(3) + 3;
    for (int i = 0; i < 4; i++) {
        double share = i % 2 ? 1 + 1e-9 : 1 - 1e-9;
        ovoid_options o = {0};
        *(i / 2 ? &o.relative_tolerance : &o.absolute_tolerance) = share * (i / 2 ? width / size : width);
        CHECK_EQ(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.options = &o, .exclusions = &all}, NULL) == OVOID_OK,
                 i % 2);
    }
    ovoid_compound_destroy(c);
    ovoid_shape_destroy(box);
}

// ---- what is refused

static void expect_refused(const ovoid_body_pair *pair, const ovoid_options *options, ovoid_limit limit) {
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY, .count = 7};
    ovoid_body_answer x = ovoid_body_distance(pair, options, &(ovoid_body_evidence){.exclusions = &all});
    CHECK_EQ(x.limit, limit);
    CHECK(x.status == OVOID_UNDECIDED && x.lower == -INFINITY && x.upper == INFINITY);
    CHECK_EQ(all.count, 0);
    CHECK_EQ(ovoid_body_verify(pair, &x, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_OK);
    // An answer where there can be none.
    x.lower = 1;
    x.status = OVOID_SEPARATED;
    CHECK_EQ(ovoid_body_verify(pair, &x, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_ERROR_PROOF);
}

static void check_refused(void) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_posed_shape parts[2] = {{box, {{0, 0, 0}, {1, 0, 0, 0}}}, {box, {{5, 0, 0}, {1, 0, 0, 0}}}};
    ovoid_compound *c = ovoid_compound_create(parts, 2, NULL, NULL);
    const ovoid_body_pair sound = {{.compound = c, .pose = parts[0].pose},
                                   {.shape = box, .pose = {{9, 0, 0}, {1, 0, 0, 0}}}};
    ovoid_body_pair pair = sound;
    pair.a.pose.rotation = (ovoid_quat){0, 0, 0, 0};
    expect_refused(&pair, NULL, OVOID_LIMIT_POSE_A);
    pair.a.pose.rotation.w = NAN;
    expect_refused(&pair, NULL, OVOID_LIMIT_POSE_A);
    pair = sound;
    pair.b.pose.position.z = INFINITY;
    expect_refused(&pair, NULL, OVOID_LIMIT_POSE_B);
    pair.b.pose.position.z = 2e50;
    expect_refused(&pair, NULL, OVOID_LIMIT_POSE_B);
    pair = sound;
    // In range itself, not so its parts.
    pair.a.pose.position = (ovoid_vec3){0.9e50, 0.9e50, 0};
    expect_refused(&pair, NULL, OVOID_LIMIT_POSE_A);
    static const ovoid_options wrong[4] = {
        {.absolute_tolerance = -1}, {.relative_tolerance = NAN}, {.cap = -1}, {.cap = NAN}};
    for (int i = 0; i < 4; i++) expect_refused(&sound, &wrong[i], OVOID_LIMIT_OPTIONS);
    ovoid_body_answer x = ovoid_body_within(&sound, -1, NULL, NULL);
    CHECK_EQ(x.limit, OVOID_LIMIT_OPTIONS);
    x = ovoid_body_within(&sound, NAN, NULL, NULL);
    CHECK_EQ(x.limit, OVOID_LIMIT_OPTIONS);
    // A warm start made of nonsense.
    ovoid_body_proof nonsense = {1, 0, {.kind = OVOID_PROOF_POINTS, .count = 77, .normal = {NAN, 1e300, 0}}};
    x = ovoid_body_distance(&sound, NULL, &(ovoid_body_evidence){.earlier = &nonsense});
    CHECK_NEAR(x.upper, 2, 1e-8);
    ovoid_compound_destroy(c);
    ovoid_shape_destroy(box);
}

int main(void) {
    check_grid();
    check_cup();
    check_touching();
    check_refused();
    check_random(60, 1, 100);
    check_random(15, 1e-9, 1000);
    check_random(15, 1e9, 2000);
    return check_end();
}
