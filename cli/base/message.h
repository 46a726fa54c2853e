// Messages to the user, on stderr: results never go there, and nothing else goes to stdout.
#ifndef OVOID_CLI_BASE_MESSAGE_H
#define OVOID_CLI_BASE_MESSAGE_H

#include <stdio.h>

#if defined(__GNUC__)
#define MESSAGE_FORMAT __attribute__((format(printf, 1, 2)))
#else
#define MESSAGE_FORMAT
#endif

/// Writes "ovoid: error: ..." and a line end.
MESSAGE_FORMAT void message_error(const char *format, ...);

/// Writes "ovoid: warning: ..." and a line end.
MESSAGE_FORMAT void message_warning(const char *format, ...);

/// Writes "ovoid: ..." and a line end: counts, times, hints.
MESSAGE_FORMAT void message_note(const char *format, ...);

/// Writes a text from a file or the command line: characters that could control a terminal, and bytes that are not
/// UTF-8, are shown as \x1b. Messages are written in the same way.
void message_write_text(FILE *file, const char *text);

/// 1 if the stream is a terminal that understands colours, and NO_COLOR is not set.
int message_is_colored(FILE *stream);

/// 1 if the stream is a terminal.
int message_is_terminal(FILE *stream);

#endif
