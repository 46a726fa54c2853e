// The pairs of a scene's objects that are answered: all, or those that are not proven farther apart than a margin; of a
// scene that moves also some that are a little farther.
#ifndef OVOID_CLI_PAIRS_NEAR_H
#define OVOID_CLI_PAIRS_NEAR_H

#include "pairs/cut.h"

#include <ovoid/io.h>
#include <ovoid/ovoid.h>

#include <stdatomic.h>

/// The objects of a scene in a world, and the pairs found last.
typedef struct cli_near {
    const ovoid_scene *scene;
    ovoid_world *world; ///< NULL: all pairs are wanted
    ovoid_id *ids;      ///< of the objects in the world
    uint32_t *objects;  ///< these objects, ascending; NULL: all are in the world
    size_t object_count;
    ovoid_couple *couples; ///< a < b, ascending
    size_t count, capacity;
    ovoid_contact_query query;
    shard_part part; ///< of the pairs of a scene at rest
    int is_still;
    cli_cut cut;
    atomic_size_t candidates; ///< pairs that the world keeps: those found last, and new ones
} cli_near;

/// Which pairs are wanted.
typedef struct near_request {
    const ovoid_scene *scene;
    const ovoid_pose *poses; ///< of its objects
    double margin;           ///< negative: all pairs are wanted
    shard_part part;         ///< of a scene at rest: only pairs of that shard are found
    unsigned threads;
    int is_still; ///< no object will be moved. Else which pairs that are not proven farther than the margin by a query
                  ///< of their own are found does not depend on earlier poses: all are
} near_request;

/// Adds the objects to a world. 0, or EXIT_INPUT after a message.
int near_open(cli_near *near, const near_request *request);

/// Moves some objects; poses are those of all. 0, or EXIT_INPUT after a message.
int near_move(cli_near *near, const uint32_t *moved, size_t count, const ovoid_pose *poses);

/// Finds the pairs for the present poses. 0, or EXIT_INPUT after a message.
int near_find(cli_near *near);

void near_close(cli_near *near);

#endif
