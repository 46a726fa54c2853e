// The report for programs: one object of JSON in a line.
#include "robot/info/info.h"

#include "base/members.h"
#include "io/fields.h"

static void write_vector(FILE *file, const char *before, const char *key, const double *v, size_t count) {
    member_write_key(file, before, key);
    json_write_numbers(file, v, count);
}

static void write_pose(FILE *file, const char *before, const char *key, const ovoid_pose *p) {
    const double xyz[] = {p->position.x, p->position.y, p->position.z};
    const double quat[] = {p->rotation.w, p->rotation.x, p->rotation.y, p->rotation.z};
    member_write_key(file, before, key);
    write_vector(file, "{", "xyz", xyz, 3);
    write_vector(file, ",", "quat_wxyz", quat, 4);
    fputc('}', file);
}

static void write_links(FILE *file, const cli_robot *robot, const ovoid_robot_description *d, const link_count *links) {
    fputs(",\"links\":[", file);
    for (uint32_t i = 0; i < d->link_count; i++) {
        uint32_t above = ovoid_robot_get_parent_joint(robot->robot, i);
        member_write_text(file, i ? ",{" : "{", "name", d->links[i].name);
        member_write_text(file, ",", "joint", above == OVOID_ROBOT_NONE ? NULL : d->joints[above].name);
        fprintf(file, ",\"elements\":%zu,\"vertices\":%zu}", links[i].elements, links[i].vertices);
    }
    fputc(']', file);
}

static void write_joint(FILE *file, const ovoid_robot_description *d, const ovoid_robot_joint *j) {
    const double axis[] = {j->axis.x, j->axis.y, j->axis.z};
    member_write_text(file, "{", "name", j->name);
    member_write_text(file, ",", "type", ovoid_joint_type_get_name(j->type));
    member_write_text(file, ",", "parent", d->links[j->parent].name);
    member_write_text(file, ",", "child", d->links[j->child].name);
    write_pose(file, ",", "origin", &j->origin);
    if (j->type != OVOID_JOINT_FIXED && j->type != OVOID_JOINT_FLOATING) write_vector(file, ",", "axis", axis, 3);
    if (j->type == OVOID_JOINT_REVOLUTE || j->type == OVOID_JOINT_PRISMATIC) {
        member_write_number(file, ",", "lower", j->lower);
        member_write_number(file, ",", "upper", j->upper);
    }
    if (j->velocity > 0) member_write_number(file, ",", "velocity", j->velocity);
    if (j->mimic != OVOID_ROBOT_NONE) {
        member_write_text(file, ",", "mimic", d->joints[j->mimic].name);
        member_write_number(file, ",", "multiplier", j->multiplier);
        member_write_number(file, ",", "offset", j->offset);
    }
    fputc('}', file);
}

static void write_variables(FILE *file, const cli_robot *robot, const ovoid_robot_description *d) {
    fputs(",\"variables\":[", file);
    for (size_t i = 0; i < ovoid_robot_get_variable_count(robot->robot); i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(robot->robot, i);
        member_write_text(file, i ? ",{" : "{", "joint", d->joints[v.joint].name);
        fprintf(file, ",\"component\":%u", (unsigned)v.component);
        member_write_number(file, ",", "lower", v.lower);
        member_write_number(file, ",", "upper", v.upper);
        fputc('}', file);
    }
    fputc(']', file);
}

static void write_elements(FILE *file, const ovoid_robot_description *d) {
    fputs(",\"elements\":[", file);
    for (size_t i = 0; i < d->element_count; i++) {
        const ovoid_robot_element *e = &d->elements[i];
        ovoid_allowance allowance = ovoid_shape_get_allowance(e->shape);
        member_write_text(file, i ? ",{" : "{", "link", d->links[e->link].name);
        member_write_text(file, ",", "name", e->name);
        write_pose(file, ",", "pose", &e->pose);
        fprintf(file, ",\"vertices\":%u", (unsigned)ovoid_shape_get_polytope(e->shape).vertex_count);
        member_write_number(file, ",", "radius", ovoid_shape_get_radius(e->shape));
        member_write_number(file, ",", "outside", allowance.outside);
        member_write_number(file, ",", "inside", allowance.inside);
        fputc('}', file);
    }
    fputc(']', file);
}

static void write_meshes(FILE *file, const cli_robot *robot) {
    fputs(",\"meshes\":[", file);
    for (size_t i = 0; i < ovoid_robot_file_get_mesh_count(robot->file); i++) {
        ovoid_robot_mesh m = ovoid_robot_file_get_mesh(robot->file, i);
        const double scale[] = {m.scale.x, m.scale.y, m.scale.z};
        member_write_text(file, i ? ",{" : "{", "address", m.address);
        member_write_text(file, ",", "path", m.path);
        write_vector(file, ",", "scale", scale, 3);
        fprintf(file, ",\"parts\":%zu,\"uses\":%zu", m.part_count, m.use_count);
        member_write_number(file, ",", "mesh_volume", m.convexity.mesh_volume);
        member_write_number(file, ",", "hull_volume", m.convexity.hull_volume);
        fprintf(file, ",\"kind\":\"%s\"", ovoid_mesh_kind_get_name(m.kind));
        if (m.allowance > 0) member_write_number(file, ",", "allowance", m.allowance);
        fputc('}', file);
    }
    fputc(']', file);
}

static void write_disabled(FILE *file, const ovoid_robot_description *d) {
    fputs(",\"disabled\":[", file);
    for (size_t i = 0; i < d->disabled_count; i++) {
        member_write_text(file, i ? ",{" : "{", "a", d->links[d->disabled[i].a].name);
        member_write_text(file, ",", "b", d->links[d->disabled[i].b].name);
        member_write_text(file, ",", "reason", d->disabled[i].reason);
        fputc('}', file);
    }
    fputc(']', file);
}

static void write_names(FILE *file, const char *key, const uint32_t *items, size_t count, const char *const *names,
                        size_t stride) {
    member_write_key(file, ",", key);
    fputc('[', file);
    for (size_t i = 0; i < count; i++) {
        if (i) fputc(',', file);
        ovoid_text_write_json(file, *(const char *const *)((const char *)names + items[i] * stride));
    }
    fputc(']', file);
}

static void write_groups(FILE *file, const cli_robot *robot, const ovoid_robot_description *d) {
    fputs(",\"groups\":[", file);
    for (size_t i = 0; i < ovoid_robot_file_get_group_count(robot->file); i++) {
        ovoid_robot_group g = ovoid_robot_file_get_group(robot->file, i);
        member_write_text(file, i ? ",{" : "{", "name", g.name);
        write_names(file, "joints", g.joints, g.joint_count, &d->joints[0].name, sizeof d->joints[0]);
        write_names(file, "links", g.links, g.link_count, &d->links[0].name, sizeof d->links[0]);
        fputc('}', file);
    }
    fputc(']', file);
}

static void write_end_effectors(FILE *file, const cli_robot *robot, const ovoid_robot_description *d) {
    fputs(",\"end_effectors\":[", file);
    for (size_t i = 0; i < ovoid_robot_file_get_end_effector_count(robot->file); i++) {
        ovoid_robot_end_effector e = ovoid_robot_file_get_end_effector(robot->file, i);
        member_write_text(file, i ? ",{" : "{", "name", e.name);
        member_write_text(file, ",", "link", d->links[e.link].name);
        member_write_text(file, ",", "group", ovoid_robot_file_get_group(robot->file, e.group).name);
        fputc('}', file);
    }
    fputc(']', file);
}

static void write_states(FILE *file, const cli_robot *robot, const ovoid_robot_description *d) {
    fputs(",\"states\":[", file);
    for (size_t i = 0; i < ovoid_robot_file_get_state_count(robot->file); i++) {
        ovoid_robot_state s = ovoid_robot_file_get_state(robot->file, i);
        member_write_text(file, i ? ",{" : "{", "name", s.name);
        member_write_text(file, ",", "group", s.group);
        fputs(",\"values\":{", file);
        for (size_t k = 0; k < s.value_count; k++) {
            const ovoid_robot_value *v = &s.values[k];
            if (k) fputc(',', file);
            ovoid_text_write_json(file, d->joints[v->joint].name);
            fputc(':', file);
            json_write_numbers(file, v->values, v->count);
        }
        fputs("}}", file);
    }
    fputc(']', file);
}

static void write_rest(FILE *file, const cli_robot *robot, const ovoid_robot_description *d) {
    size_t spheres, passive;
    const uint32_t *joints = ovoid_robot_file_get_passive(robot->file, &passive);
    (void)ovoid_robot_file_get_spheres(robot->file, &spheres);
    if (d->joint_count) write_names(file, "passive", joints, passive, &d->joints[0].name, sizeof d->joints[0]);
    fprintf(file, ",\"spheres\":%zu,\"fixed_mimics\":%zu,\"not_read\":{", spheres,
            ovoid_robot_file_get_fixed_mimic_count(robot->file));
    for (size_t i = 0; i < ovoid_robot_file_get_ignored_count(robot->file); i++) {
        ovoid_robot_ignored kind = ovoid_robot_file_get_ignored(robot->file, i);
        if (i) fputc(',', file);
        ovoid_text_write_json(file, kind.name);
        fprintf(file, ":%zu", kind.count);
    }
    fprintf(file, "},\"warnings\":%zu}\n", robot->note_count);
}

void info_write_json(FILE *file, const cli_robot *robot, const link_count *links) {
    ovoid_robot_description d = ovoid_robot_get_description(robot->robot);
    member_write_text(file, "{", "robot", d.name);
    member_write_text(file, ",", "root", d.links[ovoid_robot_get_root(robot->robot)].name);
    write_links(file, robot, &d, links);
    fputs(",\"joints\":[", file);
    for (size_t i = 0; i < d.joint_count; i++) {
        if (i) fputc(',', file);
        write_joint(file, &d, &d.joints[i]);
    }
    fputc(']', file);
    write_variables(file, robot, &d);
    write_elements(file, &d);
    write_meshes(file, robot);
    write_disabled(file, &d);
    write_groups(file, robot, &d);
    write_end_effectors(file, robot, &d);
    write_states(file, robot, &d);
    write_rest(file, robot, &d);
}
