// Lines of any length from a file. A line that memory does not suffice for is no end of the file.
#ifndef OVOID_CLI_BASE_LINES_H
#define OVOID_CLI_BASE_LINES_H

#include <stdio.h>

/// Reads the next line with its end into *line, which grows and is freed by the caller. Its length; 0 at the end of the
/// file; -1 where it cannot be read, and errno says why: ENOMEM where it is too long for the memory.
long lines_read(FILE *file, char **line, size_t *room);

#endif
