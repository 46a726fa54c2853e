// Shared by all readers: a whole file in memory, errors with path and line, numbers in any locale, arrays that grow.
// Nothing here knows a format.
#ifndef OVOID_IO_TEXT_H
#define OVOID_IO_TEXT_H

#include "tools/array.h"

#include "base/compiler.h"
#include "ovoid/io.h"

/// The place of an error.
typedef struct where {
    const char *path;
    int64_t line;  ///< 1-based; 0: none
    int64_t place; ///< where there is no line
} where;

/// Fills *error (NULL is allowed): "path:line: sentence" with place = line where there is a line, else "path: sentence"
/// with the place given. A long path keeps its end.
COMPILER_PRINTF(4, 5)
void io_report(ovoid_error *error, ovoid_code code, where at, const char *format, ...);

/// Reports an error and has the value of its code: a macro, so that compilers know that it is not OVOID_OK.
#define io_fail(error, code, ...) (io_report(error, code, __VA_ARGS__), (code))

/// The error for memory that malloc did not give.
static inline ovoid_code io_fail_memory(ovoid_error *error, const char *path) {
    return io_fail(error, OVOID_ERROR_MEMORY, (where){path, 0, -1}, "there is not enough memory");
}

/// Puts "path: " before the sentence of an error that the core has filled.
void io_prefix_path(ovoid_error *error, const char *path);

/// A file in memory; a zero byte follows the last one.
typedef struct bytes {
    char *data;
    size_t size;
} bytes;

/// Reads a regular file of at most OVOID_FILE_SIZE_MAX bytes. The caller frees out->data.
ovoid_code bytes_read(const char *path, bytes *out, ovoid_error *error);
/// Reads a regular file, or standard input where the path is "-", of at most `most` bytes. The caller frees out->data.
ovoid_code bytes_read_input(const char *path, size_t most, bytes *out, ovoid_error *error);

/// 1 if the path names a regular file that begins with these bytes, at most 64. A pipe is not waited for.
int bytes_begin_file(const char *path, const void *begin, size_t size);

/// How files are opened to be read. O_NONBLOCK: a pipe of that name must be refused, not waited for.
#define FILE_OPEN_FLAGS (O_RDONLY | O_NONBLOCK | O_CLOEXEC)
/// An open file, and its path for messages.
typedef struct opened_file {
    int file;
    const char *path;
} opened_file;

/// Reads a regular file of at most `most` bytes, and closes it. The caller frees out->data.
ovoid_code bytes_read_open(const opened_file *from, size_t most, bytes *out, ovoid_error *error);

/// The text without a byte order mark (UTF-8) at its beginning: a view.
bytes bytes_skip_mark(bytes text);
/// 1 if the text is that of a Git LFS pointer, which stands in the place of a file that was not fetched.
int text_is_pointer(const char *text, size_t length);
/// The sentence that says so.
#define TEXT_POINTER_SENTENCE "is a Git LFS pointer, not the file itself; \"git lfs pull\" fetches that"

/// Reads a decimal number, or inf, infinity, nan in any case, with a sign; always with a point. Returns the byte after
/// it, or NULL where none begins at `at`. Correctly rounded; beyond the range of double it is infinite or zero.
const char *number_read(const char *at, const char *end, double *value);

/// Reads an optional sign and digits; saturates at the ends of int64. Returns the byte after them, or NULL.
const char *integer_read(const char *at, const char *end, int64_t *value);

/// Writes %.*g with at most 17 digits and a point in any locale; not finite: "inf", "-inf", "nan". Returns the length.
size_t number_write(char out[32], double value, int digits);

/// A text that is read line by line, from a file or a pipe of any length.
typedef struct line_source {
    FILE *file;
    char *path;
    char *buffer;
    size_t capacity, begin, end; ///< the bytes read and not yet returned: buffer[begin .. end)
    int64_t line;                ///< 1-based number of the last line returned
    uint64_t taken;              ///< bytes of all lines returned, with their ends
    size_t most;                 ///< longest line that is read, bytes: LINE_MAX_BYTES when opened
} line_source;

enum { LINE_MAX_BYTES = 1 << 20 };

/// Opens the path; "-" is standard input.
ovoid_code line_source_open(line_source *source, const char *path, ovoid_error *error);
/// The next line without its end ("\n" or "\r\n"), valid until the next call. 1, 0 at the end, -1: *error is filled.
int line_source_next(line_source *source, const char **line, size_t *length, ovoid_error *error);
void line_source_close(line_source *source);

/// malloc'ed copy of length bytes, terminated; NULL where there is no memory.
char *text_copy(const char *text, size_t length);

/// The length of the UTF-8 sequence at c, of a text that ends with a zero byte; 0 if there is none.
int utf8_get_length(const unsigned char *c);

/// A 64-bit hash of the text.
uint64_t text_hash(const char *text);

/// malloc'ed path of `name` relative to the folder of `base`; an absolute name stays. Never "-", which is no file.
char *path_join(const char *base, const char *name);

/// 1 if the word `name`, given in lower case, stands at `at`, in any case.
int text_begins_with(const char *at, const char *end, const char *name);

/// 1 if the path ends in `.extension` (given without the point, in lower case), in any case.
int path_has_extension(const char *path, const char *extension);

#endif
