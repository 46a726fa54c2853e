// The progress bar: items done, share, speed and the remaining time, redrawn in place.
#include "base/progress.h"

#include "base/message.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/// Cells of the bar.
#define BAR_WIDTH 28

/// The size of a file that takes a second or more to read and to make into a body.
#define LARGE_FILE (32 << 20)

/// The only bar; only the main thread uses it.
static struct {
    const char *what;
    size_t total;
    double start, drawn;
    int active, visible;
} bar;

double progress_get_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void progress_start(const char *what, size_t total) {
    bar.what = what;
    bar.total = total;
    bar.start = bar.drawn = progress_get_seconds();
    bar.active = isatty(fileno(stderr));
}

void progress_read(const char *path) {
    struct stat status;
    if (!isatty(fileno(stderr)) || stat(path, &status) != 0 || status.st_size < LARGE_FILE) return;
    char words[300];
    snprintf(words, sizeof words, "%.200s, %.0f MB: read, and made ready ...", path, 1e-6 * (double)status.st_size);
    fputc('\r', stderr);
    message_write_text(stderr, words);
    fputs("\033[K", stderr);
    fflush(stderr);
    bar.visible = 1;
}

static void draw(size_t done, double seconds) {
    double speed = seconds > 0 ? (double)done / seconds : 0;
    if (bar.total) {
        char cells[BAR_WIDTH + 1];
        double share = done < bar.total ? (double)done / (double)bar.total : 1;
        size_t full = (size_t)(share * BAR_WIDTH);
        memset(cells, '.', BAR_WIDTH);
        memset(cells, '#', full);
        cells[BAR_WIDTH] = 0;
        fprintf(stderr, "\r[%s] %3.0f %%  %zu %s, %.0f/s, %.0f s left \033[K", cells, 100 * share, done, bar.what,
                speed, speed > 0 ? (double)(bar.total - (done < bar.total ? done : bar.total)) / speed : 0);
    } else
        fprintf(stderr, "\r%zu %s, %.0f/s \033[K", done, bar.what, speed);
    fflush(stderr);
    bar.visible = 1;
}

void progress_set(size_t done) {
    if (!bar.active) return;
    double now = progress_get_seconds();
    if (now - bar.drawn < 0.1) return;
    bar.drawn = now;
    draw(done, now - bar.start);
}

void progress_hide(void) {
    if (!bar.visible) return;
    fputs("\r\033[K", stderr);
    bar.visible = 0;
}

void progress_end(void) {
    progress_hide();
    bar.active = 0;
}
