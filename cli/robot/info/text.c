// The report for people: tables whose columns are as wide as their longest name.
#include "robot/info/info.h"

#include "base/message.h"

#include <math.h>
#include <string.h>

/// The longest of the names, or of a least width.
typedef struct widths {
    int link, joint, type;
} widths;

static int longer(int width, const char *name) { return (int)strlen(name) > width ? (int)strlen(name) : width; }

static widths measure(const ovoid_robot_description *d) {
    widths w = {4, 5, 4};
    for (size_t i = 0; i < d->link_count; i++) w.link = longer(w.link, d->links[i].name);
    for (size_t i = 0; i < d->joint_count; i++) {
        w.joint = longer(w.joint, d->joints[i].name);
        w.type = longer(w.type, ovoid_joint_type_get_name(d->joints[i].type));
    }
    return w;
}

static void write_padded(FILE *file, const char *name, int width) {
    message_write_text(file, name);
    fprintf(file, "%*s  ", width - (int)strlen(name), "");
}

static void write_number(FILE *file, double number, const char *end) {
    if (isfinite(number))
        fprintf(file, "%9.6g%s", number, end);
    else
        fprintf(file, "%9s%s", "-", end);
}

static void write_head(FILE *file, const cli_robot *robot, const ovoid_robot_description *d) {
    fputs("robot      ", file);
    message_write_text(file, d->name && d->name[0] ? d->name : "(no name)");
    fprintf(file, "\nlinks      %zu, of which ", d->link_count);
    message_write_text(file, d->links[ovoid_robot_get_root(robot->robot)].name);
    fprintf(file, " is the root\njoints     %zu\nvariables  %zu\n", d->joint_count,
            ovoid_robot_get_variable_count(robot->robot));
}

static void write_variables(FILE *file, const cli_robot *robot, const ovoid_robot_description *d, const widths *w) {
    size_t count = ovoid_robot_get_variable_count(robot->robot);
    if (!count) return;
    fprintf(file, "\n%8s  %-*s  %-*s  %9s %9s %9s\n", "variable", w->joint + 6, "joint", w->type, "type", "lower",
            "upper", "velocity");
    for (size_t i = 0; i < count; i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(robot->robot, i);
        const ovoid_robot_joint *joint = &d->joints[v.joint];
        const char *component = robot_get_component(joint, v.component);
        fprintf(file, "%8zu  ", i);
        message_write_text(file, joint->name);
        fprintf(file, "%-*s  %-*s  ", w->joint + 6 - (int)strlen(joint->name), component, w->type,
                ovoid_joint_type_get_name(joint->type));
        write_number(file, v.lower, " ");
        write_number(file, v.upper, " ");
        write_number(file, v.velocity > 0 ? v.velocity : INFINITY, "\n");
    }
}

static void write_mimics(FILE *file, const cli_robot *robot, const ovoid_robot_description *d) {
    size_t fixed = ovoid_robot_file_get_fixed_mimic_count(robot->file);
    const char *title = "\n";
    for (size_t i = 0; i < d->joint_count; i++) {
        const ovoid_robot_joint *joint = &d->joints[i];
        if (joint->mimic == OVOID_ROBOT_NONE) continue;
        fprintf(file, "%smimics     ", title);
        message_write_text(file, joint->name);
        fprintf(file, " = %.9g ", joint->multiplier);
        message_write_text(file, d->joints[joint->mimic].name);
        if (joint->offset != 0) fprintf(file, " %c %.9g", joint->offset < 0 ? '-' : '+', fabs(joint->offset));
        fputc('\n', file);
        title = "";
    }
    if (fixed) fprintf(file, "%smimics     %zu on fixed joints, without effect\n", title, fixed);
}

static void write_links(FILE *file, const cli_robot *robot, const ovoid_robot_description *d, const widths *w,
                        const link_count *links) {
    size_t vertices = 0;
    fprintf(file, "\n%-*s  %-*s  %-*s  %8s %8s\n", w->link, "link", w->joint, "joint above", w->type, "type",
            "elements", "vertices");
    for (uint32_t i = 0; i < d->link_count; i++) {
        uint32_t above = ovoid_robot_get_parent_joint(robot->robot, i);
        write_padded(file, d->links[i].name, w->link);
        write_padded(file, above == OVOID_ROBOT_NONE ? "-" : d->joints[above].name, w->joint);
        fprintf(file, "%-*s  %8zu %8zu\n", w->type,
                above == OVOID_ROBOT_NONE ? "-" : ovoid_joint_type_get_name(d->joints[above].type), links[i].elements,
                links[i].vertices);
        vertices += links[i].vertices;
    }
    fprintf(file, "\nelements   %zu, of %zu hull vertices in all\n", d->element_count, vertices);
}

static void write_scale(FILE *file, ovoid_vec3 s) {
    if (s.x != 1 || s.y != 1 || s.z != 1) fprintf(file, ", scale %.9g %.9g %.9g", s.x, s.y, s.z);
}

static void write_meshes(FILE *file, const cli_robot *robot) {
    size_t count = ovoid_robot_file_get_mesh_count(robot->file);
    if (!count) return;
    fprintf(file, "\n%5s %5s  %-7s  %7s  mesh\n", "parts", "uses", "as", "of hull");
    for (size_t i = 0; i < count; i++) {
        ovoid_robot_mesh m = ovoid_robot_file_get_mesh(robot->file, i);
        double share = 100 * m.convexity.mesh_volume / m.convexity.hull_volume;
        fprintf(file, "%5zu %5zu  %-7s  ", m.part_count, m.use_count, ovoid_mesh_kind_get_name(m.kind));
        if (isfinite(share))
            fprintf(file, "%5.1f %%  ", share);
        else
            fprintf(file, "%7s  ", "open");
        message_write_text(file, m.address);
        write_scale(file, m.scale);
        if (m.allowance > 0) fprintf(file, ", to %.2g m", m.allowance);
        fputc('\n', file);
    }
}

/// The reasons that come first, and how many pairs have each.
enum { REASONS_MAX = 8 };
typedef struct reasons {
    const char *names[REASONS_MAX];
    size_t counts[REASONS_MAX], count, others;
} reasons;

static void count_reason(reasons *r, const char *name) {
    size_t i = 0;
    while (i < r->count && strcmp(r->names[i], name) != 0) i++;
    if (i == REASONS_MAX) {
        r->others++;
        return;
    }
    if (i == r->count) r->names[r->count] = name, r->counts[r->count++] = 0;
    r->counts[i]++;
}

static void write_disabled(FILE *file, const ovoid_robot_description *d) {
    reasons r = {.count = 0};
    if (!d->disabled_count) return;
    for (size_t i = 0; i < d->disabled_count; i++)
        count_reason(&r, d->disabled[i].reason ? d->disabled[i].reason : "no reason");
    fprintf(file, "\ndisabled   %zu of %zu pairs of links", d->disabled_count, d->link_count * (d->link_count - 1) / 2);
    for (size_t i = 0; i < r.count; i++) {
        fputs(i ? ", " : ": ", file);
        message_write_text(file, r.names[i]);
        fprintf(file, " %zu", r.counts[i]);
    }
    if (r.others) fprintf(file, ", others %zu", r.others);
    fputc('\n', file);
}

static void write_srdf(FILE *file, const cli_robot *robot) {
    size_t spheres, passive;
    (void)ovoid_robot_file_get_spheres(robot->file, &spheres);
    const uint32_t *passive_joints = ovoid_robot_file_get_passive(robot->file, &passive);
    const ovoid_robot_joint *joints = ovoid_robot_get_description(robot->robot).joints;
    for (size_t i = 0; i < ovoid_robot_file_get_group_count(robot->file); i++) {
        ovoid_robot_group g = ovoid_robot_file_get_group(robot->file, i);
        fputs("group      ", file);
        message_write_text(file, g.name);
        fprintf(file, ": joints %zu, links %zu\n", g.joint_count, g.link_count);
    }
    for (size_t i = 0; i < ovoid_robot_file_get_end_effector_count(robot->file); i++) {
        ovoid_robot_end_effector e = ovoid_robot_file_get_end_effector(robot->file, i);
        fputs("effector   ", file);
        message_write_text(file, e.name);
        fputs(": group ", file);
        message_write_text(file, ovoid_robot_file_get_group(robot->file, e.group).name);
        fputs(", on link ", file);
        message_write_text(file, ovoid_robot_get_description(robot->robot).links[e.link].name);
        fputc('\n', file);
    }
    for (size_t i = 0; i < ovoid_robot_file_get_state_count(robot->file); i++) {
        ovoid_robot_state s = ovoid_robot_file_get_state(robot->file, i);
        fputs("state      ", file);
        message_write_text(file, s.name);
        fprintf(file, ": joints %zu\n", s.value_count);
    }
    if (spheres) fprintf(file, "spheres    %zu\n", spheres);
    for (size_t i = 0; i < passive; i++) {
        fputs(i ? ", " : "passive    ", file);
        message_write_text(file, joints[passive_joints[i]].name);
    }
    if (passive) fputc('\n', file);
}

static void write_ignored(FILE *file, const cli_robot *robot) {
    size_t count = ovoid_robot_file_get_ignored_count(robot->file);
    for (size_t i = 0; i < count; i++) {
        ovoid_robot_ignored kind = ovoid_robot_file_get_ignored(robot->file, i);
        fprintf(file, "%s%zu ", i ? ", " : "\nnot read   ", kind.count);
        message_write_text(file, kind.name);
    }
    if (count) fputc('\n', file);
}

void info_write_text(FILE *file, const cli_robot *robot, const link_count *links) {
    ovoid_robot_description d = ovoid_robot_get_description(robot->robot);
    widths w = measure(&d);
    write_head(file, robot, &d);
    write_variables(file, robot, &d, &w);
    write_mimics(file, robot, &d);
    write_links(file, robot, &d, &w, links);
    write_meshes(file, robot);
    write_disabled(file, &d);
    write_srdf(file, robot);
    write_ignored(file, robot);
}
