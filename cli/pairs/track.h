// The summary of a motion: the first contact, the smallest distance, and for the plot the distances of each pair over
// time.
#ifndef OVOID_CLI_PAIRS_TRACK_H
#define OVOID_CLI_PAIRS_TRACK_H

#include <ovoid/io.h>
#include <ovoid/ovoid.h>

/// A value at a frame, or at an impact between it and the next.
typedef struct track_point {
    size_t frame;
    double time, lower, upper;
    int is_measured; ///< 0: the bracket is wide, as for a yes or no
    int is_impact;
} track_point;

/// The points of one pair.
typedef struct track_pair {
    uint32_t a, b;
    track_point *points;
    size_t count, capacity;
    double lowest;
    size_t lowest_frame; ///< the frame of the lowest point, or the frame before it if that is an impact
} track_pair;

/// A contact, or an impact: after `from`, not later than `until`. If the impact is not proven, nothing is proven
/// between both, and `limit` says why.
typedef struct track_event {
    double from, until;
    ovoid_couple couple;
    uint32_t part_a, part_b;
    ovoid_limit limit;
} track_event;

/// The largest number of events that are listed.
#define TRACK_LISTED 10

/// The first events of a kind.
typedef struct track_events {
    track_event items[TRACK_LISTED];
    size_t count; ///< of the items
} track_events;

/// What is proven, or left open, about a pair in the first frame; bits.
enum track_state {
    TRACK_TOUCHES = 1, ///< it touches or overlaps
    TRACK_WITHIN = 2,  ///< it is within the margin, or touches
    TRACK_SIGN = 4,    ///< it is neither proven to be apart nor to touch
    TRACK_MARGIN = 8   ///< it is proven on neither side of the margin
};

/// A pair of the first frame with its states.
typedef struct track_start {
    ovoid_couple couple;
    unsigned states; ///< of enum track_state
} track_start;

typedef struct cli_track {
    track_start *starts; ///< ascending; the events below are not of pairs that begin with them, proven
    size_t start_count, start_capacity;
    track_events touch;    ///< the first touching or overlapping frame
    track_events reach;    ///< the first time within the margin, by a frame or an impact
    track_events impacts;  ///< the first of each pair
    track_events unproven; ///< impacts that are not proven
    int has_smallest, has_nearest;
    ovoid_record smallest; ///< of the frames, the record of the smallest distance; names and time are valid
    ovoid_record nearest;  ///< of the impacts, the record of the smallest distance
    int failed;            ///< no memory
    // For a plot or a page; unused if neither is wanted.
    int has_plot, has_pairs; ///< has_pairs: the pairs are kept, without their points
    int is_full;             ///< too many points
    int has_wide;            ///< some bracket is wide
    double first, last;      ///< times of the frames
    size_t frame_count;
    track_pair *pairs;
    size_t pair_count, pair_capacity;
    size_t *slots; ///< pairs by their objects, as index + 1
    size_t slot_count, point_count;
} cli_track;

/// Begins a frame.
void track_add_frame(cli_track *track, double time);
/// Adds one of its records, of objects a and b. earlier: the time of the frame before, NaN for the first.
void track_add(cli_track *track, ovoid_couple couple, const ovoid_record *record, double margin, double earlier);
/// Adds an impact within the margin, proven or not, from its record. until: the time of the frame after it.
void track_add_impact(cli_track *track, ovoid_couple couple, const ovoid_record *record, double until);

/// The number of pairs that begin in the state; the first of them are written to `first`, up to `most`.
size_t track_get_starts(const cli_track *track, enum track_state state, ovoid_couple *first, size_t most);

/// Draws the distances of the nearest pairs, after the last frame. 0, or EXIT_INPUT after a message.
int track_write_plot(cli_track *track, const char *path, const ovoid_scene *scene, double margin);

void track_clear(cli_track *track);

#endif
