// The summary of a motion, and its plot. Memory: a point for each pair and frame within the margin and for each impact,
// only if a plot is wanted.
#include "pairs/track.h"

#include "base/args.h"
#include "base/finish.h"
#include "base/message.h"
#include "results.h"
#include "tools/array.h"
#include "tools/hash.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// The largest number of points of a plot: 40 bytes each.
#define POINTS_MAX 50000000

/// The largest number of pairs in a plot.
#define DRAWN_MAX 6

/// The largest number of points of a line before neighbours are drawn as one.
#define LINE_POINTS 1500

/* ---- keeping */

static int is_end(const void *table, size_t slot, const void *key) {
    const cli_track *t = table;
    const ovoid_couple *couple = key;
    size_t at = t->slots[slot];
    return !at || (t->pairs[at - 1].a == couple->a && t->pairs[at - 1].b == couple->b);
}

static size_t *find_slot(const cli_track *t, uint32_t a, uint32_t b) {
    return &t->slots[hash_find(hash_pair(a, b), t->slot_count, t, &(ovoid_couple){a, b}, is_end)];
}

static int grow_slots(cli_track *t) {
    if (2 * (t->pair_count + 1) <= t->slot_count) return 1;
    size_t count = t->slot_count ? 2 * t->slot_count : 64, *slots = calloc(count, sizeof *slots);
    if (!slots) return 0;
    free(t->slots);
    t->slots = slots;
    t->slot_count = count;
    for (size_t i = 0; i < t->pair_count; i++) *find_slot(t, t->pairs[i].a, t->pairs[i].b) = i + 1;
    return 1;
}

/// The pair's entry, made if it is new; NULL if memory runs out.
static track_pair *find_pair(cli_track *t, ovoid_couple couple) {
    if (!grow_slots(t)) return NULL;
    size_t *slot = find_slot(t, couple.a, couple.b);
    if (*slot) return &t->pairs[*slot - 1];
    if (!array_reserve((void **)&t->pairs, &t->pair_capacity, t->pair_count, sizeof *t->pairs)) return NULL;
    t->pairs[t->pair_count] = (track_pair){.a = couple.a, .b = couple.b, .lowest = INFINITY};
    *slot = ++t->pair_count;
    return &t->pairs[t->pair_count - 1];
}

/// Adds a point to the present frame, and updates the lowest one; 0 if there is no more room.
static int add_point(cli_track *t, ovoid_couple couple, const ovoid_record *record, int is_impact) {
    const ovoid_answer *answer = &record->answer;
    track_pair *pair = t->point_count < POINTS_MAX ? find_pair(t, couple) : NULL;
    int is_measured = answer->limit == OVOID_LIMIT_NONE;
    if (!pair) return 0;
    if (answer->lower < pair->lowest) pair->lowest = answer->lower, pair->lowest_frame = t->frame_count - 1;
    if (!t->has_plot) return 1;
    if (!array_reserve((void **)&pair->points, &pair->capacity, pair->count, sizeof *pair->points)) return 0;
    pair->points[pair->count++] = (track_point){.frame = t->frame_count - 1,
                                                .time = record->time,
                                                .lower = answer->lower,
                                                .upper = answer->upper,
                                                .is_measured = is_measured,
                                                .is_impact = is_impact};
    t->point_count++;
    t->has_wide |= !is_measured;
    return 1;
}

/// Adds a point if a plot or the pairs are wanted, until there are too many.
static void keep_point(cli_track *t, ovoid_couple couple, const ovoid_record *record, int is_impact) {
    if ((t->has_plot || t->has_pairs) && !t->is_full) t->is_full = !add_point(t, couple, record, is_impact);
}

void track_add_frame(cli_track *t, double time) {
    if (!t->frame_count++) t->first = time;
    t->last = time;
}

/* ---- events */

static int compare_starts(const void *a, const void *b) {
    const track_start *p = a, *q = b;
    if (p->couple.a != q->couple.a) return p->couple.a < q->couple.a ? -1 : 1;
    return p->couple.b < q->couple.b ? -1 : p->couple.b > q->couple.b;
}

/// The pair's states in the first frame; 0 if it was farther then.
static unsigned find_states(const cli_track *t, ovoid_couple couple) {
    const track_start key = {couple, 0};
    if (!t->start_count) return 0;
    const track_start *found = bsearch(&key, t->starts, t->start_count, sizeof key, compare_starts);
    return found ? found->states : 0;
}

/// Adds a pair of the first frame; they come in ascending order.
static void add_start(cli_track *t, ovoid_couple couple, unsigned states) {
    t->failed |= !array_reserve((void **)&t->starts, &t->start_capacity, t->start_count, sizeof *t->starts);
    if (!t->failed) t->starts[t->start_count++] = (track_start){couple, states};
}

size_t track_get_starts(const cli_track *t, enum track_state state, ovoid_couple *first, size_t most) {
    size_t count = 0;
    for (size_t i = 0; i < t->start_count; i++) {
        if (!(t->starts[i].states & state)) continue;
        if (count < most) first[count] = t->starts[i].couple;
        count++;
    }
    return count;
}

static track_event make_event(ovoid_couple couple, const ovoid_record *record, double from, double until) {
    return (track_event){from, until, couple, record->part_a, record->part_b, record->answer.limit};
}

/// Adds an event while there are fewer than `most`.
static void add_event(track_events *events, size_t most, track_event event) {
    if (events->count < most) events->items[events->count++] = event;
}

static int has_pair(const track_events *events, ovoid_couple couple) {
    for (size_t i = 0; i < events->count; i++)
        if (events->items[i].couple.a == couple.a && events->items[i].couple.b == couple.b) return 1;
    return 0;
}

/// The states of an answer; margin negative: none.
static unsigned find_answer_states(const ovoid_answer *answer, double margin) {
    if (answer->status == OVOID_TOUCHING || answer->status == OVOID_OVERLAPPING) return TRACK_TOUCHES | TRACK_WITHIN;
    unsigned sign = answer->status == OVOID_UNDECIDED ? TRACK_SIGN : 0;
    int within = margin >= 0 ? ovoid_answer_is_within(answer, margin) : 0;
    if (within > 0) return sign | TRACK_WITHIN;
    int is_open = within < 0 && results_judge(answer, margin) == EXIT_NOT_PROVEN;
    return sign | (is_open ? TRACK_MARGIN : 0);
}

void track_add(cli_track *t, ovoid_couple couple, const ovoid_record *record, double margin, double earlier) {
    const ovoid_answer *answer = &record->answer;
    unsigned states = find_answer_states(answer, margin), starts = find_states(t, couple);
    track_event event = make_event(couple, record, earlier, record->time);
    if (isnan(earlier)) {
        if (states) add_start(t, couple, states);
    } else {
        if (states & ~starts & TRACK_TOUCHES) add_event(&t->touch, 1, event);
        if (states & ~starts & TRACK_WITHIN) add_event(&t->reach, 1, event);
    }
    if (!t->has_smallest || answer->lower < t->smallest.answer.lower) t->smallest = *record, t->has_smallest = 1;
    keep_point(t, couple, record, 0);
}

void track_add_impact(cli_track *t, ovoid_couple couple, const ovoid_record *record, double until) {
    double from = record->frame + record->free_for;
    if (!isfinite(record->hit_after)) {
        add_event(&t->unproven, TRACK_LISTED, make_event(couple, record, from, until));
        return;
    }
    keep_point(t, couple, record, 1);
    track_event event = make_event(couple, record, from, record->time);
    unsigned starts = find_states(t, couple);
    if (!(starts & TRACK_WITHIN)) {
        add_event(&t->reach, 1, event);
        if (!has_pair(&t->impacts, couple)) add_event(&t->impacts, TRACK_LISTED, event);
    }
    if (record->margin == 0 && !(starts & TRACK_TOUCHES)) add_event(&t->touch, 1, event);
    if (!t->has_nearest || record->answer.upper < t->nearest.answer.upper) t->nearest = *record, t->has_nearest = 1;
}

void track_clear(cli_track *t) {
    for (size_t i = 0; i < t->pair_count; i++) free(t->pairs[i].points);
    free(t->pairs);
    free(t->starts);
    free(t->slots);
    *t = (cli_track){.has_plot = 0};
}

/* ---- drawing */

/// The columns of a line.
typedef struct line_room {
    double *x, *y, *low, *high;
    size_t count, capacity;
    char name[128];
} line_room;

/// The line is the lower bound. The bracket of a yes or no is drawn as a band without a line.
static void add_value(line_room *l, double x, const track_point *p) {
    double low = p->lower, high = p->upper;
    l->x[l->count] = x;
    l->low[l->count] = low;
    l->high[l->count] = high;
    l->y[l->count++] = p->is_measured ? low : NAN;
}

/// 1 if the pair was farther than the margin between two of its points.
static int is_gap(const track_point *p, const track_point *next) { return next->frame > p->frame + !next->is_impact; }

/// Fills the line of a pair's distances, with a gap for missing frames and `group` neighbours as one.
static int fill_line(const track_pair *pair, line_room *l) {
    static const track_point no_point = {.lower = NAN, .upper = NAN};
    size_t group = pair->count / LINE_POINTS + 1, room = 2 * pair->count + 2;
    *l = (line_room){.x = malloc(4 * room * sizeof *l->x)};
    if (!l->x) return 0;
    l->y = l->x + room;
    l->low = l->y + room;
    l->high = l->low + room;
    for (size_t i = 0; i < pair->count;) {
        const track_point *first = &pair->points[i];
        if (i && is_gap(first - 1, first)) add_value(l, first->time, &no_point);
        track_point all = *first;
        size_t end = i + 1;
        for (; end < pair->count && end < i + group && !is_gap(&pair->points[end - 1], &pair->points[end]); end++) {
            all.lower = fmin(all.lower, pair->points[end].lower);
            all.upper = fmax(all.upper, pair->points[end].upper);
            all.is_measured &= pair->points[end].is_measured;
        }
        add_value(l, first->time, &all);
        i = end;
    }
    return 1;
}

/// Fills the places of the impacts of pairs: the `high` ends of brackets, which are proven to be within the margin.
static int fill_impacts(const track_pair *pairs, size_t count, line_room *l) {
    size_t room = 1;
    for (size_t i = 0; i < count; i++) room += pairs[i].count;
    *l = (line_room){.x = malloc(2 * room * sizeof *l->x)};
    if (!l->x) return 0;
    l->y = l->x + room;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < pairs[i].count; k++) {
            if (!pairs[i].points[k].is_impact) continue;
            l->x[l->count] = pairs[i].points[k].time;
            l->y[l->count++] = pairs[i].points[k].upper;
        }
    return 1;
}

static int compare_pairs(const void *a, const void *b) {
    const track_pair *p = a, *q = b;
    if (p->lowest != q->lowest) return p->lowest < q->lowest ? -1 : 1;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : p->b > q->b;
}

int track_write_plot(cli_track *t, const char *path, const ovoid_scene *scene, double margin) {
    if (t->is_full)
        return message_error("the plot has too many points for the memory; give a smaller --margin"), EXIT_INPUT;
    line_room lines[DRAWN_MAX], impacts;
    ovoid_series series[DRAWN_MAX + 3];
    size_t count = 0;
    int code = 0;
    // The nearest pairs first.
    if (t->pair_count) qsort(t->pairs, t->pair_count, sizeof *t->pairs, compare_pairs);
    for (; count < t->pair_count && count < DRAWN_MAX && !code; count++) {
        const track_pair *pair = &t->pairs[count];
        line_room *l = &lines[count];
        if (!fill_line(pair, l)) return message_error("out of memory"), EXIT_INPUT;
        snprintf(l->name, sizeof l->name, "%.50s, %.50s", ovoid_scene_get(scene, pair->a).name,
                 ovoid_scene_get(scene, pair->b).name);
        series[count] = (ovoid_series){l->name, OVOID_SERIES_LINE, l->count, l->x, l->y, l->low, l->high};
    }
    if (!fill_impacts(t->pairs, count, &impacts)) return message_error("out of memory"), EXIT_INPUT;
    double ends[2] = {t->frame_count ? t->first : 0, t->frame_count ? t->last : 1};
    double limits[2] = {margin, margin}, nothing[2] = {NAN, NAN};
    size_t drawn = count;
    // The axis spans the whole motion, even without distances.
    series[drawn++] = (ovoid_series){NULL, OVOID_SERIES_LINE, 2, ends, nothing, NULL, NULL};
    if (margin > 0) series[drawn++] = (ovoid_series){"margin", OVOID_SERIES_LINE, 2, ends, limits, NULL, NULL};
    if (impacts.count)
        series[drawn++] = (ovoid_series){"impact", OVOID_SERIES_TICKS, impacts.count, impacts.x, impacts.y, NULL, NULL};
    const char *unit = ovoid_scene_get_unit(scene);
    char title[120], label[40];
    snprintf(label, sizeof label, "signed distance%s%s", unit[0] ? ", " : "", unit);
    snprintf(title, sizeof title, "Signed distance over time: the nearest %zu of %zu pairs%s", count, t->pair_count,
             t->has_wide ? "; a band is where the distance is proven to be" : "");
    ovoid_chart chart = {.title = title,
                         .x_label = "time",
                         .y_label = label,
                         .series = series,
                         .series_count = drawn,
                         .width = 900,
                         .height = 480};
    code = finish_chart(path, &chart);
    for (size_t i = 0; i < count; i++) free(lines[i].x);
    free(impacts.x);
    return code;
}
