// JSON beyond what jansson offers: the line of a value, and numbers written as JSON.
#ifndef OVOID_IO_JSON_H
#define OVOID_IO_JSON_H

#include "io/fields.h"
#include "io/text.h"

#include <jansson.h>

/// Most values within each other. jansson's own limit, 2048, needs more stack than every thread has.
enum { JSON_DEPTH_MAX = 64 };

/// Loads a text, as json_loadb does. NULL and *why where it is no JSON, or nested too deep. The caller frees the value.
json_t *json_load(bytes text, int flags, json_error_t *why);

/// What kind of failure *why tells of: MEMORY (jansson does not always set that code, but then its message is empty),
/// LIMIT (nested too deep) or FORMAT.
ovoid_code json_get_failure(const json_error_t *why);

/// A step into a value: the member of an object by its key, or the element of an array by its index (key NULL).
typedef struct json_step {
    const char *key;
    size_t index;
} json_step;

/// The 1-based line where the value at the end of the steps begins, of a text that jansson has accepted. Where a step
/// leads nowhere, the line of the value before it. Linear in the text: meant for messages.
int64_t json_find_line(bytes text, const json_step *steps, size_t count);

/// The elements of a list in a text, one at a time: a million of them in one tree would be a gigabyte, and take twice
/// as long to make and to free.
typedef struct json_list {
    const char *at, *end; ///< behind the last element, and the closing bracket
    const json_t *loaded; ///< the list, where the tree has it
    size_t index;
    int flags, is_ended;
} json_list;

/// Loads a text but for the elements of the root's member `key`, which is an empty list in the tree; where the text
/// does not write that key plainly, or it is no list, all is in the tree. NULL and *why where the text is no JSON; so
/// may some of the elements still be.
json_t *json_load_around(bytes text, const char *key, int flags, json_list *list, json_error_t *why);

/// The next element in *element, which the caller frees: 1; 0 at the end; -1 where it is no JSON (or there is no
/// memory) and *why: its line is of no use.
int json_next(json_list *list, json_t **element, json_error_t *why);

/// A whole number from 0 to top; an array of as many.
int json_read_whole(const json_t *value, double top, double *whole);
int json_read_wholes(const json_t *value, size_t count, double top, double *whole);

#endif
