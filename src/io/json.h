// JSON beyond what jansson offers: the line of a value, and texts written as JSON.
#ifndef OVOID_IO_JSON_H
#define OVOID_IO_JSON_H

#include "io/text.h"

#include <jansson.h>

/// A step into a value: the member of an object by its key, or the element of an array by its index (key NULL).
typedef struct json_step {
    const char *key;
    size_t index;
} json_step;

/// The 1-based line where the value at the end of the steps begins, of a text that jansson has accepted. Where a step
/// leads nowhere, the line of the value before it. Linear in the text: meant for messages.
int64_t json_find_line(bytes text, const json_step *steps, size_t count);

/// 1 if jansson failed for lack of memory. It does not always set that code, but then its message is empty.
int json_is_memory_error(const json_error_t *why);

/// The length of the UTF-8 sequence at c, of a text that ends with a zero byte; 0 if there is none.
int utf8_get_length(const unsigned char *c);

/// Writes a text in quotes. Bytes that are not UTF-8 become U+FFFD.
void json_write_text(FILE *file, const char *text);

/// Writes %.17g; null where it is not finite.
void json_write_number(FILE *file, double value);

#endif
