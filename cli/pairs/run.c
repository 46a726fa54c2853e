// ovoid run: a scene that moves. In each frame a world finds the pairs that may be within the margin; each is answered
// by a new query, and listed if that does not prove it farther apart. So the lines of a frame do not depend on the
// frames before it, can be checked alone, and parts of the frames are shards. With --continuous the times of impact
// between frames are bracketed. Memory does not grow with the number of frames, except for the points of a plot.
#include "commands.h"

#include "base/frames.h"
#include "base/inputs.h"
#include "base/message.h"
#include "base/outputs.h"
#include "base/pipeline.h"
#include "base/progress.h"
#include "page/scenes.h"
#include "pairs/answers.h"
#include "pairs/impacts.h"
#include "pairs/near.h"
#include "pairs/run_report.h"
#include "pairs/track.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct settings {
    output_settings out;
    const char *motion, *plot, *html;
    int query, continuous, hull;
    unsigned threads;
    double margin, tolerance; ///< margin negative: not given
    contacts_settings contacts;
    shard_part part;
} settings;

static const cli_option options[] = {
    {"motion", 0, OPTION_FILE, offsetof(settings, motion), "MOTION.csv", NULL,
     "times with poses or velocities of objects, \"-\" for standard input (required)"},
    {"margin", 0, OPTION_LENGTH, offsetof(settings, margin), "M", NULL,
     "list only the pairs that are not proven farther apart than M; without it, every pair of every frame, or with "
     "--query collide those that touch"},
    {"query", 0, OPTION_CHOICE, offsetof(settings, query), "QUERY", QUERY_CHOICES,
     "collide: which pairs touch? within: which are within --margin? distance: the signed distance, minus the depth "
     "where they overlap (default)"},
    {"continuous", 0, OPTION_FLAG, offsetof(settings, continuous), NULL, NULL,
     "between frames, also find when pairs come within the margin (without one: touch)"},
    {"tol", 0, OPTION_LENGTH, offsetof(settings, tolerance), "T", NULL,
     "stop when the bracket of a pair is at most T wide, or 1e-9 of its size (default: the latter alone)"},
    {"plot", 0, OPTION_OUTPUT, offsetof(settings, plot), "FILE", "svg",
     "draw the distances of the nearest pairs over time, an SVG file"},
    CONTACTS_OPTIONS(settings),
    INPUTS_HULL_OPTION(settings),
    PAGE_OPTION(settings),
    THREADS_OPTION(settings),
    SHARD_OPTION(settings),
    RESULTS_OPTIONS(settings),
    {0},
};

/// The state of a run.
typedef struct run_state {
    const settings *settings;
    const ovoid_scene *scene;
    cli_frames frames;
    cli_near near;
    cli_impacts impacts;
    cli_track track;
    cli_results results;
    cli_page page;
    page_motion motion;              ///< of the page
    ovoid_manifold_options contacts; ///< of the records of frames, if they are wanted
    size_t counts[4];                ///< of the records of frames, by ovoid_status
    exit_code worst;
    int code;             ///< the exit code of a failed callback, or 0
    uint64_t kept;        ///< frames of a shard that an earlier run wrote
    uint64_t frame_count; ///< of the motion, if this is a shard
    int is_begun;         ///< the frame before, and the pairs in it, are those of the motion
} run_state;

/// The margin of impacts: 0, touching, if none was given.
static double get_margin(const settings *s) { return s->margin > 0 ? s->margin : 0; }

/* ---- records, as they come */

/// Records a pair for the impacts until the next frame.
static void take_held(void *context, size_t i, const ovoid_record *record) {
    run_state *r = context;
    const settings *s = r->settings;
    ovoid_couple couple = r->near.couples[i];
    if (!s->continuous || r->code || ovoid_answer_is_within(&record->answer, get_margin(s)) == 0) return;
    int is_open = results_judge(&record->answer, get_margin(s)) == EXIT_NOT_PROVEN;
    r->code = is_open ? impacts_leave_open(&r->impacts, couple) : impacts_hold(&r->impacts, couple);
}

/// Counts an answer by its exit code.
static void take_side(run_state *r, exit_code side) {
    r->worst = results_worse(r->worst, side);
    results_count(&r->results, side);
}

static void take_record(void *context, size_t i, const ovoid_record *record) {
    run_state *r = context;
    const settings *s = r->settings;
    r->counts[record->answer.status]++;
    take_side(r, results_judge(&record->answer, s->margin));
    if (!s->part.count)
        track_add(&r->track, r->near.couples[i], record, s->margin, r->frames.count > 1 ? r->frames.earlier : NAN);
    take_held(r, i, record);
}

static void take_impact(void *context, ovoid_couple couple, const ovoid_record *record) {
    run_state *r = context;
    take_side(r, isfinite(record->hit_after) ? EXIT_TOUCH : EXIT_NOT_PROVEN);
    if (!r->settings->part.count) track_add_impact(&r->track, couple, record, r->frames.time);
    if (r->page.path) page_motion_add_impact(&r->motion, couple, record, r->frames.time);
}

/* ---- the frames */

/// Answers the pairs of a frame. is_before: it is the one before those of a part, and only the data for the next frame
/// are kept.
static int answer_frame(run_state *r, int is_before) {
    const settings *s = r->settings;
    answers_job job = {.scene = r->scene,
                       .poses = r->frames.poses,
                       .query = s->query,
                       .margin = s->margin,
                       .tolerance = s->tolerance,
                       .is_near_only = r->near.world != NULL,
                       .reach = get_margin(s),
                       .threads = s->threads,
                       .couples = r->near.couples,
                       .stride = sizeof *r->near.couples,
                       .count = r->near.count,
                       .contacts = s->contacts.wanted && !is_before ? &r->contacts : NULL,
                       .time = r->frames.time,
                       .results = is_before ? NULL : &r->results,
                       .take = is_before ? take_held : take_record,
                       .context = r};
    int code = answers_run(&job);
    if (!code && r->track.failed) message_error("out of memory"), code = EXIT_INPUT;
    return code ? code : r->code;
}

static int run_frame(run_state *r) {
    int code = 0;
    if (r->settings->continuous && r->frames.count > 1) code = impacts_find(&r->impacts);
    if (!code) code = near_move(&r->near, r->frames.moved, r->frames.moved_count, r->frames.poses);
    if (!code) code = near_find(&r->near);
    track_add_frame(&r->track, r->frames.time);
    if (r->page.path) page_motion_add_frame(&r->motion, r->frames.time, r->frames.poses);
    if (!code) code = answer_frame(r, 0);
    if (!code) code = results_end_units(&r->results, 1);
    progress_set(r->frames.count);
    return code;
}

/// Begins with the present poses: of the first frame, or of the frame before consecutive ones of a part.
static int begin(run_state *r) {
    const settings *s = r->settings;
    near_close(&r->near);
    impacts_close(&r->impacts);
    const near_request request = {.scene = r->scene,
                                  .poses = r->frames.poses,
                                  .margin = s->query == QUERY_COLLIDE ? 0 : s->margin,
                                  .threads = s->threads};
    int code = near_open(&r->near, &request);
    if (code || !s->continuous) return code;
    r->impacts = (cli_impacts){.scene = r->scene,
                               .frames = &r->frames,
                               .margin = get_margin(s),
                               .threads = s->threads,
                               .results = &r->results,
                               .take = take_impact,
                               .context = r};
    code = impacts_open(&r->impacts);
    if (!code && r->frames.count) code = near_find(&r->near);
    return code || !r->frames.count ? code : answer_frame(r, 1);
}

/// Reads the next frame of the part that no earlier run has written, and begins anew behind frames that are left out.
/// 1, 0 at the end, -1 after a message.
static int next_frame(run_state *r) {
    const shard_part part = r->settings->part;
    uint64_t next = r->frames.count;
    for (; part.count && next < r->frame_count; next++) {
        int is_own = shard_part_has_frame(part, next, r->frame_count);
        if (is_own && !r->kept) break;
        r->kept -= (uint64_t)is_own;
    }
    if (part.count && next == r->frame_count) return 0;
    int is_next = next == r->frames.count;
    if (!is_next && frames_skip(&r->frames, next) <= 0) return -1;
    if (!(is_next && r->is_begun) && begin(r)) return -1;
    r->is_begun = 1;
    return frames_next(&r->frames);
}

static int run_frames(run_state *r) {
    int code = 0, got = 0;
    progress_start("frames", 0);
    while (!code && (got = next_frame(r)) > 0) code = run_frame(r);
    progress_end();
    return code || got >= 0 ? code : EXIT_INPUT;
}

/* ---- the run */

static unsigned get_fields(const run_state *r) {
    const settings *s = r->settings;
    return inputs_get_fields(r->scene) | OVOID_RECORD_TIME | OVOID_RECORD_PARTS |
           (s->contacts.wanted ? OVOID_RECORD_CONTACTS : 0) | (s->continuous ? OVOID_RECORD_IMPACT : 0) |
           (s->margin >= 0 ? OVOID_RECORD_MARGIN : 0);
}

/// Runs the frames of a shard.
static int run_shard(run_state *r, const cli_command *command, const cli_operands *paths) {
    const settings *s = r->settings;
    shard_job job = {.command = command,
                     .settings = s,
                     .operands = paths,
                     .part = s->part,
                     .scene = r->scene,
                     .seen = shard_digest_make(),
                     .units = "frames"};
    shard_digest_add_scene(&job.seen, r->scene);
    int code = results_open_shard(&r->results, &s->out, get_fields(r), &job);
    if (code) return code;
    r->kept = results_get_done(&r->results);
    if (r->kept != UINT64_MAX) code = frames_count(s->motion, r->scene, &r->frame_count);
    if (!code && r->kept != UINT64_MAX) code = frames_open(&r->frames, s->motion, r->scene);
    if (!code && r->kept != UINT64_MAX) code = run_frames(r);
    return results_close(&r->results, code);
}

/// Writes the page. 0, or an exit code after a message; does nothing if no page is wanted.
static int write_page(run_state *r, const char *title) {
    const settings *s = r->settings;
    const answers_job job = {.scene = r->scene,
                             .query = QUERY_DISTANCE,
                             .margin = s->margin,
                             .tolerance = s->tolerance,
                             .contacts = s->contacts.wanted ? &r->contacts : NULL,
                             .threads = s->threads};
    const page_run run = {&r->motion, &r->track, s->continuous ? get_margin(s) : s->margin};
    r->motion.is_continuous = s->continuous && !r->frames.speed;
    return page_write_run(&r->page, title, &job, &run);
}

static int run_motion(run_state *r, const char *title) {
    const settings *s = r->settings;
    double start = progress_get_seconds();
    int code = frames_open(&r->frames, s->motion, r->scene);
    if (!code && s->html) code = page_motion_open(&r->motion, ovoid_scene_get_count(r->scene));
    if (code) return code;
    const unsigned fields = get_fields(r);
    if (results_open(&r->results, &s->out, fields, ovoid_scene_get_unit(r->scene))) return EXIT_INPUT;
    r->track.has_plot = s->plot != NULL;
    r->track.has_pairs = s->html != NULL;
    code = run_frames(r);
    int worst = (int)r->worst;
    code = results_close(&r->results, code ? code : worst);
    if (code != worst) return code;
    if (s->plot && track_write_plot(&r->track, s->plot, r->scene, s->margin)) return EXIT_INPUT;
    const run_summary summary = {.scene = r->scene,
                                 .track = &r->track,
                                 .frames = r->frames.count,
                                 .counts = r->counts,
                                 .impacts = s->continuous ? &r->impacts : NULL,
                                 .margin = s->margin,
                                 .measures = s->query == QUERY_DISTANCE};
    run_report(&summary, progress_get_seconds() - start);
    return write_page(r, title) ? EXIT_INPUT : code;
}

/// Checks the options together. -1 to continue, or EXIT_USAGE.
static int settle(const cli_command *command, settings *s) {
    if (!s->motion) return args_complain(command, "run: --motion MOTION.csv is missing");
    if (s->query == QUERY_WITHIN && s->margin < 0) return args_complain(command, "run: --query within needs --margin");
    if (s->query == QUERY_COLLIDE && s->margin >= 0)
        return args_complain(command, "run: --query collide takes no --margin; --query within does");
    if (s->plot && strcmp(s->plot, "-") == 0)
        return args_complain(command, "run: --plot needs a file; standard output has the results");
    if (s->plot && s->part.count)
        return args_complain(command, "run: --plot is of all pairs, --shard of a part of them");
    int code = page_settle(command, s->html, s->part);
    if (code < 0) code = contacts_settle(command, &s->contacts);
    return code < 0 ? results_settle_part(command, &s->out, s->part) : code;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.query = QUERY_DISTANCE, .margin = -1};
    cli_operands paths;
    int code = command_parse(command, argc, argv, &s, &paths);
    if (code < 0) code = settle(command, &s);
    if (code >= 0) return code;
    run_state r = {.settings = &s, .contacts = contacts_make_options(&s.contacts, s.margin, s.tolerance)};
    if (page_open(&r.page, s.html)) return EXIT_INPUT;
    ovoid_scene *scene = inputs_read_scene(paths.items[0], s.hull);
    if (!scene) return page_close(&r.page), EXIT_INPUT;
    inputs_warn_scene(scene);
    r.scene = scene;
    code = s.part.count ? run_shard(&r, command, &paths) : run_motion(&r, paths.items[0]);
    impacts_close(&r.impacts);
    track_clear(&r.track);
    near_close(&r.near);
    frames_close(&r.frames);
    page_motion_close(&r.motion);
    page_close(&r.page);
    ovoid_scene_destroy(scene);
    return code;
}

const cli_command command_run = {
    .name = "run",
    .summary = "a scene that moves: what is near, touches, and when",
    .usage = "[OPTION...] SCENE.json --motion MOTION.csv",
    .description =
        "The signed distances of the pairs of a scene at each time of a motion: a line for each frame and pair. "
        "The first line of MOTION.csv must be one of\n\n"
        "    time,body,x,y,z,qw,qx,qy,qz\n"
        "    time,body,vx,vy,vz,wx,wy,wz\n\n"
        "for poses of objects, or velocities from that time on (of the frame's origin, and in radians about axes of "
        "the world). Times never decrease; an object stays, or goes on, until its next line; until its first it is "
        "where the scene has it.\n\n"
        "With --continuous, motion between two frames counts too: from pose to pose the position is linear and the "
        "rotation turns about one axis, the shorter way round; velocities are constant. An impact is a line of its "
        "own, with the time until which the pair is proven farther apart and the time when it is within the margin, or "
        "the reason why that is not proven. No motion is too fast for it.\n\n"
        "At the end are reported: what touches, or is not proven apart, from the beginning; the first contact of pairs "
        "that "
        "did not touch then, and their first "
        "impacts; the smallest distance of the frames. ovoid verify --motion "
        "checks the lines of --json.",
    .exits = "0 every pair is apart in every frame (with --margin: farther than M)\n"
             "1 a pair touches or overlaps (or is within M)\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written\n"
             "4 for some pair the sign (with --margin: the side of M) is not proven; this comes before 1",
    .examples = "ovoid run cell.json --motion pick.csv --margin 0.1 --plot pick.svg\n"
                "ovoid run cell.json --motion pick.csv --continuous --query collide\n"
                "ovoid run cell.json --motion pick.csv --margin 0.05 --json -o near.jsonl",
    .options = options,
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
