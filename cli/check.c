// ovoid check: all pairs of a scene, sorted by distance. With a margin, a sweep along x over enclosing spheres (D.
// Baraff, Dynamic simulation of non-penetrating rigid bodies, 1992) and the bounds of each pair leave out what is
// proven farther. Pairs are kept as small rows; their answers are made twice, once to sort and once to be written, so
// that millions of pairs and their proofs pass through bounded memory.
#include "commands.h"

#include "inputs.h"
#include "message.h"
#include "pipeline.h"
#include "progress.h"
#include "results.h"

#include <ovoid/ovoid.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Pairs of one piece of work.
#define CHUNK 128

/// Most pairs that are sorted: rows of 1.6 GB.
#define ROWS_MAX 50000000

typedef struct settings {
    output_settings out;
    unsigned threads;
    double margin, tolerance; ///< margin negative: not given
} settings;

static const cli_option options[] = {
    {"margin", 0, OPTION_LENGTH, offsetof(settings, margin), "M", NULL,
     "list only the pairs that are not proven farther apart than M"},
    {"tol", 0, OPTION_LENGTH, offsetof(settings, tolerance), "T", NULL,
     "stop when the bracket of a pair is at most T wide (default: 1e-9 of the pair's size)"},
    {"threads", 0, OPTION_COUNT, offsetof(settings, threads), "N", NULL,
     "work on N threads; the output is the same bytes for any N (default: one for each processor)"},
    RESULTS_OPTIONS(settings),
    {0},
};

/// One pair: what it is sorted by.
typedef struct row {
    uint32_t a, b;
    double lower, upper;
    uint8_t code;   ///< exit_code
    uint8_t culled; ///< proven farther than the margin
} row;

/// An object's enclosing sphere in the world, padded for rounding.
typedef struct ball {
    ovoid_vec3 center;
    double radius;
    uint32_t object;
} ball;

/// What the whole run shares.
typedef struct check {
    const settings *settings;
    const ovoid_scene *scene;
    size_t object_count;
    row *rows;
    size_t row_count, row_capacity, next, done;
    cli_results results;
} check;

/// A piece of work: some rows; for output, their lines or records.
typedef struct chunk {
    size_t first, count;
    ovoid_record *records; ///< CHUNK
    ovoid_cover *cover;    ///< of one answer after another
    char *text;
    size_t size;
    int failed; ///< no memory
} chunk;

/* ---- which pairs ---- */

static int add_row(check *c, uint32_t a, uint32_t b) {
    if (ovoid_scene_is_ignored(c->scene, a, b)) return 0;
    if (c->row_count == c->row_capacity) {
        size_t capacity = c->row_capacity ? 2 * c->row_capacity : 1024;
        if (capacity > ROWS_MAX) capacity = ROWS_MAX;
        int is_full = c->row_count == ROWS_MAX;
        row *rows = is_full ? NULL : realloc(c->rows, capacity * sizeof *rows);
        if (!rows && !is_full) return message_error("out of memory for %zu pairs", capacity), EXIT_INPUT;
        if (!rows) {
            message_error("too many pairs to sort: above %zu; %s", c->row_count,
                          c->settings->margin >= 0 ? "give a smaller --margin"
                                                   : "give --margin to leave out far pairs");
            return EXIT_INPUT;
        }
        c->rows = rows;
        c->row_capacity = capacity;
    }
    c->rows[c->row_count++] = (row){.a = a < b ? a : b, .b = a < b ? b : a};
    return 0;
}

static int find_all_pairs(check *c) {
    int code = 0;
    for (size_t a = 0; a < c->object_count; a++)
        for (size_t b = a + 1; b < c->object_count && !code; b++) code = add_row(c, (uint32_t)a, (uint32_t)b);
    return code;
}

static double norm(ovoid_vec3 v) { return hypot(hypot(v.x, v.y), v.z); }

/// Posed points are off by at most 64 ulp of the lengths in play: 1e-12 of them is more than that and every rounding
/// of the comparisons below.
static ball make_ball(const ovoid_scene *scene, size_t object) {
    ovoid_scene_object o = ovoid_scene_get(scene, object);
    ovoid_measures measures = ovoid_shape_get_measures(o.shape);
    ovoid_vec3 origin = ovoid_shape_get_polytope(o.shape).origin, local = measures.sphere_center;
    double radius = measures.sphere_radius + ovoid_shape_get_radius(o.shape);
    double size = norm(o.pose.position) + norm(origin) + norm(local) + radius;
    local = (ovoid_vec3){origin.x + local.x, origin.y + local.y, origin.z + local.z};
    return (ball){ovoid_pose_compute_point(&o.pose, local), radius + 1e-12 * size, (uint32_t)object};
}

static int compare_balls(const void *a, const void *b) {
    const ball *p = a, *q = b;
    double low_p = p->center.x - p->radius, low_q = q->center.x - q->radius;
    if (low_p != low_q) return low_p < low_q ? -1 : 1;
    return p->object < q->object ? -1 : p->object > q->object;
}

/// Two balls whose gap is above the margin.
static int is_far(const ball *p, const ball *q, double margin) {
    ovoid_vec3 d = {q->center.x - p->center.x, q->center.y - p->center.y, q->center.z - p->center.z};
    return norm(d) > (p->radius + q->radius + margin) * (1 + 1e-14);
}

/// Sweeps the balls along x: cost n log n and the pairs whose spans along x are within the margin.
static int find_near_pairs(check *c) {
    double margin = c->settings->margin;
    ball *balls = malloc((c->object_count + 1) * sizeof *balls);
    int code = 0;
    if (!balls) return message_error("out of memory"), EXIT_INPUT;
    for (size_t i = 0; i < c->object_count; i++) balls[i] = make_ball(c->scene, i);
    qsort(balls, c->object_count, sizeof *balls, compare_balls);
    for (size_t i = 0; i < c->object_count && !code; i++) {
        double end = balls[i].center.x + balls[i].radius + margin;
        end += 1e-14 * fabs(end);
        for (size_t j = i + 1; j < c->object_count && !code; j++) {
            if (balls[j].center.x - balls[j].radius > end) break;
            if (!is_far(&balls[i], &balls[j], margin)) code = add_row(c, balls[i].object, balls[j].object);
        }
    }
    free(balls);
    return code;
}

/* ---- their answers ---- */

static ovoid_pair make_pair(const ovoid_scene *scene, const row *r) {
    ovoid_scene_object a = ovoid_scene_get(scene, r->a), b = ovoid_scene_get(scene, r->b);
    return (ovoid_pair){a.shape, b.shape, a.pose, b.pose};
}

static int fill(void *context, void *slot) {
    check *c = context;
    chunk *k = slot;
    k->first = c->next;
    k->count = c->row_count - c->next < CHUNK ? c->row_count - c->next : CHUNK;
    c->next += k->count;
    return k->count > 0;
}

/// First pass: the bracket of each row, or that it is proven farther than the margin.
static void work_bracket(void *context, void *slot) {
    const check *c = context;
    const chunk *k = slot;
    const settings *s = c->settings;
    ovoid_options query = {.absolute_tolerance = s->tolerance};
    for (row *r = c->rows + k->first; r < c->rows + k->first + k->count; r++) {
        ovoid_pair pair = make_pair(c->scene, r);
        if (s->margin >= 0) {
            ovoid_answer near = ovoid_within(&pair, s->margin, NULL, NULL);
            r->culled = ovoid_answer_is_within(&near, s->margin) == 0;
            if (r->culled) continue;
        }
        ovoid_answer answer = ovoid_depth(&pair, &query, NULL, NULL);
        r->lower = answer.lower;
        r->upper = answer.upper;
        r->code = (uint8_t)results_judge(&answer, s->margin);
    }
}

static int drain_bracket(void *context, void *slot) {
    check *c = context;
    progress_set(c->done += ((chunk *)slot)->count);
    return 0;
}

/// Second pass: the lines of each row.
static void work_lines(void *context, void *slot) {
    const check *c = context;
    chunk *k = slot;
    int lines = results_are_lines(&c->results);
    ovoid_options query = {.absolute_tolerance = c->settings->tolerance};
    if (!k->cover) k->cover = malloc(sizeof *k->cover);
    if (!k->records) k->records = malloc(CHUNK * sizeof *k->records);
    FILE *file = lines ? open_memstream(&k->text, &k->size) : NULL;
    k->failed = !k->cover || !k->records || (lines && !file);
    for (size_t i = 0; i < k->count && !k->failed; i++) {
        const row *r = &c->rows[k->first + i];
        ovoid_pair pair = make_pair(c->scene, r);
        k->records[i] = (ovoid_record){.a = ovoid_scene_get(c->scene, r->a).name,
                                       .b = ovoid_scene_get(c->scene, r->b).name,
                                       .answer = ovoid_depth(&pair, &query, NULL, k->cover),
                                       .cover = k->cover};
        if (lines) results_write_line(file, &c->settings->out, &k->records[i]);
    }
    if (file && fclose(file) != 0) k->failed = 1;
}

static int drain_lines(void *context, void *slot) {
    check *c = context;
    chunk *k = slot;
    int code = 0;
    if (k->failed) {
        message_error("out of memory");
        return EXIT_INPUT;
    }
    if (results_are_lines(&c->results))
        code = results_add_text(&c->results, k->text, k->size);
    else
        for (size_t i = 0; i < k->count && !code; i++) code = results_add(&c->results, &k->records[i]);
    free(k->text);
    k->text = NULL;
    return code;
}

static void clear(void *slot) {
    chunk *k = slot;
    free(k->cover);
    free(k->records);
    free(k->text);
}

static int compare_rows(const void *a, const void *b) {
    const row *p = a, *q = b;
    if (p->lower != q->lower) return p->lower < q->lower ? -1 : 1;
    if (p->upper != q->upper) return p->upper < q->upper ? -1 : 1;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : p->b > q->b;
}

/// Runs all rows through a pass of the pipeline.
static int run_pass(check *c, void (*work)(void *, void *), int (*drain)(void *, void *)) {
    cli_pipeline line = {c, sizeof(chunk), fill, work, drain, clear};
    c->next = c->done = 0;
    int code = pipeline_run(&line, c->settings->threads ? c->settings->threads : pipeline_get_processors());
    if (code < 0) message_error("out of memory or threads"), code = EXIT_INPUT;
    return code;
}

/// Drops the culled rows and sorts the others by distance.
static void sort_rows(check *c) {
    size_t kept = 0;
    for (size_t i = 0; i < c->row_count; i++)
        if (!c->rows[i].culled) c->rows[kept++] = c->rows[i];
    c->row_count = kept;
    if (kept) qsort(c->rows, kept, sizeof *c->rows, compare_rows);
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

static void tell_counts(const check *c, const tally *t, double seconds) {
    if (c->settings->margin >= 0)
        message_note("%zu objects in %.2f s; pairs within %g: %zu, not proven: %zu; all others are farther or ignored",
                     c->object_count, seconds, c->settings->margin, t->touch + t->apart, t->not_proven);
    else
        message_note("%zu objects, %zu pairs in %.2f s; apart: %zu, touching or overlapping: %zu, not proven: %zu",
                     c->object_count, c->row_count, seconds, t->apart, t->touch, t->not_proven);
}

static int run_check(check *c) {
    const settings *s = c->settings;
    double start = progress_get_seconds();
    // Which pairs, how far, in which order.
    int code = s->margin >= 0 ? find_near_pairs(c) : find_all_pairs(c);
    if (code) return code;
    progress_start("pairs", c->row_count);
    code = run_pass(c, work_bracket, drain_bracket);
    progress_end();
    if (code) return code;
    sort_rows(c);
    // Their answers.
    if (results_open(&c->results, &s->out, s->margin)) return EXIT_INPUT;
    code = run_pass(c, work_lines, drain_lines);
    tally t = count_rows(c);
    int worst = t.not_proven ? EXIT_NOT_PROVEN : t.touch ? EXIT_TOUCH : EXIT_APART;
    code = results_close(&c->results, code ? code : worst);
    if (code == worst) tell_counts(c, &t, progress_get_seconds() - start);
    return code;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.margin = -1};
    cli_operands paths;
    int code = args_parse(command, argc, argv, &s, &paths);
    if (code < 0) code = results_check_settings(command, &s.out);
    if (code >= 0) return code;
    ovoid_scene *scene = inputs_read_scene(paths.items[0]);
    if (!scene) return EXIT_INPUT;
    check c = {.settings = &s, .scene = scene, .object_count = ovoid_scene_get_count(scene)};
    code = run_check(&c);
    free(c.rows);
    ovoid_scene_destroy(scene);
    return code;
}

const cli_command command_check = {
    .name = "check",
    .summary = "all pairs of a scene, sorted by distance",
    .usage = "[OPTION...] SCENE.json",
    .description =
        "The signed distance of every pair of objects of a scene that the scene does not ignore, the nearest (or "
        "deepest) first. With --margin, only pairs that are not proven farther than M; that is much faster in scenes "
        "of "
        "many objects.\n\n"
        "A scene:\n\n"
        "    {\"objects\": [{\"name\": \"arm\", \"mesh\": \"arm.stl\", \"unit\": \"mm\",\n"
        "                  \"pose\": {\"xyz\": [0, 0, 0.3], \"rpy\": [0, 0, 1.57]}},\n"
        "                 {\"name\": \"table\", \"box\": [0.8, 1.2, 0.04]}],\n"
        "     \"ignore\": [[\"arm\", \"table\"]]}\n\n"
        "Bodies: mesh, box, sphere, capsule, cylinder, cone, points. Poses: xyz, with rpy or quat_wxyz.",
    .exits = "0 every pair is apart (with --margin: farther than M)\n1 a pair touches or overlaps (or is within M)\n"
             "2 the command line is wrong\n3 bad input, or output that could not be written\n"
             "4 for some pair nothing is proven; this comes before 1",
    .examples = "ovoid check cell.json\n"
                "ovoid check cell.json --margin 0.02 --json -o near.jsonl",
    .options = options,
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
