// The times when pairs of a scene's objects come within a margin of each other, between two frames of a motion.
#ifndef OVOID_CLI_IMPACTS_H
#define OVOID_CLI_IMPACTS_H

#include "answers.h"
#include "frames.h"

/// The state that lasts from frame to frame.
typedef struct cli_impacts {
    const ovoid_scene *scene;
    const cli_frames *frames;
    double margin; ///< >= 0
    unsigned threads;
    cli_results *results;
    shard_part part;         ///< of the pairs
    ovoid_box *boxes;        ///< of each object, from the frame before to this one
    unsigned char *is_fresh; ///< of each object: its box is that of its present resting place
    struct cli_span *spans;  ///< the objects' boxes along x
    ovoid_couple *held;      ///< within the margin in the frame before, ascending
    size_t held_count, held_capacity;
    ovoid_couple *open; ///< not proven within the margin in the frame before, nor farther, ascending
    size_t open_count, open_capacity;
    ovoid_couple *couples; ///< candidates: their boxes are near each other
    size_t couple_count, couple_capacity;
    size_t found, not_proven; ///< impacts, and undecided pairs
    /// Receives each impact in order; one that is not proven has an infinite hit_after. One that ends with the frame,
    /// whose own line shows it, is not written, and comes with the answer at the end of the free time.
    void (*take)(void *context, ovoid_couple couple, const ovoid_record *record);
    void *context;
} cli_impacts;

/// Makes room for the objects. 0, or EXIT_INPUT after a message. Members that the caller has set stay.
int impacts_open(cli_impacts *x);

/// Notes a pair that is within or at the margin in this frame: in ascending order, before the next frame. 0, or
/// EXIT_INPUT after a message.
int impacts_hold(cli_impacts *x, ovoid_couple couple);

/// The same for a pair that is not proven on either side of the margin: only a proven impact of it is written.
int impacts_leave_open(cli_impacts *x, ovoid_couple couple);

/// Finds the impacts from the frame before to this one, of pairs that were not held then, writes them in the order of
/// their times, also those of which nothing is proven, and clears the held pairs. 0, or an exit code after a message.
int impacts_find(cli_impacts *x);

void impacts_close(cli_impacts *x);

#endif
