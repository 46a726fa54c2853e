// ovoid distance: the signed distance of one pair, with its bracket, witness points and proof.
#include "commands.h"

#include "base/inputs.h"
#include "base/message.h"
#include "base/outputs.h"
#include "contacts.h"
#include "pairs/answers.h"
#include "pairs/solids.h"
#include "results.h"

#include <ovoid/ovoid.h>

#include <math.h>
#include <string.h>

typedef struct settings {
    read_settings read;
    output_settings out;
    ovoid_pose pose_a, pose_b;
    double margin, tolerance; ///< margin negative: not given
    solids_choice choice;
    contacts_settings contacts;
} settings;

static const cli_option options[] = {
    {"pose-a", 0, OPTION_POSE, offsetof(settings, pose_a), ARGS_POSE, NULL,
     "pose of A" ARGS_POSE_HELP " (default: \"0 0 0\")"},
    {"pose-b", 0, OPTION_POSE, offsetof(settings, pose_b), ARGS_POSE, NULL, "pose of B"},
    SOLIDS_OPTIONS(settings,
                   "A and B are compounds: each object of their files is a convex part; the nearest parts are named"),
    {"margin", 0, OPTION_LENGTH, offsetof(settings, margin), "M", NULL,
     "also ask whether the bodies are within M of each other: exit code 1 if they are"},
    {"tol", 0, OPTION_LENGTH, offsetof(settings, tolerance), "T", NULL,
     "stop when the bracket is at most T wide, or 1e-9 of the pair's size (default: the latter alone)"},
    CONTACTS_OPTIONS(settings),
    INPUTS_OPTIONS(settings),
    RESULTS_OPTIONS(settings),
    {0},
};

/// The file of the report, and the unit of its lengths with a blank before it, or "".
typedef struct report {
    FILE *file;
    char unit[8];
} report;

static void print_vector(const report *r, const char *title, ovoid_vec3 v, const char *unit) {
    fprintf(r->file, "%-11s %.9g %.9g %.9g%s\n", title, v.x, v.y, v.z, unit);
}

static void print_name(FILE *file, const char *title, const char *name) {
    fprintf(file, "%-11s ", title);
    message_write_text(file, name);
}

static int has_axis(const ovoid_allowance *allowance) {
    return fabs(allowance->axis.x) + fabs(allowance->axis.y) + fabs(allowance->axis.z) > 0;
}

static void print_allowance(const report *r, const char *title, const ovoid_allowance *allowance) {
    if (allowance->outside > 0 || allowance->inside > 0)
        fprintf(r->file, "; %s: %.9g%s outside, %.9g%s inside", title, allowance->outside, r->unit, allowance->inside,
                r->unit);
    const ovoid_vec3 axis = allowance->axis;
    if (has_axis(allowance)) fprintf(r->file, ", outside across (%.9g, %.9g, %.9g) only", axis.x, axis.y, axis.z);
}

/// The largest allowances of the parts of a file.
static ovoid_allowance find_allowance(const ovoid_shapes *parts) {
    ovoid_allowance most = {0};
    for (size_t i = 0; i < ovoid_shapes_get_count(parts); i++) {
        ovoid_allowance one = ovoid_shape_get_allowance(ovoid_shapes_get(parts, i).shape);
        most.outside = fmax(most.outside, one.outside);
        most.inside = fmax(most.inside, one.inside);
    }
    return most;
}

static void print_shape(const report *r, const char *title, const char *path, const cli_body *body) {
    const ovoid_shape *shape = body->shape;
    ovoid_convexity mesh = ovoid_shapes_get(body->parts, 0).convexity;
    unsigned long long vertices = ovoid_shape_get_report(shape).vertices;
    double radius = ovoid_shape_get_radius(shape);
    int are_points = !ovoid_path_is_shape(path) && mesh.kind == OVOID_MESH_HULL && isnan(mesh.mesh_volume);
    print_name(r->file, title, path);
    fprintf(r->file, "; %svertices: %llu", are_points ? "hull of points, " : "", vertices);
    ovoid_allowance allowance = ovoid_shape_get_allowance(shape);
    if (radius > 0) fprintf(r->file, "; radius: %.9g%s", radius, r->unit);
    print_allowance(r, "allowance", &allowance);
    fputc('\n', r->file);
}

static void print_body(const report *r, const char *title, const char *path, const cli_body *body) {
    if (body->shape)
        print_shape(r, title, path, body);
    else {
        print_name(r->file, title, path);
        fprintf(r->file, "; parts: %zu", ovoid_shapes_get_count(body->parts));
        ovoid_allowance most = find_allowance(body->parts);
        print_allowance(r, "allowance up to", &most);
        fputc('\n', r->file);
    }
}

/// Prints the number of a part, and its name in the file.
static void print_part(FILE *file, const char *title, const cli_body *body, uint32_t part) {
    if (body->shape) return;
    fprintf(file, "%-11s %lu; ", title, (unsigned long)part);
    message_write_text(file, ovoid_shapes_get(body->parts, part).name);
    fputc('\n', file);
}

/// Prints whether the bodies are within the margin.
static void print_margin(const report *r, const ovoid_answer *answer, double margin) {
    int within = ovoid_answer_is_within(answer, margin);
    const char *words = within > 0                          ? "within"
                        : within == 0                       ? "farther"
                        : answer->limit == OVOID_LIMIT_NONE ? "exactly there, as far as the bracket tells"
                                                            : "not proven";
    fprintf(r->file, "%-11s %.9g%s: %s\n", "margin", margin, r->unit, words);
}

/// Prints the distance or the depth; for a wide bracket both ends.
static void print_distance(const report *r, const ovoid_answer *answer) {
    char text[64];
    int is_depth = answer->upper < 0;
    ovoid_answer shown = *answer;
    if (is_depth) shown.lower = -answer->upper, shown.upper = -answer->lower;
    (void)ovoid_answer_write_distance(text, &shown);
    double middle = shown.lower + (shown.upper - shown.lower) / 2;
    if (!strstr(text, " .. ")) snprintf(text, sizeof text, "%.9g", fabs(middle));
    if (isfinite(middle)) fprintf(r->file, "%-11s %s%s\n", is_depth ? "depth" : "distance", text, r->unit);
}

/// Prints the report for people: bodies, distance, proof.
static void print_report(const report *r, const cli_body bodies[2], const ovoid_record *record, int holds) {
    FILE *file = r->file;
    const ovoid_answer *answer = &record->answer;
    print_body(r, "a", record->a, &bodies[0]);
    print_body(r, "b", record->b, &bodies[1]);
    fprintf(file, "%-11s %s\n", "status", ovoid_status_get_name(answer->status));
    print_distance(r, answer);
    fprintf(file, "%-11s %.17g .. %.17g%s\n", "bracket", answer->lower, answer->upper, r->unit);
    if (record->margin >= 0) print_margin(r, answer, record->margin);
    print_part(file, "part of a", &bodies[0], record->part_a);
    print_part(file, "part of b", &bodies[1], record->part_b);
    print_vector(r, "point on a", answer->point_a, r->unit);
    print_vector(r, "point on b", answer->point_b, r->unit);
    print_vector(r, "normal", answer->normal, "");
    fprintf(file, "%-11s %s; iterations: %u", "decided by", ovoid_stage_get_name(answer->stage),
            (unsigned)answer->iterations);
    if (answer->limit != OVOID_LIMIT_NONE) fprintf(file, "; stopped by: %s", ovoid_limit_get_name(answer->limit));
    fprintf(file, "\n%-11s %s; ", "proof", ovoid_proof_kind_get_name(answer->proof.kind));
    if (bodies[0].compound) fprintf(file, "exclusions: %zu; ", record->exclusion_count);
    fprintf(file, "%s\n", holds ? "checked" : "DOES NOT HOLD");
    (void)ovoid_record_write_contacts(file, record);
}

/// Verifies a record by its proof alone, and its contacts by theirs.
static int verify_record(const ovoid_body_pair *pair, const ovoid_record *record, double tolerance) {
    ovoid_error error;
    const ovoid_options asked = {.absolute_tolerance = tolerance};
    ovoid_body_answer answer = ovoid_body_answer_make(&record->answer, pair->a.compound ? record->part_a : 0,
                                                      pair->b.compound ? record->part_b : 0);
    ovoid_exclusions exclusions = {.items = (ovoid_exclusion *)record->exclusions,
                                   .capacity = record->exclusion_count,
                                   .count = record->exclusion_count,
                                   .cover = (ovoid_cover *)record->cover};
    ovoid_code code =
        ovoid_body_verify(pair, &answer, &(ovoid_body_basis){.options = &asked, .exclusions = &exclusions}, &error);
    if (code == OVOID_OK && record->contact_angle > 0) code = contacts_verify(pair, record, tolerance, &error);
    if (code == OVOID_OK) return 1;
    message_error("the proof does not hold: %s", error.message);
    return 0;
}

/// Answers the pair, verifies the proof, writes the record. Returns the exit code.
static int answer_pair(const settings *s, const cli_body bodies[2], const char *const paths[2]) {
    ovoid_body_pair pair = {inputs_get_body(&bodies[0], &s->pose_a), inputs_get_body(&bodies[1], &s->pose_b)};
    const ovoid_manifold_options contacts = contacts_make_options(&s->contacts, s->margin, s->tolerance);
    const answers_query query = {.query = QUERY_DISTANCE,
                                 .margin = s->margin,
                                 .tolerance = s->tolerance,
                                 .wants_proof = 1,
                                 .contacts = s->contacts.wanted ? &contacts : NULL};
    answer_room room = {.cover = {.memory = NULL}};
    cli_results results;
    ovoid_record record = {.a = paths[0], .b = paths[1], .margin = s->margin};
    if (!answers_find(&room, &pair, &query, &record)) {
        message_error("out of memory");
        answer_room_clear(&room);
        return EXIT_INPUT;
    }
    int holds = verify_record(&pair, &record, s->tolerance);
    int code = holds ? (int)results_judge(&record.answer, s->margin) : EXIT_NOT_PROVEN;
    const char *unit = inputs_get_unit(&s->read);
    solids_describe_bodies(bodies, &record);
    unsigned fields = record.fields | OVOID_RECORD_PARTS | (s->margin >= 0 ? OVOID_RECORD_MARGIN : 0) |
                      (s->contacts.wanted ? OVOID_RECORD_CONTACTS : 0);
    if (results_open(&results, &s->out, fields, unit)) {
        contacts_clear(&record);
        answer_room_clear(&room);
        return EXIT_INPUT;
    }
    record.fields = results.fields;
    report text = {.file = results.file};
    snprintf(text.unit, sizeof text.unit, "%s%s", unit[0] ? " " : "", unit);
    if (results_are_lines(&results))
        code = results_add(&results, &record) ? EXIT_INPUT : code;
    else
        print_report(&text, bodies, &record, holds);
    contacts_clear(&record);
    answer_room_clear(&room);
    return results_close(&results, code);
}

/// Answers as solids if one of the bodies is a solid: the exit code, or -1 if none is.
static int answer_solids(const settings *s, const cli_body bodies[2], const char *const paths[2]) {
    const ovoid_pose poses[2] = {s->pose_a, s->pose_b};
    const ovoid_manifold_options contacts = contacts_make_options(&s->contacts, s->margin, s->tolerance);
    solids_query query = {s->margin, s->tolerance, inputs_get_unit(&s->read), s->contacts.wanted ? &contacts : NULL};
    solids_pair pair;
    return solids_make_pair(paths, bodies, poses, &pair) ? solids_answer(&pair, &query, &s->out) : -1;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.read.unit = INPUTS_NO_UNIT,
                  .pose_a = ovoid_pose_make_identity(),
                  .pose_b = ovoid_pose_make_identity(),
                  .margin = -1};
    cli_operands paths;
    cli_body bodies[2];
    int code = command_parse(command, argc, argv, &s, &paths);
    if (code < 0) code = results_settle(command, &s.out);
    if (code < 0) code = solids_settle(command, &s.choice);
    if (code < 0) code = contacts_settle(command, &s.contacts);
    if (code >= 0) return code;
    s.read = solids_get_read(&s.read, &s.choice);
    if ((code = inputs_open_pair(paths.items, &s.read, s.choice.parts, bodies)) != 0) return code;
    code = answer_solids(&s, bodies, paths.items);
    if (code < 0) {
        inputs_warn_bodies(paths.items, bodies, 2, &s.read);
        code = answer_pair(&s, bodies, paths.items);
    }
    inputs_close_body(&bodies[0]);
    inputs_close_body(&bodies[1]);
    return code;
}

const cli_command command_distance = {
    .name = "distance",
    .summary = "the signed distance of two bodies, with its proof",
    .usage = "[OPTION...] A B",
    .description =
        "The signed distance of two bodies: positive where they are apart, minus the depth where they "
        "overlap. The answer is a bracket, lower <= d <= upper, rounding included, with witness points, a normal "
        "from A to B, and a proof, which is checked before it is written.\n\n"
        "A and B are meshes (STL, OBJ, OFF, PLY; COLLADA, glTF and more with Assimp), or .ovoid files. A closed "
        "mesh that is convex is its hull, any other the solid that its triangles enclose; an open one is its surface, "
        "which has no inside and no depth. --solid and --hull choose. A mesh that is convex but for rounding is its "
        "hull with an allowance, so that the bracket is true of the mesh. The depth of overlapping solids is a bracket "
        "that is true, but wide. With --parts, "
        "they are compounds of convex parts, as CoACD and V-HACD write them: "
        "d is then the smallest signed distance of a part of A and a part of B, and the proof also says why no "
        "other two are nearer.",
    .exits = "0 apart (with --margin: farther than M)\n"
             "1 touching or overlapping (with --margin: within M)\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written\n"
             "4 the sign (with --margin: the side of M) is not proven",
    .examples = "ovoid distance a.stl b.obj --pose-b \"0 0 1.5\"\n"
                "ovoid distance a.ovoid b.ovoid --margin 0.05 || echo too near\n"
                "ovoid distance a.ovoid b.ovoid --margin 0.001 --contacts\n"
                "ovoid distance peg.stl ring.stl --unit mm\n"
                "ovoid distance part.stl tool.stl --unit mm --json\n"
                "ovoid distance chair.obj lamp.obj --parts --pose-b \"0.4 0 0 1 0 0 0\"",
    .options = options,
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
