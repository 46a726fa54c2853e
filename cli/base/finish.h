// Ends of output: a failure is never silent, and no unfinished file stays behind.
#ifndef OVOID_CLI_BASE_FINISH_H
#define OVOID_CLI_BASE_FINISH_H

#include <ovoid/io.h>

/// From now on, pipes without a reader and files at their size limit give errors, not signals; SIGINT, SIGTERM and
/// SIGHUP end the program as always, but the unfinished file is removed first.
void finish_catch_signals(void);

/// Sets the path of the unfinished file, NULL for none. One at a time.
void finish_set_unfinished(const char *path);

/// Blocks these signals while a short piece of work creates and removes a file of its own, then unblocks them.
void finish_hold_signals(void);
void finish_release_signals(void);

/// Flushes. 0, or after a message EXIT_INPUT (a full disk), or without one EXIT_PIPE (the reader has gone).
int finish_file(FILE *file);

/// 1 if the stream is a pipe whose reader has gone; errno may be lost by the time a buffered stream is examined.
int finish_is_unread(FILE *file);

/// Reports why an output file failed; "-" is named as standard output.
void finish_report_failure(const ovoid_error *error);

/// Opens an output file, which a signal removes; "-": standard output. One at a time. NULL after a message.
ovoid_output *finish_open(const char *path);

/// Commits an output file. 0, or an exit code as above.
int finish_output(ovoid_output *output);

/// Commits the file, unless the code says that there is none to be made, and closes it. The code, or one as above.
int finish_close(ovoid_output *output, int code);

/// Writes a chart to a file. 0, or an exit code as above.
int finish_chart(const char *path, const ovoid_chart *chart);

#endif
