// The files that Assimp may open: the imported file, which is in memory already, and regular files below its folder
// (the buffers of a glTF file). No device, no pipe that would be waited for, no absolute path, no "..", nothing for
// writing.
#include "io/mesh/assimp_files.h"

#ifdef OVOID_WITH_ASSIMP

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

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

// Reads a file beside the imported one. 1, or 0 where it may not be read.
static int read_other(const assimp_files *files, const char *path, bytes *file) {
    struct stat status;
    if (!is_below(files->path, path) || stat(path, &status) != 0 || !S_ISREG(status.st_mode)) return 0;
    if (files->before_reading) files->before_reading((size_t)status.st_size);
    return bytes_read(path, file, NULL) == OVOID_OK;
}

static struct aiFile *open_named(struct aiFileIO *io, const char *path, const char *mode) {
    const assimp_files *files = (const assimp_files *)(void *)io->UserData;
    open_file *f = calloc(1, sizeof *f);
    struct aiFile *file = calloc(1, sizeof *file);
    int is_main = strcmp(path, files->path) == 0;
    int good = f && file && !strpbrk(mode, "wa+");
    if (good && is_main) f->file = files->file;
    if (good && !is_main) f->is_owned = good = read_other(files, path, &f->file);
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
