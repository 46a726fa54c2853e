// Calls that a host stops: for a watch that says so at its k-th question the call ends, and what it gave is true.
// Truth: the answer of the whole call, which that of a stopped one must not contradict; its proof; covers by an audit
// of their own.
#include "check.h"
#include "patience.h"
#include "robots.h"

#include "ovoid/robot_matrix.h"
#include "ovoid/robot_path.h"
#include "ovoid/robot_spheres.h"

enum { STEPS = 4096 };
static ovoid_error error;

/// Two bars on hinges and a ball beside them.
typedef struct scene {
    ovoid_shape *bar, *ball;
    ovoid_robot *robot;
    ovoid_robot_cell *cell;
    ovoid_robot_checker *checker;
} scene;

static void open_scene(scene *s) {
    static const double half[24] = {0, -0.1, -0.1, 1, -0.1, -0.1, 0, 0.1, -0.1, 1, 0.1, -0.1,
                                    0, -0.1, 0.1,  1, -0.1, 0.1,  0, 0.1, 0.1,  1, 0.1, 0.1};
    static const ovoid_robot_link links[3] = {{"base"}, {"upper"}, {"lower"}};
    s->bar = ovoid_shape_create_from_points(half, 8, NULL, &error);
    s->ball = ovoid_shape_create_sphere(0.2, NULL, &error);
    ovoid_pose here = ovoid_pose_make_identity(), there = here;
    there.position.x = 1;
    const ovoid_robot_joint joints[2] = {{.name = "a",
                                          .type = OVOID_JOINT_REVOLUTE,
                                          .parent = 0,
                                          .child = 1,
                                          .origin = here,
                                          .axis = {0, 0, 1},
                                          .lower = -3,
                                          .upper = 3,
                                          .mimic = OVOID_ROBOT_NONE,
                                          .multiplier = 1},
                                         {.name = "b",
                                          .type = OVOID_JOINT_REVOLUTE,
                                          .parent = 1,
                                          .child = 2,
                                          .origin = there,
                                          .axis = {0, 0, 1},
                                          .lower = -3,
                                          .upper = 3,
                                          .mimic = OVOID_ROBOT_NONE,
                                          .multiplier = 1}};
    const ovoid_robot_element elements[3] = {
        {1, NULL, s->bar, here, NULL}, {2, NULL, s->bar, here, NULL}, {0, NULL, s->ball, here, NULL}};
    const ovoid_robot_description d = {
        .links = links, .link_count = 3, .joints = joints, .joint_count = 2, .elements = elements, .element_count = 3};
    s->robot = ovoid_robot_create(&d, NULL, &error);
    s->cell = ovoid_robot_cell_create(s->robot, NULL, &error);
    there.position = (ovoid_vec3){1.6, 1.4, 0};
    CHECK(ovoid_robot_cell_add(s->cell, &(const ovoid_body){.shape = s->ball, .pose = there}, &error) != 0);
    CHECK(ovoid_robot_cell_add_allowed(s->cell, 1, 2, &error) == OVOID_OK);
    CHECK(ovoid_robot_cell_add_allowed(s->cell, 0, 1, &error) == OVOID_OK);
    s->checker = ovoid_robot_checker_create(s->cell, NULL, &error);
    CHECK(s->checker != NULL);
}

static void close_scene(scene *s) {
    ovoid_robot_checker_destroy(s->checker);
    ovoid_robot_cell_destroy(s->cell);
    ovoid_robot_destroy(s->robot);
    ovoid_shape_destroy(s->bar);
    ovoid_shape_destroy(s->ball);
}

static const double states[6] = {-0.5, 0.3, 0.2, 0.1, 0.3, 2.5};
static const ovoid_robot_path path = {states, 3};

static void check_path(scene *s) {
    static ovoid_robot_step steps[STEPS];
    patience p;
    size_t whole = SIZE_MAX;
    double before = 0;
    for (size_t most = 0; most < whole; most++) {
        ovoid_robot_path_options o = {.steps = steps, .capacity = STEPS, .watch = make_watch(&p, most)};
        ovoid_robot_path_answer is;
        ovoid_robot_checker_reset(s->checker);
        if (!CHECK_EQ(ovoid_robot_path_find_hit(s->checker, &(ovoid_robot_path_query){&path, &o}, &is, &error),
                      OVOID_OK))
            return;
        CHECK_EQ(ovoid_robot_path_verify(s->cell, &is, &(ovoid_robot_path_basis){{&path, &o}, steps}, &error),
                 OVOID_OK);
        CHECK(is.free_until >= before);
        CHECK(is.states <= most);
        before = is.free_until;
        if (p.asked <= most) whole = most;
        CHECK_EQ(is.status, whole < SIZE_MAX ? OVOID_ROBOT_FREE : OVOID_ROBOT_UNDECIDED);
    }
    CHECK(whole > 3);
}

static void check_clearance(scene *s) {
    patience p;
    ovoid_robot_clearance true_one, is;
    CHECK_EQ(ovoid_robot_path_compute_clearance(s->checker, &(ovoid_robot_path_query){&path, NULL}, &true_one, &error),
             OVOID_OK);
    CHECK_EQ(true_one.status, OVOID_ROBOT_FREE);
    size_t whole = SIZE_MAX;
    for (size_t most = 0; most < whole; most++) {
        ovoid_robot_path_options o = {.watch = make_watch(&p, most)};
        ovoid_robot_checker_reset(s->checker);
        if (!CHECK_EQ(ovoid_robot_path_compute_clearance(s->checker, &(ovoid_robot_path_query){&path, &o}, &is, &error),
                      OVOID_OK))
            return;
        CHECK(is.lower <= true_one.upper && true_one.lower <= is.upper);
        CHECK(is.states <= most);
        if (p.asked <= most) whole = most;
        if (whole == SIZE_MAX) CHECK(p.asked == most + 1 && is.lower <= true_one.lower);
    }
    CHECK(whole > 3);
    CHECK_NEAR(is.upper, true_one.upper, 2e-3);
}

static void check_matrix(scene *s) {
    patience p;
    ovoid_robot_matrix_options o = {.samples = 48, .budget = 100};
    ovoid_robot_matrix *all = ovoid_robot_matrix_create(s->robot, &o, &error);
    if (!CHECK(all != NULL)) return;
    size_t whole = SIZE_MAX;
    for (size_t most = 0; most < whole && most < 400; most++) {
        o.watch = make_watch(&p, most);
        ovoid_robot_matrix *m = ovoid_robot_matrix_create(s->robot, &o, &error);
        if (!CHECK(m != NULL)) break;
        if (p.asked <= most) whole = most;
        for (size_t i = 0; i < ovoid_robot_matrix_get_count(m); i++) {
            ovoid_robot_matrix_pair is = ovoid_robot_matrix_get_pair(m, i), full = ovoid_robot_matrix_get_pair(all, i);
            int is_proven = is.touch == OVOID_ROBOT_TOUCH_NEVER || is.touch == OVOID_ROBOT_TOUCH_ALWAYS ||
                            is.touch == OVOID_ROBOT_TOUCH_SOMETIMES;
            CHECK(!is_proven || is.touch == full.touch);
            CHECK(is.samples <= 8 * most && is.cells <= most);
            if (whole < SIZE_MAX) CHECK(is.touch == full.touch && is.cells == full.cells);
        }
        ovoid_robot_matrix_destroy(m);
    }
    CHECK(whole > 8 && whole < SIZE_MAX);
    ovoid_robot_matrix_destroy(all);
}

static void check_spheres(scene *s) {
    const ovoid_robot_sphere half = {{0.5, 0, 0}, 0.3};
    patience p;
    ovoid_robot_sphere_audit all, is;
    ovoid_robot_audit_options o = {.depth_cells = 256, .volume_cells = 256};
    CHECK_EQ(ovoid_robot_compute_sphere_audit(&(ovoid_robot_sphere_model){s->robot, 1, &half, 1}, &o, &all, &error),
             OVOID_OK);
    for (size_t most = 0; most < 64; most++) {
        o.watch = make_watch(&p, most);
        CHECK_EQ(ovoid_robot_compute_sphere_audit(&(ovoid_robot_sphere_model){s->robot, 1, &half, 1}, &o, &is, &error),
                 OVOID_OK);
        CHECK(is.depth.lower <= all.depth.upper && all.depth.lower <= is.depth.upper &&
              is.depth.upper >= all.depth.upper);
        CHECK(is.link.lower <= 0.04 && 0.04 <= is.link.upper && is.cells <= all.cells);
        CHECK(p.asked <= most + 2);
    }
    // A cover is one whenever it is stopped, or none as near as was asked.
    for (size_t most = 0; most < 600; most = 3 * most + 1) {
        ovoid_robot_sphere spheres[8];
        for (int fewest = 0; fewest < 2; fewest++) {
            ovoid_robot_cover_options c = {.rounds = 200, .excess = fewest ? 0.05 : 0, .watch = make_watch(&p, most)};
            ovoid_robot_sphere_cover cover = {.link = 1, .spheres = spheres, .capacity = 6};
            ovoid_code code = ovoid_robot_compute_sphere_cover(s->robot, &c, &cover, &error);
            CHECK(code == OVOID_OK || (fewest && code == OVOID_ERROR_LIMIT));
            if (code != OVOID_OK) continue;
            o.watch = (ovoid_watch){NULL, NULL};
            CHECK_EQ(ovoid_robot_compute_sphere_audit(&(ovoid_robot_sphere_model){s->robot, 1, spheres, cover.count},
                                                      &o, &is, &error),
                     OVOID_OK);
            CHECK(cover.depth.upper <= 0 && is.depth.lower <= 0);
        }
    }
}

int main(void) {
    scene s;
    open_scene(&s);
    check_path(&s);
    check_clearance(&s);
    check_matrix(&s);
    check_spheres(&s);
    close_scene(&s);
    return check_end();
}
