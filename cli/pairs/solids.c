// Pairs with at least one solid: reading them, the answer and its report.
#include "pairs/solids.h"

#include "base/message.h"
#include "contacts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- pairs

int solids_settle(const cli_command *command, const solids_choice *choice) {
    if (choice->parts + choice->solid + choice->hull <= 1) return -1;
    return args_complain(command, "%s: --parts, --solid and --hull exclude each other", command->name);
}

static ovoid_convexity get_convexity(const cli_body *body) { return ovoid_shapes_get(body->parts, 0).convexity; }

void solids_warn_flat(const char *path, const ovoid_solid *solid) {
    ovoid_solid_report r = ovoid_solid_get_report(solid);
    if (!r.is_flat) return;
    message_warning("%s encloses no volume but what rounding left, %.3g: it is a sheet with two sides, and counts as a "
                    "solid that has no inside",
                    path, r.volume);
}

read_settings solids_get_read(const read_settings *read, const solids_choice *choice) {
    read_settings settings = *read;
    settings.hull = choice->hull;
    settings.solid = choice->solid;
    return settings;
}

const ovoid_solid *solids_get(const char *path, const cli_body *body) {
    const ovoid_solid *solid = body->compound ? NULL : ovoid_shapes_get(body->parts, 0).solid;
    if (!solid) return NULL;
    ovoid_solid_report r = ovoid_solid_get_report(solid);
    if (!r.is_closed) inputs_warn_surface(path, r.edges_unmatched);
    solids_warn_flat(path, solid);
    return solid;
}

int solids_make_pair(const char *const *paths, const cli_body bodies[2], const ovoid_pose poses[2], solids_pair *p) {
    *p = (solids_pair){.paths = paths};
    ovoid_body *own[2] = {&p->pair.a, &p->pair.b};
    for (int i = 0; i < 2; i++) {
        p->solids[i] = solids_get(paths[i], &bodies[i]);
        *own[i] = (ovoid_body){.shape = p->solids[i] ? NULL : bodies[i].shape, .pose = poses[i], .solid = p->solids[i]};
        p->convexity[i] = get_convexity(&bodies[i]);
    }
    return (p->solids[0] != NULL) + (p->solids[1] != NULL);
}

ovoid_mesh_kind solids_get_kind(const ovoid_solid *solid) {
    if (!solid) return OVOID_MESH_HULL;
    return ovoid_solid_get_report(solid).is_closed ? OVOID_MESH_SOLID : OVOID_MESH_SURFACE;
}

void solids_describe(const solids_pair *p, ovoid_record *record) {
    record->fields |= OVOID_RECORD_MESHES;
    record->kind_a = solids_get_kind(p->solids[0]);
    record->kind_b = solids_get_kind(p->solids[1]);
    record->mesh_a = p->convexity[0];
    record->mesh_b = p->convexity[1];
}

/// The volumes of all parts of a file.
static ovoid_convexity sum_convexity(const cli_body *body) {
    ovoid_convexity sum = get_convexity(body);
    for (size_t i = 1; i < ovoid_shapes_get_count(body->parts); i++) {
        ovoid_convexity c = ovoid_shapes_get(body->parts, i).convexity;
        sum.mesh_volume += c.mesh_volume;
        sum.hull_volume += c.hull_volume;
        if (c.kind > sum.kind) sum.kind = c.kind;
    }
    return sum;
}

void solids_describe_bodies(const cli_body bodies[2], ovoid_record *record) {
    record->mesh_a = sum_convexity(&bodies[0]);
    record->mesh_b = sum_convexity(&bodies[1]);
    record->kind_a = bodies[0].compound ? OVOID_MESH_PARTS : OVOID_MESH_HULL;
    record->kind_b = bodies[1].compound ? OVOID_MESH_PARTS : OVOID_MESH_HULL;
    if (record->mesh_a.kind || record->mesh_b.kind) record->fields |= OVOID_RECORD_MESHES;
}

// ---- the answer

/// An answer with its proof, and whether the proof holds.
typedef struct solids_result {
    ovoid_body_answer answer;
    ovoid_exclusions exclusions;
    int holds;
} solids_result;

static int find_answer(const solids_pair *p, const solids_query *q, solids_result *r) {
    ovoid_options options = {.absolute_tolerance = q->tolerance};
    ovoid_error error;
    r->answer = ovoid_body_distance(&p->pair, &options, &(ovoid_body_evidence){.exclusions = &r->exclusions});
    if (r->exclusions.count > r->exclusions.capacity) return 0;
    r->holds =
        ovoid_body_verify(&p->pair, &r->answer, &(ovoid_body_basis){.options = &options, .exclusions = &r->exclusions},
                          &error) == OVOID_OK;
    if (!r->holds) message_error("the proof does not hold: %s", error.message);
    return 1;
}

/// The record of the answer, with its contacts. 0 if memory runs out.
static int make_record(const solids_pair *p, const solids_query *q, const solids_result *r, ovoid_record *record) {
    *record = (ovoid_record){.a = p->paths[0], .b = p->paths[1], .margin = q->margin};
    ovoid_record_set_solid(record, &r->answer);
    solids_describe(p, record);
    record->exclusions = r->exclusions.items;
    record->exclusion_count = r->exclusions.count;
    return !q->contacts || contacts_find(&p->pair, q->contacts, record);
}

// ---- for people

static void print_body(FILE *file, const char *title, const solids_pair *p, int side, const char *unit) {
    const ovoid_body *body = side ? &p->pair.b : &p->pair.a;
    fprintf(file, "%-11s ", title);
    message_write_text(file, p->paths[side]);
    if (body->solid) {
        ovoid_solid_report r = ovoid_solid_get_report(body->solid);
        fprintf(file, "; %s, triangles: %llu; components: %llu", r.is_closed ? "solid" : "surface",
                (unsigned long long)r.triangles, (unsigned long long)r.components);
        if (r.is_closed) fprintf(file, "; volume: %.6g", fabs(r.volume));
    } else {
        fprintf(file, "; hull, vertices: %llu", (unsigned long long)ovoid_shape_get_report(body->shape).vertices);
        double allowance = p->convexity[side].allowance;
        if (allowance > 0) fprintf(file, "; off its mesh by at most %.2g%s%s", allowance, *unit ? " " : "", unit);
    }
    fputc('\n', file);
}

static void print_vector(FILE *file, const char *title, ovoid_vec3 v, const char *unit) {
    fprintf(file, "%-11s %.9g %.9g %.9g%s\n", title, v.x, v.y, v.z, unit);
}

static void print_margin(FILE *file, const solids_query *q, const ovoid_body_answer *found, const char *unit) {
    int within = ovoid_body_answer_is_within(found, q->margin);
    const char *word = within > 0 ? "yes" : within == 0 ? "no" : found->limit == OVOID_LIMIT_NONE ? "at" : "unproven";
    fprintf(file, "%-11s %.9g%s: within: %s\n", "margin", q->margin, unit, word);
}

// Explains why there is no depth.
static void print_surfaces(FILE *file, const solids_pair *p) {
    int a = solids_get_kind(p->solids[0]) == OVOID_MESH_SURFACE,
        b = solids_get_kind(p->solids[1]) == OVOID_MESH_SURFACE;
    if (a || b)
        fprintf(file, "%-11s %s, without an inside: they cross, and the bracket is that of the crossing\n", "no depth",
                a && b ? "a and b are surfaces"
                : a    ? "a is a surface"
                       : "b is a surface");
}

static void print_report(FILE *file, const solids_pair *p, const solids_query *q, const solids_result *r) {
    const ovoid_body_answer *found = &r->answer;
    char unit[8], text[64];
    snprintf(unit, sizeof unit, "%s%s", q->unit[0] ? " " : "", q->unit);
    print_body(file, "a", p, 0, q->unit);
    print_body(file, "b", p, 1, q->unit);
    fprintf(file, "%-11s %s\n", "status", ovoid_status_get_name(found->status));
    ovoid_answer shown = {.status = found->status, .lower = found->lower, .upper = found->upper};
    int is_depth = found->upper < 0 && solids_get_kind(p->solids[0]) != OVOID_MESH_SURFACE &&
                   solids_get_kind(p->solids[1]) != OVOID_MESH_SURFACE;
    if (is_depth) shown.lower = -found->upper, shown.upper = -found->lower;
    (void)ovoid_answer_write_distance(text, &shown);
    fprintf(file, "%-11s %s%s\n", is_depth ? "depth" : "distance", text, unit);
    fprintf(file, "%-11s %.17g .. %.17g%s\n", "bracket", found->lower, found->upper, unit);
    if (q->margin >= 0) print_margin(file, q, found, unit);
    if (p->solids[0]) fprintf(file, "%-11s %u of a\n", "triangle", (unsigned)found->part_a);
    if (p->solids[1]) fprintf(file, "%-11s %u of b\n", "triangle", (unsigned)found->part_b);
    if (found->inside == OVOID_BODY_COMMON_POINT)
        print_vector(file, "common", found->common, unit);
    else if (found->inside)
        fprintf(file, "%-11s %s\n", "inside", found->inside == OVOID_BODY_A_INSIDE ? "a in b" : "b in a");
    if (found->status == OVOID_OVERLAPPING) print_surfaces(file, p);
    print_vector(file, "point on a", found->deciding.point_a, unit);
    print_vector(file, "point on b", found->deciding.point_b, unit);
    print_vector(file, "normal", found->deciding.normal, "");
    if (found->limit != OVOID_LIMIT_NONE) fprintf(file, "%-11s %s\n", "stopped by", ovoid_limit_get_name(found->limit));
    fprintf(file, "%-11s %s; exclusions: %zu; %s\n", "proof", ovoid_proof_kind_get_name(found->deciding.proof.kind),
            r->exclusions.count, r->holds ? "checked" : "DOES NOT HOLD");
}

int solids_answer(const solids_pair *p, const solids_query *q, const output_settings *out) {
    solids_result r = {.exclusions.grows = 1};
    cli_results results;
    ovoid_record record;
    if (!find_answer(p, q, &r) || !make_record(p, q, &r, &record)) {
        message_error("out of memory");
        ovoid_exclusions_release(&r.exclusions);
        return EXIT_INPUT;
    }
    unsigned fields = OVOID_RECORD_MESHES | OVOID_RECORD_SOLIDS | (q->margin >= 0 ? OVOID_RECORD_MARGIN : 0) |
                      (q->contacts ? OVOID_RECORD_CONTACTS : 0);
    int code = r.holds ? (int)results_judge(&record.answer, q->margin) : EXIT_NOT_PROVEN;
    if (results_open(&results, out, fields, q->unit))
        code = EXIT_INPUT;
    else {
        record.fields = results.fields;
        if (results_are_lines(&results))
            code = results_add(&results, &record) ? EXIT_INPUT : code;
        else {
            print_report(results.file, p, q, &r);
            (void)ovoid_record_write_contacts(results.file, &record);
        }
        code = results_close(&results, code);
    }
    contacts_clear(&record);
    ovoid_exclusions_release(&r.exclusions);
    return code;
}
