// Reading a shard line by line.
#ifndef OVOID_CLI_SHARD_READ_H
#define OVOID_CLI_SHARD_READ_H

#include "shard/mark.h"

typedef struct shard_reader {
    const char *path;
    FILE *file, *mark;
    shard_header header;
    shard_progress progress; ///< once it was checked
    char *line;              ///< that was read last
    size_t line_size, room;
    uint64_t taken; ///< bytes of the lines that were read
} shard_reader;

/// Opens a shard and reads the header of its mark. 0, or EXIT_INPUT after a message.
int shard_reader_open(shard_reader *reader, const char *path);
void shard_reader_close(shard_reader *reader);

/// Checks that the shard is done and that its results are what its mark says; then its lines can be read. 0, or
/// EXIT_INPUT after a message.
int shard_reader_check(shard_reader *reader);

/// The next line with its end, valid until the next call: line, line_size. 1; 0 at the end, once all bytes were read
/// that the mark speaks of; -1 after a message.
int shard_reader_next(shard_reader *reader);

/// Says that the shard is not what it should be; EXIT_INPUT.
int shard_reader_complain(const shard_reader *reader);

#endif
