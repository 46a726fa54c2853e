// Texts of files, such as names, as other programs are given them: what a terminal or an editor would not show, or
// would take for a command, is masked; what a spreadsheet would take for a formula is not one any more. Both can be
// undone: a name is never lost (io/csv.h reads it back). Spreadsheets: G. Fielding, OWASP, CSV Injection.
#include "io/csv.h"
#include "io/json.h"

#include <ctype.h>
#include <string.h>

// R. Pike, K. Thompson, 1992; RFC 3629: no surrogates, no overlong forms, nothing above U+10FFFF.
int utf8_get_length(const unsigned char *c) {
    if (c[0] < 0x80) return 1;
    int length = c[0] >= 0xc2 && c[0] < 0xe0   ? 2
                 : c[0] >= 0xe0 && c[0] < 0xf0 ? 3
                 : c[0] >= 0xf0 && c[0] < 0xf5 ? 4
                                               : 0;
    for (int i = 1; i < length; i++)
        if ((c[i] & 0xc0) != 0x80) return 0;
    if (c[0] == 0xe0 && c[1] < 0xa0) return 0;
    if (c[0] == 0xed && c[1] > 0x9f) return 0;
    if (c[0] == 0xf0 && c[1] < 0x90) return 0;
    if (c[0] == 0xf4 && c[1] > 0x8f) return 0;
    return length;
}

// The code point of a sequence of that length.
static uint32_t get_point(const unsigned char *c, int length) {
    uint32_t point = length == 1 ? c[0] : c[0] & (0x7fu >> length);
    for (int i = 1; i < length; i++) point = point << 6 | (c[i] & 0x3fu);
    return point;
}

// 1 for what is not seen, or turns what is beside it round: controls (C0, DEL, C1), marks of direction, and characters
// without a width (Unicode 15, general category Cf but the soft hyphen and what belongs to numerals), ends of lines.
static int is_masked(uint32_t point) {
    static const struct {
        uint32_t first, last;
    } ranges[] = {{0, 0x1f},        {0x7f, 0x9f},     {0x61c, 0x61c},   {0x180e, 0x180e}, {0x200b, 0x200f},
                  {0x2028, 0x202e}, {0x2060, 0x206f}, {0xfeff, 0xfeff}, {0xfff9, 0xfffb}, {0xe0000, 0xe007f}};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++)
        if (point >= ranges[i].first && point <= ranges[i].last) return 1;
    return 0;
}

size_t ovoid_text_get_visible_length(const char *text) {
    const unsigned char *c = (const unsigned char *)text;
    int length = utf8_get_length(c);
    return length && !is_masked(get_point(c, length)) ? (size_t)length : 0;
}

// ---- JSON

static void write_escaped(FILE *file, uint32_t point) {
    if (point < 0x10000) {
        fprintf(file, "\\u%04x", (unsigned)point);
        return;
    }
    point -= 0x10000;
    fprintf(file, "\\u%04x\\u%04x", (unsigned)(0xd800 + (point >> 10)), (unsigned)(0xdc00 + (point & 0x3ff)));
}

void ovoid_text_write_json(FILE *file, const char *text) {
    fputc('"', file);
    for (const unsigned char *c = (const unsigned char *)text; *c;) {
        int length = utf8_get_length(c);
        uint32_t point = length ? get_point(c, length) : 0xfffd;
        if (point == '"' || point == '\\')
            fprintf(file, "\\%c", (char)point);
        else if (!length || is_masked(point))
            write_escaped(file, point);
        else
            fwrite(c, 1, (size_t)length, file);
        c += length ? length : 1;
    }
    fputc('"', file);
}

// ---- CSV

int text_is_formula(const char *text, const char *end) {
    static const char *const wide[] = {"\xef\xbc\x9d", "\xef\xbc\x8b", "\xef\xbc\x8d", "\xef\xbc\xa0"}; // = + - @
    while (text < end && *text == ' ') text++; // a tab is masked
    if (text == end) return 0;
    if (*text && strchr("=+-@'", *text)) return 1;
    for (size_t i = 0; i < sizeof wide / sizeof *wide; i++)
        if (end - text >= 3 && memcmp(text, wide[i], 3) == 0) return 1;
    return 0;
}

int text_read_escape(const char *text, const char *end) {
    static const char digits[] = "0123456789abcdef";
    if (end - text < 4 || text[0] != '\\' || text[1] != 'x') return -1;
    if (!isxdigit((unsigned char)text[2]) || !isxdigit((unsigned char)text[3])) return -1;
    const char *high = strchr(digits, tolower((unsigned char)text[2]));
    const char *low = strchr(digits, tolower((unsigned char)text[3]));
    return (int)(16 * (high - digits) + (low - digits));
}

// 1 for letters of ASCII, in any locale.
static int is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// 1 for a text of letters, digits, underscores and points that begins with a letter, as most names do.
static int is_word(const char *text) {
    const char *c = text;
    if (!is_letter(*c)) return 0;
    while (is_letter(*c) || (*c >= '0' && *c <= '9') || *c == '_' || *c == '.') c++;
    return !*c;
}

void ovoid_text_write_csv(FILE *file, const char *text) {
    if (is_word(text)) {
        fputs(text, file);
        return;
    }
    const char *end = text + strlen(text);
    int is_quoted = strpbrk(text, ",;\"") || *text == ' ' || (end > text && end[-1] == ' ');
    if (is_quoted) fputc('"', file);
    if (text_is_formula(text, end)) fputc('\'', file);
    while (text < end) {
        size_t length = ovoid_text_get_visible_length(text);
        if (!length || text_read_escape(text, end) >= 0)
            fprintf(file, "\\x%02x", (unsigned)(unsigned char)*text);
        else if (*text == '"')
            fputs("\"\"", file);
        else
            fwrite(text, 1, length, file);
        text += length ? length : 1;
    }
    if (is_quoted) fputc('"', file);
}
