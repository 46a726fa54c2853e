// The number of frames is not known in advance: whenever there is no more room every second frame is dropped.
#include "page/motion.h"

#include "base/members.h"
#include "base/message.h"
#include "io/fields.h"
#include "page/write.h"
#include "tools/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// The largest number of frames, and of bytes of their poses.
#define FRAMES_MOST 2000
#define BYTES_MOST 32000000u

/// Bytes of a pose.
#define POSE_BYTES 56

/// The largest number of events.
#define EVENTS_MOST 100000

int page_motion_open(page_motion *m, size_t object_count) {
    size_t fits = BYTES_MOST / (POSE_BYTES * (object_count + 1));
    *m = (page_motion){.object_count = object_count,
                       .stride = 1,
                       .most = fits < 2             ? 2
                               : fits > FRAMES_MOST ? FRAMES_MOST
                                                    : fits};
    // Room for one more: the last frame.
    m->times = malloc((m->most + 1) * sizeof *m->times);
    m->poses = malloc((m->most + 1) * (object_count + 1) * sizeof *m->poses);
    m->last = malloc((object_count + 1) * sizeof *m->last);
    if (m->times && m->poses && m->last) return 0;
    page_motion_close(m);
    return message_error("out of memory"), EXIT_INPUT;
}

void page_motion_close(page_motion *m) {
    free(m->times);
    free(m->poses);
    free(m->last);
    free(m->events);
    *m = (page_motion){.object_count = 0};
}

static ovoid_pose *get_frame(const page_motion *m, size_t i) { return m->poses + i * m->object_count; }

static void keep(page_motion *m, double time, const ovoid_pose *poses) {
    if (m->object_count) memcpy(get_frame(m, m->count), poses, m->object_count * sizeof *poses);
    m->times[m->count++] = time;
}

/// Drops every second frame.
static void thin(page_motion *m) {
    size_t half = (m->count + 1) / 2;
    for (size_t i = 1; i < half; i++) {
        if (m->object_count) memcpy(get_frame(m, i), get_frame(m, 2 * i), m->object_count * sizeof *m->poses);
        m->times[i] = m->times[2 * i];
    }
    m->count = half;
    m->stride *= 2;
}

void page_motion_add_frame(page_motion *m, double time, const ovoid_pose *poses) {
    if (m->seen % m->stride == 0 && m->count == m->most) thin(m);
    if (m->seen % m->stride == 0) keep(m, time, poses);
    if (m->object_count) memcpy(m->last, poses, m->object_count * sizeof *poses);
    m->last_time = time;
    m->seen++;
}

int page_motion_finish(page_motion *m) {
    if (m->failed) return message_error("out of memory"), EXIT_INPUT;
    if (m->seen && (m->seen - 1) % m->stride) keep(m, m->last_time, m->last);
    return 0;
}

size_t page_motion_find_frame(const page_motion *m, size_t frame) {
    size_t i = (frame + m->stride / 2) / m->stride;
    return i < m->count ? i : m->count - 1;
}

// ---- events

static void add_event(page_motion *m, page_event event) {
    if (m->event_count == EVENTS_MOST) {
        m->event_lost++;
        return;
    }
    if (!array_reserve((void **)&m->events, &m->event_capacity, m->event_count, sizeof event))
        m->failed = 1;
    else
        m->events[m->event_count++] = event;
}

void page_motion_add_impact(page_motion *m, ovoid_couple couple, const ovoid_record *record, double until) {
    double from = record->frame + record->free_for;
    int is_proven = isfinite(record->hit_after);
    add_event(m, (page_event){is_proven ? record->time : until, from, couple, is_proven ? "impact" : "unproven"});
}

void page_motion_add_firsts(page_motion *m, const cli_track *track) {
    for (size_t i = 0; i < track->touch.count; i++) {
        const track_event *e = &track->touch.items[i];
        add_event(m, (page_event){e->until, e->from, e->couple, "contact"});
    }
    for (size_t i = 0; i < track->reach.count; i++) {
        const track_event *e = &track->reach.items[i];
        add_event(m, (page_event){e->until, e->from, e->couple, "within"});
    }
}

// ---- writing

static void write_times(FILE *file, const page_motion *m) {
    fputs(",\"motion\":{\"times\":", file);
    json_write_numbers(file, m->times, m->count);
    fputs(",\"poses\":", file);
}

static void write_poses(FILE *file, const page_motion *m, const page_choice *choice) {
    page_base64 to = page_base64_begin(file);
    for (size_t i = 0; i < m->count; i++)
        for (size_t k = 0; k < m->object_count; k++) {
            if (choice->numbers[k] == PAGE_NO_NUMBER) continue;
            const ovoid_vec3 p = get_frame(m, i)[k].position;
            const ovoid_quat q = get_frame(m, i)[k].rotation;
            const double numbers[] = {p.x, p.y, p.z, q.w, q.x, q.y, q.z};
            for (int n = 0; n < 7; n++) page_base64_add_double(&to, numbers[n]);
        }
    page_base64_end(&to);
}

/// Writes the events between bodies that are on the page. Returns how many are not.
static size_t write_events(FILE *file, const page_motion *m, const page_choice *choice) {
    size_t lost = 0;
    const char *before = "";
    fputs(",\"events\":[", file);
    for (size_t i = 0; i < m->event_count; i++) {
        const page_event *e = &m->events[i];
        uint32_t a = choice->numbers[e->couple.a], b = choice->numbers[e->couple.b];
        lost += a == PAGE_NO_NUMBER || b == PAGE_NO_NUMBER;
        if (a == PAGE_NO_NUMBER || b == PAGE_NO_NUMBER) continue;
        fprintf(file, "%s{\"time\":", before);
        json_write_number(file, e->time);
        fputs(",\"from\":", file);
        json_write_number(file, e->from);
        fprintf(file, ",\"a\":%lu,\"b\":%lu,\"kind\":\"%s\"}", (unsigned long)a, (unsigned long)b, e->kind);
        before = ",";
    }
    fputc(']', file);
    return lost;
}

void page_motion_write(cli_page *page, const page_motion *m, const page_choice *choice, double margin) {
    FILE *file = page->file;
    write_times(file, m);
    write_poses(file, m, choice);
    page->left_out.events += m->event_lost + write_events(file, m, choice);
    page->left_out.frames += m->seen - m->count;
    fprintf(file, ",\"between\":%s", m->is_continuous && m->seen == m->count ? "true" : "false");
    member_write_number(file, ",", "margin", margin >= 0 ? margin : NAN);
    fputc('}', file);
}
