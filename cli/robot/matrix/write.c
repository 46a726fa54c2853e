// The matrix as JSON and as an SRDF, and how it compares with the pairs of a given SRDF.
#include "robot/matrix/matrix.h"
#include "robot/xml_text.h"

#include "base/members.h"
#include "io/fields.h"

#include <string.h>

const char *matrix_get_given_reason(const matrix_view *v, const ovoid_robot_matrix_pair *pair) {
    for (size_t i = 0; v->has_srdf && i < v->description.disabled_count; i++) {
        const ovoid_robot_pair *d = &v->description.disabled[i];
        if (d->a == pair->a && d->b == pair->b) return d->reason ? d->reason : "";
    }
    return NULL;
}

matrix_finding matrix_find(const matrix_view *v, const ovoid_robot_matrix_pair *p) {
    int is_proven = p->touch == OVOID_ROBOT_TOUCH_NEVER || p->touch == OVOID_ROBOT_TOUCH_ALWAYS;
    if (!v->has_srdf || p->touch == OVOID_ROBOT_TOUCH_RIGID) return FINDING_NONE;
    if (!matrix_get_given_reason(v, p)) return is_proven ? FINDING_MISSING : FINDING_NONE;
    if (is_proven) return FINDING_NONE;
    if (p->is_neighbour) return p->touch == OVOID_ROBOT_TOUCH_SOMETIMES ? FINDING_NEIGHBOURS : FINDING_NONE;
    return p->touch == OVOID_ROBOT_TOUCH_SOMETIMES ? FINDING_WRONG : FINDING_UNPROVEN;
}

// ---- JSON

static void write_state(FILE *file, const matrix_view *v, const char *key, const double *q) {
    member_write_key(file, ",", key);
    if (!q) {
        fputs("null", file);
        return;
    }
    json_write_numbers(file, q, ovoid_robot_get_variable_count(v->robot));
}

static const char *get_finding_name(matrix_finding finding) {
    static const char *const names[] = {NULL, "wrongly disabled", "neighbours that touch", "disabled without proof",
                                        "missing"};
    return names[finding];
}

void matrix_write_json(FILE *file, const matrix_view *v) {
    const ovoid_robot_link *links = v->description.links;
    for (size_t i = 0; i < ovoid_robot_matrix_get_count(v->matrix); i++) {
        ovoid_robot_matrix_pair p = ovoid_robot_matrix_get_pair(v->matrix, i);
        member_write_text(file, "{", "a", links[p.a].name);
        member_write_text(file, ",", "b", links[p.b].name);
        member_write_text(file, ",", "touch", ovoid_robot_touch_get_name(p.touch));
        fprintf(file, ",\"neighbours\":%s", p.is_neighbour ? "true" : "false");
        fprintf(file, ",\"samples\":%zu,\"hits\":%zu,\"frees\":%zu,\"cells\":%zu", p.samples, p.hits, p.frees, p.cells);
        write_state(file, v, "hit", p.hit);
        write_state(file, v, "free", p.free);
        if (v->has_srdf) {
            member_write_text(file, ",", "given", matrix_get_given_reason(v, &p));
            member_write_text(file, ",", "finding", get_finding_name(matrix_find(v, &p)));
        }
        fputs("}\n", file);
    }
}

// ---- SRDF

void matrix_write_srdf(FILE *file, const matrix_view *v, int with_sampled) {
    const ovoid_robot_link *links = v->description.links;
    fputs("<?xml version=\"1.0\"?>\n<robot", file);
    xml_write_attribute(file, "name", v->description.name ? v->description.name : "");
    fputs(">\n", file);
    for (size_t i = 0; i < ovoid_robot_matrix_get_count(v->matrix); i++) {
        ovoid_robot_matrix_pair p = ovoid_robot_matrix_get_pair(v->matrix, i);
        const char *reason = ovoid_robot_matrix_pair_get_reason(&p, with_sampled);
        if (!reason) continue;
        fputs("  <disable_collisions", file);
        xml_write_attribute(file, "link1", links[p.a].name);
        xml_write_attribute(file, "link2", links[p.b].name);
        xml_write_attribute(file, "reason", reason);
        fputs("/>\n", file);
    }
    fputs("</robot>\n", file);
}
