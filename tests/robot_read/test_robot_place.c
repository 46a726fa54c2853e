// A planning scene around a robot: what links hold, frames, paddings, allowed collisions, followers' limits, and what
// is said where nothing is compared. Truth: boxes on one axis, whose distances can be told by hand; the meaning of each
// key is that of MoveIt's PlanningScene::setPlanningSceneMsg.
#define FILES_FOLDER "test_place"
#include "robot_files.h"

#include "ovoid/robot_path.h"

// A box of 0.2 slides along x, from -5 to 5; another one on top of it turns about z.
static const char urdf[] =
    "<robot name=\"r\"><link name=\"base\"/>"
    "<link name=\"tip\"><collision><geometry><box size=\"0.2 0.2 0.2\"/></geometry></collision></link>"
    "<link name=\"hand\"><collision><origin xyz=\"0 0 0.3\"/><geometry><box size=\"0.2 0.2 0.2\"/></geometry>"
    "</collision></link>"
    "<joint name=\"j\" type=\"prismatic\"><parent link=\"base\"/><child link=\"tip\"/><axis xyz=\"1 0 0\"/>"
    "<limit lower=\"-5\" upper=\"5\" effort=\"1\" velocity=\"1\"/></joint>"
    "<joint name=\"k\" type=\"continuous\"><parent link=\"tip\"/><child link=\"hand\"/><axis xyz=\"0 0 1\"/></joint>"
    "</robot>";

#define BOX(id, x, more)                                                                                               \
    "{id: " id ", primitives: [{type: box, dimensions: [0.1, 0.1, 0.1]}], primitive_poses: [{position: [" x            \
    ", 0, 0]}]" more "}"
#define WORLD(objects) "world:\n  collision_objects: [" objects "]\n"

typedef struct setup {
    ovoid_robot_file *file;
    ovoid_robot *robot;
    ovoid_obstacles *obstacles;
    ovoid_robot_cell *cell;
    ovoid_robot_checker *checker;
    ovoid_placed_obstacle placed[8];
    ovoid_code code;
    ovoid_error error;
} setup;

static int open_with(setup *s, const char *robot, const char *srdf, const char *scene, int fixed_base) {
    ovoid_robot_read_options options = make_read_options();
    options.fixed_base = fixed_base;
    *s = (setup){.error = {OVOID_OK, -1, ""}};
    s->file = srdf ? read_both(robot, srdf, &options, NULL) : read_urdf(robot, &options, NULL);
    if (!CHECK(s->file)) return 0;
    ovoid_robot_description d = ovoid_robot_file_get_description(s->file);
    s->robot = ovoid_robot_create(&d, NULL, &s->error);
    s->cell = s->robot ? ovoid_robot_cell_create(s->robot, NULL, &s->error) : NULL;
    s->obstacles = ovoid_obstacles_read(file_write_text("scene.yaml", scene), &options, &s->error);
    if (!CHECK(s->cell && s->obstacles)) return printf("  %s\n", s->error.message), 0;
    s->code = ovoid_robot_cell_add_obstacles(s->cell, s->obstacles, s->placed, &s->error);
    s->checker = ovoid_robot_checker_create(s->cell, NULL, NULL);
    return 1;
}

static void close_setup(setup *s) {
    ovoid_robot_checker_destroy(s->checker);
    ovoid_robot_cell_destroy(s->cell);
    ovoid_obstacles_destroy(s->obstacles);
    ovoid_robot_destroy(s->robot);
    ovoid_robot_file_destroy(s->file);
}

static ovoid_robot_answer ask(const setup *s, double j, double k) {
    ovoid_robot_answer answer;
    ovoid_robot_query_options options = {.limit_slack = 0};
    CHECK_EQ(ovoid_robot_collide(s->checker, &(ovoid_robot_query){(double[2]){j, k}, &options}, &answer, NULL),
             OVOID_OK);
    return answer;
}

/// Whether a state of the robot in the scene has the status.
static int is_state(const char *scene, double j, double k, ovoid_robot_status expected) {
    setup s;
    int is_so = open_with(&s, urdf, NULL, scene, 0) && CHECK_EQ(s.code, OVOID_OK);
    if (!is_so) printf("  %s\n", s.error.message);
    is_so = is_so && CHECK_EQ(ask(&s, j, k).status, expected);
    close_setup(&s);
    return is_so;
}
#define FREE(scene, j, k) CHECK(is_state(scene, j, k, OVOID_ROBOT_FREE))
#define HIT(scene, j, k) CHECK(is_state(scene, j, k, OVOID_ROBOT_HIT))

// ---- what links hold

#define HELD(state, more, object)                                                                                      \
    "robot_state:\n  joint_state: {name: [j], position: [" state "]}\n  attached_collision_objects:\n"                 \
    "    - link_name: tip\n" more "      object: " object "\n"

static void test_held(void) {
    // A box 1 m ahead of the tip, given in the tip's frame, moves with it: it meets the obstacle at x = 3 for j = 2.
    static const char ahead[] = HELD("0", "", BOX("held", "1", ", header: {frame_id: tip}")) WORLD(BOX("o", "3", ""));
    FREE(ahead, 0, 0);
    HIT(ahead, 2, 0);
    // Given in the root's frame, with or without a name, it is where it was seen with the tip at 0.5: 0.5 m ahead.
    static const char seen[] = HELD("0.5", "", BOX("held", "1", ", header: {frame_id: base}")) WORLD(BOX("o", "3", ""));
    static const char nameless[] = HELD("0.5", "", BOX("held", "1", "")) WORLD(BOX("o", "3", ""));
    FREE(seen, 2, 0), HIT(seen, 2.5, 0);
    FREE(nameless, 2, 0), HIT(nameless, 2.5, 0);
    // Through the hand, which it may touch or not; of the tip, which holds it, nothing is asked.
    static const char through[] =
        HELD("0", "", BOX("held", "0", ", pose: {position: [0, 0, 0.3]}")) WORLD(BOX("o", "3", ""));
    static const char touching[] =
        HELD("0", "      touch_links: [hand, other]\n      weight: 2\n      detach_posture: {points: []}\n",
             BOX("held", "0", ", pose: {position: [0, 0, 0.3]}")) WORLD(BOX("o", "3", ""));
    HIT(through, 0, 0), FREE(touching, 0, 0);
    setup s;
    if (open_with(&s, urdf, NULL, ahead, 0)) {
        CHECK_EQ(ovoid_obstacles_get_count(s.obstacles), 2);
        CHECK(strcmp(ovoid_obstacles_get(s.obstacles, 1).link, "tip") == 0);
        CHECK(strcmp(ovoid_obstacles_get(s.obstacles, 1).frame, "tip") == 0);
        CHECK(s.placed[0].link == OVOID_ROBOT_NONE && s.placed[1].link == ovoid_robot_find_link(s.robot, "tip"));
        CHECK_EQ(ask(&s, 2, 0).a.body, s.placed[1].id);
    }
    close_setup(&s);
}

// ---- frames

static void test_frames(void) {
    // In the frame of a link an obstacle stands where that was in the scene's state, and stays there.
    static const char of_link[] = "robot_state: {joint_state: {name: [j, unknown], position: [0.5, 7]}}\n" WORLD(
        BOX("o", "1", ", header: {frame_id: /tip}"));
    FREE(of_link, 0, 0), HIT(of_link, 1.5, 0), FREE(of_link, 2, 0);
    // A fixed frame; the last one of a name counts. A quarter of a turn about z takes x to y.
    static const char fixed[] =
        "fixed_frame_transforms:\n"
        "  - {header: {frame_id: cam}, child_frame_id: base, transform: {translation: [9, 0, 0]}}\n"
        "  - {header: {frame_id: cam}, child_frame_id: base, transform: {translation: [2, -1, 0], rotation: [0, 0, "
        "1, 1]}}\n" WORLD(BOX("o", "1", ", header: {frame_id: cam, stamp: {sec: 1}}"));
    FREE(fixed, 0, 0), HIT(fixed, 2, 0), FREE(fixed, 3, 0);
    // MotionBenchMaker's: no name, and nothing moves.
    static const char none[] = "fixed_frame_transforms: [{child_frame_id: world, transform: {rotation: [0, 0, 0, 1], "
                               "translation: [0, 0, 0]}}]\n" WORLD(BOX("o", "1", ""));
    HIT(none, 1, 0);
    setup s;
    static const char unknown[] = WORLD(BOX("o", "1", ",\n header: {frame_id: camera}"));
    if (open_with(&s, urdf, NULL, unknown, 0)) {
        CHECK_EQ(s.code, OVOID_ERROR_FORMAT);
        CHECK(strstr(s.error.message, "scene.yaml:2: object \"o\": its frame, header: frame_id \"camera\""));
        CHECK_EQ(ask(&s, 0, 0).status, OVOID_ROBOT_FREE); // of the two links alone
    }
    close_setup(&s);
    static const char other[] = "fixed_frame_transforms: [{header: {frame_id: a}, child_frame_id: map, transform: "
                                "{translation: [1, 0, 0]}}]\n" WORLD(BOX("o", "1", ""));
    if (open_with(&s, urdf, NULL, other, 0))
        CHECK(s.code == OVOID_ERROR_FORMAT && strstr(s.error.message, "child_frame_id is \"map\", not the model's"));
    close_setup(&s);
}

#define SRDF                                                                                                           \
    "<robot name=\"r\"><virtual_joint name=\"v\" type=\"planar\" parent_frame=\"map\" child_link=\"base\"/></robot>"

// The model's frame is that above the virtual joint, whether that joint counts or not; a base that stands elsewhere is
// obeyed with the joint and refused without.
static void test_bases(void) {
    static const char moved[] =
        "robot_state: {multi_dof_joint_state: {joint_names: [v], transforms: [{translation: [0, 1, 0], rotation: [0, "
        "0, 1, 1]}]}}\n" WORLD(
            BOX("o", "1", ", header: {frame_id: tip}") "," BOX("p", "2", ", header: {frame_id: map}"));
    setup s;
    if (open_with(&s, urdf, SRDF, moved, 0) && CHECK_EQ(s.code, OVOID_OK)) {
        CHECK(fabs(s.placed[0].pose.position.x) < 1e-15 && fabs(s.placed[0].pose.position.y - 2) < 1e-15);
        CHECK_EQ(s.placed[1].pose.position.x, 2);
    }
    close_setup(&s);
    for (int has_srdf = 0; has_srdf < 2; has_srdf++) {
        if (open_with(&s, urdf, has_srdf ? SRDF : NULL, moved, 1))
            CHECK(s.code == OVOID_ERROR_FORMAT && strstr(s.error.message, "joint \"v\" is not of the robot"));
        close_setup(&s);
    }
    static const char map[] = WORLD(BOX("p", "2", ", header: {frame_id: map}"));
    if (open_with(&s, urdf, SRDF, map, 1)) CHECK_EQ(s.code, OVOID_OK);
    close_setup(&s);
}

// ---- paddings and allowed collisions

static void test_padding(void) {
    // The gap at j = 0 is 1 - 0.05 - 0.1.
    FREE("link_padding: [{link_name: tip, padding: 0.8}]\n" WORLD(BOX("o", "1", "")), 0, 0);
    HIT("link_padding: [{link_name: tip, padding: 0.9}]\n" WORLD(BOX("o", "1", "")), 0, 0);
    setup s;
    if (open_with(&s, urdf, NULL, "link_padding:\n  - {link_name: tap, padding: 0.9}\n" WORLD(BOX("o", "1", "")), 0))
        CHECK(s.code == OVOID_ERROR_FORMAT && strstr(s.error.message, "scene.yaml:2: link_padding: there is no link"));
    close_setup(&s);
}

#define MATRIX(names, rows, more)                                                                                      \
    "allowed_collision_matrix: {entry_names: [" names "], entry_values: [" rows "]" more "}\n"

static void test_matrix(void) {
    // Two links that overlap in all states: the SRDF disables them, a matrix that does not name them enables them.
    static const char close[] =
        "<robot name=\"r\"><link name=\"base\"><collision><geometry><sphere "
        "radius=\"1\"/></geometry></collision></link>"
        "<link name=\"tip\"><collision><geometry><sphere radius=\"1\"/></geometry></collision></link>"
        "<joint name=\"j\" type=\"continuous\"><parent link=\"base\"/><child link=\"tip\"/></joint>"
        "<joint name=\"k\" type=\"continuous\"><parent link=\"tip\"/><child link=\"hand\"/></joint>"
        "<link name=\"hand\"/></robot>";
    static const char srdf[] = "<robot name=\"r\"><disable_collisions link1=\"base\" link2=\"tip\"/></robot>";
    static const struct {
        const char *scene;
        ovoid_robot_status expected;
    } cases[] = {
        {WORLD(BOX("o", "5", "")), OVOID_ROBOT_FREE},
        {MATRIX("", "", "") WORLD(BOX("o", "5", "")), OVOID_ROBOT_FREE},
        {MATRIX("base, x", "[0, 1], [1, 0]", "") WORLD(BOX("o", "5", "")), OVOID_ROBOT_HIT},
        {MATRIX("tip, x, base", "{enabled: [0, 0, true]}, [0, 0, 0], [0, 0, 0]", "") WORLD(BOX("o", "5", "")),
         OVOID_ROBOT_FREE},
        {MATRIX("tip, base", "[0, 0], [1, 0]", "") WORLD(BOX("o", "5", "")), OVOID_ROBOT_HIT}, // the upper entry counts
        {MATRIX("", "", ", default_entry_names: [tip], default_entry_values: [1]") WORLD(BOX("o", "5", "")),
         OVOID_ROBOT_FREE},
        {MATRIX("", "", ", default_entry_names: [tip, base], default_entry_values: [1, 0]") WORLD(BOX("o", "5", "")),
         OVOID_ROBOT_HIT},
        {MATRIX("tip, base", "[0, 0], [0, 0]", ", default_entry_names: [tip], default_entry_values: [1]")
             WORLD(BOX("o", "5", "")),
         OVOID_ROBOT_HIT},
        // An obstacle in both links, which touch: each is named.
        {MATRIX("tip, base, o", "[0, 1, 1], [1, 0, 1], [1, 1, 0]", "") WORLD(BOX("o", "0", "") "," BOX("p", "5", "")),
         OVOID_ROBOT_FREE},
        {MATRIX("tip, base, o", "[0, 1, 1], [1, 0, 0], [1, 0, 0]", "") WORLD(BOX("o", "0", "")), OVOID_ROBOT_HIT},
        {MATRIX("tip, base", "[0, 1], [1, 0]", ", default_entry_names: [o], default_entry_values: [1]")
             WORLD(BOX("o", "0", "") "," BOX("p", "5", "")),
         OVOID_ROBOT_FREE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        setup s;
        check_seed = i;
        if (open_with(&s, close, srdf, cases[i].scene, 0) && CHECK_EQ(s.code, OVOID_OK))
            CHECK_EQ(ask(&s, 0, 0).status, cases[i].expected);
        close_setup(&s);
    }
    check_seed = 0;
    // What the tip holds may touch the obstacle only if the tip may.
    static const char held[] = MATRIX("held, o", "[0, 1], [1, 0]", "")
        HELD("0", "", BOX("held", "1", ", header: {frame_id: tip}")) WORLD(BOX("o", "1", ""));
    setup s;
    if (open_with(&s, urdf, NULL, held, 0))
        CHECK(s.code == OVOID_ERROR_FORMAT && strstr(s.error.message, "has one entry for it and \"o\""));
    close_setup(&s);
    static const char both[] = MATRIX("held, tip, o", "[0, 0, 1], [0, 0, 1], [1, 1, 0]", "")
        HELD("0", "", BOX("held", "1", ", header: {frame_id: tip}")) WORLD(BOX("o", "1", ""));
    FREE(both, 0, 0);
}

// ---- followers and nothing

static void test_followers(void) {
    static const char text[] =
        "<robot name=\"m\"><link name=\"b\"/><link name=\"c\"/><link name=\"d\"/><link name=\"e\"/>"
        "<joint name=\"j\" type=\"revolute\"><parent link=\"b\"/><child link=\"c\"/><limit lower=\"-3\" "
        "upper=\"3\"/></joint>"
        "<joint name=\"k\" type=\"revolute\"><parent link=\"b\"/><child link=\"d\"/><limit lower=\"-0.1\" "
        "upper=\"0.3\"/>"
        "<mimic joint=\"j\" multiplier=\"-0.5\" offset=\"0.1\"/></joint>"
        "<joint name=\"l\" type=\"prismatic\"><parent link=\"d\"/><child link=\"e\"/><limit lower=\"-9\" "
        "upper=\"0.5\"/>"
        "<mimic joint=\"k\" multiplier=\"3\"/></joint></robot>";
    setup s;
    if (!open_with(&s, text, NULL, WORLD(""), 0)) return;
    // k is 0.1 - j / 2, and l three times that: -0.1333 <= j <= 0.4.
    static const double q[] = {0, 0.4, 0.4000001, -0.13333333333333, -0.1334, -0.4};
    static const char *const names[] = {NULL, NULL,          "joint \"k\", which follows \"j\"",
                                        NULL, "joint \"l\"", "joint \"l\""};
    for (size_t i = 0; i < sizeof q / sizeof *q; i++) {
        ovoid_error error = {OVOID_OK, -1, ""};
        ovoid_code code = ovoid_robot_validate_limits(s.robot, &q[i], 0, &error);
        CHECK_EQ(code, names[i] ? OVOID_ERROR_RANGE : OVOID_OK);
        if (names[i] && !CHECK(strstr(error.message, names[i]))) printf("  %s\n", error.message);
        if (names[i]) CHECK_EQ(error.place, 0);
        CHECK_EQ(ask(&s, q[i], 0).status, names[i] ? OVOID_ROBOT_REFUSED : OVOID_ROBOT_UNDECIDED);
    }
    CHECK_EQ(ovoid_robot_validate_limits(s.robot, (double[1]){0.42}, 0.02, NULL), OVOID_OK);
    close_setup(&s);
}

// Nothing is said of no pair: by a state, many, a path, its clearance, and the check of a proof that says more.
static void test_nothing(void) {
    setup s;
    static const char visual[] =
        "<robot name=\"v\"><link name=\"a\"><visual><geometry><box size=\"1 1 1\"/></geometry></visual></link>"
        "<link name=\"b\"><visual><geometry><box size=\"1 1 1\"/></geometry></visual></link>"
        "<joint name=\"j\" type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/></joint></robot>";
    if (!open_with(&s, visual, NULL, WORLD(BOX("o", "0", "")), 0)) return;
    ovoid_robot_answer one = ask(&s, 0, 0), many[2];
    CHECK(one.status == OVOID_ROBOT_UNDECIDED && one.code == OVOID_ERROR_EMPTY && one.a.link == OVOID_ROBOT_NONE);
    const double q[2] = {0, 1};
    const ovoid_robot_batch batch = {q, 2, NULL, many};
    CHECK_EQ(ovoid_robot_collide_batch(&s.checker, 1, &batch, NULL), OVOID_OK);
    CHECK(many[1].status == OVOID_ROBOT_UNDECIDED && many[1].code == OVOID_ERROR_EMPTY);
    const ovoid_robot_path path = {q, 2};
    ovoid_robot_path_answer answer;
    for (int any = 0; any < 2; any++) {
        const ovoid_robot_path_options options = {.any_hit = any};
        CHECK_EQ(ovoid_robot_path_find_hit(s.checker, &(ovoid_robot_path_query){&path, &options}, &answer, NULL),
                 OVOID_OK);
        CHECK(answer.status == OVOID_ROBOT_UNDECIDED && answer.hit.code == OVOID_ERROR_EMPTY && answer.free_until == 0);
        CHECK_EQ(ovoid_robot_path_verify(s.cell, &answer, &(ovoid_robot_path_basis){{&path, &options}, NULL}, NULL),
                 OVOID_OK);
    }
    answer.status = OVOID_ROBOT_FREE, answer.free_until = 1;
    CHECK_EQ(ovoid_robot_path_verify(s.cell, &answer, &(ovoid_robot_path_basis){{&path, NULL}, NULL}, NULL),
             OVOID_ERROR_PROOF);
    ovoid_robot_clearance clearance;
    CHECK_EQ(ovoid_robot_path_compute_clearance(s.checker, &(ovoid_robot_path_query){&path, NULL}, &clearance, NULL),
             OVOID_OK);
    CHECK(clearance.status == OVOID_ROBOT_UNDECIDED && clearance.code == OVOID_ERROR_EMPTY);
    close_setup(&s);
    ovoid_robot_read_options options = make_read_options();
    ovoid_robot_file *file = read_urdf(visual, &options, NULL);
    CHECK(notes.count == 1 && has_note("2 links have only <visual> geometry, which is not compared: a, b"));
    ovoid_robot_file_destroy(file);
    // Options may leave nothing: the two links alone are a pair.
    if (!open_with(&s, urdf, NULL, WORLD(""), 0)) return;
    ovoid_robot_query_options without = {.without_self = 1};
    CHECK_EQ(ovoid_robot_collide(s.checker, &(ovoid_robot_query){(double[2]){0, 0}, &without}, &one, NULL), OVOID_OK);
    CHECK(one.status == OVOID_ROBOT_UNDECIDED && one.code == OVOID_ERROR_EMPTY);
    CHECK_EQ(ask(&s, 0, 0).status, OVOID_ROBOT_FREE);
    CHECK_EQ(ovoid_robot_cell_add_allowed(s.cell, 1, 2, NULL), OVOID_OK);
    CHECK_EQ(ask(&s, 0, 0).status, OVOID_ROBOT_UNDECIDED);
    close_setup(&s);
}

int main(void) {
    test_held();
    test_frames();
    test_bases();
    test_padding();
    test_matrix();
    test_followers();
    test_nothing();
    return check_end();
}
