// Tables of pairs of links. Truth: exact distances of all elements of two links at states of random robots: anywhere,
// and at the corners of cells that lie beside open ones, where the bounds are sharp; a distance that a table claims is
// one. Ranges against their cells, one by one. Cells of robots with attached bodies, margins, allowed pairs against all
// pairs by ovoid_depth. Tables must prove much, or they would be of no use.
#include "check.h"
#include "countdown.h"
#include "robots.h"

#include "ovoid/query.h"
#include "ovoid/robot_path.h"
#include "robot/cell/checker.h"

#include <pthread.h>

enum { ROBOTS = 160, LINKS = 7, STATES = 150, CORNERS = 40, RANGES = 60, SHAPES = 4, THREADS = 4 };
static ovoid_shape *shapes[SHAPES];
static ovoid_error error;
static long asked, far, is_truly_far, corners, sharp, turning, wrapped;
// What kinematics and distances are off by, at most: lengths here are below 100.
static const double near_enough = 1e-11;

static void make_shapes(void) {
    double xyz[60];
    uint64_t s = 3;
    for (int i = 0; i < 60; i++) xyz[i] = random_uniform(&s, -0.2, 0.3);
    shapes[0] = ovoid_shape_create_box((ovoid_vec3){0.2, 0.1, 0.3}, NULL, &error);
    shapes[1] = ovoid_shape_create_capsule(0.05, 0.3, NULL, &error);
    shapes[2] = ovoid_shape_create_sphere(0.2, NULL, &error);
    shapes[3] = ovoid_shape_create_from_points(xyz, 20, &(ovoid_shape_options){.radius = 0.02}, &error);
    for (int i = 0; i < SHAPES; i++)
        if (!shapes[i]) exit(1);
}

// Of few links, so that many pairs have one or two variables between them; narrow limits, whole turns, slides.
static ovoid_robot *make_robot(uint64_t *s, random_robot *a, const ovoid_allocator *allocator) {
    make_random_robot(s, a);
    if (a->d.link_count > LINKS) a->d.link_count = LINKS, a->d.joint_count = LINKS - 1;
    size_t count = 0;
    for (uint32_t i = 0; i < a->d.link_count; i++) {
        ovoid_robot_joint *j = &a->joints[i];
        // A lone joint in a chain of fixed ones has a pair of links whose bound is nearly reached.
        if (j->type > OVOID_JOINT_PRISMATIC && j->mimic == OVOID_ROBOT_NONE)
            j->type = random_below(s, 2) ? OVOID_JOINT_REVOLUTE : OVOID_JOINT_CONTINUOUS;
        if (random_below(s, 3) == 0 && j->mimic == OVOID_ROBOT_NONE) j->lower = -0.3, j->upper = 0.1;
        if (random_below(s, 8) == 0 && j->mimic == OVOID_ROBOT_NONE) j->lower = -20, j->upper = 30;
        for (uint32_t k = random_below(s, 3); k > 0; k--)
            a->elements[count++] =
                (ovoid_robot_element){i, NULL, shapes[random_below(s, SHAPES)], random_pose(s, 0.2), NULL};
    }
    a->d.element_count = count;
    ovoid_robot *r = ovoid_robot_create(&a->d, &(ovoid_robot_options){.allocator = allocator}, &error);
    if (!r && !allocator) printf("%s\n", error.message), exit(1);
    return r;
}

// ---- states

// The least distance of the elements of two links: a bracket.
static void measure(const ovoid_robot *r, const double *q, const pair_table *t, double *lower, double *upper) {
    ovoid_robot_description d = ovoid_robot_get_description(r);
    ovoid_pose links[ROBOT_LINKS];
    *lower = *upper = INFINITY;
    CHECK_EQ(ovoid_robot_compute_poses(r, q, links, &error), OVOID_OK);
    for (size_t i = 0; i < d.element_count; i++)
        for (size_t k = 0; k < d.element_count; k++) {
            const ovoid_robot_element *a = &d.elements[i], *b = &d.elements[k];
            if (a->link != t->a || b->link != t->b) continue;
            ovoid_pair pair = {a->shape, b->shape, ovoid_pose_compute_product(&links[a->link], &a->pose),
                               ovoid_pose_compute_product(&links[b->link], &b->pose)};
            ovoid_answer answer = ovoid_distance(&pair, NULL, NULL);
            *lower = fmin(*lower, answer.lower);
            *upper = fmin(*upper, answer.upper);
        }
}

static void get_values(const ovoid_robot *r, const double *q, double *values) {
    double magnitude;
    CHECK_EQ(robot_compute_values(r, q, values, 1, &magnitude, &error), OVOID_OK);
}

// What a table says of a state must be so, for the largest margin too that it claims.
static int check_state(const ovoid_robot *r, const pair_table *t, const double *q) {
    double values[64], lower, upper;
    get_values(r, q, values);
    measure(r, q, t, &lower, &upper);
    int is_far = pair_table_is_far(t, values, 1, 0);
    if (!is_far) return lower > 0 ? 0 : -1;
    double claimed = 0;
    while (claimed < 254 * t->unit && pair_table_is_far(t, values, 1, claimed + t->unit)) claimed += t->unit;
    CHECK_LE(claimed - near_enough, upper);
    CHECK(upper > 0);
    CHECK(!pair_table_is_far(t, values, 1, 256 * t->unit));
    return 1;
}

static void check_states(uint64_t *s, const ovoid_robot *r, const pair_tables *tables) {
    double q[64];
    for (int i = 0; i < STATES; i++) {
        make_random_state(s, r, q);
        for (uint32_t k = 0; k < tables->count; k++) {
            int is = check_state(r, &tables->items[k], q);
            asked++;
            far += is > 0;
            is_truly_far += is >= 0;
        }
    }
}

// Beside an open cell what is proven is nearly all that could be: states at the corners of those cells, and just
// beyond.
static void check_corners(uint64_t *s, const ovoid_robot *r, const pair_table *t) {
    double q[64], lower, upper;
    uint32_t count = t->axes[0].count;
    for (int tries = 0, found = 0; t->codes && tries < 200 * CORNERS && found < CORNERS; tries++) {
        uint32_t cells[2] = {random_below(s, count), random_below(s, t->axes[1].count)};
        uint8_t code = t->codes[cells[1] * count + cells[0]];
        if (code == 0 || code > 2) continue;
        found++;
        make_random_state(s, r, q);
        for (int k = 0; k < 2; k++) {
            const table_axis *x = &t->axes[k];
            if (x->variable == OVOID_ROBOT_NONE) continue;
            double at = x->low + (cells[k] + (double)random_below(s, 2)) / x->scale;
            for (uint32_t steps = random_below(s, 3); steps > 0; steps--)
                at = nextafter(at, random_below(s, 2) ? INFINITY : -INFINITY);
            q[x->variable] = at + x->period * ((int)random_below(s, 9) - 4);
            turning += x->period > 0;
        }
        (void)check_state(r, t, q);
        measure(r, q, t, &lower, &upper);
        // The cell's own claim holds at its corner.
        CHECK_LE((code - 1) * t->unit - near_enough, upper);
        CHECK(upper > 0);
        corners++;
        sharp += upper < (code + 1) * t->unit;
    }
}

// ---- ranges

static int is_cell_open(const pair_table *t, uint32_t i, uint32_t k) {
    return t->codes && t->codes[(size_t)k * t->axes[0].count + i] == 0;
}

// By cells: those that a sample of the range lies in.
static int is_sampled_open(uint64_t *s, const pair_table *t, const table_range *range) {
    for (int i = 0; i < 200; i++) {
        uint32_t cells[2];
        for (int k = 0; k < 2; k++) {
            double q = random_uniform(s, range->low[k], range->high[k]);
            cells[k] = table_axis_find_cell(&t->axes[k], table_axis_locate(&t->axes[k], q));
            if (cells[k] == t->axes[k].count) return 1;
        }
        if (is_cell_open(t, cells[0], cells[1])) return 1;
    }
    return 0;
}

// All cells from the first to the last, going around where it is a turn.
static int is_range_open(const pair_table *t, const table_range *range) {
    uint32_t first[2], steps[2];
    for (int k = 0; k < 2; k++) {
        const table_axis *x = &t->axes[k];
        double from = table_axis_locate(x, range->low[k]), to = from + (range->high[k] - range->low[k]) * x->scale;
        first[k] = table_axis_find_cell(x, from);
        if (first[k] == x->count || !(fabs(range->high[k]) <= x->most)) return 1;
        if (!(x->period > 0) && table_axis_find_cell(x, to) == x->count) return 1;
        steps[k] = (uint32_t)(to < 2.0 * x->count ? to : 2.0 * x->count) - first[k];
        if (!(x->period > 0) && first[k] + steps[k] >= x->count) steps[k] = x->count - 1 - first[k];
        if (x->period > 0 && first[k] + steps[k] >= x->count) wrapped++;
        if (steps[k] > x->count) steps[k] = x->count;
    }
    for (uint32_t k = 0; k <= steps[1]; k++)
        for (uint32_t i = 0; i <= steps[0]; i++)
            if (is_cell_open(t, (first[0] + i) % t->axes[0].count, (first[1] + k) % t->axes[1].count)) return 1;
    return 0;
}

static void check_ranges(uint64_t *s, const pair_table *t) {
    for (int i = 0; i < RANGES; i++) {
        table_range range;
        double share = i % 3 == 0 ? 0.02 : i % 3 == 1 ? 0.3 : 1.2;
        for (int k = 0; k < 2; k++) {
            const table_axis *x = &t->axes[k];
            double whole = x->variable == OVOID_ROBOT_NONE ? 1 : x->count / x->scale;
            range.low[k] = x->low + random_uniform(s, x->period > 0 ? -3 : -0.05, x->period > 0 ? 3 : 1) * whole;
            range.high[k] = range.low[k] + random_uniform(s, 0, share) * whole;
        }
        int is_apart = pair_table_is_apart(t, &range);
        CHECK_EQ(is_apart, !is_range_open(t, &range));
        if (is_apart) CHECK(!is_sampled_open(s, t, &range));
    }
}

// Eight cells of a whole turn, of which cell 1 alone is open: ranges that go around end before it, in it, beyond it.
static void test_around(void) {
    uint8_t codes[8] = {1, 0, 1, 1, 1, 1, 1, 1};
    uint32_t sums[18] = {0};
    for (int i = 0; i < 9; i++) sums[9 + i] = i > 1;
    const pair_table t = {.axes = {{.count = 8, .low = 0, .scale = 1, .period = 8, .most = 64},
                                   {.variable = OVOID_ROBOT_NONE, .count = 1, .most = INFINITY}},
                          .unit = 1,
                          .codes = codes,
                          .sums = sums};
    static const struct {
        double low, high;
        int is_apart;
    } all[] = {{2.5, 2.6, 1}, {2.5, 3.9, 1},  {0.5, 0.9, 1}, {0.5, 1.1, 0},  {1.9, 2.1, 0},
               {3.5, 8.9, 1}, {3.5, 9.1, 0},  {3.5, 9.9, 0}, {3.5, 11.4, 0}, {2.5, 60, 0},
               {2.5, 65, 0},  {-5.5, 0.9, 1}, {-5.5, 1.1, 0}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        CHECK_EQ(pair_table_is_apart(&t, &(table_range){{all[i].low, 0}, {all[i].high, 0}}), all[i].is_apart);
}

static void test_tables(void) {
    for (uint64_t seed = 1; seed <= ROBOTS; seed++) {
        uint64_t s = check_seed = seed;
        random_robot a;
        ovoid_robot *r = make_robot(&s, &a, NULL);
        const pair_tables *tables = robot_get_pair_tables(r);
        CHECK(tables && tables == robot_get_pair_tables(r));
        check_states(&s, r, tables);
        for (uint32_t i = 0; i < tables->count; i++) {
            const pair_table *t = &tables->items[i];
            CHECK(pair_tables_find(tables, t->a, t->b) == t && pair_tables_find(tables, t->b, t->a) == t);
            CHECK(t->a < t->b && !pair_tables_find(tables, t->a, LINKS));
            check_corners(&s, r, t);
            check_ranges(&s, t);
        }
        ovoid_robot_destroy(r);
    }
    check_seed = 0;
    printf("states %ld, far %ld, by tables %ld; corners %ld, sharp %ld, turning %ld, around %ld\n", asked, is_truly_far,
           far, corners, sharp, turning, wrapped);
    CHECK(far > 0.95 * (double)is_truly_far && is_truly_far < asked);
    CHECK(corners > 1000 && sharp > 0.1 * (double)corners && turning > 100 && wrapped > 100);
}

// ---- cells

// Three spheres of 0.2, at 0, 0.5 and 1 where both joints, which turn about the second one's centre, are at 0. Each
// pair has a table.
typedef struct arm {
    ovoid_robot_link links[3];
    ovoid_robot_joint joints[2];
    ovoid_robot_element elements[3];
    ovoid_robot *r;
    ovoid_robot_cell *cell;
    ovoid_robot_checker *checker;
} arm;

static void make_arm(arm *a) {
    static const char *const names[3] = {"base", "middle", "tip"};
    const ovoid_pose at = {{0.5, 0, 0}, {1, 0, 0, 0}}, same = ovoid_pose_make_identity();
    for (uint32_t i = 0; i < 3; i++) {
        a->links[i].name = names[i];
        a->elements[i] = (ovoid_robot_element){i, NULL, shapes[2], i == 2 ? at : same, NULL};
    }
    for (uint32_t i = 0; i < 2; i++)
        a->joints[i] = (ovoid_robot_joint){.name = names[i],
                                           .type = OVOID_JOINT_REVOLUTE,
                                           .parent = i,
                                           .child = i + 1,
                                           .origin = i ? same : at,
                                           .axis = {0, 0, 1},
                                           .lower = -3,
                                           .upper = 3,
                                           .mimic = OVOID_ROBOT_NONE};
    const ovoid_robot_description d = {.links = a->links,
                                       .link_count = 3,
                                       .joints = a->joints,
                                       .joint_count = 2,
                                       .elements = a->elements,
                                       .element_count = 3};
    a->r = ovoid_robot_create(&d, NULL, &error);
    a->cell = a->r ? ovoid_robot_cell_create(a->r, NULL, &error) : NULL;
    a->checker = a->cell ? ovoid_robot_checker_create(a->cell, NULL, &error) : NULL;
    if (!a->checker) printf("%s\n", error.message), exit(1);
}

static void destroy_arm(arm *a) {
    ovoid_robot_checker_destroy(a->checker);
    ovoid_robot_cell_destroy(a->cell);
    ovoid_robot_destroy(a->r);
}

// One state alone, in a batch, and as an edge that stays there; all give this status.
static void check_status(arm *a, const double q[2], double margin, ovoid_robot_status status) {
    const ovoid_robot_query_options options = {.margin = margin};
    double many[16];
    ovoid_robot_answer is, all[8];
    CHECK_EQ(ovoid_robot_collide(a->checker, &(ovoid_robot_query){q, &options}, &is, &error), OVOID_OK);
    CHECK_EQ(is.status, status);
    for (int i = 0; i < 16; i++) many[i] = q[i % 2];
    const ovoid_robot_batch batch = {many, 8, &options, all};
    CHECK_EQ(ovoid_robot_collide_batch(&a->checker, 1, &batch, &error), OVOID_OK);
    for (int i = 0; i < 8; i++) CHECK_EQ(all[i].status, status);
    const double path[4] = {q[0], q[1], q[0] + 1e-3, q[1]};
    ovoid_robot_path_answer answer;
    const ovoid_robot_path_options path_options = {.query = options, .any_hit = 1};
    const ovoid_robot_path_query query = {&(ovoid_robot_path){path, 2}, &path_options};
    CHECK_EQ(ovoid_robot_path_find_hit(a->checker, &query, &answer, &error), OVOID_OK);
    CHECK_EQ(answer.status, status);
}

// Edges that meet the base at their end, at their beginning, nearly.
static void check_fold(arm *a) {
    static const double edges[4][4] = {{0, 0, 0, 2.9}, {0, 2.9, 0, 0}, {0, -2.9, 0, 1}, {0, -1.5, 0, 1.5}};
    const ovoid_robot_path_options options = {.any_hit = 1};
    for (int i = 0; i < 4; i++) {
        const ovoid_robot_path_query query = {&(ovoid_robot_path){edges[i], 2}, &options};
        ovoid_robot_path_answer answer;
        CHECK_EQ(ovoid_robot_path_find_hit(a->checker, &query, &answer, &error), OVOID_OK);
        CHECK_EQ(answer.status, i < 3 ? OVOID_ROBOT_HIT : OVOID_ROBOT_FREE);
    }
}

// The tip is 0.6 from the base at 0 and 0, and meets it at 0 and 2.9; neighbours are always 0.1 apart.
static void test_cells(void) {
    const double straight[2] = {0, 0}, folded[2] = {0, 2.9}, values[2] = {0, 0};
    arm a;
    make_arm(&a);
    CHECK_EQ(robot_get_pair_tables(a.r)->count, 3);
    const pair_table *t = pair_tables_find(robot_get_pair_tables(a.r), 0, 2);
    CHECK(t && pair_table_is_far(t, values, 1, 0));
    check_status(&a, straight, 0, OVOID_ROBOT_FREE);
    check_status(&a, folded, 0, OVOID_ROBOT_HIT);
    check_fold(&a);
    check_status(&a, straight, 0.0999, OVOID_ROBOT_FREE);
    check_status(&a, straight, 0.1001, OVOID_ROBOT_HIT);
    for (uint32_t i = 0; i < 2; i++) CHECK_EQ(ovoid_robot_cell_add_allowed(a.cell, i, i + 1, &error), OVOID_OK);
    check_status(&a, straight, 0.5999, OVOID_ROBOT_FREE);
    check_status(&a, straight, 0.6001, OVOID_ROBOT_HIT);
    // A table is of elements, so not of what a link holds: a sphere that reaches from the tip to the base.
    ovoid_robot_attachment held = {.link = 2, .body = {.shape = shapes[2], .pose = {{-0.4, 0, 0}, {1, 0, 0, 0}}}};
    const uint32_t touching = 1;
    held.touching = &touching, held.touching_count = 1;
    ovoid_id id = ovoid_robot_cell_attach(a.cell, &held, &error);
    CHECK(id != 0);
    check_status(&a, straight, 0, OVOID_ROBOT_HIT);
    CHECK_EQ(ovoid_robot_cell_remove(a.cell, id, &error), OVOID_OK);
    check_status(&a, straight, 0, OVOID_ROBOT_FREE);
    // Held by the base.
    held.link = 0, held.body.pose.position.x = 0.9;
    id = ovoid_robot_cell_attach(a.cell, &held, &error);
    check_status(&a, straight, 0, OVOID_ROBOT_HIT);
    CHECK_EQ(ovoid_robot_cell_remove(a.cell, id, &error), OVOID_OK);
    // A pair that is allowed is not queried, and is again after that.
    CHECK_EQ(ovoid_robot_cell_add_allowed(a.cell, 0, 2, &error), OVOID_OK);
    CHECK_EQ(ovoid_robot_cell_remove_allowed(a.cell, 0, 1, &error), OVOID_OK);
    check_status(&a, folded, 0, OVOID_ROBOT_FREE);
    CHECK_EQ(ovoid_robot_cell_remove_allowed(a.cell, 0, 2, &error), OVOID_OK);
    check_status(&a, folded, 0, OVOID_ROBOT_HIT);
    destroy_arm(&a);
}

// A state beyond the limits is not the table's.
static void test_limits(void) {
    arm a;
    make_arm(&a);
    const double q[2] = {0, 3.1};
    const ovoid_robot_query_options options = {.limit_slack = INFINITY};
    ovoid_robot_answer is;
    CHECK_EQ(ovoid_robot_collide(a.checker, &(ovoid_robot_query){q, &options}, &is, &error), OVOID_OK);
    CHECK_EQ(is.status, OVOID_ROBOT_HIT);
    const pair_table *t = pair_tables_find(robot_get_pair_tables(a.r), 0, 1);
    const double beyond[2] = {3.0001, 0}, at[2] = {3, 0}, nowhere[2] = {NAN, 0}, far_off[2] = {1e300, 0};
    CHECK(pair_table_is_far(t, at, 1, 0) && !pair_table_is_far(t, beyond, 1, 0));
    CHECK(!pair_table_is_far(t, nowhere, 1, 0) && !pair_table_is_far(t, far_off, 1, 0));
    CHECK(!pair_table_is_apart(t, &(table_range){{2.9, 0}, {3.0001, 0}}));
    CHECK(pair_table_is_apart(t, &(table_range){{-3, 0}, {3, 0}}));
    CHECK(!pair_table_is_apart(t, &(table_range){{NAN, 0}, {3, 0}}));
    CHECK(!pair_table_is_apart(t, &(table_range){{-3, 0}, {INFINITY, 0}}));
    destroy_arm(&a);
}

// A long arm that slides, on a turning joint, past a ball that only the farthest reach meets: each cell is asked at its
// corners and its middle. A lever without what slides would call cells apart that are not.
static void test_slide(void) {
    const ovoid_pose same = ovoid_pose_make_identity(), ball = {{2.1, 0, 0}, {1, 0, 0, 0}};
    const ovoid_robot_link links[3] = {{"base"}, {"turning"}, {"sliding"}};
    ovoid_robot_joint joints[2];
    for (uint32_t i = 0; i < 2; i++)
        joints[i] = (ovoid_robot_joint){.name = i ? "slide" : "turn",
                                        .type = i ? OVOID_JOINT_PRISMATIC : OVOID_JOINT_REVOLUTE,
                                        .parent = i,
                                        .child = i + 1,
                                        .origin = same,
                                        .axis = {i, 0, !i},
                                        .lower = i ? 0 : -3,
                                        .upper = i ? 2 : 3,
                                        .mimic = OVOID_ROBOT_NONE};
    const ovoid_robot_element elements[2] = {{0, NULL, shapes[2], ball, NULL}, {2, NULL, shapes[2], same, NULL}};
    const ovoid_robot_description d = {
        .links = links, .link_count = 3, .joints = joints, .joint_count = 2, .elements = elements, .element_count = 2};
    ovoid_robot *r = ovoid_robot_create(&d, NULL, &error);
    const pair_table *t = pair_tables_find(robot_get_pair_tables(r), 0, 2);
    CHECK(t && t->codes);
    long proven = 0, count = (long)t->axes[0].count * t->axes[1].count;
    for (uint32_t k = 0; k < t->axes[1].count; k++)
        for (uint32_t i = 0; i < t->axes[0].count; i++) {
            uint32_t code = t->codes[(size_t)k * t->axes[0].count + i];
            proven += code > 0;
            // The spheres' distance in closed form, at five places of the cell.
            for (int n = 0; code > 0 && n < 5; n++) {
                double q[2];
                q[t->axes[0].variable] = t->axes[0].low + (i + (n == 4 ? 0.5 : n % 2)) / t->axes[0].scale;
                q[t->axes[1].variable] = t->axes[1].low + (k + (n == 4 ? 0.5 : n / 2)) / t->axes[1].scale;
                double angle = q[0], slide = q[1];
                double apart = hypot(slide * cos(angle) - 2.1, slide * sin(angle)) - 0.4;
                if (!(apart > (code - 1) * t->unit - near_enough)) CHECK_LE((code - 1) * t->unit, apart);
            }
        }
    // Of all states less than 0.01 hit.
    CHECK(proven > 0.98 * (double)count && proven < count);
    ovoid_robot_destroy(r);
}

static void test_left_out(void) {
    uint64_t s = 4;
    random_robot a;
    ovoid_robot *r = make_robot(&s, &a, NULL);
    robot_leave_out_pair_tables(r);
    const pair_tables *tables = robot_get_pair_tables(r);
    CHECK(tables && tables->count == 0 && !pair_tables_find(tables, 0, 1));
    ovoid_robot_destroy(r);
}

// ---- threads and memory

static void *get_tables(void *robot) { return (void *)(uintptr_t)robot_get_pair_tables(robot); }

static void test_threads(void) {
    for (uint64_t seed = 1; seed <= 20; seed++) {
        uint64_t s = seed;
        random_robot a;
        ovoid_robot *r = make_robot(&s, &a, NULL);
        pthread_t threads[THREADS];
        for (int i = 0; i < THREADS; i++) CHECK(pthread_create(&threads[i], NULL, get_tables, r) == 0);
        for (int i = 0; i < THREADS; i++) {
            void *got = NULL;
            CHECK(pthread_join(threads[i], &got) == 0 && got == (void *)(uintptr_t)robot_get_pair_tables(r));
        }
        ovoid_robot_destroy(r);
    }
}

// For every k the k-th allocation fails: then there are no tables, nothing is held, and a later call makes them.
static void test_memory(void) {
    uint64_t s = 4;
    random_robot a;
    countdown left = {.left = 1 << 20};
    ovoid_allocator allocator = countdown_make_allocator(&left);
    ovoid_robot *r = make_robot(&s, &a, &allocator);
    long held = left.held, k = 0;
    for (const pair_tables *tables = NULL; !tables && CHECK(k < 200); k++) {
        left.left = k;
        tables = robot_get_pair_tables(r);
        if (!tables) CHECK_EQ(left.held, held);
        if (tables) CHECK(tables->count > 1);
    }
    CHECK(k > 12);
    left.left = 0;
    CHECK(robot_get_pair_tables(r));
    ovoid_robot_destroy(r);
    CHECK_EQ(left.held, 0);
}

int main(void) {
    make_shapes();
    test_around();
    test_tables();
    test_cells();
    test_limits();
    test_slide();
    test_left_out();
    test_threads();
    test_memory();
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
