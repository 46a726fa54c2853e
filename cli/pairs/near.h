// The pairs of a scene's objects that are answered: all, or those that are not proven farther apart than a margin.
#ifndef OVOID_CLI_PAIRS_NEAR_H
#define OVOID_CLI_PAIRS_NEAR_H

#include "base/args.h"

#include <ovoid/io.h>
#include <ovoid/ovoid.h>

#include <stdatomic.h>

/// The objects of a scene in a world, and the pairs found last.
typedef struct cli_near {
    const ovoid_scene *scene;
    ovoid_world *world;    ///< NULL: all pairs are wanted
    ovoid_id *ids;         ///< of the objects
    ovoid_couple *couples; ///< a < b, ascending
    size_t count, capacity;
    ovoid_contact_query query;
    shard_part part;          ///< of the pairs
    atomic_size_t candidates; ///< pairs that the world keeps: those found last, and new ones
} cli_near;

/// Adds the objects to a world, at the poses of the scene. query: collide, or within a margin, which is negative for
/// all pairs. part: only pairs of that shard are found. 0, or EXIT_INPUT after a message.
int near_open(cli_near *near, const ovoid_scene *scene, const ovoid_contact_query *query, shard_part part,
              unsigned threads);

/// Moves some objects; poses are those of all. 0, or EXIT_INPUT after a message.
int near_move(cli_near *near, const uint32_t *moved, size_t count, const ovoid_pose *poses);

/// Finds the pairs for the present poses. 0, or EXIT_INPUT after a message.
int near_find(cli_near *near);

void near_close(cli_near *near);

#endif
