// A search of a path, and what covers use of it.
#ifndef OVOID_ROBOT_PATH_SEARCH_H
#define OVOID_ROBOT_PATH_SEARCH_H

#include "robot/path/cover.h"

enum { SEARCH_LEVELS = 31 }; // so begin, end and middle of an interval are exact numbers

/// What is between the bits of the masks: eights of parts for each item, then eights of pairs of items.
struct path_memory {
    path_work w;
    path_cover cover;
    uint32_t groups;
    size_t mask_count, state_size;
    uint8_t *queried; ///< the masks of all pairs that are queried
    uint8_t *masks;   ///< of each level
    uint8_t *is_open; ///< of each item: it has open pairs
    char *states;     ///< the middle's of each level, then those of the segment's ends, and of a state ahead
};

/// Segments: those of a path follow one another, edges are apart.
typedef struct segment_list {
    const double *states; ///< of the first segment
    size_t count;
    size_t step;   ///< numbers from a segment's first state to that of the next segment
    size_t length; ///< from its first state to its second one
    int is_state;  ///< 1: the one segment is one state
    int are_edges; ///< 1: each has a time from 0 to 1 of its own
} segment_list;

typedef struct path_search {
    path_work *w;
    path_memory *memory;
    ovoid_robot_checker *checker;
    const ovoid_robot_path_options *options;
    ovoid_robot_path_answer *answer;
    segment_list list;
    const double *q0, *q1;
    double segment, margin, tolerance;
    uint32_t states_most;
    size_t set_segment; ///< the number of that which `w` is set to, and one; 0: none
    int is_still;       ///< the segment's states are one
    int is_settled;     ///< the answer's hit is one that its check finds again
} path_search;

static inline path_state search_get_state(const path_search *s, uint32_t level) {
    return path_place_state(s->w->cell, s->memory->states + level * s->memory->state_size);
}
static inline uint8_t *search_get_masks(const path_search *s, uint32_t level) {
    return s->memory->masks + level * s->memory->mask_count;
}

/// The pairs that the options leave of all that are queried.
void search_open_all(const path_search *s, uint8_t *masks);
/// Sets the work to a segment of the list, if it is not; the codes of path_set_segment.
ovoid_code search_set_segment(path_search *s, size_t index, ovoid_error *refused);
/// The answer where a segment was refused.
void search_refuse(path_search *s, ovoid_code code, const ovoid_error *refused);
/// A hit was found, and is the answer; free is what was proven up to `begin`, both in the time of the segment.
void search_end_with(path_search *s, double begin, double at, const ovoid_robot_answer *hit);
/// Searches an interval of the segment that was set for what is open at level 0. 1: it is free; else the answer says.
int search_run_open(path_search *s, double begin, double end);
/// All of the segment that was set is free.
void search_end_segment(path_search *s);
/// The answer's hit as its check finds it again, if that was not seen to. What is within rounding of the margin may be
/// none then. first: the number of the path's first segment in the list.
void search_settle_hit(path_search *s, const ovoid_robot_path *path, size_t first);
/// An edge of the list as a path of its own, without covers; states that were checked before count.
void search_run_edge(path_search *s, size_t index);
/// The whole list, without covers; has_pairs: there is one to ask about.
void search_run_all(path_search *s, int has_pairs);

/// 1 where covers prove what they can first.
static inline int search_uses_covers(const ovoid_robot_path_options *o) { return o->any_hit && !o->steps; }
/// The whole list, a path, by covers. 1: it was decided, and all but free_until of a hit is as without covers.
int covered_run_path(path_search *s);
/// Each edge of the list from `first` to before `end` by covers, several side by side.
void covered_run_edges(path_search *s, size_t first, size_t end, ovoid_robot_path_answer *answers);

#endif
