// Allowances along an axis. Truth: cylinders and cones have their support in closed form, and what stands on a plate is
// as far from it as that says; a body drawn in across its axis has the shape that it was drawn from for its bound. Each
// answer is checked without a search, by the shape that it is about, and is refused by one with another axis.
#include "compounds.h"
#include "proofs/covers.h"

#include "linear/mat3.h"
#include "linear/rotation.h"
#include "linear/vec3.h"
#include "ovoid/ovoid.h"

#include <string.h>

static int is_same(const void *a, const void *b, size_t size) { return memcmp(a, b, size) == 0; }

// ---- what rests on a plate

/// A body above the top of a plate, in a scene that is turned, moved and scaled.
typedef struct rest {
    ovoid_shape *plate, *body;
    ovoid_pair pair;
    double scale, truth; ///< truth: the signed distance of the true bodies
} rest;

static double find_support(vec3 n, double radius, double half, int is_cone) {
    double across = radius * sqrt(n.x * n.x + n.y * n.y);
    return is_cone ? fmax(half * n.z, across - half * n.z) : half * fabs(n.z) + across;
}

// turned: of the body, from standing on its base.
static rest make_rest(int is_cone, double scale, double gap, ovoid_quat turned, uint64_t *s) {
    double radius = random_uniform(s, 0.3, 1), half = random_uniform(s, 0.2, 1);
    rest r = {.scale = scale, .truth = gap * scale};
    r.plate = ovoid_shape_create_box((ovoid_vec3){4 * scale, 4 * scale, 0.5 * scale}, NULL, NULL);
    r.body =
        (is_cone ? ovoid_shape_create_cone : ovoid_shape_create_cylinder)(radius * scale, half * scale, NULL, NULL);
    vec3 down = mat3_mul_transposed_vec3(quat_to_mat3(turned), (vec3){0, 0, -1});
    double height = find_support(down, radius, half, is_cone) + 0.5 + gap;
    ovoid_pose on = {{random_uniform(s, -2, 2) * scale, random_uniform(s, -2, 2) * scale, height * scale}, turned};
    ovoid_pose scene = {vec3_scale(random_vec3(s, 1), scale), random_quat(s)};
    r.pair = (ovoid_pair){r.plate, r.body, scene, ovoid_pose_compute_product(&scene, &on)};
    if (random_next(s) % 2) r.pair = (ovoid_pair){r.body, r.plate, r.pair.pose_b, r.pair.pose_a};
    CHECK(r.plate && r.body);
    return r;
}

static void destroy_rest(const rest *r) {
    ovoid_shape_destroy(r->plate);
    ovoid_shape_destroy(r->body);
}

static ovoid_answer ask(const ovoid_pair *p, int how, const ovoid_proof *earlier, ovoid_cover *cover) {
    return how == 0   ? ovoid_collide(p, NULL, earlier)
           : how == 1 ? ovoid_distance(p, NULL, earlier)
                      : ovoid_depth(p, NULL, earlier, cover);
}

// The bracket holds the truth, to what rounding did to the poses, and passes its check.
static void check_holds(const rest *r, const ovoid_answer *x, const ovoid_cover *cover) {
    ovoid_error e = {.message = ""};
    CHECK_LE(x->lower, r->truth + 1e-14 * r->scale);
    CHECK_LE(r->truth - 1e-14 * r->scale, x->upper);
    if (!CHECK_EQ(ovoid_answer_verify(&r->pair, x, &(ovoid_answer_basis){.cover = cover}, &e), OVOID_OK))
        printf("  %s\n", e.message);
}

// The lower bound of a distance or depth is that of the true bodies: the supports' gap along the plate's normal, to the
// tolerance and what rounding did to the poses.
static void check_lower(const rest *r, const ovoid_answer *x, double least) {
    if (r->truth <= least * r->scale) return;
    CHECK_LE(r->truth - 2e-8 * r->scale, x->lower);
    if (r->truth > 2e-8 * r->scale) CHECK_EQ(x->status, OVOID_SEPARATED);
    ovoid_answer lie = *x;
    lie.lower = r->truth + 1e-12 * r->scale;
    if (lie.lower <= lie.upper) CHECK_EQ(ovoid_answer_verify(&r->pair, &lie, NULL, NULL), OVOID_ERROR_PROOF);
}

// A body with the same polyhedron and another axis, or none, is not shown by the answer; unless it claims no more than
// the allowance leaves in all directions.
static void check_other_axis(const rest *r, const ovoid_answer *x, const ovoid_cover *cover) {
    static const vec3 axes[] = {{0, 0, 0}, {1, 0, 0}, {0, 0.1, 1}};
    for (size_t i = 0; i < sizeof axes / sizeof *axes; i++) {
        ovoid_allowance other = ovoid_shape_get_allowance(r->body);
        other.axis = axes[i];
        ovoid_shape *liar = ovoid_shape_create_allowed(r->body, &(ovoid_shape_options){.allowance = other}, NULL);
        ovoid_pair p = r->pair;
        if (p.shape_a == r->body) p.shape_a = liar;
        if (p.shape_b == r->body) p.shape_b = liar;
        CHECK_EQ(ovoid_answer_verify(&p, x, &(ovoid_answer_basis){.cover = cover}, NULL), OVOID_ERROR_PROOF);
        ovoid_shape_destroy(liar);
    }
    ovoid_answer y = *x;
    y.lower += 1e-8 * r->scale;
    y.upper = fmax(y.lower, y.upper);
    y.status = y.lower > 0 ? OVOID_SEPARATED : y.upper < 0 ? OVOID_OVERLAPPING : OVOID_TOUCHING;
    CHECK_EQ(ovoid_answer_verify(&r->pair, &y, &(ovoid_answer_basis){.cover = cover}, NULL), OVOID_ERROR_PROOF);
}

// On its base: decided, however near.
static void check_stands(int is_cone, double scale, double gap, uint64_t *s) {
    STATIC_COVER(cover);
    double turn = random_uniform(s, 0, 3);
    rest r = make_rest(is_cone, scale, gap, (ovoid_quat){cos(turn), 0, 0, sin(turn)}, s);
    ovoid_status wanted = gap > 1e-8 ? OVOID_SEPARATED : gap < -1e-8 ? OVOID_OVERLAPPING : OVOID_TOUCHING;
    ovoid_proof earlier;
    for (int how = 0; how < 6; how++) {
        ovoid_answer x = ask(&r.pair, how % 3, how < 3 ? NULL : &earlier, &cover);
        check_holds(&r, &x, &cover);
        if (gap == 0) {
            CHECK(x.lower <= 1e-14 * scale && x.upper >= -1e-14 * scale && x.upper - x.lower <= 1e-8 * scale);
        } else {
            CHECK_EQ(x.status, wanted);
        }
        if (how % 3 == 2 && x.limit == OVOID_LIMIT_NONE) {
            CHECK_LE(x.upper - x.lower, 1e-7 * scale);
            check_other_axis(&r, &x, &cover);
        }
        earlier = x.proof;
    }
    destroy_rest(&r);
}

static void test_standing(void) {
    static const double gaps[] = {0, 1e-6, -1e-6, 1e-4, -1e-3, 0.1};
    uint64_t s = 3;
    for (int power = -9; power <= 9; power += 3)
        for (int i = 0; i < 240; i++) {
            check_seed = s;
            check_stands(i & 1, pow(10, power) * random_uniform(&s, 0.5, 2), gaps[i / 2 % 6], &s);
        }
    check_seed = 0;
}

// Tilted, lying and anyhow, with the apex or the rim down: brackets hold, and are no wider than the allowance and where
// the body leans little than its share of it.
static void test_leaning(void) {
    static const double tilts[] = {1e-9, 1e-6, 1e-3, 0.1};
    uint64_t s = 5;
    for (int i = 0; i < 10000; i++) {
        STATIC_COVER(cover);
        check_seed = s;
        int is_cone = i & 1, is_small = i % 4 < 2;
        double scale = pow(10, random_uniform(&s, -9, 9)), tilt = tilts[i / 4 % 4],
               gap = random_uniform(&s, -0.01, 0.02);
        if (i % 3 == 0) gap *= 1e-5;
        ovoid_quat q = is_small ? (ovoid_quat){1, 0.5 * tilt, 0, 0} : random_quat(&s);
        if (i % 32 == 2) q = (ovoid_quat){1, 1, 0, 0};
        rest r = make_rest(is_cone, scale, gap, q, &s);
        ovoid_allowance w = ovoid_shape_get_allowance(r.body);
        double share = is_small ? sin(2 * atan(0.5 * tilt)) : 1;
        for (int how = 0; how < 3; how++) {
            ovoid_answer x = ask(&r.pair, how, NULL, &cover);
            check_holds(&r, &x, &cover);
            if (how == 2) CHECK_LE(x.upper - x.lower, w.outside * share + 1e-7 * scale);
            if (how == 2) check_lower(&r, &x, -1);
            if (how == 1) check_lower(&r, &x, 0);
        }
        destroy_rest(&r);
    }
    check_seed = 0;
}

// ---- other ways to ask

static void test_batch(void) {
    enum { COUNT = 60 };
    rest all[COUNT];
    ovoid_posed_shape bodies[2 * COUNT];
    ovoid_couple couples[COUNT];
    ovoid_answer answers[COUNT];
    uint64_t s = 7;
    for (uint32_t i = 0; i < COUNT; i++) {
        ovoid_quat q = i % 3 ? (ovoid_quat){1, 0, 0, 0} : random_quat(&s);
        all[i] = make_rest(i & 1, 1, (int)(i % 5 - 2) * 1e-6, q, &s);
        bodies[2 * i] = (ovoid_posed_shape){all[i].pair.shape_a, all[i].pair.pose_a};
        bodies[2 * i + 1] = (ovoid_posed_shape){all[i].pair.shape_b, all[i].pair.pose_b};
        couples[i] = (ovoid_couple){2 * i, 2 * i + 1};
    }
    ovoid_batch batch = {
        .bodies = bodies, .body_count = 2 * COUNT, .couples = couples, .couple_count = COUNT, .answers = answers};
    for (int how = 0; how < 2; how++) {
        CHECK((how ? ovoid_distance_batch : ovoid_collide_batch)(&batch, NULL) == OVOID_OK);
        for (uint32_t i = 0; i < COUNT; i++) {
            ovoid_answer x = ask(&all[i].pair, how, NULL, NULL);
            CHECK(x.status == answers[i].status && is_same(&x.lower, &answers[i].lower, sizeof x.lower) &&
                  is_same(&x.upper, &answers[i].upper, sizeof x.upper));
        }
    }
    for (uint32_t i = 0; i < COUNT; i++) destroy_rest(&all[i]);
}

// The gap along a direction is below the true supports'.
static void test_gap(void) {
    uint64_t s = 11;
    for (int i = 0; i < 1000; i++) {
        rest r = make_rest(i & 1, 1, 1e-6, (ovoid_quat){1, 0, 0, 0}, &s);
        ovoid_answer x = ovoid_distance(&r.pair, NULL, NULL);
        double gap = ovoid_pair_compute_gap(&r.pair, x.normal);
        CHECK_LE(gap, r.truth + 1e-14);
        CHECK_LE(r.truth, gap + 1e-11);
        destroy_rest(&r);
    }
}

// ---- solids, compounds, worlds, motions

static ovoid_solid *make_table(void) {
    static const double xyz[] = {-4, -4, -1, 4, -4, -1, 4, 4, -1, -4, 4, -1, -4, -4, 0, 4, -4, 0, 4, 4, 0, -4, 4, 0};
    static const uint32_t t[] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
    return ovoid_solid_create_from_triangles(&(ovoid_triangles){xyz, 8, t, 12}, NULL, NULL);
}

// Both ways to the answer of two bodies, with exclusions, and its check.
static ovoid_answer ask_bodies(const ovoid_body_pair *pair, int has_solid) {
    static ovoid_exclusion items[4096];
    ovoid_exclusions all = {.items = items, .capacity = 4096};
    ovoid_error e = {.message = ""};
    if (!has_solid) {
        ovoid_body_answer x = ovoid_body_distance(pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        if (!CHECK_EQ(ovoid_body_verify(pair, &x, &(ovoid_body_basis){.exclusions = &all}, &e), OVOID_OK))
            printf("  %s\n", e.message);
        return x.deciding;
    }
    ovoid_body_answer x = ovoid_body_distance(pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    if (!CHECK_EQ(ovoid_body_verify(pair, &x, &(ovoid_body_basis){.exclusions = &all}, &e), OVOID_OK))
        printf("  %s\n", e.message);
    return (ovoid_answer){.status = x.status, .limit = x.limit, .lower = x.lower, .upper = x.upper};
}

// A cylinder on a solid; and one of two cylinders of a compound, on a plate or on a solid.
static void test_bodies(void) {
    static const double gaps[] = {0, 1e-6, -1e-6, 0.01};
    uint64_t s = 13;
    ovoid_solid *table = make_table();
    ovoid_shape *plate = ovoid_shape_create_box((ovoid_vec3){4, 4, 0.5}, NULL, NULL),
                *post = ovoid_shape_create_cylinder(0.5, 1, NULL, NULL);
    const ovoid_posed_shape parts[] = {{post, {{0, 0, 1}, {1, 0, 0, 0}}}, {post, {{1.5, 0, 2}, {1, 0.3, 0, 0}}}};
    ovoid_compound *both = ovoid_compound_create(parts, 2, NULL, NULL);
    if (!CHECK(table && plate && post && both)) return;
    for (int i = 0; i < 240; i++) {
        check_seed = s;
        double gap = gaps[i % 4];
        int has_solid = i / 4 % 2, is_compound = has_solid ? i / 8 % 2 : 1;
        ovoid_pose scene = {random_vec3(&s, 1), random_quat(&s)};
        ovoid_pose at = {{random_uniform(&s, -1, 1), random_uniform(&s, -1, 1), gap + !is_compound}, {1, 0, 0, 0.3}},
                   under = {{0, 0, has_solid ? 0 : -0.5}, {1, 0, 0, 0}};
        ovoid_body_pair pair = {{.shape = is_compound ? NULL : post, .compound = is_compound ? both : NULL},
                                {.shape = has_solid ? NULL : plate, .solid = has_solid ? table : NULL}};
        pair.a.pose = ovoid_pose_compute_product(&scene, &at);
        pair.b.pose = ovoid_pose_compute_product(&scene, &under);
        ovoid_answer x = ask_bodies(&pair, has_solid);
        CHECK_LE(x.lower, gap + 1e-14);
        CHECK_LE(gap - 1e-14, x.upper);
        ovoid_status wanted = gap > 0 ? OVOID_SEPARATED : gap < 0 ? OVOID_OVERLAPPING : OVOID_TOUCHING;
        // What rounding makes of a gap of 0 is a sign sometimes.
        if (!(gap == 0 && x.status != OVOID_UNDECIDED)) CHECK_EQ(x.status, wanted);
    }
    check_seed = 0;
    ovoid_compound_destroy(both);
    ovoid_shape_destroy(post);
    ovoid_shape_destroy(plate);
    ovoid_solid_destroy(table);
}

// A cylinder rocks a little above a plate: at each step the verdict, aged or new, holds the truth.
static void test_world(void) {
    uint64_t s = 17;
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_shape *plate = ovoid_shape_create_box((ovoid_vec3){4, 4, 0.5}, NULL, NULL),
                *post = ovoid_shape_create_cylinder(0.5, 0.05, &(ovoid_shape_options){.tolerance = 0.1}, NULL);
    ovoid_world_body bodies[2] = {{.body = {.shape = plate, .pose = {{0, 0, -0.5}, {1, 0, 0, 0}}}},
                                  {.body = {.shape = post, .pose = {{0, 0, 1}, {1, 0, 0, 0}}}}};
    ovoid_id ids[2];
    for (int i = 0; i < 2; i++) ids[i] = ovoid_world_add(w, &bodies[i], NULL);
    int apart = 0;
    for (int step = 0; step < 4000; step++) {
        ovoid_query_kind kind = step / 1000 % 2 ? OVOID_QUERY_DISTANCE : OVOID_QUERY_COLLIDE;
        double tilt = 0.2 * (step % 100) / 100, gap = step % 200 < 100 ? 1e-4 : 1e-3 * random_uniform(&s, -1, 1);
        ovoid_quat q = {1, 0.5 * tilt * cos(step), 0.5 * tilt * sin(step), 0};
        vec3 down = mat3_mul_transposed_vec3(quat_to_mat3(q), (vec3){0, 0, -1});
        ovoid_pose to = {{0, 0, find_support(down, 0.5, 0.05, 0) + gap}, q};
        ovoid_world_move(w, ids[1], &to, NULL);
        ovoid_contact_query query = {kind, kind == OVOID_QUERY_DISTANCE ? 0.02 : 0, NULL};
        ovoid_contacts found;
        if (!CHECK(ovoid_world_compute_contacts(w, &query, &found, NULL) == OVOID_OK)) break;
        if (gap < 0) CHECK(found.count == 1);
        for (size_t i = 0; i < found.count; i++) {
            CHECK_LE(found.items[i].verdict.lower, gap + 1e-14);
            CHECK_LE(gap - 1e-14, found.items[i].verdict.upper);
            apart += found.items[i].verdict.status == OVOID_SEPARATED;
        }
    }
    CHECK(apart > 10);
    ovoid_world_destroy(w);
    ovoid_shape_destroy(post);
    ovoid_shape_destroy(plate);
}

// A point that stands for a disc: what stands out across the axis moves as it turns, the point does not. Once the
// disc's rim is in the plate no aged bound says that they are apart.
static void test_turning_disc(void) {
    const double origin[3] = {0, 0, 0};
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_shape_options o = {.allowance = {.outside = 0.5, .axis = {0, 0, 1}}};
    ovoid_shape *plate = ovoid_shape_create_box((ovoid_vec3){4, 4, 0.5}, NULL, NULL),
                *disc = ovoid_shape_create_from_points(origin, 1, &o, NULL);
    ovoid_world_body bodies[2] = {{.body = {.shape = plate, .pose = {{0, 0, -0.5}, {1, 0, 0, 0}}}},
                                  {.body = {.shape = disc, .pose = {{0, 0, 0.1}, {1, 0, 0, 0}}}}};
    ovoid_id ids[2];
    for (int i = 0; i < 2; i++) ids[i] = ovoid_world_add(w, &bodies[i], NULL);
    int apart = 0;
    for (int step = 0; step <= 400; step++) {
        double tilt = 1e-3 * step;
        ovoid_pose to = {{0, 0, 0.1}, {cos(0.5 * tilt), sin(0.5 * tilt), 0, 0}};
        ovoid_world_move(w, ids[1], &to, NULL);
        ovoid_contact_query query = {OVOID_QUERY_COLLIDE, 0, NULL};
        ovoid_contacts found;
        if (!CHECK(ovoid_world_compute_contacts(w, &query, &found, NULL) == OVOID_OK)) break;
        if (0.5 * sin(tilt) > 0.1) CHECK_EQ(found.count, 1);
        apart += found.count == 0;
    }
    CHECK(apart > 100);
    ovoid_world_destroy(w);
    ovoid_shape_destroy(disc);
    ovoid_shape_destroy(plate);
}

// A cylinder that slides on air over a plate is free, though its allowance is wider; one that tilts on the way hits
// when its rim does.
static void test_motions(void) {
    ovoid_shape *plate = ovoid_shape_create_box((ovoid_vec3){4, 4, 0.5}, NULL, NULL),
                *post = ovoid_shape_create_cylinder(0.5, 0.25, NULL, NULL);
    const ovoid_pose none = {{0, 0, 0}, {0, 0, 0, 0}};
    const double gap = 1e-4;
    static ovoid_step steps[4096];
    for (int i = 0; i < 60; i++) {
        double rate = i % 3 ? 0.02 * i : 0;
        vec3 axis = {cos(i), sin(i), 0};
        ovoid_pose from = {{-1, 0, 0.25 + gap}, {1, 0, 0, 0}};
        ovoid_moving_shape a = {plate, ovoid_motion_make_still((ovoid_pose){{0, 0, -0.5}, {1, 0, 0, 0}}), none},
                           b = {post,
                                ovoid_motion_make_velocity(from, (vec3){2, 0, 0},
                                                           i % 3 == 2 ? (vec3){0, 0, 3} : vec3_scale(axis, rate), 1),
                                none};
        ovoid_motion_options o = {.steps = steps, .capacity = 4096};
        ovoid_impact x = ovoid_impact_find(&(ovoid_moving_pair){a, b, 0}, &o);
        ovoid_error e = {.message = ""};
        if (x.step_count <= 4096 &&
            !CHECK_EQ(ovoid_impact_verify(&(ovoid_moving_pair){a, b, 0}, &x, &(ovoid_motion_basis){.steps = steps}, &e),
                      OVOID_OK))
            printf("  %s\n", e.message);
        if (i % 3 != 1) {
            CHECK_EQ(x.status, OVOID_IMPACT_FREE);
            continue;
        }
        // Free no longer than until the rim is down; and that is found to what the tolerance of a query, 1e-9 of a size
        // of about 8, leaves of the tilt.
        double low = 0, high = 1;
        for (int k = 0; k < 60; k++) {
            double t = 0.5 * (low + high), at = rate * t;
            double lift = gap + 0.25 - (0.25 * fabs(cos(at)) + 0.5 * fabs(sin(at)));
            if (lift > 0)
                low = t;
            else
                high = t;
        }
        CHECK_LE(x.free_until, high + 1e-9);
        if (high < 1) CHECK_LE(high - 2e-8 / rate, x.free_until);
    }
    ovoid_shape_destroy(post);
    ovoid_shape_destroy(plate);
}

// ---- what a shape keeps

static void check_axis(const ovoid_shape *shape, ovoid_vec3 wanted) {
    ovoid_vec3 axis = ovoid_shape_get_allowance(shape).axis;
    CHECK(axis.x == wanted.x && axis.y == wanted.y && axis.z == wanted.z);
}

static void test_shapes(void) {
    const ovoid_vec3 z = {0, 0, 1}, none = {0, 0, 0};
    const struct {
        ovoid_allowance given;
        ovoid_vec3 kept;
    } cases[] = {{{0, 0, {0, 0, 0}}, z},        {{0.1, 0, {0, 0, 0}}, none}, {{0, 0.1, {0, 0, 0}}, z},
                 {{0.1, 0, {0, 0, -3}}, z},     {{0.1, 0, {1, 0, 0}}, none}, {{0, 0.1, {1, 0, 0}}, z},
                 {{0.1, 0, {0, 1e-9, 1}}, none}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ovoid_shape_options o = {.allowance = cases[i].given};
        ovoid_shape *c = ovoid_shape_create_cylinder(1, 1, &o, NULL), *k = ovoid_shape_create_cone(1, 1, &o, NULL),
                    *p = ovoid_shape_create_prism(&(ovoid_prism){1, 1, 8}, &o, NULL),
                    *to = ovoid_shape_create_copy(c, NULL, NULL);
        check_axis(c, cases[i].kept);
        check_axis(k, cases[i].kept);
        check_axis(to, cases[i].kept);
        // Of nothing that stands out there is no axis; else it has the length 1.
        ovoid_vec3 own = ovoid_shape_get_allowance(p).axis, given = cases[i].given.axis;
        CHECK_NEAR(vec3_norm(own), cases[i].given.outside > 0 && vec3_norm(given) > 0 ? 1 : 0, 1e-15);
        ovoid_shape *again =
            ovoid_shape_create_allowed(c, &(ovoid_shape_options){.allowance = ovoid_shape_get_allowance(p)}, NULL);
        check_axis(again, own);
        ovoid_shape_destroy(again);
        ovoid_shape_destroy(to);
        ovoid_shape_destroy(p);
        ovoid_shape_destroy(k);
        ovoid_shape_destroy(c);
    }
    const double bad[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        ovoid_error e = {0};
        ovoid_shape_options o = {.allowance = {.outside = 1, .axis = {0, bad[i], 1}}};
        CHECK(!ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, &o, &e));
        CHECK_EQ(e.code, OVOID_ERROR_NOT_FINITE);
        CHECK(!ovoid_shape_create_cone(1, 1, &o, NULL));
    }
}

// A speck of a cylinder in a box: the gain along its axis is less than a rounding of the bound, which stays as it is.
static void test_speck(void) {
    uint64_t r = 6;
    ovoid_shape_options o = {.allowance = {.inside = 1e-6}};
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, &o, NULL);
    ovoid_shape *speck = ovoid_shape_create_cylinder(1e-17, 1e-9, NULL, NULL);
    for (int i = 0; i < 600 && CHECK(box && speck); i++) {
        ovoid_pair p = {box, speck, {{0, 0, 0}, random_quat(&r)}, {random_vec3(&r, i & 1 ? 0.3 : 0), random_quat(&r)}};
        ovoid_answer x = ovoid_collide(&p, NULL, NULL);
        CHECK(ovoid_answer_verify(&p, &x, NULL, NULL) == OVOID_OK);
    }
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(speck);
}

int main(void) {
    test_speck();
    test_shapes();
    test_standing();
    test_leaning();
    test_batch();
    test_gap();
    test_bodies();
    test_world();
    test_turning_disc();
    test_motions();
    return check_end();
}
