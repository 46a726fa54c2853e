// Which part of a command's work is a shard's.
#ifndef OVOID_CLI_SHARD_PART_H
#define OVOID_CLI_SHARD_PART_H

#include <stddef.h>
#include <stdint.h>

/// Part `index`, from 1 on, of `count`; all zero: all the work.
typedef struct shard_part {
    unsigned index, count;
} shard_part;

/// Most parts: two files of each are open while they are merged.
#define SHARD_PARTS_MAX 100000

/// The row of an options table of the commands whose work can be cut; `part` is the member of the settings.
#define SHARD_OPTION(settings)                                                                                         \
    {                                                                                                                  \
        "shard", 0, OPTION_PART, offsetof(settings, part), "I/N", NULL,                                                \
            "do part I of N, from 1 on, and write it to FILE of --output, a shard for ovoid merge, and FILE.mark; "    \
            "where they hold the beginning of it, go on"                                                               \
    }

/// 1 if item i of a list that is dealt out in turn is one of the part.
static inline int shard_part_has(shard_part part, uint64_t i) {
    return !part.count || i % part.count == part.index - 1;
}

/// Blocks of frames of a part, and frames of a block at least where a part has more than one. Each begins anew, which
/// costs about a frame.
enum { SHARD_BLOCKS = 4, SHARD_BLOCK_FRAMES = 32 };

/// 1 if frame i of `count` is one of the part: blocks of consecutive frames of the same length, within one, are dealt
/// out in turn, from another part on in each round, so that blocks and rounds of different lengths even out.
static inline int shard_part_has_frame(shard_part part, uint64_t i, uint64_t count) {
    if (part.count < 2) return 1;
    uint64_t rounds = count / part.count / SHARD_BLOCK_FRAMES;
    rounds = rounds < 1 ? 1 : rounds > SHARD_BLOCKS ? SHARD_BLOCKS : rounds;
    uint64_t block = ((i + 1) * (rounds * part.count) - 1) / count;
    return shard_part_has(part, block + block / part.count);
}

/// Bodies in a row of pairs that go to one shard together.
enum { SHARD_ROW = 16 };

/// 1 if the pair of bodies a < b is one of the part. Pairs of one body with SHARD_ROW others go together, by a hash
/// (the finaliser of S. Vigna's splitmix64), so that neighbours, and a floor that meets all, are dealt out evenly.
static inline int shard_part_has_pair(shard_part part, uint32_t a, uint32_t b) {
    if (part.count < 2) return 1;
    uint64_t h = ((uint64_t)a << 32 | b / SHARD_ROW) + 0x9e3779b97f4a7c15u;
    h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9u;
    h = (h ^ h >> 27) * 0x94d049bb133111ebu;
    return shard_part_has(part, h ^ h >> 31);
}

#endif
