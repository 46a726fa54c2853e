// Takes a line of JSON apart whose keys have a fixed order: enough for files that this library's tool writes, and
// strict.
#ifndef OVOID_ROBOT_READ_TEXT_SCAN_H
#define OVOID_ROBOT_READ_TEXT_SCAN_H

#include "robot/read/text/pool.h"

/// Where the scan of a line is. After a failure `what` says what was wanted at `at`, and nothing is taken any more.
typedef struct scan {
    const char *at, *end;
    const char *what; ///< NULL: no failure
    pool *memory;     ///< of texts
    int is_memory_out;
} scan;

/// 1 where the character is next, blanks before it apart; it is taken.
int scan_try(scan *s, char c);
/// The same, and a failure where it is not.
void scan_take(scan *s, char c);
/// 1 where a key is next, with a comma before it unless is_first; it is taken, with its colon.
int scan_try_key(scan *s, const char *key, int is_first);
/// 1 where a key is next behind a comma; nothing is taken.
int scan_is_key(const scan *s, const char *key);
void scan_take_key(scan *s, const char *key, int is_first);
/// A finite number.
double scan_number(scan *s);
/// A number, or null.
double scan_number_or(scan *s, double if_null);
/// A whole number from 0 to `most`, at most 2^53.
uint64_t scan_whole(scan *s, uint64_t most);
/// true or false.
int scan_flag(scan *s);
/// A text of UTF-8 without zero bytes, in memory of the pool; "" after a failure.
const char *scan_text(scan *s);
/// A text, or NULL for null.
const char *scan_text_or_null(scan *s);
/// Sets a failure, unless there is one.
void scan_fail(scan *s, const char *what);
/// The line must end here.
void scan_end(scan *s);

#endif
