// A whole file in memory, errors with path and line, numbers in any locale, arrays that grow.
// Numbers: up to 15 digits and a power of ten up to 22 are exact in doubles, so that one multiplication or division
// rounds correctly (W. D. Clinger, How to read floating point numbers accurately, 1990); the rest goes to strtod.
#define _POSIX_C_SOURCE 200809L
#include "io/text.h"

#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// ---- errors

// The end of a long path, so that the sentence after it has room.
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

static ovoid_code read_all(int file, size_t size, const char *path, bytes *out, ovoid_error *error) {
    out->data = malloc(size + 1);
    if (!out->data) return io_fail_memory(error, path);
    out->size = 0;
    while (out->size < size) {
        ssize_t n = read(file, out->data + out->size, size - out->size);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) {
            int reason = errno;
            free(out->data);
            out->data = NULL;
            return io_fail(error, OVOID_ERROR_FILE, (where){path, 0, -1}, "cannot be read: %s", strerror(reason));
        }
        if (n == 0) break; // the file has become shorter: its reader will say so
        out->size += (size_t)n;
    }
    out->data[out->size] = 0;
    return OVOID_OK;
}

ovoid_code bytes_read(const char *path, bytes *out, ovoid_error *error) {
    *out = (bytes){NULL, 0};
    where at = {path, 0, -1};
    // O_NONBLOCK: a pipe of that name must be refused, not waited for.
    int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return io_fail(error, OVOID_ERROR_FILE, at, "cannot be opened: %s", strerror(errno));
    struct stat status;
    ovoid_code code;
    if (fstat(file, &status) != 0)
        code = io_fail(error, OVOID_ERROR_FILE, at, "cannot be read: %s", strerror(errno));
    else if (!S_ISREG(status.st_mode))
        code = io_fail(error, OVOID_ERROR_FILE, at, "is not a regular file");
    else if ((uint64_t)status.st_size > OVOID_FILE_SIZE_MAX)
        code = io_fail(error, OVOID_ERROR_LIMIT, at, "has %lld bytes; at most %zu are read", (long long)status.st_size,
                       OVOID_FILE_SIZE_MAX);
    else if (status.st_size == 0)
        code = io_fail(error, OVOID_ERROR_EMPTY, at, "the file is empty");
    else
        code = read_all(file, (size_t)status.st_size, path, out, error);
    close(file);
    return code;
}

int array_reserve(void **data, size_t *capacity, size_t count, size_t size) {
    if (count < *capacity) return 1;
    if (*capacity > SIZE_MAX / 4 / size) return 0;
    size_t grown = *capacity ? *capacity * 2 : 64;
    void *moved = realloc(*data, grown * size);
    if (!moved) return 0;
    *data = moved;
    *capacity = grown;
    return 1;
}

// ---- numbers

static const double power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

static int is_digit(char c) { return c >= '0' && c <= '9'; }

// The word `name` in any case at `at`.
static int is_word(const char *at, const char *end, const char *name) {
    for (; *name; name++, at++)
        if (at == end || (*at | 0x20) != *name) return 0;
    return 1;
}

// inf, infinity, nan.
static const char *read_special(const char *at, const char *end, double sign, double *value) {
    if (is_word(at, end, "nan")) {
        *value = NAN;
        return at + 3;
    }
    if (!is_word(at, end, "inf")) return NULL;
    *value = sign * INFINITY;
    return is_word(at, end, "infinity") ? at + 8 : at + 3;
}

// Whatever the fast path cannot round: strtod, which wants the locale's point and a terminated text. Of a number of
// more than 800 digits the rest cannot change the rounding of any double that has fewer; it is refused.
static const char *read_slow(const char *begin, const char *end, double *value) {
    char copy[1024];
    size_t length = (size_t)(end - begin);
    const char *point = localeconv()->decimal_point;
    size_t point_length = strlen(point);
    if (length + point_length >= sizeof copy) return NULL;
    size_t n = 0;
    for (const char *c = begin; c < end; c++) {
        if (*c == '.') {
            memcpy(copy + n, point, point_length);
            n += point_length;
        } else {
            copy[n++] = *c;
        }
    }
    copy[n] = 0;
    *value = strtod(copy, NULL);
    return end;
}

const char *number_read(const char *at, const char *end, double *value) {
    const char *begin = at;
    double sign = 1;
    if (at < end && (*at == '-' || *at == '+')) sign = *at++ == '-' ? -1 : 1;
    if (at < end && !is_digit(*at) && *at != '.') return read_special(at, end, sign, value);
    // Digits before and after the point; beyond 19 they no longer fit and only mark the number as slow.
    uint64_t mantissa = 0;
    int digits = 0, used = 0, exponent = 0;
    for (; at < end && is_digit(*at); at++, digits++) {
        if (used < 19) mantissa = mantissa * 10 + (uint64_t)(*at - '0');
        used += mantissa > 0;
    }
    if (at < end && *at == '.')
        for (at++; at < end && is_digit(*at); at++, digits++, exponent--) {
            if (used < 19) mantissa = mantissa * 10 + (uint64_t)(*at - '0');
            used += mantissa > 0;
        }
    if (!digits) return NULL;
    if (at < end && (*at == 'e' || *at == 'E')) {
        int64_t power;
        const char *after = integer_read(at + 1, end, &power);
        if (after) {
            at = after;
            exponent = power > 100000 ? 100000 : power < -100000 ? -100000 : exponent + (int)power;
        }
    }
    if (used > 19 || mantissa > (uint64_t)1 << 53 || exponent < -22 || exponent > 22)
        return read_slow(begin, at, value);
    double m = (double)mantissa;
    *value = sign * (exponent < 0 ? m / power_of_ten[-exponent] : m * power_of_ten[exponent]);
    return at;
}

const char *integer_read(const char *at, const char *end, int64_t *value) {
    int negative = 0;
    if (at < end && (*at == '-' || *at == '+')) negative = *at++ == '-';
    if (at == end || !is_digit(*at)) return NULL;
    int64_t v = 0;
    for (; at < end && is_digit(*at); at++) v = v > (INT64_MAX - 9) / 10 ? INT64_MAX : v * 10 + (*at - '0');
    *value = negative ? -v : v;
    return at;
}

size_t number_write(char out[32], double value, int digits) {
    // Small whole numbers are frequent and quick; minus zero is not one.
    int whole = fabs(value) < 1e6 ? (int)value : 0;
    if (whole && (double)whole == value) return (size_t)snprintf(out, 32, "%d", whole);
    if (isnan(value)) return (size_t)snprintf(out, 32, "nan");
    if (isinf(value)) return (size_t)snprintf(out, 32, value < 0 ? "-inf" : "inf");
    size_t n = (size_t)snprintf(out, 32, "%.*g", digits, value);
    // The locale's point, which may have several bytes, becomes one.
    const char *point = localeconv()->decimal_point;
    if (point[0] == '.' && !point[1]) return n;
    char *at = strstr(out, point);
    if (!at) return n;
    size_t length = strlen(point);
    *at = '.';
    memmove(at + 1, at + length, n - (size_t)(at - out) - length + 1);
    return n - length + 1;
}

// ---- text and paths

char *text_copy(const char *text, size_t length) {
    char *copy = malloc(length + 1);
    if (!copy) return NULL;
    if (length) memcpy(copy, text, length);
    copy[length] = 0;
    return copy;
}

char *path_join(const char *base, const char *name) {
    const char *slash = strrchr(base, '/');
    size_t folder = slash && name[0] != '/' ? (size_t)(slash - base) + 1 : 0;
    size_t length = strlen(name);
    char *joined = malloc(folder + length + 1);
    if (!joined) return NULL;
    if (folder) memcpy(joined, base, folder);
    memcpy(joined + folder, name, length + 1);
    return joined;
}

int path_has_extension(const char *path, const char *extension) {
    const char *dot = strrchr(path, '.');
    if (!dot || strlen(dot + 1) != strlen(extension)) return 0;
    return is_word(dot + 1, dot + 1 + strlen(extension), extension);
}
