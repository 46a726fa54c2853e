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

static void say(const char *mark, const char *format, va_list list) {
    char text[1024];
    vsnprintf(text, sizeof text, format, list);
    progress_hide();
    fprintf(stderr, "ovoid: %s%s\n", mark, text);
}

void message_error(const char *format, ...) {
    va_list list;
    va_start(list, format);
    say(message_is_colored(stderr) ? "\033[31merror:\033[0m " : "error: ", format, list);
    va_end(list);
}

void message_note(const char *format, ...) {
    va_list list;
    va_start(list, format);
    say("", format, list);
    va_end(list);
}
