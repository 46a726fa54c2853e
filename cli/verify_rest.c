// What results lack. Each pair of a scene, at each frame, has a result, or it is farther apart than the margin that was
// asked: by the boxes around both bodies, which hold rounding and allowances, or by a query whose proof is checked as
// that of a result is. Between frames each pair that moves has an impact, or is near already, or is proven free.
#include "base/message.h"
#include "pairs/impacts.h"
#include "pairs/sweep.h"
#include "tools/array.h"
#include "verify.h"

#include <math.h>
#include <stdlib.h>

/// Pairs without a result that are named, where no margin excuses them.
#define NAMED 10

void verify_clear_rest(verify_rest *rest) {
    seen_clear(&rest->seen);
    seen_clear(&rest->before);
    free(rest->items);
    free(rest->boxes);
    free(rest->swept);
    *rest = (verify_rest){.items = NULL};
}

int verify_begin_rest(verify *v) {
    verify_rest *rest = &v->rest;
    cli_seen earlier = rest->before;
    rest->before = rest->seen;
    rest->seen = earlier;
    seen_empty(&rest->seen);
    rest->results = 0;
    rest->is_listed = 0;
    return 1;
}

/// The margin beyond which a pair needs no result: negative where all need one.
static double get_margin(const verify *v) {
    if (v->settings->query == QUERY_COLLIDE) return 0;
    return v->margin >= 0 ? v->margin : -1;
}

/// The margin of impacts.
static double get_impact_margin(const verify *v) { return v->margin > 0 ? v->margin : 0; }

static ovoid_pose get_pose(const verify *v, size_t object) {
    const cli_frames *f = &v->bodies.frames;
    return f->poses ? f->poses[object] : ovoid_scene_get(v->bodies.scene, object).pose;
}

/// Adds a pair of the frame to the list. 0, or EXIT_INPUT after a message.
static int add_item(verify *v, claim_kind kind, ovoid_couple c) {
    verify_rest *rest = &v->rest;
    const ovoid_scene *scene = v->bodies.scene;
    if (!array_reserve((void **)&rest->items, &rest->capacity, rest->count, sizeof *rest->items))
        return message_error("out of memory for %zu pairs", rest->count + 1), EXIT_INPUT;
    ovoid_pose pose_a = get_pose(v, c.a), pose_b = get_pose(v, c.b);
    rest->items[rest->count++] =
        (claim){.kind = kind,
                .couple = c,
                .pair = {answers_get_body(scene, c.a, &pose_a), answers_get_body(scene, c.b, &pose_b)},
                .time = v->bodies.frames.time};
    return 0;
}

/* ---- at the frame */

static int needs_result(const verify *v, ovoid_couple c) {
    return !ovoid_scene_is_ignored(v->bodies.scene, c.a, c.b) && !(seen_get(&v->rest.seen, c) & SEEN_RESULT);
}

/// The first pairs without a result, to be named.
static int list_named(verify *v) {
    size_t count = ovoid_scene_get_count(v->bodies.scene);
    int code = 0;
    for (uint32_t a = 0; a < count && !code && v->rest.count < NAMED; a++)
        for (uint32_t b = a + 1; b < count && !code && v->rest.count < NAMED; b++)
            if (needs_result(v, (ovoid_couple){a, b})) code = add_item(v, CLAIM_LACKING, (ovoid_couple){a, b});
    return code;
}

static int visit_near(void *context, ovoid_couple c) {
    verify *v = context;
    return needs_result(v, c) ? add_item(v, CLAIM_BEYOND, c) : 0;
}

/// Makes the boxes of the objects where they are in this frame, but for those that have not moved.
static void make_boxes(verify *v) {
    const cli_frames *f = &v->bodies.frames;
    for (size_t i = 0; i < ovoid_scene_get_count(v->bodies.scene); i++) {
        ovoid_pose pose = get_pose(v, i);
        if (v->rest.has_boxes && !f->is_moved[i]) continue;
        ovoid_body o = answers_get_body(v->bodies.scene, i, &pose);
        ovoid_moving_body still = {
            .shape = o.shape, .compound = o.compound, .motion = ovoid_motion_make_still(pose), .solid = o.solid};
        v->rest.boxes[i] = ovoid_moving_body_compute_box(&still, 0, 0);
    }
    v->rest.has_boxes = 1;
}

static int list_beyond(verify *v, size_t lacking) {
    double margin = get_margin(v);
    if (!lacking) return 0;
    if (margin < 0) return list_named(v);
    int code = sweep_find(v->rest.boxes, ovoid_scene_get_count(v->bodies.scene), margin, visit_near, v);
    if (lacking > v->rest.count) v->counts.by_boxes += lacking - v->rest.count;
    return code;
}

/* ---- between two frames */

static int visit_moving(void *context, ovoid_couple c) {
    verify *v = context;
    const verify_rest *rest = &v->rest;
    const cli_frames *f = &v->bodies.frames;
    unsigned now = seen_get(&rest->seen, c), before = seen_get(&rest->before, c);
    if ((!f->is_moved[c.a] && !f->is_moved[c.b]) || now & SEEN_IMPACT || before & SEEN_NEAR) return 0;
    if (ovoid_scene_is_ignored(v->bodies.scene, c.a, c.b)) return 0;
    if (add_item(v, CLAIM_FREE, c)) return EXIT_INPUT;
    claim *item = &rest->items[rest->count - 1];
    item->flags = (now & SEEN_NEAR) | (before & SEEN_OPEN);
    item->duration = f->time - f->earlier;
    item->moving[0] = impacts_get_moving(v->bodies.scene, f, c.a);
    item->moving[1] = impacts_get_moving(v->bodies.scene, f, c.b);
    return 0;
}

static int list_free(verify *v) {
    const cli_frames *f = &v->bodies.frames;
    size_t count = ovoid_scene_get_count(v->bodies.scene);
    if (!v->settings->continuous || f->count < 2) return 0;
    if (frames_validate_motions(f)) return EXIT_INPUT;
    for (size_t i = 0; i < count; i++) {
        v->rest.swept[i] = v->rest.boxes[i];
        if (!f->is_moved[i]) continue;
        ovoid_moving_body moving = impacts_get_moving(v->bodies.scene, f, i);
        v->rest.swept[i] = ovoid_moving_body_compute_box(&moving, 0, f->time - f->earlier);
    }
    return sweep_find(v->rest.swept, count, get_impact_margin(v), visit_moving, v);
}

/* ---- all of them */

static int make_room(verify *v) {
    verify_rest *rest = &v->rest;
    size_t count = ovoid_scene_get_count(v->bodies.scene) + 1;
    if (!rest->boxes) rest->boxes = calloc(count, sizeof *rest->boxes);
    if (!rest->swept) rest->swept = calloc(count, sizeof *rest->swept);
    return rest->boxes && rest->swept;
}

int verify_list_rest(verify *v) {
    verify_rest *rest = &v->rest;
    size_t pairs = ovoid_scene_get_pair_count(v->bodies.scene), lacking = pairs - rest->results;
    rest->is_listed = 1;
    rest->count = rest->next = 0;
    v->counts.pairs += pairs;
    v->counts.lacking += lacking;
    if (v->settings->partial) return 1;
    int code = make_room(v) ? 0 : (message_error("out of memory"), EXIT_INPUT);
    if (!code) make_boxes(v);
    if (!code) code = list_beyond(v, lacking);
    if (!code) code = list_free(v);
    v->refused |= code != 0;
    return !code;
}

/* ---- their proofs */

static int prove_beyond(const verify *v, answer_room *room, const claim *item) {
    const answers_query query = {
        .query = QUERY_WITHIN, .margin = get_margin(v), .tolerance = v->settings->tolerance, .wants_proof = 1};
    claim asked = *item;
    ovoid_error error;
    asked.record = (ovoid_record){.fields = OVOID_RECORD_PARTS};
    if (!answers_find(room, &item->pair, &query, &asked.record)) return 0;
    return ovoid_answer_is_within(&asked.record.answer, query.margin) == 0 &&
           verify_claim(v, &asked, &error) == OVOID_OK;
}

/// 1 where no impact is due: the pair does not come within the margin, or not before the frame, whose result has it; of
/// one that the frame before leaves open only a proven impact is.
static int is_excused(const pair_impact *found, unsigned flags) {
    ovoid_impact_status status = found->found.impact.status;
    if (status != OVOID_IMPACT_UNDECIDED) return status == OVOID_IMPACT_FREE;
    return flags & SEEN_OPEN || (flags & SEEN_NEAR && pair_impact_is_arrival(found));
}

static int prove_free(const verify *v, const claim *item) {
    pair_impact p = {.steps = NULL};
    ovoid_error error;
    double margin = get_impact_margin(v);
    int is = pair_impact_find(&p, item->moving, margin, IMPACT_PROOF_GROUPS) && is_excused(&p, item->flags) &&
             verify_claim_impact(item, margin, &p.found, p.steps, p.groups, &error) == OVOID_OK;
    pair_impact_clear(&p);
    return is;
}

int verify_prove_rest(const verify *v, answer_room *room, const claim *item) {
    if (item->kind == CLAIM_BEYOND) return prove_beyond(v, room, item);
    return item->kind == CLAIM_FREE && prove_free(v, item);
}
