// Output files that appear whole or not at all: written beside their path under a temporary name, flushed to the disk,
// then renamed. A link is followed first, so that it stays a link. A path that is no regular file (a terminal, a pipe,
// /dev/null) is written to directly. What a process that was killed left of an unfinished file is removed by the next
// one that writes the same path.
#define _XOPEN_SOURCE 700 // realpath, fsync
#include "io/text.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct ovoid_output {
    FILE *file;
    char *path;      ///< the caller's path, for messages
    char *target;    ///< the file to replace; NULL: written to directly
    char *temporary; ///< the file being written
};

static ovoid_code fail_output(ovoid_error *error, const char *path, const char *what) {
    return io_fail(error, OVOID_ERROR_FILE, (where){path, 0, -1}, "%s: %s", what, strerror(errno));
}

// ---- unfinished files

// A lock for as long as the file is open: who cannot have it sees that somebody writes, on another machine too.
static int lock(int file) {
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    return fcntl(file, F_SETLK, &whole) == 0;
}

// The process that writes, or wrote, NAME.PROCESS-ATTEMPT.tmp; 0 where the file's name is not of that form.
static long get_writer(const char *file, const char *name) {
    size_t length = strlen(name);
    if (strncmp(file, name, length) != 0 || file[length] != '.') return 0;
    char *end;
    const char *number = file + length + 1;
    errno = 0;
    long process = strtol(number, &end, 10);
    if (errno || *number < '1' || *number > '9' || (pid_t)process != process || *end != '-') return 0;
    const char *attempt = end + 1;
    size_t digits = strspn(attempt, "0123456789");
    return digits && strcmp(attempt + digits, ".tmp") == 0 ? process : 0;
}

// Removes an unfinished file of ours that nobody writes any more.
static void remove_leftover(int folder, const char *file) {
    struct stat status;
    int opened = openat(folder, file, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (opened < 0) return;
    if (fstat(opened, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == geteuid() && lock(opened))
        (void)unlinkat(folder, file, 0);
    close(opened);
}

// Removes what processes that are gone have left of the target. 0 where memory is out.
static int remove_leftovers(const char *target) {
    const char *slash = strrchr(target, '/'), *name = slash ? slash + 1 : target;
    char *path = path_join(target, ".");
    DIR *folder = path ? opendir(path) : NULL;
    int has_memory = path != NULL;
    free(path);
    if (!folder) return has_memory;
    for (struct dirent *entry; (entry = readdir(folder));) {
        long writer = get_writer(entry->d_name, name);
        if (writer && kill((pid_t)writer, 0) != 0 && errno == ESRCH) remove_leftover(dirfd(folder), entry->d_name);
    }
    closedir(folder);
    return 1;
}

// Opens a new file beside the target; mode "x" fails where it exists.
static ovoid_code open_temporary(ovoid_output *output, ovoid_error *error) {
    size_t length = strlen(output->target);
    char *name = malloc(length + 48);
    if (!name || !remove_leftovers(output->target)) {
        free(name);
        return io_fail_memory(error, output->path);
    }
    for (unsigned attempt = 0; attempt < 100 && !output->file; attempt++) {
        snprintf(name, length + 48, "%s.%ld-%u.tmp", output->target, (long)getpid(), attempt);
        output->file = fopen(name, "wbx");
        if (!output->file && errno != EEXIST) break;
    }
    if (output->file) {
        (void)lock(fileno(output->file)); // a file system without locks has none to be seen
        output->temporary = name;
        return OVOID_OK;
    }
    ovoid_code code = fail_output(error, output->path, "cannot be written");
    free(name);
    return code;
}

// The file that a link to nothing names, through as many links as there are; NULL with errno.
static char *follow_link(const char *path) {
    char *at = text_copy(path, strlen(path)), name[4096];
    struct stat status;
    for (int links = 0; at && lstat(at, &status) == 0 && S_ISLNK(status.st_mode); links++) {
        ssize_t length = links < 40 ? readlink(at, name, sizeof name - 1) : -1;
        char *next = NULL;
        if (length >= 0) {
            name[length] = 0;
            next = path_join(at, name);
        } else if (links == 40) {
            errno = ELOOP;
        }
        free(at);
        at = next;
    }
    return at;
}

// Finds the target of the path; NULL for a path that is no regular file.
static ovoid_code find_target(ovoid_output *output, ovoid_error *error) {
    struct stat status;
    int exists = strcmp(output->path, "-") != 0 && stat(output->path, &status) == 0;
    if (exists && S_ISDIR(status.st_mode))
        return io_fail(error, OVOID_ERROR_FILE, (where){output->path, 0, -1}, "is a folder");
    if (strcmp(output->path, "-") == 0 || (exists && !S_ISREG(status.st_mode))) return OVOID_OK;
    output->target = exists ? realpath(output->path, NULL) : follow_link(output->path);
    return output->target ? OVOID_OK : fail_output(error, output->path, "cannot be written");
}

ovoid_output *ovoid_output_open(const char *path, ovoid_error *error) {
    ovoid_output *output = calloc(1, sizeof *output);
    if (output) output->path = text_copy(path, strlen(path));
    if (!output || !output->path) {
        io_fail_memory(error, path);
        ovoid_output_close(output);
        return NULL;
    }
    ovoid_code code = find_target(output, error);
    if (!code && output->target) {
        code = open_temporary(output, error);
    } else if (!code) {
        output->file = strcmp(path, "-") == 0 ? stdout : fopen(path, "wb");
        if (!output->file) code = fail_output(error, path, "cannot be written");
    }
    if (!code) return output;
    ovoid_output_close(output);
    return NULL;
}

FILE *ovoid_output_get_file(ovoid_output *output) { return output->file; }

const char *ovoid_output_get_temporary(const ovoid_output *output) { return output->temporary; }

// Closes the file. OVOID_OK if all of it was written; a full disk may show only here.
static ovoid_code close_file(ovoid_output *output, ovoid_error *error) {
    ovoid_code code = OVOID_OK;
    if (ferror(output->file))
        code = io_fail(error, OVOID_ERROR_FILE, (where){output->path, 0, -1},
                       "could not be written in full (is the disk full?)");
    if (!code && (fflush(output->file) || (output->target && fsync(fileno(output->file)))))
        code = fail_output(error, output->path, "could not be written in full");
    if (output->file != stdout && fclose(output->file) && !code)
        code = fail_output(error, output->path, "could not be written in full");
    output->file = NULL;
    return code;
}

// Gives the new file the permissions of the one that it replaces.
static void copy_mode(const ovoid_output *output) {
    struct stat status;
    if (stat(output->target, &status) == 0) (void)chmod(output->temporary, status.st_mode & 07777);
}

ovoid_code ovoid_output_commit(ovoid_output *output, ovoid_error *error) {
    if (!output->file) return io_fail(error, OVOID_ERROR_ARGUMENT, (where){output->path, 0, -1}, "was written before");
    ovoid_code code = close_file(output, error);
    if (code || !output->target) return code;
    copy_mode(output);
    if (rename(output->temporary, output->target)) return fail_output(error, output->path, "could not be put in place");
    free(output->temporary);
    output->temporary = NULL;
    return OVOID_OK;
}

void ovoid_output_close(ovoid_output *output) {
    if (!output) return;
    if (output->file && output->file != stdout) fclose(output->file);
    if (output->temporary) remove(output->temporary);
    free(output->temporary);
    free(output->target);
    free(output->path);
    free(output);
}
