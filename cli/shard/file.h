// Shard files: a header of text lines that says whose part they are, then blocks of results. Each block counts and
// checks itself, so that what is whole can be told from a torn end; the last one says that nothing follows.
#ifndef OVOID_CLI_SHARD_FILE_H
#define OVOID_CLI_SHARD_FILE_H

#include "base/args.h"

#include <stdint.h>

/// The place of a text among those of all shards: they are merged in ascending order.
typedef struct shard_key {
    uint64_t words[3];
} shard_key;

/// A number as a word of a key: words compare as numbers do; both zeros are one.
uint64_t shard_key_from_number(double number);
int shard_key_compare(const shard_key *a, const shard_key *b);

/// Answers, by the exit code that each of them alone would give.
typedef struct shard_tally {
    uint64_t sides[EXIT_NOT_PROVEN + 1];
} shard_tally;

void shard_tally_add(shard_tally *to, const shard_tally *from);
exit_code shard_tally_get_exit(const shard_tally *tally);

/// The head of a block, without its number and its checksum.
typedef struct shard_block {
    uint64_t bytes; ///< of its texts with their keys
    uint64_t texts;
    uint64_t units; ///< of work that end with it: where it is 0, the work goes on in the next block
    int is_last;
    shard_tally tally;
} shard_block;

/// Bytes of a block's head, and of a text's: its key and its length.
enum { SHARD_BLOCK_HEAD = 96, SHARD_TEXT_HEAD = 32 };

/// Bytes of texts after which a block ends; a longer text is a block of its own.
enum { SHARD_BLOCK_BYTES = 1 << 16 };

/// The head as it is written. number: of the block, from 0 on.
void shard_block_encode(unsigned char head[SHARD_BLOCK_HEAD], const shard_block *block, uint64_t number,
                        const void *texts);
/// Its members. 0 where it is no head of block `number`; whether its texts are whole, shard_block_check says.
int shard_block_decode(const unsigned char head[SHARD_BLOCK_HEAD], uint64_t number, shard_block *block);
int shard_block_check(const unsigned char head[SHARD_BLOCK_HEAD], const void *texts, size_t size);

void shard_text_encode(unsigned char head[SHARD_TEXT_HEAD], const shard_key *key, size_t size);
size_t shard_text_decode(const unsigned char head[SHARD_TEXT_HEAD], shard_key *key);

/// What a header says, in its order.
enum { SHARD_TOOL, SHARD_COMMAND, SHARD_FORMAT, SHARD_OPTIONS, SHARD_INPUTS, SHARD_MOST, SHARD_PART, SHARD_FIELDS };

/// Longest line of a header, bytes.
enum { SHARD_LINE_MAX = 8192 };

/// The first line.
#define SHARD_MAGIC "ovoid shard 1"

/// A header, taken apart.
typedef struct shard_header {
    const char *fields[SHARD_FIELDS]; ///< terminated texts in `text`
    shard_part part;
    uint64_t most; ///< texts that the merged output has at most; 0: all
    char *head;    ///< what the output begins with; owned
    size_t head_size;
    char *text; ///< owned; NULL: none
} shard_header;

/// The word before a field in its line.
const char *shard_header_get_word(int field);

/// Reads a header from the beginning of a file. 1; 0 where it is none or ends early, with nothing to free.
int shard_header_read(FILE *file, shard_header *header);
void shard_header_clear(shard_header *header);

#endif
