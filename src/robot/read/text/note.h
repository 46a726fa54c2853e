// Notes of readers to their caller.
#ifndef OVOID_ROBOT_READ_TEXT_NOTE_H
#define OVOID_ROBOT_READ_TEXT_NOTE_H

#include "base/compiler.h"
#include "ovoid/robot_io.h"

#include <stdarg.h>
#include <stdio.h>

/// Hands a sentence about a line of a file to the caller, where he wants it; line 0: about the file.
COMPILER_PRINTF(4, 0)
static inline void note_tell(const ovoid_robot_read_options *options, const char *path, int64_t line,
                             const char *format, va_list list) {
    char text[1024];
    if (!options->note) return;
    (void)vsnprintf(text, sizeof text, format, list);
    ovoid_robot_note note = {path, line, text};
    options->note(options->context, &note);
}

#endif
