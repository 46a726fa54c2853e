// ovoid verify: checks the proofs of a results file. Each bound is computed again from its proof alone, on the given
// bodies, without any search: in exact rational arithmetic where the judge was built in, else in floating point with
// rigorous error bounds. The steps of impacts, whose bodies turn by angles that no rational pose has, are always
// checked in floating point; such results are counted apart.
#include "commands.h"

#include "base/finish.h"
#include "base/message.h"
#include "base/outputs.h"
#include "base/pipeline.h"
#include "base/progress.h"
#include "body/decompose.h"
#include "pairs/answers.h"
#include "verify.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Results of a chunk.
#define CHUNK 32

/// Most failures, and missing results, that are reported one by one.
#define REPORTED_MAX 10

static const cli_option options[] = {
    {"shapes", 0, OPTION_FILE, offsetof(verify_settings, list), "LIST", NULL, "the shapes of ovoid batch"},
    {"pairs", 0, OPTION_FILE, offsetof(verify_settings, pairs), "PAIRS.csv", NULL, "the pairs of ovoid batch"},
    {"shard", 0, OPTION_PART, offsetof(verify_settings, part), "I/N", NULL,
     "the results are those of ovoid batch --shard I/N; of check and run, give --partial"},
    {"query", 0, OPTION_CHOICE, offsetof(verify_settings, query), "QUERY", QUERY_CHOICES,
     "the query of ovoid batch or run; for distance, it is also checked that the witness points differ "
     "by the distance along the normal (default: distance; of a batch: within)"},
    {"pose-a", 0, OPTION_POSE, offsetof(verify_settings, pose_a), ARGS_POSE, NULL,
     "pose of A, as given to ovoid distance"},
    {"pose-b", 0, OPTION_POSE, offsetof(verify_settings, pose_b), ARGS_POSE, NULL, "pose of B"},
    SOLIDS_OPTIONS(verify_settings,
                   "A and B are compounds of their files' objects, as given to ovoid distance; so are the next two"),
    {"motion", 0, OPTION_FILE, offsetof(verify_settings, motion), "MOTION.csv", NULL, "the motion of ovoid run"},
    {"margin", 0, OPTION_LENGTH, offsetof(verify_settings, margin), "M", NULL,
     "the margin that was asked: a pair without a result is proven farther apart (default: that of the results)"},
    {"tol", 0, OPTION_LENGTH, offsetof(verify_settings, tolerance), "T", NULL,
     "the tolerance that was asked: touching is a bracket of at most T, or of 1e-9 of the bodies' size (default: the "
     "latter alone)"},
    {"continuous", 0, OPTION_FLAG, offsetof(verify_settings, continuous), NULL, NULL,
     "as given to ovoid run: a pair without an impact between two frames is proven not to come within the margin"},
    {"partial", 0, OPTION_FLAG, offsetof(verify_settings, partial), NULL, NULL,
     "results may be missing or undecided: only those that are there are checked"},
    {"json", 0, OPTION_FLAG, offsetof(verify_settings, json), NULL, NULL, "write the counts as one JSON object"},
    {"threads", 0, OPTION_COUNT, offsetof(verify_settings, threads), "N", NULL,
     "work on N threads (default: one for each processor)"},
    INPUTS_OPTIONS(verify_settings),
#ifdef OVOID_HAVE_ROBOT
    PATH_VERIFY_OPTIONS(verify_settings),
#endif
    {0},
};

typedef struct chunk {
    size_t count;
    claim items[CHUNK];
    answer_room room;
} chunk;

static int fill(void *context, void *slot) {
    verify *v = context;
    chunk *c = slot;
    c->count = 0;
    while (!v->refused && c->count < CHUNK && verify_read(v, &c->items[c->count])) c->count++;
    return c->count > 0;
}

static void work(void *context, void *slot) {
    const verify *v = context;
    chunk *c = slot;
    for (claim *i = c->items; i < c->items + c->count; i++) {
        ovoid_error error = {.message = ""};
        if (i->kind != CLAIM_RESULT) {
            i->holds = verify_prove_rest(v, &c->room, i);
            continue;
        }
        if (!i->message[0] && verify_claim(v, i, &error) != OVOID_OK)
            snprintf(i->message, sizeof i->message, "%s", error.message[0] ? error.message : "the proof does not hold");
        i->holds = !i->message[0];
    }
}

/// 1 where the answer leaves open what was asked: the sign, the side of the margin, or when there is an impact.
static int is_open(const ovoid_record *r) {
    if (r->fields & OVOID_RECORD_IMPACT && !isfinite(r->hit_after)) return 1;
    return results_judge(&r->answer, r->fields & OVOID_RECORD_MARGIN ? r->margin : -1) == EXIT_NOT_PROVEN;
}

static void count_result(verify *v, const claim *i) {
    verify_counts *n = &v->counts;
    n->proofs++;
    n->held += (size_t)i->holds;
    n->undecided += is_open(&i->record);
    n->impacts += (i->record.fields & OVOID_RECORD_IMPACT) != 0;
    n->contacts += i->record.contact_count;
    n->mixed += i->record.solid && (i->pair.a.compound || i->pair.b.compound);
    if (!i->holds && v->reported++ < REPORTED_MAX)
        message_error("%s:%lld: %s", v->path, (long long)i->line, i->message);
}

/// Counts a pair without a result, and names it where it needs one.
static void count_rest(verify *v, const claim *i) {
    const char *a = ovoid_scene_get(v->bodies.scene, i->couple.a).name,
               *b = ovoid_scene_get(v->bodies.scene, i->couple.b).name;
    char time[64] = "";
    if (v->settings->motion) snprintf(time, sizeof time, i->kind == CLAIM_FREE ? " before %.9g" : " at %.9g", i->time);
    v->counts.beyond += i->kind == CLAIM_BEYOND && i->holds;
    v->counts.impacts_lacking += i->kind == CLAIM_FREE && !i->holds;
    if (!i->holds && v->reported++ < REPORTED_MAX)
        message_error("%s: there is no %s of %.60s, %.60s%s", v->path, i->kind == CLAIM_FREE ? "impact" : "result", a,
                      b, time);
}

static int drain(void *context, void *slot) {
    verify *v = context;
    chunk *c = slot;
    for (claim *i = c->items; i < c->items + c->count; i++) {
        if (i->kind == CLAIM_RESULT)
            count_result(v, i);
        else
            count_rest(v, i);
        verify_drop(i);
    }
    progress_set(v->counts.proofs);
    return 0;
}

static void clear(void *slot) {
    chunk *c = slot;
    for (size_t i = 0; i < CHUNK; i++) verify_drop(&c->items[i]);
    answer_room_clear(&c->room);
}

/// Counts the pairs of a batch, or of two bodies, that have no result.
static void count_others(verify *v) {
    ovoid_indexed_pair pair;
    int got = 0;
    if (v->bodies.scene) return;
    while (v->bodies.pairs && (got = ovoid_pairs_reader_read(v->bodies.pairs, &pair, &v->error)) > 0)
        v->counts.lacking++;
    if (!v->bodies.pairs) v->counts.lacking = v->rest.results == 0;
    v->counts.pairs = v->counts.proofs + v->counts.lacking;
    v->refused = got < 0;
}

/// The pairs that need a result and have none.
static size_t get_missing(const verify_counts *n) { return n->lacking - n->beyond - n->by_boxes; }

/// 1 if results of a motion have impacts, and what is missing of these was not asked.
static int is_continuous_unasked(const verify *v) { return v->counts.impacts && !v->settings->continuous; }

static void print_json(const verify_counts *n, size_t exact) {
    printf("{\"proofs\":%zu,\"hold\":%zu,\"fail\":%zu,\"undecided\":%zu,\"exact\":%zu,\"floating\":%zu,", n->proofs,
           n->held, n->proofs - n->held, n->undecided, exact, n->proofs - exact);
    printf("\"pairs\":%zu,\"missing\":%zu,\"beyond\":%zu,\"impacts_missing\":%zu,\"contacts\":%zu}\n", n->pairs,
           get_missing(n), n->beyond + n->by_boxes, n->impacts_lacking, n->contacts);
}

/// What the results lack.
static void print_rest(const verify *v) {
    const verify_counts *n = &v->counts;
    size_t beyond = n->beyond + n->by_boxes;
    if (n->lacking)
        printf("%s without a result: %zu of %zu", v->settings->motion ? "pairs of frames" : "pairs", n->lacking,
               n->pairs);
    if (beyond) printf(", proven farther than the margin: %zu (%zu by boxes)", beyond, n->by_boxes);
    if (n->lacking) printf("; ");
    if (n->impacts_lacking) printf("impacts missing: %zu; ", n->impacts_lacking);
}

/// The counts, and in what arithmetic the proofs were checked.
static void print_counts(const verify *v) {
    static const char floating[] = "floating point with rigorous error bounds";
    const verify_counts *n = &v->counts;
    size_t exact = verdict_is_exact() ? n->proofs - n->impacts - n->mixed : 0;
    if (v->settings->json) {
        print_json(n, exact);
        return;
    }
    printf("proofs: %zu, hold: %zu, do not: %zu; undecided answers: %zu; ", n->proofs, n->held, n->proofs - n->held,
           n->undecided);
    print_rest(v);
    if (!verdict_is_exact())
        printf("checked in %s\n", floating);
    else if (!n->impacts)
        printf("checked in exact arithmetic");
    else
        printf("checked in exact arithmetic, but for impacts (%zu): their steps in %s", n->impacts, floating);
    if (verdict_is_exact() && n->mixed) printf("; solids beside compounds (%zu) in %s", n->mixed, floating);
    if (verdict_is_exact() && n->contacts) printf("; contacts (%zu) in %s", n->contacts, floating);
    if (verdict_is_exact()) printf("\n");
}

/// Proofs of two bodies hold where the poses are those of the query, and the results do not say these.
static void advise_poses(const verify *v) {
    if (v->bodies.scene || v->settings->list) return;
    if (args_is_origin(&v->settings->pose_a) && args_is_origin(&v->settings->pose_b))
        message_note(
            "both bodies are at the origin: if \"ovoid distance\" had --pose-a or --pose-b, give them here too");
}

/// The exit code of what was counted: what does not hold, before what is missing or open.
static int find_code(const verify *v) {
    const verify_counts *n = &v->counts;
    if (n->held != n->proofs) {
        advise_poses(v);
        return EXIT_NOT_PROVEN;
    }
    if (v->settings->partial) return EXIT_APART;
    if (is_continuous_unasked(v))
        message_note("the results have impacts: --continuous proves that none is missing, --partial allows it");
    if (!n->proofs && get_missing(n) && isnan(v->margin))
        message_note("there are no results: with the --margin that was asked it is proven that all pairs are farther "
                     "apart");
    int is_whole = !get_missing(n) && !n->impacts_lacking && !n->undecided && !is_continuous_unasked(v);
    return is_whole ? EXIT_APART : EXIT_TOUCH;
}

/// Checks every result; returns the exit code.
static int run_results(verify *v) {
    cli_pipeline line = {v, sizeof(chunk), fill, work, drain, clear};
    unsigned threads = pipeline_get_threads(v->settings->threads);
    const ovoid_options asked = {.absolute_tolerance = v->settings->tolerance};
    v->verdict = verdict_create(threads, &asked);
    if (!v->verdict) return message_error("out of memory"), EXIT_INPUT;
    progress_start("proofs", 0);
    int code = pipeline_run(&line, threads);
    progress_end();
    verdict_destroy(v->verdict);
    if (code) return code < 0 ? (message_error("out of memory or threads"), EXIT_INPUT) : code;
    if (!v->refused) count_others(v);
    if (v->refused && v->error.message[0]) message_error("%s", v->error.message);
    if (v->refused) return EXIT_INPUT;
    print_counts(v);
    code = finish_file(stdout);
    if (code) return code;
    return find_code(v);
}

/* ---- the inputs ---- */

/// Checks the operands and options together. -1 to go on, or EXIT_USAGE.
static int validate_inputs(const cli_command *command, const verify_settings *s, const cli_operands *paths) {
    int has_list = s->list || s->pairs;
    if (has_list && (!s->list || !s->pairs)) return args_complain(command, "verify: --shapes and --pairs go together");
    if (s->part.count && !has_list) return args_complain(command, "verify: --shard goes with --shapes and --pairs");
    if (has_list && paths->count > 1)
        return args_complain(command, "verify: --shapes takes the place of %s", paths->items[1]);
    if (!has_list && paths->count < 2)
        return args_complain(command, "verify: on which bodies? Give SCENE.json, or A and B, or --shapes and --pairs");
    if (!has_list && paths->count == 2 && !inputs_is_scene(paths->items[1]) && strcmp(paths->items[1], "-") != 0)
        return args_complain(command, "verify: %s is no scene (.json); of two bodies, both must be given",
                             paths->items[1]);
    if (s->motion && (has_list || paths->count > 2))
        return args_complain(command, "verify: --motion is that of a scene: give SCENE.json");
    if (s->continuous && !s->motion)
        return args_complain(command, "verify: --continuous is of a motion: give --motion too");
    int is_scene = !has_list && paths->count == 2;
    if (is_scene && (s->read.unit != INPUTS_NO_UNIT || s->read.scale > 0))
        return args_complain(command,
                             "verify: --unit and --scale are for meshes; a scene says its own (\"unit\": \"mm\")");
    if ((has_list || is_scene) && !(args_is_origin(&s->pose_a) && args_is_origin(&s->pose_b)))
        return args_complain(command, "verify: --pose-a and --pose-b go with A and B");
    const solids_choice *c = &s->choice;
    if (c->parts + c->solid + (c->hull && !is_scene && !has_list) && (has_list || paths->count < 3))
        return args_complain(command, "verify: --%s goes with A and B",
                             c->parts   ? "parts"
                             : c->solid ? "solid"
                                        : "hull");
    return solids_settle(command, c);
}

/// 1 where the operands are those of path proofs: the file alone, or with a URDF.
static int has_path_proofs(const verify_settings *s, const cli_operands *paths) {
    if (s->list || s->pairs || s->motion) return 0;
    return paths->count == 1 || (paths->count == 2 && outputs_has_extension(paths->items[1], "urdf"));
}

#ifdef OVOID_HAVE_ROBOT
static int verify_paths(const cli_command *command, verify_settings *s, const cli_operands *paths) {
    if (s->margin >= 0 || s->tolerance > 0)
        return args_complain(command,
                             "verify: --%s is of results, with the bodies that they are of; path proofs have their own",
                             s->margin >= 0 ? "margin" : "tol");
    s->paths.json = s->json;
    s->paths.partial = s->partial;
    return path_verify(command, &s->paths, paths->items[0], paths->count > 1 ? paths->items[1] : NULL);
}
#else
static int verify_paths(const cli_command *command, verify_settings *s, const cli_operands *paths) {
    (void)s;
    if (paths->count == 1)
        return args_complain(command, "verify: on which bodies? Give SCENE.json, or A and B, or --shapes and --pairs");
    return args_complain(command, "verify: path proofs need libovoid_robot, without which this ovoid was built");
}
#endif

static int run(const cli_command *command, int argc, char **argv) {
    verify_settings s = {.read.unit = INPUTS_NO_UNIT,
                         .query = QUERY_NONE,
                         .margin = -1,
                         .pose_a = ovoid_pose_make_identity(),
                         .pose_b = ovoid_pose_make_identity()};
    cli_operands paths;
    int code = command_parse(command, argc, argv, &s, &paths);
    if (code < 0 && has_path_proofs(&s, &paths)) return verify_paths(command, &s, &paths);
    if (code < 0 && paths.count == 3 && ovoid_decomposition_is_proof(paths.items[0]))
        return decomposed_verify(paths.items, &s.read);
    if (code < 0) code = validate_inputs(command, &s, &paths);
    if (code >= 0) return code;
    if (s.query == QUERY_NONE) s.query = s.list ? QUERY_WITHIN : QUERY_DISTANCE;
    verify v = {.settings = &s, .path = paths.items[0], .margin = s.margin >= 0 ? s.margin : NAN};
    code = verify_open_bodies(&v.bodies, &s, &paths);
    if (!code) {
        v.reader = ovoid_results_reader_open(v.path, &v.error);
        if (v.reader)
            code = run_results(&v);
        else
            message_error("%s", v.error.message), code = EXIT_INPUT;
    }
    ovoid_results_reader_close(v.reader);
    verify_clear_rest(&v.rest);
    verify_close_bodies(&v.bodies);
    return code;
}

const cli_command command_verify = {
    .name = "verify",
    .summary = "checks the proofs of a results file",
    .usage = "[OPTION...] RESULTS.jsonl SCENE.json\n"
             "[OPTION...] RESULTS.jsonl SCENE.json --motion MOTION.csv\n"
             "[OPTION...] RESULTS.jsonl A B\n"
             "[OPTION...] RESULTS.jsonl --shapes LIST --pairs PAIRS.csv\n"
             "[OPTION...] PROOFS.jsonl [ROBOT.urdf]\n"
             "[OPTION...] PROOF.json MESH PARTS.obj",
    .description =
        "Checks every result of a file written with --json by check, run, distance or batch, on the same bodies, "
        "without the search that found it: each bound is computed again from the proof alone, in exact rational "
        "arithmetic where ovoid was built with GMP. A result holds if its proof shows lower <= d <= upper and the "
        "status, if the normal is the one that proves the lower bound, and if the witness points lie on their "
        "bodies.\n\n"
        "Of compounds and solids, it is also checked that the exclusions hold and leave out no pair of parts or "
        "triangles, and of solids, by winding numbers, what is inside; and of impacts, the "
        "steps that show that a pair was free until then, these always in floating point with rigorous error bounds. "
        "Such results are counted apart; so are contacts, whose brackets, points and areas are shown again by the "
        "features that meet, in floating point.\n\n"
        "PROOFS.jsonl is of \"ovoid robot path --proofs\". It names its robot and its obstacles, which must be the "
        "same "
        "still: a digest says so. Each step is measured again, without a search, and for each pair the steps must "
        "reach "
        "from the beginning to the end of what is said to be free.\n\n"
        "PROOF.json is of \"ovoid decompose --proof\", MESH and PARTS.obj what it is about. The points that it names "
        "are measured, and both lengths are shown anew, by cells that are bounded by what is claimed.\n\n"
        "Nothing may be missing either, unless --partial says so: each pair of the scene has one result, at each "
        "frame, or it is farther apart than the margin that was asked, which is proven anew where there is no "
        "result. An answer that is undecided claims nothing, so it counts as missing.\n\n"
        "RESULTS.jsonl is \"-\" for standard input. The first failures are listed with their lines, and the first "
        "pairs whose results are missing with their names.",
    .exits = "0 every proof holds, and nothing is missing or undecided\n"
             "1 every proof holds, but results are missing or undecided\n"
             "2 the command line is wrong\n"
             "3 bad input\n"
             "4 a proof does not hold",
    .examples = "ovoid check cell.json --json | ovoid verify - cell.json\n"
                "ovoid verify near.jsonl cell.json --margin 0.02\n"
                "ovoid verify results.jsonl --shapes hulls.txt --pairs pairs.csv\n"
                "ovoid verify proof.jsonl",
    .options = options,
    .operands_min = 1,
    .operands_max = 3,
    .run = run,
};
