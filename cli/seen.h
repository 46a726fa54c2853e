// Which pairs of a scene the results name: so that pairs without a result can be counted.
#ifndef OVOID_CLI_SEEN_H
#define OVOID_CLI_SEEN_H

#include <ovoid/io.h>

/// A set of pairs of objects. Memory: 16 to 32 bytes a pair. All zero is the empty set.
typedef struct cli_seen {
    uint64_t *slots; ///< open addressing; 0: empty
    size_t slot_count, count;
    size_t before; ///< pairs of earlier frames
} cli_seen;

/// Adds a pair of two objects that the scene does not ignore; others, and those that are there, change nothing. 0 where
/// memory is out.
int seen_add(cli_seen *seen, const ovoid_scene *scene, size_t a, size_t b);

/// Begins another frame: its pairs are counted anew.
void seen_begin_frame(cli_seen *seen);

/// How many pairs of all frames were added.
size_t seen_get_count(const cli_seen *seen);

void seen_clear(cli_seen *seen);

#endif
