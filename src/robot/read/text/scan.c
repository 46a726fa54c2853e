// JSON (RFC 8259) with its keys in a known order.
#include "robot/read/text/scan.h"

#include <math.h>
#include <string.h>

void scan_fail(scan *s, const char *what) {
    if (!s->what) s->what = what;
}

static void skip_blanks(scan *s) {
    while (s->at < s->end && (*s->at == ' ' || *s->at == '\t' || *s->at == '\r')) s->at++;
}

int scan_try(scan *s, char c) {
    if (s->what) return 0;
    skip_blanks(s);
    if (s->at == s->end || *s->at != c) return 0;
    s->at++;
    return 1;
}

void scan_take(scan *s, char c) {
    static const char *const names[] = {"\"{\" is missing", "\"}\" is missing", "\"[\" is missing", "\"]\" is missing",
                                        "\",\" is missing", "\":\" is missing", "a text is missing"};
    static const char characters[] = "{}[],:\"";
    if (!scan_try(s, c)) scan_fail(s, names[strchr(characters, c) - characters]);
}

// 1 where the word is next; it is taken.
static int try_word(scan *s, const char *word) {
    size_t length = strlen(word);
    if (s->what) return 0;
    skip_blanks(s);
    if ((size_t)(s->end - s->at) < length || memcmp(s->at, word, length) != 0) return 0;
    s->at += length;
    return 1;
}

int scan_try_key(scan *s, const char *key, int is_first) {
    const char *from = s->at;
    size_t length = strlen(key);
    if (!is_first && !scan_try(s, ',')) return 0;
    if (scan_try(s, '"') && (size_t)(s->end - s->at) > length && memcmp(s->at, key, length) == 0 &&
        s->at[length] == '"') {
        s->at += length + 1;
        if (scan_try(s, ':')) return 1;
    }
    s->at = from;
    return 0;
}

int scan_is_key(const scan *s, const char *key) {
    scan ahead = *s;
    return scan_try_key(&ahead, key, 0);
}

void scan_take_key(scan *s, const char *key, int is_first) {
    if (!scan_try_key(s, key, is_first)) scan_fail(s, key);
}

double scan_number(scan *s) {
    double value = 0;
    if (s->what) return 0;
    skip_blanks(s);
    // Words for what is not finite are none of JSON's numbers.
    int begins = s->at < s->end && (*s->at == '-' || (*s->at >= '0' && *s->at <= '9'));
    const char *behind = begins ? number_read(s->at, s->end, &value) : NULL;
    if (!behind || !isfinite(value)) return scan_fail(s, "a finite number is missing"), 0;
    s->at = behind;
    return value;
}

double scan_number_or(scan *s, double if_null) { return try_word(s, "null") ? if_null : scan_number(s); }

uint64_t scan_whole(scan *s, uint64_t most) {
    double value = scan_number(s);
    if (s->what) return 0;
    if (!(value >= 0 && value <= 0x1p53 && value == floor(value)) || (uint64_t)value > most)
        return scan_fail(s, "a whole number is missing, or it is too large"), 0;
    return (uint64_t)value;
}

int scan_flag(scan *s) {
    if (try_word(s, "true")) return 1;
    if (!try_word(s, "false")) scan_fail(s, "true or false is missing");
    return 0;
}

// ---- texts

static int get_hex(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

// The four digits at c, of a text that goes on for as long; -1: they are none.
static int read_four(const char *c, const char *end) {
    int value = 0;
    if (end - c < 4) return -1;
    for (int i = 0; i < 4; i++) {
        int digit = get_hex(c[i]);
        if (digit < 0) return -1;
        value = 16 * value + digit;
    }
    return value;
}

// A character below U+10000 as UTF-8; behind it. The tool writes no others escaped.
static char *write_utf8(char *to, int c) {
    if (c < 0x80) return *to++ = (char)c, to;
    if (c < 0x800)
        *to++ = (char)(0xc0 | c >> 6);
    else {
        *to++ = (char)(0xe0 | c >> 12);
        *to++ = (char)(0x80 | (c >> 6 & 0x3f));
    }
    *to++ = (char)(0x80 | (c & 0x3f));
    return to;
}

// The escape behind a backslash at *at; 0: it is none.
static int take_escape(const char **at, const char *end, char **to) {
    static const char from[] = "\"\\/bfnrt", into[] = "\"\\/\b\f\n\r\t";
    if (*at == end) return 0;
    char c = *(*at)++;
    const char *found = c ? strchr(from, c) : NULL;
    if (found) return *(*to)++ = into[found - from], 1;
    int value = c == 'u' ? read_four(*at, end) : -1;
    if (value <= 0 || (value >= 0xd800 && value < 0xe000)) return 0;
    *at += 4;
    *to = write_utf8(*to, value);
    return 1;
}

const char *scan_text(scan *s) {
    scan_take(s, '"');
    if (s->what) return "";
    const char *close = s->at;
    while (close < s->end && *close != '"') close += *close == '\\' && close + 1 < s->end ? 2 : 1;
    if (close >= s->end) return scan_fail(s, "a text does not end"), "";
    char *text = pool_get(s->memory, (size_t)(close - s->at) + 1, 1), *to = text;
    if (!text) return s->is_memory_out = 1, scan_fail(s, "memory"), "";
    for (const char *c = s->at; c < close;) {
        int good = *c == '\\' ? (c++, take_escape(&c, close, &to)) : (*(to++) = *c, (unsigned char)*c++ >= 0x20);
        if (!good) return scan_fail(s, "a text has a character that it may not have"), "";
    }
    *to = 0;
    s->at = close + 1;
    return text;
}

const char *scan_text_or_null(scan *s) { return try_word(s, "null") ? NULL : scan_text(s); }

void scan_end(scan *s) {
    if (s->what) return;
    skip_blanks(s);
    if (s->at != s->end) scan_fail(s, "the line goes on where it should end");
}
