// Near pairs whose depth fills a search's own memory: a ball on a slide, in a fixed ball with nearly the same centre.
// Truth: the pair asked alone with memory; without any memory left, the answer is true and wide.
#include "countdown.h"
#include "proofs/covers.h"
#include "robots.h"

enum { VERTICES = 700 };

static ovoid_shape *make_ball(void) {
    double points[3 * VERTICES];
    for (int i = 0; i < VERTICES; i++) {
        double z = 2 * (i + 0.5) / VERTICES - 1, r = sqrt(1 - z * z), turn = 2.399963229728653 * i;
        points[3 * i] = r * cos(turn), points[3 * i + 1] = r * sin(turn), points[3 * i + 2] = z;
    }
    return ovoid_shape_create_from_points(points, VERTICES, NULL, NULL);
}

static ovoid_answer ask_alone(const ovoid_shape *ball, const ovoid_pose *fixed, double q) {
    ovoid_cover cover = {.size = ovoid_cover_get_size(4000)};
    cover.memory = malloc(cover.size);
    const ovoid_pair pair = {ball, ball, {{q, 0, 0}, {1, 0, 0, 0}}, *fixed};
    ovoid_answer x = ovoid_depth(&pair, NULL, NULL, &cover);
    CHECK(x.limit == OVOID_LIMIT_NONE && cover.point_count > OVOID_COVER_POINTS);
    free(cover.memory);
    return x;
}

int main(void) {
    ovoid_error error = {0};
    ovoid_shape *ball = make_ball();
    const ovoid_robot_link links[2] = {{.name = "base"}, {.name = "slide"}};
    const ovoid_robot_joint joint = {.name = "x",
                                     .type = OVOID_JOINT_PRISMATIC,
                                     .parent = 0,
                                     .child = 1,
                                     .origin = ovoid_pose_make_identity(),
                                     .axis = {1, 0, 0},
                                     .lower = -1,
                                     .upper = 1,
                                     .mimic = OVOID_ROBOT_NONE,
                                     .multiplier = 1};
    const ovoid_robot_element element = {.link = 1, .shape = ball, .pose = ovoid_pose_make_identity()};
    const ovoid_robot_description description = {
        .links = links, .link_count = 2, .joints = &joint, .joint_count = 1, .elements = &element, .element_count = 1};
    ovoid_robot *robot = ovoid_robot_create(&description, NULL, &error);
    ovoid_robot_cell *cell = robot ? ovoid_robot_cell_create(robot, NULL, &error) : NULL;
    const ovoid_body fixed = {.shape = ball, .pose = {{1e-4, 2e-4, 0}, {0.3, 0.4, 0.5, 0.7}}};
    if (!CHECK(cell && ovoid_robot_cell_add(cell, &fixed, &error))) return printf("%s\n", error.message), check_end();
    countdown memory = {1000, 0};
    const ovoid_allocator allocator = countdown_make_allocator(&memory);
    ovoid_robot_checker *x =
        ovoid_robot_checker_create(cell, &(ovoid_robot_checker_options){.allocator = &allocator}, &error);
    for (int i = 0; x && i < 6; i++) {
        double q = 1e-3 * (i % 3), row[1];
        ovoid_robot_near near;
        ovoid_robot_nears nears = {.items = &near, .gradients = row, .capacity = 1};
        memory.left = i < 3 ? 0 : 1000;
        long held = memory.held;
        CHECK_EQ(ovoid_robot_find_near(x, &(ovoid_robot_query){&q, NULL}, &nears, &error), OVOID_OK);
        if (!CHECK_EQ(nears.count, 1)) continue;
        ovoid_answer alone = ask_alone(ball, &fixed.pose, q);
        CHECK_EQ((int)near.status, (int)OVOID_OVERLAPPING);
        CHECK(near.lower <= alone.upper && alone.lower <= near.upper);
        CHECK((near.upper - near.lower < 1e-8) == (i >= 3));
        // The memory is taken once.
        CHECK_EQ(memory.held - held, i == 3);
    }
    ovoid_robot_checker_destroy(x);
    CHECK_EQ(memory.held, 0);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(robot);
    ovoid_shape_destroy(ball);
    return check_end();
}
