// Collision matrices. Truth: balls and rods whose contact has a closed form in the joints' limits; random robots in
// states of their own, at corners of the limits too: no pair that is said to be never in contact is ever hit, none that
// always is ever free; the states that are handed out as proofs are asked again by a checker.
#include "check.h"
#include "countdown.h"
#include "robots.h"

#include "ovoid/robot_matrix.h"

enum { SHAPES = 4, NEARS = 4000 };
static ovoid_shape *shapes[SHAPES];
static ovoid_robot_near near_items[NEARS];
static ovoid_error error;
static long of_touch[7];

static void make_shapes(void) {
    shapes[0] = ovoid_shape_create_box((ovoid_vec3){0.3, 0.1, 0.2}, NULL, &error);
    shapes[1] = ovoid_shape_create_sphere(0.25, NULL, &error);
    shapes[2] = ovoid_shape_create_capsule(0.1, 0.5, NULL, &error);
    shapes[3] = ovoid_shape_create_cylinder(0.2, 0.2, NULL, &error);
    for (int i = 0; i < SHAPES; i++)
        if (!shapes[i]) exit(1);
}

static ovoid_robot_matrix *make_matrix(const ovoid_robot_description *d, const ovoid_robot_matrix_options *options) {
    ovoid_robot *r = ovoid_robot_create(d, NULL, &error);
    if (!r) printf("%s\n", error.message), exit(1);
    ovoid_robot_matrix *m = ovoid_robot_matrix_create(r, options, &error);
    if (!m) printf("%s\n", error.message), exit(1);
    ovoid_robot_destroy(r);
    return m;
}

// ---- closed forms

static const ovoid_robot_link links[] = {{"base"}, {"a"}, {"b"}, {"c"}};

static ovoid_robot_joint make_hinge(const char *name, uint32_t child, ovoid_vec3 at, double lower, double upper) {
    return (ovoid_robot_joint){.name = name,
                               .type = OVOID_JOINT_REVOLUTE,
                               .child = child,
                               .origin = {at, {1, 0, 0, 0}},
                               .axis = {0, 0, 1},
                               .lower = lower,
                               .upper = upper,
                               .mimic = OVOID_ROBOT_NONE,
                               .multiplier = 1};
}

static ovoid_robot_matrix_pair find(const ovoid_robot_matrix *m, uint32_t a, uint32_t b) {
    const ovoid_robot_matrix_pair *p = ovoid_robot_matrix_find_pair(m, a, b);
    if (!p) exit(1);
    return *p;
}

// A ball of radius 1/4 at distance 1 from the axis, and one that stays at angle 0: they touch where 2 sin |angle / 2|
// is at most 1/2, so up to 2 asin 1/4.
static ovoid_robot_touch ask_balls(double lower, double upper, ovoid_joint_type type) {
    ovoid_robot_joint hinge = make_hinge("j", 1, (ovoid_vec3){0, 0, 0}, lower, upper);
    hinge.type = type;
    ovoid_robot_element balls[] = {{0, NULL, shapes[1], {{1, 0, 0}, {1, 0, 0, 0}}, NULL},
                                   {1, NULL, shapes[1], {{1, 0, 0}, {1, 0, 0, 0}}, NULL}};
    ovoid_robot_description d = {
        .links = links, .link_count = 2, .joints = &hinge, .joint_count = 1, .elements = balls, .element_count = 2};
    ovoid_robot_matrix *m = make_matrix(&d, NULL);
    ovoid_robot_matrix_pair p = find(m, 1, 0);
    CHECK_EQ(ovoid_robot_matrix_get_count(m), 1);
    CHECK_EQ(p.a, 0);
    CHECK_EQ(p.is_neighbour, 1);
    double bound = 2 * asin(0.25);
    if (p.hit) CHECK(cos(*p.hit) >= cos(bound) && *p.hit >= lower && *p.hit <= upper);
    if (p.free) CHECK(cos(*p.free) <= cos(bound) && *p.free >= lower && *p.free <= upper);
    ovoid_robot_matrix_destroy(m);
    return p.touch;
}

static void test_balls(void) {
    const double bound = 2 * asin(0.25), a_little = 1e-9;
    CHECK_EQ(ask_balls(bound + a_little, 2, OVOID_JOINT_REVOLUTE), OVOID_ROBOT_TOUCH_NEVER);
    CHECK_EQ(ask_balls(-4, -bound - a_little, OVOID_JOINT_REVOLUTE), OVOID_ROBOT_TOUCH_NEVER);
    CHECK_EQ(ask_balls(bound - a_little, 2, OVOID_JOINT_REVOLUTE), OVOID_ROBOT_TOUCH_SOMETIMES);
    CHECK_EQ(ask_balls(-bound + a_little, bound - a_little, OVOID_JOINT_REVOLUTE), OVOID_ROBOT_TOUCH_ALWAYS);
    CHECK_EQ(ask_balls(-bound + a_little, bound + a_little, OVOID_JOINT_REVOLUTE), OVOID_ROBOT_TOUCH_SOMETIMES);
    CHECK_EQ(ask_balls(-4, 4, OVOID_JOINT_REVOLUTE), OVOID_ROBOT_TOUCH_SOMETIMES);
    // One place is a box, too.
    CHECK_EQ(ask_balls(1, 1, OVOID_JOINT_REVOLUTE), OVOID_ROBOT_TOUCH_NEVER);
    CHECK_EQ(ask_balls(0.1, 0.1, OVOID_JOINT_REVOLUTE), OVOID_ROBOT_TOUCH_ALWAYS);
}

// The moving ball never comes to a ball that is a quarter behind it, but where a whole turn is allowed it does.
static void test_angles(void) {
    const double pi = 3.14159265358979324;
    CHECK_EQ(ask_balls(0.6, 2 * pi - 0.6, OVOID_JOINT_REVOLUTE), OVOID_ROBOT_TOUCH_NEVER);
    CHECK_EQ(ask_balls(0.6, 2 * pi - 0.5, OVOID_JOINT_REVOLUTE), OVOID_ROBOT_TOUCH_SOMETIMES);
    CHECK_EQ(ask_balls(-INFINITY, INFINITY, OVOID_JOINT_CONTINUOUS), OVOID_ROBOT_TOUCH_SOMETIMES);
}

// Two rods on one base, of length 1 and radius 1/10, that point at each other where both angles are 0: there they are
// `gap` apart, and nowhere nearer.
static ovoid_robot_matrix *make_rods(double gap, ovoid_robot_description *d) {
    static ovoid_robot_joint hinges[2];
    static ovoid_robot_element rods[2];
    hinges[0] = make_hinge("j", 1, (ovoid_vec3){0, 0, 0}, -0.75, 1);
    hinges[1] = make_hinge("k", 2, (ovoid_vec3){2.2 + gap, 0, 0}, -1, 1);
    ovoid_quat along_x = {1, 0, 1, 0}; // capsules are along z
    rods[0] = (ovoid_robot_element){1, NULL, shapes[2], {{0.5, 0, 0}, along_x}, NULL};
    rods[1] = (ovoid_robot_element){2, NULL, shapes[2], {{-0.5, 0, 0}, along_x}, NULL};
    *d = (ovoid_robot_description){
        .links = links, .link_count = 3, .joints = hinges, .joint_count = 2, .elements = rods, .element_count = 2};
    return make_matrix(d, &(ovoid_robot_matrix_options){.samples = 100});
}

// A rod that turns about the middle of another touches it at any angle; the axis lies in both all the while, so that
// one cell proves it. Where the axis is beside the second rod, they touch in some states and not in others.
static void test_pivot(void) {
    ovoid_robot_joint hinge = make_hinge("j", 1, (ovoid_vec3){0, 0, 0}, -3, 3);
    ovoid_quat along_x = {1, 0, 1, 0};
    for (int i = 0; i < 2; i++) {
        ovoid_robot_element rods[] = {{0, NULL, shapes[2], {{0, 0, 0}, along_x}, NULL},
                                      {1, NULL, shapes[2], {{0, i ? 0.65 : 0, 0}, along_x}, NULL}};
        ovoid_robot_description d = {
            .links = links, .link_count = 2, .joints = &hinge, .joint_count = 1, .elements = rods, .element_count = 2};
        ovoid_robot_matrix *m = make_matrix(&d, NULL);
        ovoid_robot_matrix_pair p = find(m, 0, 1);
        CHECK_EQ(p.touch, i ? OVOID_ROBOT_TOUCH_SOMETIMES : OVOID_ROBOT_TOUCH_ALWAYS);
        CHECK_EQ(p.cells, i ? 0 : 1);
        ovoid_robot_matrix_destroy(m);
    }
}

static void test_rods(void) {
    ovoid_robot_description d;
    static const double gaps[] = {1, 0.1, 0.01, -0.02, -0.001};
    for (size_t i = 0; i < sizeof gaps / sizeof *gaps; i++) {
        ovoid_robot_matrix *m = make_rods(gaps[i], &d);
        ovoid_robot_matrix_pair p = find(m, 1, 2);
        // The last overlap is a millionth of the box.
        int is_right = p.touch == (gaps[i] > 0 ? OVOID_ROBOT_TOUCH_NEVER : OVOID_ROBOT_TOUCH_SOMETIMES);
        if (!CHECK(is_right)) printf("  gap %g, %zu cells\n", gaps[i], p.cells);
        CHECK(p.cells < 1000);
        // The base has no geometry, so nothing is between them.
        CHECK_EQ(p.is_neighbour, 1);
        CHECK(!ovoid_robot_matrix_find_pair(m, 0, 1));
        CHECK(!ovoid_robot_matrix_find_pair(m, 1, 1));
        ovoid_robot_matrix_destroy(m);
    }
}

// ---- what is neither proven nor queried

static ovoid_robot_touch ask_kind(ovoid_joint_type type, uint32_t mimic, size_t budget) {
    ovoid_robot_joint joints[3] = {make_hinge("j", 1, (ovoid_vec3){0, 0, 0}, -1, 1),
                                   make_hinge("k", 2, (ovoid_vec3){0, 0, 0}, 0.6, 2),
                                   make_hinge("l", 3, (ovoid_vec3){0, 0, 1}, -1, 1)};
    joints[0].type = type == OVOID_JOINT_CONTINUOUS ? type : OVOID_JOINT_REVOLUTE;
    joints[1].type = type == OVOID_JOINT_CONTINUOUS ? OVOID_JOINT_REVOLUTE : type;
    joints[1].mimic = mimic;
    joints[2].parent = 2;
    joints[2].type = OVOID_JOINT_FIXED;
    ovoid_robot_element balls[] = {{0, NULL, shapes[1], {{1, 0, 0}, {1, 0, 0, 0}}, NULL},
                                   {2, NULL, shapes[1], {{1, 0, 5}, {1, 0, 0, 0}}, NULL},
                                   {3, NULL, shapes[1], {{1, 0, 5}, {1, 0, 0, 0}}, NULL}};
    ovoid_robot_description d = {
        .links = links, .link_count = 4, .joints = joints, .joint_count = 3, .elements = balls, .element_count = 3};
    ovoid_robot_matrix *m = make_matrix(&d, &(ovoid_robot_matrix_options){.budget = budget});
    CHECK_EQ(ovoid_robot_matrix_get_count(m), 3);
    ovoid_robot_matrix_pair p = find(m, 0, 2), fixed = find(m, 2, 3);
    CHECK_EQ(fixed.touch, OVOID_ROBOT_TOUCH_RIGID);
    CHECK_EQ(fixed.samples, 0);
    CHECK(strcmp(ovoid_robot_matrix_pair_get_reason(&fixed, 0), "Adjacent") == 0);
    ovoid_robot_matrix_destroy(m);
    return p.touch;
}

static void test_kinds(void) {
    CHECK_EQ(ask_kind(OVOID_JOINT_REVOLUTE, OVOID_ROBOT_NONE, 0), OVOID_ROBOT_TOUCH_NEVER);
    CHECK_EQ(ask_kind(OVOID_JOINT_PLANAR, OVOID_ROBOT_NONE, 0), OVOID_ROBOT_TOUCH_OPEN);
    CHECK_EQ(ask_kind(OVOID_JOINT_FLOATING, OVOID_ROBOT_NONE, 0), OVOID_ROBOT_TOUCH_OPEN);
    CHECK_EQ(ask_kind(OVOID_JOINT_REVOLUTE, 0, 0), OVOID_ROBOT_TOUCH_NEVER);
    // What follows a continuous joint turns on and on.
    CHECK_EQ(ask_kind(OVOID_JOINT_CONTINUOUS, 0, 0), OVOID_ROBOT_TOUCH_OPEN);
    CHECK_EQ(ask_kind(OVOID_JOINT_CONTINUOUS, OVOID_ROBOT_NONE, 0), OVOID_ROBOT_TOUCH_NEVER);
}

static void test_reasons(void) {
    ovoid_robot_matrix_pair p = {.touch = OVOID_ROBOT_TOUCH_SAMPLED_NEVER};
    CHECK(!ovoid_robot_matrix_pair_get_reason(&p, 0));
    CHECK(strcmp(ovoid_robot_matrix_pair_get_reason(&p, 1), "Never") == 0);
    p.touch = OVOID_ROBOT_TOUCH_SAMPLED_ALWAYS;
    CHECK(!ovoid_robot_matrix_pair_get_reason(&p, 0));
    CHECK(strcmp(ovoid_robot_matrix_pair_get_reason(&p, 1), "Always") == 0);
    p.touch = OVOID_ROBOT_TOUCH_SOMETIMES;
    CHECK(!ovoid_robot_matrix_pair_get_reason(&p, 1));
    p.is_neighbour = 1;
    CHECK(strcmp(ovoid_robot_matrix_pair_get_reason(&p, 0), "Adjacent") == 0);
    CHECK(strcmp(ovoid_robot_touch_get_name(OVOID_ROBOT_TOUCH_RIGID), "rigid") == 0);
    CHECK(strcmp(ovoid_robot_touch_get_name((ovoid_robot_touch)7), "unknown") == 0);
}

// ---- random robots

typedef struct scene {
    random_robot a;
    ovoid_robot_pair disabled;
    ovoid_robot *r;
    ovoid_robot_cell *cell;
    ovoid_robot_checker *checker;
    ovoid_robot_matrix *m;
} scene;

// Limits that are narrow or one place, so that all kinds of pairs come about. The disabled pair has no effect.
static void make_scene(uint64_t *s, scene *c) {
    make_random_robot(s, &c->a);
    size_t count = 0, most = c->a.d.link_count < 10 ? c->a.d.link_count : 10;
    for (uint32_t i = 0; i < most; i++) {
        ovoid_robot_joint *j = &c->a.joints[i];
        if (random_below(s, 2)) j->lower = random_uniform(s, -1, 0), j->upper = j->lower + random_uniform(s, 0, 0.5);
        if (random_below(s, 2) && j->type > OVOID_JOINT_PRISMATIC && j->mimic == OVOID_ROBOT_NONE)
            j->type = OVOID_JOINT_REVOLUTE;
        for (uint32_t k = random_below(s, 3); k-- > 0;)
            c->a.elements[count++] =
                (ovoid_robot_element){i, NULL, shapes[random_below(s, SHAPES)], random_pose(s, 0.1), NULL};
    }
    c->a.d.element_count = count;
    c->r = ovoid_robot_create(&c->a.d, NULL, &error);
    c->cell = ovoid_robot_cell_create(c->r, NULL, &error);
    c->checker = c->cell ? ovoid_robot_checker_create(c->cell, NULL, &error) : NULL;
    if (!c->checker) printf("%s\n", error.message), exit(1);
    c->disabled = (ovoid_robot_pair){0, 1, NULL};
    ovoid_robot_description d = c->a.d;
    d.disabled = &c->disabled, d.disabled_count = 1;
    c->m = make_matrix(&d, &(ovoid_robot_matrix_options){.samples = 300, .budget = 400, .seed = random_next(s)});
}

static void destroy_scene(scene *c) {
    ovoid_robot_matrix_destroy(c->m);
    ovoid_robot_checker_destroy(c->checker);
    ovoid_robot_cell_destroy(c->cell);
    ovoid_robot_destroy(c->r);
}

// The least upper bound and the least lower bound of the distance of two links in a state; 1 and 1: apart.
static void measure(const scene *c, const double *q, double slack, const ovoid_robot_matrix_pair *p, double *lower,
                    double *upper) {
    ovoid_robot_nears nears = {.items = near_items, .capacity = NEARS};
    ovoid_robot_query_options options = {.limit_slack = slack};
    *lower = *upper = 1;
    CHECK_EQ(ovoid_robot_find_near(c->checker, &(ovoid_robot_query){q, &options}, &nears, &error), OVOID_OK);
    CHECK_LE(nears.count, (size_t)NEARS);
    for (size_t i = 0; i < nears.count; i++) {
        if (near_items[i].a.link != p->a || near_items[i].b.link != p->b) continue;
        *lower = near_items[i].lower < *lower ? near_items[i].lower : *lower;
        *upper = near_items[i].upper < *upper ? near_items[i].upper : *upper;
    }
}

// The states that are handed out are within limits, but for planar and floating joints' identity, and are what they
// are said to be.
static void check_witnesses(const scene *c, const ovoid_robot_matrix_pair *p) {
    double lower, upper;
    if (p->hit) {
        measure(c, p->hit, 0, p, &lower, &upper);
        CHECK_LE(upper, 0.0);
    }
    if (p->free) {
        measure(c, p->free, 0, p, &lower, &upper);
        CHECK_LE(-lower, 0.0);
    }
    CHECK(!p->hits || p->hit);
    CHECK(!p->frees || p->free);
    if (p->touch == OVOID_ROBOT_TOUCH_SOMETIMES) CHECK(p->hit && p->free);
    if (p->touch == OVOID_ROBOT_TOUCH_NEVER) CHECK(!p->hit && p->hits == 0 && p->cells > 0);
    if (p->touch == OVOID_ROBOT_TOUCH_ALWAYS) CHECK(!p->free && p->frees == 0 && p->cells > 0);
    CHECK_LE(p->hits + p->frees, p->samples);
    CHECK_LE(p->cells, (size_t)400);
}

// A state of which some variables are at their limits.
static void make_state(uint64_t *s, const ovoid_robot *r, double *q) {
    make_random_state(s, r, q);
    for (size_t i = 0; i < ovoid_robot_get_variable_count(r); i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(r, i);
        if (isfinite(v.lower) && random_below(s, 3) == 0) q[i] = random_below(s, 2) ? v.lower : v.upper;
    }
}

static void collide_state(const scene *c, const double *q) {
    double lower, upper;
    for (size_t i = 0; i < ovoid_robot_matrix_get_count(c->m); i++) {
        ovoid_robot_matrix_pair p = ovoid_robot_matrix_get_pair(c->m, i);
        if (p.touch != OVOID_ROBOT_TOUCH_NEVER && p.touch != OVOID_ROBOT_TOUCH_ALWAYS) continue;
        measure(c, q, 0, &p, &lower, &upper);
        CHECK(p.touch == OVOID_ROBOT_TOUCH_NEVER ? upper > 0 : !(lower > 0));
    }
}

static void test_random(uint64_t seed) {
    uint64_t s = seed;
    scene c;
    double q[7 * ROBOT_LINKS];
    make_scene(&s, &c);
    for (size_t i = 0; i < ovoid_robot_matrix_get_count(c.m); i++) {
        ovoid_robot_matrix_pair p = ovoid_robot_matrix_get_pair(c.m, i);
        of_touch[p.touch]++;
        CHECK_EQ(ovoid_robot_is_rigid_pair(c.r, p.a, p.b), p.touch == OVOID_ROBOT_TOUCH_RIGID);
        if (p.touch != OVOID_ROBOT_TOUCH_RIGID) check_witnesses(&c, &p);
    }
    for (int i = 0; i < 60; i++) {
        make_state(&s, c.r, q);
        // Joints that follow others have limits of their own.
        if (ovoid_robot_validate_limits(c.r, q, 0, NULL) == OVOID_OK) collide_state(&c, q);
    }
    destroy_scene(&c);
}

// ---- repeated, and without memory

static void test_again(void) {
    uint64_t s = 99;
    scene c;
    make_scene(&s, &c);
    ovoid_robot_matrix_options options = {.samples = 50, .budget = 50, .seed = 7};
    ovoid_robot_matrix *a = ovoid_robot_matrix_create(c.r, &options, &error);
    ovoid_robot_matrix *b = ovoid_robot_matrix_create(c.r, &options, &error);
    size_t size = ovoid_robot_get_variable_count(c.r) * sizeof(double);
    CHECK_EQ(ovoid_robot_matrix_get_count(a), ovoid_robot_matrix_get_count(b));
    for (size_t i = 0; i < ovoid_robot_matrix_get_count(a); i++) {
        ovoid_robot_matrix_pair p = ovoid_robot_matrix_get_pair(a, i), o = ovoid_robot_matrix_get_pair(b, i);
        CHECK(p.touch == o.touch && p.hits == o.hits && p.frees == o.frees && p.cells == o.cells);
        CHECK(!p.hit == !o.hit && (!p.hit || memcmp(p.hit, o.hit, size) == 0));
    }
    ovoid_robot_matrix_destroy(a);
    ovoid_robot_matrix_destroy(b);
    destroy_scene(&c);
}

static void test_memory(void) {
    uint64_t s = 99;
    scene c;
    make_scene(&s, &c);
    for (long k = 0, is_done = 0; !is_done; k++) {
        countdown left = {.left = k};
        ovoid_allocator allocator = countdown_make_allocator(&left);
        error = (ovoid_error){0};
        ovoid_robot_matrix_options options = {.samples = 20, .budget = 20, .allocator = &allocator};
        ovoid_robot_matrix *m = ovoid_robot_matrix_create(c.r, &options, &error);
        is_done = m != NULL;
        if (!m) CHECK_EQ(error.code, OVOID_ERROR_MEMORY);
        ovoid_robot_matrix_destroy(m);
        CHECK_EQ(left.held, 0);
        if (!CHECK_LE(k, 2000)) break;
    }
    destroy_scene(&c);
    CHECK(!ovoid_robot_matrix_create(NULL, NULL, &error));
    CHECK_EQ(error.code, OVOID_ERROR_ARGUMENT);
}

int main(void) {
    make_shapes();
    test_balls();
    test_angles();
    test_rods();
    test_pivot();
    test_kinds();
    test_reasons();
    for (uint64_t seed = 1; seed <= 150; seed++) test_random(seed);
    test_again();
    test_memory();
    for (int i = 0; i < 7; i++) printf("%s %ld\n", ovoid_robot_touch_get_name((ovoid_robot_touch)i), of_touch[i]);
    // Random robots are of no use to the tests unless they have pairs of each kind.
    CHECK(of_touch[OVOID_ROBOT_TOUCH_NEVER] > 50 && of_touch[OVOID_ROBOT_TOUCH_ALWAYS] > 20);
    CHECK(of_touch[OVOID_ROBOT_TOUCH_SOMETIMES] > 50 && of_touch[OVOID_ROBOT_TOUCH_OPEN] > 10);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
