// Untrusted work in a child process with limits: whatever it does, the caller goes on.
#ifndef OVOID_IO_MESH_CHILD_H
#define OVOID_IO_MESH_CHILD_H

#include <stddef.h>
#include <sys/types.h>

/// The limits of a child.
typedef struct child_limits {
    size_t memory;        ///< bytes beyond those in use; no limit where the system does not report these
    unsigned cpu_seconds; ///< of processor time
    unsigned seconds;     ///< of wall-clock time: the last resort, where the child waits
} child_limits;

/// A running child.
typedef struct child {
    pid_t pid;
    int input;     ///< the descriptor to read what the child writes
    double end_at; ///< on the monotonic clock
    int is_late;
} child;

/// How a child ended.
typedef struct child_end {
    int is_late;   ///< it was stopped after limits.seconds
    int is_slow;   ///< it was stopped after limits.cpu_seconds
    int signal;    ///< the signal that killed it; 0: it ended by itself, or that is unknown
    int exit_code; ///< where it ended by itself
} child_end;

/// Starts a child that calls work(output, context): what it writes to the descriptor `output` comes out of child_read.
/// 0, or errno. The child has the caller's memory as it was, no other open file, signals as in a new program, and its
/// standard streams lead nowhere. Where the caller has other threads, `work` may call what their locks do not touch;
/// malloc is made safe by the C library.
int child_start(child *c, const child_limits *limits, void (*work)(int output, void *context), void *context);

/// Reads at most size bytes; waits for the first. 0: the end; -1: the child is late, or the pipe failed.
ptrdiff_t child_read(child *c, void *buffer, size_t size);

/// Stops the child if it still runs, reaps it, and returns how it ended. is_done: the caller has all that it wanted,
/// and does not wait.
child_end child_finish(child *c, int is_done);

/// For the child: raises the limit on memory by that many bytes.
void child_allow_memory(size_t bytes);

/// For the child: writes all of it, or ends the child.
void child_write(int output, const void *data, size_t size);

#endif
