// A progress bar on stderr, drawn only where stderr is a terminal, and gone when the work is done.
#ifndef OVOID_CLI_PROGRESS_H
#define OVOID_CLI_PROGRESS_H

#include <stddef.h>

/// Starts the bar. what: for example "pairs"; total: 0 where it is not known. One bar at a time, from one thread.
void progress_start(const char *what, size_t total);

/// Tells how much is done; draws at most ten times a second.
void progress_set(size_t done);

/// Takes the bar off the screen, so that a message can stand there; it comes back with the next progress_set.
void progress_hide(void);

/// Ends the bar.
void progress_end(void);

/// Seconds of the monotonic clock.
double progress_get_seconds(void);

#endif
