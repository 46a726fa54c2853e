// A true cylinder, cone or ellipsoid has one answer, whoever is asked: a pair, a gap along a direction, a body among
// bodies, a world, a motion, a cast, a robot's state, its path and what verifies it. Truth: the support in closed form
// of a body that hangs above a plate by a hundredth of its allowance, leaning any way, and slides along it.
#include "check.h"

#include "linear/mat3.h"
#include "linear/rotation.h"
#include "ovoid/ovoid.h"
#include "ovoid/robot_path.h"
#include "places.h"

enum { STEPS = 4096 };

static ovoid_error error;

/// A body that leans by `turn`, whose lowest point is `gap` above a plate's top, z = 0, at every x from -1 to 1.
typedef struct hanging {
    ovoid_shape *body, *plate;
    ovoid_pose at, under;
    double gap;
} hanging;

static hanging make_hanging(uint64_t *s, ovoid_round_kind kind, double gap) {
    int is_cone = kind == OVOID_ROUND_CONE, is_ellipsoid = kind == OVOID_ROUND_ELLIPSOID;
    double radius = random_uniform(s, 0.2, 0.5), half = random_uniform(s, 0.1, 0.5);
    ovoid_quat turn = random_quat(s);
    vec3 down = mat3_mul_transposed_vec3(quat_to_mat3(turn), (vec3){0, 0, -1});
    double across = radius * sqrt(down.x * down.x + down.y * down.y);
    double reach = is_cone ? fmax(half * down.z, across - half * down.z) : half * fabs(down.z) + across;
    vec3 axes = {radius, half, 0.3};
    if (is_ellipsoid) reach = vec3_norm((vec3){axes.x * down.x, axes.y * down.y, axes.z * down.z});
    hanging h = {.gap = gap, .at = {{0, 0.1, reach + gap}, turn}, .under = {{0, 0, -0.5}, {1, 0, 0, 0}}};
    h.body = is_ellipsoid ? ovoid_shape_create_ellipsoid(axes, NULL, &error)
             : is_cone    ? ovoid_shape_create_cone(radius, half, NULL, &error)
                          : ovoid_shape_create_cylinder(radius, half, NULL, &error);
    h.plate = ovoid_shape_create_box((ovoid_vec3){3, 3, 0.5}, NULL, &error);
    if (!h.body || !h.plate) exit(1);
    return h;
}

static void check_bracket(const hanging *h, double lower, double upper) {
    CHECK(lower <= h->gap + 1e-14 && upper >= h->gap - 1e-14);
    CHECK(h->gap > 0 ? lower > 0 : upper < 0);
}

static void check_pair(const hanging *h) {
    ovoid_pair p = {h->body, h->plate, h->at, h->under};
    ovoid_answer x = ovoid_distance(&p, NULL, NULL);
    check_bracket(h, x.lower, x.upper);
    CHECK_EQ(ovoid_answer_verify(&p, &x, NULL, &error), OVOID_OK);
    CHECK_NEAR(ovoid_pair_compute_gap(&p, (ovoid_vec3){0, 0, -1}), h->gap, 1e-11);
    CHECK_LE(ovoid_pair_compute_gap(&p, (ovoid_vec3){0, 0, -1}), h->gap + 1e-14);

    const ovoid_posed_shape part = {h->body, ovoid_pose_make_identity()};
    ovoid_compound *c = ovoid_compound_create(&part, 1, NULL, &error);
    const ovoid_body_pair bodies = {{.compound = c, .pose = h->at}, {.shape = h->plate, .pose = h->under}};
    ovoid_body_answer y = ovoid_body_distance(&bodies, NULL, NULL);
    check_bracket(h, y.lower, y.upper);
    ovoid_compound_destroy(c);
}

static void check_world(const hanging *h) {
    ovoid_world *w = ovoid_world_create(NULL, &error);
    const ovoid_world_body body = {.body = {.shape = h->body, .pose = h->at}},
                           plate = {.body = {.shape = h->plate, .pose = h->under}};
    ovoid_contacts found = {.count = 0};
    const ovoid_contact_query query = {OVOID_QUERY_DISTANCE, 0.01, NULL};
    ovoid_id id = ovoid_world_add(w, &body, &error);
    CHECK(id != 0 && ovoid_world_add(w, &plate, &error) != 0);
    for (int step = 0; step < 3; step++) {
        ovoid_pose to = h->at;
        to.position.x += 0.1 * step;
        CHECK_EQ(ovoid_world_move(w, id, &to, &error), OVOID_OK);
        CHECK_EQ(ovoid_world_compute_contacts(w, &query, &found, &error), OVOID_OK);
        if (CHECK_EQ(found.count, 1)) check_bracket(h, found.items[0].verdict.lower, found.items[0].verdict.upper);
    }
    ovoid_world_destroy(w);
}

static void check_impact(const hanging *h, const ovoid_impact *x) {
    CHECK_EQ(x->status, h->gap > 0 ? OVOID_IMPACT_FREE : OVOID_IMPACT_HIT);
    if (h->gap < 0) CHECK_EQ(x->hit_at, 0);
}

// One motion slides, one turns as well about the plate's normal; the others sink from above into the plate and end
// where the body touches it, or begin to do so half way.
static void check_motions(const hanging *h) {
    static ovoid_step steps[STEPS];
    const ovoid_pose none = {{0, 0, 0}, {0, 0, 0, 0}};
    const ovoid_moving_shape plate = {h->plate, ovoid_motion_make_still(h->under), none};
    ovoid_motion_options o = {.steps = steps, .capacity = STEPS};
    for (int turns = 0; turns < 2; turns++) {
        ovoid_moving_pair p = {.a = plate, .b = {h->body, plate.motion, none}};
        p.b.motion = ovoid_motion_make_velocity(h->at, (vec3){1, 0, 0}, (vec3){0, 0, 2 * turns}, 1);
        ovoid_impact x = ovoid_impact_find(&p, &o);
        check_impact(h, &x);
        CHECK_EQ(ovoid_impact_verify(&p, &x, &(ovoid_motion_basis){.steps = steps}, &error), OVOID_OK);
    }
    ovoid_moving_pair near = {.a = plate, .b = {h->body, plate.motion, none}};
    near.b.motion = ovoid_motion_make_velocity(h->at, (vec3){0.1, 0, -0.5 * h->gap}, (vec3){0, 0, 0}, 1);
    ovoid_approach y = ovoid_approach_find(&near, &o);
    check_bracket(&(hanging){.gap = h->gap > 0 ? 0.5 * h->gap : h->gap}, y.lower, y.upper);
    if (h->gap > 0) CHECK_LE(y.upper - y.lower, 1e-7);
    // One that rolls above the plate: to the tolerance of an approach, 1e-6 of a size below 10.
    ovoid_pose high = h->at;
    high.position.z += 1;
    near.b.motion = ovoid_motion_make_velocity(high, (vec3){0.1, 0, 0}, (vec3){4, 1, 0}, 1);
    y = ovoid_approach_find(&near, &o);
    CHECK_LE(y.upper - y.lower, 1e-5);
    ovoid_pair p = {h->plate, h->body, h->under, h->at};
    ovoid_impact x = ovoid_shape_cast(&p, (ovoid_vec3){1, 0, 0}, 0, NULL);
    check_impact(h, &x);
    p.pose_b.position.z += 1 - h->gap;
    x = ovoid_shape_cast(&p, (ovoid_vec3){0, 0, -2}, 0, NULL);
    CHECK_EQ(x.status, OVOID_IMPACT_HIT);
    CHECK_LE(x.free_until, 0.5 + 1e-12);
    CHECK_LE(0.5 - 2e-8, x.free_until);
    CHECK_LE(x.hit_at, 0.5 + 2e-8);
}

// The body on a slide along x, at `at`.
static void check_robot(const hanging *h) {
    static ovoid_robot_step steps[STEPS];
    ovoid_robot_link links[2] = {{"rail"}, {"cart"}};
    ovoid_robot_joint joint = {.name = "slide",
                               .type = OVOID_JOINT_PRISMATIC,
                               .child = 1,
                               .origin = {{0, 0, 0}, {1, 0, 0, 0}},
                               .axis = {1, 0, 0},
                               .lower = -1,
                               .upper = 1,
                               .mimic = OVOID_ROBOT_NONE};
    ovoid_robot_element element = {1, NULL, h->body, h->at, NULL};
    ovoid_robot_description d = {
        .links = links, .link_count = 2, .joints = &joint, .joint_count = 1, .elements = &element, .element_count = 1};
    ovoid_robot *r = ovoid_robot_create(&d, NULL, &error);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(r, NULL, &error);
    const ovoid_body plate = {.shape = h->plate, .pose = h->under};
    CHECK(ovoid_robot_cell_add(cell, &plate, &error) != 0);
    ovoid_robot_checker *x = ovoid_robot_checker_create(cell, NULL, &error);
    ovoid_robot_status wanted = h->gap > 0 ? OVOID_ROBOT_FREE : OVOID_ROBOT_HIT;
    const double q[2] = {-0.7, 0.8};
    ovoid_robot_answer state;
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){q, NULL}, &state, &error), OVOID_OK);
    CHECK_EQ(state.status, wanted);

    ovoid_robot_path path = {q, 2};
    ovoid_robot_path_options o = {.steps = steps, .capacity = STEPS};
    for (int has_steps = 0; has_steps < 2; has_steps++) {
        ovoid_robot_path_answer is;
        o.steps = has_steps ? steps : NULL;
        CHECK_EQ(ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, &o}, &is, &error), OVOID_OK);
        CHECK_EQ(is.status, wanted);
        // Along the plate a few steps are enough, since these are measured by the true supports too.
        if (h->gap > 0) CHECK_LE((double)is.step_count, 64);
        if (has_steps)
            CHECK_EQ(ovoid_robot_path_verify(cell, &is, &(ovoid_robot_path_basis){{&path, &o}, steps}, &error),
                     OVOID_OK);
    }
    ovoid_robot_checker_destroy(x);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(r);
}

int main(void) {
    uint64_t s = 31;
    for (int i = 0; i < 200; i++) {
        check_seed = s;
        hanging h = make_hanging(&s, (ovoid_round_kind)(1 + i % 3), i & 1 ? 1e-5 : -1e-5);
        check_pair(&h);
        check_world(&h);
        check_motions(&h);
        check_robot(&h);
        ovoid_shape_destroy(h.body);
        ovoid_shape_destroy(h.plate);
    }
    check_seed = 0;
    return check_end();
}
