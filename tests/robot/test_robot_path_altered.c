// A liar for ovoid_robot_path_verify. True answers of random arms among boxes are altered one field at a time
// (alter.h), the answer's and its steps', and others are forged: a step over two segments, over an arc that comes
// nearer between its ends, over more motion than there is room for, a state that collides and is called free without
// steps.
//
// Truth: kinematics in long double, written here from the joints' numbers; distances of the bodies at sampled s of the
// exact path. What a sample shows to be false must be refused; what none does may pass. Slack: 1e-12, the rounding of
// poses to doubles at lengths of some metres.
#include "alter.h"
#include "options.h"
#include "robots.h"

#include "ovoid/robot_path.h"

enum { LINKS = 4, OBSTACLES = 3, STATES = 3, STEPS = 4000, SAMPLES = 48, CASES = 40 };
static const double slack = 1e-12;
static ovoid_robot_step steps[STEPS], other_steps[STEPS];
static ovoid_error error;

// An arm in a plane: joint i turns about z, or slides along x of the frame before it; a box on each link.
typedef struct arm {
    ovoid_robot_joint joints[LINKS];
    ovoid_robot_element elements[LINKS];
    ovoid_shape *boxes[2];
    ovoid_body obstacles[OBSTACLES];
    ovoid_id ids[OBSTACLES];
    size_t obstacle_count;
    ovoid_robot *robot;
    ovoid_robot_cell *cell;
    ovoid_robot_checker *checker;
    double q[STATES * LINKS];
    ovoid_robot_path path;
    double margin;
} arm;

static const ovoid_robot_link links[LINKS + 1] = {{"a"}, {"b"}, {"c"}, {"d"}, {"e"}};

static void set_joint(arm *m, uint32_t i, ovoid_joint_type type, double length) {
    m->joints[i] =
        (ovoid_robot_joint){.name = links[i].name,
                            .type = type,
                            .parent = i,
                            .child = i + 1,
                            .origin = {{length, 0, 0}, {1, 0, 0, 0}},
                            .axis = type == OVOID_JOINT_PRISMATIC ? (ovoid_vec3){1, 0, 0} : (ovoid_vec3){0, 0, 1},
                            .lower = -100,
                            .upper = 100,
                            .mimic = OVOID_ROBOT_NONE,
                            .multiplier = 1};
}

static void open_arm(arm *m, uint32_t joints) {
    const ovoid_robot_pair near[] = {{0, 1, NULL}, {1, 2, NULL}, {2, 3, NULL}, {3, 4, NULL}};
    const ovoid_robot_description d = {.links = links,
                                       .link_count = joints + 1,
                                       .joints = m->joints,
                                       .joint_count = joints,
                                       .elements = m->elements,
                                       .element_count = joints,
                                       .disabled = near,
                                       .disabled_count = joints};
    m->robot = ovoid_robot_create(&d, NULL, &error);
    m->cell = m->robot ? ovoid_robot_cell_create(m->robot, NULL, &error) : NULL;
    if (!m->cell) printf("%s\n", error.message), exit(1);
    for (size_t i = 0; i < m->obstacle_count; i++) m->ids[i] = ovoid_robot_cell_add(m->cell, &m->obstacles[i], &error);
    m->checker = ovoid_robot_checker_create(m->cell, NULL, &error);
}

static void close_arm(arm *m) {
    ovoid_robot_checker_destroy(m->checker);
    ovoid_robot_cell_destroy(m->cell);
    ovoid_robot_destroy(m->robot);
    for (int i = 0; i < 2; i++) ovoid_shape_destroy(m->boxes[i]);
}

static ovoid_pose turned(double x, double y, double angle) {
    return (ovoid_pose){{x, y, 0}, {cos(angle / 2), 0, 0, sin(angle / 2)}};
}

static void make_random_arm(uint64_t *s, arm *m) {
    uint32_t joints = 1 + random_below(s, LINKS);
    *m = (arm){.margin = random_below(s, 3) ? 0 : 0.02};
    m->boxes[0] = ovoid_shape_create_box((ovoid_vec3){0.3, 0.04, 0.05}, NULL, &error);
    m->boxes[1] = ovoid_shape_create_box((ovoid_vec3){0.05, 0.1, 0.2}, NULL, &error);
    for (uint32_t i = 0; i < joints; i++) {
        set_joint(m, i, random_below(s, 3) ? OVOID_JOINT_REVOLUTE : OVOID_JOINT_PRISMATIC, i ? 0.7 : 0);
        m->elements[i] = (ovoid_robot_element){i + 1, NULL, m->boxes[0], {{0.35, 0, 0}, {1, 0, 0, 0}}, NULL};
    }
    m->obstacle_count = 1 + random_below(s, OBSTACLES);
    for (size_t i = 0; i < m->obstacle_count; i++)
        m->obstacles[i] =
            (ovoid_body){.shape = m->boxes[1],
                         .pose = turned(random_uniform(s, -2, 2), random_uniform(s, -2, 2), random_uniform(s, -3, 3))};
    open_arm(m, joints);
    m->path = (ovoid_robot_path){m->q, 1 + random_below(s, STATES)};
    for (size_t i = 0; i < m->path.count * joints; i++) m->q[i] = random_uniform(s, -1.2, 1.2);
}

// ---- truth

static double find_distance(const arm *m, const ovoid_robot_side *a, const ovoid_robot_side *b, double at);

// The pose of the box on a link at s of the exact path.
static ovoid_pose place(const arm *m, uint32_t element, double at) {
    size_t count = ovoid_robot_get_variable_count(m->robot), segment = (size_t)at;
    if (segment + 2 > m->path.count) segment = m->path.count > 1 ? m->path.count - 2 : 0;
    const double *q0 = m->q + segment * count, *q1 = m->path.count > 1 ? q0 + count : q0;
    long double t = (long double)at - (long double)segment, x = 0, y = 0, angle = 0;
    for (uint32_t i = 0; i <= element; i++) {
        long double value = q0[i] + t * ((long double)q1[i] - q0[i]), length = m->joints[i].origin.position.x;
        if (m->joints[i].type == OVOID_JOINT_PRISMATIC) length += value;
        x += length * cosl(angle), y += length * sinl(angle);
        if (m->joints[i].type == OVOID_JOINT_REVOLUTE) angle += value;
    }
    ovoid_vec3 own = m->elements[element].pose.position;
    x += own.x * cosl(angle) - own.y * sinl(angle), y += own.x * sinl(angle) + own.y * cosl(angle);
    return (ovoid_pose){{(double)x, (double)y, own.z}, {(double)cosl(angle / 2), 0, 0, (double)sinl(angle / 2)}};
}

static ovoid_answer ask(const arm *m, const ovoid_robot_side *a, const ovoid_robot_side *b, double at) {
    ovoid_pair pair = {m->elements[a->element].shape, NULL, place(m, a->element, at), ovoid_pose_make_identity()};
    if (b->link == OVOID_ROBOT_NONE) {
        size_t i = 0;
        while (i + 1 < m->obstacle_count && m->ids[i] != b->body) i++;
        pair.shape_b = m->obstacles[i].shape, pair.pose_b = m->obstacles[i].pose;
    } else {
        pair.shape_b = m->elements[b->element].shape, pair.pose_b = place(m, b->element, at);
    }
    return ovoid_depth(&pair, NULL, NULL, NULL);
}

static double find_distance(const arm *m, const ovoid_robot_side *a, const ovoid_robot_side *b, double at) {
    return ask(m, a, b, at).upper;
}

static int is_pair_near(const arm *m, size_t pair, double at) {
    ovoid_robot_sides sides;
    if (ovoid_robot_cell_get_pair(m->cell, pair, &sides, NULL) != OVOID_OK) return 1;
    return find_distance(m, &sides.a, &sides.b, at) < m->margin - slack;
}

// A pair comes within the margin at a sampled place between two.
static int is_near_between(const arm *m, size_t pair, double from, double until) {
    for (int i = 0; i <= SAMPLES; i++)
        if (is_pair_near(m, pair, from + (until - from) * i / SAMPLES)) return 1;
    return 0;
}

static double get_last(const arm *m) { return m->path.count > 1 ? (double)(m->path.count - 1) : 1; }

static int step_is_false(const arm *m, const ovoid_robot_step *x) {
    if (!(x->begin >= 0 && x->end > x->begin && x->end <= get_last(m))) return 1;
    if (x->kind < 1 || x->kind > 4 || !x->mask || x->mask > 255) return 1;
    for (uint32_t k = 0; k < 8; k++)
        if ((x->mask >> k & 1) && is_near_between(m, x->pair + k, x->begin, x->end)) return 1;
    return 0;
}

static int hit_is_false(const arm *m, const ovoid_robot_path_answer *x) {
    ovoid_robot_sides sides;
    if (!(x->hit_at >= x->free_until && x->hit_at <= get_last(m))) return 1;
    for (size_t i = 0; i < ovoid_robot_cell_get_pair_count(m->cell); i++) {
        if (ovoid_robot_cell_get_pair(m->cell, i, &sides, NULL) != OVOID_OK) continue;
        ovoid_robot_side a = sides.a, b = sides.b;
        if (a.link != x->hit.a.link || a.element != x->hit.a.element || a.body != x->hit.a.body ||
            b.link != x->hit.b.link || b.element != x->hit.b.element || b.body != x->hit.b.body)
            continue;
        ovoid_answer is = ask(m, &a, &b, x->hit_at);
        return !(x->hit.lower <= is.upper + slack && x->hit.upper >= is.lower - slack &&
                 x->hit.upper <= m->margin + slack);
    }
    return 1;
}

static int answer_is_false(const arm *m, const ovoid_robot_path_answer *x) {
    double last = (double)(m->path.count - 1);
    if (x->status < OVOID_ROBOT_UNDECIDED || x->status >= OVOID_ROBOT_REFUSED) return 1;
    if (!(x->free_until >= 0 && x->free_until <= last)) return 1;
    if (x->status == OVOID_ROBOT_FREE && x->free_until < last) return 1;
    double until = x->status == OVOID_ROBOT_FREE ? last : x->free_until * (1 - 1e-15);
    for (size_t i = 0; i < ovoid_robot_cell_get_pair_count(m->cell); i++)
        if ((until > 0 || x->status == OVOID_ROBOT_FREE) && is_near_between(m, i, 0, until)) return 1;
    return x->status == OVOID_ROBOT_HIT && hit_is_false(m, x);
}

// ---- lies

static int is_refused(const arm *m, const ovoid_robot_path_answer *x, const ovoid_robot_step *with) {
    const ovoid_robot_path_options o = {.query = {.margin = m->margin}};
    return ovoid_robot_path_verify(m->cell, x, &(ovoid_robot_path_basis){{&m->path, &o}, with}, &error) != OVOID_OK;
}

#define OF_ANSWER(member, type, tolerance) ALTER_FIELD(ovoid_robot_path_answer, member, type, tolerance)
#define OF_STEP(member, type, tolerance) ALTER_FIELD(ovoid_robot_step, member, type, tolerance)

static const alter_field of_answer[] = {OF_ANSWER(status, ALTER_INT, 0),        OF_ANSWER(free_until, ALTER_REAL, 1e-6),
                                        OF_ANSWER(hit_at, ALTER_REAL, 1e-6),    OF_ANSWER(hit.lower, ALTER_REAL, 1e-9),
                                        OF_ANSWER(hit.upper, ALTER_REAL, 1e-9), OF_ANSWER(hit.a.link, ALTER_U32, 0),
                                        OF_ANSWER(hit.a.element, ALTER_U32, 0), OF_ANSWER(hit.b.link, ALTER_U32, 0),
                                        OF_ANSWER(hit.b.element, ALTER_U32, 0), OF_ANSWER(hit.b.body, ALTER_SIZE, 0)};
static const alter_field of_step[] = {OF_STEP(begin, ALTER_REAL, 1e-6),    OF_STEP(end, ALTER_REAL, 1e-6),
                                      OF_STEP(pair, ALTER_U32, 0),         OF_STEP(normal.x, ALTER_REAL, 1e-3),
                                      OF_STEP(normal.y, ALTER_REAL, 1e-3), OF_STEP(normal.z, ALTER_REAL, 1e-3)};
enum { ANSWER_FIELDS = sizeof of_answer / sizeof *of_answer, STEP_FIELDS = sizeof of_step / sizeof *of_step };
static alter_count answer_counts[ANSWER_FIELDS], step_counts[STEP_FIELDS], kind_counts;
static const alter_table answer_table = ALTER_TABLE(of_answer, answer_counts),
                         step_table = ALTER_TABLE(of_step, step_counts);

// The answer alone: its steps stay, so what is more than they prove is not proven.
static void lie_about_answer(const arm *m, const ovoid_robot_path_answer *x, const ovoid_robot_path_answer *other) {
    ovoid_robot_path_answer lie = *x;
    alter_walk w = alter_walk_make(&answer_table, &lie, sizeof lie, other);
    for (alter_count *n; (n = alter_next(&w));) alter_take(n, answer_is_false(m, &lie), is_refused(m, &lie, steps));
}

static void take_step_lie(const arm *m, const ovoid_robot_path_answer *x, size_t at, const ovoid_robot_step *lie,
                          alter_count *count) {
    ovoid_robot_step kept = steps[at];
    steps[at] = *lie;
    alter_take(count, step_is_false(m, lie), is_refused(m, x, steps));
    steps[at] = kept;
}

// One step, and one that says the same of a longer time: to the end of its segment, and to that of the path.
static void lie_about_step(const arm *m, const ovoid_robot_path_answer *x, size_t at) {
    const ovoid_robot_step *other = &steps[(at + 1) % x->step_count];
    ovoid_robot_step lie = steps[at];
    alter_walk w = alter_walk_make(&step_table, &lie, sizeof lie, other);
    for (alter_count *n; (n = alter_next(&w));) take_step_lie(m, x, at, &lie, n);
    alter_name = "kind, mask, longer", alter_way = "";
    for (unsigned kind = 0; kind < 6; kind++) {
        lie = steps[at], lie.kind = (uint16_t)kind;
        if (kind != steps[at].kind) take_step_lie(m, x, at, &lie, &kind_counts);
        lie = steps[at], lie.mask = (uint16_t)(kind < 5 ? lie.mask << kind | kind : 256);
        if (lie.mask != steps[at].mask) take_step_lie(m, x, at, &lie, &kind_counts);
        lie = steps[at], lie.kind = (uint16_t)(1 + kind % 3);
        if (kind > 2) lie.end = kind == 3 ? floor(lie.begin) + 1 : get_last(m);
        if (kind > 2) take_step_lie(m, x, at, &lie, &kind_counts);
    }
}

static void test_random(uint64_t seed, int cases) {
    uint64_t s = seed;
    for (int i = 0; i < cases; i++) {
        arm m;
        ovoid_robot_path_answer x, other = {.status = OVOID_ROBOT_FREE};
        check_seed = (uint64_t)i;
        make_random_arm(&s, &m);
        ovoid_robot_path_options o = {
            .query = {.margin = m.margin}, .states = 400, .steps = steps, .capacity = STEPS, .any_hit = i % 4 == 0};
        CHECK_EQ(ovoid_robot_path_find_hit(m.checker, &(ovoid_robot_path_query){&m.path, &o}, &x, &error), OVOID_OK);
        if (x.step_count < STEPS && x.status < OVOID_ROBOT_REFUSED) {
            CHECK(!answer_is_false(&m, &x) && !is_refused(&m, &x, steps));
            ovoid_robot_path_options again = o;
            again.any_hit = !o.any_hit, again.steps = other_steps;
            (void)ovoid_robot_path_find_hit(m.checker, &(ovoid_robot_path_query){&m.path, &again}, &other, &error);
            lie_about_answer(&m, &x, &other);
            for (int k = 0; k < 6 && x.step_count; k++) lie_about_step(&m, &x, random_next(&s) % x.step_count);
        }
        close_arm(&m);
    }
    check_seed = 0;
}

// ---- forgeries

static ovoid_robot_path_answer make_free(const arm *m, size_t count) {
    return (ovoid_robot_path_answer){
        .status = OVOID_ROBOT_FREE, .free_until = (double)(m->path.count - 1), .hit_at = INFINITY, .step_count = count};
}

// An arm of one joint, its box at `out`, and a wall whose near side is at x = `wall`.
static void make_simple(arm *m, ovoid_joint_type type, double out, double wall) {
    *m = (arm){.obstacle_count = 1};
    m->boxes[0] = ovoid_shape_create_box((ovoid_vec3){0.001, 0.001, 0.001}, NULL, &error);
    m->boxes[1] = ovoid_shape_create_box((ovoid_vec3){0.1, 5, 5}, NULL, &error);
    set_joint(m, 0, type, 0);
    m->elements[0] = (ovoid_robot_element){1, NULL, m->boxes[0], {{out, 0, 0}, {1, 0, 0, 0}}, NULL};
    m->obstacles[0] = (ovoid_body){.shape = m->boxes[1], .pose = turned(wall + 0.1, 0, 0)};
    open_arm(m, 1);
    m->path.states = m->q;
}

// One forged step of a pair that is hit on the way: refused, for each kind.
static void check_forged(const arm *m, double begin, double end) {
    CHECK(is_near_between(m, 0, 0, get_last(m)));
    for (uint16_t kind = 1; kind <= 4; kind++) {
        ovoid_robot_step lie = {begin, end, 0, kind, 1, {0, 0, 0}};
        if (kind == OVOID_ROBOT_STEP_MIDDLE || kind == OVOID_ROBOT_STEP_ENDS) lie.normal.x = 1;
        ovoid_robot_path_answer x = make_free(m, 1);
        if (!CHECK(is_refused(m, &x, &lie))) printf("  kind %u, %g .. %g\n", kind, begin, end);
    }
}

// Steps that are true, and leave out the time in which the wall is passed: between them, or after the last one.
static void test_gaps(uint64_t seed, int cases) {
    uint64_t s = seed;
    for (int i = 0; i < cases; i++) {
        arm m;
        make_simple(&m, OVOID_JOINT_PRISMATIC, 0, random_uniform(&s, -0.1, 0.1));
        m.path.count = 2, m.q[0] = -2, m.q[1] = 2.2;
        double before = random_uniform(&s, 0.1, 0.44), after = random_uniform(&s, 0.6, 0.7);
        const ovoid_robot_step around[] = {{0, before, 0, OVOID_ROBOT_STEP_MIDDLE, 1, {1, 0, 0}},
                                           {after, 1, 0, OVOID_ROBOT_STEP_MIDDLE, 1, {-1, 0, 0}}};
        for (size_t k = 0; k < 2; k++) CHECK(!step_is_false(&m, &around[k]));
        ovoid_robot_path_answer x = make_free(&m, 2);
        CHECK(answer_is_false(&m, &x) && is_refused(&m, &x, around));
        x.step_count = 1;
        CHECK(is_refused(&m, &x, around) && is_refused(&m, &x, around + 1));
        x.status = OVOID_ROBOT_UNDECIDED, x.free_until = before;
        CHECK(!is_refused(&m, &x, around));
        x.free_until = nextafter(before, 1);
        CHECK(is_refused(&m, &x, around));
        close_arm(&m);
    }
}

static void test_forged(uint64_t seed, int cases) {
    uint64_t s = seed;
    for (int i = 0; i < cases; i++) {
        arm m;
        // Away from the wall, and back into it: with the first segment's motion the second one would be free.
        double wall = random_uniform(&s, 0.1, 2), away = random_uniform(&s, 0.1, 5);
        make_simple(&m, OVOID_JOINT_PRISMATIC, 0, wall);
        m.path.count = 3, m.q[0] = 0, m.q[1] = -away, m.q[2] = wall + 0.1;
        check_forged(&m, 0, 2);
        check_forged(&m, 0.5, 1.5);
        // Farther than the room in the middle of the interval, by little or much.
        m.path.count = 2, m.q[0] = -away, m.q[1] = wall + random_uniform(&s, 0, 0.2);
        check_forged(&m, 0, 1);
        // A state in the wall, and nothing said of it.
        m.path.count = 1, m.q[0] = wall + random_uniform(&s, 0, 0.2);
        ovoid_robot_path_answer none = make_free(&m, 0);
        CHECK(is_refused(&m, &none, NULL));
        check_forged(&m, 0, 1);
        close_arm(&m);
        // An arc whose ends have room, and whose middle is in the wall by a part of the sagitta.
        double angle = random_uniform(&s, 0.01, 0.8), sagitta = 1 - cos(angle);
        make_simple(&m, OVOID_JOINT_REVOLUTE, 1, 1.001 - sagitta * random_uniform(&s, 0.05, 0.9));
        m.path.count = 2, m.q[0] = -angle, m.q[1] = angle;
        check_forged(&m, 0, 1);
        close_arm(&m);
    }
}

// test_robot_path_altered [SEED] [CASES]: more arms for longer.
int main(int argc, char **argv) {
    uint64_t seed = 1, cases = CASES;
    const test_option options[] = {{"seed", "of the arms (1)", &seed, NULL, NULL, NULL},
                                   {"cases", "how many arms (40)", &cases, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, argc, argv);
    if (code >= 0) return code;
    test_forged(seed, (int)cases);
    test_gaps(seed, (int)cases);
    test_random(seed, (int)cases);
    alter_print_table(&answer_table);
    alter_print_table(&step_table);
    alter_print("kind, mask, longer", &kind_counts);
    return check_end();
}
