// Compounds against brute force over all pairs of parts, and every answer through its own check. Truth: the pair query,
// whose brackets are judged elsewhere by exact arithmetic; both brackets hold d, so they must meet, and both are
// narrow.
#include "compounds.h"

enum { CAPACITY = 40000 };
static ovoid_exclusion items[CAPACITY];
static ovoid_cover cover;

// Everything that an answer claims.
static void check_answer(const ovoid_solid_pair *pair, const ovoid_compound_answer *x, const ovoid_exclusions *all,
                         bracket truth) {
    ovoid_error error = {.message = ""};
    ovoid_code code = ovoid_compound_answer_check(pair, x, all, &error);
    if (!CHECK_EQ(code, OVOID_OK)) printf("  %s\n", error.message);
    CHECK_LE(x->answer.lower, truth.upper);
    CHECK_LE(truth.lower, x->answer.upper);
    CHECK_LE(x->answer.lower, x->answer.upper);
    CHECK(x->part_a < get_count(&pair->a) && x->part_b < get_count(&pair->b));
}

static double get_size(const ovoid_solid_pair *pair) {
    ovoid_vec3 p = pair->a.pose.position, q = pair->b.pose.position;
    double size = sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z));
    for (int side = 0; side < 2; side++) {
        const ovoid_solid *s = side ? &pair->b : &pair->a;
        double most = 0;
        for (size_t i = 0; i < get_count(s); i++) {
            ovoid_solid here = *s;
            here.pose = ovoid_pose_make_identity();
            ovoid_body part = get_part(&here, i);
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

// All questions about one pair of solids.
static void check_pair(const ovoid_solid_pair *pair, uint64_t *s) {
    bracket truth = find_brute(pair, 1);
    double tolerance = 1.001e-9 * get_size(pair);
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY, .cover = &cover};

    ovoid_compound_answer depth = ovoid_compound_depth(pair, NULL, NULL, &all);
    check_answer(pair, &depth, &all, truth);
    if (depth.answer.limit == OVOID_LIMIT_NONE) CHECK_LE(depth.answer.upper - depth.answer.lower, tolerance);
    CHECK(depth.answer.limit == OVOID_LIMIT_NONE || truth.upper - truth.lower > 1e-12);
    CHECK(all.count <= CAPACITY);

    ovoid_compound_answer distance = ovoid_compound_distance(pair, NULL, NULL, &all);
    check_answer(pair, &distance, &all, truth);
    if (truth.lower > 0) CHECK_LE(distance.answer.upper - distance.answer.lower, tolerance);
    if (truth.lower > 0) CHECK_EQ(distance.answer.status, OVOID_SEPARATED);
    if (truth.upper < 0) CHECK(distance.answer.status == OVOID_OVERLAPPING || truth.upper > -tolerance);

    ovoid_compound_answer collide = ovoid_compound_collide(pair, NULL, NULL, &all);
    check_answer(pair, &collide, &all, truth);
    if (truth.lower > 0) CHECK_EQ(collide.answer.status, OVOID_SEPARATED);
    if (truth.upper < 0) CHECK_EQ(collide.answer.status, OVOID_OVERLAPPING);

    double margin = fmax(truth.lower, 0) * random_uniform(s, 0.5, 2) + tolerance;
    ovoid_compound_answer within = ovoid_compound_within(pair, margin, NULL, NULL, &all);
    check_answer(pair, &within, &all, truth);
    int is = ovoid_answer_is_within(&within.answer, margin);
    if (truth.upper <= margin) CHECK(is == 1 || (is == -1 && truth.upper > margin - tolerance));
    if (truth.lower > margin) CHECK(is == 0 || (is == -1 && truth.lower <= margin + tolerance));
    if (is == 1 && fabs(truth.lower) > tolerance) CHECK(within.answer.status != OVOID_UNDECIDED);

    // Again, from what is known; and from nonsense.
    ovoid_compound_proof known = {depth.part_a, depth.part_b, depth.answer.proof};
    ovoid_compound_answer again = ovoid_compound_depth(pair, NULL, &known, &all);
    check_answer(pair, &again, &all, truth);
    CHECK_LE(again.visited, depth.visited);
    known.part_a = (uint32_t)(random_next(s) % (2 * get_count(&pair->a)));
    known.part_b = (uint32_t)random_next(s) % 3;
    again = ovoid_compound_distance(pair, NULL, &known, &all);
    check_answer(pair, &again, &all, truth);

    // A cap below the distance: proven farther.
    ovoid_options options = {.cap = 0.5 * truth.lower};
    if (truth.lower > tolerance) {
        again = ovoid_compound_distance(pair, &options, NULL, &all);
        check_answer(pair, &again, &all, truth);
        CHECK_LE(options.cap, again.answer.lower);
        CHECK(again.answer.limit == OVOID_LIMIT_CAP || again.answer.limit == OVOID_LIMIT_NONE);
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
            ovoid_solid_pair pair = {{NULL, a, {random_vec3(&s, apart), random_quat(&s)}},
                                     {NULL, b, {random_vec3(&s, apart), random_quat(&s)}}};
            if (i % 3 == 1) pair.b = (ovoid_solid){shapes[i % SHAPES], NULL, pair.b.pose};
            if (i % 8 == 2) pair.a = (ovoid_solid){shapes[i % SHAPES], NULL, pair.a.pose};
            if (i % 11 == 3) pair.b.pose = pair.a.pose; // identical poses
            check_pair(&pair, &s);
        }
        ovoid_compound_destroy(a);
        ovoid_compound_destroy(b);
        destroy_shapes(shapes);
    }
    check_seed = 0;
}

int main(void) {
    check_random(60, 1, 100);
    check_random(15, 1e-9, 1000);
    check_random(15, 1e9, 2000);
    return check_end();
}
