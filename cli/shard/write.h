// Writing a shard: new files, or those that an earlier run has begun and that go on behind the last whole unit of work.
// What is on the disk stays there, whatever ends the program.
#ifndef OVOID_CLI_SHARD_WRITE_H
#define OVOID_CLI_SHARD_WRITE_H

#include "shard/mark.h"

typedef struct shard_writer {
    const shard_job *job;
    FILE *file;    ///< of the results, to which whole lines are written
    FILE *written; ///< the same, to be read
    FILE *mark;
    char *mark_path;
    shard_digest digest;     ///< of what the mark has
    shard_progress marked;   ///< the last one that it has
    shard_progress progress; ///< at the last end of a unit; answers are counted as they come
    uint64_t kept;           ///< units that were there
    int failed;              ///< 1: after a message
} shard_writer;

/// Opens the files of a job, which must live as long. Checks what is there, cuts a torn end off, and sets what is kept;
/// all is done where progress.is_done. 0, or EXIT_INPUT after a message.
int shard_writer_open(shard_writer *writer, const shard_job *job);

/// Says that the results could not be written; EXIT_INPUT.
int shard_writer_complain(shard_writer *writer);

/// Counts an answer, before the unit to which it belongs ends.
void shard_writer_count(shard_writer *writer, exit_code side);

/// Ends units of work, whose lines are written: behind them an interrupted run goes on. 0, or EXIT_INPUT after a
/// message.
int shard_writer_end_units(shard_writer *writer, uint64_t units);

/// Ends the shard: with EXIT_INPUT or EXIT_PIPE as it is, to go on later, else done. Returns the exit code: code, or
/// that of all answers of the shard.
int shard_writer_close(shard_writer *writer, int code);

#endif
