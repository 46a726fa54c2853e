// The results are written where they are to stay; the mark says how far, once they are in the file. A run that finds a
// mark of the same header keeps what is whole, and goes on behind it. A lock keeps two runs apart.
#define _FILE_OFFSET_BITS 64
#include "shard/write.h"

#include "base/message.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int complain(shard_writer *w, const char *path, const char *what) {
    if (!w->failed) message_error("%s: %s", path, what);
    w->failed = 1;
    return EXIT_INPUT;
}

static int complain_system(shard_writer *w, const char *what) {
    char text[200];
    snprintf(text, sizeof text, "%s: %s", what, errno ? strerror(errno) : "it ends early");
    return complain(w, w->job->path, text);
}

int shard_writer_complain(shard_writer *w) {
    return complain_system(w, "could not be written in full; make room, then run it again: it goes on");
}

/* ---- opening */

static int lock(shard_writer *w) {
    struct flock all = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (fcntl(fileno(w->mark), F_SETLK, &all) == 0) return 0;
    if (errno == EACCES || errno == EAGAIN) return complain(w, w->job->path, "another run is writing this shard");
    return 0; // a file system without locks
}

/// Opens a file, made if it is not there, without losing what it holds. NULL after a message.
static FILE *open_file(shard_writer *w, const char *path) {
    struct stat status;
    int number = open(path, O_RDWR | O_CREAT, 0666);
    FILE *file = number >= 0 ? fdopen(number, "r+b") : NULL;
    if (file && fstat(number, &status) == 0 && S_ISREG(status.st_mode)) return file;
    int reason = errno;
    if (file)
        (void)complain(w, path, "a shard needs a regular file");
    else
        errno = reason, (void)complain_system(w, "cannot be written");
    if (file) (void)fclose(file);
    if (!file && number >= 0) (void)close(number);
    return NULL;
}

/// Opens the mark. Results without one are not those of a shard. 0, or EXIT_INPUT after a message.
static int open_mark(shard_writer *w, int has_results) {
    const char *path = w->job->path;
    if (!(w->mark_path = shard_get_mark_path(path))) return complain(w, path, "out of memory");
    if (has_results && access(w->mark_path, F_OK) != 0)
        return complain(w, path, "is there and is no shard; remove it, or choose another name");
    w->mark = open_file(w, w->mark_path);
    return w->mark ? lock(w) : EXIT_INPUT;
}

/* ---- what is there */

/// Says what a mark is that is not the beginning of this shard's.
static int complain_other(shard_writer *w, char *text, size_t size) {
    shard_header ours, theirs;
    FILE *file = fmemopen(text, size, "rb");
    rewind(w->mark);
    int has_ours = file && shard_header_read(file, &ours);
    if (!shard_header_read(w->mark, &theirs))
        (void)complain(w, w->mark_path, "is there and is no mark of a shard; remove it, or choose another name");
    else if (has_ours && !shard_header_differs(w->job->path, &theirs, "this run", &ours))
        message_error("%s: is part %s, not %s; choose another name", w->job->path, theirs.fields[SHARD_PART],
                      ours.fields[SHARD_PART]);
    if (has_ours) shard_header_clear(&ours);
    if (file) (void)fclose(file); // it was read
    shard_header_clear(&theirs);
    w->failed = 1;
    return EXIT_INPUT;
}

/// The mark that is there must be that of these results: 0, or EXIT_INPUT after a message.
static int check_mark(shard_writer *w, char *header, size_t size) {
    char *text = malloc(size);
    if (!text) return complain(w, w->job->path, "out of memory");
    int is_same = fread(text, 1, size, w->mark) == size && memcmp(text, header, size) == 0;
    free(text);
    return is_same ? 0 : complain_other(w, header, size);
}

/// Begins the mark anew, where there are no results. It is on the disk before they are. 0, or EXIT_INPUT after a
/// message.
static int begin_mark(shard_writer *w, const char *header, size_t size) {
    char text[8];
    size_t there = fread(text, 1, sizeof text, w->mark);
    if (memcmp(text, header, there) != 0)
        return complain(w, w->mark_path, "is there and is no mark of a shard; remove it, or choose another name");
    errno = 0;
    if (ftruncate(fileno(w->mark), 0) != 0) return complain_system(w, "cannot be written");
    rewind(w->mark);
    if (fwrite(header, 1, size, w->mark) != size || fflush(w->mark) != 0 ||
        (fsync(fileno(w->mark)) != 0 && errno != EINVAL))
        return shard_writer_complain(w);
    return 0;
}

/// Keeps what is whole, and cuts both files behind it. 0, or EXIT_INPUT after a message.
static int keep(shard_writer *w, size_t size) {
    shard_state state = {.digest = w->digest, .mark_size = (int64_t)size};
    shard_state_find(&state, w->mark, w->written);
    w->digest = state.digest;
    w->marked = w->progress = state.progress;
    w->kept = state.progress.units;
    if (state.progress.is_done) return 0;
    off_t mark = (off_t)state.mark_size, file = (off_t)state.progress.bytes;
    errno = 0;
    if (ftruncate(fileno(w->mark), mark) == 0 && fseeko(w->mark, mark, SEEK_SET) == 0 &&
        ftruncate(fileno(w->file), file) == 0 && fseeko(w->file, file, SEEK_SET) == 0 &&
        fseeko(w->written, file, SEEK_SET) == 0)
        return 0;
    return complain_system(w, "cannot be written");
}

/// Opens the files. 0, or EXIT_INPUT after a message.
static int open_files(shard_writer *w, char *header, size_t size) {
    int has_results = access(w->job->path, F_OK) == 0;
    int code = open_mark(w, has_results);
    if (!code) code = has_results ? check_mark(w, header, size) : begin_mark(w, header, size);
    if (!code && !(w->file = open_file(w, w->job->path))) code = EXIT_INPUT;
    if (!code && !(w->written = fopen(w->job->path, "rb"))) code = complain_system(w, "cannot be read");
    return code ? code : keep(w, size);
}

int shard_writer_open(shard_writer *w, const shard_job *job) {
    size_t size;
    *w = (shard_writer){.job = job};
    char *header = shard_header_make(job, &size);
    if (!header) return EXIT_INPUT;
    w->digest = shard_digest_make();
    shard_digest_add(&w->digest, header, size);
    int code = open_files(w, header, size);
    free(header);
    if (code) (void)shard_writer_close(w, code);
    return code;
}

/* ---- writing */

/// Bytes of results, and units, after which the mark says how far they have come.
enum { BYTES = 1 << 16, UNITS = 1024 };

/// Writes into the mark how far the work has come.
static int write_mark(shard_writer *w) {
    char line[SHARD_LINE_SIZE];
    errno = 0;
    if (fflush(w->file) != 0 || !shard_digest_add_stream(&w->digest, w->written, w->progress.bytes - w->marked.bytes))
        return shard_writer_complain(w);
    shard_progress_write(line, &w->progress, &w->digest);
    if (fputs(line, w->mark) < 0 || fflush(w->mark) != 0) return shard_writer_complain(w);
    w->marked = w->progress;
    return 0;
}

void shard_writer_count(shard_writer *w, exit_code side) { w->progress.sides[side]++; }

int shard_writer_end_units(shard_writer *w, uint64_t units) {
    shard_progress *now = &w->progress;
    if (w->failed || ferror(w->file)) return shard_writer_complain(w);
    now->units += units;
    now->bytes = (uint64_t)ftello(w->file);
    return now->bytes - w->marked.bytes >= BYTES || now->units - w->marked.units >= UNITS ? write_mark(w) : 0;
}

/// Ends the last unit, and says in the mark that all is done.
static int finish(shard_writer *w) {
    if (w->progress.is_done) return 0;
    if (shard_writer_end_units(w, 0)) return EXIT_INPUT;
    w->progress.is_done = 1;
    return write_mark(w);
}

/* ---- closing */

/// Flushed to the disk, and closed. 0, or EXIT_INPUT after a message.
static int close_file(shard_writer *w, FILE *file, int code) {
    if (!file) return code;
    errno = 0;
    int is_good = code == EXIT_INPUT || code == EXIT_PIPE || fsync(fileno(file)) == 0 || errno == EINVAL;
    if (fclose(file) != 0) is_good = 0;
    return is_good || code == EXIT_INPUT ? code : shard_writer_complain(w);
}

static void report(const shard_writer *w) {
    const shard_job *job = w->job;
    const uint64_t *sides = w->progress.sides;
    char kept[80] = "";
    if (w->kept) snprintf(kept, sizeof kept, ", %" PRIu64 " of them from before", w->kept);
    message_note("part %u/%u: %" PRIu64 " %s%s; apart: %" PRIu64 ", touching, overlapping or within: %" PRIu64
                 ", not proven: %" PRIu64,
                 job->part.index, job->part.count, w->progress.units, job->units, kept, sides[EXIT_APART],
                 sides[EXIT_TOUCH], sides[EXIT_NOT_PROVEN]);
}

int shard_writer_close(shard_writer *w, int code) {
    int is_good = !w->failed && code != EXIT_INPUT && code != EXIT_PIPE && !finish(w);
    if (is_good) code = shard_progress_get_exit(&w->progress);
    if (!is_good && code != EXIT_PIPE) code = EXIT_INPUT;
    code = close_file(w, w->file, code);
    code = close_file(w, w->mark, code);
    if (w->written) (void)fclose(w->written); // it was read
    if (is_good && !w->failed) report(w);
    free(w->mark_path);
    w->mark_path = NULL;
    return code;
}
