// A progress bar on stderr, drawn only if stderr is a terminal, and removed when the work is done.
#ifndef OVOID_CLI_BASE_PROGRESS_H
#define OVOID_CLI_BASE_PROGRESS_H

#include <ovoid/base.h>

#include <stddef.h>

/// Starts the bar. what: for example "pairs"; total: 0 if it is not known. One bar at a time, from one thread.
void progress_start(const char *what, size_t total);

/// Shows that a file is being read, if it is so large that this takes a while; progress_hide or a bar removes the text.
void progress_read(const char *path);

/// Sets the number of items done; draws at most ten times a second.
void progress_set(size_t done);

/// A callback for a long call of the library, which keeps the bar's seconds going. counts: 1: each call of it is an
/// item done, as a cell is.
ovoid_watch progress_make_watch(int counts);

/// Removes the bar from the screen, so that a message can be written there; the next progress_set draws it again.
void progress_hide(void);

/// Ends the bar.
void progress_end(void);

/// Seconds of the monotonic clock.
double progress_get_seconds(void);

#endif
