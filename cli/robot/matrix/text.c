// The matrix for people: the pairs by what is known of them, and what a given SRDF leaves out wrongly.
#include "robot/matrix/matrix.h"

#include "base/message.h"

#include <string.h>

typedef int is_chosen(const matrix_view *v, const ovoid_robot_matrix_pair *p, int which);

static size_t count_pairs(const matrix_view *v, is_chosen *choose, int which) {
    size_t count = 0;
    for (size_t i = 0; i < ovoid_robot_matrix_get_count(v->matrix); i++) {
        ovoid_robot_matrix_pair p = ovoid_robot_matrix_get_pair(v->matrix, i);
        count += choose(v, &p, which) != 0;
    }
    return count;
}

static int has_touch(const matrix_view *v, const ovoid_robot_matrix_pair *p, int which) {
    (void)v;
    return (int)p->touch == which;
}

static int has_finding(const matrix_view *v, const ovoid_robot_matrix_pair *p, int which) {
    return (int)matrix_find(v, p) == which;
}

static int find_width(const matrix_view *v) {
    int width = 4;
    for (size_t i = 0; i < v->description.link_count; i++) {
        int size = (int)strlen(v->description.links[i].name);
        if (size > width) width = size;
    }
    return width;
}

static void write_name(FILE *file, const matrix_view *v, uint32_t link, int width) {
    const char *name = v->description.links[link].name;
    message_write_text(file, name);
    fprintf(file, "%*s  ", width - (int)strlen(name), "");
}

static void write_pair(FILE *file, const matrix_view *v, const ovoid_robot_matrix_pair *p, int width) {
    write_name(file, v, p->a, width);
    write_name(file, v, p->b, width);
    fprintf(file, "%-14s  %-10s  ", ovoid_robot_touch_get_name(p->touch), p->is_neighbour ? "yes" : "");
    if (p->touch == OVOID_ROBOT_TOUCH_RIGID)
        fputs("       -        -\n", file);
    else
        fprintf(file, "%8zu %8zu\n", p->hits, p->cells);
}

static void write_pairs(FILE *file, const matrix_view *v, int width) {
    fprintf(file, "%-*s  %-*s  touch           neighbours      hits    cells\n", width, "link", width, "link");
    for (int touch = OVOID_ROBOT_TOUCH_OPEN; touch <= OVOID_ROBOT_TOUCH_RIGID; touch++)
        for (size_t i = 0; i < ovoid_robot_matrix_get_count(v->matrix); i++) {
            ovoid_robot_matrix_pair p = ovoid_robot_matrix_get_pair(v->matrix, i);
            if ((int)p.touch == touch) write_pair(file, v, &p, width);
        }
}

static void write_counts(FILE *file, const matrix_view *v) {
    size_t count = ovoid_robot_matrix_get_count(v->matrix), samples = 0;
    for (size_t i = 0; i < count; i++) {
        ovoid_robot_matrix_pair p = ovoid_robot_matrix_get_pair(v->matrix, i);
        if (p.samples > samples) samples = p.samples;
    }
    fprintf(file, "\npairs           %zu, of %zu samples\n", count, samples);
    for (int touch = OVOID_ROBOT_TOUCH_OPEN; touch <= OVOID_ROBOT_TOUCH_RIGID; touch++) {
        size_t of = count_pairs(v, has_touch, touch);
        if (of) fprintf(file, "%-14s  %zu\n", ovoid_robot_touch_get_name((ovoid_robot_touch)touch), of);
    }
}

// A state as joint names with their numbers; of a joint with several, each with its place among them.
static void write_state(FILE *file, const matrix_view *v, const double *q) {
    for (size_t i = 0; i < ovoid_robot_get_variable_count(v->robot); i++) {
        ovoid_robot_variable variable = ovoid_robot_get_variable(v->robot, i);
        const ovoid_robot_joint *joint = &v->description.joints[variable.joint];
        fputs(i ? " " : "    ", file);
        message_write_text(file, joint->name);
        if (ovoid_joint_type_get_variable_count(joint->type) > 1) fprintf(file, "[%u]", (unsigned)variable.component);
        fprintf(file, "=%.17g", q[i]);
    }
    fputc('\n', file);
}

static void write_finding(FILE *file, const matrix_view *v, matrix_finding finding, const char *title) {
    size_t count = count_pairs(v, has_finding, (int)finding);
    fprintf(file, "\n%s: %zu\n", title, count);
    for (size_t i = 0; i < ovoid_robot_matrix_get_count(v->matrix); i++) {
        ovoid_robot_matrix_pair p = ovoid_robot_matrix_get_pair(v->matrix, i);
        if (matrix_find(v, &p) != finding) continue;
        const char *given = matrix_get_given_reason(v, &p);
        fputs("  ", file);
        message_write_text(file, v->description.links[p.a].name);
        fputs(", ", file);
        message_write_text(file, v->description.links[p.b].name);
        fprintf(file, ": %s", ovoid_robot_touch_get_name(p.touch));
        if (given) {
            fputs(", the file says ", file);
            message_write_text(file, given[0] ? given : "nothing");
        }
        if (finding == FINDING_WRONG || finding == FINDING_NEIGHBOURS)
            fprintf(file, "; hit in %zu of %zu samples", p.hits, p.samples);
        fputc('\n', file);
        if (finding == FINDING_WRONG) write_state(file, v, p.hit);
    }
}

void matrix_write_text(FILE *file, const matrix_view *v) {
    write_pairs(file, v, find_width(v));
    write_counts(file, v);
    if (!v->has_srdf) return;
    write_finding(file, v, FINDING_WRONG, "disabled, but they can touch");
    write_finding(file, v, FINDING_NEIGHBOURS, "disabled neighbours that can touch");
    write_finding(file, v, FINDING_UNPROVEN, "disabled without proof; no sample shows otherwise");
    write_finding(file, v, FINDING_MISSING, "not disabled, but proven never or always to touch");
}
