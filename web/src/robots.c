// Robots: made from flat arrays, where their links are, what is near.
#include "ovoid/robot.h"
#include "src/exchange.h"

#include <stdlib.h>

/// Numbers of a joint: type, parent, child, origin, axis, lower, upper, velocity, mimicked joint (-1: none),
/// multiplier, offset.
enum { JOINT = 19 };
/// Numbers of an element beside its shape: the link, the pose.
enum { ELEMENT = 8 };

static void read_joint(const double *from, const char *name, ovoid_robot_joint *j) {
    *j = (ovoid_robot_joint){.name = name, .type = (ovoid_joint_type)(int)from[0]};
    j->parent = read_index(from[1]);
    j->child = read_index(from[2]);
    from = read_vec3(read_pose(from + 3, &j->origin), &j->axis);
    j->lower = from[0], j->upper = from[1], j->velocity = from[2];
    j->mimic = from[3] < 0 ? OVOID_ROBOT_NONE : read_index(from[3]);
    j->multiplier = from[4], j->offset = from[5];
}

// The next of the names, which end with a zero each.
static const char *take_name(const char **names) {
    const char *name = *names;
    while (**names) ++*names;
    ++*names;
    return name;
}

typedef struct model {
    ovoid_robot_link *links;
    ovoid_robot_joint *joints;
    ovoid_robot_element *elements;
    ovoid_robot_pair *disabled;
} model;

/// counts: links, joints, elements, disabled pairs. names: of all links, then of all joints. shapes: of each element
/// the shape, then the solid or 0.
ovoid_robot *EXPORT(robot_create)(const uint32_t counts[4], const char *names, const double *joints,
                                  const double *elements, void *const *shapes, const uint32_t *disabled) {
    model m = {calloc(counts[0] + 1, sizeof *m.links), calloc(counts[1] + 1, sizeof *m.joints),
               calloc(counts[2] + 1, sizeof *m.elements), calloc(counts[3] + 1, sizeof *m.disabled)};
    ovoid_robot *robot = NULL;
    if (m.links && m.joints && m.elements && m.disabled) {
        for (uint32_t i = 0; i < counts[0]; i++) m.links[i].name = take_name(&names);
        for (uint32_t i = 0; i < counts[1]; i++) read_joint(joints + JOINT * i, take_name(&names), &m.joints[i]);
        for (uint32_t i = 0; i < counts[2]; i++) {
            m.elements[i] = (ovoid_robot_element){
                .link = read_index(elements[ELEMENT * i]), .shape = shapes[2 * i], .solid = shapes[2 * i + 1]};
            read_pose(elements + ELEMENT * i + 1, &m.elements[i].pose);
        }
        for (uint32_t i = 0; i < counts[3]; i++)
            m.disabled[i] = (ovoid_robot_pair){.a = disabled[2 * i], .b = disabled[2 * i + 1]};
        ovoid_robot_description d = {.links = m.links,
                                     .link_count = counts[0],
                                     .joints = m.joints,
                                     .joint_count = counts[1],
                                     .elements = m.elements,
                                     .element_count = counts[2],
                                     .disabled = m.disabled,
                                     .disabled_count = counts[3]};
        robot = ovoid_robot_create(&d, NULL, &exchange_error);
    } else
        exchange_error = (ovoid_error){OVOID_ERROR_MEMORY, -1, "out of memory"};
    free(m.links);
    free(m.joints);
    free(m.elements);
    free(m.disabled);
    return robot;
}
void EXPORT(robot_destroy)(ovoid_robot *robot) { ovoid_robot_destroy(robot); }
size_t EXPORT(robot_get_variable_count)(const ovoid_robot *robot) { return ovoid_robot_get_variable_count(robot); }

/// Seven numbers a link. 0, or the error's code.
int EXPORT(robot_compute_poses)(const ovoid_robot *robot, const double *q, double *out) {
    size_t count = ovoid_robot_get_description(robot).link_count;
    ovoid_pose *poses = calloc(count, sizeof *poses);
    if (!poses) return OVOID_ERROR_MEMORY;
    int code = (int)ovoid_robot_compute_poses(robot, q, poses, &exchange_error);
    for (size_t i = 0; !code && i < count; i++) out = write_pose(out, &poses[i]);
    free(poses);
    return code;
}

// ---- cells

ovoid_robot_cell *EXPORT(cell_create)(const ovoid_robot *robot) {
    return ovoid_robot_cell_create(robot, NULL, &exchange_error);
}
void EXPORT(cell_destroy)(ovoid_robot_cell *cell) { ovoid_robot_cell_destroy(cell); }

/// Reads the pose. The obstacle's id, 0 on failure. kind: of the body, as read_body has it.
double EXPORT(cell_add)(ovoid_robot_cell *cell, unsigned kind, const void *body) {
    ovoid_body obstacle;
    read_body(exchange, kind, body, &obstacle);
    return (double)ovoid_robot_cell_add(cell, &obstacle, &exchange_error);
}
/// Reads the pose in the link's frame. The body's id, 0 on failure; touching: links that it may touch.
double EXPORT(cell_attach)(ovoid_robot_cell *cell, uint32_t link, unsigned kind, const void *body,
                           const uint32_t *touching, size_t count) {
    ovoid_body held;
    read_body(exchange, kind, body, &held);
    return (double)ovoid_robot_cell_attach(cell, &(ovoid_robot_attachment){link, held, touching, count},
                                           &exchange_error);
}
int EXPORT(cell_set_allowed)(ovoid_robot_cell *cell, uint32_t a, uint32_t b, int allowed) {
    return (int)(allowed ? ovoid_robot_cell_add_allowed(cell, a, b, &exchange_error)
                         : ovoid_robot_cell_remove_allowed(cell, a, b, &exchange_error));
}
int EXPORT(cell_set_body_allowed)(ovoid_robot_cell *cell, double id, uint32_t link, int allowed) {
    return (int)(allowed ? ovoid_robot_cell_add_body_allowed(cell, (ovoid_id)id, link, &exchange_error)
                         : ovoid_robot_cell_remove_body_allowed(cell, (ovoid_id)id, link, &exchange_error));
}
int EXPORT(cell_set_padding)(ovoid_robot_cell *cell, uint32_t link, double padding) {
    return (int)ovoid_robot_cell_set_padding(cell, link, padding, &exchange_error);
}
int EXPORT(cell_move)(ovoid_robot_cell *cell, double id) {
    ovoid_pose pose;
    read_pose(exchange, &pose);
    return (int)ovoid_robot_cell_move(cell, (ovoid_id)id, &pose, &exchange_error);
}
int EXPORT(cell_remove)(ovoid_robot_cell *cell, double id) {
    return (int)ovoid_robot_cell_remove(cell, (ovoid_id)id, &exchange_error);
}

ovoid_robot_checker *EXPORT(checker_create)(const ovoid_robot_cell *cell) {
    return ovoid_robot_checker_create(cell, NULL, &exchange_error);
}
void EXPORT(checker_destroy)(ovoid_robot_checker *checker) { ovoid_robot_checker_destroy(checker); }

const char *EXPORT(get_code_name)(int code) { return ovoid_code_get_name((ovoid_code)code); }

// Links and obstacles as numbers; -1: none.
static double *write_side(double *to, const ovoid_robot_side *s) {
    *to++ = s->link == OVOID_ROBOT_NONE ? -1 : (double)s->link;
    *to++ = s->element == OVOID_ROBOT_NONE ? -1 : (double)s->element;
    *to++ = (double)s->body, *to++ = s->part;
    return to;
}

/// Reads the margin and the slack of the limits. Writes status, code, variable, whether there is a pair, both sides,
/// lower, upper. 0, or the error's code. Each state is asked as if it were the first one.
int EXPORT(checker_collide)(ovoid_robot_checker *checker, const double *q) {
    ovoid_robot_query_options options = {.margin = exchange[0], .limit_slack = exchange[1]};
    ovoid_robot_answer a;
    ovoid_robot_checker_reset(checker);
    int code = (int)ovoid_robot_collide(checker, &(ovoid_robot_query){q, &options}, &a, &exchange_error);
    double *to = exchange;
    *to++ = a.status, *to++ = a.code, *to++ = a.variable;
    *to++ = a.status == OVOID_ROBOT_HIT || (a.status == OVOID_ROBOT_UNDECIDED && a.code != OVOID_ERROR_EMPTY);
    to = write_side(write_side(to, &a.a), &a.b);
    *to++ = a.lower, *to++ = a.upper;
    return code;
}

/// Near pairs, 20 numbers each: both sides, status, lower, upper, points, normal; nearest first. Reads the margin
/// and the slack of the limits; writes how many there are. 0, or the error's code.
int EXPORT(checker_find_near)(ovoid_robot_checker *checker, const double *q, double *out, size_t capacity) {
    ovoid_robot_query_options options = {.margin = exchange[0], .limit_slack = exchange[1]};
    ovoid_robot_nears nears = {.items = calloc(capacity + 1, sizeof(ovoid_robot_near)), .capacity = capacity};
    if (!nears.items) return OVOID_ERROR_MEMORY;
    int code = (int)ovoid_robot_find_near(checker, &(ovoid_robot_query){q, &options}, &nears, &exchange_error);
    exchange[0] = code ? 0 : (double)nears.count;
    for (size_t i = 0; !code && i < nears.count && i < capacity; i++) {
        const ovoid_robot_near *n = &nears.items[i];
        out = write_side(write_side(out, &n->a), &n->b);
        *out++ = n->status, *out++ = n->lower, *out++ = n->upper;
        out = write_vec3(write_vec3(write_vec3(out, n->point_a), n->point_b), n->normal);
    }
    free(nears.items);
    return code;
}
