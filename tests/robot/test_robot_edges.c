// Edges in batches, and paths of many short segments, which covers prove several side by side. Truth: the search of
// each edge alone with its steps verified, and hits by ovoid_robot_path_verify. Batches give the same bits on any
// number of threads and whatever was asked before.
#include "check.h"
#include "options.h"
#include "path_machines.h"
#include "patience.h"

#include "ovoid/robot_path.h"

enum { MACHINES = 60, EDGES = 300, OBSTACLES = 5, STEPS = 1 << 16, NUMBERS = 3 * JOINTS };

typedef struct scene {
    machine m;
    ovoid_robot_checker *checkers[3];
    size_t variables;
    double states[2 * EDGES * NUMBERS];
    ovoid_robot_path_answer answers[EDGES];
} scene;

static ovoid_robot_step steps[STEPS];
static long frees, hits, undecided, covered;

// Obstacles around it; of a chain of boxes that touch their neighbours nothing would be free.
static void open_scene(uint64_t *s, scene *c) {
    make_machine(s, &c->m);
    for (int k = 0; k < OBSTACLES; k++) {
        ovoid_body body = {.shape = c->m.shapes[k % 3], .pose = random_pose(s, 2.5 * c->m.scale)};
        if (random_below(s, 2)) body.pose.rotation = (ovoid_quat){1, 0, 0, 0};
        CHECK(ovoid_robot_cell_add(c->m.cell, &body, &error) != 0);
    }
    for (uint32_t a = 0; a < c->m.cell->robot->link_count; a++)
        for (uint32_t b = a + 1; b < c->m.cell->robot->link_count; b++)
            if (random_below(s, 4)) (void)ovoid_robot_cell_add_allowed(c->m.cell, a, b, &error);
    for (int k = 0; k < 3; k++) c->checkers[k] = ovoid_robot_checker_create(c->m.cell, NULL, &error);
    c->variables = ovoid_robot_get_variable_count(c->m.r);
}

static void close_scene(scene *c) {
    for (int k = 0; k < 3; k++) ovoid_robot_checker_destroy(c->checkers[k]);
    destroy_machine(&c->m);
}

// Edges of many lengths, from states along the machine's own segment.
static void make_edges(uint64_t *s, scene *c, size_t count) {
    for (size_t i = 0; i < count; i++) {
        double *q0 = c->states + 2 * i * c->variables, *q1 = q0 + c->variables, t = random_uniform(s, 0, 1);
        double share = pow(0.5, random_below(s, 9));
        for (size_t v = 0; v < c->variables; v++) {
            double change = c->m.q[1][v] - c->m.q[0][v];
            q0[v] = c->m.q[0][v] + t * change;
            q1[v] = q0[v] + share * random_uniform(s, -1, 1) * change;
        }
    }
}

static ovoid_robot_path_options make_options(double margin) {
    return (ovoid_robot_path_options){
        .query = {.margin = margin, .limit_slack = INFINITY}, .states = 5000, .any_hit = 1};
}

static ovoid_code ask(scene *c, size_t threads, size_t count, const ovoid_robot_path_options *o) {
    const ovoid_robot_edge_batch batch = {c->states, count, o, c->answers};
    return ovoid_robot_path_find_hit_batch(c->checkers, threads, &batch, &error);
}

// The answer to an edge or a path, beside that of a search whose steps are verified.
static void compare(const scene *c, const ovoid_robot_path *path, const ovoid_robot_path_options *o,
                    const ovoid_robot_path_answer *is) {
    ovoid_robot_path_options known = *o;
    known.steps = steps, known.capacity = STEPS, known.any_hit = 0;
    ovoid_robot_path_answer truth;
    CHECK_EQ(ovoid_robot_path_find_hit(c->checkers[2], &(ovoid_robot_path_query){path, &known}, &truth, &error),
             OVOID_OK);
    if (truth.step_count <= STEPS)
        CHECK_EQ(ovoid_robot_path_verify(c->m.cell, &truth, &(ovoid_robot_path_basis){{path, &known}, steps}, &error),
                 OVOID_OK);
    frees += is->status == OVOID_ROBOT_FREE, hits += is->status == OVOID_ROBOT_HIT;
    covered += is->status == OVOID_ROBOT_FREE && is->states == 0;
    undecided += is->status == OVOID_ROBOT_UNDECIDED || truth.status == OVOID_ROBOT_UNDECIDED;
    CHECK_EQ(is->step_count, 0u);
    if (is->status == OVOID_ROBOT_UNDECIDED || truth.status == OVOID_ROBOT_UNDECIDED) return;
    CHECK_EQ(is->status, truth.status);
    if (is->status == OVOID_ROBOT_FREE) CHECK(is->free_until == (double)(path->count - 1) && is->hit_at == INFINITY);
    if (is->status != OVOID_ROBOT_HIT) return;
    CHECK(is->hit_at >= truth.free_until && is->free_until <= is->hit_at && is->hit.upper <= o->query.margin);
    // What was free before it is without steps; the hit itself is shown.
    ovoid_robot_path_answer alone = *is;
    alone.free_until = 0;
    ovoid_code code = ovoid_robot_path_verify(c->m.cell, &alone, &(ovoid_robot_path_basis){{path, o}, NULL}, &error);
    if (!CHECK_EQ(code, OVOID_OK)) printf("  %s\n", error.message);
}

static void test_verdicts(int rounds) {
    static scene c;
    uint64_t s = 11;
    for (int i = 0; i < MACHINES * rounds; i++) {
        check_seed = (uint64_t)i;
        open_scene(&s, &c);
        enum { COUNT = 40 };
        make_edges(&s, &c, COUNT);
        const ovoid_robot_path_options o = make_options(random_below(&s, 3) ? 0 : 0.05 * c.m.scale);
        CHECK_EQ(ask(&c, 1, COUNT, &o), OVOID_OK);
        for (size_t k = 0; k < COUNT; k++)
            compare(&c, &(const ovoid_robot_path){c.states + 2 * k * c.variables, 2}, &o, &c.answers[k]);
        close_scene(&c);
    }
    check_seed = 0;
    printf("%ld free, %ld of them by covers alone, %ld hit, %ld undecided\n", frees, covered, hits, undecided);
    CHECK(frees > 1000 * rounds && hits > 150 * rounds && 10 * covered > 9 * frees);
}

// Paths that wander in short segments.
static void test_paths(int rounds) {
    enum { SEGMENTS = 12 };
    static scene c;
    uint64_t s = 29;
    frees = hits = undecided = covered = 0;
    for (int i = 0; i < 4 * MACHINES * rounds; i++) {
        check_seed = (uint64_t)i;
        open_scene(&s, &c);
        double share = pow(0.5, 2 + random_below(&s, 5));
        for (size_t v = 0; v < c.variables; v++) {
            c.states[v] = c.m.q[0][v];
            for (size_t k = 1; k <= SEGMENTS; k++)
                c.states[k * c.variables + v] = c.states[(k - 1) * c.variables + v] +
                                                share * random_uniform(&s, -1, 1) * (c.m.q[1][v] - c.m.q[0][v]);
        }
        const ovoid_robot_path path = {c.states, SEGMENTS + 1};
        const ovoid_robot_path_options o = make_options(0);
        ovoid_robot_path_answer is;
        CHECK_EQ(ovoid_robot_path_find_hit(c.checkers[0], &(ovoid_robot_path_query){&path, &o}, &is, &error), OVOID_OK);
        compare(&c, &path, &o, &is);
        close_scene(&c);
    }
    check_seed = 0;
    printf("paths: %ld free, %ld of them by covers alone, %ld hit, %ld undecided\n", frees, covered, hits, undecided);
    CHECK(frees > 100 * rounds && hits > 20 * rounds && 2 * covered > frees);
}

static int are_sides_equal(const ovoid_robot_side *a, const ovoid_robot_side *b) {
    return a->link == b->link && a->element == b->element && a->body == b->body && a->part == b->part;
}

static int are_equal(const ovoid_robot_path_answer *a, const ovoid_robot_path_answer *b) {
    return a->status == b->status && a->free_until == b->free_until && a->hit_at == b->hit_at &&
           a->refused == b->refused && a->states == b->states && a->step_count == b->step_count &&
           a->hit.status == b->hit.status && a->hit.code == b->hit.code && a->hit.lower == b->hit.lower &&
           a->hit.upper == b->hit.upper && are_sides_equal(&a->hit.a, &b->hit.a) &&
           are_sides_equal(&a->hit.b, &b->hit.b);
}

// On one to three threads, by checkers that were asked other things before; with and without any_hit.
static void test_threads(void) {
    static scene c;
    static ovoid_robot_path_answer first[EDGES];
    uint64_t s = 5;
    for (int i = 0; i < 6; i++) {
        check_seed = (uint64_t)i;
        open_scene(&s, &c);
        make_edges(&s, &c, EDGES);
        ovoid_robot_path_options o = make_options(0);
        o.any_hit = i % 3 != 0;
        for (size_t threads = 1; threads <= 3; threads++) {
            memset(c.answers, 0, sizeof c.answers);
            CHECK_EQ(ask(&c, threads, EDGES, &o), OVOID_OK);
            if (threads == 1) memcpy(first, c.answers, sizeof first);
            for (int k = 0; k < EDGES; k++) CHECK(are_equal(&first[k], &c.answers[k]));
            // Edges in another order, which the checkers are to forget.
            const ovoid_robot_path other = {c.states + 2 * (EDGES / 2) * c.variables, 2};
            for (size_t k = 0; k < threads; k++)
                CHECK_EQ(ovoid_robot_path_find_hit(c.checkers[k], &(ovoid_robot_path_query){&other, &o}, &c.answers[0],
                                                   &error),
                         OVOID_OK);
        }
        close_scene(&c);
    }
    check_seed = 0;
}

// What is refused is the edge's alone; what is wrong with the question is said, and nothing is answered.
static void test_refused(void) {
    static scene c;
    uint64_t s = 17;
    do {
        if (c.variables) close_scene(&c);
        open_scene(&s, &c);
    } while (c.variables < 2);
    make_edges(&s, &c, 20);
    const ovoid_robot_path_options o = make_options(0);
    CHECK_EQ(ask(&c, 1, 20, &o), OVOID_OK);
    static ovoid_robot_path_answer whole[20];
    memcpy(whole, c.answers, sizeof whole);
    for (int k = 0; k < 20; k += 3) c.states[(2 * k + 1) * (int)c.variables + 1] = k % 2 ? NAN : INFINITY;
    CHECK_EQ(ask(&c, 1, 20, &o), OVOID_OK);
    for (int k = 0; k < 20; k++) {
        const ovoid_robot_path_answer *a = &c.answers[k];
        if (k % 3 == 0)
            CHECK(a->status == OVOID_ROBOT_REFUSED && a->refused == 0 && a->hit.code != OVOID_OK &&
                  a->hit.variable == 1);
        else
            CHECK_EQ(a->status, whole[k].status);
    }
    ovoid_robot_path_options bad = o;
    bad.steps = steps, bad.capacity = STEPS;
    CHECK_EQ(ask(&c, 1, 20, &bad), OVOID_ERROR_ARGUMENT);
    CHECK(strstr(error.message, "steps") && c.answers[1].status == OVOID_ROBOT_UNDECIDED);
    bad = o, bad.tolerance = -1;
    CHECK_EQ(ask(&c, 1, 20, &bad), OVOID_ERROR_ARGUMENT);
    bad = o, bad.query.margin = NAN;
    CHECK_EQ(ask(&c, 1, 20, &bad), OVOID_ERROR_ARGUMENT);
    CHECK_EQ(ask(&c, 0, 20, &o), OVOID_ERROR_ARGUMENT);
    CHECK_EQ(ask(&c, 1, 0, NULL), OVOID_OK);
    close_scene(&c);
}

// How often an edge that covers alone prove asks whether to go on: before its first block, and before each more.
static size_t count_questions(scene *c, size_t edge) {
    patience p;
    ovoid_robot_path_options o = make_options(0);
    o.watch = make_watch(&p, SIZE_MAX);
    const ovoid_robot_path path = {c->states + 2 * edge * c->variables, 2};
    ovoid_robot_path_answer answer;
    CHECK_EQ(ovoid_robot_path_find_hit(c->checkers[1], &(ovoid_robot_path_query){&path, &o}, &answer, &error),
             OVOID_OK);
    return answer.status == OVOID_ROBOT_FREE && answer.states == 0 ? p.asked : 0;
}

// A host that stops the batch at the k-th question: what is decided is as in the whole.
static void test_watch(void) {
    static scene c;
    static ovoid_robot_path_answer whole[40];
    uint64_t s = 23;
    long stopped = 0, closer = 0;
    for (int i = 0; i < 12; i++) {
        check_seed = (uint64_t)i;
        open_scene(&s, &c);
        make_edges(&s, &c, 40);
        ovoid_robot_path_options o = make_options(0);
        CHECK_EQ(ask(&c, 1, 40, &o), OVOID_OK);
        memcpy(whole, c.answers, sizeof whole);
        for (size_t most = 0; most < 60; most += 1 + most / 4) {
            patience p;
            o.watch = make_watch(&p, most);
            CHECK_EQ(ask(&c, 1, 40, &o), OVOID_OK);
            for (int k = 0; k < 40; k++) {
                stopped += c.answers[k].status == OVOID_ROBOT_UNDECIDED && whole[k].status != OVOID_ROBOT_UNDECIDED;
                if (c.answers[k].status != OVOID_ROBOT_UNDECIDED) CHECK_EQ(c.answers[k].status, whole[k].status);
            }
        }
        for (size_t k = 0; k < 40; k++) closer += count_questions(&c, k) > 1;
        close_scene(&c);
    }
    check_seed = 0;
    CHECK(stopped > 500 && closer > 10);
}

int main(int argc, char **argv) {
    uint64_t wanted = 1;
    const test_option options[] = {{"rounds", "how many (1)", &wanted, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, argc, argv);
    if (code >= 0) return code;
    test_verdicts((int)wanted);
    test_paths((int)wanted);
    test_threads();
    test_refused();
    test_watch();
    return check_end();
}
