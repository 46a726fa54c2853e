// The times when pairs of a scene's objects come within a margin of each other, between two frames of a motion.
#ifndef OVOID_CLI_PAIRS_IMPACTS_H
#define OVOID_CLI_PAIRS_IMPACTS_H

#include "base/frames.h"
#include "pairs/answers.h"

/// The state kept from frame to frame.
typedef struct cli_impacts {
    const ovoid_scene *scene;
    const cli_frames *frames;
    double margin; ///< >= 0
    unsigned threads;
    cli_results *results;
    ovoid_box *boxes;        ///< of each object, from the frame before to this one
    unsigned char *is_fresh; ///< of each object: its box is that of its present resting place
    ovoid_couple *held;      ///< pairs within the margin in the frame before, ascending
    size_t held_count, held_capacity;
    ovoid_couple *open; ///< pairs proven neither within nor beyond the margin in the frame before, ascending
    size_t open_count, open_capacity;
    ovoid_couple *couples; ///< candidates: their boxes are near each other
    size_t couple_count, couple_capacity;
    size_t found, not_proven; ///< impacts, and undecided pairs
    /// Receives each impact in order; an unproven one has an infinite hit_after. An impact at the end of the interval
    /// is not written, since the frame's own line shows it; it comes with the answer at the end of the free time.
    void (*take)(void *context, ovoid_couple couple, const ovoid_record *record);
    void *context;
} cli_impacts;

/// An impact of one pair, with the memory of its proof.
typedef struct pair_impact {
    ovoid_body_impact found;
    ovoid_step *steps;
    ovoid_step_group *groups; ///< of compounds and solids
} pair_impact;

/// The motion of an object of a scene from the frame before to this one.
ovoid_moving_body impacts_get_moving(const ovoid_scene *scene, const cli_frames *frames, size_t object);

/// The contents of a proof of an impact.
typedef enum impact_proof {
    IMPACT_PROOF_NONE,
    IMPACT_PROOF_RECORD, ///< as in records: for shapes the steps, for other bodies their groups too
    IMPACT_PROOF_GROUPS  ///< for shapes the groups too: without them nothing proves that there is no impact
} impact_proof;

/// Finds the impact of two moving bodies, with its proof. The pair must be all zero, or as an earlier call left it. 0
/// if memory runs out.
int pair_impact_find(pair_impact *pair, const ovoid_moving_body bodies[2], double margin, impact_proof proof);
void pair_impact_clear(pair_impact *pair);

/// 1 if the result is free until the end, to the tolerance.
int pair_impact_is_arrival(const pair_impact *pair);

/// Makes room for the objects. 0, or EXIT_INPUT after a message. Members that the caller has set are kept.
int impacts_open(cli_impacts *impacts);

/// Records a pair that is within or at the margin in this frame: in ascending order, before the next frame. 0, or
/// EXIT_INPUT after a message.
int impacts_hold(cli_impacts *impacts, ovoid_couple couple);

/// Records a pair that is proven on neither side of the margin: only a proven impact of it is written.
int impacts_leave_open(cli_impacts *impacts, ovoid_couple couple);

/// Finds the impacts from the frame before to this one, of pairs that were not within the margin then, writes them in
/// the order of their times, including those that are not proven, and clears the lists of the frame before. 0, or an
/// exit code after a message.
int impacts_find(cli_impacts *impacts);

void impacts_close(cli_impacts *impacts);

#endif
