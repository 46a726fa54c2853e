// The summary of a motion: the first contact, the smallest distance, and for the plot the distances of each pair over
// time.
#ifndef OVOID_CLI_TRACK_H
#define OVOID_CLI_TRACK_H

#include <ovoid/io.h>
#include <ovoid/ovoid.h>

/// A value at a frame.
typedef struct track_point {
    size_t frame;
    double lower, upper;
} track_point;

/// The points of one pair.
typedef struct track_pair {
    uint32_t a, b;
    track_point *points;
    size_t count, capacity;
    double lowest;
} track_pair;

/// A contact between two frames: after `from`, not later than `until`. from is NaN where the motion begins with it.
typedef struct track_event {
    int is_there;
    double from, until;
    uint32_t a, b, part_a, part_b;
} track_event;

typedef struct cli_track {
    track_event touch; ///< the first touching or overlapping frame
    track_event reach; ///< the first time within the margin, by a frame or an impact
    int has_smallest;
    ovoid_record smallest; ///< the record of the smallest distance; names and time hold
    // Of the plot; unused where has_plot is 0.
    int has_plot, failed;
    double *times; ///< of the frames
    size_t frame_count, frame_capacity;
    track_pair *pairs;
    size_t pair_count, pair_capacity;
    size_t *slots; ///< pairs by their objects, as index + 1
    size_t slot_count, point_count;
} cli_track;

/// Begins a frame.
void track_add_frame(cli_track *track, double time);
/// Adds one of its records, of objects a and b. earlier: the time of the frame before, NaN for the first.
void track_add(cli_track *track, ovoid_couple couple, const ovoid_record *record, double margin, double earlier);
/// Adds an impact within the margin, from its record.
void track_add_impact(cli_track *track, ovoid_couple couple, const ovoid_record *record);

/// Draws the distances of the pairs that come nearest, after the last frame. 0, or EXIT_INPUT after a message.
int track_write_plot(cli_track *track, const char *path, const ovoid_scene *scene, double margin);

void track_clear(cli_track *track);

#endif
