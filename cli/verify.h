// ovoid verify: one result, the bodies it is about, and the state of a run.
#ifndef OVOID_CLI_VERIFY_H
#define OVOID_CLI_VERIFY_H

#include "frames.h"
#include "inputs.h"
#include "seen.h"
#include "solids.h"
#include "verdict.h"
#ifdef OVOID_HAVE_ROBOT
#include "robot/path_verify.h"
#endif

#include <ovoid/ovoid.h>

typedef struct verify_settings {
    read_settings read;
    const char *list, *pairs, *motion;
    solids_choice choice;
    int query, json, allow_empty;
    unsigned threads;
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

/// One result, and the outcome of its check.
typedef struct claim {
    int64_t line;
    ovoid_body_pair pair;
    ovoid_moving_body moving[2]; ///< of an impact
    double duration;             ///< of an impact: of the motions
    ovoid_record record;         ///< with copies of what it points to; its names are not valid
    int holds;
    char message[256]; ///< why it does not hold; empty where it does
} claim;

/// The state of a run.
typedef struct verify {
    const verify_settings *settings;
    body_source bodies;
    const char *path;
    ovoid_results_reader *reader;
    verdict *verdict;
    size_t proofs, held, undecided;
    size_t impacts;        ///< results whose steps were checked in floating point
    size_t mixed;          ///< and those of solids beside compounds, which the exact judge does not know
    cli_seen seen;         ///< the scene's pairs that have a result
    size_t pairs, missing; ///< of a scene, of all frames, and those of them without a result
    int refused;           ///< *error has the reason, if it has a message
    ovoid_error error;
} verify;

/// Opens the bodies that the options and operands name. 0, or EXIT_INPUT after a message.
int verify_open_bodies(body_source *bodies, const verify_settings *settings, const cli_operands *paths);
void verify_close_bodies(body_source *bodies);

/// Reads the next result with its bodies; where these are not there, the item has the reason. 0: the end, or refused.
int verify_read(verify *v, claim *item);
/// Frees what a record points to.
void verify_drop(claim *item);

/// Checks a result by its proof alone.
ovoid_code verify_check(const verify *v, const claim *item, ovoid_error *error);

#endif
