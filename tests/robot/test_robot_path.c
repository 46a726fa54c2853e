// Proven motions. Truth: states sampled along each path, each asked alone with a checker that knows nothing of paths;
// no sampled state before free_until may be within the margin, and that at hit_at must be. Robots: random trees with
// all types of joints and mimics; a thin plate and a fast wrist that no sampling sees. Every answer's steps pass the
// check, and steps that say more than is true do not.
#include "check.h"
#include "countdown.h"
#include "robots.h"

#include "ovoid/robot_path.h"

enum { SHAPES = 4, OBSTACLES = 5, STEPS = 200000, SAMPLES = 300 };
static ovoid_shape *shapes[SHAPES];
static ovoid_robot_step steps[STEPS];
static ovoid_error error;
static long frees, hits, undecided, step_sum, state_sum, any_states, first_states, looked, covered;

static void make_shapes(void) {
    shapes[0] = ovoid_shape_create_box((ovoid_vec3){0.1, 0.05, 0.2}, NULL, &error);
    shapes[1] = ovoid_shape_create_sphere(0.1, NULL, &error);
    shapes[2] = ovoid_shape_create_capsule(0.03, 0.2, NULL, &error);
    shapes[3] = ovoid_shape_create_cylinder(0.1, 0.2, NULL, &error);
    for (int i = 0; i < SHAPES; i++)
        if (!shapes[i]) exit(1);
}

typedef struct scene {
    random_robot a;
    ovoid_robot *r;
    ovoid_robot_cell *cell;
    ovoid_robot_checker *checker;
} scene;

static void make_scene(uint64_t *s, scene *c) {
    make_random_robot(s, &c->a);
    size_t count = 0;
    for (uint32_t i = 0; i < c->a.d.link_count; i++)
        if (random_below(s, 2) == 0)
            c->a.elements[count++] =
                (ovoid_robot_element){i, NULL, shapes[random_below(s, SHAPES)], random_pose(s, 0.1), NULL};
    c->a.d.element_count = count;
    c->r = ovoid_robot_create(&c->a.d, NULL, &error);
    c->cell = ovoid_robot_cell_create(c->r, NULL, &error);
    if (!c->cell) exit(1);
    for (int i = 0; i < OBSTACLES; i++) {
        ovoid_body b = {.shape = shapes[random_below(s, SHAPES)], .pose = random_pose(s, 1)};
        CHECK(ovoid_robot_cell_add(c->cell, &b, &error) != 0);
    }
    CHECK_EQ(ovoid_robot_cell_set_padding(c->cell, random_below(s, (uint32_t)c->a.d.link_count), 0.01, &error),
             OVOID_OK);
    c->checker = ovoid_robot_checker_create(c->cell, NULL, &error);
    if (!c->checker) exit(1);
}

static void destroy_scene(scene *c) {
    ovoid_robot_checker_destroy(c->checker);
    ovoid_robot_cell_destroy(c->cell);
    ovoid_robot_destroy(c->r);
}

// A path of states near one another; what floats stays.
static void make_path(uint64_t *s, const scene *c, double *states, size_t count, double reach) {
    size_t n = ovoid_robot_get_variable_count(c->r);
    make_random_state(s, c->r, states);
    for (size_t k = 1; k < count; k++)
        for (size_t i = 0; i < n; i++) {
            ovoid_robot_variable v = ovoid_robot_get_variable(c->r, i);
            int floats = c->a.joints[v.joint].type == OVOID_JOINT_FLOATING, stays = random_below(s, 4) == 0;
            double x = states[(k - 1) * n + i];
            if (!floats && !stays) x = fmin(fmax(x + random_uniform(s, -reach, reach), v.lower), v.upper);
            states[k * n + i] = x;
        }
}

static void get_state(const scene *c, const double *states, size_t count, double at, double *q) {
    size_t n = ovoid_robot_get_variable_count(c->r), k = (size_t)at;
    if (k + 1 >= count) k = count > 1 ? count - 2 : 0;
    const double *q0 = states + k * n, *q1 = count > 1 ? q0 + n : q0;
    double t = at - (double)k;
    for (size_t i = 0; i < n; i++) q[i] = t == 0 ? q0[i] : t == 1 ? q1[i] : q0[i] + t * (q1[i] - q0[i]);
}

static ovoid_robot_status ask_state(const scene *c, const double *q, double margin) {
    ovoid_robot_answer is;
    CHECK_EQ(ovoid_robot_collide(
                 c->checker,
                 &(ovoid_robot_query){q, &(ovoid_robot_query_options){.margin = margin, .limit_slack = 1e-9}}, &is,
                 &error),
             OVOID_OK);
    return is.status;
}

static void compare_samples(const scene *c, const double *states, size_t count, double margin,
                            const ovoid_robot_path_answer *x) {
    double q[7 * ROBOT_LINKS] = {0}, end = count > 1 ? (double)(count - 1) : 0;
    if (x->status == OVOID_ROBOT_FREE) CHECK(x->free_until == end && x->hit_at == INFINITY);
    for (int i = 0; i <= SAMPLES; i++) {
        double at = i == SAMPLES ? x->free_until : x->free_until * i / SAMPLES;
        if (at >= x->free_until && x->status != OVOID_ROBOT_FREE) continue;
        get_state(c, states, count, at, q);
        CHECK(ask_state(c, q, margin) == OVOID_ROBOT_FREE);
    }
    if (x->status != OVOID_ROBOT_HIT) return;
    CHECK(x->hit_at >= x->free_until && x->hit_at <= fmax(end, 1));
    get_state(c, states, count, x->hit_at, q);
    CHECK(ask_state(c, q, margin) != OVOID_ROBOT_FREE);
}

// Faults in the proof: it must not pass.
static void spoil(uint64_t *s, const scene *c, const ovoid_robot_path *path, const ovoid_robot_path_options *o,
                  const ovoid_robot_path_answer *x) {
    if (x->step_count == 0) return;
    size_t at = random_next(s) % x->step_count;
    ovoid_robot_step kept = steps[at];
    ovoid_robot_path_answer more = *x;
    switch (random_below(s, 5)) {
    case 0: steps[at].end = 0.5 * (kept.begin + kept.end); break; // a gap, unless something else covers it
    case 1: steps[at].pair = 1u << 30; break;
    case 2: steps[at].kind = 9; break;
    case 3: steps[at].begin = NAN; break;
    default:
        if (kept.kind == OVOID_ROBOT_STEP_OUTER) return;
        steps[at].normal = (ovoid_vec3){-kept.normal.x, -kept.normal.y, -kept.normal.z};
    }
    // Only what is before free_until is wanted.
    ovoid_code code = ovoid_robot_path_verify(c->cell, &more, &(ovoid_robot_path_basis){{path, o}, steps}, &error);
    double wanted = steps[at].end < kept.end ? steps[at].end : kept.begin;
    if (wanted < x->free_until) CHECK_EQ(code, OVOID_ERROR_PROOF);
    steps[at] = kept;
}

// Any hit: the same word on whether the path is free, proven too, by no more states where it is not.
static void compare_any_hit(const scene *c, const ovoid_robot_path *path, const ovoid_robot_path_options *first,
                            const ovoid_robot_path_answer *known) {
    ovoid_robot_path_options o = *first;
    ovoid_robot_path_answer x;
    o.any_hit = 1;
    CHECK_EQ(ovoid_robot_path_find_hit(c->checker, &(ovoid_robot_path_query){path, &o}, &x, &error), OVOID_OK);
    if (known->status != OVOID_ROBOT_UNDECIDED && x.status != OVOID_ROBOT_UNDECIDED) CHECK_EQ(x.status, known->status);
    if (known->status == OVOID_ROBOT_HIT) CHECK_EQ(x.status, OVOID_ROBOT_HIT);
    compare_samples(c, path->states, path->count, o.query.margin, &x);
    ovoid_code code = ovoid_robot_path_verify(c->cell, &x, &(ovoid_robot_path_basis){{path, &o}, steps}, &error);
    if (!CHECK_EQ(code, OVOID_OK)) printf("  any hit: %s\n", error.message);
    // Without steps covers prove what they can.
    ovoid_robot_path_answer bare;
    o.steps = NULL, o.capacity = 0;
    CHECK_EQ(ovoid_robot_path_find_hit(c->checker, &(ovoid_robot_path_query){path, &o}, &bare, &error), OVOID_OK);
    if (known->status != OVOID_ROBOT_UNDECIDED && bare.status != OVOID_ROBOT_UNDECIDED)
        CHECK_EQ(bare.status, known->status);
    compare_samples(c, path->states, path->count, o.query.margin, &bare);
    covered += bare.status == OVOID_ROBOT_FREE && bare.states == 0;
    if (x.status != OVOID_ROBOT_HIT || known->status != OVOID_ROBOT_HIT) return;
    CHECK(x.hit_at >= known->free_until);
    any_states += x.states, first_states += known->states;
    looked += x.free_until == 0 && x.hit_at > 0;
}

static void test_random(void) {
    uint64_t s = 31;
    double states[4 * 7 * ROBOT_LINKS] = {0};
    for (int i = 0; i < 400; i++) {
        check_seed = (uint64_t)i;
        scene c;
        make_scene(&s, &c);
        size_t count = 1 + random_below(&s, 4);
        make_path(&s, &c, states, count, i % 3 ? 0.2 : 2);
        double margin = i % 4 ? 0 : 0.01;
        ovoid_robot_path path = {states, count};
        ovoid_robot_path_options o = {
            .query = {.margin = margin, .limit_slack = 1e-9}, .states = 3000, .steps = steps, .capacity = STEPS};
        ovoid_robot_path_answer x;
        CHECK_EQ(ovoid_robot_path_find_hit(c.checker, &(ovoid_robot_path_query){&path, &o}, &x, &error), OVOID_OK);
        CHECK(x.step_count <= STEPS && x.status != OVOID_ROBOT_REFUSED);
        frees += x.status == OVOID_ROBOT_FREE, hits += x.status == OVOID_ROBOT_HIT;
        undecided += x.status == OVOID_ROBOT_UNDECIDED;
        step_sum += (long)x.step_count, state_sum += x.states;
        compare_samples(&c, states, count, margin, &x);
        ovoid_code code = ovoid_robot_path_verify(c.cell, &x, &(ovoid_robot_path_basis){{&path, &o}, steps}, &error);
        if (!CHECK_EQ(code, OVOID_OK)) printf("  %d: %s\n", i, error.message);
        spoil(&s, &c, &path, &o, &x);
        compare_any_hit(&c, &path, &o, &x);
        destroy_scene(&c);
    }
}

// One turning joint, a thin rod on it, a thin plate in its way.
static ovoid_robot *make_wrist(ovoid_shape *rod, double upper) {
    const ovoid_robot_link links[2] = {{"base"}, {"rod"}};
    const ovoid_robot_joint joint = {
        "wrist", OVOID_JOINT_REVOLUTE, 0, 1, {{0, 0, 0}, {1, 0, 0, 0}}, {0, 0, 1}, -upper, upper,
        0,       OVOID_ROBOT_NONE,     1, 0};
    const ovoid_robot_element element = {1, NULL, rod, {{0.5, 0, 0}, {1, 0, 0, 0}}, NULL};
    const ovoid_robot_description d = {
        .links = links, .link_count = 2, .joints = &joint, .joint_count = 1, .elements = &element, .element_count = 1};
    return ovoid_robot_create(&d, NULL, &error);
}

// The rod is along x at angle 0, from 0.1 to 0.9, and 0.002 thick; the plate stands at an angle of `at`.
static void test_wrist(double turns, double at, double radius) {
    ovoid_shape *rod = ovoid_shape_create_box((ovoid_vec3){0.4, 0.001, 0.001}, NULL, &error);
    ovoid_shape *plate = ovoid_shape_create_box((ovoid_vec3){0.05, 1e-6, 0.05}, NULL, &error);
    double pi = 3.14159265358979323846, q[2] = {-2 * pi * turns, 2 * pi * turns};
    ovoid_robot *r = make_wrist(rod, 1e6);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(r, NULL, &error);
    ovoid_body body = {.shape = plate,
                       .pose = {{radius * cos(at), radius * sin(at), 0}, {cos(at / 2), 0, 0, sin(at / 2)}}};
    CHECK(ovoid_robot_cell_add(cell, &body, &error) != 0);
    ovoid_robot_checker *x = ovoid_robot_checker_create(cell, NULL, &error);
    ovoid_robot_path path = {q, 2};
    ovoid_robot_path_options o = {.steps = steps, .capacity = STEPS};
    ovoid_robot_path_answer is;
    CHECK_EQ(ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, &o}, &is, &error), OVOID_OK);
    if (radius < 0.95) {
        // The first meeting of the plate's angle, minus half the rod's thickness at about that radius.
        double first = (fmod(at + 200 * pi - q[0], 2 * pi)) / (q[1] - q[0]);
        CHECK_EQ(is.status, OVOID_ROBOT_HIT);
        CHECK(is.hit_at - is.free_until <= 0x1p-20);
        CHECK(fabs(is.hit_at - first) < 0.01 / turns);
    } else
        CHECK_EQ(is.status, OVOID_ROBOT_FREE);
    CHECK_EQ(ovoid_robot_path_verify(cell, &is, &(ovoid_robot_path_basis){{&path, &o}, steps}, &error), OVOID_OK);
    // A hit is that of a pair which is queried, and its bracket is.
    if (is.status == OVOID_ROBOT_HIT) {
        ovoid_robot_path_answer other = is;
        other.hit.lower = is.hit.upper + 1e-6, other.hit.upper = is.hit.upper + 2e-6;
        CHECK_EQ(ovoid_robot_path_verify(cell, &other, &(ovoid_robot_path_basis){{&path, &o}, steps}, &error),
                 OVOID_ERROR_PROOF);
        o.query.without_obstacles = 1;
        CHECK_EQ(ovoid_robot_path_verify(cell, &is, &(ovoid_robot_path_basis){{&path, &o}, steps}, &error),
                 OVOID_ERROR_PROOF);
    }
    ovoid_robot_checker_destroy(x);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(r);
    ovoid_shape_destroy(rod);
    ovoid_shape_destroy(plate);
}

// Four hinges on one axis, which turn together, carry a small ball on an arc of radius 1; a wall touches the arc by a
// ten-thousandth, or stands farther out by the link's padding: it is met wherever it is, between two states that are
// clear of it.
static void test_arc(void) {
    enum { HINGES = 4 };
    uint64_t s = 77;
    ovoid_shape *ball = ovoid_shape_create_sphere(0.01, NULL, &error);
    ovoid_shape *wall = ovoid_shape_create_box((ovoid_vec3){0.005, 0.2, 0.2}, NULL, &error);
    const ovoid_robot_link links[HINGES + 1] = {{"a"}, {"b"}, {"c"}, {"d"}, {"e"}};
    ovoid_robot_joint joints[HINGES];
    for (uint32_t i = 0; i < HINGES; i++)
        joints[i] = (ovoid_robot_joint){links[i].name,
                                        OVOID_JOINT_CONTINUOUS,
                                        i,
                                        i + 1,
                                        {{0, 0, 0}, {1, 0, 0, 0}},
                                        {0, 0, 1},
                                        0,
                                        0,
                                        0,
                                        OVOID_ROBOT_NONE,
                                        1,
                                        0};
    const ovoid_robot_element element = {HINGES, NULL, ball, {{1, 0, 0}, {1, 0, 0, 0}}, NULL};
    const ovoid_robot_description d = {.links = links,
                                       .link_count = HINGES + 1,
                                       .joints = joints,
                                       .joint_count = HINGES,
                                       .elements = &element,
                                       .element_count = 1};
    ovoid_robot *r = ovoid_robot_create(&d, NULL, &error);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(r, NULL, &error);
    ovoid_robot_checker *x = ovoid_robot_checker_create(cell, NULL, &error);
    for (int i = 0; i < 600; i++) {
        check_seed = (uint64_t)i;
        double angle = random_uniform(&s, 0.05, 0.8), share = random_uniform(&s, 0.05, 0.95);
        double at = HINGES * angle * share, q[2 * HINGES] = {0}, far = 1.0149 + (i % 2 ? 0.02 : 0);
        for (int k = 0; k < HINGES; k++) q[HINGES + k] = angle;
        ovoid_body body = {.shape = wall,
                           .pose = {{far * cos(at), far * sin(at), 0}, {cos(at / 2), 0, 0, sin(at / 2)}}};
        ovoid_id id = ovoid_robot_cell_add(cell, &body, &error);
        CHECK_EQ(ovoid_robot_cell_set_padding(cell, HINGES, i % 2 ? 0.02 : 0, &error), OVOID_OK);
        ovoid_robot_path path = {q, 2};
        ovoid_robot_path_answer is;
        CHECK_EQ(ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, NULL}, &is, &error), OVOID_OK);
        CHECK_EQ(is.status, OVOID_ROBOT_HIT);
        CHECK(is.free_until <= share && fabs(is.hit_at - share) <= 0.01 / angle);
        CHECK_EQ(ovoid_robot_cell_remove(cell, id, &error), OVOID_OK);
    }
    check_seed = 0;
    ovoid_robot_checker_destroy(x);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(r);
    ovoid_shape_destroy(ball);
    ovoid_shape_destroy(wall);
}

static void test_refusals(void) {
    ovoid_shape *rod = ovoid_shape_create_box((ovoid_vec3){0.4, 0.001, 0.001}, NULL, &error);
    ovoid_robot *r = make_wrist(rod, 1);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(r, NULL, &error);
    ovoid_robot_checker *x = ovoid_robot_checker_create(cell, NULL, &error);
    double q[2] = {0, 2};
    ovoid_robot_path path = {q, 2};
    ovoid_robot_path_answer is;
    CHECK_EQ(ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, NULL}, &is, &error), OVOID_OK);
    CHECK(is.status == OVOID_ROBOT_REFUSED && is.hit.code == OVOID_ERROR_RANGE && is.refused == 0);
    q[1] = NAN;
    CHECK_EQ(ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, NULL}, &is, &error), OVOID_OK);
    CHECK_EQ(is.status, OVOID_ROBOT_REFUSED);
    path.count = 0;
    CHECK_EQ(ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, NULL}, &is, &error), OVOID_ERROR_ARGUMENT);
    path.count = 2, q[1] = 0.5;
    ovoid_robot_path_options o = {.tolerance = NAN};
    CHECK_EQ(ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, &o}, &is, &error), OVOID_ERROR_ARGUMENT);
    o = (ovoid_robot_path_options){.query = {.margin = -1}};
    CHECK_EQ(ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, &o}, &is, &error), OVOID_ERROR_ARGUMENT);
    CHECK_EQ(ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, NULL}, &is, &error), OVOID_OK);
    CHECK(is.status == OVOID_ROBOT_UNDECIDED && is.hit.code == OVOID_ERROR_EMPTY && is.step_count == 0);
    ovoid_robot_sides sides;
    CHECK_EQ(ovoid_robot_cell_get_pair_count(cell), 0);
    CHECK_EQ(ovoid_robot_cell_get_pair(cell, 0, &sides, &error), OVOID_ERROR_INDEX);
    ovoid_robot_checker_destroy(x);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(r);
    ovoid_shape_destroy(rod);
}

// Every allocation that a first path may make fails once: it says so and leaks nothing. A second path allocates nothing
// and gets the same answer; after a change of the cell the memory is made anew.
static void test_memory(int any_hit) {
    ovoid_shape *rod = ovoid_shape_create_box((ovoid_vec3){0.4, 0.001, 0.001}, NULL, &error);
    ovoid_robot *r = make_wrist(rod, 1);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(r, NULL, &error);
    ovoid_body body = {.shape = shapes[0], .pose = {{0, 0.5, 0}, {1, 0, 0, 0}}};
    CHECK(ovoid_robot_cell_add(cell, &body, &error) != 0);
    double q[2] = {0, 0.9};
    ovoid_robot_path path = {q, 2};
    ovoid_robot_path_answer first, second;
    const ovoid_robot_path_options how = {.any_hit = any_hit};
    long failures = 0;
    for (int is_done = 0; !is_done; failures += !is_done) {
        countdown left = {.left = 1 << 20};
        ovoid_allocator allocator = countdown_make_allocator(&left);
        ovoid_robot_checker *x = ovoid_robot_checker_create(cell, &(ovoid_robot_checker_options){&allocator}, &error);
        left.left = failures;
        ovoid_code code = ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, &how}, &first, &error);
        is_done = code == OVOID_OK;
        if (!is_done) CHECK_EQ(code, OVOID_ERROR_MEMORY);
        if (is_done) {
            left.left = 0;
            ovoid_robot_checker_reset(x);
            CHECK_EQ(ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, &how}, &second, &error), OVOID_OK);
            CHECK(second.status == first.status && second.free_until == first.free_until);
            CHECK_EQ(second.states, first.states);
            ovoid_id id = ovoid_robot_cell_add(cell, &body, &error);
            CHECK_EQ(ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, &how}, &second, &error),
                     OVOID_ERROR_MEMORY);
            left.left = 1 << 20;
            CHECK_EQ(ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, &how}, &second, &error), OVOID_OK);
            CHECK(second.status == first.status && second.free_until == first.free_until);
            CHECK(id != 0);
        }
        ovoid_robot_checker_destroy(x);
        CHECK_EQ(left.held, 0);
    }
    CHECK(failures > 3);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(r);
    ovoid_shape_destroy(rod);
}

int main(void) {
    make_shapes();
    test_memory(0);
    test_memory(1);
    test_wrist(1, 0.7, 0.6);
    test_wrist(30, 2.1, 0.85);
    test_wrist(3, 0.7, 0.99);
    test_arc();
    test_refusals();
    test_random();
    printf("%ld free, %ld hit, %ld undecided, %ld steps, %ld states\n", frees, hits, undecided, step_sum, state_sum);
    printf("any hit: %ld states, %ld; %ld hits before anything was proven; %ld free by covers alone\n", any_states,
           first_states, looked, covered);
    CHECK(2 * covered > frees);
    CHECK(frees > 50 && hits > 50 && looked > 30 && any_states < first_states);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
