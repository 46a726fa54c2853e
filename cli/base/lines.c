// getline returns -1 for the end of a file, for a failed read and for a failed allocation; only the first one is an
// end.
#include "base/lines.h"

#include <errno.h>
#include <sys/types.h>

long lines_read(FILE *file, char **line, size_t *room) {
    errno = 0;
    ssize_t length = getline(line, room, file);
    if (length > 0) return (long)length;
    if (feof(file) && !ferror(file)) return 0;
    if (!errno) errno = EIO;
    return -1;
}
