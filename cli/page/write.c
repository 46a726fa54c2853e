// JSON for a script element, and base64.
#include "page/write.h"

#include "io/fields.h"

#include <stdlib.h>
#include <string.h>

/// The length of the UTF-8 character at c (RFC 3629: no surrogates, no overlong forms, nothing above U+10FFFF), of
/// which `left` bytes are available; 0 if it is not UTF-8.
static size_t get_length(const unsigned char *c, size_t left) {
    size_t length = c[0] < 0x80 ? 1 : c[0] < 0xc2 ? 0 : c[0] < 0xe0 ? 2 : c[0] < 0xf0 ? 3 : c[0] < 0xf5 ? 4 : 0;
    if (length > left) return 0;
    for (size_t i = 1; i < length; i++)
        if ((c[i] & 0xc0) != 0x80) return 0;
    int is_out = (c[0] == 0xe0 && c[1] < 0xa0) || (c[0] == 0xed && c[1] > 0x9f) || (c[0] == 0xf0 && c[1] < 0x90) ||
                 (c[0] == 0xf4 && c[1] > 0x8f);
    return is_out ? 0 : length;
}

void page_copy_json(FILE *file, const char *json, size_t size) {
    const unsigned char *c = (const unsigned char *)json;
    while (size) {
        size_t length = get_length(c, size);
        if (*c == '<')
            fputs("\\u003c", file);
        else if (length && *c != '\n')
            fwrite(c, 1, length, file);
        else if (!length)
            fputs("\\ufffd", file);
        length += !length;
        c += length;
        size -= length;
    }
}

void page_write_text(FILE *file, const char *text) {
    fputc('"', file);
    for (const char *end; *text; text = end) {
        // Text without escapes is written at once, so that no character is split.
        end = text;
        while ((unsigned char)*end >= 0x20 && *end != '"' && *end != '\\') end++;
        page_copy_json(file, text, (size_t)(end - text));
        if (!*end) break;
        fprintf(file, (unsigned char)*end < 0x20 ? "\\u%04x" : "\\%c", (unsigned char)*end);
        end++;
    }
    fputc('"', file);
}

static void write_numbers(FILE *file, const char *key, const double *numbers, int count) {
    fprintf(file, "\"%s\":", key);
    json_write_numbers(file, numbers, (size_t)count);
}

void page_write_vector(FILE *file, const char *before, const char *key, ovoid_vec3 v) {
    const double xyz[] = {v.x, v.y, v.z};
    fputs(before, file);
    write_numbers(file, key, xyz, 3);
}

void page_write_pose(FILE *file, const ovoid_pose *pose) {
    const ovoid_quat q = pose->rotation;
    const double quat[] = {q.w, q.x, q.y, q.z};
    page_write_vector(file, "{", "xyz", pose->position);
    fputc(',', file);
    write_numbers(file, "quat_wxyz", quat, 4);
    fputc('}', file);
}

// ---- base64

/// Writes the waiting bytes, padded with zeros, as that many characters and signs "=".
static void write_group(page_base64 *to) {
    static const char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned bits = to->bits << 8 * (3 - to->count);
    char text[4];
    for (unsigned i = 0; i < 4; i++) text[i] = i <= to->count ? alphabet[bits >> (18 - 6 * i) & 63] : '=';
    fwrite(text, 1, sizeof text, to->file);
    to->bits = to->count = 0;
}

page_base64 page_base64_begin(FILE *file) {
    fputc('"', file);
    return (page_base64){file, 0, 0};
}

void page_base64_add_bytes(page_base64 *to, const void *bytes, size_t size) {
    const unsigned char *c = bytes;
    for (size_t i = 0; i < size; i++) {
        to->bits = to->bits << 8 | c[i];
        if (++to->count == 3) write_group(to);
    }
}

/// Adds the low bytes of a number, the lowest first.
static void add_number(page_base64 *to, uint64_t number, unsigned size) {
    unsigned char bytes[8];
    for (unsigned i = 0; i < size; i++) bytes[i] = (unsigned char)(number >> 8 * i);
    page_base64_add_bytes(to, bytes, size);
}

void page_base64_add_uint32(page_base64 *to, uint32_t value) { add_number(to, value, 4); }

void page_base64_add_float(page_base64 *to, double value) {
    float number = (float)value;
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    add_number(to, bits, 4);
}

void page_base64_add_double(page_base64 *to, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    add_number(to, bits, 8);
}

void page_base64_end(page_base64 *to) {
    if (to->count) write_group(to);
    fputc('"', to->file);
}
