// Files of path proofs before the check: what is read is followed nowhere out of bounds, and what the check accepts on
// a known robot is true. Truth: an arm of one hinge with a ball, 1 from the axis, among two walls that it meets at
// angles which are known in closed form.
#include "robot.h"

#include <ovoid/robot_proof.h>

#include <math.h>

static ovoid_robot_cell *cell;

// A ball of radius 0.1 at 1 from a hinge; walls, boxes of half size 0.2, stand at angles of 1.5 and -2 at the same
// distance, so that balls at angles of magnitude up to 1 are apart from them.
static void make_cell(void) {
    ovoid_shape *ball = ovoid_shape_create_sphere(0.1, NULL, NULL);
    ovoid_shape *wall = ovoid_shape_create_box((ovoid_vec3){0.2, 0.2, 0.2}, NULL, NULL);
    static const ovoid_robot_link links[2] = {{"base"}, {"arm"}};
    static const ovoid_robot_joint joint = {
        "hinge", OVOID_JOINT_REVOLUTE, 0, 1, {{0, 0, 0}, {1, 0, 0, 0}}, {0, 0, 1}, -3, 3, 0, OVOID_ROBOT_NONE, 1, 0};
    const ovoid_robot_element element = {1, NULL, ball, {{1, 0, 0}, {1, 0, 0, 0}}, NULL};
    const ovoid_robot_description d = {
        .links = links, .link_count = 2, .joints = &joint, .joint_count = 1, .elements = &element, .element_count = 1};
    ovoid_robot *robot = ovoid_robot_create(&d, NULL, NULL);
    cell = robot ? ovoid_robot_cell_create(robot, NULL, NULL) : NULL;
    fuzz_require(cell != NULL);
    static const double angles[2] = {1.5, -2};
    for (int i = 0; i < 2; i++) {
        double a = angles[i];
        const ovoid_body body = {.shape = wall, .pose = {{cos(a), sin(a), 0}, {cos(a / 2), 0, 0, sin(a / 2)}}};
        fuzz_require(ovoid_robot_cell_add(cell, &body, NULL) != 0);
    }
}

// The ball's centre and a wall's, whose near corners reach 0.29 and more: nearer than 0.3 + 0.1 is not sure to touch,
// nearer than 0.2 does.
static int is_inside(double angle) {
    double a = 2 * sin(0.5 * fabs(angle - 1.5)), b = 2 * sin(0.5 * fabs(angle + 2));
    return fmin(fabs(a), fabs(b)) < 0.2;
}
static int is_apart(double angle, double margin) {
    double a = 2 * sin(0.5 * fabs(angle - 1.5)), b = 2 * sin(0.5 * fabs(angle + 2));
    return fmin(fabs(a), fabs(b)) > 0.2 * sqrt(3) + 0.1 + margin + 1e-9;
}

static double get_angle(const ovoid_robot_proof *p, double s) {
    size_t i = (size_t)s;
    if (i + 1 >= p->count) return p->states[p->count - 1];
    return p->states[i] + (s - (double)i) * (p->states[i + 1] - p->states[i]);
}

static void check_claim(const ovoid_robot_proof *p, const ovoid_robot_proof_source *source) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_robot_path_answer answer = p->answer;
    const ovoid_robot_path path = {p->states, p->count};
    const ovoid_robot_path_options o = {.query = {.margin = source->margin, .limit_slack = source->limit_slack}};
    if (source->variable_count != 1) return;
    ovoid_robot_sides sides = {answer.hit.a, answer.hit.b};
    if (p->has_pair && ovoid_robot_cell_get_pair(cell, p->pair, &sides, &error) != OVOID_OK) return;
    answer.hit.a = sides.a;
    answer.hit.b = sides.b;
    if (ovoid_robot_path_verify(cell, &answer, &(ovoid_robot_path_basis){{&path, &o}, p->steps}, &error) != OVOID_OK) {
        fuzz_require_error(&error);
        return;
    }
    for (int i = 0; i < 200; i++) fuzz_require(!is_inside(get_angle(p, answer.free_until * i / 200)));
    if (answer.status == OVOID_ROBOT_FREE) fuzz_require(answer.free_until == (double)(p->count - 1));
    if (answer.status == OVOID_ROBOT_HIT) fuzz_require(!is_apart(get_angle(p, answer.hit_at), source->margin));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (!cell) make_cell();
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_robot_proofs_reader *proofs =
        ovoid_robot_proofs_reader_open(fuzz_write_file("proofs.jsonl", data, size), &error);
    if (!proofs) {
        fuzz_require_error(&error);
        return 0;
    }
    ovoid_robot_proof p;
    int got;
    while ((got = ovoid_robot_proofs_reader_read(proofs, &p, &error)) > 0) {
        const ovoid_robot_proof_source *source = ovoid_robot_proofs_reader_get_source(proofs);
        fuzz_require(source != NULL && source->robot != NULL && p.number < source->path_count && p.count > 0);
        for (size_t i = 0; i < 2 * source->pair_count; i++)
            fuzz_require(!source->pairs[i].link == (source->pairs[i].obstacle != NULL));
        for (size_t i = 0; i < p.count * source->variable_count; i++) fuzz_require(isfinite(p.states[i]));
        for (size_t i = 0; i < p.answer.step_count; i++) fuzz_require(p.steps[i].mask != 0 && p.steps[i].mask < 256);
        fuzz_require(p.line > 0 && ovoid_robot_proofs_reader_get_line(proofs) == p.line + (int64_t)p.answer.step_count);
        check_claim(&p, source);
    }
    if (got < 0) fuzz_require_error(&error);
    ovoid_robot_proofs_reader_close(proofs);
    return 0;
}
