// States among obstacles: free or not, the near pairs, the nearest, gradients. Truth: all pairs by ovoid_depth at the
// poses of ovoid_robot_compute_poses, which pairs count being worked out here from the tree; differences of distances
// for the gradients. Brackets of the truth are 1e-11 wide at most, poses are off by less.
#include "check.h"
#include "countdown.h"
#include "robots.h"

enum { SHAPES = 6, OBSTACLES = 7, ITEMS = 2 * ROBOT_LINKS + 4 };
static ovoid_shape *shapes[SHAPES];
static ovoid_compound *compound;
static ovoid_error error;
static const double near_enough = 1e-11;

static void make_shapes(void) {
    uint64_t s = 5;
    double xyz[60];
    for (int i = 0; i < 60; i++) xyz[i] = random_uniform(&s, -0.2, 0.2);
    shapes[0] = ovoid_shape_create_box((ovoid_vec3){0.1, 0.05, 0.2}, NULL, &error);
    shapes[1] = ovoid_shape_create_sphere(0.15, NULL, &error);
    shapes[2] = ovoid_shape_create_capsule(0.05, 0.2, NULL, &error);
    shapes[3] = ovoid_shape_create_from_points(xyz, 20, NULL, &error);
    shapes[4] = ovoid_shape_create_from_points(xyz, 12, &(ovoid_shape_options){.radius = 0.03}, &error);
    shapes[5] = ovoid_shape_create_cylinder(0.1, 0.2, NULL, &error);
    ovoid_posed_shape parts[2] = {{shapes[0], {{0.3, 0, 0}, {1, 0.5, 0, 0}}},
                                  {shapes[4], {{-0.2, 0.1, 0}, {1, 0, 0, 2}}}};
    compound = ovoid_compound_create(parts, 2, NULL, &error);
    for (int i = 0; i < SHAPES; i++)
        if (!shapes[i] || !compound) exit(1);
}

// A robot among obstacles, and what the truth needs to know of it.
typedef struct scene {
    random_robot a;
    ovoid_robot_pair disabled[4];
    ovoid_robot *r;
    ovoid_robot_cell *cell;
    ovoid_body obstacles[OBSTACLES], held;
    ovoid_id ids[OBSTACLES], held_id;
    uint32_t held_link, held_touches, allowed[2], free_obstacle, free_link;
    double padding[ROBOT_LINKS];
} scene;

static void add_elements(uint64_t *s, scene *c) {
    size_t count = 0;
    for (uint32_t i = 0; i < c->a.d.link_count; i++)
        for (uint32_t k = random_below(s, 3); k > 0; k--) {
            ovoid_pose pose = random_below(s, 2) ? ovoid_pose_make_identity() : random_pose(s, 0.1);
            c->a.elements[count++] = (ovoid_robot_element){i, NULL, shapes[random_below(s, SHAPES)], pose, NULL};
        }
    c->a.d.element_count = count;
}

static ovoid_body random_body(uint64_t *s, double scale) {
    ovoid_body b = {.pose = random_pose(s, scale)};
    if (random_below(s, 4) == 0)
        b.compound = compound;
    else
        b.shape = shapes[random_below(s, SHAPES)];
    return b;
}

static void make_scene(uint64_t *s, scene *c) {
    make_random_robot(s, &c->a);
    uint32_t links = (uint32_t)c->a.d.link_count;
    add_elements(s, c);
    for (int i = 0; i < 4; i++)
        c->disabled[i] = (ovoid_robot_pair){random_below(s, links), random_below(s, links), NULL};
    c->a.d.disabled = c->disabled, c->a.d.disabled_count = 4;
    c->r = ovoid_robot_create(&c->a.d, NULL, &error);
    c->cell = ovoid_robot_cell_create(c->r, NULL, &error);
    if (!c->cell) exit(1);
    for (int i = 0; i < OBSTACLES; i++) {
        c->obstacles[i] = random_body(s, 1.5);
        c->ids[i] = ovoid_robot_cell_add(c->cell, &c->obstacles[i], &error);
        CHECK(c->ids[i] != 0);
    }
    c->held = random_body(s, 0.2);
    c->held_link = random_below(s, links), c->held_touches = random_below(s, links);
    c->held_id =
        ovoid_robot_cell_attach(c->cell, &(ovoid_robot_attachment){c->held_link, c->held, &c->held_touches, 1}, &error);
    CHECK(c->held_id != 0);
    c->allowed[0] = random_below(s, links), c->allowed[1] = (c->allowed[0] + 1 + random_below(s, links - 1)) % links;
    CHECK_EQ(ovoid_robot_cell_add_allowed(c->cell, c->allowed[0], c->allowed[1], &error), OVOID_OK);
    c->free_obstacle = random_below(s, OBSTACLES), c->free_link = random_below(s, links);
    CHECK_EQ(ovoid_robot_cell_add_body_allowed(c->cell, c->ids[c->free_obstacle], c->free_link, &error), OVOID_OK);
    for (uint32_t i = 0; i < links; i++) {
        c->padding[i] = random_below(s, 3) ? 0 : 0.02;
        CHECK_EQ(ovoid_robot_cell_set_padding(c->cell, i, c->padding[i], &error), OVOID_OK);
    }
}

static void destroy_scene(scene *c) {
    ovoid_robot_cell_destroy(c->cell);
    ovoid_robot_destroy(c->r);
}

// ---- the truth

typedef struct true_item {
    ovoid_posed_shape posed;
    ovoid_robot_side side;
} true_item;

typedef struct true_pair {
    true_item a, b;
    double padding;
    ovoid_answer answer;
} true_pair;

static size_t add_body_items(const ovoid_body *body, const ovoid_pose *pose, ovoid_robot_side side, true_item *items) {
    size_t count = body->shape ? 1 : ovoid_compound_get_part_count(body->compound);
    for (size_t i = 0; i < count; i++) {
        ovoid_posed_shape part = {body->shape, ovoid_pose_make_identity()};
        if (!body->shape) part = ovoid_compound_get_part(body->compound, i);
        part.pose = body->shape ? *pose : ovoid_pose_compute_product(pose, &part.pose);
        side.part = (uint32_t)i;
        items[i] = (true_item){part, side};
    }
    return count;
}

static uint32_t find_top(const scene *c, uint32_t link) {
    for (;;) {
        uint32_t j = ovoid_robot_get_parent_joint(c->r, link);
        if (j == OVOID_ROBOT_NONE || c->a.joints[j].type != OVOID_JOINT_FIXED) return link;
        link = c->a.joints[j].parent;
    }
}

static int is_pair(uint32_t a, uint32_t b, uint32_t x, uint32_t y) { return (a == x && b == y) || (a == y && b == x); }

static int counts(const scene *c, const ovoid_robot_side *a, const ovoid_robot_side *b) {
    if (b->link == OVOID_ROBOT_NONE) return !(b->body == c->ids[c->free_obstacle] && a->link == c->free_link);
    if (find_top(c, a->link) == find_top(c, b->link)) return 0;
    if (b->body) return a->link != c->held_touches;
    if (is_pair(a->link, b->link, c->allowed[0], c->allowed[1])) return 0;
    for (int i = 0; i < 4; i++)
        if (is_pair(a->link, b->link, c->disabled[i].a, c->disabled[i].b)) return 0;
    return 1;
}

// What a cell says of its pairs and paddings is what was set.
static void check_settings(const scene *c) {
    for (uint32_t a = 0; a < c->a.d.link_count; a++) {
        const ovoid_robot_side side = {.link = a};
        for (uint32_t b = 0; b < c->a.d.link_count; b++) {
            const ovoid_robot_side other = {.link = b};
            CHECK_EQ(ovoid_robot_cell_is_allowed(c->cell, a, b), !counts(c, &side, &other));
        }
        for (int i = 0; i < OBSTACLES; i++) {
            const ovoid_robot_side obstacle = {.link = OVOID_ROBOT_NONE, .body = c->ids[i]};
            CHECK_EQ(ovoid_robot_cell_is_body_allowed(c->cell, c->ids[i], a), !counts(c, &side, &obstacle));
        }
        const ovoid_robot_side held = {.link = c->held_link, .body = c->held_id};
        CHECK_EQ(ovoid_robot_cell_is_body_allowed(c->cell, c->held_id, a), !counts(c, &side, &held));
        CHECK_EQ(ovoid_robot_cell_is_body_allowed(c->cell, c->held_id + 1, a), 0);
        CHECK_EQ(ovoid_robot_cell_get_padding(c->cell, a), c->padding[a]);
    }
}

// All pairs that count, with their depths.
static size_t find_truth(const scene *c, const double *q, true_pair *pairs) {
    ovoid_pose poses[ROBOT_LINKS];
    true_item items[ITEMS + 2 * OBSTACLES];
    size_t moving = 0, count = 0;
    CHECK_EQ(ovoid_robot_compute_poses(c->r, q, poses, &error), OVOID_OK);
    for (uint32_t i = 0; i < c->a.d.element_count; i++) {
        const ovoid_robot_element *e = &c->a.elements[i];
        items[moving++] =
            (true_item){{e->shape, ovoid_pose_compute_product(&poses[e->link], &e->pose)}, {e->link, i, 0, 0}};
    }
    ovoid_pose held = ovoid_pose_compute_product(&poses[c->held_link], &c->held.pose);
    moving += add_body_items(&c->held, &held, (ovoid_robot_side){c->held_link, OVOID_ROBOT_NONE, c->held_id, 0},
                             items + moving);
    size_t all = moving;
    for (int i = 0; i < OBSTACLES; i++)
        all += add_body_items(&c->obstacles[i], &c->obstacles[i].pose,
                              (ovoid_robot_side){OVOID_ROBOT_NONE, OVOID_ROBOT_NONE, c->ids[i], 0}, items + all);
    for (size_t a = 0; a < moving; a++)
        for (size_t b = a + 1; b < all; b++) {
            if (!counts(c, &items[a].side, &items[b].side)) continue;
            ovoid_pair pair = {items[a].posed.shape, items[b].posed.shape, items[a].posed.pose, items[b].posed.pose};
            ovoid_options options = {.relative_tolerance = 1e-12};
            true_pair *p = &pairs[count++];
            *p = (true_pair){items[a], items[b], b >= moving ? c->padding[items[a].side.link] : 0,
                             ovoid_depth(&pair, &options, NULL, NULL)};
            p->answer.lower -= p->padding, p->answer.upper -= p->padding;
        }
    return count;
}

static int same_side(const ovoid_robot_side *a, const ovoid_robot_side *b) {
    return a->link == b->link && a->element == b->element && a->body == b->body && a->part == b->part;
}
// In either order.
static const true_pair *find_true_pair(const true_pair *pairs, size_t count, const ovoid_robot_side *a,
                                       const ovoid_robot_side *b) {
    for (size_t i = 0; i < count; i++) {
        const ovoid_robot_side *x = &pairs[i].a.side, *y = &pairs[i].b.side;
        if ((same_side(x, a) && same_side(y, b)) || (same_side(x, b) && same_side(y, a))) return &pairs[i];
    }
    return NULL;
}

// ---- comparisons

static long free_count, hit_count, row_count, wide_count;

static void compare_check(const scene *c, ovoid_robot_checker *x, const double *q, const true_pair *pairs,
                          size_t count) {
    static const double margins[3] = {0, 0.05, 0.4};
    for (int m = 0; m < 3; m++) {
        ovoid_robot_query_options options = {.margin = margins[m], .limit_slack = 0};
        ovoid_robot_answer is;
        CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){q, &options}, &is, &error), OVOID_OK);
        double least = INFINITY;
        for (size_t i = 0; i < count; i++) least = fmin(least, pairs[i].answer.lower);
        if (is.status == OVOID_ROBOT_FREE) {
            for (size_t i = 0; i < count; i++) CHECK_LE(margins[m], pairs[i].answer.upper + near_enough);
            free_count++;
            continue;
        }
        const true_pair *p = find_true_pair(pairs, count, &is.a, &is.b);
        CHECK(p != NULL);
        CHECK_EQ(is.status, OVOID_ROBOT_HIT); // no pair of these is as near to the margin as rounding
        if (!p) continue;
        CHECK_LE(is.upper, margins[m]);
        CHECK_LE(p->answer.lower - near_enough, margins[m]);
        CHECK_LE(is.lower, p->answer.upper + near_enough);
        CHECK_LE(p->answer.lower, is.upper + near_enough);
        hit_count++;
    }
    (void)c;
}

static void compare_near(const scene *c, ovoid_robot_checker *x, const double *q, const true_pair *pairs,
                         size_t count) {
    enum { MOST = 1000 };
    static ovoid_robot_near items[MOST];
    static double rows[MOST * 7 * ROBOT_LINKS];
    size_t variables = ovoid_robot_get_variable_count(c->r);
    ovoid_robot_query_options options = {.margin = 0.3};
    ovoid_robot_nears nears = {.items = items, .gradients = rows, .capacity = MOST};
    CHECK_LE(variables, 7 * ROBOT_LINKS);
    CHECK_EQ(ovoid_robot_find_near(x, &(ovoid_robot_query){q, &options}, &nears, &error), OVOID_OK);
    size_t expected = 0;
    double least = INFINITY;
    for (size_t i = 0; i < count; i++) {
        expected += pairs[i].answer.lower <= 0.3;
        least = fmin(least, pairs[i].answer.lower);
    }
    CHECK_EQ(nears.count, expected);
    for (size_t i = 0; i < nears.count && i < MOST; i++) {
        const ovoid_robot_near *n = &items[i];
        const true_pair *p = find_true_pair(pairs, count, &n->a, &n->b);
        CHECK(p != NULL);
        if (!p) continue;
        CHECK_LE(n->lower, p->answer.upper + near_enough);
        CHECK_LE(p->answer.lower, n->upper + near_enough);
        CHECK(i == 0 || items[i - 1].lower <= n->lower);
        if (n->upper - n->lower > 1e-7) continue; // an allowance, or a depth that a limit ended
        double x_ = n->point_b.x - n->point_a.x, y = n->point_b.y - n->point_a.y, z = n->point_b.z - n->point_a.z;
        CHECK_NEAR(x_ * n->normal.x + y * n->normal.y + z * n->normal.z, n->upper, 1e-7);
    }
    // With little room, the nearest, and their own rows.
    enum { FEW = 5 };
    ovoid_robot_near few[FEW];
    double own[FEW * 7 * ROBOT_LINKS];
    ovoid_robot_nears some = {.items = few, .gradients = own, .capacity = FEW};
    CHECK_EQ(ovoid_robot_find_near(x, &(ovoid_robot_query){q, &options}, &some, &error), OVOID_OK);
    CHECK_EQ(some.count, expected);
    for (size_t i = 0; i < FEW && i < expected; i++) {
        CHECK_NEAR(few[i].lower, items[i].lower, 1e-8);
        int is_same = same_side(&few[i].a, &items[i].a) && same_side(&few[i].b, &items[i].b);
        if (!is_same || !few[i].has_gradient || !items[i].has_gradient) continue;
        for (size_t v = 0; v < variables; v++) CHECK_NEAR(own[i * variables + v], rows[i * variables + v], 1e-5);
        row_count++;
    }
    // Without depths: the same pairs, overlaps by brackets that hold.
    static ovoid_robot_near plain_items[MOST];
    ovoid_robot_nears plain = {.items = plain_items, .capacity = MOST, .without_depths = 1};
    for (int round = 0; round < 2; round++) {
        CHECK_EQ(ovoid_robot_find_near(x, &(ovoid_robot_query){q, &options}, &plain, &error), OVOID_OK);
        CHECK_EQ(plain.count, expected);
        for (size_t i = 0; i < plain.count && i < MOST; i++) {
            const true_pair *p = find_true_pair(pairs, count, &plain_items[i].a, &plain_items[i].b);
            CHECK(p != NULL);
            if (!p) continue;
            CHECK_LE(plain_items[i].lower, p->answer.upper + near_enough);
            CHECK_LE(p->answer.lower, plain_items[i].upper + near_enough);
            // Both are within the tolerance, 1e-9 of the pair's size, which is below 4.
            if (p->answer.lower > near_enough)
                CHECK_LE(plain_items[i].upper - plain_items[i].lower, p->answer.upper - p->answer.lower + 4e-9);
            if (p->answer.upper < -near_enough) CHECK_EQ(plain_items[i].status, OVOID_OVERLAPPING);
            wide_count += plain_items[i].upper - plain_items[i].lower > 1e-3;
        }
        ovoid_robot_checker_reset(x);
    }
    some.capacity = 0;
    CHECK_EQ(ovoid_robot_find_near(x, &(ovoid_robot_query){q, &options}, &some, &error), OVOID_OK);
    CHECK_EQ(some.count, expected);
    some.capacity = FEW;
    options.margin = INFINITY;
    CHECK_EQ(ovoid_robot_find_nearest(x, &(ovoid_robot_query){q, &options}, &some, &error), OVOID_OK);
    CHECK_EQ(some.count, count > 0);
    if (count) CHECK_LE(few[0].lower, least + near_enough);
}

static void test_truth(void) {
    uint64_t s = 6;
    static true_pair pairs[ITEMS * (ITEMS + 2 * OBSTACLES)];
    for (int round = 0; round < 60; round++) {
        scene c;
        check_seed = (uint64_t)round;
        make_scene(&s, &c);
        check_settings(&c);
        ovoid_robot_checker *x = ovoid_robot_checker_create(c.cell, NULL, &error);
        CHECK(x != NULL);
        double q[7 * ROBOT_LINKS];
        for (int k = 0; k < 6; k++) {
            make_random_state(&s, c.r, q);
            size_t count = find_truth(&c, q, pairs);
            compare_check(&c, x, q, pairs, count);
            compare_near(&c, x, q, pairs, count);
            // Obstacles that move between states.
            c.obstacles[k].pose = random_pose(&s, 1.5);
            CHECK_EQ(ovoid_robot_cell_move(c.cell, c.ids[k], &c.obstacles[k].pose, &error), OVOID_OK);
        }
        ovoid_robot_checker_destroy(x);
        destroy_scene(&c);
    }
    check_seed = 0;
    CHECK_LE(200, free_count);
    CHECK_LE(200, hit_count);
    CHECK_LE(200, row_count);
    CHECK_LE(100, wide_count);
}

// ---- batches

static int same_answer(const ovoid_robot_answer *a, const ovoid_robot_answer *b) {
    return a->status == b->status && a->code == b->code && a->variable == b->variable && same_side(&a->a, &b->a) &&
           same_side(&a->b, &b->b) && memcmp(&a->lower, &b->lower, 2 * sizeof a->lower) == 0;
}

// A batch on one thread and on three has the bits of its states asked one by one, block by block.
static void test_batches(void) {
    enum { COUNT = 2 * OVOID_ROBOT_BLOCK + 77 };
    static ovoid_robot_answer answers[2][COUNT];
    static double q[COUNT * 7 * ROBOT_LINKS];
    uint64_t s = 10;
    long statuses[4] = {0};
    for (int round = 0; round < 8; round++) {
        scene c;
        check_seed = (uint64_t)round;
        make_scene(&s, &c);
        size_t n = ovoid_robot_get_variable_count(c.r);
        for (size_t i = 0; i < COUNT; i++) make_random_state(&s, c.r, q + i * n);
        if (n) q[5 * n] = NAN, q[9 * n + n - 1] = 1e60;
        // Lengths whose errors are larger than their neighbours'.
        for (size_t i = 11; n && i < COUNT; i += 13)
            for (size_t v = 0; v < n; v++) q[i * n + v] *= 64;
        ovoid_robot_checker *x[3];
        for (int i = 0; i < 3; i++) x[i] = ovoid_robot_checker_create(c.cell, NULL, &error);
        ovoid_robot_query_options options = {.margin = round % 2 ? 0.05 : 0, .limit_slack = round % 3 ? 0 : INFINITY};
        for (size_t threads = 1; threads <= 3; threads += 2) {
            ovoid_robot_batch batch = {q, COUNT, &options, answers[threads / 2]};
            CHECK_EQ(ovoid_robot_collide_batch(x, threads, &batch, &error), OVOID_OK);
        }
        for (size_t i = 0; i < COUNT; i++) {
            ovoid_robot_answer alone;
            if (i % OVOID_ROBOT_BLOCK == 0) ovoid_robot_checker_reset(x[0]);
            CHECK_EQ(ovoid_robot_collide(x[0], &(ovoid_robot_query){q + i * n, &options}, &alone, &error), OVOID_OK);
            CHECK(same_answer(&alone, &answers[0][i]) && same_answer(&alone, &answers[1][i]));
            statuses[alone.status]++;
        }
        options.limit_slack = NAN;
        ovoid_robot_batch batch = {q, COUNT, &options, answers[0]};
        CHECK_EQ(ovoid_robot_collide_batch(x, 1, &batch, &error), OVOID_ERROR_ARGUMENT);
        CHECK_EQ(ovoid_robot_collide_batch(x, 0, &batch, &error), OVOID_ERROR_ARGUMENT);
        for (int i = 0; i < 3; i++) ovoid_robot_checker_destroy(x[i]);
        destroy_scene(&c);
    }
    check_seed = 0;
    for (int i = OVOID_ROBOT_FREE; i <= OVOID_ROBOT_REFUSED; i++) CHECK_LE(10, statuses[i]);
}

// ---- gradients

static double find_distance(ovoid_robot_checker *x, const double *q, const ovoid_robot_near *of) {
    static ovoid_robot_near items[1000];
    ovoid_robot_query_options options = {.margin = 1, .limit_slack = INFINITY};
    ovoid_robot_nears nears = {.items = items, .capacity = 1000};
    (void)ovoid_robot_find_near(x, &(ovoid_robot_query){q, &options}, &nears, &error);
    for (size_t i = 0; i < nears.count; i++)
        if (same_side(&items[i].a, &of->a) && same_side(&items[i].b, &of->b))
            return (items[i].lower + items[i].upper) / 2;
    return NAN;
}

static long gradients_compared;

// Central differences of two widths; where they agree, the gradient is compared with the finer one.
static void compare_gradient(ovoid_robot_checker *x, double *q, size_t n, const ovoid_robot_near *of,
                             const double *row) {
    for (size_t v = 0; v < n; v++) {
        double at = q[v], d[2];
        for (int k = 0; k < 2; k++) {
            double h = k ? 1e-4 : 2e-4;
            q[v] = at + h;
            double high = find_distance(x, q, of), right = q[v];
            q[v] = at - h;
            d[k] = (high - find_distance(x, q, of)) / (right - q[v]);
        }
        q[v] = at;
        if (!(fabs(d[0] - d[1]) < 1e-6)) continue;
        CHECK_NEAR(row[v], d[1], 2e-6);
        gradients_compared++;
    }
}

static void test_gradients(void) {
    uint64_t s = 7;
    enum { MOST = 40 };
    for (int round = 0; round < 25; round++) {
        scene c;
        check_seed = (uint64_t)round;
        make_scene(&s, &c);
        ovoid_robot_checker *x = ovoid_robot_checker_create(c.cell, NULL, &error);
        if (!x) exit(1);
        double q[7 * ROBOT_LINKS];
        static double rows[MOST * 7 * ROBOT_LINKS];
        ovoid_robot_near items[MOST];
        make_random_state(&s, c.r, q);
        ovoid_robot_query_options options = {.margin = 0.5};
        ovoid_robot_nears nears = {.items = items, .gradients = rows, .capacity = MOST};
        CHECK_EQ(ovoid_robot_find_near(x, &(ovoid_robot_query){q, &options}, &nears, &error), OVOID_OK);
        size_t n = ovoid_robot_get_variable_count(c.r), kept = nears.count < MOST ? nears.count : MOST;
        // Differences of brackets are those of the shapes; gradients of cylinders are those of true cylinders, which
        // test_gradient_round compares.
        for (size_t i = 0; i < kept; i += 3)
            if (items[i].has_gradient && items[i].upper - items[i].lower < 1e-6)
                compare_gradient(x, q, n, &items[i], rows + i * n);
        ovoid_robot_checker_destroy(x);
        destroy_scene(&c);
    }
    check_seed = 0;
    CHECK_LE(500, gradients_compared);
}

// ---- refusals, memory

static void test_refusals(void) {
    uint64_t s = 8;
    scene c;
    make_scene(&s, &c);
    ovoid_robot_checker *x = ovoid_robot_checker_create(c.cell, NULL, &error);
    double q[7 * ROBOT_LINKS];
    make_random_state(&s, c.r, q);
    ovoid_robot_answer is;
    ovoid_robot_near item;
    ovoid_robot_nears nears = {.items = &item};
    ovoid_robot_query_options options = {.margin = -1};
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){q, &options}, &is, &error), OVOID_ERROR_ARGUMENT);
    CHECK_EQ(is.status, OVOID_ROBOT_UNDECIDED);
    CHECK_EQ(ovoid_robot_find_nearest(x, &(ovoid_robot_query){q, NULL}, &nears, &error), OVOID_ERROR_ARGUMENT);
    size_t limited = 0;
    while (!isfinite(ovoid_robot_get_variable(c.r, limited).upper)) limited++;
    q[limited] = ovoid_robot_get_variable(c.r, limited).upper + 0.25;
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){q, NULL}, &is, &error), OVOID_OK);
    CHECK(is.status == OVOID_ROBOT_REFUSED && is.code == OVOID_ERROR_RANGE && is.variable == limited);
    CHECK_EQ(ovoid_robot_find_near(x, &(ovoid_robot_query){q, NULL}, &nears, &error), OVOID_ERROR_RANGE);
    options = (ovoid_robot_query_options){.limit_slack = 0.25};
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){q, &options}, &is, &error), OVOID_OK);
    CHECK(is.status != OVOID_ROBOT_REFUSED);
    q[limited] = NAN;
    options.limit_slack = INFINITY;
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){q, &options}, &is, &error), OVOID_OK);
    CHECK(is.status == OVOID_ROBOT_REFUSED && is.code == OVOID_ERROR_NOT_FINITE && is.variable == limited);
    // Bodies.
    ovoid_body none = {.pose = ovoid_pose_make_identity()};
    CHECK_EQ(ovoid_robot_cell_add(c.cell, &none, &error), (ovoid_id)0);
    CHECK_EQ(error.code, OVOID_ERROR_ARGUMENT);
    none.shape = shapes[0], none.pose.position.x = NAN;
    CHECK_EQ(ovoid_robot_cell_add(c.cell, &none, &error), (ovoid_id)0);
    CHECK_EQ(error.code, OVOID_ERROR_NOT_FINITE);
    CHECK_EQ(ovoid_robot_cell_move(c.cell, c.ids[0], &none.pose, &error), OVOID_ERROR_NOT_FINITE);
    CHECK_EQ(ovoid_robot_cell_attach(c.cell, &(ovoid_robot_attachment){99, c.held, NULL, 0}, &error), (ovoid_id)0);
    CHECK_EQ(error.code, OVOID_ERROR_INDEX);
    uint32_t there_is_none = 99;
    CHECK_EQ(ovoid_robot_cell_attach(c.cell, &(ovoid_robot_attachment){0, c.held, &there_is_none, 1}, &error),
             (ovoid_id)0);
    CHECK_EQ(error.code, OVOID_ERROR_INDEX);
    CHECK_EQ(ovoid_robot_cell_add_allowed(c.cell, 0, 0, &error), OVOID_ERROR_ARGUMENT);
    CHECK_EQ(ovoid_robot_cell_add_allowed(c.cell, 0, 99, &error), OVOID_ERROR_INDEX);
    CHECK_EQ(ovoid_robot_cell_set_padding(c.cell, 0, -1, &error), OVOID_ERROR_RADIUS);
    CHECK_EQ(ovoid_robot_cell_set_padding(c.cell, 99, 0, &error), OVOID_ERROR_INDEX);
    CHECK_EQ(ovoid_robot_cell_remove(c.cell, c.ids[2], &error), OVOID_OK);
    CHECK_EQ(ovoid_robot_cell_remove(c.cell, c.ids[2], &error), OVOID_ERROR_INDEX);
    CHECK_EQ(ovoid_robot_cell_add_body_allowed(c.cell, c.ids[2], 0, &error), OVOID_ERROR_INDEX);
    ovoid_id again = ovoid_robot_cell_add(c.cell, &c.obstacles[2], &error);
    CHECK(again >> 32 == c.ids[2] >> 32 && again != c.ids[2]);
    CHECK(ovoid_robot_cell_create(NULL, NULL, &error) == NULL);
    CHECK(ovoid_robot_checker_create(NULL, NULL, &error) == NULL);
    ovoid_robot_checker_destroy(x);
    destroy_scene(&c);
}

// Two boxes on one slide: the margin is exact to rounding, removed and allowed bodies do not count, an attached one
// does.
static void test_by_hand(void) {
    ovoid_robot_link links[2] = {{"rail"}, {"cart"}};
    ovoid_robot_joint joint = {.name = "slide",
                               .type = OVOID_JOINT_PRISMATIC,
                               .parent = 0,
                               .child = 1,
                               .origin = {{0, 0, 0}, {1, 0, 0, 0}},
                               .axis = {1, 0, 0},
                               .lower = 0,
                               .upper = 10,
                               .mimic = OVOID_ROBOT_NONE};
    ovoid_robot_element element = {1, "box", shapes[0], ovoid_pose_make_identity(), NULL};
    ovoid_robot_description d = {
        .links = links, .link_count = 2, .joints = &joint, .joint_count = 1, .elements = &element, .element_count = 1};
    ovoid_robot *r = ovoid_robot_create(&d, NULL, &error);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(r, NULL, &error);
    ovoid_body wall = {.shape = shapes[0], .pose = {{5, 0, 0}, {1, 0, 0, 0}}};
    ovoid_id id = ovoid_robot_cell_add(cell, &wall, &error);
    ovoid_robot_checker *x = ovoid_robot_checker_create(cell, NULL, &error);
    ovoid_robot_answer is;
    ovoid_robot_query_options options = {.margin = 0.5};
    // Half sizes 0.1: the gap at q is 4.8 - q.
    for (double q = 4; q <= 5; q += 0.0625) {
        CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){&q, &options}, &is, &error), OVOID_OK);
        CHECK_EQ(is.status, q < 4.3 ? OVOID_ROBOT_FREE : OVOID_ROBOT_HIT);
    }
    double q = 4.3 + 1e-10;
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){&q, &options}, &is, &error), OVOID_OK);
    CHECK(is.status == OVOID_ROBOT_HIT && is.a.link == 1 && is.a.element == 0 && is.b.link == OVOID_ROBOT_NONE &&
          is.b.body == id);
    q = 4.3 - 1e-10;
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){&q, &options}, &is, &error), OVOID_OK);
    CHECK_EQ(is.status, OVOID_ROBOT_FREE);
    (void)ovoid_robot_cell_set_padding(cell, 1, 0.25, &error);
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){&q, &options}, &is, &error), OVOID_OK);
    CHECK_EQ(is.status, OVOID_ROBOT_HIT);
    CHECK_NEAR(is.upper, 0.25, 1e-3);
    options.without_obstacles = 1;
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){&q, &options}, &is, &error), OVOID_OK);
    CHECK(is.status == OVOID_ROBOT_UNDECIDED && is.code == OVOID_ERROR_EMPTY); // of no pair
    options.without_obstacles = 0;
    (void)ovoid_robot_cell_add_body_allowed(cell, id, 1, &error);
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){&q, &options}, &is, &error), OVOID_OK);
    CHECK(is.status == OVOID_ROBOT_UNDECIDED && is.code == OVOID_ERROR_EMPTY); // of no pair
    ovoid_body held = {.shape = shapes[1], .pose = {{0, 0, 1}, {1, 0, 0, 0}}};
    ovoid_id sphere = ovoid_robot_cell_attach(cell, &(ovoid_robot_attachment){1, held, NULL, 0}, &error);
    wall.pose.position.z = 1;
    ovoid_id second = ovoid_robot_cell_add(cell, &wall, &error);
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){&q, &options}, &is, &error), OVOID_OK);
    CHECK(is.status == OVOID_ROBOT_HIT && is.a.body == sphere && is.b.body == second && is.a.link == 1);
    // Both links, and a rail that an attached body touches.
    ovoid_body on_rail = {.shape = shapes[1], .pose = {{4, 0, 1}, {1, 0, 0, 0}}};
    (void)ovoid_robot_cell_remove(cell, second, &error);
    ovoid_id fixed = ovoid_robot_cell_attach(cell, &(ovoid_robot_attachment){0, on_rail, NULL, 0}, &error);
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){&q, &options}, &is, &error), OVOID_OK);
    CHECK(is.status == OVOID_ROBOT_HIT && is.a.body && is.b.body);
    options.without_self = 1;
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){&q, &options}, &is, &error), OVOID_OK);
    CHECK_EQ(is.status, OVOID_ROBOT_FREE);
    options.without_self = 0;
    (void)ovoid_robot_cell_add_body_allowed(cell, fixed, 1, &error);
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){&q, &options}, &is, &error), OVOID_OK);
    CHECK_EQ(is.status, OVOID_ROBOT_FREE);
    CHECK(ovoid_robot_is_rigid_pair(r, 0, 1) == 0 && ovoid_robot_is_rigid_pair(r, 1, 1) == 1);
    ovoid_robot_checker_destroy(x);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(r);
}

// A change whose memory ends is not half of one: queries say so, or find what was there.
static void test_half_changes(void) {
    uint64_t s = 11;
    scene c;
    make_scene(&s, &c);
    double q[7 * ROBOT_LINKS];
    make_random_state(&s, c.r, q);
    countdown left = {.left = 1 << 20};
    ovoid_allocator allocator = countdown_make_allocator(&left);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(c.r, &(ovoid_robot_cell_options){&allocator}, &error);
    ovoid_robot_checker *x = ovoid_robot_checker_create(cell, NULL, &error);
    ovoid_robot_answer is;
    left.left = 0;
    CHECK_EQ(ovoid_robot_cell_add(cell, &c.obstacles[0], &error), (ovoid_id)0);
    CHECK_EQ(error.code, OVOID_ERROR_MEMORY);
    CHECK_EQ(ovoid_robot_cell_remove_allowed(cell, 0, 1, &error), OVOID_ERROR_MEMORY);
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){q, NULL}, &is, &error), OVOID_ERROR_MEMORY);
    CHECK_EQ(is.status, OVOID_ROBOT_UNDECIDED);
    left.left = 1 << 20;
    CHECK_EQ(ovoid_robot_cell_remove_allowed(cell, 0, 1, &error), OVOID_OK);
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){q, NULL}, &is, &error), OVOID_OK);
    ovoid_robot_checker_destroy(x);
    ovoid_robot_cell_destroy(cell);
    CHECK_EQ(left.held, 0);
    destroy_scene(&c);
}

static void test_memory(void) {
    uint64_t s = 9;
    scene c;
    make_scene(&s, &c);
    double q[7 * ROBOT_LINKS];
    make_random_state(&s, c.r, q);
    for (long k = 0;; k++) {
        countdown left = {.left = k};
        ovoid_allocator allocator = countdown_make_allocator(&left);
        error = (ovoid_error){0};
        ovoid_robot_cell *cell = ovoid_robot_cell_create(c.r, &(ovoid_robot_cell_options){&allocator}, &error);
        ovoid_id id = cell ? ovoid_robot_cell_add(cell, &c.obstacles[0], &error) : 0;
        ovoid_robot_checker *x =
            cell ? ovoid_robot_checker_create(cell, &(ovoid_robot_checker_options){&allocator}, &error) : NULL;
        int is_done = id && x;
        if (!is_done) CHECK_EQ(error.code, OVOID_ERROR_MEMORY);
        if (x) { // queries allocate nothing, and find what there is
            left.left = 0;
            ovoid_robot_answer is;
            CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){q, NULL}, &is, &error), OVOID_OK);
        }
        ovoid_robot_checker_destroy(x);
        ovoid_robot_cell_destroy(cell);
        CHECK_EQ(left.held, 0);
        if (is_done) break;
    }
    destroy_scene(&c);
}

// Obstacles that were appended one by one stand where a cell puts them that is compiled at once: the answers have the
// same bits. Truth: test_truth, of a cell whose last change compiles all of it.
static void test_appended(void) {
    uint64_t s = 12;
    for (int round = 0; round < 20; round++) {
        scene c;
        make_scene(&s, &c);
        uint32_t links = (uint32_t)c.a.d.link_count;
        ovoid_robot_cell *cell = ovoid_robot_cell_create(c.r, NULL, &error);
        ovoid_robot_checker *x = ovoid_robot_checker_create(cell, NULL, &error);
        for (int i = 0; i < OBSTACLES; i++) {
            ovoid_id id = ovoid_robot_cell_add(cell, &c.obstacles[i], &error);
            if (!CHECK(id)) break;
            if (i == 3) CHECK_EQ(ovoid_robot_cell_add_body_allowed(cell, id, links - 1, &error), OVOID_OK);
            // One that is taken out leaves its slot to the next.
            if (i == 5) CHECK_EQ(ovoid_robot_cell_remove(cell, id, &error), OVOID_OK);
        }
        enum { ROOM = 64 };
        double q[7 * ROBOT_LINKS];
        ovoid_robot_near items[2][ROOM];
        ovoid_robot_nears nears[2] = {{.items = items[0], .capacity = ROOM}, {.items = items[1], .capacity = ROOM}};
        ovoid_robot_query_options options = {.margin = 0.5, .limit_slack = INFINITY};
        make_random_state(&s, c.r, q);
        for (int k = 0; k < 2; k++) {
            CHECK_EQ(ovoid_robot_find_near(x, &(ovoid_robot_query){q, &options}, &nears[k], &error), OVOID_OK);
            // Any change of links compiles all.
            CHECK_EQ(ovoid_robot_cell_remove_allowed(cell, 0, links - 1, &error), OVOID_OK);
        }
        CHECK_EQ(nears[0].count, nears[1].count);
        for (size_t i = 0; i < nears[0].count && i < ROOM; i++) {
            const ovoid_robot_near *a = &items[0][i], *b = &items[1][i];
            CHECK(a->a.element == b->a.element && a->b.body == b->b.body && a->b.part == b->b.part);
            CHECK(a->lower == b->lower && a->upper == b->upper);
            CHECK(a->normal.x == b->normal.x && a->normal.y == b->normal.y && a->normal.z == b->normal.z);
        }
        ovoid_robot_checker_destroy(x);
        ovoid_robot_cell_destroy(cell);
        destroy_scene(&c);
    }
}

int main(void) {
    make_shapes();
    test_by_hand();
    test_truth();
    test_batches();
    test_gradients();
    test_refusals();
    test_memory();
    test_half_changes();
    test_appended();
    printf("%ld states free, %ld hit, %ld derivatives\n", free_count, hit_count, gradients_compared);
    ovoid_compound_destroy(compound);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
