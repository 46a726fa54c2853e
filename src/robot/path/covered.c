// Paths and edges by covers: segments go into blocks of lanes, as many as there is room for, and the search gets what
// covers leave of each.
#include "robot/path/search.h"

#include "base/watch.h"

#include <string.h>

// The most that variables may change along a segment, summed, to begin in two lanes, and in four.
#define MOVED_IN_TWO 2.0
#define MOVED_IN_FOUR 8.0

static uint32_t count_parts(const path_search *s, const double *q0) {
    const double *q1 = q0 + s->list.length;
    double moved = 0;
    for (uint32_t i = 0; i < s->w->cell->robot->variable_count; i++) moved += fabs(q1[i] - q0[i]);
    return moved <= MOVED_IN_TWO ? 2 : moved <= MOVED_IN_FOUR ? 4 : COVER8;
}

// Segments of the list from `first` to before `end` that are proven together.
typedef struct pack {
    size_t first, end, count;
    ovoid_code code; ///< why no more of them were added, where one was refused
    ovoid_error refused;
} pack;

// Adds as many as a block has room for, up to one that is refused.
static void add_segments(path_search *s, pack *p) {
    path_cover *cover = &s->memory->cover;
    // Quaternions of floating joints are those of one segment.
    size_t most = s->w->cell->robot->free_count ? 1 : COVER_SEGMENTS;
    search_open_all(s, search_get_masks(s, 0));
    path_cover_begin(cover, &(cover_query){.queried = search_get_masks(s, 0),
                                           .mask_groups = s->memory->groups,
                                           .margin = s->margin,
                                           .state = search_get_state(s, SEARCH_LEVELS + 2),
                                           .tables = s->checker->pair_tables,
                                           .watch = &s->options->watch,
                                           .generation = s->checker->generation});
    p->code = OVOID_OK;
    uint32_t lanes = 0;
    for (p->count = 0; p->count < most && p->first + p->count < p->end; p->count++) {
        size_t index = p->first + p->count;
        uint32_t parts = count_parts(s, s->list.states + index * s->list.step);
        if (lanes + parts > COVER8) return;
        p->code = search_set_segment(s, index, &p->refused);
        if (p->code != OVOID_OK) return;
        path_cover_add(cover, s->q0, s->q1, parts);
        lanes += parts;
    }
}

static void prove(path_search *s, const pack *p) {
    path_cover *cover = &s->memory->cover;
    path_cover_set(cover);
    path_cover_prove(cover);
    s->set_segment = cover->set_segment < p->count ? p->first + cover->set_segment + 1 : 0;
}

// A segment of a pack by what covers say of it and, if that is not all, the search. 1: it is free.
static int finish(path_search *s, size_t index, const cover_segment *of) {
    if (of->hit_at < INFINITY) {
        s->segment = s->list.are_edges ? 0 : (double)index;
        s->answer->states++;
        search_end_with(s, 0, of->hit_at, &of->hit);
        s->is_settled = 1;
        return 0;
    }
    ovoid_error refused;
    // It was not refused when it was added.
    if (of->is_open && search_set_segment(s, index, &refused) == OVOID_OK) {
        memcpy(search_get_masks(s, 0), of->left, s->memory->mask_count);
        if (!search_run_open(s, of->begin, of->end)) return 0;
    }
    s->segment = s->list.are_edges ? 0 : (double)index;
    search_end_segment(s);
    return 1;
}

// ---- a path

// 1: all segments of a pack are free. A hit of one ends the path, whatever is open of those before it.
static int finish_pack(path_search *s, const pack *p) {
    const cover_segment *segments = s->memory->cover.segments;
    for (size_t i = 0; i < p->count; i++) {
        if (!(segments[i].hit_at < INFINITY)) continue;
        size_t open = 0;
        while (open < i && !segments[open].is_open) open++;
        (void)finish(s, p->first + i, &segments[i]);
        s->answer->free_until = (double)(p->first + open);
        return 0;
    }
    for (size_t i = 0; i < p->count; i++)
        if (!finish(s, p->first + i, &segments[i])) return 0;
    return 1;
}

int covered_run_path(path_search *s) {
    s->answer->status = OVOID_ROBOT_FREE;
    pack p = {.first = 0, .end = s->list.count};
    s->set_segment = 0;
    for (; p.first < p.end; p.first += p.count) {
        if (watch_is_stopped(&s->options->watch) || s->answer->states >= s->states_most) return 0;
        add_segments(s, &p);
        if (p.count == 0) {
            search_refuse(s, p.code, &p.refused);
            return 1;
        }
        prove(s, &p);
        if (!finish_pack(s, &p)) return s->answer->status != OVOID_ROBOT_UNDECIDED;
    }
    return 1;
}

// ---- edges

// An edge that covers and the search of what they leave do not decide is searched as a path of its own.
static void finish_edge(path_search *s, size_t index, const cover_segment *of) {
    s->answer->status = OVOID_ROBOT_FREE;
    s->is_settled = 0;
    if (!finish(s, index, of)) {
        const ovoid_robot_path path = {s->list.states + index * s->list.step, 2};
        search_settle_hit(s, &path, index);
        if (s->answer->status == OVOID_ROBOT_UNDECIDED) search_run_edge(s, index);
    }
    s->answer->step_count = 0;
}

void covered_run_edges(path_search *s, size_t first, size_t end, ovoid_robot_path_answer *answers) {
    pack p = {.first = first, .end = end};
    s->set_segment = 0;
    // Edges that are not looked at any more stay undecided.
    while (p.first < p.end && !watch_is_stopped(&s->options->watch)) {
        add_segments(s, &p);
        if (p.count) prove(s, &p);
        for (size_t i = 0; i < p.count; i++) {
            s->answer = &answers[p.first + i];
            finish_edge(s, p.first + i, &s->memory->cover.segments[i]);
        }
        p.first += p.count;
        if (p.count) continue;
        s->answer = &answers[p.first++];
        search_refuse(s, p.code, &p.refused);
    }
}
