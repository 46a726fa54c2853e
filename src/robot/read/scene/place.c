// A scene around a robot: where its objects stand in the root link's frame or in that of the link that holds them, as
// MoveIt places them by the state that the scene was made in; paddings, and the collisions that it allows.
#include "base/environment.h"
#include "base/error.h"
#include "robot/cell/cell.h"
#include "robot/read/scene/obstacles.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// What placing works with.
typedef struct placer {
    ovoid_robot_cell *cell;
    const ovoid_obstacles *from;
    ovoid_placed_obstacle *placed;
    ovoid_pose *links; ///< of all links in the scene's state; NULL: not needed yet
    ovoid_error *error;
} placer;

COMPILER_PRINTF(5, 6)
static ovoid_code fail(const placer *p, const char *object, int64_t line, ovoid_code code, const char *format, ...) {
    char sentence[256];
    va_list list;
    va_start(list, format);
    (void)vsnprintf(sentence, sizeof sentence, format, list);
    va_end(list);
    where at = {p->from->path, line, -1};
    if (object) return io_fail(p->error, code, at, "object \"%.60s\": %s", object, sentence);
    return io_fail(p->error, code, at, "%s", sentence);
}

// ---- the state that the scene was made in

static double get_default(const ovoid_robot_variable *v, const ovoid_robot_joint *joint) {
    if (joint->type == OVOID_JOINT_FLOATING && v->component == 3) return 1;
    return v->lower <= 0 && v->upper >= 0 ? 0 : v->lower + (v->upper - v->lower) / 2;
}

// The angle of a planar joint is that of the rotation about its axis, which MoveIt takes to be z.
static double get_yaw(const double v[7]) {
    return atan2(2 * (v[3] * v[6] + v[4] * v[5]), v[3] * v[3] + v[4] * v[4] - v[5] * v[5] - v[6] * v[6]);
}

// A joint that the robot does not have moves nothing of it, and one that is known by several numbers has them all.
static ovoid_code set_joint(const placer *p, const scene_joint *from, double *q) {
    const ovoid_robot *robot = p->cell->robot;
    uint32_t joint = ovoid_robot_find_joint(robot, from->name);
    if (joint == OVOID_ROBOT_NONE) {
        if (!from->is_multiple || transform_is_identity(from->values)) return OVOID_OK;
        return fail(
            p, NULL, from->line, OVOID_ERROR_FORMAT,
            "robot_state: joint \"%.60s\" is not of the robot, and puts it elsewhere: give the SRDF that has it, and a "
            "base that is free (--free-base) where it is the virtual joint",
            from->name);
    }
    const ovoid_robot_joint *j = &robot->joints[joint];
    uint32_t first = ovoid_robot_get_joint_variable(robot, joint), count = ovoid_joint_type_get_variable_count(j->type);
    if (j->mimic != OVOID_ROBOT_NONE || count == 0) return OVOID_OK;
    if (from->is_multiple != (count > 1))
        return fail(p, NULL, from->line, OVOID_ERROR_FORMAT, "robot_state: joint \"%.60s\" is %s", from->name,
                    ovoid_joint_type_get_name(j->type));
    for (uint32_t i = 0; i < count; i++) q[first + i] = from->values[i];
    if (count == 3) q[first + 2] = get_yaw(from->values);
    return OVOID_OK;
}

static ovoid_code place_links(placer *p) {
    const ovoid_robot *robot = p->cell->robot;
    if (p->links) return OVOID_OK;
    size_t count = ovoid_robot_get_variable_count(robot);
    double *q = calloc(count + 1, sizeof *q);
    p->links = calloc(robot->link_count, sizeof *p->links);
    if (!q || !p->links) {
        free(q);
        return io_fail_memory(p->error, p->from->path);
    }
    for (size_t i = 0; i < count; i++)
        q[i] = get_default(&robot->variables[i], &robot->joints[robot->variables[i].joint]);
    ovoid_code code = OVOID_OK;
    ovoid_error why;
    for (size_t i = 0; i < p->from->state.joint_count && !code; i++) code = set_joint(p, &p->from->state.joints[i], q);
    if (!code && (code = ovoid_robot_compute_poses(robot, q, p->links, &why)) != OVOID_OK)
        code = fail(p, NULL, 0, code, "robot_state: %s", why.message);
    free(q);
    return code;
}

// ---- frames

static int is_root(const placer *p, const char *name) {
    const ovoid_robot *robot = p->cell->robot;
    return !name[0] || strcmp(name, robot->links[robot->root].name) == 0 ||
           (robot->of.frame && strcmp(name, robot->of.frame) == 0);
}

static ovoid_pose invert(const ovoid_pose *pose) {
    ovoid_quat q = {pose->rotation.w, -pose->rotation.x, -pose->rotation.y, -pose->rotation.z};
    ovoid_pose back = {{0, 0, 0}, q};
    vec3 at = ovoid_pose_compute_point(&back, pose->position);
    return (ovoid_pose){{-at.x, -at.y, -at.z}, q};
}

// A pose in a frame as one in the root link's. MoveIt looks for a link first, then for a fixed frame.
static ovoid_code find_in_root(placer *p, const obstacle_entry *e, ovoid_pose *pose) {
    const scene_state *s = &p->from->state;
    uint32_t link = ovoid_robot_find_link(p->cell->robot, e->frame);
    *pose = e->pose;
    if (is_root(p, e->frame)) return OVOID_OK;
    if (link != OVOID_ROBOT_NONE) {
        ovoid_code code = place_links(p);
        if (!code) *pose = ovoid_pose_compute_product(&p->links[link], &e->pose);
        return code;
    }
    for (size_t i = s->frame_count; i-- > 0;) // the last one of a name counts
        if (strcmp(s->frames[i].name, e->frame) == 0)
            return *pose = ovoid_pose_compute_product(&s->frames[i].pose, &e->pose), OVOID_OK;
    return fail(p, e->name, e->line, OVOID_ERROR_FORMAT,
                "its frame, header: frame_id \"%.60s\", is neither a link nor one of fixed_frame_transforms", e->frame);
}

static ovoid_code place_attached(placer *p, const obstacle_entry *e, ovoid_placed_obstacle *to) {
    to->link = ovoid_robot_find_link(p->cell->robot, e->link);
    if (to->link == OVOID_ROBOT_NONE)
        return fail(p, e->name, e->line, OVOID_ERROR_FORMAT, "its link_name \"%.60s\" is no link", e->link);
    to->pose = e->pose;
    if (strcmp(e->frame, e->link) == 0) return OVOID_OK;
    ovoid_code code = place_links(p);
    if (!code) code = find_in_root(p, e, &to->pose);
    if (code) return code;
    ovoid_pose in_link = invert(&p->links[to->link]);
    to->pose = ovoid_pose_compute_product(&in_link, &to->pose);
    return OVOID_OK;
}

static ovoid_code place_all(placer *p) {
    const scene_state *s = &p->from->state;
    if (s->model && !is_root(p, s->model))
        return fail(p, NULL, s->model_line, OVOID_ERROR_FORMAT,
                    "fixed_frame_transforms: child_frame_id is \"%.60s\", not the model's frame, \"%.60s\"", s->model,
                    p->cell->robot->links[p->cell->robot->root].name);
    ovoid_code code = OVOID_OK;
    for (size_t i = 0; i < p->from->count && !code; i++) {
        const obstacle_entry *e = &p->from->entries[i];
        ovoid_placed_obstacle *to = &p->placed[i];
        *to = (ovoid_placed_obstacle){.link = OVOID_ROBOT_NONE};
        code = e->link ? place_attached(p, e, to) : find_in_root(p, e, &to->pose);
    }
    for (size_t i = 0; i < s->padding_count && !code; i++)
        if (ovoid_robot_find_link(p->cell->robot, s->paddings[i].link) == OVOID_ROBOT_NONE)
            code = fail(p, NULL, s->paddings[i].line, OVOID_ERROR_FORMAT, "link_padding: there is no link \"%.60s\"",
                        s->paddings[i].link);
    return code;
}

// ---- allowed collisions

// What is held and an obstacle, or two things that are held, are let touch as their links are.
static ovoid_code validate_held(const placer *p, size_t i) {
    const scene_matrix *m = &p->from->state.matrix;
    const obstacle_entry *e = &p->from->entries[i];
    for (size_t k = 0; k < p->from->count; k++) {
        const obstacle_entry *other = &p->from->entries[k];
        const char *name = other->link ? other->link : other->name;
        if (k == i || (other->link && strcmp(other->link, e->link) == 0)) continue;
        const char *own = other->link ? e->name : e->link;
        if (scene_matrix_is_allowed(m, e->name, other->name) != scene_matrix_is_allowed(m, own, name))
            return fail(p, e->name, m->line, OVOID_ERROR_FORMAT,
                        "allowed_collision_matrix has one entry for it and \"%.60s\", another for \"%.60s\" and "
                        "\"%.60s\": what a link holds is let touch what the link is",
                        other->name, own, name);
    }
    return OVOID_OK;
}

static ovoid_code allow(const placer *p) {
    ovoid_robot_cell *c = p->cell;
    const scene_matrix *m = &p->from->state.matrix;
    const ovoid_robot_link *links = c->robot->links;
    int good = 1;
    if (!m->line) return OVOID_OK;
    c->ignores_disabled = 1;
    for (uint32_t a = 0; a < c->robot->link_count; a++) {
        for (uint32_t b = a + 1; b < c->robot->link_count && good; b++)
            if (scene_matrix_is_allowed(m, links[a].name, links[b].name))
                good = keys_set(&c->allocator, &c->allowed_links, cell_make_key(a, b), 1) == OVOID_OK;
        for (size_t i = 0; i < p->from->count && good; i++)
            if (scene_matrix_is_allowed(m, links[a].name, p->from->entries[i].name))
                good = keys_set(&c->allocator, &c->allowed_bodies, cell_make_key((uint32_t)(p->placed[i].id >> 32), a),
                                1) == OVOID_OK;
    }
    return good ? OVOID_OK : io_fail_memory(p->error, p->from->path);
}

// ---- into the cell

static ovoid_code add(const placer *p, size_t i) {
    const obstacle_entry *e = &p->from->entries[i];
    ovoid_placed_obstacle *to = &p->placed[i];
    const ovoid_body body = {.shape = e->solid ? NULL : e->shape, .pose = to->pose, .solid = e->solid};
    ovoid_error why = {OVOID_OK, -1, ""};
    if (!e->link) {
        to->id = ovoid_robot_cell_add(p->cell, &body, &why);
    } else {
        uint32_t *links = calloc(e->touching_count + 1, sizeof *links);
        size_t count = 0;
        if (!links) return io_fail_memory(p->error, p->from->path);
        // A link that this variant of the robot does not have touches nothing.
        for (size_t k = 0; k < e->touching_count; k++) {
            uint32_t link = ovoid_robot_find_link(p->cell->robot, e->touching[k]);
            if (link != OVOID_ROBOT_NONE) links[count++] = link;
        }
        const ovoid_robot_attachment held = {to->link, body, links, count};
        to->id = ovoid_robot_cell_attach(p->cell, &held, &why);
        free(links);
    }
    return to->id ? OVOID_OK : fail(p, e->name, e->line, why.code, "%s", why.message);
}

static ovoid_code add_all(placer *p) {
    const scene_state *s = &p->from->state;
    size_t added = 0;
    ovoid_code code = place_all(p);
    for (size_t i = 0; i < p->from->count && !code && s->matrix.line; i++)
        if (p->from->entries[i].link) code = validate_held(p, i);
    if (code) return code;
    for (; added < p->from->count && !code; added++) code = add(p, added);
    if (!code) code = allow(p);
    if (!code && s->matrix.line) code = cell_compile(p->cell, p->error);
    if (!code) {
        for (size_t i = 0; i < s->padding_count; i++)
            p->cell->padding[ovoid_robot_find_link(p->cell->robot, s->paddings[i].link)] = s->paddings[i].padding;
        return OVOID_OK;
    }
    for (size_t i = 0; i < added; i++)
        if (p->placed[i].id) (void)ovoid_robot_cell_remove(p->cell, p->placed[i].id, NULL);
    return code;
}

ovoid_code ovoid_robot_cell_add_obstacles(ovoid_robot_cell *cell, const ovoid_obstacles *obstacles,
                                          ovoid_placed_obstacle *placed, ovoid_error *error) {
    placer p = {.cell = cell, .from = obstacles, .placed = placed, .error = error};
    if (!placed) p.placed = calloc(obstacles->count + 1, sizeof *p.placed);
    ovoid_code code = p.placed ? add_all(&p) : io_fail_memory(error, obstacles->path);
    if (!placed) free(p.placed);
    free(p.links);
    return code;
}
