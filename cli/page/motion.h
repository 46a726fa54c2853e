// The frames and the events of a motion, for a page.
#ifndef OVOID_CLI_PAGE_MOTION_H
#define OVOID_CLI_PAGE_MOTION_H

#include "page/bodies.h"
#include "pairs/track.h"

/// An event between two objects.
typedef struct page_event {
    double time, from; ///< it is after `from`, and not later than `time`
    ovoid_couple couple;
    const char *kind;
} page_event;

/// Every stride-th frame, and the last one; the largest number of frames depends on the number of objects.
typedef struct page_motion {
    size_t object_count, stride, most;
    size_t count, seen; ///< of the frames that are kept, of all
    double *times;
    ovoid_pose *poses; ///< frame by frame
    ovoid_pose *last;  ///< of the frame that came last
    double last_time;
    page_event *events;
    size_t event_count, event_capacity, event_lost;
    int is_continuous; ///< between two frames objects go as --continuous takes them, from pose to pose
    int failed;        ///< no memory
} page_motion;

/// Begins with no frame. 0, or EXIT_INPUT after a message.
int page_motion_open(page_motion *motion, size_t object_count);

/// Adds the next frame: the poses of all objects.
void page_motion_add_frame(page_motion *motion, double time, const ovoid_pose *poses);

/// Adds an impact from its record; with an infinite hit_after, an interval in which nothing is proven. until: the time
/// of the frame after it.
void page_motion_add_impact(page_motion *motion, ovoid_couple couple, const ovoid_record *record, double until);

/// Adds the first contact, and the first pair within the margin, of the frames.
void page_motion_add_firsts(page_motion *motion, const cli_track *track);

/// Ends the frames: the last one is kept. 0, or EXIT_INPUT after a message if memory was out before.
int page_motion_finish(page_motion *motion);

/// The kept frame that is nearest to a frame.
size_t page_motion_find_frame(const page_motion *motion, size_t frame);

/// Writes "motion", after page_motion_finish. margin: negative if there is none.
void page_motion_write(cli_page *page, const page_motion *motion, const page_choice *choice, double margin);

void page_motion_close(page_motion *motion);

#endif
