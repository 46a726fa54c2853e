// ovoid decompose: convex parts of a closed mesh, computed or given; the proven error of the parts.
#include "body/decompose.h"

#include "base/finish.h"
#include "base/inputs.h"
#include "base/message.h"
#include "base/outputs.h"
#include "base/progress.h"
#include "commands.h"
#include "pairs/solids.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct settings {
    read_settings read;
    const char *output, *proof, *check;
    double error, tolerance;
    unsigned parts, cells;
    int cover, json, csv;
} settings;

static const cli_option options[] = {
    {"output", 'o', OPTION_OUTPUT, offsetof(settings, output), "FILE", "obj",
     "write the parts to FILE, an OBJ file with an object for each"},
    {"error", 0, OPTION_POSITIVE, offsetof(settings, error), "E", NULL,
     "the parts shall neither leave a point of the solid uncovered by more than E nor stand out of it by more "
     "(default: "
     "1/50 of the diagonal of its box, as a goal that is not tested)"},
    {"parts", 0, OPTION_COUNT, offsetof(settings, parts), "N", NULL,
     "at most N parts, which stand out as little as may be"},
    {"check", 0, OPTION_FILE, offsetof(settings, check), "PARTS", NULL,
     "the parts are the objects of this mesh file, each as its hull; none are made"},
    {"cover", 0, OPTION_FLAG, offsetof(settings, cover), NULL, NULL,
     "grow the parts by what may be uncovered, so that they are proven to cover the solid"},
    {"proof", 0, OPTION_OUTPUT, offsetof(settings, proof), "FILE", "json|jsonl",
     "write what is proven as a file that \"ovoid verify FILE MESH PARTS\" checks"},
    {"tolerance", 0, OPTION_POSITIVE, offsetof(settings, tolerance), "T", NULL,
     "how narrow both brackets shall be, a length (default: 1/1000 of the diagonal, or a tenth of --error if that is "
     "less)"},
    {"cells", 0, OPTION_COUNT, offsetof(settings, cells), "N", NULL,
     "look at most at N cells for each bracket (default: 2097152)"},
    INPUTS_OPTIONS(settings),
    {"json", 0, OPTION_FLAG, offsetof(settings, json), NULL, NULL, "write JSON, one object"},
    {"csv", 0, OPTION_FLAG, offsetof(settings, csv), NULL, NULL, "write CSV with a header line"},
    {0},
};

static void show_progress(void *context, size_t done, size_t total) {
    (void)context;
    (void)total;
    progress_set(done);
}

static double get_diagonal(const ovoid_solid *solid) {
    ovoid_box b = ovoid_solid_get_report(solid).box;
    return hypot(hypot(b.max.x - b.min.x, b.max.y - b.min.y), b.max.z - b.min.z);
}

static ovoid_decomposition_options make_options(const settings *s, const ovoid_solid *solid) {
    double tolerance = s->tolerance;
    if (!(tolerance > 0) && s->error > 0 && s->error < 0.01 * get_diagonal(solid)) tolerance = 0.1 * s->error;
    return (ovoid_decomposition_options){
        .tolerance = tolerance, .work = s->cells, .error = s->error, .parts = s->parts, .progress = show_progress};
}

/// Proves both lengths of the parts. 0, or EXIT_INPUT after a message.
static int prove(decomposed *d, const ovoid_decomposition_options *o) {
    ovoid_error error;
    free(d->excess);
    d->excess = calloc(d->view.part_count ? d->view.part_count : 1, sizeof *d->excess);
    if (!d->excess) return message_error("out of memory"), EXIT_INPUT;
    ovoid_decomposition_options all = *o;
    all.excesses = d->excess;
    progress_start("cells", 0);
    ovoid_code code = ovoid_decomposition_compute_proof(&d->view, &all, &d->proof, &error);
    progress_end();
    if (code != OVOID_OK) return message_error("%s: %s", d->path, error.message), EXIT_INPUT;
    d->found = d->proof;
    return 0;
}

static void take_parts(decomposed *d, ovoid_parts *parts) {
    ovoid_parts_destroy(d->parts);
    d->parts = parts;
    d->view.parts = ovoid_parts_get_shapes(parts);
    d->view.part_count = ovoid_parts_get_count(parts);
}

/// Computes the parts. If the proof shows a larger error than asked, cuts again with a smaller target. This is common,
/// since the estimate that guides the cuts is a lower bound.
static int make_parts(decomposed *d, const settings *s) {
    enum { TRIES = 5 };
    ovoid_decomposition_options o = make_options(s, d->view.solid), goal = o;
    ovoid_error error;
    for (int i = 0; i < TRIES; i++) {
        progress_start("parts", 0);
        ovoid_parts *parts = ovoid_parts_create_from_solid(d->view.solid, &goal, &error);
        progress_end();
        if (!parts) return message_error("%s: %s", d->path, error.message), EXIT_INPUT;
        take_parts(d, parts);
        int code = prove(d, &o);
        if (code || !(s->error > 0) || s->parts || d->proof.excess.upper <= s->error) return code;
        goal.error *= fmin(0.9, 0.95 * s->error / d->proof.excess.upper);
    }
    return 0;
}

int decomposed_read_parts(decomposed *d, const char *path, const read_settings *how) {
    ovoid_error error;
    ovoid_read_options read = inputs_make_options(how);
    read.parts = 1;
    d->given = ovoid_shapes_read_file(path, &read, NULL, &error);
    if (!d->given) return message_error("%s", error.message), EXIT_INPUT;
    size_t count = ovoid_shapes_get_count(d->given);
    d->list = calloc(count ? count : 1, sizeof *d->list);
    if (!d->list) return message_error("out of memory"), EXIT_INPUT;
    for (size_t i = 0; i < count; i++) d->list[i] = ovoid_shapes_get(d->given, i).shape;
    d->view.parts = d->list;
    d->view.part_count = count;
    return 0;
}

/// Reads parts from a file and proves their error. 0, or EXIT_INPUT after a message.
static int read_parts(decomposed *d, const settings *s) {
    int code = decomposed_read_parts(d, s->check, &s->read);
    ovoid_decomposition_options o = make_options(s, d->view.solid);
    return code ? code : prove(d, &o);
}

/// Grows the parts by the proven length. Then they cover the solid; their excess is proven again.
static int cover(decomposed *d, const settings *s) {
    ovoid_error error;
    double radius = d->proof.uncovered.upper;
    ovoid_parts *parts = ovoid_parts_create_enlarged(&d->view, radius, NULL, &error);
    if (!parts) return message_error("%s: %s", d->path, error.message), EXIT_INPUT;
    take_parts(d, parts);
    ovoid_decomposition_options o = make_options(s, d->view.solid);
    int code = prove(d, &o);
    d->is_grown = 1;
    d->grown = radius;
    d->proof.uncovered = (ovoid_decomposition_length){.lower = 0, .upper = 0};
    return code;
}

/// 0: within the error that was asked for, or none was; 1: proven not to be; 4: not proven.
static int judge(const decomposed *d, double error) {
    const ovoid_decomposition_proof *p = &d->proof;
    if (!(error > 0) || (p->uncovered.upper <= error && p->excess.upper <= error)) return EXIT_APART;
    return p->uncovered.lower > error || p->excess.lower > error ? EXIT_TOUCH : EXIT_NOT_PROVEN;
}

static int report(const decomposed *d, const settings *s) {
    if (s->json)
        decomposed_write_json(stdout, d);
    else if (s->csv)
        decomposed_write_csv(stdout, d);
    else
        decomposed_write_text(stdout, d);
    int code = finish_file(stdout);
    return code ? code : judge(d, s->error);
}

static int work(decomposed *d, const settings *s) {
    int code = s->check ? read_parts(d, s) : make_parts(d, s);
    if (!code && s->cover) code = cover(d, s);
    if (!code && s->output) code = decomposed_write_parts(s->output, d);
    if (!code && s->proof) code = decomposed_write_proof(s->proof, d);
    return code ? code : report(d, s);
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.read.unit = INPUTS_NO_UNIT};
    cli_operands paths;
    ovoid_error error;
    int code = command_parse(command, argc, argv, &s, &paths);
    if (code >= 0) return code;
    if (s.json && s.csv) return args_complain(command, "decompose: --json and --csv exclude each other");
    if (s.check && s.parts)
        return args_complain(command,
                             "decompose: --parts is for parts that are made, --check for parts that are given");
    if (s.proof && !s.output && !s.check)
        return args_complain(command, "decompose: --proof is of parts that are kept: --output PARTS.obj");
    decomposed d = {.path = paths.items[0], .unit = inputs_get_unit(&s.read)};
    ovoid_read_options read = inputs_make_options(&s.read);
    progress_read(d.path);
    ovoid_solid *solid = ovoid_solid_read_file(d.path, &read, &error);
    progress_hide();
    if (!solid) return message_error("%s", error.message), EXIT_INPUT;
    solids_warn_flat(d.path, solid);
    d.view.solid = solid;
    code = work(&d, &s);
    ovoid_parts_destroy(d.parts);
    ovoid_shapes_destroy(d.given);
    ovoid_solid_destroy(solid);
    free(d.list);
    free(d.excess);
    return code;
}

const cli_command command_decompose = {
    .name = "decompose",
    .summary = "a mesh that is not convex in convex parts, with a proof of how good they are",
    .usage = "[OPTION...] MESH",
    .description =
        "Cuts a closed mesh by planes into convex parts, or takes those of --check, and proves two lengths: "
        "uncovered, the radius by which the parts must be grown to cover the solid, and excess, by how much they stand "
        "out of it. Both are brackets, true whatever the budget.\n\n"
        "With them a distance of the parts becomes a true bracket of the solid's: at least the parts' less uncovered, "
        "at most the parts' and excess. Where the parts overlap, the solids are within both their excesses of each "
        "other, and need not touch.\n\n"
        "The solid is all points around which the mesh winds, and its surface: also of a mesh that crosses itself. A "
        "mesh that is not closed is refused.",
    .exits = "0 done; with --error, both lengths are proven to be at most that\n"
             "1 one of them is proven to be above --error\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written\n"
             "4 the brackets leave open whether both are within --error",
    .examples = "ovoid decompose bunny.obj -o parts.obj\n"
                "ovoid decompose bunny.obj --error 0.02 --cover -o parts.obj\n"
                "ovoid decompose bunny.obj --parts 16 --json\n"
                "ovoid decompose bunny.obj --check vhacd.obj",
    .options = options,
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
