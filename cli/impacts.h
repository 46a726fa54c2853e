// When pairs of a scene's objects come within a margin of each other between two frames of a motion.
#ifndef OVOID_CLI_IMPACTS_H
#define OVOID_CLI_IMPACTS_H

#include "answers.h"
#include "frames.h"

/// What is kept from step to step.
typedef struct cli_impacts {
    const ovoid_scene *scene;
    const cli_frames *frames;
    double margin; ///< >= 0
    unsigned threads, fields;
    cli_results *results;
    ovoid_box *boxes;        ///< of each object, over the step
    unsigned char *is_fresh; ///< of each object: its box is that of a body at rest, where it still is
    struct cli_span *spans;  ///< the objects along x
    ovoid_couple *held;      ///< within the margin in the frame before, ascending
    size_t held_count, held_capacity;
    ovoid_couple *couples; ///< whose boxes are near each other
    size_t couple_count, couple_capacity;
    size_t found, not_proven; ///< impacts, and pairs of which none is proven, nor that there is none
    /// Looks at each impact in order.
    void (*take)(void *context, ovoid_couple couple, const ovoid_record *record);
    void *context;
} cli_impacts;

/// Gets room for the objects. 0, or EXIT_INPUT after a message. What the caller sets before stays.
int impacts_open(cli_impacts *x);

/// A pair that was within the margin in this frame, or was not proven farther: in ascending order, before the next
/// frame. 0, or EXIT_INPUT after a message.
int impacts_hold(cli_impacts *x, ovoid_couple couple);

/// Finds the impacts from the frame before to this one, of pairs that were not held then, writes them in the order of
/// their times, and forgets what was held. 0, or an exit code after a message.
int impacts_find(cli_impacts *x);

void impacts_close(cli_impacts *x);

#endif
