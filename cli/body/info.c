// ovoid info: facts about meshes before any query: whether they are closed, their orientation, their components,
// duplicates, triangles without area, self-intersections; the share of its hull that each fills, and the kind as which
// it is queried.
#include "commands.h"

#include "base/finish.h"
#include "base/inputs.h"
#include "base/members.h"
#include "base/message.h"
#include "base/outputs.h"
#include "base/progress.h"
#include "pairs/solids.h"

#include <ovoid/ovoid.h>

#include <math.h>

/// The largest number of pairs of intersecting triangles that is counted.
#define CROSSINGS_MAX 1000000

typedef struct settings {
    read_settings read;
    int json;
} settings;

static const cli_option options[] = {
    {"json", 0, OPTION_FLAG, offsetof(settings, json), NULL, NULL, "write JSON Lines, one object a mesh"},
    INPUTS_OPTIONS(settings),
    {0},
};

/// The facts about one mesh.
typedef struct info {
    const char *path, *unit;
    ovoid_solid_report report;
    ovoid_solid_crossings crossings;
    ovoid_convexity convexity;
    ovoid_mesh_kind kind; ///< the kind as which ovoid distance queries it
} info;

static int is_inside_out(const info *report) { return report->report.is_closed && report->report.volume < 0; }

/// 1 if the mesh has no faults.
static int is_clean(const info *report) {
    const ovoid_solid_report *r = &report->report;
    return r->is_closed && r->volume > 0 && !r->edges_crowded && !r->degenerate && !r->duplicates &&
           !report->crossings.pairs;
}

/// Reads a mesh. 0 after a message.
static int read_mesh(const char *path, const settings *s, info *report) {
    cli_body body;
    read_settings read = s->read;
    read.solid = 1;
    *report = (info){.path = path, .unit = inputs_get_unit(&s->read)};
    if (ovoid_path_is_shape(path)) {
        message_error("%s is a shape, not a mesh: ovoid fit tells about it", path);
        return 0;
    }
    if (inputs_open_body(path, &read, 0, &body)) return 0;
    ovoid_named_shape mesh = ovoid_shapes_get(body.parts, 0);
    report->convexity = mesh.convexity;
    report->kind = mesh.convexity.kind;
    report->report = ovoid_solid_get_report(mesh.solid);
    report->crossings = ovoid_solid_compute_crossings(mesh.solid, CROSSINGS_MAX);
    inputs_close_body(&body);
    return 1;
}

// ---- for people

static void print_count(const char *title, uint64_t count, const char *what) {
    if (count) printf("  %-11s %llu%s\n", title, (unsigned long long)count, what);
}

static void print_crossings(const info *report) {
    const ovoid_solid_crossings *c = &report->crossings;
    if (!c->pairs) return;
    printf("  %-11s %llu%s pairs of triangles; the first: %lu and %lu\n", "crossings", (unsigned long long)c->pairs,
           c->is_complete ? "" : " and more", (unsigned long)c->triangle_a, (unsigned long)c->triangle_b);
}

static void print_volumes(const info *report) {
    const ovoid_solid_report *r = &report->report;
    char unit[8] = "";
    if (report->unit[0]) snprintf(unit, sizeof unit, " %s^3", report->unit);
    if (r->is_closed) printf("  %-11s %.6g%s\n", "volume", r->volume, unit);
    printf("  %-11s %.6g%s", "hull", report->convexity.hull_volume, unit);
    if (r->is_closed && report->convexity.hull_volume > 0)
        printf("; filled to %.4g %%", 100 * fabs(r->volume) / report->convexity.hull_volume);
    putchar('\n');
}

static void print_info(const info *report) {
    const ovoid_solid_report *r = &report->report;
    message_write_text(stdout, report->path);
    printf("\n  %-11s %llu; points: %llu; components: %llu\n", "triangles", (unsigned long long)r->triangles,
           (unsigned long long)r->points, (unsigned long long)r->components);
    if (r->is_closed)
        printf("  %-11s yes%s\n", "closed", is_inside_out(report) ? "; inside out" : "");
    else
        printf("  %-11s no: %llu edges are not matched\n", "closed", (unsigned long long)r->edges_unmatched);
    print_volumes(report);
    if (r->is_flat) puts("  flat        encloses no volume but what rounding left: a sheet with two sides");
    print_count("crowded", r->edges_crowded, " edges of more than two triangles");
    print_count("degenerate", r->degenerate, " triangles without area");
    print_count("duplicates", r->duplicates, " triangles that are there before");
    print_crossings(report);
    printf("  %-11s %s", "counts as", ovoid_mesh_kind_get_name(report->kind));
    double allowance = report->kind == OVOID_MESH_HULL ? report->convexity.allowance : 0;
    if (allowance > 0)
        printf(", off the mesh by at most %.2g%s%s: answers allow for it", allowance, *report->unit ? " " : "",
               report->unit);
    if (report->kind == OVOID_MESH_HULL && !(allowance > 0)) fputs(", which it is exactly", stdout);
    if (report->kind == OVOID_MESH_SURFACE)
        printf(", without an inside: %llu edges are open", (unsigned long long)r->edges_unmatched);
    putchar('\n');
}

// ---- for programs

static void write_count(const char *key, uint64_t count) { printf(",\"%s\":%llu", key, (unsigned long long)count); }

static void write_json(const info *report) {
    const ovoid_solid_report *r = &report->report;
    member_write_text(stdout, "{", "mesh", report->path);
    write_count("triangles", r->triangles);
    write_count("points", r->points);
    write_count("components", r->components);
    printf(",\"closed\":%s,\"inside_out\":%s", r->is_closed ? "true" : "false",
           is_inside_out(report) ? "true" : "false");
    write_count("edges_unmatched", r->edges_unmatched);
    write_count("edges_crowded", r->edges_crowded);
    write_count("degenerate", r->degenerate);
    write_count("duplicates", r->duplicates);
    write_count("crossings", report->crossings.pairs);
    printf(",\"crossings_complete\":%s,\"first_crossing\":", report->crossings.is_complete ? "true" : "false");
    if (report->crossings.pairs)
        printf("[%lu,%lu]", (unsigned long)report->crossings.triangle_a, (unsigned long)report->crossings.triangle_b);
    else
        fputs("null", stdout);
    member_write_number(stdout, ",", "volume", r->is_closed ? r->volume : NAN);
    printf(",\"flat\":%s", r->is_flat ? "true" : "false");
    member_write_number(stdout, ",", "area", r->area);
    member_write_number(stdout, ",", "mesh_volume", report->convexity.mesh_volume);
    member_write_number(stdout, ",", "hull_volume", report->convexity.hull_volume);
    printf(",\"kind\":\"%s\"", ovoid_mesh_kind_get_name(report->kind));
    member_write_number(stdout, ",", "allowance", report->kind == OVOID_MESH_HULL ? report->convexity.allowance : 0);
    fputs("}\n", stdout);
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.read.unit = INPUTS_NO_UNIT};
    cli_operands paths;
    int code = command_parse(command, argc, argv, &s, &paths), failed = 0, faults = 0;
    if (code >= 0) return code;
    progress_start("meshes", (size_t)paths.count);
    for (int i = 0; i < paths.count; i++) {
        info report;
        int is_read = read_mesh(paths.items[i], &s, &report);
        failed |= !is_read;
        faults |= is_read && !is_clean(&report);
        if (is_read) (s.json ? write_json : print_info)(&report);
        progress_set((size_t)i + 1);
    }
    progress_end();
    code = finish_file(stdout);
    return code ? code : failed ? EXIT_INPUT : faults ? EXIT_TOUCH : EXIT_APART;
}

const cli_command command_info = {
    .name = "info",
    .summary = "what meshes are: closed, which way round, crossing themselves",
    .usage = "[OPTION...] MESH...",
    .description =
        "For each mesh: triangles, points and components; whether it is closed (each edge is run through as often in "
        "one direction as in the other) or inside out; its volume and that of its convex hull; edges of more than two "
        "triangles, triangles without area or there twice; and the pairs of triangles that meet other than in common "
        "corners and edges, by exact arithmetic, counted up to a million. Last, as what \"ovoid distance\" takes it: "
        "its hull, exactly or with an allowance, a solid, or, where it is open, a surface; --solid and --hull choose "
        "there.\n\n"
        "A bad mesh is named, the others are done all the same, and the exit code is 3.",
    .exits = "0 each mesh is closed, the right way round, and nothing of the above is found\n"
             "1 something is\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written",
    .examples = "ovoid info ring.stl\n"
                "ovoid info --json *.stl | jq -r 'select(.crossings > 0).mesh'",
    .options = options,
    .operands_min = 1,
    .operands_max = -1,
    .run = run,
};
