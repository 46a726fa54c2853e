// Balls and slabs that part bodies at rest. Truth: exact distances of the same bodies, whose bracket no claim may
// contradict, and the vertices themselves, none of which may stand out of a slab. All instruction sets give one answer.
// Most pairs that are a tenth of their size apart must be parted, or the test in front of the exact query is of no use.
#include "check.h"
#include "robots.h"

#include "ovoid/query.h"
#include "robot/cell/checker.h"

enum { SHAPES = 7, FAR = SHAPES, ALL, TRIALS = 400, STATES = 25 };
static ovoid_shape *shapes[ALL]; // the last one, far from its frame, for slabs alone
static ovoid_error error;
static long asked[2], parted[2], wide[2], parted_wide[2];

static void make_shapes(void) {
    double xyz[60];
    uint64_t s = 3;
    for (int i = 0; i < 60; i++) xyz[i] = random_uniform(&s, -0.2, 0.3) + (i % 3 == 1 ? 0.5 : 0);
    shapes[0] = ovoid_shape_create_box((ovoid_vec3){0.2, 0.1, 0.3}, NULL, &error);
    shapes[1] = ovoid_shape_create_capsule(0.05, 0.3, NULL, &error);
    shapes[2] = ovoid_shape_create_sphere(0.2, NULL, &error);
    shapes[3] = ovoid_shape_create_from_points(xyz, 20, &(ovoid_shape_options){.radius = 0.02}, &error);
    shapes[4] = ovoid_shape_create_cylinder(0.1, 0.2, NULL, &error);
    shapes[5] = ovoid_shape_create_from_points(xyz, 4, NULL, &error);
    shapes[6] = ovoid_shape_create_from_points(xyz, 3, NULL, &error);
    for (int i = 0; i < 60; i++) xyz[i] += 1000;
    shapes[FAR] = ovoid_shape_create_from_points(xyz, 20, NULL, &error);
    for (int i = 0; i < ALL; i++)
        if (!shapes[i]) exit(1);
    CHECK(shapes[FAR]->origin.x > 900);
}

// ---- slabs

static void find_along(const long double v[3], long double along[SLABS]) {
    static const int signs[SLABS][3] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {1, 1, 0},  {1, -1, 0},
                                        {1, 0, 1},  {1, 0, -1}, {0, 1, 1},  {0, 1, -1}, {1, 1, 1},
                                        {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
    for (int k = 0; k < SLABS; k++) along[k] = signs[k][0] * v[0] + signs[k][1] * v[1] + signs[k][2] * v[2];
}

// Each vertex, thickened, is within each slab, and some vertex is at its edge.
static void test_slabs(void) {
    static const long double norms[3] = {1, 1.41421356237309504880L, 1.73205080756887729353L};
    for (int i = 0; i < ALL; i++) {
        body_slabs slabs = slabs_find_of_shape(shapes[i]);
        ovoid_polytope p = ovoid_shape_get_polytope(shapes[i]);
        long double most[SLABS], along[SLABS];
        for (uint32_t n = 0; n < p.vertex_count; n++) {
            const double *v = p.vertices + 3 * (size_t)n;
            const long double x[3] = {(long double)p.origin.x + v[0], (long double)p.origin.y + v[1],
                                      (long double)p.origin.z + v[2]};
            find_along(x, along);
            for (int k = 0; k < SLABS; k++) {
                long double out =
                    fabsl(along[k] - (long double)slabs.middle[k]) + shapes[i]->lower_radius * norms[k < 3   ? 0
                                                                                                     : k < 9 ? 1
                                                                                                             : 2];
                most[k] = n ? fmaxl(most[k], out) : out;
            }
        }
        for (int k = 0; k < SLABS; k++) {
            CHECK(most[k] <= (long double)slabs.half[k]);
            CHECK_LE(slabs.half[k] - (double)most[k], 1e-9);
        }
    }
}

// ---- pairs

// Two links, the second of which floats; an obstacle.
typedef struct scene {
    ovoid_robot *r;
    ovoid_robot_cell *cell;
    ovoid_robot_checker *checker;
} scene;

static void make_scene(uint64_t *s, scene *c) {
    static const ovoid_robot_link links[2] = {{"base"}, {"free"}};
    const ovoid_robot_joint joint = {.name = "j",
                                     .type = OVOID_JOINT_FLOATING,
                                     .parent = 0,
                                     .child = 1,
                                     .origin = random_pose(s, 0.1),
                                     .mimic = OVOID_ROBOT_NONE};
    const ovoid_robot_element elements[2] = {{0, NULL, shapes[random_below(s, SHAPES)], random_pose(s, 0.1), NULL},
                                             {1, NULL, shapes[random_below(s, SHAPES)], random_pose(s, 0.1), NULL}};
    const ovoid_robot_description d = {
        .links = links, .link_count = 2, .joints = &joint, .joint_count = 1, .elements = elements, .element_count = 2};
    c->r = ovoid_robot_create(&d, NULL, &error);
    c->cell = c->r ? ovoid_robot_cell_create(c->r, NULL, &error) : NULL;
    const ovoid_body body = {.shape = shapes[random_below(s, SHAPES)], .pose = random_pose(s, 0.1)};
    if (!c->cell || !ovoid_robot_cell_add(c->cell, &body, &error)) exit(1);
    CHECK_EQ(ovoid_robot_cell_set_padding(c->cell, 1, 0.03, &error), OVOID_OK);
    c->checker = ovoid_robot_checker_create(c->cell, NULL, &error);
    if (!c->checker) exit(1);
}

static void check_pair(scene *c, pair_name name, double margin) {
    int is_pair = name.item == OVOID_ROBOT_NONE, is_far = 0;
    checker_pair p = is_pair ? checker_make_item_pair(c->checker, name.index)
                             : checker_make_part_pair(c->checker, name.item, name.index);
    for (int isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++) {
        const robot8_kernels *kernels = robot8_get_kernels_of((simd_isa)isa);
        if (!kernels) continue;
        c->checker->kernels = kernels;
        int is = checker_is_cover_far(c->checker, &p, name, margin);
        if (isa > SIMD_SCALAR) CHECK_EQ(is, is_far);
        is_far = is;
    }
    ovoid_answer answer = ovoid_distance(&p.pair, NULL, NULL);
    double most = answer.upper - p.padding + p.error, least = answer.lower - p.padding - p.error;
    if (is_far) CHECK(most > margin);
    asked[is_pair] += least > margin;
    parted[is_pair] += is_far;
    wide[is_pair] += least > margin + 0.1;
    parted_wide[is_pair] += is_far && least > margin + 0.1;
}

static void test_pairs(void) {
    for (int i = 0; i < TRIALS; i++) {
        uint64_t s = check_seed = (uint64_t)i + 1;
        scene c;
        make_scene(&s, &c);
        for (int k = 0; k < STATES; k++) {
            const double q[7] = {random_uniform(&s, -0.5, 0.5),
                                 random_uniform(&s, -0.5, 0.5),
                                 random_uniform(&s, -0.5, 0.5),
                                 random_normal(&s),
                                 random_normal(&s),
                                 random_normal(&s),
                                 random_normal(&s)};
            CHECK_EQ(checker_place(c.checker, q, 0, &error), OVOID_OK);
            double margin = random_below(&s, 2) ? 0 : random_uniform(&s, 0, 0.1);
            check_pair(&c, (pair_name){OVOID_ROBOT_NONE, 0}, margin);
            check_pair(&c, (pair_name){1, 0}, margin);
        }
        ovoid_robot_checker_destroy(c.checker);
        ovoid_robot_cell_destroy(c.cell);
        ovoid_robot_destroy(c.r);
    }
    check_seed = 0;
    for (int k = 0; k < 2; k++) {
        printf("%s: apart %ld, parted %ld; by a tenth %ld, parted %ld\n", k ? "links" : "obstacles", asked[k],
               parted[k], wide[k], parted_wide[k]);
        CHECK(parted[k] > 0.9 * (double)asked[k] && parted_wide[k] > 0.99 * (double)wide[k] && asked[k] > 1000);
    }
}

int main(void) {
    make_shapes();
    test_slabs();
    test_pairs();
    for (int i = 0; i < ALL; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
