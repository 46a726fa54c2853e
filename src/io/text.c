// A whole file in memory, errors with path and line, arrays that grow, texts and paths.
#define _POSIX_C_SOURCE 200809L
#include "io/text.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// ---- errors

// The end of a long path, which leaves room for the sentence after it.
static const char *shorten_path(const char *path) {
    size_t length = strlen(path);
    return length <= 110 ? path : path + length - 110;
}

void io_report(ovoid_error *error, ovoid_code code, where at, const char *format, ...) {
    if (!error) return;
    error->code = code;
    error->place = at.line > 0 ? at.line : at.place;
    const char *path = shorten_path(at.path);
    const char *dots = path == at.path ? "" : "...";
    size_t room = sizeof error->message;
    int used = at.line > 0 ? snprintf(error->message, room, "%s%s:%lld: ", dots, path, (long long)at.line)
                           : snprintf(error->message, room, "%s%s: ", dots, path);
    va_list arguments;
    va_start(arguments, format);
    if (used >= 0 && (size_t)used < room)
        (void)vsnprintf(error->message + used, room - (size_t)used, format, arguments);
    va_end(arguments);
}

void io_prefix_path(ovoid_error *error, const char *path) {
    if (!error) return;
    ovoid_error inner = *error;
    io_report(error, inner.code, (where){path, 0, inner.place}, "%s", inner.message);
}

// ---- files

static ovoid_code read_all(const opened_file *from, size_t size, bytes *out, ovoid_error *error) {
    const char *path = from->path;
    out->data = malloc(size + 1);
    if (!out->data) return io_fail_memory(error, path);
    out->size = 0;
    while (out->size < size) {
        ssize_t n = read(from->file, out->data + out->size, size - out->size);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) {
            int reason = errno;
            free(out->data);
            out->data = NULL;
            return io_fail(error, OVOID_ERROR_FILE, (where){path, 0, -1}, "cannot be read: %s", strerror(reason));
        }
        if (n == 0) break; // the file has become shorter: its reader will find out
        out->size += (size_t)n;
    }
    out->data[out->size] = 0;
    return OVOID_OK;
}

bytes bytes_skip_mark(bytes text) {
    if (text.size < 3 || memcmp(text.data, "\xef\xbb\xbf", 3) != 0) return text;
    return (bytes){text.data + 3, text.size - 3};
}

int text_is_pointer(const char *text, size_t length) {
    static const char begin[] = "version https://git-lfs.github.com/spec/";
    return length >= sizeof begin - 1 && memcmp(text, begin, sizeof begin - 1) == 0;
}

// What no reader wants.
static ovoid_code validate_content(const char *path, bytes *out, ovoid_error *error) {
    where at = {path, 0, -1};
    ovoid_code code = OVOID_OK;
    if (out->size == 0) code = io_fail(error, OVOID_ERROR_EMPTY, at, "the file is empty");
    if (text_is_pointer(out->data, out->size)) code = io_fail(error, OVOID_ERROR_FORMAT, at, TEXT_POINTER_SENTENCE);
    if (!code) return OVOID_OK;
    free(out->data);
    *out = (bytes){NULL, 0};
    return code;
}

// Reads what is open, which must be a regular file of at most `most` bytes.
static ovoid_code read_open(const opened_file *from, size_t most, bytes *out, ovoid_error *error) {
    where at = {from->path, 0, -1};
    struct stat status;
    if (fstat(from->file, &status) != 0)
        return io_fail(error, OVOID_ERROR_FILE, at, "cannot be read: %s", strerror(errno));
    if (!S_ISREG(status.st_mode)) return io_fail(error, OVOID_ERROR_FILE, at, "is not a regular file");
    if ((uint64_t)status.st_size > most)
        return io_fail(error, OVOID_ERROR_LIMIT, at, "has %lld bytes; at most %zu are read", (long long)status.st_size,
                       most);
    return read_all(from, (size_t)status.st_size, out, error);
}

ovoid_code bytes_read_open(const opened_file *from, size_t most, bytes *out, ovoid_error *error) {
    *out = (bytes){NULL, 0};
    ovoid_code code = read_open(from, most, out, error);
    close(from->file);
    return code ? code : validate_content(from->path, out, error);
}

static ovoid_code read_file(const char *path, size_t most, bytes *out, ovoid_error *error) {
    *out = (bytes){NULL, 0};
    int file = open(path, FILE_OPEN_FLAGS);
    if (file < 0)
        return io_fail(error, OVOID_ERROR_FILE, (where){path, 0, -1}, "cannot be opened: %s", strerror(errno));
    return bytes_read_open(&(opened_file){file, path}, most, out, error);
}

// Standard input, of a length that is not known before.
static ovoid_code read_input(size_t most, bytes *out, ovoid_error *error) {
    size_t capacity = 1 << 16;
    where at = {"-", 0, -1};
    *out = (bytes){malloc(capacity), 0};
    for (size_t n = 1; out->data && n;) {
        n = fread(out->data + out->size, 1, capacity - 1 - out->size, stdin);
        out->size += n;
        if (out->size > most || ferror(stdin)) {
            free(out->data);
            if (out->size > most)
                return io_fail(error, OVOID_ERROR_LIMIT, at, "has more than %zu bytes, the most that are read", most);
            return io_fail(error, OVOID_ERROR_FILE, at, "cannot be read: %s", strerror(errno));
        }
        if (out->size + 1 < capacity) continue;
        char *grown = realloc(out->data, capacity *= 2);
        if (!grown) free(out->data);
        out->data = grown;
    }
    if (!out->data) return io_fail_memory(error, "-");
    out->data[out->size] = 0;
    return validate_content("-", out, error);
}

int bytes_begin_file(const char *path, const void *begin, size_t size) {
    char found[64];
    struct stat status;
    int file = open(path, FILE_OPEN_FLAGS);
    if (file < 0) return 0;
    int is_one = fstat(file, &status) == 0 && S_ISREG(status.st_mode) && size <= sizeof found &&
                 read(file, found, (unsigned)size) == (ptrdiff_t)size && memcmp(found, begin, size) == 0;
    close(file);
    return is_one;
}

ovoid_code bytes_read(const char *path, bytes *out, ovoid_error *error) {
    return read_file(path, OVOID_FILE_SIZE_MAX, out, error);
}

ovoid_code bytes_read_input(const char *path, size_t most, bytes *out, ovoid_error *error) {
    return strcmp(path, "-") == 0 ? read_input(most, out, error) : read_file(path, most, out, error);
}

// ---- text and paths

char *text_copy(const char *text, size_t length) {
    char *copy = malloc(length + 1);
    if (!copy) return NULL;
    if (length) memcpy(copy, text, length);
    copy[length] = 0;
    return copy;
}

// FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo, 1991).
uint64_t text_hash(const char *text) {
    uint64_t h = 0xcbf29ce484222325u;
    for (; *text; text++) h = (h ^ (unsigned char)*text) * 0x100000001b3u;
    return h;
}

char *path_join(const char *base, const char *name) {
    const char *slash = strrchr(base, '/');
    size_t folder = slash && name[0] != '/' ? (size_t)(slash - base) + 1 : 0;
    if (!folder && strcmp(name, "-") == 0) name = "./-";
    size_t length = strlen(name);
    char *joined = malloc(folder + length + 1);
    if (!joined) return NULL;
    if (folder) memcpy(joined, base, folder);
    memcpy(joined + folder, name, length + 1);
    return joined;
}

int text_begins_with(const char *at, const char *end, const char *name) {
    for (; *name; name++, at++)
        if (at == end || (*at | 0x20) != *name) return 0;
    return 1;
}

int path_has_extension(const char *path, const char *extension) {
    const char *dot = strrchr(path, '.');
    if (!dot || strlen(dot + 1) != strlen(extension)) return 0;
    return text_begins_with(dot + 1, dot + 1 + strlen(extension), extension);
}
