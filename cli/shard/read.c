// A shard is checked before any of its lines is used.
#define _FILE_OFFSET_BITS 64
#include "shard/read.h"

#include "base/message.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// Opens the mark and reads its header. 0, or EXIT_INPUT after a message.
static int open_mark(shard_reader *r, const char *path) {
    struct stat status;
    r->mark = fopen(path, "rb");
    if (r->mark && fstat(fileno(r->mark), &status) == 0 && S_ISREG(status.st_mode) &&
        shard_header_read(r->mark, &r->header))
        return 0;
    message_error("%s: is no shard, as ovoid batch --shard I/N makes them: %s, which says of which run it is, %s",
                  r->path, path, r->mark ? "does not" : "is not there");
    return EXIT_INPUT;
}

int shard_reader_open(shard_reader *r, const char *path) {
    *r = (shard_reader){.path = path};
    errno = 0;
    r->file = fopen(path, "rb");
    if (!r->file) return message_error("%s: cannot be opened: %s", path, strerror(errno)), EXIT_INPUT;
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
    ssize_t size = getline(&r->line, &r->room, r->file);
    r->line_size = size > 0 ? (size_t)size : 0;
    return size > 0;
}
