// ovoid check: all pairs of a scene, sorted by distance; with a margin, those that a world does not prove to be
// farther. Pairs are stored as small rows. Their answers are computed twice, once for sorting and once for output, so
// that millions of pairs and their proofs take bounded memory.
#include "commands.h"

#include "base/inputs.h"
#include "base/message.h"
#include "base/outputs.h"
#include "base/pipeline.h"
#include "base/progress.h"
#include "page/scenes.h"
#include "pairs/answers.h"
#include "pairs/near.h"

#include <stdlib.h>

typedef struct settings {
    output_settings out;
    unsigned threads, top;
    int hull;
    double margin, tolerance; ///< margin negative: not given
    contacts_settings contacts;
    shard_part part;
    const char *html;
} settings;

static const cli_option options[] = {
    {"margin", 0, OPTION_LENGTH, offsetof(settings, margin), "M", NULL,
     "list only the pairs that are not proven farther apart than M"},
    {"top", 0, OPTION_AMOUNT, offsetof(settings, top), "N", NULL,
     "list the N nearest pairs, 0: all; all are counted (default: of a table without --margin 20, else all)"},
    {"tol", 0, OPTION_LENGTH, offsetof(settings, tolerance), "T", NULL,
     "stop when the bracket of a pair is at most T wide, or 1e-9 of its size (default: the latter alone)"},
    CONTACTS_OPTIONS(settings),
    INPUTS_HULL_OPTION(settings),
    THREADS_OPTION(settings),
    SHARD_OPTION(settings),
    PAGE_OPTION(settings),
    RESULTS_OPTIONS(settings),
    {0},
};

/// The default of --top.
#define TOP_UNSET 0xffffffffu
#define TOP_TABLE 20

/// One pair, with its keys for sorting.
typedef struct row {
    ovoid_couple couple;
    double lower, upper;
    uint8_t code; ///< exit_code
} row;

/// The state of a run.
typedef struct check {
    const settings *settings;
    const ovoid_scene *scene;
    ovoid_pose *poses;
    row *rows;
    size_t row_count;
    cli_results results;
    cli_page page;
    ovoid_manifold_options contacts; ///< of the records, if they are wanted
    const char *path;                ///< of the scene
    size_t kept;                     ///< rows of a shard that an earlier run wrote
} check;

/// Makes the rows of all pairs, or of those that are near. 0, or EXIT_INPUT after a message.
static int find_rows(check *c) {
    cli_near near;
    const near_request request = {.scene = c->scene,
                                  .poses = c->poses,
                                  .margin = c->settings->margin,
                                  .part = c->settings->part,
                                  .threads = c->settings->threads,
                                  .is_still = 1};
    int code = near_open(&near, &request);
    if (code) return code;
    code = near_find(&near);
    if (!code) {
        c->rows = malloc((near.count + 1) * sizeof *c->rows);
        c->row_count = near.count;
        if (!c->rows) message_error("out of memory for %zu pairs", near.count), code = EXIT_INPUT;
    }
    for (size_t i = 0; i < near.count && !code; i++) c->rows[i] = (row){.couple = near.couples[i]};
    near_close(&near);
    return code;
}

static void take_bracket(void *context, size_t i, const ovoid_record *record) {
    check *c = context;
    c->rows[i].lower = record->answer.lower;
    c->rows[i].upper = record->answer.upper;
    c->rows[i].code = (uint8_t)results_judge(&record->answer, c->settings->margin);
    progress_set(i + 1);
}

static int compare_rows(const void *a, const void *b) {
    const row *p = a, *q = b;
    if (p->lower != q->lower) return p->lower < q->lower ? -1 : 1;
    if (p->upper != q->upper) return p->upper < q->upper ? -1 : 1;
    if (p->couple.a != q->couple.a) return p->couple.a < q->couple.a ? -1 : 1;
    return p->couple.b < q->couple.b ? -1 : p->couple.b > q->couple.b;
}

/// How many rows there are of each exit code.
typedef struct tally {
    size_t apart, touch, not_proven;
} tally;

static tally count_rows(const check *c) {
    tally t = {0, 0, 0};
    for (size_t i = 0; i < c->row_count; i++) {
        uint8_t code = c->rows[i].code;
        *(code == EXIT_APART ? &t.apart : code == EXIT_TOUCH ? &t.touch : &t.not_proven) += 1;
    }
    return t;
}

static void report_counts(const check *c, const tally *t, double seconds) {
    size_t objects = ovoid_scene_get_count(c->scene);
    const char *unit = ovoid_scene_get_unit(c->scene);
    if (!c->row_count && c->settings->margin >= 0)
        message_note("%zu objects in %.2f s; nothing is within %g%s%s: all pairs are proven farther apart, or ignored",
                     objects, seconds, c->settings->margin, unit[0] ? " " : "", unit);
    else if (!c->row_count)
        message_note("%zu object%s: there is no pair to compare%s", objects, objects == 1 ? "" : "s",
                     objects == 1 ? "" : ", the scene ignores all");
    else if (c->settings->margin >= 0)
        message_note("%zu objects in %.2f s; pairs within %g%s%s: %zu, not proven: %zu; all others are farther or "
                     "ignored",
                     objects, seconds, c->settings->margin, unit[0] ? " " : "", unit, t->touch, t->not_proven);
    else
        message_note("%zu objects, %zu pairs in %.2f s; apart: %zu, touching or overlapping: %zu, not proven: %zu",
                     objects, c->row_count, seconds, t->apart, t->touch, t->not_proven);
}

/// The number of rows that are listed.
static size_t get_listed(const check *c) {
    unsigned top = c->settings->top;
    int is_short = top == TOP_UNSET && c->settings->margin < 0 && !results_are_lines(&c->results);
    size_t most = is_short ? TOP_TABLE : top == TOP_UNSET || top == 0 ? c->row_count : top;
    return most < c->row_count ? most : c->row_count;
}

static answers_job make_job(check *c) {
    const settings *s = c->settings;
    return (answers_job){.scene = c->scene,
                         .poses = c->poses,
                         .query = QUERY_DISTANCE,
                         .margin = s->margin,
                         .tolerance = s->tolerance,
                         .threads = s->threads,
                         .couples = c->rows,
                         .stride = sizeof *c->rows,
                         .count = c->row_count,
                         .context = c};
}

/// The pairs, their distances and their order. 0, or an exit code after a message.
static int sort_rows(check *c) {
    int code = find_rows(c);
    if (code) return code;
    answers_job job = make_job(c);
    // The order is that of the brackets that are written, by which shards are merged.
    job.wants_proof = results_have_proofs(&(cli_results){.settings = &c->settings->out});
    job.take = take_bracket;
    progress_start("pairs", c->row_count);
    code = answers_run(&job);
    progress_end();
    if (!code && c->row_count) qsort(c->rows, c->row_count, sizeof *c->rows, compare_rows);
    return code;
}

/// The pairs that are listed, as they are written: with their contacts.
static answers_job make_listed_job(check *c) {
    answers_job job = make_job(c);
    if (c->settings->contacts.wanted) job.contacts = &c->contacts;
    return job;
}

static unsigned get_fields(const check *c) {
    return OVOID_RECORD_PARTS | (c->settings->margin >= 0 ? OVOID_RECORD_MARGIN : 0) |
           (c->settings->contacts.wanted ? OVOID_RECORD_CONTACTS : 0) | inputs_get_fields(c->scene);
}

/* ---- a shard */

/// Counts all rows, including those that are not listed.
static void count_sides(check *c) {
    for (size_t i = 0; i < c->row_count; i++) results_count(&c->results, c->rows[i].code);
}

/// Answers the pairs of a shard and writes them in their order, after those that an earlier run wrote.
static int run_shard(check *c, const cli_command *command, const cli_operands *paths) {
    const settings *s = c->settings;
    shard_job shard = {.command = command,
                       .settings = s,
                       .operands = paths,
                       .part = s->part,
                       .scene = c->scene,
                       .most = s->top == TOP_UNSET ? 0 : s->top,
                       .seen = shard_digest_make(),
                       .units = "pairs"};
    shard_digest_add_scene(&shard.seen, c->scene);
    if (results_open_shard(&c->results, &s->out, get_fields(c), &shard)) return EXIT_INPUT;
    uint64_t done = results_get_done(&c->results);
    int code = done == UINT64_MAX ? 0 : sort_rows(c);
    answers_job job = make_listed_job(c);
    job.count = get_listed(c);
    c->kept = done < job.count ? (size_t)done : job.count;
    job.couples = c->kept ? c->rows + c->kept : c->rows;
    job.count -= c->kept;
    job.results = &c->results;
    job.are_units = 1;
    if (!code) code = answers_run(&job);
    if (!code && done != UINT64_MAX) count_sides(c);
    return results_close(&c->results, code);
}

static int run_check(check *c) {
    const settings *s = c->settings;
    double start = progress_get_seconds();
    int code = sort_rows(c);
    if (code) return code;
    // Their answers, written.
    if (results_open(&c->results, &s->out, get_fields(c), ovoid_scene_get_unit(c->scene))) return EXIT_INPUT;
    answers_job job = make_listed_job(c);
    job.results = &c->results;
    job.count = get_listed(c);
    code = answers_run(&job);
    tally t = count_rows(c);
    int worst = t.not_proven ? EXIT_NOT_PROVEN : t.touch ? EXIT_TOUCH : EXIT_APART;
    code = results_close(&c->results, code ? code : worst);
    if (code != worst) return code;
    if (job.count < c->row_count) message_note("%zu more pairs: --top 0, or --json", c->row_count - job.count);
    report_counts(c, &t, progress_get_seconds() - start);
    job = make_listed_job(c);
    return page_write_scene(&c->page, c->path, &job) ? EXIT_INPUT : code;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.margin = -1, .top = TOP_UNSET};
    cli_operands paths;
    int code = command_parse(command, argc, argv, &s, &paths);
    if (code < 0) code = results_settle_part(command, &s.out, s.part);
    if (code < 0) code = page_settle(command, s.html, s.part);
    if (code < 0) code = contacts_settle(command, &s.contacts);
    if (code >= 0) return code;
    check c = {
        .settings = &s, .path = paths.items[0], .contacts = contacts_make_options(&s.contacts, s.margin, s.tolerance)};
    if (page_open(&c.page, s.html)) return EXIT_INPUT;
    ovoid_scene *scene = inputs_read_scene(paths.items[0], s.hull);
    if (!scene) return page_close(&c.page), EXIT_INPUT;
    inputs_warn_scene(scene);
    c.scene = scene;
    c.poses = inputs_copy_poses(scene);
    code = !c.poses ? EXIT_INPUT : s.part.count ? run_shard(&c, command, &paths) : run_check(&c);
    free(c.poses);
    free(c.rows);
    page_close(&c.page);
    ovoid_scene_destroy(scene);
    return code;
}

const cli_command command_check = {
    .name = "check",
    .summary = "all pairs of a scene, sorted by distance",
    .usage = "[OPTION...] SCENE.json",
    .description =
        "The signed distance of every pair of objects of a scene that the scene does not ignore, the nearest (or "
        "deepest) first. With --margin, only pairs that are not proven farther than M; that is much faster in "
        "scenes of many objects.\n\n"
        "A scene:\n\n"
        "    {\"unit\": \"m\", \"objects\": [{\"name\": \"arm\", \"mesh\": \"arm.stl\", \"unit\": \"mm\",\n"
        "                  \"pose\": {\"xyz\": [0, 0, 0.3], \"rpy\": [0, 0, 1.57]}},\n"
        "                 {\"name\": \"table\", \"box\": [0.8, 1.2, 0.04]}],\n"
        "     \"ignore\": [[\"arm\", \"table\"]]}\n\n"
        "Bodies: mesh, box, sphere, capsule, cylinder, cone, ellipsoid, points; compound, a list of these, or a mesh "
        "with "
        "\"parts\": true, whose objects are the parts. A closed mesh that is not convex is the solid that its "
        "triangles enclose, an open one its surface; the depth of solids is a bracket that is true, but wide. Poses: "
        "xyz, with rpy or quat_wxyz.",
    .exits = "0 every pair is apart (with --margin: farther than M)\n"
             "1 a pair touches or overlaps (or is within M)\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written\n"
             "4 for some pair the sign (with --margin: the side of M) is not proven; this comes before 1",
    .examples = "ovoid check cell.json\n"
                "ovoid check cell.json --margin 0.02 --json -o near.jsonl\n"
                "ovoid check stack.json --margin 0.001 --contacts",
    .options = options,
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
