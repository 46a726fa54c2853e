// Impacts between two frames: boxes that contain each object over the whole interval are swept along x; the remaining
// pairs go to ovoid_body_impact_find, on several threads. A pair is a candidate until it first comes within the margin.
#include "pairs/impacts.h"

#include "base/message.h"
#include "base/pipeline.h"
#include "pairs/sweep.h"
#include "tools/array.h"

#include <math.h>
#include <stdlib.h>

/// Pairs of a chunk.
#define CHUNK 16

/// The tolerance of impacts, relative to the time between two frames: the default of ovoid_motion_options.
#define TOLERANCE 1e-9

/// The initial room for steps of a proof.
#define STEPS 64

/// The result for one pair: an impact, or none.
typedef struct impact {
    ovoid_couple couple;
    pair_impact pair;
    int failed; ///< no memory
} impact;

typedef struct chunk {
    size_t first, count;
} chunk;

typedef struct work_state {
    const cli_impacts *impacts;
    impact *items;
    size_t next;
} work_state;

int impacts_open(cli_impacts *impacts) {
    size_t count = ovoid_scene_get_count(impacts->scene);
    impacts->boxes = calloc(count + 1, sizeof *impacts->boxes);
    impacts->is_fresh = calloc(count + 1, 1);
    if (impacts->boxes && impacts->is_fresh) return 0;
    message_error("out of memory");
    impacts_close(impacts);
    return EXIT_INPUT;
}

void impacts_close(cli_impacts *impacts) {
    free(impacts->boxes);
    free(impacts->is_fresh);
    free(impacts->held);
    free(impacts->open);
    free(impacts->couples);
    *impacts = (cli_impacts){.scene = NULL};
}

static int add_couple(ovoid_couple **couples, size_t *count, size_t *capacity, ovoid_couple couple) {
    if (!array_reserve((void **)couples, capacity, *count, sizeof **couples))
        return message_error("out of memory for %zu pairs", *count + 1), EXIT_INPUT;
    (*couples)[(*count)++] = couple;
    return 0;
}

int impacts_hold(cli_impacts *impacts, ovoid_couple couple) {
    return add_couple(&impacts->held, &impacts->held_count, &impacts->held_capacity, couple);
}

int impacts_leave_open(cli_impacts *impacts, ovoid_couple couple) {
    return add_couple(&impacts->open, &impacts->open_count, &impacts->open_capacity, couple);
}

/* ---- which pairs come near each other */

ovoid_moving_body impacts_get_moving(const ovoid_scene *scene, const cli_frames *frames, size_t object) {
    const ovoid_pose any = ovoid_pose_make_identity();
    ovoid_body o = answers_get_body(scene, object, &any);
    return (ovoid_moving_body){
        .shape = o.shape, .compound = o.compound, .motion = frames_get_motion(frames, object), .solid = o.solid};
}

static ovoid_moving_body get_moving(const cli_impacts *impacts, size_t object) {
    return impacts_get_moving(impacts->scene, impacts->frames, object);
}

static double get_duration(const cli_impacts *impacts) { return impacts->frames->time - impacts->frames->earlier; }

static void make_box(cli_impacts *impacts, size_t object) {
    int moves = impacts->frames->is_moved[object];
    if (!moves && impacts->is_fresh[object]) return;
    ovoid_moving_body moving = get_moving(impacts, object);
    ovoid_box *box = &impacts->boxes[object];
    *box = ovoid_moving_body_compute_box(&moving, 0, get_duration(impacts));
    impacts->is_fresh[object] = !moves;
}

static int compare_couples(const void *a, const void *b) {
    const ovoid_couple *p = a, *q = b;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : p->b > q->b;
}

/// 1 if the pair is in the list, which is in ascending order.
static int has_couple(const ovoid_couple *couples, size_t count, ovoid_couple c) {
    return count && bsearch(&c, couples, count, sizeof c, compare_couples);
}

/// 1 for a candidate: one of the two moves, the scene does not ignore the pair, and the pair was not proven within the
/// margin.
static int is_candidate(const cli_impacts *impacts, ovoid_couple c) {
    if (!impacts->frames->is_moved[c.a] && !impacts->frames->is_moved[c.b]) return 0;
    if (ovoid_scene_is_ignored(impacts->scene, c.a, c.b)) return 0;
    return !has_couple(impacts->held, impacts->held_count, c);
}

static int visit_couple(void *context, ovoid_couple couple) {
    cli_impacts *impacts = context;
    if (!is_candidate(impacts, couple)) return 0;
    return add_couple(&impacts->couples, &impacts->couple_count, &impacts->couple_capacity, couple);
}

static int find_couples(cli_impacts *impacts) {
    size_t count = ovoid_scene_get_count(impacts->scene);
    impacts->couple_count = 0;
    for (size_t i = 0; i < count; i++) make_box(impacts, i);
    int code = sweep_find(impacts->boxes, count, impacts->margin, visit_couple, impacts);
    if (impacts->couple_count)
        qsort(impacts->couples, impacts->couple_count, sizeof *impacts->couples, compare_couples);
    return code;
}

/* ---- their impacts */

/// Makes room for the steps of a proof and, for compounds, for their groups. 0 if memory runs out.
static int reserve(pair_impact *p, ovoid_motion_options *options) {
    options->steps = realloc(p->steps, options->capacity * sizeof *p->steps);
    if (!options->steps) return 0;
    p->steps = options->steps;
    if (!options->group_capacity) return 1;
    options->groups = realloc(p->groups, options->group_capacity * sizeof *p->groups);
    if (!options->groups) return 0;
    p->groups = options->groups;
    return 1;
}

int pair_impact_find(pair_impact *p, const ovoid_moving_body bodies[2], double margin, impact_proof proof) {
    const ovoid_moving_body *a = &bodies[0], *b = &bodies[1];
    int is_compound = !a->shape || !b->shape;
    int has_groups = proof == IMPACT_PROOF_GROUPS || (proof && is_compound);
    ovoid_motion_options options = {.capacity = proof ? STEPS : 0, .group_capacity = has_groups ? STEPS : 0};
    for (;;) {
        if (proof && !reserve(p, &options)) return 0;
        p->found = ovoid_body_impact_find(&(ovoid_moving_body_pair){*a, *b, margin}, &options);
        if (!has_groups) p->found.group_count = 0;
        size_t steps = p->found.impact.step_count, groups = p->found.group_count;
        if (!proof || (steps <= options.capacity && groups <= options.group_capacity)) return 1;
        if (options.capacity < steps) options.capacity = steps;
        if (options.group_capacity < groups) options.group_capacity = groups;
    }
}

void pair_impact_clear(pair_impact *p) {
    free(p->steps);
    free(p->groups);
    *p = (pair_impact){.steps = NULL};
}

int pair_impact_is_arrival(const pair_impact *p) {
    const ovoid_impact *found = &p->found.impact;
    return found->status == OVOID_IMPACT_UNDECIDED && found->free_until >= (1 - TOLERANCE) * found->end;
}

static int fill(void *context, void *slot) {
    work_state *w = context;
    chunk *k = slot;
    k->count = pipeline_take(&w->next, w->impacts->couple_count, CHUNK, &k->first);
    return k->count > 0;
}

static void work(void *context, void *slot) {
    const work_state *w = context;
    const chunk *k = slot;
    for (size_t i = k->first; i < k->first + k->count; i++) {
        const cli_impacts *impacts = w->impacts;
        impact_proof proof = results_have_proofs(impacts->results) ? IMPACT_PROOF_RECORD : IMPACT_PROOF_NONE;
        const ovoid_couple c = impacts->couples[i];
        const ovoid_moving_body bodies[2] = {get_moving(impacts, c.a), get_moving(impacts, c.b)};
        w->items[i].couple = c;
        w->items[i].failed = !pair_impact_find(&w->items[i].pair, bodies, impacts->margin, proof);
    }
}

static int drain(void *context, void *slot) {
    const work_state *w = context;
    const chunk *k = slot;
    for (size_t i = k->first; i < k->first + k->count; i++)
        if (w->items[i].failed) return message_error("out of memory"), EXIT_INPUT;
    return 0;
}

static void clear(void *slot) { (void)slot; }

/* ---- what is written */

static const ovoid_impact *get_impact(const impact *item) { return &item->pair.found.impact; }

static int is_hit(const impact *item) { return get_impact(item)->status == OVOID_IMPACT_HIT; }

/// The time of an impact: when the pair is within the margin; if that is not proven, until when it is free.
static double get_time(const impact *item) {
    return is_hit(item) ? get_impact(item)->hit_at : get_impact(item)->free_until;
}

static int compare_impacts(const void *a, const void *b) {
    const impact *p = a, *q = b;
    double s = get_time(p), t = get_time(q);
    if (s != t) return s < t ? -1 : 1;
    return compare_couples(&p->couple, &q->couple);
}

static int is_shape(const cli_impacts *impacts, size_t object) {
    ovoid_scene_object o = ovoid_scene_get(impacts->scene, object);
    return !o.compound && !o.solid;
}

/// The answer of compounds or solids at a time between the frames, at which a hit is within the margin. 0 if memory
/// is out.
static int answer_compounds(const cli_impacts *impacts, const impact *item, answer_room *room, ovoid_record *record) {
    const ovoid_couple c = item->couple;
    double at = get_time(item);
    ovoid_motion motions[2] = {frames_get_motion(impacts->frames, c.a), frames_get_motion(impacts->frames, c.b)};
    ovoid_pose poses[2] = {ovoid_motion_compute_pose(&motions[0], at), ovoid_motion_compute_pose(&motions[1], at)};
    ovoid_body_pair pair = {answers_get_body(impacts->scene, c.a, &poses[0]),
                            answers_get_body(impacts->scene, c.b, &poses[1])};
    answers_query query = {
        .query = QUERY_WITHIN, .margin = impacts->margin, .wants_proof = results_have_proofs(impacts->results)};
    int done = answers_find(room, &pair, &query, record);
    if (!done || !is_hit(item) || record->answer.upper <= impacts->margin) return done;
    // For bodies with allowances the few pairs of one proof may prove less than those of the hit.
    ovoid_body_proof earlier = {item->pair.found.part_a, item->pair.found.part_b, get_impact(item)->hit.proof};
    query.earlier = &earlier;
    return answers_find(room, &pair, &query, record);
}

/// Makes the record of an impact. For compounds the answer is that of the whole bodies at that time, with a complete
/// proof. If the impact is not proven, the record says why, and has the answer at the end of the free time. 0 if memory
/// runs out.
static int make_record(const cli_impacts *impacts, const impact *item, answer_room *room, ovoid_record *record) {
    const ovoid_couple c = item->couple;
    const ovoid_impact *found = get_impact(item);
    double at = get_time(item);
    *record = (ovoid_record){.a = ovoid_scene_get(impacts->scene, c.a).name,
                             .b = ovoid_scene_get(impacts->scene, c.b).name,
                             .answer = is_hit(item) ? found->hit : found->free,
                             .fields = impacts->results->fields,
                             .time = impacts->frames->earlier + at,
                             .frame = impacts->frames->earlier,
                             .margin = impacts->margin,
                             .free_for = found->free_until,
                             .hit_after = found->hit_at,
                             .part_a = OVOID_RECORD_NO_PART,
                             .part_b = OVOID_RECORD_NO_PART};
    record->steps = item->pair.steps;
    record->step_count = item->pair.steps ? found->step_count : 0;
    record->groups = item->pair.groups;
    record->group_count = item->pair.groups ? item->pair.found.group_count : 0;
    int done = 1;
    answers_describe(impacts->scene, c, record);
    if (!is_shape(impacts, c.a) || !is_shape(impacts, c.b)) done = answer_compounds(impacts, item, room, record);
    if (!is_hit(item)) record->answer.limit = found->limit;
    return done;
}

/// 1 if a pair that is proven free until the frame, to the tolerance, is not proven farther than the margin there: it
/// arrives with the frame, whose own line has its distance. A bracket of the distance that contains the margin cannot
/// prove that the pair is within the margin by then.
static int is_arrival(const cli_impacts *impacts, const impact *item) {
    const cli_frames *f = impacts->frames;
    const ovoid_couple c = item->couple;
    if (!pair_impact_is_arrival(&item->pair)) return 0;
    ovoid_body_pair pair = {answers_get_body(impacts->scene, c.a, &f->poses[c.a]),
                            answers_get_body(impacts->scene, c.b, &f->poses[c.b])};
    ovoid_body_answer at_end = ovoid_body_within(&pair, impacts->margin, NULL, NULL);
    int within = ovoid_body_answer_is_within(&at_end, impacts->margin);
    return within > 0 || (within < 0 && at_end.limit == OVOID_LIMIT_NONE);
}

static int write_impacts(cli_impacts *impacts, const impact *items) {
    answer_room room = {.cover = {.memory = NULL}};
    int code = 0;
    for (size_t i = 0; i < impacts->couple_count && !code; i++) {
        ovoid_record record;
        if (get_impact(&items[i])->status == OVOID_IMPACT_FREE) continue;
        // The lines of the frames show that an open pair stays open.
        if (!is_hit(&items[i]) && has_couple(impacts->open, impacts->open_count, items[i].couple)) continue;
        int arrives = is_arrival(impacts, &items[i]);
        if (is_hit(&items[i]) || arrives)
            impacts->found++;
        else
            impacts->not_proven++;
        if (!make_record(impacts, &items[i], &room, &record)) code = EXIT_INPUT, message_error("out of memory");
        if (arrives)
            record.hit_after = impacts->frames->time - impacts->frames->earlier, record.time = impacts->frames->time;
        if (!code && !arrives) code = results_add(impacts->results, &record);
        if (!code) impacts->take(impacts->context, items[i].couple, &record);
    }
    answer_room_clear(&room);
    return code;
}

/// Finds the impacts of the candidates and writes them.
static int find_impacts(cli_impacts *impacts) {
    work_state w = {impacts, calloc(impacts->couple_count, sizeof(impact)), 0};
    int code = 0;
    if (!w.items) return message_error("out of memory"), EXIT_INPUT;
    cli_pipeline line = {&w, sizeof(chunk), fill, work, drain, clear};
    unsigned threads = pipeline_get_threads(impacts->threads);
    code = pipeline_run(&line, impacts->couple_count <= CHUNK ? 1 : threads);
    if (code < 0) message_error("out of memory or threads"), code = EXIT_INPUT;
    if (!code) qsort(w.items, impacts->couple_count, sizeof *w.items, compare_impacts);
    if (!code) code = write_impacts(impacts, w.items);
    for (size_t i = 0; i < impacts->couple_count; i++) pair_impact_clear(&w.items[i].pair);
    free(w.items);
    return code;
}

int impacts_find(cli_impacts *impacts) {
    int code = frames_validate_motions(impacts->frames);
    if (!code) code = find_couples(impacts);
    if (!code && impacts->couple_count) code = find_impacts(impacts);
    impacts->held_count = impacts->open_count = 0;
    return code;
}
