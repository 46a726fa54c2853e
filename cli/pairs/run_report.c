// The summary of a motion: pairs that touch from the beginning, the first pairs that come near later, the impacts, and
// the smallest distance. Pairs that rest on each other from the beginning are listed apart from those that meet.
#include "pairs/run_report.h"

#include "base/message.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// The largest number of pairs of the beginning that are named.
#define NAMED_MAX 3

/// Room for the names of a pair.
#define NAMES_ROOM 200

/// "arm[3], table".
static void write_names(char *text, const char *a, uint32_t part_a, const char *b, uint32_t part_b) {
    char parts[2][16] = {"", ""};
    if (part_a != OVOID_RECORD_NO_PART) snprintf(parts[0], 16, "[%lu]", (unsigned long)part_a);
    if (part_b != OVOID_RECORD_NO_PART) snprintf(parts[1], 16, "[%lu]", (unsigned long)part_b);
    snprintf(text, NAMES_ROOM, "%.60s%s, %.60s%s", a, parts[0], b, parts[1]);
}

static void write_event_names(char *text, const run_summary *s, const track_event *event) {
    write_names(text, ovoid_scene_get(s->scene, event->couple.a).name, event->part_a,
                ovoid_scene_get(s->scene, event->couple.b).name, event->part_b);
}

/// "between 1 and 1.5"; the bracket of an impact is narrow, so both ends have as many digits as distinguish them.
static void write_times(char *text, size_t room, double from, double until) {
    char ends[2][40];
    for (int digits = 9; digits <= 17; digits += 4) {
        snprintf(ends[0], sizeof ends[0], "%.*g", digits, from);
        snprintf(ends[1], sizeof ends[1], "%.*g", digits, until);
        if (strcmp(ends[0], ends[1]) != 0) break;
    }
    snprintf(text, room, "between %s and %s", ends[0], ends[1]);
}

static void report_event(const run_summary *s, const char *what, const track_event *event) {
    char names[NAMES_ROOM], times[100];
    write_event_names(names, s, event);
    write_times(times, sizeof times, event->from, event->until);
    message_note("%s: %s, %s", what, names, times);
}

/// "touching from the beginning: 2 pairs: floor, crate; crate, rod".
static size_t report_starts(const run_summary *s, const char *what, enum track_state state) {
    ovoid_couple first[NAMED_MAX];
    char list[NAMED_MAX * NAMES_ROOM] = "";
    size_t count = track_get_starts(s->track, state, first, NAMED_MAX);
    if (!count) return 0;
    for (size_t i = 0; i < count && i < NAMED_MAX; i++) {
        char names[NAMES_ROOM];
        write_names(names, ovoid_scene_get(s->scene, first[i].a).name, OVOID_RECORD_NO_PART,
                    ovoid_scene_get(s->scene, first[i].b).name, OVOID_RECORD_NO_PART);
        size_t length = strlen(list);
        snprintf(list + length, sizeof list - length, "%s%s", i ? "; " : "", names);
    }
    message_note("%s from the beginning: %zu pair%s: %s%s", what, count, count == 1 ? "" : "s", list,
                 count > NAMED_MAX ? "; ..." : "");
    return count;
}

/// The first event of a kind, after the pairs that begin with it.
static void report_first(const run_summary *s, const char *what, size_t starts, const track_events *events) {
    char title[80];
    snprintf(title, sizeof title, "first %s%s", what, starts ? " of the others" : "");
    if (events->count)
        report_event(s, title, &events->items[0]);
    else
        message_note("%s: none", title);
}

static void report_impacts(const run_summary *s) {
    const cli_track *t = s->track;
    if (!s->impacts) return;
    message_note("impacts: %zu, not proven: %zu", s->impacts->found, s->impacts->not_proven);
    for (size_t i = 0; i < t->impacts.count; i++) report_event(s, "  impact", &t->impacts.items[i]);
    if (s->impacts->found > t->impacts.count)
        message_note("  %zu more: later ones of these pairs, of pairs near from the beginning, or of others; see the "
                     "results",
                     s->impacts->found - t->impacts.count);
    for (size_t i = 0; i < t->unproven.count; i++) {
        char names[NAMES_ROOM], times[100];
        const track_event *event = &t->unproven.items[i];
        write_event_names(names, s, event);
        write_times(times, sizeof times, event->from, event->until);
        message_note("  not proven: %s, %s: ended by %s", names, times, ovoid_limit_get_name(event->limit));
    }
    if (s->impacts->not_proven > t->unproven.count)
        message_note("  %zu more that are not proven: see the results", s->impacts->not_proven - t->unproven.count);
}

static void report_smallest(const run_summary *s) {
    const ovoid_record *least = &s->track->smallest, *nearest = &s->track->nearest;
    const char *unit = ovoid_scene_get_unit(s->scene), *gap = unit[0] ? " " : "";
    const char *where = s->impacts ? "smallest distance in the frames" : "smallest distance";
    char names[NAMES_ROOM], distance[64];
    if (!s->measures) return;
    if (s->track->has_smallest) {
        write_names(names, least->a, least->part_a, least->b, least->part_b);
        ovoid_answer_write_distance(distance, &least->answer);
        message_note("%s: %s%s%s, at %.9g, %s", where, distance, gap, unit, least->time, names);
    } else if (s->margin >= 0) {
        message_note("%s: above %g%s%s, proven", where, s->margin, gap, unit);
    }
    // Between the frames bodies may come nearer than in them.
    if (!s->track->has_nearest || (s->track->has_smallest && nearest->answer.upper >= least->answer.lower)) return;
    write_names(names, nearest->a, nearest->part_a, nearest->b, nearest->part_b);
    message_note("nearer between the frames: at most %.9g%s%s, at %.9g, %s", nearest->answer.upper, gap, unit,
                 nearest->time, names);
}

/// Writes one sentence if no pair came within the margin, neither in a frame nor between two. 1: it was written.
static int report_nothing(const run_summary *s, double seconds) {
    const size_t *n = s->counts,
                 listed = n[OVOID_UNDECIDED] + n[OVOID_SEPARATED] + n[OVOID_TOUCHING] + n[OVOID_OVERLAPPING];
    const char *unit = ovoid_scene_get_unit(s->scene);
    if (listed || s->margin < 0 || (s->impacts && s->impacts->found + s->impacts->not_proven > 0)) return 0;
    message_note(
        "%zu frames, %zu objects in %.2f s; nothing comes within %g%s%s%s: all pairs are proven farther apart, "
        "or ignored",
        s->frames, ovoid_scene_get_count(s->scene), seconds, s->margin, unit[0] ? " " : "", unit,
        s->impacts ? ", also between the frames" : " in a frame");
    return 1;
}

void run_report(const run_summary *s, double seconds) {
    const size_t *n = s->counts;
    const char *unit = ovoid_scene_get_unit(s->scene);
    char within[48], farther[80];
    if (report_nothing(s, seconds)) return;
    message_note("%zu frames, %zu objects in %.2f s; pairs listed: %zu; separated: %zu, touching: %zu, overlapping: "
                 "%zu, undecided: %zu",
                 s->frames, ovoid_scene_get_count(s->scene), seconds,
                 n[OVOID_UNDECIDED] + n[OVOID_SEPARATED] + n[OVOID_TOUCHING] + n[OVOID_OVERLAPPING], n[OVOID_SEPARATED],
                 n[OVOID_TOUCHING], n[OVOID_OVERLAPPING], n[OVOID_UNDECIDED]);
    size_t touching = report_starts(s, "touching", TRACK_TOUCHES);
    (void)report_starts(s, "not proven apart", TRACK_SIGN);
    if (s->margin > 0) {
        snprintf(within, sizeof within, "within %g%s%s", s->margin, unit[0] ? " " : "", unit);
        snprintf(farther, sizeof farther, "not proven on either side of %s", within + strlen("within "));
        size_t starts = track_get_starts(s->track, TRACK_WITHIN, NULL, 0);
        if (starts > touching) (void)report_starts(s, within, TRACK_WITHIN);
        (void)report_starts(s, farther, TRACK_MARGIN);
        report_first(s, within, starts, &s->track->reach);
    }
    report_first(s, "contact", touching, &s->track->touch);
    report_impacts(s);
    report_smallest(s);
}
