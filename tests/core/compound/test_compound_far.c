// Bodies so far apart that the balls around them answer. Truth: the distance query, whose proof is checked; of single
// balls the distance itself, in long double.
#include "extended.h"
#include "worlds.h"

typedef ovoid_body_answer ask(const ovoid_body_pair *pair, double margin, ovoid_exclusions *all);

static ovoid_body_answer ask_collide(const ovoid_body_pair *pair, double margin, ovoid_exclusions *all) {
    (void)margin;
    return ovoid_body_collide(pair, NULL, &(ovoid_body_evidence){.exclusions = all});
}
static ovoid_body_answer ask_within(const ovoid_body_pair *pair, double margin, ovoid_exclusions *all) {
    return ovoid_body_within(pair, margin, NULL, &(ovoid_body_evidence){.exclusions = all});
}
static ovoid_body_answer ask_capped(const ovoid_body_pair *pair, double margin, ovoid_exclusions *all) {
    return ovoid_body_distance(pair, &(ovoid_options){.cap = margin}, &(ovoid_body_evidence){.exclusions = all});
}
static ask *const asks[] = {ask_collide, ask_within, ask_capped};

static int first_looks;

// The answer holds, and its proof; one exclusion of all parts shows it where no pair of parts was asked.
static void check_answer(const ovoid_body_pair *pair, ask *how, double margin, double lower, double upper) {
    ovoid_exclusion items[512];
    ovoid_exclusions all = {.items = items, .capacity = 512};
    ovoid_body_answer x = how(pair, margin, &all), same = how(pair, margin, NULL);
    ovoid_error error = {0};
    if (!CHECK(ovoid_body_verify(pair, &x, &(ovoid_body_basis){.exclusions = &all}, &error) == OVOID_OK))
        printf("  %s\n", error.message);
    CHECK(x.lower <= upper && lower <= x.upper);
    CHECK(same.lower == x.lower && same.upper == x.upper);
    if (x.tested) return;
    first_looks++;
    CHECK(x.status == OVOID_SEPARATED && x.deciding.stage == OVOID_STAGE_SPHERE && x.visited == 1);
    CHECK(all.count == 1 && items[0].first_a == 0 && items[0].first_b == 0);
    ovoid_limit beyond = how == ask_capped ? OVOID_LIMIT_CAP : OVOID_LIMIT_ANSWERED;
    CHECK(x.limit == (x.upper - x.lower < 1e-9 ? OVOID_LIMIT_NONE : beyond));
    // The points are at the upper bound's distance.
    ovoid_vec3 d = {x.deciding.point_b.x - x.deciding.point_a.x, x.deciding.point_b.y - x.deciding.point_a.y,
                    x.deciding.point_b.z - x.deciding.point_a.z};
    CHECK_NEAR(sqrt(d.x * d.x + d.y * d.y + d.z * d.z), x.upper, 1e-12 * (1 + x.upper) + 1e-5);
    // Room for no exclusion changes nothing but that.
    ovoid_exclusions none = {.items = NULL};
    ovoid_body_answer without = how(pair, margin, &none);
    CHECK(none.count == 1 && without.lower == x.lower);
}

static void test_compounds(uint64_t seed) {
    uint64_t s = check_seed = seed;
    ovoid_shape *shapes[WORLD_SHAPES];
    world_make_shapes(&s, 1, shapes);
    ovoid_compound *c[2] = {world_make_compound(&s, shapes, 1), world_make_compound(&s, shapes, 1)};
    for (int k = 0; k < 60; k++) {
        double far = exp(random_uniform(&s, log(3), log(60))), place = k % 4 ? 1 : 1e5;
        ovoid_pose at_a = {random_place(&s, place), random_quat(&s)}, at_b = {at_a.position, random_quat(&s)};
        ovoid_vec3 way = random_place(&s, far);
        at_b.position = (ovoid_vec3){at_b.position.x + way.x, at_b.position.y + way.y, at_b.position.z + way.z};
        ovoid_body_pair pair = {{.compound = c[0], .pose = at_a}, {.compound = c[1], .pose = at_b}};
        if (k % 3 == 1) pair.a = (ovoid_body){.shape = shapes[k % WORLD_SHAPES], .pose = at_a};
        if (k % 3 == 2) pair.b = (ovoid_body){.shape = shapes[k % WORLD_SHAPES], .pose = at_b};
        ovoid_answer truth = ovoid_body_distance(&pair, NULL, NULL).deciding;
        double margin = fmax(truth.lower, 0.1) * random_uniform(&s, 0.2, 1.1);
        for (int i = 0; i < 3; i++) check_answer(&pair, asks[i], margin, truth.lower, truth.upper);
    }
    ovoid_compound_destroy(c[0]);
    ovoid_compound_destroy(c[1]);
    world_destroy_shapes(shapes);
}

// Compounds of one ball each: the balls around the roots are no larger than they.
static void test_balls(uint64_t seed) {
    uint64_t s = check_seed = seed;
    double ra = random_uniform(&s, 0.1, 5), rb = random_uniform(&s, 0.1, 5);
    ovoid_shape *balls[2] = {ovoid_shape_create_sphere(ra, NULL, NULL), ovoid_shape_create_sphere(rb, NULL, NULL)};
    ovoid_posed_shape parts[2] = {{balls[0], {{0, 0, 0}, {1, 0, 0, 0}}}, {balls[1], {{0, 0, 0}, {1, 0, 0, 0}}}};
    ovoid_compound *c[2] = {ovoid_compound_create(&parts[0], 1, NULL, NULL),
                            ovoid_compound_create(&parts[1], 1, NULL, NULL)};
    ovoid_vec3 at = random_place(&s, 10), way = random_place(&s, 1);
    double size = sqrt(way.x * way.x + way.y * way.y + way.z * way.z), gap = exp(random_uniform(&s, log(1e-9), 0));
    double more = (ra + rb + gap) / size;
    ovoid_vec3 to = {at.x + more * way.x, at.y + more * way.y, at.z + more * way.z};
    extended3 d = extended3_sub(extended3_from(to), extended3_from(at));
    long double truth = extended3_norm(d) - ra - rb;
    ovoid_body_pair pair = {{.compound = c[0], .pose = {at, random_quat(&s)}},
                            {.compound = c[1], .pose = {to, random_quat(&s)}}};
    ovoid_body_answer x = ovoid_body_collide(&pair, NULL, NULL);
    CHECK(x.lower <= truth && truth <= x.upper);
    CHECK(x.tested == 0 || gap < 1e-6);
    // A margin that is more than the gap is met, one that is less is not.
    CHECK(ovoid_body_within(&pair, gap * (1 + 1e-6) + 1e-12, NULL, NULL).lower <= gap * (1 + 1e-6));
    for (int i = 0; i < 3; i++) check_answer(&pair, asks[i], 0.5 * gap, (double)truth - 1e-14, (double)truth + 1e-14);
    for (int i = 0; i < 2; i++) ovoid_compound_destroy(c[i]), ovoid_shape_destroy(balls[i]);
}

int main(void) {
    for (uint64_t seed = 1; seed <= 40; seed++) test_compounds(seed);
    if (!EXTENDED) check_skip("long double has no more digits than double here");
    for (uint64_t seed = 1; EXTENDED && seed <= 300; seed++) test_balls(seed);
    CHECK_LE(1000, first_looks);
    return check_end();
}
