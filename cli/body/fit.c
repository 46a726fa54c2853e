// ovoid fit: the offline steps of each mesh, one after another, each with its result and its time; .ovoid files.
#include "body/fit.h"

#include "base/finish.h"
#include "base/inputs.h"
#include "base/message.h"
#include "base/outputs.h"
#include "base/progress.h"
#include "commands.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef struct settings {
    read_settings read;
    const char *output; ///< a file, or a folder; NULL: none
    int parts, json, csv, table, phases, lean;
    double radius, outside, inside, gap;
} settings;

static const cli_option options[] = {
    {"output", 'o', OPTION_OUTPUT, offsetof(settings, output), "PATH", "ovoid",
     "write .ovoid files: PATH is the file for one body; with several meshes or --parts, or where it ends in \"/\" or "
     "is a folder, the folder of NAME.ovoid or NAME-PART.ovoid"},
    {"parts", 0, OPTION_FLAG, offsetof(settings, parts), NULL, NULL,
     "each object of a mesh file is a body of its own (default: the hull of the whole file)"},
    {"radius", 0, OPTION_LENGTH, offsetof(settings, radius), "R", NULL,
     "rounding radius around each body (default: 0)"},
    {"outside", 0, OPTION_LENGTH, offsetof(settings, outside), "L", NULL,
     "allowance: the true body stands out of what is fitted by at most L (default: 0)"},
    {"inside", 0, OPTION_LENGTH, offsetof(settings, inside), "L", NULL,
     "allowance: what is fitted stands out of the true body by at most L (default: 0)"},
    {"gap", 0, OPTION_SHARE, offsetof(settings, gap), "G", NULL,
     "relative volume gap of the outer and the inner ellipsoid, below 1 (default: 1e-6)"},
    {"phases", 0, OPTION_FLAG, offsetof(settings, phases), NULL, NULL,
     "the files hold the inner ellipsoid of the three phases (default: that of maximum volume)"},
    {"lean", 0, OPTION_FLAG, offsetof(settings, lean), NULL, NULL,
     "lean bodies, made in some 60 % of the time, whose answers are as true but take longer: the inner ellipsoid is "
     "that of the moments, --gap is 0.1 unless it is given, and there is no table of supports"},
    {"hull", 0, OPTION_FLAG, offsetof(settings, read.hull), NULL, NULL,
     "the hull stands for itself (default: where its mesh is so only nearly, \"inside\" has what keeps answers true of "
     "the mesh)"},
    INPUTS_OPTIONS(settings),
    {"table", 0, OPTION_FLAG, offsetof(settings, table), NULL, NULL,
     "one line a body, the ellipsoids' volumes relative to the body's (default: a report of each body)"},
    {"json", 0, OPTION_FLAG, offsetof(settings, json), NULL, NULL, "write JSON Lines, one object a body"},
    {"csv", 0, OPTION_FLAG, offsetof(settings, csv), NULL, NULL, "write CSV with a header line"},
    {0},
};

/// The state of a run.
typedef struct fit {
    const settings *settings;
    int is_folder, title_due;
    int failed;         ///< 1: some mesh was refused
    char **written;     ///< paths of the files made so far
    size_t write_count; ///< their number
} fit;

/* ---- where .ovoid files go ---- */

static int is_folder(const char *path) {
    struct stat info;
    size_t length = strlen(path);
    return (length && path[length - 1] == '/') || (stat(path, &info) == 0 && S_ISDIR(info.st_mode));
}

/// Appends the bytes of a text that a file name may hold; others become "_".
static void append_safe(char *name, size_t size, const char *text, size_t length) {
    size_t at = strlen(name);
    for (size_t i = 0; i < length && at + 1 < size; i++) {
        unsigned char c = (unsigned char)text[i];
        int safe = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_' ||
                   c == '.' || c >= 128;
        name[at++] = (char)(safe ? c : '_');
    }
    name[at] = 0;
}

static int is_written(const fit *f, const char *path) {
    for (size_t i = 0; i < f->write_count; i++)
        if (strcmp(f->written[i], path) == 0) return 1;
    return 0;
}

/// The path "FOLDER/NAME-PART.ovoid", with "-2" and so on where this run has written that already. NULL if memory is
/// out.
static char *make_path(const fit *f, const char *mesh, const char *part) {
    char name[200] = "";
    const char *folder = f->settings->output, *slash = strrchr(mesh, '/'), *base = slash ? slash + 1 : mesh;
    const char *dot = strrchr(base, '.');
    append_safe(name, sizeof name, base, dot && dot > base ? (size_t)(dot - base) : strlen(base));
    if (*part) append_safe(name, sizeof name, "-", 1);
    append_safe(name, sizeof name, part, strlen(part));
    size_t length = strlen(folder), size = length + sizeof name + 32;
    char *path = malloc(size);
    if (!path) return NULL;
    const char *separator = length && folder[length - 1] == '/' ? "" : "/";
    snprintf(path, size, "%s%s%s.ovoid", folder, separator, name);
    for (int i = 2; is_written(f, path); i++) snprintf(path, size, "%s%s%s-%d.ovoid", folder, separator, name, i);
    return path;
}

/// Writes the shape and adds the path to `written`. NULL after a message.
static const char *write_shape(fit *f, const ovoid_shape *shape, const char *mesh, const char *part) {
    ovoid_error error;
    char **list = realloc(f->written, (f->write_count + 1) * sizeof *list);
    if (list) f->written = list;
    char *path = !list ? NULL : f->is_folder ? make_path(f, mesh, part) : strdup(f->settings->output);
    if (!path) return message_error("out of memory"), NULL;
    finish_hold_signals();
    ovoid_code code = ovoid_shape_write_file(shape, path, &error);
    finish_release_signals();
    if (code != OVOID_OK) {
        message_error("%s", error.message);
        free(path);
        return NULL;
    }
    return f->written[f->write_count++] = path;
}

/// Makes the folder if the output is one. 0, or EXIT_INPUT after a message.
static int make_folder(const fit *f) {
    const char *path = f->settings->output;
    if (!path || !f->is_folder || mkdir(path, 0777) == 0 || errno == EEXIST) return 0;
    message_error("%s: %s", path, strerror(errno));
    return EXIT_INPUT;
}

/* ---- the steps ---- */

/// Volume, area of one side, or length.
static double get_measure(const ovoid_polytope *p, const ovoid_measures *measures) {
    if (p->rank == 3) return measures->volume;
    if (p->rank == 2) return measures->area / 2;
    if (p->rank == 0) return 0;
    // The ends are the two vertices that have a neighbor.
    const double *end[2] = {p->vertices, p->vertices};
    for (uint32_t i = 0, k = 0; i < p->vertex_count && k < 2; i++)
        if (p->neighbor_starts[i + 1] > p->neighbor_starts[i]) end[k++] = p->vertices + 3 * (size_t)i;
    return hypot(hypot(end[1][0] - end[0][0], end[1][1] - end[0][1]), end[1][2] - end[0][2]);
}

/// Runs the offline steps on the polytope, timing each. OVOID_OK or MEMORY.
static ovoid_code run_steps(const ovoid_polytope *p, double gap, fitted *out) {
    for (int i = 0; i < FIT_STEPS; i++) out->steps[i] = (ovoid_fit){.volume = NAN, .gap = NAN};
    double start = progress_get_seconds();
    ovoid_code code =
        ovoid_ellipsoid_compute_outer(p, &(ovoid_ellipsoid_options){.gap = gap}, &out->steps[FIT_OUTER], NULL);
    out->seconds[FIT_OUTER] = progress_get_seconds() - start;
    if (code != OVOID_OK) return code;
    // The paper's phases are for bodies of rank 3.
    static ovoid_fit (*const phases[])(const ovoid_polytope *, const ovoid_ellipsoid *) = {
        ovoid_ellipsoid_compute_shrunk, ovoid_ellipsoid_compute_stretched, ovoid_ellipsoid_compute_enlarged};
    for (int i = FIT_SHRUNK; i <= FIT_ENLARGED && p->rank == 3; i++) {
        start = progress_get_seconds();
        out->steps[i] = phases[i - FIT_SHRUNK](p, &out->steps[i - 1].ellipsoid);
        out->seconds[i] = progress_get_seconds() - start;
    }
    start = progress_get_seconds();
    code = ovoid_ellipsoid_compute_inner(p, &(ovoid_ellipsoid_options){.gap = gap}, &out->steps[FIT_INNER], NULL);
    out->seconds[FIT_INNER] = progress_get_seconds() - start;
    return code;
}

/// The ellipsoids of a lean shape are its own; no step is run.
static void take_ellipsoids(const ovoid_shape *shape, fitted *out) {
    for (int i = 0; i < FIT_STEPS; i++) out->steps[i] = (ovoid_fit){.volume = NAN, .gap = NAN};
    out->steps[FIT_OUTER] = ovoid_shape_get_outer(shape);
    out->steps[FIT_INNER] = ovoid_shape_get_inner(shape);
    if (isinf(out->steps[FIT_INNER].gap)) out->steps[FIT_INNER].gap = NAN; // of the moments' ellipsoid none is known
}

static void write_findings(fit *f, const fitted *found) {
    const settings *s = f->settings;
    if (f->title_due && s->csv) fit_write_csv_title(stdout);
    if (f->title_due && s->table) fit_write_table_title(stdout, inputs_get_unit(&s->read));
    f->title_due = 0;
    if (s->json)
        fit_write_json(stdout, found);
    else if (s->csv)
        fit_write_csv_row(stdout, found);
    else if (s->table)
        fit_write_table_row(stdout, found);
    else
        fit_write_report(stdout, found);
}

/// Runs all steps on a shape and writes its report. 0, or an exit code after a message.
static int fit_shape(fit *f, const ovoid_shape *shape, fitted *found) {
    ovoid_polytope polytope = ovoid_shape_get_polytope(shape);
    found->report = ovoid_shape_get_report(shape);
    found->is_lean = ovoid_shape_is_lean(shape);
    found->measures = ovoid_shape_get_measures(shape);
    found->radius = ovoid_shape_get_radius(shape);
    found->allowance = ovoid_shape_get_allowance(shape);
    found->triangles = polytope.triangle_count;
    found->facets = polytope.facet_count;
    found->measure = get_measure(&polytope, &found->measures);
    if (found->is_lean)
        take_ellipsoids(shape, found);
    else if (run_steps(&polytope, f->settings->gap, found) != OVOID_OK) {
        message_error("%s: out of memory", found->file);
        return EXIT_INPUT;
    }
    if (f->settings->output && !(found->output = write_shape(f, shape, found->file, found->name))) return EXIT_INPUT;
    write_findings(f, found);
    return finish_file(stdout);
}

static ovoid_shape_options make_options(const settings *s) {
    return (ovoid_shape_options){.radius = s->radius,
                                 .gap = s->gap,
                                 .inner = s->lean     ? OVOID_INNER_LEAN
                                          : s->phases ? OVOID_INNER_PHASES
                                                      : OVOID_INNER_MAXIMUM,
                                 .allowance = {.outside = s->outside, .inside = s->inside}};
}

/// Reports on a .ovoid file, without fitting it again.
static int fit_file(fit *f, const char *path) {
    ovoid_error error;
    ovoid_read_options read = inputs_make_options(&f->settings->read);
    ovoid_shape_options make = make_options(f->settings);
    if (make.inner != OVOID_INNER_MAXIMUM) {
        message_error("%s: --%s: a .ovoid file has its ellipsoids already; fit the mesh anew", path,
                      f->settings->lean ? "lean" : "phases");
        return f->failed = 1, 0;
    }
    fitted found = {.file = path,
                    .name = "",
                    .unit = inputs_get_unit(&f->settings->read),
                    .convexity = {.mesh_volume = NAN, .hull_volume = NAN}};
    double start = progress_get_seconds();
    ovoid_shape *shape = ovoid_shape_read_file(path, &read, &make, &error);
    if (!shape) return message_error("%s", error.message), f->failed = 1, 0;
    found.read_seconds = progress_get_seconds() - start;
    if (make.gap > 0 && ovoid_shape_is_lean(shape)) {
        message_error("%s: --gap: a lean body has its ellipsoids already; fit the mesh anew", path);
        ovoid_shape_destroy(shape);
        return f->failed = 1, 0;
    }
    int code = fit_shape(f, shape, &found);
    ovoid_shape_destroy(shape);
    return code;
}

/// Gives the hull of a nearly convex mesh its allowance; 0 if memory runs out.
static int allow(const fit *f, ovoid_shape **shape, fitted *found, ovoid_error *error) {
    if (f->settings->read.hull || f->settings->parts) found->convexity.allowance = 0;
    if (!(found->convexity.allowance > 0)) return 1;
    ovoid_allowance allowance = ovoid_shape_get_allowance(*shape);
    allowance.inside = nextafter(allowance.inside + found->convexity.allowance, INFINITY);
    ovoid_shape *allowed = ovoid_shape_create_allowed(*shape, &(ovoid_shape_options){.allowance = allowance}, error);
    if (!allowed) return 0;
    ovoid_shape_destroy(*shape);
    *shape = allowed;
    return 1;
}

/// Fits one part of a mesh. A refused one is reported, and the run goes on.
static int fit_part(fit *f, const char *path, const ovoid_mesh *mesh, size_t number, double read_seconds) {
    ovoid_error error;
    ovoid_mesh_part part = ovoid_mesh_get_part(mesh, number);
    ovoid_shape_options make = make_options(f->settings);
    char name[200] = "";
    if (f->settings->parts) snprintf(name, sizeof name, "%s", part.name);
    if (f->settings->parts && !*name) snprintf(name, sizeof name, "part %zu", number);
    fitted found = {
        .file = path, .name = name, .read_seconds = read_seconds, .unit = inputs_get_unit(&f->settings->read)};
    double start = progress_get_seconds();
    ovoid_shape *shape = ovoid_shape_create_from_points(part.faces.vertices, part.faces.vertex_count, &make, &error);
    if (!shape) {
        message_error("%s%s%s: %s", path, *name ? ": " : "", name, error.message);
        return f->failed = 1, 0;
    }
    found.make_seconds = progress_get_seconds() - start;
    found.report.faces = part.faces.face_count;
    if (ovoid_mesh_part_compute_convexity(&part, shape, &found.convexity, &error)) {
        message_error("%s: %s", path, error.message);
        ovoid_shape_destroy(shape);
        return f->failed = 1, 0;
    }
    if (!allow(f, &shape, &found, &error)) {
        message_error("%s: %s", path, error.message);
        ovoid_shape_destroy(shape);
        return f->failed = 1, 0;
    }
    if (f->settings->parts)
        inputs_warn_part(path, name, &found.convexity);
    else
        inputs_warn_file(path, &f->settings->read, &found.convexity);
    int code = fit_shape(f, shape, &found);
    ovoid_shape_destroy(shape);
    return code;
}

/// Fits one mesh file, or its parts. 0, also after a refused mesh, which is reported; or the exit code that ends the
/// run.
static int fit_mesh(fit *f, const char *path) {
    ovoid_error error;
    if (ovoid_path_is_shape(path)) return fit_file(f, path);
    ovoid_read_options read = inputs_make_options(&f->settings->read);
    read.parts = f->settings->parts;
    double start = progress_get_seconds();
    progress_read(path);
    ovoid_mesh *mesh = ovoid_mesh_read(path, &read, &error);
    progress_hide();
    if (!mesh) return message_error("%s", error.message), f->failed = 1, 0;
    double seconds = progress_get_seconds() - start;
    size_t count = ovoid_mesh_get_part_count(mesh);
    int code = 0;
    for (size_t i = 0; i < count && !code; i++) code = fit_part(f, path, mesh, i, seconds);
    ovoid_mesh_destroy(mesh);
    return code;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.read.unit = INPUTS_NO_UNIT};
    cli_operands paths;
    int code = command_parse(command, argc, argv, &s, &paths);
    if (code >= 0) return code;
    if (s.json + s.csv + s.table > 1)
        return args_complain(command, "fit: --json, --csv and --table exclude each other");
    if (s.phases && s.lean) return args_complain(command, "fit: --phases and --lean exclude each other");
    fit f = {.settings = &s, .title_due = 1};
    f.is_folder = s.output && (paths.count > 1 || s.parts || is_folder(s.output));
    if ((code = make_folder(&f)) != 0) return code;
    progress_start("meshes", (size_t)paths.count);
    for (int i = 0; i < paths.count && !code; i++) {
        code = fit_mesh(&f, paths.items[i]);
        progress_set((size_t)i + 1);
    }
    progress_end();
    for (size_t i = 0; i < f.write_count; i++) free(f.written[i]);
    free(f.written);
    return code ? code : f.failed ? EXIT_INPUT : EXIT_APART;
}

const cli_command command_fit = {
    .name = "fit",
    .summary = "the ellipsoids of meshes, step by step; makes .ovoid files",
    .usage = "[OPTION...] MESH...",
    .description =
        "For each mesh: what became of its points, the convex hull, and the offline steps with their volumes, "
        "radii, proven gaps and times: the smallest ellipsoid around it (outer), the three phases of Su, Liu and "
        "Chen (shrink, stretch, enlarge), and the largest ellipsoid inside it (inner). Each body gives a report; "
        "--table gives a line instead.\n\n"
        "A .ovoid file keeps the hull and the ellipsoids, so that other commands need not find them again. "
        "A bad mesh is named, the others are done all the same, and the exit code is 3; every file that is written "
        "is whole.",
    .exits = "0 done\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written",
    .examples = "ovoid fit bunny.obj\n"
                "ovoid fit --scale 0.001 -o link3.ovoid link3.stl\n"
                "ovoid fit --parts -o parts/ decomposed.obj\n"
                "ovoid fit --table *.stl\n"
                "ovoid fit --csv *.stl > fits.csv",
    .options = options,
    .operands_min = 1,
    .operands_max = -1,
    .run = run,
};
