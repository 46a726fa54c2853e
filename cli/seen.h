// What the results of a frame say of each pair of a scene: so that what they lack is known.
#ifndef OVOID_CLI_SEEN_H
#define OVOID_CLI_SEEN_H

#include <ovoid/ovoid.h>

/// What is known of a pair; bits.
enum seen_flag {
    SEEN_RESULT = 1, ///< it has a result
    SEEN_IMPACT = 2, ///< it has an impact between the frame before and this one
    SEEN_NEAR = 4,   ///< its result says that it is within the margin, or at it
    SEEN_OPEN = 8    ///< its result leaves open on which side of the margin it is
};

/// Flags of pairs of objects. Memory: 18 to 36 bytes a pair. All zero is empty.
typedef struct cli_seen {
    uint64_t *slots; ///< open addressing; 0: empty
    unsigned char *flags;
    size_t slot_count, count;
} cli_seen;

/// Adds a pair without flags if it is not there. Its flags, until the next call, or NULL where memory is out.
unsigned char *seen_add(cli_seen *seen, ovoid_couple couple);

/// The flags of a pair; 0 where it is not there.
unsigned seen_get(const cli_seen *seen, ovoid_couple couple);

/// Removes all pairs.
void seen_empty(cli_seen *seen);

void seen_clear(cli_seen *seen);

#endif
