// Frames of swarms. All contestants get the same poses in turn, frame by frame, in an order that rotates by one each
// frame; so each finds the caches as another left them, and a disturbance affects all alike.
#define _POSIX_C_SOURCE 200809L
#include "many/many.h"

#include "many/meetings.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/// The first frames fill caches of pairs and are judged, not timed. Those after them are at least twice as many as
/// ovoid's boxes last: at first boxes are renewed in waves, and the mean includes these.
enum { FRAMES_UNTIMED = 2, FRAMES_MOST = 1000 };

/// Above this many bodies only each fourth frame is judged.
enum { JUDGED_ALL = 30000 };

typedef struct contestant {
    const swarm_peer *who;
    void *self;
    double samples[FRAMES_MOST]; ///< milliseconds
    uint32_t taken;
    double judged, missing, extra;
} contestant;

/// The state of a run.
typedef struct swarm_run {
    swarm_motion motion;
    contestant *all;
    uint32_t count;
    double boxes, touching; ///< per body, of the last frame judged
    double open, unproven;
} swarm_run;

static int judge_frame(swarm_run *run, meetings *lists, const meeting_truth *right, uint32_t k) {
    meeting_faults wrong = meetings_judge(&lists[k], right, -1);
    contestant *c = &run->all[k];
    c->judged += (double)right->sure.count;
    c->missing += (double)wrong.missing;
    c->extra += (double)wrong.extra;
    return !lists[k].failed;
}

/// The turn of every contestant; the truth if the frame is judged.
static int run_frame(swarm_run *run, meetings *lists, uint32_t frame) {
    const swarm_motion *m = &run->motion;
    for (uint32_t j = 0; j < run->count; j++) {
        uint32_t k = (j + frame) % run->count;
        contestant *c = &run->all[k];
        lists[k].count = 0;
        double start = get_own_seconds();
        c->who->run(c->self, m->poses, &lists[k]);
        double spent = get_own_seconds() - start;
        if (frame >= FRAMES_UNTIMED) c->samples[c->taken++] = spent * 1e3;
    }
    if (m->what.body_count > JUDGED_ALL && frame % 4 != 1) return 1;
    meeting_truth right;
    int good = swarm_compute_truth(&m->what, m->poses, &right);
    for (uint32_t k = 0; good && k < run->count; k++) good = judge_frame(run, lists, &right, k);
    run->boxes = (double)right.boxes / m->what.body_count;
    run->touching = (double)right.sure.count / m->what.body_count;
    run->open += (double)right.open.count;
    run->unproven += (double)right.unproven;
    meeting_truth_destroy(&right);
    return good;
}

static int run_frames(swarm_run *run, const many_plan *plan) {
    meetings lists[CONTESTANTS_MOST] = {{0}};
    double start = get_seconds();
    int good = 1;
    uint32_t frame = 0, least = plan->frames_least + FRAMES_UNTIMED, most = plan->frames_most + FRAMES_UNTIMED;
    for (; good && frame < most && (frame < least || get_seconds() - start < plan->seconds); frame++) {
        good = run_frame(run, lists, frame);
        swarm_move(&run->motion);
    }
    for (uint32_t k = 0; k < run->count; k++) free(lists[k].items);
    return good;
}

static void report(rows *all, const swarm_run *run) {
    for (uint32_t k = 0; k < run->count; k++) {
        contestant *c = &run->all[k];
        rows_add(all,
                 (row){"A frame of many bodies, one thread", "bodies", "ms", c->who->name, run->motion.what.body_count,
                       timing_make(c->samples, c->taken), c->judged, c->missing + c->extra});
        if (c->missing + c->extra > 0) printf("%40s missing %.0f, too many %.0f\n", "", c->missing, c->extra);
    }
    printf("%12s  per body %.2f overlapping boxes, %.3f touching pairs; open %.0f, unproven %.0f\n", "", run->boxes,
           run->touching, run->open, run->unproven);
}

static int run_swarm(rows *all, const many_field *field, const many_plan *plan, uint32_t number) {
    swarm_run run = {.all = calloc(CONTESTANTS_MOST, sizeof(contestant))};
    int good = run.all && swarm_create(&run.motion, number, 32);
    for (uint32_t k = 0; good && k < field->swarm_count; k++) {
        contestant *c = &run.all[run.count];
        c->who = field->swarms[k];
        c->self = c->who->create(&run.motion.what, run.motion.poses);
        run.count += c->self != NULL;
    }
    good = good && run_frames(&run, plan);
    if (good) report(all, &run);
    for (uint32_t k = 0; k < run.count; k++) run.all[k].who->destroy(run.all[k].self);
    swarm_destroy(&run.motion);
    free(run.all);
    return good;
}

// --- threads

/// Wall time of ovoid's frames on so many threads.
static int run_threads(rows *all, const swarm_peer *ours, const many_plan *plan, uint32_t number, uint32_t threads) {
    static double samples[FRAMES_MOST];
    swarm_motion motion;
    if (!swarm_create(&motion, number, 32)) return 0;
    motion.what.threads = threads;
    void *self = ours->create(&motion.what, motion.poses);
    meetings lists = {0};
    uint32_t taken = 0, frames = plan->frames_least + FRAMES_UNTIMED;
    for (uint32_t frame = 0; self && frame < frames; frame++) {
        lists.count = 0;
        double start = get_seconds();
        ours->run(self, motion.poses, &lists);
        if (frame >= FRAMES_UNTIMED) samples[taken++] = (get_seconds() - start) * 1e3;
        swarm_move(&motion);
    }
    static char lines[COUNTS_MOST][32];
    static uint32_t used;
    char *line = lines[used % COUNTS_MOST];
    if (threads == 1) {
        line = lines[++used % COUNTS_MOST];
        (void)snprintf(line, sizeof lines[0], "%u bodies", number);
    }
    rows_add(all, (row){"ovoid's frame on several threads", "threads", "ms", line, threads, timing_make(samples, taken),
                        0, 0});
    if (self) ours->destroy(self);
    free(lists.items);
    swarm_destroy(&motion);
    return self != NULL && !lists.failed;
}

int many_run_swarms(rows *all, const many_field *field, const many_plan *plan) {
    if (!plan->only || !strcmp(plan->only, "swarm"))
        for (uint32_t i = 0; i < plan->count_of_counts; i++)
            if (!run_swarm(all, field, plan, plan->counts[i])) return 0;
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    if (!plan->only || !strcmp(plan->only, "threads"))
        for (uint32_t i = 0; field->swarm_count && i < plan->count_of_counts; i++)
            for (uint32_t threads = 1; threads <= 2 * (uint32_t)cores && threads <= 64; threads *= 2)
                if (!run_threads(all, field->swarms[0], plan, plan->counts[i], threads)) return 0;
    return 1;
}
