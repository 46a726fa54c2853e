// The files that Assimp may open: the imported file, which is in memory already, and regular files below its folder
// (the buffers of a glTF file). No device, no pipe that would be waited for, no absolute path, no "..", no symbolic
// link that leads out of the folder, nothing for writing.
#define _XOPEN_SOURCE 700 // realpath, openat
#include "io/mesh/assimp_files.h"

#ifdef OVOID_WITH_ASSIMP

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/// An open file; it owns its bytes unless it is the imported one.
typedef struct open_file {
    bytes file;
    size_t at;
    int is_owned;
} open_file;

static open_file *get_file(struct aiFile *file) { return (open_file *)(void *)file->UserData; }

// Reads as fread does.
static size_t read_file(struct aiFile *file, char *to, size_t size, size_t count) {
    open_file *f = get_file(file);
    size_t left = f->file.size - f->at;
    if (!size) return 0;
    if (count > left / size) count = left / size;
    memcpy(to, f->file.data + f->at, size * count);
    f->at += size * count;
    return count;
}

static size_t write_file(struct aiFile *file, const char *from, size_t size, size_t count) {
    (void)file, (void)from, (void)size, (void)count;
    return 0;
}

static size_t get_position(struct aiFile *file) { return get_file(file)->at; }

static size_t size_file(struct aiFile *file) { return get_file(file)->file.size; }

// Seeks; an offset may be a negative number converted to size_t.
static enum aiReturn seek_file(struct aiFile *file, size_t offset, enum aiOrigin origin) {
    open_file *f = get_file(file);
    size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? f->at : f->file.size;
    if (from + offset > f->file.size) return aiReturn_FAILURE;
    f->at = from + offset;
    return aiReturn_SUCCESS;
}

static void flush_file(struct aiFile *file) { (void)file; }

// 1 if the path is below the folder of the imported file.
static int is_below(const char *base, const char *path) {
    const char *slash = strrchr(base, '/');
    size_t folder = slash ? (size_t)(slash - base) + 1 : 0;
    if (strncmp(path, base, folder) != 0) return 0;
    const char *name = path + folder;
    if (folder == 0 && name[0] == '.' && name[1] == '/') name += 2;
    if (name[0] == '/') return 0;
    for (const char *at = name; (at = strstr(at, "..")); at += 2)
        if ((at == name || at[-1] == '/') && (at[2] == '/' || !at[2])) return 0;
    return 1;
}

// Opens a file by its way down from a folder, neither of which may have links any more: step by step, following none,
// so that a link which is put there meanwhile leads nowhere. -1 with errno.
static int open_steps(const char *folder, char *way) {
    int at = open(*folder ? folder : "/", FILE_OPEN_FLAGS | O_DIRECTORY);
    for (char *step = way, *rest; at >= 0 && step; step = rest) {
        rest = strchr(step, '/');
        if (rest) *rest++ = 0;
        int next = openat(at, step, FILE_OPEN_FLAGS | O_NOFOLLOW | (rest ? O_DIRECTORY : 0));
        close(at);
        at = next;
    }
    return at;
}

// The folder of a path that has no links, without the slash at its end.
static void cut_name(char *path) { *strrchr(path, '/') = 0; }

// The way down from the folder to the file, or NULL where it is not below.
static char *find_way(const char *folder, char *file) {
    size_t length = strlen(folder);
    return strncmp(file, folder, length) == 0 && file[length] == '/' ? file + length + 1 : NULL;
}

// Opens a file whose path without links is given, where it is below the folder of the imported file's name, or of the
// file that this name leads to. -1 with errno; 0 there: it is below neither.
static int open_below(const char *base, char *resolved) {
    char *named = path_join(base, "."), *folders[2] = {named ? realpath(named, NULL) : NULL, realpath(base, NULL)};
    if (folders[0] && strcmp(folders[0], "/") == 0) *folders[0] = 0;
    if (folders[1]) cut_name(folders[1]);
    int file = -1, why = 0;
    char *way = NULL;
    for (int i = 0; i < 2 && !way; i++) {
        way = folders[i] ? find_way(folders[i], resolved) : NULL;
        if (!way) continue;
        file = open_steps(folders[i], way);
        why = errno;
    }
    free(named), free(folders[0]), free(folders[1]);
    errno = why;
    return file;
}

static ovoid_code fail_open(const char *path, ovoid_error *error) {
    return io_fail(error, OVOID_ERROR_FILE, (where){path, 0, -1}, "cannot be opened: %s", strerror(errno));
}

// Reads a file beside the imported one.
static ovoid_code read_other(const assimp_files *files, const char *path, bytes *out, ovoid_error *error) {
    where at = {path, 0, -1};
    struct stat status;
    if (!is_below(files->path, path))
        return io_fail(error, OVOID_ERROR_FILE, at, "is not below the folder of the file that names it");
    char *resolved = realpath(path, NULL);
    if (!resolved) return fail_open(path, error);
    int file = open_below(files->path, resolved);
    ovoid_code code = OVOID_OK;
    if (file < 0 && !errno)
        code = io_fail(error, OVOID_ERROR_FILE, at, "a link leads out of the folder of the file that names it, to %s",
                       resolved);
    else if (file < 0)
        code = fail_open(path, error);
    free(resolved);
    if (code) return code;
    if (files->before_reading && fstat(file, &status) == 0) files->before_reading((size_t)status.st_size);
    return bytes_read_open(&(opened_file){file, path}, OVOID_FILE_SIZE_MAX, out, error);
}

static struct aiFile *open_named(struct aiFileIO *io, const char *path, const char *mode) {
    assimp_files *files = (assimp_files *)(void *)io->UserData;
    open_file *f = calloc(1, sizeof *f);
    struct aiFile *file = calloc(1, sizeof *file);
    int is_main = strcmp(path, files->path) == 0;
    int good = f && file && !strpbrk(mode, "wa+");
    if (good && is_main) f->file = files->file;
    if (good && !is_main)
        f->is_owned = good = !read_other(files, path, &f->file, files->refused.code ? NULL : &files->refused);
    if (!good) {
        free(f);
        free(file);
        return NULL;
    }
    *file = (struct aiFile){read_file, write_file, get_position, size_file, seek_file, flush_file, (char *)f};
    return file;
}

static void close_named(struct aiFileIO *io, struct aiFile *file) {
    (void)io;
    open_file *f = get_file(file);
    if (f->is_owned) free(f->file.data);
    free(f);
    free(file);
}

struct aiFileIO assimp_files_make(assimp_files *files) {
    return (struct aiFileIO){open_named, close_named, (char *)(void *)files};
}

#else

// A translation unit must not be empty.
typedef int no_assimp_files;

#endif
