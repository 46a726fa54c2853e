// Impacts between two frames: boxes that hold each object over the whole interval are swept along x (D. Baraff, Dynamic
// simulation of non-penetrating rigid bodies, 1992); the remaining pairs go to ovoid_compound_impact_find, on several
// threads. A pair is a candidate until it first comes within the margin.
#include "impacts.h"

#include "message.h"
#include "pipeline.h"

#include <math.h>
#include <stdlib.h>

/// Pairs of a chunk.
#define CHUNK 16

/// Part of the time between two frames to which impacts are found: the default of ovoid_motion_options.
#define TOLERANCE 1e-9

/// Steps of a proof for which there is room at first.
#define STEPS 64

/// The result for one pair: an impact, or none.
typedef struct impact {
    ovoid_couple couple;
    ovoid_impact found;
    uint32_t parts[2]; ///< of compounds: those that meet
    ovoid_step *steps;
    ovoid_step_group *groups; ///< of compounds
    size_t group_count;
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

/// The beginning of an object's box along x.
typedef struct cli_span {
    double low;
    uint32_t object;
} cli_span;

int impacts_open(cli_impacts *x) {
    size_t count = ovoid_scene_get_count(x->scene);
    x->boxes = calloc(count + 1, sizeof *x->boxes);
    x->is_fresh = calloc(count + 1, 1);
    x->spans = calloc(count + 1, sizeof *x->spans);
    if (x->boxes && x->is_fresh && x->spans) return 0;
    message_error("out of memory");
    impacts_close(x);
    return EXIT_INPUT;
}

void impacts_close(cli_impacts *x) {
    free(x->boxes);
    free(x->is_fresh);
    free(x->spans);
    free(x->held);
    free(x->open);
    free(x->couples);
    *x = (cli_impacts){.scene = NULL};
}

static int add_couple(ovoid_couple **couples, size_t *count, size_t *capacity, ovoid_couple couple) {
    if (*count == *capacity) {
        size_t grown = *capacity ? 2 * *capacity : 256;
        ovoid_couple *moved = realloc(*couples, grown * sizeof *moved);
        if (!moved) return message_error("out of memory for %zu pairs", grown), EXIT_INPUT;
        *couples = moved;
        *capacity = grown;
    }
    (*couples)[(*count)++] = couple;
    return 0;
}

int impacts_hold(cli_impacts *x, ovoid_couple couple) {
    return add_couple(&x->held, &x->held_count, &x->held_capacity, couple);
}

int impacts_leave_open(cli_impacts *x, ovoid_couple couple) {
    return add_couple(&x->open, &x->open_count, &x->open_capacity, couple);
}

/* ---- which pairs come near each other */

/// An object with its motion from the frame before to this one.
static ovoid_moving_body get_moving(const cli_impacts *x, size_t object) {
    const ovoid_pose any = ovoid_pose_make_identity();
    ovoid_body o = answers_get_body(x->scene, object, &any);
    return (ovoid_moving_body){
        .shape = o.shape, .compound = o.compound, .motion = frames_get_motion(x->frames, object), .solid = o.solid};
}

static double get_duration(const cli_impacts *x) { return x->frames->time - x->frames->earlier; }

static void make_box(cli_impacts *x, size_t object) {
    int moves = x->frames->is_moved[object];
    if (!moves && x->is_fresh[object]) return;
    ovoid_moving_body moving = get_moving(x, object);
    ovoid_box *box = &x->boxes[object];
    *box = ovoid_moving_body_compute_box(&moving, 0, get_duration(x));
    // A body without a box is near all others.
    if (isnan(box->min.x)) *box = (ovoid_box){{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};
    x->is_fresh[object] = !moves;
}

/// 1 if two boxes are not proven farther apart than the margin.
static int is_near(const ovoid_box *a, const ovoid_box *b, double margin) {
    const double gaps[] = {b->min.x - a->max.x, a->min.x - b->max.x, b->min.y - a->max.y,
                           a->min.y - b->max.y, b->min.z - a->max.z, a->min.z - b->max.z};
    for (int i = 0; i < 6; i++)
        if (gaps[i] > margin * (1 + 1e-15)) return 0;
    return 1;
}

static int compare_couples(const void *a, const void *b) {
    const ovoid_couple *p = a, *q = b;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : p->b > q->b;
}

/// 1 if the pair is among these, which ascend.
static int has_couple(const ovoid_couple *couples, size_t count, ovoid_couple c) {
    return count && bsearch(&c, couples, count, sizeof c, compare_couples);
}

/// 1 for a candidate: one of the two moves, the scene does not ignore the pair, and it was not proven within the
/// margin.
static int is_candidate(const cli_impacts *x, ovoid_couple c) {
    if (!x->frames->is_moved[c.a] && !x->frames->is_moved[c.b]) return 0;
    if (!shard_part_has_pair(x->part, c.a, c.b)) return 0;
    if (!is_near(&x->boxes[c.a], &x->boxes[c.b], x->margin) || ovoid_scene_is_ignored(x->scene, c.a, c.b)) return 0;
    return !has_couple(x->held, x->held_count, c);
}

static int compare_spans(const void *a, const void *b) {
    const cli_span *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    return p->object < q->object ? -1 : p->object > q->object;
}

static int find_couples(cli_impacts *x) {
    size_t count = ovoid_scene_get_count(x->scene);
    int code = 0;
    x->couple_count = 0;
    for (size_t i = 0; i < count; i++) {
        make_box(x, i);
        x->spans[i] = (cli_span){x->boxes[i].min.x, (uint32_t)i};
    }
    qsort(x->spans, count, sizeof *x->spans, compare_spans);
    for (size_t i = 0; i < count; i++) {
        uint32_t a = x->spans[i].object;
        double end = x->boxes[a].max.x + x->margin;
        end += 1e-15 * fabs(end);
        for (size_t k = i + 1; k < count && !(x->spans[k].low > end) && !code; k++) {
            uint32_t b = x->spans[k].object;
            ovoid_couple c = {a < b ? a : b, a < b ? b : a};
            if (is_candidate(x, c)) code = add_couple(&x->couples, &x->couple_count, &x->couple_capacity, c);
        }
    }
    if (x->couple_count) qsort(x->couples, x->couple_count, sizeof *x->couples, compare_couples);
    return code;
}

/* ---- their impacts */

/// Makes room for the steps of a proof and, of compounds, for their groups. 0 where memory is out.
static int reserve(impact *item, ovoid_motion_options *options) {
    options->steps = realloc(item->steps, options->capacity * sizeof *item->steps);
    if (!options->steps) return 0;
    item->steps = options->steps;
    if (!options->group_capacity) return 1;
    options->groups = realloc(item->groups, options->group_capacity * sizeof *item->groups);
    if (!options->groups) return 0;
    item->groups = options->groups;
    return 1;
}

/// Finds the impact of a pair, with its steps where they are wanted.
static void find_impact(const cli_impacts *x, impact *item) {
    ovoid_moving_body a = get_moving(x, item->couple.a), b = get_moving(x, item->couple.b);
    int proofs = results_have_proofs(x->results), are_solids = a.solid || b.solid;
    int is_compound = are_solids || a.compound || b.compound;
    ovoid_motion_options options = {.capacity = proofs ? STEPS : 0,
                                    .group_capacity = proofs && is_compound ? STEPS : 0};
    for (;;) {
        item->failed = proofs && !reserve(item, &options);
        if (item->failed) return;
        ovoid_compound_impact found = are_solids ? ovoid_solid_impact_find(&a, &b, x->margin, &options)
                                                 : ovoid_compound_impact_find(&a, &b, x->margin, &options);
        item->found = found.impact;
        item->parts[0] = found.part_a;
        item->parts[1] = found.part_b;
        item->group_count = found.group_count;
        if (!proofs) return;
        if (!is_compound) item->group_count = 0;
        if (found.impact.step_count <= options.capacity && item->group_count <= options.group_capacity) return;
        if (options.capacity < found.impact.step_count) options.capacity = found.impact.step_count;
        if (options.group_capacity < item->group_count) options.group_capacity = item->group_count;
    }
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
        w->items[i].couple = w->impacts->couples[i];
        find_impact(w->impacts, &w->items[i]);
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

static int is_hit(const impact *item) { return item->found.status == OVOID_IMPACT_HIT; }

/// The time of an impact: when the pair is within the margin; where that is not proven, until when it is free.
static double get_time(const impact *item) { return is_hit(item) ? item->found.hit_at : item->found.free_until; }

static int compare_impacts(const void *a, const void *b) {
    const impact *p = a, *q = b;
    double s = get_time(p), t = get_time(q);
    if (s != t) return s < t ? -1 : 1;
    return compare_couples(&p->couple, &q->couple);
}

static int is_shape(const cli_impacts *x, size_t object) {
    ovoid_scene_object o = ovoid_scene_get(x->scene, object);
    return !o.compound && !o.solid;
}

/// The answer of compounds or solids at a time between the frames, at which a hit is within the margin. 0 where memory
/// is out.
static int answer_compounds(const cli_impacts *x, const impact *item, answer_room *room, ovoid_record *record) {
    const ovoid_couple c = item->couple;
    double at = get_time(item);
    ovoid_motion motions[2] = {frames_get_motion(x->frames, c.a), frames_get_motion(x->frames, c.b)};
    ovoid_pose poses[2] = {ovoid_motion_compute_pose(&motions[0], at), ovoid_motion_compute_pose(&motions[1], at)};
    ovoid_body_pair pair = {answers_get_body(x->scene, c.a, &poses[0]), answers_get_body(x->scene, c.b, &poses[1])};
    answers_query query = {QUERY_WITHIN, x->margin, 0, results_have_proofs(x->results), NULL};
    int done = answers_find(room, &pair, &query, record);
    if (!done || !is_hit(item) || record->answer.upper <= x->margin) return done;
    // Of bodies with allowances the few pairs of one proof may show less than those of the hit.
    ovoid_compound_proof earlier = {item->parts[0], item->parts[1], item->found.hit.proof};
    query.earlier = &earlier;
    return answers_find(room, &pair, &query, record);
}

/// Makes the record of an impact. Of compounds the answer is that of the whole bodies at that time, whose proof is
/// complete. Where the impact is not proven, the record says why, and has the answer where the free time ends. 0 where
/// memory is out.
static int make_record(const cli_impacts *x, const impact *item, answer_room *room, ovoid_record *record) {
    const ovoid_couple c = item->couple;
    double at = get_time(item);
    *record = (ovoid_record){.a = ovoid_scene_get(x->scene, c.a).name,
                             .b = ovoid_scene_get(x->scene, c.b).name,
                             .answer = is_hit(item) ? item->found.hit : item->found.free,
                             .fields = x->results->fields,
                             .time = x->frames->earlier + at,
                             .frame = x->frames->earlier,
                             .margin = x->margin,
                             .free_for = item->found.free_until,
                             .hit_after = item->found.hit_at,
                             .part_a = OVOID_RECORD_NO_PART,
                             .part_b = OVOID_RECORD_NO_PART};
    record->steps = item->steps;
    record->step_count = item->steps ? item->found.step_count : 0;
    record->groups = item->groups;
    record->group_count = item->groups ? item->group_count : 0;
    int done = 1;
    answers_describe(x->scene, c, record);
    if (!is_shape(x, c.a) || !is_shape(x, c.b)) done = answer_compounds(x, item, room, record);
    if (!is_hit(item)) record->answer.limit = item->found.limit;
    return done;
}

/// 1 if a pair that is proven free until the frame, but for the tolerance, is not proven beyond the margin there: it
/// arrives with the frame, whose own line says how near it is. That it meets no later than that, a bracket of the
/// distance around the margin cannot prove.
static int is_arrival(const cli_impacts *x, const impact *item) {
    const cli_frames *f = x->frames;
    const ovoid_couple c = item->couple;
    double duration = f->time - f->earlier;
    if (item->found.status != OVOID_IMPACT_UNDECIDED || !(item->found.free_until >= (1 - TOLERANCE) * duration))
        return 0;
    ovoid_body_pair pair = {answers_get_body(x->scene, c.a, &f->poses[c.a]),
                            answers_get_body(x->scene, c.b, &f->poses[c.b])};
    ovoid_answer at_end;
    if (pair.a.solid || pair.b.solid) {
        ovoid_record record = {.a = NULL};
        ovoid_solid_answer found = ovoid_solid_within(&pair, x->margin, NULL, NULL, NULL);
        ovoid_record_set_solid(&record, &found);
        at_end = record.answer;
    } else {
        at_end = ovoid_compound_within(&pair, x->margin, NULL, NULL, NULL).answer;
    }
    int within = ovoid_answer_is_within(&at_end, x->margin);
    return within > 0 || (within < 0 && at_end.limit == OVOID_LIMIT_NONE);
}

/// Writes the line of an impact. Those of a frame come before its own lines, in the order of compare_impacts.
static int write_impact(cli_impacts *x, const impact *item, const ovoid_record *record) {
    if (!x->results->shard) return results_add(x->results, record);
    const shard_key key = {{2 * (uint64_t)x->frames->count, shard_key_from_number(get_time(item)),
                            (uint64_t)item->couple.a << 32 | item->couple.b}};
    return results_add_record(x->results, &key, record);
}

static int write_impacts(cli_impacts *x, const impact *items) {
    answer_room room = {.cover = NULL};
    int code = 0;
    for (size_t i = 0; i < x->couple_count && !code; i++) {
        ovoid_record record;
        if (items[i].found.status == OVOID_IMPACT_FREE) continue;
        // That an open pair stays open is in the lines of the frames.
        if (!is_hit(&items[i]) && has_couple(x->open, x->open_count, items[i].couple)) continue;
        int arrives = is_arrival(x, &items[i]);
        if (is_hit(&items[i]) || arrives)
            x->found++;
        else
            x->not_proven++;
        if (!make_record(x, &items[i], &room, &record)) code = EXIT_INPUT, message_error("out of memory");
        if (arrives) record.hit_after = x->frames->time - x->frames->earlier, record.time = x->frames->time;
        if (!code && !arrives) code = write_impact(x, &items[i], &record);
        if (!code) x->take(x->context, items[i].couple, &record);
    }
    answer_room_clear(&room);
    return code;
}

/// Finds the impacts of the candidates and writes them.
static int find_impacts(cli_impacts *x) {
    work_state w = {x, calloc(x->couple_count, sizeof(impact)), 0};
    int code = 0;
    if (!w.items) return message_error("out of memory"), EXIT_INPUT;
    cli_pipeline line = {&w, sizeof(chunk), fill, work, drain, clear};
    unsigned threads = x->threads ? x->threads : pipeline_get_processors();
    code = pipeline_run(&line, x->couple_count <= CHUNK ? 1 : threads);
    if (code < 0) message_error("out of memory or threads"), code = EXIT_INPUT;
    if (!code) qsort(w.items, x->couple_count, sizeof *w.items, compare_impacts);
    if (!code) code = write_impacts(x, w.items);
    for (size_t i = 0; i < x->couple_count; i++) {
        free(w.items[i].steps);
        free(w.items[i].groups);
    }
    free(w.items);
    return code;
}

int impacts_find(cli_impacts *x) {
    int code = frames_check_motions(x->frames);
    if (!code) code = find_couples(x);
    if (!code && x->couple_count) code = find_impacts(x);
    x->held_count = x->open_count = 0;
    return code;
}
