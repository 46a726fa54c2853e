// Pieces of a page's data: JSON that cannot end a script element, and arrays of numbers as base64.
#ifndef OVOID_CLI_PAGE_WRITE_H
#define OVOID_CLI_PAGE_WRITE_H

#include <ovoid/linear.h>

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/// Copies JSON: each < becomes \u003c, so that nothing in it ends a script or begins a comment; each byte that is not
/// UTF-8 becomes \ufffd; line ends, which no string contains, are dropped.
void page_copy_json(FILE *file, const char *json, size_t size);

/// Writes a text as a JSON string, with the same escapes.
void page_write_text(FILE *file, const char *text);

/// Writes "KEY":[x,y,z], after `before`.
void page_write_vector(FILE *file, const char *before, const char *key, ovoid_vec3 v);

/// Writes {"xyz":[...],"quat_wxyz":[...]}.
void page_write_pose(FILE *file, const ovoid_pose *pose);

/// A writer of base64 (RFC 4648, the standard alphabet, padded).
typedef struct page_base64 {
    FILE *file;
    unsigned bits;  ///< the bits of the waiting bytes
    unsigned count; ///< the number of these bytes, below 3
} page_base64;

/// Writes a string in quotes: begin, any number of add, end. Numbers are little-endian on every machine.
page_base64 page_base64_begin(FILE *file);
void page_base64_add_bytes(page_base64 *to, const void *bytes, size_t size);
void page_base64_add_uint32(page_base64 *to, uint32_t value);
void page_base64_add_float(page_base64 *to, double value);
void page_base64_add_double(page_base64 *to, double value);
void page_base64_end(page_base64 *to);

#endif
