// Reading a shard, text by text, each block checked.
#ifndef OVOID_CLI_SHARD_READ_H
#define OVOID_CLI_SHARD_READ_H

#include "shard/file.h"

typedef struct shard_reader {
    const char *path;
    FILE *file;
    shard_header header;
    unsigned char *texts; ///< of the block
    size_t size, capacity, at;
    uint64_t number; ///< of the next block
    uint64_t left;   ///< texts of the block that were not read yet
    int ended;
    shard_tally all; ///< of the blocks so far
    shard_key key;   ///< of the text that was read last
    const char *text;
    size_t text_size;
} shard_reader;

/// Opens a shard that is whole: its header and its last block are there. 0, or EXIT_INPUT after a message.
int shard_reader_open(shard_reader *reader, const char *path);
void shard_reader_close(shard_reader *reader);

/// The next text, valid until the next call: key, text, text_size. 1; 0 at the end; -1 after a message.
int shard_reader_next(shard_reader *reader);

#endif
