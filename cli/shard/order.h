// The place of a line of results among those of all shards, from what the line says.
#ifndef OVOID_CLI_SHARD_ORDER_H
#define OVOID_CLI_SHARD_ORDER_H

#include "shard/read.h"

/// In which order the lines of all shards come.
typedef enum shard_order {
    SHARD_IN_TURN,     ///< one part after another
    SHARD_BY_STATE,    ///< by the number of the state
    SHARD_BY_DISTANCE, ///< by lower and upper bound, then by bodies
    SHARD_BY_TIME      ///< by frames; impacts between two of them by their times; then by bodies
} shard_order;

shard_order shard_get_order(const char *command);

/// Lines come in ascending order of these words.
typedef struct shard_key {
    uint64_t words[3];
} shard_key;

int shard_key_compare(const shard_key *a, const shard_key *b);

/// What the lines of one run have in common.
typedef struct shard_lines {
    shard_order order;
    const char *columns;        ///< the header of CSV; NULL: the lines are JSON
    const shard_object *bodies; ///< in the order of shard_object_compare
    size_t body_count;
} shard_lines;

/// The key of a line. 0 where it does not say what belongs to the key.
int shard_key_find(shard_key *key, const shard_lines *lines, const char *line);

/// For qsort: by their texts.
int shard_object_compare(const void *a, const void *b);

#endif
