// Notes of the readers of files.
#ifndef OVOID_PYTHON_ROBOT_NOTES_H
#define OVOID_PYTHON_ROBOT_NOTES_H

#include "src/module.h"

#include <ovoid/robot_io.h>

/// What a reader noted, each with its place.
typedef struct read_notes {
    char **texts;
    size_t count, capacity;
} read_notes;

/// Keeps a note. For ovoid_robot_read_options, whose context are the notes; needs no interpreter's lock.
void notes_gather(void *notes, const ovoid_robot_note *note);

/// Tells them as warnings and frees them; -1 where one is made an exception.
int notes_tell(read_notes *notes);

#endif
