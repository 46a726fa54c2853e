// Writing a shard: a new file, or one that an earlier run has begun and that goes on behind its last whole unit of
// work. What is on the disk stays there, whatever ends the program.
#ifndef OVOID_CLI_SHARD_WRITE_H
#define OVOID_CLI_SHARD_WRITE_H

#include "shard/digest.h"
#include "shard/file.h"

/// Whose part is written.
typedef struct shard_job {
    const cli_command *command; ///< its options and operands go into the header, files by their digest
    const void *settings;
    const cli_operands *operands;
    shard_part part;
    const char *path;
    int is_json;       ///< else CSV
    uint64_t most;     ///< texts that the merged output has at most; 0: all
    shard_digest seen; ///< of shapes and whatever else was read beside these files
    const char *units; ///< of work, for messages: "pairs"
} shard_job;

typedef struct shard_writer {
    const shard_job *job;
    FILE *file;
    char *texts; ///< of the block that is being filled
    size_t size, capacity, count;
    uint64_t number;                ///< of that block
    uint64_t units;                 ///< that have ended in it
    size_t ended_size, ended_count; ///< of its texts, where the last one did
    shard_tally ended_tally, tally; ///< of these, and of what has come since
    uint64_t done, kept;            ///< units in the file, and those of them that were there
    shard_tally all;                ///< of the blocks in the file
    int is_whole;                   ///< the file has its last block
    int failed;                     ///< 1: after a message
} shard_writer;

/// Opens the file of a job, which must live as long; what the output begins with is `head`. Checks what is there, cuts
/// a torn end off, and sets done, all and is_whole. 0, or EXIT_INPUT after a message.
int shard_writer_open(shard_writer *writer, const shard_job *job, const char *head, size_t head_size);

/// Adds a text. Keys ascend. 0, or EXIT_INPUT after a message.
int shard_writer_add(shard_writer *writer, const shard_key *key, const char *text, size_t size);

/// Counts an answer, before the unit to which it belongs ends.
void shard_writer_count(shard_writer *writer, exit_code side);

/// Ends units of work: behind the texts so far an interrupted run goes on. 0, or EXIT_INPUT after a message.
int shard_writer_end_units(shard_writer *writer, uint64_t units);

/// Ends the file: with EXIT_INPUT or EXIT_PIPE as it is, to go on later, else whole. Returns the exit code: code, or
/// that of all answers of the shard.
int shard_writer_close(shard_writer *writer, int code);

#endif
