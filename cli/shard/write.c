// The file is written where it is to stay, block after block. A run that finds one of the same header keeps the blocks
// that are whole, up to the last one that ends a unit of work, and goes on behind it. A lock keeps two runs apart.
#define _FILE_OFFSET_BITS 64
#include "shard/write.h"

#include "base/message.h"
#include "shard/header.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int complain(shard_writer *w, const char *what) {
    if (!w->failed) message_error("%s: %s", w->job->path, what);
    w->failed = 1;
    return EXIT_INPUT;
}

static int complain_system(shard_writer *w, const char *what) {
    char text[200];
    snprintf(text, sizeof text, "%s: %s", what, errno ? strerror(errno) : "it ends early");
    return complain(w, text);
}

/* ---- what is there */

/// Reads the block at the stream's place into the writer's room. 0 where none is whole there.
static int read_block(shard_writer *w, uint64_t number, shard_block *b) {
    unsigned char head[SHARD_BLOCK_HEAD];
    struct stat status;
    if (fread(head, 1, sizeof head, w->file) != sizeof head || !shard_block_decode(head, number, b)) return 0;
    // A length that is no length of this file costs no memory.
    if (fstat(fileno(w->file), &status) != 0 || b->bytes > (uint64_t)status.st_size) return 0;
    if (b->bytes > w->capacity) {
        char *texts = realloc(w->texts, (size_t)b->bytes);
        if (!texts) return 0;
        w->texts = texts;
        w->capacity = (size_t)b->bytes;
    }
    size_t size = (size_t)b->bytes;
    return fread(w->texts, 1, size, w->file) == size && shard_block_check(head, w->texts, size);
}

/// Finds the whole blocks up to the last one that ends a unit; the end of that one.
static off_t find_end(shard_writer *w, off_t begin) {
    shard_block b;
    shard_tally open = {{0}};
    off_t end = begin;
    for (uint64_t number = 0; !w->is_whole && read_block(w, number, &b); number++) {
        shard_tally_add(&open, &b.tally);
        if (!b.units && !b.is_last) continue;
        w->number = number + 1;
        w->done += b.units;
        w->is_whole = b.is_last;
        shard_tally_add(&w->all, &open);
        open = (shard_tally){{0}};
        end = ftello(w->file);
    }
    return end;
}

/// Says what a file is that is not the beginning of this shard.
static int complain_other(shard_writer *w, char *text, size_t size) {
    shard_header ours, theirs;
    FILE *file = fmemopen(text, size, "rb");
    rewind(w->file);
    if (!shard_header_read(w->file, &theirs)) {
        if (file) (void)fclose(file); // it was read
        return complain(w, "is there and is no shard; remove it, or choose another name");
    }
    int read = file && shard_header_read(file, &ours);
    if (read && !shard_header_differs(w->job->path, &theirs, "this run", &ours))
        message_error("%s: is part %s, not %s; choose another name", w->job->path, theirs.fields[SHARD_PART],
                      ours.fields[SHARD_PART]);
    if (read) shard_header_clear(&ours);
    if (file) (void)fclose(file); // it was read
    shard_header_clear(&theirs);
    w->failed = 1;
    return EXIT_INPUT;
}

/// Keeps what is there of this shard. 0 with the place where it goes on.
static int keep(shard_writer *w, char *header, size_t size, off_t *end) {
    struct stat status;
    *end = 0;
    if (fstat(fileno(w->file), &status) != 0) return complain_system(w, "cannot be read");
    size_t there = (uint64_t)status.st_size < size ? (size_t)status.st_size : size;
    char *text = malloc(there + 1);
    if (!text) return complain(w, "out of memory");
    int same = fread(text, 1, there, w->file) == there && memcmp(text, header, there) == 0;
    free(text);
    if (!same) return complain_other(w, header, size);
    if (there == size) *end = find_end(w, (off_t)size);
    return 0;
}

/* ---- opening */

static int lock(shard_writer *w) {
    struct flock all = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (fcntl(fileno(w->file), F_SETLK, &all) == 0) return 0;
    if (errno == EACCES || errno == EAGAIN) return complain(w, "another run is writing this shard");
    return 0; // a file system without locks
}

/// Opens the file, made if it is not there, without losing what it holds.
static int open_file(shard_writer *w) {
    struct stat status;
    int file = open(w->job->path, O_RDWR | O_CREAT, 0666);
    w->file = file >= 0 ? fdopen(file, "r+b") : NULL;
    if (!w->file) {
        int reason = errno;
        if (file >= 0) (void)close(file);
        errno = reason;
        return complain_system(w, "cannot be written");
    }
    if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return complain(w, "a shard needs a regular file");
    return lock(w);
}

/// Cuts the file behind what is kept and goes on there, with the header where nothing is.
static int begin(shard_writer *w, const char *header, size_t size, off_t end) {
    if (w->is_whole) return 0;
    errno = 0;
    if (ftruncate(fileno(w->file), end) != 0 || fseeko(w->file, end, SEEK_SET) != 0)
        return complain_system(w, "cannot be written");
    if (!end && (fwrite(header, 1, size, w->file) != size || fflush(w->file) != 0))
        return complain_system(w, "could not be written in full");
    return 0;
}

int shard_writer_open(shard_writer *w, const shard_job *job, const char *head, size_t head_size) {
    size_t size;
    off_t end = 0;
    *w = (shard_writer){.job = job};
    char *header = shard_header_make(job, head, head_size, &size);
    if (!header) return EXIT_INPUT;
    int code = open_file(w);
    if (!code) code = keep(w, header, size, &end);
    if (!code) code = begin(w, header, size, end);
    free(header);
    w->kept = w->done;
    if (code) (void)shard_writer_close(w, code);
    return code;
}

/* ---- writing */

/// Units that end with a block without texts.
#define UNITS_MAX 1024

/// Writes the texts up to the last end of a unit, or all of them where there is none, as a block.
static int write_block(shard_writer *w, int is_last) {
    unsigned char head[SHARD_BLOCK_HEAD];
    int has_end = w->units || is_last;
    shard_block b = {w->size, w->count, w->units, is_last, w->tally};
    if (has_end) b = (shard_block){w->ended_size, w->ended_count, w->units, is_last, w->ended_tally};
    shard_block_encode(head, &b, w->number, w->texts);
    errno = 0;
    if (fwrite(head, 1, sizeof head, w->file) != sizeof head ||
        (b.bytes && fwrite(w->texts, 1, (size_t)b.bytes, w->file) != b.bytes) || fflush(w->file) != 0)
        return complain_system(w, "could not be written in full; make room, then run it again: it goes on");
    w->number++;
    w->done += b.units;
    shard_tally_add(&w->all, &b.tally);
    // What is left belongs to a unit that has not ended.
    w->size -= (size_t)b.bytes;
    w->count -= (size_t)b.texts;
    if (w->size) memmove(w->texts, w->texts + b.bytes, w->size);
    if (has_end)
        w->ended_tally = (shard_tally){{0}};
    else
        w->tally = (shard_tally){{0}};
    w->units = 0;
    w->ended_size = w->ended_count = 0;
    return 0;
}

int shard_writer_add(shard_writer *w, const shard_key *key, const char *text, size_t size) {
    size_t more = SHARD_TEXT_HEAD + size;
    int is_full = w->size && w->size + more > SHARD_BLOCK_BYTES;
    if (w->failed || (is_full && write_block(w, 0))) return EXIT_INPUT;
    if (w->size + more > w->capacity) {
        size_t capacity = w->size + more > SHARD_BLOCK_BYTES ? 2 * (w->size + more) : SHARD_BLOCK_BYTES;
        char *texts = realloc(w->texts, capacity);
        if (!texts) return complain(w, "out of memory");
        w->texts = texts;
        w->capacity = capacity;
    }
    shard_text_encode((unsigned char *)w->texts + w->size, key, size);
    if (size) memcpy(w->texts + w->size + SHARD_TEXT_HEAD, text, size);
    w->size += more;
    w->count++;
    return 0;
}

void shard_writer_count(shard_writer *w, exit_code side) { w->tally.sides[side]++; }

int shard_writer_end_units(shard_writer *w, uint64_t units) {
    if (w->failed) return EXIT_INPUT;
    w->units += units;
    w->ended_size = w->size;
    w->ended_count = w->count;
    shard_tally_add(&w->ended_tally, &w->tally);
    w->tally = (shard_tally){{0}};
    return w->size >= SHARD_BLOCK_BYTES / 2 || w->units >= UNITS_MAX ? write_block(w, 0) : 0;
}

/* ---- closing */

/// Flushed to the disk, and closed. 0, or EXIT_INPUT after a message.
static int close_file(shard_writer *w, int code) {
    errno = 0;
    if (code <= EXIT_TOUCH || code == EXIT_NOT_PROVEN) {
        if (fsync(fileno(w->file)) != 0 && errno != EINVAL) code = complain_system(w, "could not be written in full");
    }
    if (fclose(w->file) != 0 && code != EXIT_INPUT) code = complain_system(w, "could not be written in full");
    w->file = NULL;
    return code;
}

static void report(const shard_writer *w) {
    const shard_job *job = w->job;
    char kept[80] = "";
    if (w->kept) snprintf(kept, sizeof kept, ", %" PRIu64 " of them from before", w->kept);
    message_note("part %u/%u: %" PRIu64 " %s%s; apart: %" PRIu64 ", touching, overlapping or within: %" PRIu64
                 ", not proven: %" PRIu64,
                 job->part.index, job->part.count, w->done, job->units, kept, w->all.sides[EXIT_APART],
                 w->all.sides[EXIT_TOUCH], w->all.sides[EXIT_NOT_PROVEN]);
}

int shard_writer_close(shard_writer *w, int code) {
    int is_good = !w->failed && code != EXIT_INPUT && code != EXIT_PIPE;
    if (is_good && !w->is_whole) {
        (void)shard_writer_end_units(w, 0);
        if (w->size && write_block(w, 0)) is_good = 0;
        if (is_good && write_block(w, 1)) is_good = 0;
    }
    if (is_good) code = shard_tally_get_exit(&w->all);
    if (!is_good && code != EXIT_PIPE) code = EXIT_INPUT;
    if (w->file) code = close_file(w, code);
    if (is_good && !w->failed) report(w);
    free(w->texts);
    w->texts = NULL;
    return code;
}
