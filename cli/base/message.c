// Messages on stderr. Errors are marked in red if the terminal can show it (https://no-color.org is respected).
#include "base/message.h"

#include "base/progress.h"

#include <ovoid/io.h>

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

/// Writes the character at the text's beginning as it is shown; returns its length in the text.
static size_t show(const char *text, char shown[5]) {
    size_t length = ovoid_text_get_visible_length(text);
    if (length)
        memcpy(shown, text, length), shown[length] = 0;
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
    fprintf(stderr, "ovoid: %s%s\n", mark, shown); // one write, so that lines of several processes stay whole
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
