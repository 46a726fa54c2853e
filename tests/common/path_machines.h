// Robots that are made to break bounds of motions, and their kinematics in long double, straight from the description:
// long thin links, wrists that turn many times, hinges one above the other, slides, planar bases, mimics with factors,
// at three scales; all elements are boxes.
#ifndef OVOID_TESTS_PATH_MACHINES_H
#define OVOID_TESTS_PATH_MACHINES_H

#include "check.h"
#include "robots.h"

#include "robot/path/motion.h"

#include <math.h>

enum { JOINTS = 8, VERTICES = 8 };
typedef long double real;
typedef struct real3 {
    real x, y, z;
} real3;
typedef struct frame {
    real m[3][3];
    real3 p;
} frame;

static ovoid_error error;

// ---- kinematics in long double

static inline frame multiply(const frame *a, const frame *b) {
    frame c;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            c.m[i][k] = a->m[i][0] * b->m[0][k] + a->m[i][1] * b->m[1][k] + a->m[i][2] * b->m[2][k];
    c.p = (real3){a->m[0][0] * b->p.x + a->m[0][1] * b->p.y + a->m[0][2] * b->p.z + a->p.x,
                  a->m[1][0] * b->p.x + a->m[1][1] * b->p.y + a->m[1][2] * b->p.z + a->p.y,
                  a->m[2][0] * b->p.x + a->m[2][1] * b->p.y + a->m[2][2] * b->p.z + a->p.z};
    return c;
}

static inline real3 apply(const frame *a, real3 v) {
    return (real3){a->m[0][0] * v.x + a->m[0][1] * v.y + a->m[0][2] * v.z + a->p.x,
                   a->m[1][0] * v.x + a->m[1][1] * v.y + a->m[1][2] * v.z + a->p.y,
                   a->m[2][0] * v.x + a->m[2][1] * v.y + a->m[2][2] * v.z + a->p.z};
}

// The rotation of a quaternion of any length.
static inline frame turn_by(real w, real x, real y, real z) {
    real s = 2 / (w * w + x * x + y * y + z * z);
    return (frame){{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                    {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
                    {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}},
                   {0, 0, 0}};
}

static inline frame make_frame(const ovoid_pose *p) {
    frame f = turn_by(p->rotation.w, p->rotation.x, p->rotation.y, p->rotation.z);
    f.p = (real3){p->position.x, p->position.y, p->position.z};
    return f;
}

static inline real get_value(const ovoid_robot *r, uint32_t joint, const real *q) {
    const ovoid_robot_joint *j = &ovoid_robot_get_description(r).joints[joint];
    if (j->mimic == OVOID_ROBOT_NONE) return q[ovoid_robot_get_joint_variable(r, joint)];
    return j->multiplier * get_value(r, j->mimic, q) + j->offset;
}

static inline frame move_joint(const ovoid_robot *r, uint32_t joint, const real *q) {
    const ovoid_robot_joint *j = &ovoid_robot_get_description(r).joints[joint];
    real n = sqrtl((real)j->axis.x * j->axis.x + (real)j->axis.y * j->axis.y + (real)j->axis.z * j->axis.z);
    real x = j->axis.x / n, y = j->axis.y / n, z = j->axis.z / n, angle = 0;
    real3 by = {0, 0, 0};
    if (j->type == OVOID_JOINT_PLANAR) { // about z here: the plane's directions are x and y
        const real *v = q + ovoid_robot_get_joint_variable(r, joint);
        by = (real3){v[0], v[1], 0};
        angle = v[2];
    } else if (j->type == OVOID_JOINT_PRISMATIC) {
        real v = get_value(r, joint, q);
        by = (real3){v * x, v * y, v * z};
    } else if (j->type != OVOID_JOINT_FIXED)
        angle = get_value(r, joint, q);
    frame f = turn_by(cosl(angle / 2), x * sinl(angle / 2), y * sinl(angle / 2), z * sinl(angle / 2));
    f.p = by;
    return f;
}

// All links' frames; the joints are in order.
static inline void place(const ovoid_robot *r, const real *q, frame *links) {
    ovoid_robot_description d = ovoid_robot_get_description(r);
    links[0] = turn_by(1, 0, 0, 0);
    for (uint32_t i = 0; i < d.joint_count; i++) {
        frame origin = make_frame(&d.joints[i].origin), moved = move_joint(r, i, q);
        frame at = multiply(&links[d.joints[i].parent], &origin);
        links[d.joints[i].child] = multiply(&at, &moved);
    }
}

// ---- robots that are made to break bounds

typedef struct machine {
    ovoid_robot_link links[JOINTS + 1];
    ovoid_robot_joint joints[JOINTS];
    ovoid_robot_element elements[JOINTS + 1];
    ovoid_shape *shapes[3];
    ovoid_robot *r;
    ovoid_robot_cell *cell;
    double scale, q[2][3 * JOINTS];
} machine;

static const char *const names[JOINTS + 1] = {"a", "b", "c", "d", "e", "f", "g", "h", "i"};

static inline ovoid_vec3 pick_axis(uint64_t *s) {
    static const ovoid_vec3 axes[4] = {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
    return random_below(s, 3) ? axes[random_below(s, 4)] : random_vec3(s, 1);
}

static inline void make_joint(uint64_t *s, machine *m, uint32_t i, int is_tree) {
    static const ovoid_joint_type types[6] = {OVOID_JOINT_REVOLUTE,  OVOID_JOINT_CONTINUOUS, OVOID_JOINT_CONTINUOUS,
                                              OVOID_JOINT_PRISMATIC, OVOID_JOINT_PLANAR,     OVOID_JOINT_REVOLUTE};
    ovoid_robot_joint *j = &m->joints[i];
    double length = random_below(s, 3) ? random_uniform(s, 0, 2) * m->scale : 0;
    *j = (ovoid_robot_joint){.name = names[i],
                             .type = types[random_below(s, 6)],
                             .parent = is_tree ? random_below(s, i + 1) : i,
                             .child = i + 1,
                             .origin = {{length, 0, 0}, {1, 0, 0, 0}},
                             .axis = pick_axis(s),
                             .lower = -1e6,
                             .upper = 1e6,
                             .mimic = OVOID_ROBOT_NONE,
                             .multiplier = 1};
    if (random_below(s, 3) == 0) j->origin.rotation = random_pose(s, 1).rotation;
    if (j->type == OVOID_JOINT_PLANAR) j->axis = (ovoid_vec3){0, 0, 1};
    uint32_t leader = random_below(s, i + 1);
    if (leader == i || !has_one_variable(j) || !has_one_variable(&m->joints[leader]) || random_below(s, 2)) return;
    j->mimic = leader;
    j->multiplier = random_uniform(s, -4, 4);
    j->offset = random_uniform(s, -1, 1);
}

static inline void make_machine(uint64_t *s, machine *m) {
    static const double scales[3] = {1e-3, 1, 1e3};
    uint32_t count = 1 + random_below(s, JOINTS);
    int is_tree = random_below(s, 2) == 0;
    *m = (machine){.scale = scales[random_below(s, 3)]};
    double c = m->scale;
    m->shapes[0] = ovoid_shape_create_box((ovoid_vec3){c, 1e-4 * c, 1e-4 * c}, NULL, &error);
    m->shapes[1] = ovoid_shape_create_box((ovoid_vec3){0.1 * c, 0.2 * c, 0.05 * c}, NULL, &error);
    m->shapes[2] = ovoid_shape_create_box((ovoid_vec3){0.01 * c, 1e-6 * c, 0.5 * c}, NULL, &error);
    for (uint32_t i = 0; i <= count; i++) {
        m->links[i].name = names[i];
        m->elements[i] = (ovoid_robot_element){i, NULL, m->shapes[random_below(s, 3)], random_pose(s, 0.5 * c), NULL};
    }
    for (uint32_t i = 0; i < count; i++) make_joint(s, m, i, is_tree);
    const ovoid_robot_description d = {.links = m->links,
                                       .link_count = count + 1,
                                       .joints = m->joints,
                                       .joint_count = count,
                                       .elements = m->elements,
                                       .element_count = count + 1};
    m->r = ovoid_robot_create(&d, NULL, &error);
    m->cell = m->r ? ovoid_robot_cell_create(m->r, NULL, &error) : NULL;
    if (!m->cell) printf("%s\n", error.message), exit(1);
    // A wrist may turn many times, or nothing but one joint moves, in which bounds are sharp.
    size_t n = ovoid_robot_get_variable_count(m->r), only = random_below(s, 3) ? n : random_below(s, (uint32_t)n + 1);
    for (size_t i = 0; i < n; i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(m->r, i);
        int is_length = m->joints[v.joint].type == OVOID_JOINT_PRISMATIC ||
                        (m->joints[v.joint].type == OVOID_JOINT_PLANAR && v.component < 2);
        double reach = is_length ? c : random_below(s, 4) ? 1 : 60;
        m->q[0][i] = random_uniform(s, -reach, reach);
        m->q[1][i] = only < n && only != i ? m->q[0][i] : random_uniform(s, -reach, reach);
    }
}

static inline void destroy_machine(machine *m) {
    ovoid_robot_cell_destroy(m->cell);
    ovoid_robot_destroy(m->r);
    for (int i = 0; i < 3; i++) ovoid_shape_destroy(m->shapes[i]);
}

// The vertices of an item in a state, in the frame of a link, or the world's (NONE).
static inline void place_in_state(const machine *m, const cell_item *item, const real *q, uint32_t in,
                                  real3 *vertices) {
    frame links[JOINTS + 1], own = make_frame(&item->in_link);
    place(m->r, q, links);
    frame at = multiply(&links[item->side.link], &own);
    ovoid_polytope p = ovoid_shape_get_polytope(item->shape);
    for (uint32_t i = 0; i < VERTICES; i++) {
        const double *v = p.vertices + 3 * (size_t)i;
        real3 x = apply(&at, (real3){v[0], v[1], v[2]});
        if (in != OVOID_ROBOT_NONE) {
            const frame *f = &links[in];
            real3 d = {x.x - f->p.x, x.y - f->p.y, x.z - f->p.z};
            x = (real3){f->m[0][0] * d.x + f->m[1][0] * d.y + f->m[2][0] * d.z,
                        f->m[0][1] * d.x + f->m[1][1] * d.y + f->m[2][1] * d.z,
                        f->m[0][2] * d.x + f->m[1][2] * d.y + f->m[2][2] * d.z};
        }
        vertices[i] = x;
    }
}

// The vertices of an item at s of the exact path, in such a frame.
static inline void place_vertices(const machine *m, const cell_item *item, real s, uint32_t in, real3 *vertices) {
    real q[3 * JOINTS];
    for (size_t i = 0; i < ovoid_robot_get_variable_count(m->r); i++)
        q[i] = m->q[0][i] + s * ((real)m->q[1][i] - m->q[0][i]);
    place_in_state(m, item, q, in, vertices);
}

// ---- states

static inline ovoid_quat get_rotation(const frame *f) {
    // Of the four forms the one without a small divisor.
    const real(*m)[3] = f->m;
    real t[4] = {1 + m[0][0] + m[1][1] + m[2][2], 1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
                 1 - m[0][0] - m[1][1] + m[2][2]};
    int k = 0;
    for (int i = 1; i < 4; i++) k = t[i] > t[k] ? i : k;
    real x = m[2][1] - m[1][2], y = m[0][2] - m[2][0], z = m[1][0] - m[0][1];
    real xy = m[0][1] + m[1][0], xz = m[0][2] + m[2][0], yz = m[1][2] + m[2][1];
    const real forms[4][4] = {{t[0], x, y, z}, {x, t[1], xy, xz}, {y, xy, t[2], yz}, {z, xz, yz, t[3]}};
    return (ovoid_quat){(double)forms[k][0], (double)forms[k][1], (double)forms[k][2], (double)forms[k][3]};
}

static inline ovoid_pose find_pose(const frame *links, const cell_item *item) {
    frame own = make_frame(&item->in_link), at = multiply(&links[item->side.link], &own);
    return (ovoid_pose){{(double)at.p.x, (double)at.p.y, (double)at.p.z}, get_rotation(&at)};
}

// At s: no pair may overlap by more than rounding the poses to doubles does.
static inline void sweep_state(const machine *m, double at) {
    const ovoid_robot_cell *c = m->cell;
    frame links[JOINTS + 1];
    real q[3 * JOINTS];
    for (size_t i = 0; i < ovoid_robot_get_variable_count(m->r); i++)
        q[i] = m->q[0][i] + at * ((real)m->q[1][i] - m->q[0][i]);
    place(m->r, q, links);
    double allowed = 1e-13 * (1 + 100 * m->scale);
    for (size_t i = 0; i < c->items.count; i++) {
        ovoid_pose pose = find_pose(links, &cell_items(c)[i]);
        for (size_t k = 0; k < c->parts.count; k++) {
            ovoid_pair pair = {cell_items(c)[i].shape, cell_parts(c)[k].shape, pose, cell_parts(c)[k].pose};
            ovoid_answer is = ovoid_within(&pair, 0, NULL, NULL);
            if (is.status == OVOID_OVERLAPPING) is = ovoid_depth(&pair, NULL, NULL, NULL);
            CHECK(is.upper > -allowed);
        }
    }
}

#endif
