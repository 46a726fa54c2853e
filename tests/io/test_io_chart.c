// Charts: every number lands where its axis says, odd values leave gaps, the same chart gives the same bytes. The truth
// is the picture's own geometry, read back from the SVG.
#include "check.h"
#include "ovoid/io.h"

#include <stdlib.h>
#include <string.h>

static char text[1 << 20];

// The chart as text; "" where it failed.
static const char *draw(const ovoid_chart *chart) {
    FILE *file = tmpfile();
    text[0] = 0;
    if (!CHECK(file != NULL)) return text;
    ovoid_code code = ovoid_chart_write_svg(file, chart);
    if (CHECK_EQ(code, OVOID_OK)) {
        rewind(file);
        text[fread(text, 1, sizeof text - 1, file)] = 0;
    }
    fclose(file);
    return text;
}

static size_t count(const char *where, const char *what) {
    size_t found = 0;
    for (const char *at = strstr(where, what); at; at = strstr(at + 1, what)) found++;
    return found;
}

// The y of circle number i.
static double get_circle(const char *svg, size_t i) {
    const char *at = strstr(svg, "<circle");
    for (; at && i; i--) at = strstr(at + 1, "<circle");
    at = at ? strstr(at, "cy=\"") : NULL;
    return at ? atof(at + 4) : NAN;
}

static void test_places(void) {
    const double x[] = {1, 2, 3}, y[] = {0, 50, 100};
    const ovoid_series s = {NULL, OVOID_SERIES_POINTS, 3, x, y, NULL, NULL};
    ovoid_chart chart = {.series = &s, .series_count = 1};
    const char *svg = draw(&chart);
    CHECK_EQ(count(svg, "<circle"), 3);
    double bottom = get_circle(svg, 0), middle = get_circle(svg, 1), top = get_circle(svg, 2);
    CHECK_NEAR(middle, (bottom + top) / 2, 0.11);
    CHECK_LE(top, bottom - 200);
    // Decades are equally far apart.
    const double tens[] = {1, 100, 10000};
    const ovoid_series logs = {NULL, OVOID_SERIES_POINTS, 3, tens, tens, NULL, NULL};
    chart = (ovoid_chart){.series = &logs, .series_count = 1, .x_log = 1, .y_log = 1};
    svg = draw(&chart);
    CHECK_NEAR(get_circle(svg, 1), (get_circle(svg, 0) + get_circle(svg, 2)) / 2, 0.11);
    CHECK(strstr(svg, ">10000<") != NULL);
}

// Labels of the axis stay in the picture, the last one too, and do not run into each other.
static void test_axis_labels(void) {
    const double x[] = {1000, 100000}, y[] = {1, 2};
    const ovoid_series s = {NULL, OVOID_SERIES_LINE, 2, x, y, NULL, NULL};
    ovoid_chart chart = {.series = &s, .series_count = 1, .x_log = 1, .width = 480, .height = 360};
    const char *svg = draw(&chart), *last = strstr(svg, ">100000<");
    if (!CHECK(last != NULL)) return;
    while (last > svg && strncmp(last, "<text x=\"", 9) != 0) last--;
    // Six digits of 7 pixels at most, centred.
    CHECK_LE(atof(last + 9), 480 - 3.5 * 6);
}

// A band without a line where y leaves a gap, one for each run of points; of a single point a stroke.
static void test_bands(void) {
    const double y[] = {NAN, NAN, NAN, NAN, 1}, low[] = {0, 1, NAN, 2, NAN}, high[] = {1, 3, 2, 4, 2};
    const ovoid_series s = {NULL, OVOID_SERIES_LINE, 5, NULL, y, low, high};
    ovoid_chart chart = {.series = &s, .series_count = 1};
    const char *svg = draw(&chart);
    CHECK_EQ(count(svg, "fill-opacity=\"0.15\""), 1);
    CHECK_EQ(count(svg, "stroke-opacity=\"0.5\""), 1);
    CHECK_EQ(count(svg, "stroke-opacity=\"0.4\""), 1);
    CHECK_EQ(count(svg, "<circle"), 1);
    const ovoid_series bands = {NULL, OVOID_SERIES_LINE, 4, NULL, y, low, high};
    chart.series = &bands;
    svg = draw(&chart);
    CHECK_EQ(count(svg, "<path"), 2);
    CHECK_EQ(count(svg, "<circle"), 0);
}

// A tick is upright about its place, and is the key of its series.
static void test_ticks(void) {
    const double x[] = {0, 1, 2}, y[] = {1, NAN, 3};
    const ovoid_series s = {"event", OVOID_SERIES_TICKS, 3, x, y, NULL, NULL};
    const ovoid_chart chart = {.series = &s, .series_count = 1, .width = 720, .height = 400};
    const char *svg = draw(&chart);
    CHECK_EQ(count(svg, "v16\" stroke="), 3);
    CHECK_EQ(count(svg, "<circle"), 0);
    // The last one is at the right end, 18 pixels from the edge, and at the top, below one line of the legend.
    CHECK(strstr(svg, "M702.0 32.0v16") != NULL);
}

// Names of wide letters have room in the legend: an m is as wide as the type is high, in some fonts.
static void test_legend(void) {
    const double y[] = {1, 2};
    const ovoid_series s[] = {{"mmmmmmmmmm", OVOID_SERIES_LINE, 2, NULL, y, NULL, NULL},
                              {"next", OVOID_SERIES_LINE, 2, NULL, y, NULL, NULL}};
    const ovoid_chart chart = {.series = s, .series_count = 2};
    const char *svg = draw(&chart), *next = strstr(svg, ">next<");
    if (!CHECK(next != NULL)) return;
    while (next > svg && strncmp(next, "<text x=\"", 9) != 0) next--;
    // Before it the first name, from 66 + 26 on, and its own key of 26.
    CHECK_LE(66 + 26 + 12 * 10 + 26, atof(next + 9));
}

// Nothing that is not a number, and no value out of its axis, whatever comes in.
static void test_odd_values(void) {
    const double y[] = {NAN, INFINITY, -INFINITY, 0, -1, 1e300, 5};
    for (int kind = 0; kind <= OVOID_SERIES_TICKS; kind++)
        for (int logs = 0; logs < 4; logs++) {
            const ovoid_series s = {"odd", (ovoid_series_kind)kind, 7, NULL, y, y, y};
            const ovoid_chart chart = {.series = &s, .series_count = 1, .x_log = logs & 1, .y_log = logs >> 1};
            const char *svg = draw(&chart);
            CHECK(!strstr(svg, "nan") && !strstr(svg, "inf"));
            CHECK(strstr(svg, "</svg>") != NULL);
        }
    // No series, no values, equal values.
    ovoid_chart chart = {.title = "<none> & \"nothing\""};
    CHECK(strstr(draw(&chart), "&#60;none&#62; &#38;") != NULL);
    const double same[] = {7, 7};
    const ovoid_series s[] = {{"none", OVOID_SERIES_LINE, 0, NULL, same, NULL, NULL},
                              {"same", OVOID_SERIES_LINE, 2, same, same, NULL, NULL}};
    chart = (ovoid_chart){.series = s, .series_count = 2};
    CHECK(!strstr(draw(&chart), "nan"));
    // More series than colours.
    ovoid_series many[13] = {{0}};
    chart = (ovoid_chart){.series = many, .series_count = 13};
    FILE *file = tmpfile();
    ovoid_code code = ovoid_chart_write_svg(file, &chart);
    CHECK_EQ(code, OVOID_ERROR_LIMIT);
    fclose(file);
}

static void test_bars(void) {
    const double a[] = {1, 2}, b[] = {3, 1};
    const char *const names[] = {"first", "second"};
    ovoid_series s[] = {{"a", OVOID_SERIES_STACK, 2, NULL, a, NULL, NULL},
                        {"b", OVOID_SERIES_STACK, 2, NULL, b, NULL, NULL}};
    ovoid_chart chart = {.series = s, .series_count = 2, .categories = names, .category_count = 2, .y_label = "ms"};
    const char *svg = draw(&chart);
    // Background, two keys, four bars; the axis goes to the top of the highest stack.
    CHECK_EQ(count(svg, "<rect"), 7);
    CHECK(strstr(svg, ">4<") && !strstr(svg, ">5<") && strstr(svg, ">second<"));
    s[0].kind = s[1].kind = OVOID_SERIES_BARS;
    CHECK(strstr(draw(&chart), ">3<") != NULL);
    char first[4096];
    snprintf(first, sizeof first, "%.4000s", draw(&chart));
    CHECK(strncmp(first, draw(&chart), 4000) == 0);
}

static void test_full_disk(void) {
    FILE *full = fopen("/dev/full", "w");
    if (!full) {
        check_skip("no /dev/full");
        return;
    }
    static const double y[2000] = {0};
    const ovoid_series s = {NULL, OVOID_SERIES_POINTS, 2000, NULL, y, NULL, NULL};
    const ovoid_chart chart = {.series = &s, .series_count = 1};
    ovoid_code code = ovoid_chart_write_svg(full, &chart);
    CHECK_EQ(code, OVOID_ERROR_FILE);
    fclose(full);
}

int main(void) {
    test_places();
    test_axis_labels();
    test_bands();
    test_ticks();
    test_legend();
    test_odd_values();
    test_bars();
    test_full_disk();
    return check_end();
}
