// A shard is checked before any of its lines is used.
#define _FILE_OFFSET_BITS 64
#include "shard/read.h"

#include "base/lines.h"
#include "base/message.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/// Opens a regular file; a pipe, which would wait for its writer, is none. NULL with errno set; 0: no regular file.
static FILE *open_regular(const char *path) {
    struct stat status;
    int number = open(path, O_RDONLY | O_NONBLOCK);
    if (number < 0) return NULL;
    int is_regular = fstat(number, &status) == 0 && S_ISREG(status.st_mode);
    FILE *file = is_regular ? fdopen(number, "rb") : (errno = 0, NULL);
    if (!file) (void)close(number);
    return file;
}

/// Opens the mark and reads its header. 0, or EXIT_INPUT after a message.
static int open_mark(shard_reader *r, const char *path) {
    r->mark = open_regular(path);
    const char *what = r->mark || !errno ? "is no mark of a shard"
                       : errno == ENOENT ? "is not there"
                                         : "cannot be opened";
    errno = 0;
    if (r->mark && shard_header_read(r->mark, &r->header)) return 0;
    if (errno == ENOMEM) return message_error("%s: cannot be read: %s", path, strerror(errno)), EXIT_INPUT;
    message_error("%s: is no shard, as ovoid batch --shard I/N makes them: its mark, %s, %s", r->path, path, what);
    return EXIT_INPUT;
}

int shard_reader_open(shard_reader *r, const char *path) {
    *r = (shard_reader){.path = path};
    r->file = open_regular(path);
    if (!r->file) {
        message_error("%s: cannot be opened: %s", path, errno ? strerror(errno) : "it is no regular file");
        return EXIT_INPUT;
    }
    char *mark = shard_get_mark_path(path);
    int code = mark ? open_mark(r, mark) : (message_error("out of memory"), EXIT_INPUT);
    free(mark);
    if (code) shard_reader_close(r);
    return code;
}

void shard_reader_close(shard_reader *r) {
    if (r->file) (void)fclose(r->file); // it was read
    if (r->mark) (void)fclose(r->mark);
    shard_header_clear(&r->header);
    free(r->line);
    *r = (shard_reader){.path = NULL};
}

int shard_reader_complain(const shard_reader *r) {
    message_error("%s: part %s is not finished, or damaged; run it again, with --shard %s: it goes on", r->path,
                  r->header.fields[SHARD_PART], r->header.fields[SHARD_PART]);
    return EXIT_INPUT;
}

int shard_reader_check(shard_reader *r) {
    shard_state state = {.digest = r->header.digest};
    shard_state_find(&state, r->mark, r->file);
    (void)fclose(r->mark); // it was read
    r->mark = NULL;
    r->progress = state.progress;
    return r->progress.is_done && fseeko(r->file, 0, SEEK_SET) == 0 ? 0 : shard_reader_complain(r);
}

int shard_reader_next(shard_reader *r) {
    long size = lines_read(r->file, &r->line, &r->room);
    r->line_size = size > 0 ? (size_t)size : 0;
    r->taken += r->line_size;
    if (size > 0) return 1;
    if (size < 0) return message_error("%s: a line cannot be read: %s", r->path, strerror(errno)), -1;
    return r->taken == r->progress.bytes ? 0 : (shard_reader_complain(r), -1);
}
