// The first line of a file of path proofs. Its digest is FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo, 1991) over the robot
// and the obstacles as they were compiled: it tells files apart that were mixed up; that a proof holds it need not say.
#include "robot/path/proof.h"

#include "base/members.h"
#include "io/fields.h"

#include <string.h>

// ---- the digest

static uint64_t add_bytes(uint64_t hash, const void *data, size_t size) {
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++) hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return hash;
}

static uint64_t add_text(uint64_t hash, const char *text) {
    return add_bytes(hash, text ? text : "", text ? strlen(text) + 1 : 1);
}

/// Zeros of both signs are one.
static uint64_t add_number(uint64_t hash, double x) {
    x += 0.0;
    return add_bytes(hash, &x, sizeof x);
}

static uint64_t add_index(uint64_t hash, uint64_t x) { return add_bytes(hash, &x, sizeof x); }

static uint64_t add_vector(uint64_t hash, ovoid_vec3 v) {
    return add_number(add_number(add_number(hash, v.x), v.y), v.z);
}

static uint64_t add_pose(uint64_t hash, const ovoid_pose *pose) {
    hash = add_number(add_vector(hash, pose->position), pose->rotation.w);
    return add_vector(hash, (ovoid_vec3){pose->rotation.x, pose->rotation.y, pose->rotation.z});
}

static uint64_t add_shape(uint64_t hash, const ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    ovoid_allowance allowance = ovoid_shape_get_allowance(shape);
    hash = add_index(hash, p.vertex_count);
    for (size_t i = 0; i < 3 * p.vertex_count; i++) hash = add_number(hash, p.vertices[i]);
    hash = add_number(hash, ovoid_shape_get_radius(shape));
    return add_number(add_number(hash, allowance.outside), allowance.inside);
}

static uint64_t add_solid(uint64_t hash, const ovoid_solid *solid) {
    if (!solid) return hash;
    ovoid_solid_report is = ovoid_solid_get_report(solid);
    const double *points = ovoid_solid_get_points(solid);
    hash = add_index(add_index(hash, is.points), is.triangles);
    for (size_t i = 0; i < 3 * (size_t)is.points; i++) hash = add_number(hash, points[i]);
    for (size_t i = 0; i < (size_t)is.triangles; i++) {
        uint32_t corner[3];
        ovoid_solid_get_triangle(solid, i, corner);
        for (int k = 0; k < 3; k++) hash = add_index(hash, corner[k]);
    }
    return hash;
}

static uint64_t add_joint(uint64_t hash, const ovoid_robot_joint *j) {
    hash = add_index(add_text(hash, j->name), (uint64_t)j->type);
    hash = add_pose(add_index(add_index(hash, j->parent), j->child), &j->origin);
    hash = add_number(add_number(add_vector(hash, j->axis), j->lower), j->upper);
    return add_number(add_number(add_index(hash, j->mimic), j->multiplier), j->offset);
}

uint64_t proof_compute_digest(const cli_cell *cell) {
    const ovoid_robot_description *d = &cell->description;
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < d->link_count; i++) hash = add_text(hash, d->links[i].name);
    for (size_t i = 0; i < d->joint_count; i++) hash = add_joint(hash, &d->joints[i]);
    for (size_t i = 0; i < d->element_count; i++) {
        const ovoid_robot_element *e = &d->elements[i];
        hash = add_shape(add_pose(add_text(add_index(hash, e->link), e->name), &e->pose), e->shape);
        hash = add_solid(hash, e->solid);
    }
    for (size_t i = 0; i < d->disabled_count; i++)
        hash = add_index(add_index(hash, d->disabled[i].a), d->disabled[i].b);
    for (size_t i = 0; i < cell->body_count; i++) {
        const cell_body *o = &cell->bodies[i];
        const ovoid_placed_obstacle *at = &o->at;
        hash = add_solid(add_shape(add_pose(add_text(hash, o->name), &at->pose), o->shape), o->solid);
        if (at->link != OVOID_ROBOT_NONE) hash = add_index(hash, at->link);
    }
    return hash;
}

// ---- the line

uint32_t proof_find_pair(const cli_cell *cell, const ovoid_robot_side *a, const ovoid_robot_side *b) {
    size_t count = ovoid_robot_cell_get_pair_count(cell->cell);
    for (size_t i = 0; i < count; i++) {
        ovoid_robot_sides sides;
        if (ovoid_robot_cell_get_pair(cell->cell, i, &sides, NULL) != OVOID_OK) continue;
        ovoid_robot_side p = sides.a, q = sides.b;
        if (p.link == a->link && p.element == a->element && p.body == a->body && p.part == a->part &&
            q.link == b->link && q.element == b->element && q.body == b->body && q.part == b->part)
            return (uint32_t)i;
    }
    return OVOID_ROBOT_NONE;
}

static void write_list(FILE *file, const char *key, const args_list *list) {
    fprintf(file, ",\"%s\":[", key);
    for (int i = 0; i < list->count; i++) {
        if (i) fputc(',', file);
        ovoid_text_write_json(file, list->items[i]);
    }
    fputc(']', file);
}

static void write_flag(FILE *file, const char *key, int is_set) {
    fprintf(file, ",\"%s\":%s", key, is_set ? "true" : "false");
}

void proof_write_pairs(FILE *file, const cli_cell *cell) {
    size_t count = ovoid_robot_cell_get_pair_count(cell->cell);
    for (size_t i = 0; i < count; i++) {
        ovoid_robot_sides sides;
        if (ovoid_robot_cell_get_pair(cell->cell, i, &sides, NULL) != OVOID_OK) continue;
        fputs(i ? ",[" : "[", file);
        cell_write_side_json(file, cell, &sides.a);
        fputc(',', file);
        cell_write_side_json(file, cell, &sides.b);
        fputc(']', file);
    }
}

void proof_write_source(FILE *file, const proof_source *source) {
    const cell_settings *s = source->cell;
    const cli_cell *cell = source->opened;
    size_t variables = ovoid_robot_get_variable_count(cell->robot.robot);
    fputs("{\"path_proofs\":2", file);
    member_write_text(file, ",", "robot", source->urdf);
    member_write_text(file, ",", "srdf", s->robot->srdf);
    member_write_text(file, ",", "scene", s->scene);
    write_list(file, "packages", &s->robot->packages);
    write_list(file, "scales", &s->robot->scales);
    write_list(file, "paddings", &s->paddings);
    // Most files have none, and are read by versions that do not know the key.
    if (s->attached.count) write_list(file, "attached", &s->attached);
    write_flag(file, "parts", s->robot->parts);
    write_flag(file, "hull", s->robot->hull);
    write_flag(file, "visual", s->robot->visual);
    write_flag(file, "fixed_base", !s->robot->free_base);
    member_write_number(file, ",", "cylinder_tolerance", s->robot->tolerance);
    member_write_number(file, ",", "margin", s->margin);
    member_write_number(file, ",", "limit_slack", s->slack);
    fprintf(file, ",\"paths\":%zu,\"digest\":\"%016llx\",\"variables\":[", source->path_count,
            (unsigned long long)proof_compute_digest(cell));
    for (size_t i = 0; i < variables; i++) {
        if (i) fputc(',', file);
        cell_write_variable_json(file, cell, i);
    }
    fputs("],\"pairs\":[", file);
    proof_write_pairs(file, cell);
    fputs("]}\n", file);
}
