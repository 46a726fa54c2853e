// Work that is not to be trusted, in a child process with limits: whatever it does, the caller goes on.
#ifndef OVOID_IO_CHILD_H
#define OVOID_IO_CHILD_H

#include <stddef.h>
#include <sys/types.h>

/// What a child may use.
typedef struct child_limits {
    size_t memory;        ///< bytes beyond what the process has already; none where the system does not say
    unsigned cpu_seconds; ///< of processor time
    unsigned seconds;     ///< of any time: the last resort, where the child waits for something
} child_limits;

/// A running child.
typedef struct child {
    pid_t pid;
    int input;     ///< what the child writes, comes here
    double end_at; ///< on the monotonic clock
    int is_late;
} child;

/// How a child ended.
typedef struct child_end {
    int is_late;   ///< it was stopped after limits.seconds
    int is_slow;   ///< it was stopped after limits.cpu_seconds
    int signal;    ///< what it died of; 0: it ended by itself, or nobody knows
    int exit_code; ///< where it ended by itself
} child_end;

/// Starts a child that calls work(output, context): what it writes to the descriptor `output` comes out of child_read.
/// 0, or errno. The child has the caller's memory as it was, no other open file, signals as in a new program, and its
/// standard streams lead nowhere. Where the caller has other threads, `work` may call what their locks do not touch;
/// malloc is made safe by the C library.
int child_start(child *c, const child_limits *limits, void (*work)(int output, void *context), void *context);

/// At most size bytes; waits for the first. 0: there are no more; -1: the child is late, or the pipe failed.
ptrdiff_t child_read(child *c, void *buffer, size_t size);

/// Stops the child if it still runs, takes its place in the process table back, and says how it ended. is_done: the
/// caller has all that it wanted, and does not wait.
child_end child_finish(child *c, int is_done);

/// In the child: raises the limit on memory by that many bytes.
void child_allow_memory(size_t bytes);

/// In the child: writes all of it, or ends the child.
void child_write(int output, const void *data, size_t size);

#endif
