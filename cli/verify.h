// ovoid verify: one result, the bodies it is about, what the results lack, and the state of a run.
#ifndef OVOID_CLI_VERIFY_H
#define OVOID_CLI_VERIFY_H

#include "base/frames.h"
#include "base/inputs.h"
#include "pairs/answers.h"
#include "pairs/solids.h"
#include "seen.h"
#include "verdict.h"
#ifdef OVOID_HAVE_ROBOT
#include "robot/path/verify.h"
#endif

#include <ovoid/ovoid.h>

typedef struct verify_settings {
    read_settings read;
    const char *list, *pairs, *motion;
    solids_choice choice;
    int query, json, partial, continuous;
    double margin, tolerance; ///< of the question; margin negative: not given
    unsigned threads;
    shard_part part; ///< of the pairs of a batch
    ovoid_pose pose_a, pose_b;
#ifdef OVOID_HAVE_ROBOT
    path_verify_settings paths;
#endif
} verify_settings;

/// The source of the bodies of a result: a scene, which may move, a list with pairs, or two bodies.
typedef struct body_source {
    ovoid_scene *scene;
    cli_frames frames; ///< of a motion; else without poses
    ovoid_shapes *list;
    ovoid_pairs_reader *pairs;
    cli_body bodies[2];
    const char *paths[2];
    ovoid_body_pair pair; ///< of the two bodies
    solids_pair solids;   ///< of the two bodies, where one of them is a solid
    ovoid_record meshes;  ///< what the two bodies are taken as
} body_source;

/// What is to be checked.
typedef enum claim_kind {
    CLAIM_RESULT,  ///< a result of the file
    CLAIM_LACKING, ///< none: a pair without a result, where all need one
    CLAIM_BEYOND,  ///< that a pair without a result is farther apart than the margin
    CLAIM_FREE     ///< that a pair without an impact does not come within the margin between two frames
} claim_kind;

/// One result, or one that is not there, and the outcome of its check.
typedef struct claim {
    claim_kind kind;
    int64_t line;
    ovoid_body_pair pair;
    ovoid_moving_body moving[2]; ///< between two frames
    double duration;             ///< and the time between them
    ovoid_record record;         ///< with copies of what it points to; its names are not valid
    int holds;
    char message[256]; ///< why it does not hold; empty where it does
    // Of a pair without a result:
    ovoid_couple couple;
    unsigned flags; ///< of the frame before, SEEN_OPEN, and of this one, SEEN_NEAR
    double time;    ///< of the frame
} claim;

/// The pairs of the frame at hand that have no result. While the results lack nothing, none is there.
typedef struct verify_rest {
    cli_seen seen, before; ///< of this frame and of the one before
    size_t results;        ///< pairs of this frame that have one
    int is_listed;         ///< what this frame lacks is in `items`, or counted
    claim *items;          ///< to be checked, from `next` on
    size_t count, capacity, next;
    ovoid_box *boxes; ///< of the objects in this frame
    ovoid_box *swept; ///< and from the frame before to this one
    int has_boxes;
} verify_rest;

/// How many there are of each kind.
typedef struct verify_counts {
    size_t proofs, held, undecided;
    size_t impacts;          ///< results whose steps were checked in floating point
    size_t contacts;         ///< of results, which were checked in floating point
    size_t mixed;            ///< and those of solids beside compounds, which the exact judge does not know
    size_t pairs;            ///< of the question: of a scene those of all frames
    size_t lacking;          ///< of these, without a result
    size_t beyond, by_boxes; ///< of these, proven farther apart than the margin; and by their boxes alone
    size_t impacts_lacking;
} verify_counts;

/// The state of a run.
typedef struct verify {
    const verify_settings *settings;
    body_source bodies;
    const char *path;
    ovoid_results_reader *reader;
    verdict *verdict;
    ovoid_record record; ///< that was read, and is not yet given on
    int has_record, has_ended;
    double margin; ///< of the question: negative: none; NaN: not known yet
    verify_rest rest;
    verify_counts counts;
    size_t reported; ///< failures, and what is lacking
    int refused;     ///< *error has the reason, if it has a message
    ovoid_error error;
} verify;

/// Opens the bodies that the options and operands name. 0, or EXIT_INPUT after a message.
int verify_open_bodies(body_source *bodies, const verify_settings *settings, const cli_operands *paths);
void verify_close_bodies(body_source *bodies);

/// Reads the next result with its bodies; where these are not there, the item has the reason. Behind those of a frame
/// come the pairs that have none and are to be proven. 0: the end, or refused.
int verify_read(verify *v, claim *item);
/// Frees what a record points to.
void verify_drop(claim *item);

/// Lists and counts what the frame at hand lacks. 0 where the run is refused.
int verify_list_rest(verify *v);
/// Begins the next frame. 0 where the run is refused.
int verify_begin_rest(verify *v);
void verify_clear_rest(verify_rest *rest);
/// 1 if a pair without a result needs none: by a query whose proof is checked.
int verify_prove_rest(const verify *v, answer_room *room, const claim *item);

/// Checks a result by its proof alone.
ovoid_code verify_claim(const verify *v, const claim *item, ovoid_error *error);
/// Checks an impact between two frames, or that there is none.
ovoid_code verify_claim_impact(const claim *item, double margin, const ovoid_body_impact *found,
                               const ovoid_step *steps, const ovoid_step_group *groups, ovoid_error *error);

#endif
