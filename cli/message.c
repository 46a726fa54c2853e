// Messages on stderr. Red marks an error where the terminal can (https://no-color.org is respected).
#include "message.h"

#include "progress.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int message_is_terminal(FILE *stream) { return isatty(fileno(stream)); }

int message_is_colored(FILE *stream) {
    const char *no_color = getenv("NO_COLOR"), *term = getenv("TERM");
    if (no_color && *no_color) return 0;
    return message_is_terminal(stream) && term && strcmp(term, "dumb") != 0;
}

/// The length of the character at c in UTF-8 that can be shown as it is; 0 for one that may control a terminal (C0,
/// DEL, and C1 in its two bytes), and for a byte that begins none.
static int get_visible_length(const unsigned char *c) {
    if (c[0] < 0x80) return c[0] >= 0x20 && c[0] != 0x7f;
    int length = c[0] >= 0xc2 && c[0] < 0xe0   ? 2
                 : c[0] >= 0xe0 && c[0] < 0xf0 ? 3
                 : c[0] >= 0xf0 && c[0] < 0xf5 ? 4
                                               : 0;
    for (int i = 1; i < length; i++)
        if ((c[i] & 0xc0) != 0x80) return 0;
    return c[0] == 0xc2 && c[1] < 0xa0 ? 0 : length;
}

/// Writes the character at the text's beginning as it is shown; returns its length in the text.
static int show(const char *text, char shown[5]) {
    int length = get_visible_length((const unsigned char *)text);
    if (length)
        memcpy(shown, text, (size_t)length), shown[length] = 0;
    else
        snprintf(shown, 5, "\\x%02x", (unsigned)(unsigned char)*text);
    return length ? length : 1;
}

void message_write_text(FILE *file, const char *text) {
    char shown[5];
    while (*text) {
        text += show(text, shown);
        fputs(shown, file);
    }
}

static void say(const char *mark, const char *format, va_list list) {
    char text[1024], shown[4 * sizeof text], *end = shown;
    vsnprintf(text, sizeof text, format, list);
    for (const char *c = text; *c; end += strlen(end)) c += show(c, end);
    *end = 0;
    progress_hide();
    fprintf(stderr, "ovoid: %s%s\n", mark, shown); // at once: lines of several processes stay whole
}

void message_error(const char *format, ...) {
    va_list list;
    va_start(list, format);
    say(message_is_colored(stderr) ? "\033[31merror:\033[0m " : "error: ", format, list);
    va_end(list);
}

void message_warning(const char *format, ...) {
    va_list list;
    va_start(list, format);
    say(message_is_colored(stderr) ? "\033[33mwarning:\033[0m " : "warning: ", format, list);
    va_end(list);
}

void message_note(const char *format, ...) {
    va_list list;
    va_start(list, format);
    say("", format, list);
    va_end(list);
}
