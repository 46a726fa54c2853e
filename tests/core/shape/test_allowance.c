// Bodies known to within an allowance. Truth: bodies whose true counterpart is at hand. A rounded body enlarged (or
// shrunk) by a length stands `outside` (or `inside`) by exactly that everywhere, so brackets must hold and be as tight
// as the search makes them; a hull of displaced points by no more than the displacement; cylinders and cones have
// supports in closed form. Each query of the shape with its allowance is compared with that of the true body.
#include "compounds.h"
#include "proofs/covers.h"

#include "linear/exact.h"
#include "linear/mat3.h"
#include "linear/rotation.h"
#include "linear/vec3.h"
#include "ovoid/ovoid.h"

// ---- bodies

/// A shape with an allowance, and the body that it stands for.
typedef struct known {
    ovoid_shape *shape, *body;
} known;

/// ACROSS: displaced across an axis, which the allowance has.
typedef enum style { ENLARGED, SHRUNK, DISPLACED, PULLED, ACROSS, STYLES } style;

static ovoid_vec3 random_step(uint64_t *s, double length) {
    ovoid_vec3 v = vec3_unit((vec3){random_normal(s), random_normal(s), random_normal(s)});
    return vec3_scale(v, length * (1 - 1e-9));
}

/// Both from some points in +-1, at most 24; by: the allowance's length.
static known make_known_of(int count, style how, double by, uint64_t *s) {
    double given[3 * 24], moved[3 * 24];
    for (int i = 0; i < 3 * count; i++) given[i] = moved[i] = random_uniform(s, -1, 1);
    vec3 middle = {0, 0, 0}, axis = random_step(s, 1);
    for (int i = 0; i < count; i++) middle = vec3_add_scaled(middle, vec3_at(given, (size_t)i), 1.0 / count);
    for (int i = 0; i < count; i++) {
        vec3 v = vec3_at(given, (size_t)i), in = vec3_sub(middle, v), step = {0, 0, 0};
        double far = vec3_norm(in);
        if (how == DISPLACED || how == ACROSS) step = random_step(s, by);
        if (how == ACROSS) step = vec3_add_scaled(step, axis, -vec3_dot(axis, step) / vec3_norm_squared(axis));
        if (how == PULLED && far > 0) step = vec3_scale(in, fmin(by, far) * (1 - 1e-9) / far);
        moved[3 * i] += step.x, moved[3 * i + 1] += step.y, moved[3 * i + 2] += step.z;
    }
    double radius = how == SHRUNK ? by + random_uniform(s, 0, 0.2) : random_next(s) % 2 ? 0 : 0.2;
    ovoid_shape_options of_shape = {.radius = radius}, of_body = {.radius = radius};
    if (how != SHRUNK) of_shape.allowance.outside = by;
    // What rounding may put out of the true body.
    of_shape.allowance.inside = how == SHRUNK || how == DISPLACED || how == ACROSS ? by : how == PULLED ? 1e-15 : 0;
    if (how == ACROSS) of_shape.allowance.axis = vec3_scale(axis, random_uniform(s, 0.5, 2));
    if (how == ENLARGED) of_body.radius += by;
    if (how == SHRUNK) of_body.radius -= by;
    known k = {ovoid_shape_create_from_points(moved, (size_t)count, &of_shape, NULL),
               ovoid_shape_create_from_points(given, (size_t)count, &of_body, NULL)};
    CHECK(k.shape && k.body);
    return k;
}

static known make_known(style how, double by, uint64_t *s) {
    int count = 1 + (int)(random_next(s) % 24);
    return make_known_of(count, how, by, s);
}

static void destroy_known(known k) {
    ovoid_shape_destroy(k.shape);
    ovoid_shape_destroy(k.body);
}

typedef struct trial {
    known a, b;
    ovoid_pair shapes, bodies; ///< at the same poses
    double width;              ///< of both allowances, in one
    int is_tight;              ///< the true distance is at an end of the bracket
} trial;

static trial make_trial(uint64_t seed) {
    static const double lengths[] = {1e-12, 1e-6, 1e-3, 0.05, 0.3};
    uint64_t s = seed * 99;
    style of_a = (style)(random_next(&s) % STYLES), of_b = (style)(random_next(&s) % STYLES);
    double by_a = lengths[random_next(&s) % 5], by_b = lengths[random_next(&s) % 5];
    if (seed % 3 == 0) of_b = of_a = seed % 2 ? ENLARGED : SHRUNK;
    trial t = {.a = make_known(of_a, by_a, &s), .b = make_known(of_b, by_b, &s)};
    t.is_tight = seed % 3 == 0;
    ovoid_pose at = {random_vec3(&s, 1), random_quat(&s)}, to = {random_vec3(&s, 2.5), random_quat(&s)};
    t.bodies = (ovoid_pair){t.a.body, t.b.body, at, to};
    // Near contact, near the allowances' own lengths, and anywhere.
    ovoid_answer x = ovoid_depth(&t.bodies, NULL, NULL, NULL);
    double wanted = seed % 4 == 0 ? 0 : random_uniform(&s, -1.5, 1.5) * (by_a + by_b);
    if (seed % 4 < 3) to.position = vec3_add_scaled(to.position, x.normal, wanted - x.lower);
    t.bodies.pose_b = to;
    t.shapes = (ovoid_pair){t.a.shape, t.b.shape, at, to};
    ovoid_allowance wa = ovoid_shape_get_allowance(t.a.shape), wb = ovoid_shape_get_allowance(t.b.shape);
    t.width = wa.outside + wa.inside + wb.outside + wb.inside;
    return t;
}

static void destroy_trial(const trial *t) {
    destroy_known(t->a);
    destroy_known(t->b);
}

// ---- queries of a pair

static double size_of(const ovoid_pair *p) { return 8 + vec3_norm(vec3_sub(p->pose_a.position, p->pose_b.position)); }

/// What every answer of the shapes must satisfy; truth: an answer of the bodies.
static void check_answer(const trial *t, const ovoid_answer *x, const ovoid_answer *truth, double margin) {
    CHECK_LE(x->lower, truth->upper);
    CHECK_LE(truth->lower, x->upper);
    CHECK(x->status == (x->lower > 0 ? OVOID_SEPARATED : x->upper < 0 ? OVOID_OVERLAPPING : x->status));
    CHECK((x->status == OVOID_SEPARATED) == (x->lower > 0));
    CHECK((x->status == OVOID_OVERLAPPING) == (x->upper < 0));
    if (x->status == OVOID_TOUCHING) CHECK_LE(x->upper - x->lower, 1e-8 * size_of(&t->shapes));
    if (x->limit == OVOID_LIMIT_ALLOWANCE)
        CHECK((x->lower <= 0 && x->upper >= 0) || (x->lower <= margin && x->upper > margin));
}

/// The sign of a yes or no is open by the allowances alone, or where the few pairs of a proof do not show an overlap.
static void check_decided(const ovoid_answer *x, const ovoid_answer *truth) {
    if (x->status != OVOID_UNDECIDED || x->limit == OVOID_LIMIT_ALLOWANCE) return;
    CHECK(x->limit == OVOID_LIMIT_PRECISION && x->proof.kind == OVOID_PROOF_HULL && truth->upper < 0);
}

static void check_pair(const trial *t) {
    STATIC_COVER(cover);
    ovoid_answer truth = ovoid_depth(&t->bodies, NULL, NULL, NULL), x;
    double slack = 3e-9 * size_of(&t->shapes);

    x = ovoid_depth(&t->shapes, NULL, NULL, &cover);
    check_answer(t, &x, &truth, 0);
    ovoid_error e;
    if (!CHECK(ovoid_answer_verify(&t->shapes, &x, &(ovoid_answer_basis){.cover = &cover}, &e) == OVOID_OK))
        puts(e.message);
    CHECK_LE(x.upper - x.lower, t->width + slack);
    CHECK_EQ(ovoid_answer_get_distance(&x), x.lower);
    if (t->is_tight && ovoid_shape_get_allowance(t->a.shape).outside > 0) CHECK_LE(truth.lower, x.lower + slack);
    if (t->is_tight && !(ovoid_shape_get_allowance(t->a.shape).outside > 0)) CHECK_LE(x.upper, truth.upper + slack);
    // Not wider than it says: the sign is open only where the allowances' width reaches it.
    if (x.limit == OVOID_LIMIT_ALLOWANCE) CHECK_LE(fabs(truth.lower), t->width + slack);

    ovoid_answer cold = ovoid_collide(&t->shapes, NULL, NULL), warm = ovoid_collide(&t->shapes, NULL, &cold.proof),
                 deep = ovoid_collide(&t->shapes, NULL, &x.proof);
    check_answer(t, &cold, &truth, 0);
    check_answer(t, &warm, &truth, 0);
    CHECK(ovoid_answer_verify(&t->shapes, &cold, NULL, NULL) == OVOID_OK);
    check_decided(&cold, &truth);
    // No earlier proof leaves open what a cold query proves.
    if (cold.status == OVOID_SEPARATED || cold.status == OVOID_OVERLAPPING) {
        CHECK(warm.status == cold.status);
        CHECK(deep.status == cold.status);
    }

    x = ovoid_distance(&t->shapes, NULL, &cold.proof);
    check_answer(t, &x, &truth, 0);
    CHECK(ovoid_answer_verify(&t->shapes, &x, NULL, NULL) == OVOID_OK);
    if (truth.lower > t->width + slack) CHECK_LE(x.upper - x.lower, t->width + slack);

    x = ovoid_pair_compute_bounds(&t->shapes);
    check_answer(t, &x, &truth, 0);
    CHECK(ovoid_answer_verify(&t->shapes, &x, NULL, NULL) == OVOID_OK);

    double margin = fmax(truth.lower, 0) + 0.5 * t->width;
    x = ovoid_within(&t->shapes, margin, NULL, NULL);
    check_answer(t, &x, &truth, margin);
    int is_within = ovoid_answer_is_within(&x, margin);
    if (is_within == 0) CHECK(truth.upper > margin);
    if (is_within == 1) CHECK(truth.lower <= margin);

    ovoid_smooth smooth = ovoid_pair_compute_smooth(&t->shapes, 0);
    if (smooth.limit == OVOID_LIMIT_NONE) {
        CHECK_LE(smooth.outer.value, truth.upper);
        CHECK_LE(truth.lower, smooth.inner.value);
    }
}

static void test_pairs(void) {
    for (uint64_t seed = 1; seed <= 3000; seed++) {
        check_seed = seed;
        trial t = make_trial(seed);
        if (t.a.shape && t.a.body && t.b.shape && t.b.body) check_pair(&t);
        destroy_trial(&t);
    }
    check_seed = 0;
}

static int is_same(const void *a, const void *b, size_t size) { return memcmp(a, b, size) == 0; }

// Batches give the bits of single queries.
static void test_batch(void) {
    enum { COUNT = 200 };
    static trial trials[COUNT];
    static ovoid_posed_shape bodies[2 * COUNT];
    static ovoid_couple couples[COUNT];
    static ovoid_answer answers[COUNT];
    for (uint32_t i = 0; i < COUNT; i++) {
        trials[i] = make_trial(i + 1);
        bodies[2 * i] = (ovoid_posed_shape){trials[i].shapes.shape_a, trials[i].shapes.pose_a};
        bodies[2 * i + 1] = (ovoid_posed_shape){trials[i].shapes.shape_b, trials[i].shapes.pose_b};
        couples[i] = (ovoid_couple){2 * i, 2 * i + 1};
    }
    ovoid_batch batch = {
        .bodies = bodies, .body_count = 2 * COUNT, .couples = couples, .couple_count = COUNT, .answers = answers};
    CHECK(ovoid_collide_batch(&batch, NULL) == OVOID_OK);
    for (uint32_t i = 0; i < COUNT; i++) {
        ovoid_answer x = ovoid_collide(&trials[i].shapes, NULL, NULL);
        CHECK(x.status == answers[i].status && is_same(&x.lower, &answers[i].lower, sizeof x.lower) &&
              is_same(&x.upper, &answers[i].upper, sizeof x.upper));
        destroy_trial(&trials[i]);
    }
}

// ---- compounds and worlds

enum { PARTS = 6 };
typedef struct assembly {
    known parts[PARTS];
    ovoid_compound *shape, *body;
} assembly;

static assembly make_assembly(uint64_t *s, double by) {
    assembly c = {.shape = NULL};
    ovoid_posed_shape of_shape[PARTS], of_body[PARTS];
    for (int i = 0; i < PARTS; i++) {
        c.parts[i] = make_known((style)(random_next(s) % STYLES), by * (i % 3), s);
        ovoid_pose at = {random_vec3(s, 3), random_quat(s)};
        of_shape[i] = (ovoid_posed_shape){c.parts[i].shape, at};
        of_body[i] = (ovoid_posed_shape){c.parts[i].body, at};
    }
    c.shape = ovoid_compound_create(of_shape, PARTS, NULL, NULL);
    c.body = ovoid_compound_create(of_body, PARTS, NULL, NULL);
    CHECK(c.shape && c.body);
    return c;
}

static void destroy_assembly(assembly *c) {
    ovoid_compound_destroy(c->shape);
    ovoid_compound_destroy(c->body);
    for (int i = 0; i < PARTS; i++) destroy_known(c->parts[i]);
}

// A shape beside a compound is a tree of one node.
static void check_shape_beside(const assembly *b, ovoid_pose to, double by, uint64_t *s) {
    known one = make_known(ENLARGED, by, s);
    ovoid_pose at = {random_vec3(s, 5), random_quat(s)};
    ovoid_body_pair shapes = {{.shape = one.shape, .pose = at}, {.compound = b->shape, .pose = to}},
                    bodies = {{.shape = one.body, .pose = at}, {.compound = b->body, .pose = to}};
    ovoid_body_answer truth = ovoid_body_depth(&bodies, NULL, NULL), x = ovoid_body_depth(&shapes, NULL, NULL),
                      y = ovoid_body_collide(&shapes, NULL, NULL);
    CHECK_LE(x.lower, truth.upper);
    CHECK_LE(truth.lower, x.upper);
    CHECK_LE(y.lower, truth.upper);
    CHECK_LE(truth.lower, y.upper);
    destroy_known(one);
}

static void test_compounds(void) {
    for (uint64_t seed = 1; seed <= 400; seed++) {
        check_seed = seed;
        uint64_t s = seed;
        double by = seed % 2 ? 0.02 : 0.2;
        assembly a = make_assembly(&s, by), b = make_assembly(&s, by);
        ovoid_pose at = {random_vec3(&s, 4), random_quat(&s)}, to = {random_vec3(&s, 4), random_quat(&s)};
        ovoid_body_pair shapes = {{.compound = a.shape, .pose = at}, {.compound = b.shape, .pose = to}},
                        bodies = {{.compound = a.body, .pose = at}, {.compound = b.body, .pose = to}};
        ovoid_exclusion items[256];
        STATIC_COVER(cover);
        ovoid_exclusions all = {.items = items, .capacity = 256, .cover = &cover};
        ovoid_body_answer truth = ovoid_body_depth(&bodies, NULL, NULL),
                          x = ovoid_body_depth(&shapes, NULL, &(ovoid_body_evidence){.exclusions = &all});
        CHECK_LE(x.lower, truth.upper);
        CHECK_LE(truth.lower, x.upper);
        CHECK_LE(x.upper - x.lower, 8 * by + 1e-6);
        CHECK(all.count <= all.capacity &&
              ovoid_body_verify(&shapes, &x, &(ovoid_body_basis){.exclusions = &all}, NULL) == OVOID_OK);
        ovoid_body_answer y = ovoid_body_collide(&shapes, NULL, &(ovoid_body_evidence){.exclusions = &all});
        CHECK_LE(y.lower, truth.upper);
        CHECK_LE(truth.lower, y.upper);
        CHECK(ovoid_body_verify(&shapes, &y, &(ovoid_body_basis){.exclusions = &all}, NULL) == OVOID_OK);
        check_decided(&y.deciding, &truth.deciding);
        y = ovoid_body_within(&shapes, 0.5, NULL, NULL);
        int is_within = ovoid_answer_is_within(&y.deciding, 0.5);
        if (is_within == 0) CHECK(truth.upper > 0.5);
        if (is_within == 1) CHECK(truth.lower <= 0.5);
        for (int i = 0; i < 4; i++) check_shape_beside(&b, to, by, &s);
        destroy_assembly(&a);
        destroy_assembly(&b);
    }
    check_seed = 0;
}

// The least upper bound of all parts counts, also where another part's allowance makes its lower bound lower; and a
// warm start leaves nothing open that a cold one proves.
static void test_mixed(void) {
    const double origin[3] = {0, 0, 0};
    ovoid_shape_options exact = {.radius = 1}, loose = {.radius = 1, .allowance = {.outside = 0.5, .inside = 0.5}};
    ovoid_shape *ball = ovoid_shape_create_from_points(origin, 1, &exact, NULL),
                *cloud = ovoid_shape_create_from_points(origin, 1, &loose, NULL),
                *box = ovoid_shape_create_box((ovoid_vec3){1, 2, 5}, NULL, NULL);
    ovoid_posed_shape parts[2] = {{ball, {{0, 0, 0}, {1, 0, 0, 0}}}, {cloud, {{0.3, 0, 2}, {1, 0, 0, 0}}}};
    ovoid_compound *c = ovoid_compound_create(parts, 2, NULL, NULL);
    ovoid_body_pair pair = {{.compound = c, .pose = {{0, 0, 0}, {1, 0, 0, 0}}},
                            {.shape = box, .pose = {{1.9, 0, 0}, {1, 0, 0, 0}}}};
    ovoid_body_answer x = ovoid_body_depth(&pair, NULL, NULL);
    CHECK(x.status == OVOID_OVERLAPPING);
    CHECK_LE(x.upper, -0.1 + 1e-8);
    pair.b.pose.position.x = 3;
    x = ovoid_body_distance(&pair, NULL, NULL);
    CHECK_NEAR(x.upper, 1, 1e-8);
    CHECK_NEAR(x.lower, 0.2, 1e-8);
    x = ovoid_body_within(&pair, 1.0001, NULL, NULL);
    CHECK_EQ(ovoid_answer_is_within(&x.deciding, 1.0001), 1);
    ovoid_compound_destroy(c);
    ovoid_shape_destroy(ball);
    ovoid_shape_destroy(cloud);
    ovoid_shape_destroy(box);
}

// Two columns of balls along z, `apart` along x: an exclusion of all of them is taken up to their true bodies' gap.
static void test_exclusion(void) {
    const double origin[3] = {0, 0, 0}, apart = 10, radius = 0.5, outside = 0.25;
    ovoid_shape_options o = {.radius = radius, .allowance = {.outside = outside}};
    ovoid_shape *ball = ovoid_shape_create_from_points(origin, 1, &o, NULL);
    ovoid_posed_shape parts[2] = {{ball, {{0, 0, -1}, {1, 0, 0, 0}}}, {ball, {{0, 0, 1}, {1, 0, 0, 0}}}};
    ovoid_compound *c = ovoid_compound_create(parts, 2, NULL, NULL);
    ovoid_body_pair pair = {{.compound = c, .pose = {{0, 0, 0}, {1, 0, 0, 0}}},
                            {.compound = c, .pose = {{apart, 0, 0}, {1, 0, 0, 0}}}};
    ovoid_exclusion items[8];
    ovoid_exclusions all = {.items = items, .capacity = 8};
    ovoid_body_answer x = ovoid_body_collide(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    if (CHECK(x.status == OVOID_SEPARATED && all.count > 0 && all.count <= 8)) {
        ovoid_exclusion e = {0, 2, 0, 2, {1, 0, 0}, {0, 0, 0}, apart - 2 * (radius + outside) - 1e-12};
        all.count = 1;
        items[0] = e;
        CHECK(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, NULL) == OVOID_OK);
        items[0].lower += 0.5 * outside;
        CHECK(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, NULL) == OVOID_ERROR_PROOF);
    }
    ovoid_compound_destroy(c);
    ovoid_shape_destroy(ball);
}

enum { BODIES = 40, STEPS = 30 };

// Ids rise in the order of adding, as contacts are sorted. A pair whose true bodies are within the margin is a contact,
// at every step, whatever proofs have aged.
static void check_contacts(const ovoid_contacts *found, const known *bodies, const ovoid_pose *poses,
                           const ovoid_id *ids, double margin) {
    size_t at = 0;
    for (int i = 0; i < BODIES; i++)
        for (int k = i + 1; k < BODIES; k++) {
            ovoid_pair truth = {bodies[i].body, bodies[k].body, poses[i], poses[k]};
            ovoid_answer x = ovoid_depth(&truth, NULL, NULL, NULL);
            const ovoid_contact *c = &found->items[at];
            int is_found = at < found->count && c->a == ids[i] && c->b == ids[k];
            at += (size_t)is_found;
            if (x.upper <= margin) CHECK(is_found);
            if (is_found) CHECK(c->verdict.lower <= x.upper && x.lower <= c->verdict.upper);
        }
    CHECK_EQ(at, found->count);
}

// most: of points of a body; 1 makes them balls.
static void run_world(uint64_t seed, ovoid_query_kind kind, double margin, int most) {
    uint64_t s = seed;
    known bodies[BODIES];
    ovoid_pose poses[BODIES];
    ovoid_id ids[BODIES];
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    if (!CHECK(w != NULL)) return;
    for (int i = 0; i < BODIES; i++) {
        style how = most > 1 ? (style)(random_next(&s) % STYLES) : ENLARGED;
        bodies[i] = make_known_of(1 + (int)(random_next(&s) % (uint64_t)most), how, 0.1 * (i % 3), &s);
        poses[i] = (ovoid_pose){random_vec3(&s, most > 1 ? 5 : 1.5), random_quat(&s)};
        ovoid_world_body b = {.body = {.shape = bodies[i].shape, .pose = poses[i]}};
        ids[i] = ovoid_world_add(w, &b, NULL);
    }
    ovoid_contact_query query = {kind, margin, NULL};
    for (int step = 0; step < STEPS; step++) {
        ovoid_contacts found;
        if (!CHECK(ovoid_world_compute_contacts(w, &query, &found, NULL) == OVOID_OK)) break;
        check_contacts(&found, bodies, poses, ids, margin);
        for (int i = 0; i < BODIES; i++) {
            poses[i].position = vec3_add(poses[i].position, random_vec3(&s, 0.05));
            poses[i].rotation.x += random_uniform(&s, -0.05, 0.05);
            ovoid_world_move(w, ids[i], &poses[i], NULL);
        }
    }
    ovoid_world_destroy(w);
    for (int i = 0; i < BODIES; i++) destroy_known(bodies[i]);
}

static void test_worlds(void) {
    run_world(1, OVOID_QUERY_COLLIDE, 0, 24);
    run_world(2, OVOID_QUERY_WITHIN, 0.3, 24);
    run_world(3, OVOID_QUERY_DISTANCE, 0.2, 24);
    run_world(4, OVOID_QUERY_DEPTH, 0.2, 24);
    run_world(5, OVOID_QUERY_COLLIDE, 0, 1);
    run_world(6, OVOID_QUERY_WITHIN, 0.3, 1);
}

// ---- motions

static void test_motions(void) {
    for (uint64_t seed = 1; seed <= 300; seed++) {
        check_seed = seed;
        uint64_t s = seed * 7;
        trial t = make_trial(seed);
        ovoid_pose from = t.shapes.pose_b;
        from.position = vec3_add_scaled(from.position, ovoid_depth(&t.bodies, NULL, NULL, NULL).normal, 3);
        ovoid_motion still = ovoid_motion_make_still(t.shapes.pose_a),
                     way = ovoid_motion_make_velocity(from, random_vec3(&s, 6), random_vec3(&s, seed % 4 ? 2 : 40), 1);
        const ovoid_pose none = {{0, 0, 0}, {0, 0, 0, 0}};
        ovoid_moving_shape a = {t.a.shape, still, none}, b = {t.b.shape, way, none}, true_a = {t.a.body, still, none},
                           true_b = {t.b.body, way, none};
        static ovoid_step steps[4096];
        ovoid_motion_options o = {.steps = steps, .capacity = 4096};
        ovoid_impact truth = ovoid_impact_find(&(ovoid_moving_pair){true_a, true_b, 0}, NULL),
                     x = ovoid_impact_find(&(ovoid_moving_pair){a, b, 0}, &o);
        double hit = truth.status == OVOID_IMPACT_HIT ? truth.hit_at : INFINITY;
        CHECK_LE(x.free_until, fmin(hit, 1));
        if (x.status == OVOID_IMPACT_HIT) CHECK(truth.status != OVOID_IMPACT_FREE && truth.free_until <= x.hit_at);
        if (x.step_count <= 4096)
            CHECK(ovoid_impact_verify(&(ovoid_moving_pair){a, b, 0}, &x, &(ovoid_motion_basis){.steps = steps}, NULL) ==
                  OVOID_OK);

        ovoid_approach nearest = ovoid_approach_find(&(ovoid_moving_pair){a, b, 0}, &o),
                       real = ovoid_approach_find(&(ovoid_moving_pair){true_a, true_b, 0}, NULL);
        CHECK_LE(nearest.lower, real.upper);
        CHECK_LE(real.lower, nearest.upper);
        if (nearest.limit == OVOID_LIMIT_NONE && nearest.status == OVOID_SEPARATED)
            CHECK_LE(nearest.upper - nearest.lower, t.width + 1e-4);
        if (nearest.step_count <= 4096)
            CHECK(ovoid_approach_verify(&(ovoid_moving_pair){a, b, 0}, &nearest, &(ovoid_motion_basis){.steps = steps},
                                        NULL) == OVOID_OK);

        // The box holds the true body: its enclosing box along the axes at some times.
        ovoid_box box = ovoid_moving_shape_compute_box(&b, 0, 1);
        for (int i = 0; i <= 4; i++) {
            ovoid_pose p = ovoid_moving_shape_compute_pose(&true_b, i / 4.0);
            ovoid_polytope q = ovoid_shape_get_polytope(t.b.body);
            double r = ovoid_shape_get_radius(t.b.body);
            for (uint32_t v = 0; v < q.vertex_count; v++) {
                vec3 at = ovoid_pose_compute_point(&p, vec3_add(q.origin, vec3_at(q.vertices, v)));
                CHECK(at.x + r <= box.max.x && at.y + r <= box.max.y && at.z + r <= box.max.z);
                CHECK(at.x - r >= box.min.x && at.y - r >= box.min.y && at.z - r >= box.min.z);
            }
        }

        ovoid_ray ray = {from.position, vec3_sub(t.shapes.pose_a.position, from.position), 1,
                         0.01 * (double)(seed % 3)};
        ovoid_posed_shape seen = {t.a.shape, t.shapes.pose_a}, real_seen = {t.a.body, t.shapes.pose_a};
        ovoid_ray_hit hit_shape = ovoid_shape_cast_ray(&seen, &ray), hit_body = ovoid_shape_cast_ray(&real_seen, &ray);
        if (hit_body.status == OVOID_IMPACT_HIT) CHECK_LE(hit_shape.lower, hit_body.upper);
        if (hit_shape.status == OVOID_IMPACT_FREE) CHECK(hit_body.status != OVOID_IMPACT_HIT);
        if (hit_shape.status == OVOID_IMPACT_HIT && hit_body.status == OVOID_IMPACT_HIT)
            CHECK_LE(hit_body.lower, hit_shape.upper);
        destroy_trial(&t);
    }
    check_seed = 0;
}

// ---- cylinders and cones

/// The largest n.x over the true solid.
static double find_support(vec3 n, double radius, double half, int is_cone) {
    double across = radius * sqrt(n.x * n.x + n.y * n.y);
    return is_cone ? fmax(half * n.z, across - half * n.z) : half * fabs(n.z) + across;
}

/// Against a plate so large that the distance is the support along its normal.
static void check_round(uint64_t *s, int is_cone, double tolerance) {
    double radius = random_uniform(s, 0.1, 2), half = random_uniform(s, 0.1, 2);
    ovoid_shape *round =
        is_cone ? ovoid_shape_create_cone(radius, half, &(ovoid_shape_options){.tolerance = tolerance}, NULL)
                : ovoid_shape_create_cylinder(radius, half, &(ovoid_shape_options){.tolerance = tolerance}, NULL);
    ovoid_shape *plate = ovoid_shape_create_box((ovoid_vec3){50, 50, 50}, NULL, NULL);
    if (!CHECK(round && plate)) return;
    ovoid_allowance w = ovoid_shape_get_allowance(round);
    CHECK_LE(w.outside, (tolerance > 0 ? tolerance : radius / 200) * (1 + 1e-9));
    CHECK_LE(w.inside, 1e-14 * radius);
    ovoid_quat q = random_quat(s);
    mat3 r = quat_to_mat3(q);
    // The plate's top is the plane z = 50.
    vec3 down = mat3_mul_transposed_vec3(r, (vec3){0, 0, -1});
    double support = find_support(down, radius, half, is_cone), wanted = random_uniform(s, -0.2, 1);
    ovoid_pair p = {plate, round, {{0, 0, 0}, {1, 0, 0, 0}}, {{0, 0, 50 + support + wanted}, q}};
    ovoid_answer x = ovoid_depth(&p, NULL, NULL, NULL);
    CHECK_LE(x.lower, wanted + 1e-13);
    CHECK_LE(wanted - 1e-13, x.upper);
    CHECK_LE(x.upper - x.lower, w.outside + w.inside + 3e-7);
    ovoid_shape_destroy(round);
    ovoid_shape_destroy(plate);
}

static void test_rounds(void) {
    uint64_t s = 5;
    static const double tolerances[] = {0, 1e-5, 1e-3, 0.1, 3};
    for (int i = 0; i < 2000; i++) check_round(&s, i & 1, tolerances[i / 2 % 5]);
    // Two cylinders side by side.
    ovoid_shape *a = ovoid_shape_create_cylinder(1, 2, NULL, NULL),
                *b = ovoid_shape_create_cylinder(0.5, 2, &(ovoid_shape_options){.tolerance = 1e-4}, NULL);
    for (int i = 0; i < 500; i++) {
        double turn = random_uniform(&s, 0, 3), angle = random_uniform(&s, 0, 6), d = random_uniform(&s, 1.4, 1.8);
        ovoid_pair p = {a,
                        b,
                        {{0, 0, 0}, {cos(turn), 0, 0, sin(turn)}},
                        {{d * cos(angle), d * sin(angle), 0}, {1, 0, 0, 0.3 * turn}}};
        ovoid_answer x = ovoid_depth(&p, NULL, NULL, NULL);
        CHECK_LE(x.lower, d - 1.5 + 1e-14);
        CHECK_LE(d - 1.5 - 1e-14, x.upper);
    }
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
}

// ---- what is refused, kept, and said

static void test_edges(void) {
    const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    ovoid_error e;
    static const double bad[] = {-1, NAN, INFINITY, 1e300};
    for (int i = 0; i < 8; i++) {
        ovoid_shape_options o = {.allowance = {.outside = i & 1 ? bad[i / 2] : 0, .inside = i & 1 ? 0 : bad[i / 2]}};
        CHECK(ovoid_shape_create_from_points(xyz, 4, &o, &e) == NULL);
        CHECK(strstr(e.message, i & 1 ? "outside" : "inside") != NULL);
    }
    CHECK(ovoid_shape_create_cylinder(1, 1, &(ovoid_shape_options){.tolerance = -1}, &e) == NULL &&
          strstr(e.message, "tolerance") != NULL);
    CHECK(ovoid_shape_create_cylinder(1, 1, &(ovoid_shape_options){.tolerance = NAN}, &e) == NULL &&
          strstr(e.message, "tolerance") != NULL);
    CHECK(ovoid_shape_create_cone(1, 1, &(ovoid_shape_options){.tolerance = 1e-12}, &e) == NULL &&
          e.code == OVOID_ERROR_LIMIT);
    CHECK(ovoid_shape_create_cone(-1, 1, NULL, &e) == NULL);
    ovoid_shape *line = ovoid_shape_create_cylinder(0, 1, NULL, &e);
    CHECK(line && !(ovoid_shape_get_allowance(line).outside > 0));
    ovoid_shape_destroy(line);

    // Files keep it, and a file that says nonsense is refused.
    ovoid_shape_options o = {.radius = 0.5, .allowance = {.outside = 0.25, .inside = 0.125}};
    ovoid_shape *s = ovoid_shape_create_from_points(xyz, 4, &o, &e), *copy = ovoid_shape_create_copy(s, NULL, &e);
    unsigned char bytes[1024];
    size_t size = ovoid_shape_write(s, bytes, sizeof bytes);
    ovoid_shape *read = ovoid_shape_read(bytes, size, NULL, &e);
    if (CHECK(s && copy && read)) {
        CHECK_EQ(ovoid_shape_get_allowance(read).outside, 0.25);
        CHECK_EQ(ovoid_shape_get_allowance(read).inside, 0.125);
        CHECK_EQ(ovoid_shape_get_allowance(copy).inside, 0.125);
        CHECK_EQ(ovoid_shape_write(read, NULL, 0), size);
    }
    // Two points a length apart, each known to half of it: nothing is known of the sign.
    const double origin[] = {0, 0, 0};
    ovoid_shape_options loose = {.allowance = {.outside = 0.5, .inside = 0.5}};
    ovoid_shape *point = ovoid_shape_create_from_points(origin, 1, &loose, &e);
    ovoid_pair p = {point, point, {{0, 0, 0}, {1, 0, 0, 0}}, {{1, 0, 0}, {1, 0, 0, 0}}};
    ovoid_answer x = ovoid_distance(&p, NULL, NULL);
    CHECK(x.status == OVOID_UNDECIDED && x.limit == OVOID_LIMIT_ALLOWANCE);
    // The pair's size is 4: claims are lowered by 256 u of it, and all is rounded.
    CHECK_NEAR(x.lower, 0, 4 * 260 * 0x1p-53);
    CHECK_NEAR(x.upper, 2, 4 * 260 * 0x1p-53);
    CHECK(strcmp(ovoid_limit_get_name(x.limit), "allowance") == 0);
    // `inside` says no more than the bodies' own sizes do.
    ovoid_shape_options huge = {.allowance = {.outside = 0, .inside = 1e30}};
    ovoid_shape *any = ovoid_shape_create_from_points(xyz, 4, &huge, &e);
    p = (ovoid_pair){any, any, {{0, 0, 0}, {1, 0, 0, 0}}, {{5, 0, 0}, {1, 0, 0, 0}}};
    x = ovoid_distance(&p, NULL, NULL);
    CHECK(x.lower > 3.9 && x.upper < 4 + 8 + 1e-9);
    // The true body may be no more than the corner that is farthest from the other.
    p = (ovoid_pair){point, any, {{-5, 0, 0}, {1, 0, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}};
    x = ovoid_distance(&p, NULL, NULL);
    CHECK(x.upper >= 6 + 0.5);
    // A point has no size, so nothing is left of it.
    ovoid_shape *exact = ovoid_shape_create_from_points(origin, 1, &huge, &e);
    size = ovoid_shape_write(exact, bytes, sizeof bytes);
    ovoid_shape *exact_read = ovoid_shape_read(bytes, size, NULL, &e);
    CHECK(exact_read && ovoid_shape_get_allowance(exact_read).inside <= 0);
    ovoid_shape_destroy(exact);
    ovoid_shape_destroy(exact_read);
    ovoid_shape_destroy(s);
    ovoid_shape_destroy(copy);
    ovoid_shape_destroy(read);
    ovoid_shape_destroy(point);
    ovoid_shape_destroy(any);
}

int main(void) {
    test_pairs();
    test_batch();
    test_compounds();
    test_exclusion();
    test_mixed();
    test_worlds();
    test_motions();
    test_rounds();
    test_edges();
    return check_end();
}
