// The progress bar: items done, share, speed, the time so far and the remaining time, redrawn in place.
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
    size_t total, done;
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
    bar.done = 0;
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

/// "12 of 40 links, 31 s, 72 s left", with the speed where it is one a second or more.
static void draw(double seconds) {
    size_t done = bar.total && bar.done > bar.total ? bar.total : bar.done;
    double speed = seconds > 0 ? (double)done / seconds : 0;
    char of[32] = "", rate[48] = "";
    if (speed >= 1) snprintf(rate, sizeof rate, ", %.0f/s", speed);
    fputc('\r', stderr);
    if (bar.total) {
        char cells[BAR_WIDTH + 1];
        double share = (double)done / (double)bar.total;
        memset(cells, '.', BAR_WIDTH);
        memset(cells, '#', (size_t)(share * BAR_WIDTH));
        cells[BAR_WIDTH] = 0;
        fprintf(stderr, "[%s] %3.0f %%  ", cells, 100 * share);
        snprintf(of, sizeof of, " of %zu", bar.total);
    }
    fprintf(stderr, "%zu%s %s, %.0f s%s", done, of, bar.what, seconds, rate);
    if (bar.total && speed > 0) fprintf(stderr, ", %.0f s left", (double)(bar.total - done) / speed);
    fputs(" \033[K", stderr);
    fflush(stderr);
    bar.visible = 1;
}

/// Draws the bar, at most ten times a second.
static void redraw(void) {
    if (!bar.active) return;
    double now = progress_get_seconds();
    if (now - bar.drawn < 0.1) return;
    bar.drawn = now;
    draw(now - bar.start);
}

void progress_set(size_t done) {
    bar.done = done;
    redraw();
}

static int keep_drawing(void *context) {
    (void)context;
    redraw();
    return 0;
}

static int count_and_draw(void *context) {
    bar.done++;
    return keep_drawing(context);
}

ovoid_watch progress_make_watch(int counts) {
    return (ovoid_watch){.is_stopped = counts ? count_and_draw : keep_drawing};
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
