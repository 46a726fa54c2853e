// Series of a chart: lines with bands and marks, bars with whiskers, stacks. Series differ by colour and by dash or
// mark, so that a print without colours can be read.
#include "io/draw/chart_series.h"

#include <math.h>

// Most points of a line with marks.
enum { MARKS_MAX = 40 };

static const char *get_dash(size_t i) {
    static const char *const dashes[] = {"", " stroke-dasharray=\"6 3\"", " stroke-dasharray=\"2 3\"",
                                         " stroke-dasharray=\"8 3 2 3\""};
    return dashes[i % 4];
}

static void draw_mark(const canvas *c, size_t i, vec2 at) {
    const char *fill = chart_get_color(i);
    switch (i % 4) {
    case 0: fprintf(c->file, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>", at.x, at.y, fill); break;
    case 1:
        fprintf(c->file, "<rect x=\"%.1f\" y=\"%.1f\" width=\"6\" height=\"6\" fill=\"%s\"/>", at.x - 3, at.y - 3,
                fill);
        break;
    case 2: fprintf(c->file, "<path d=\"M%.1f %.1fl4 7h-8z\" fill=\"%s\"/>", at.x, at.y - 4.5, fill); break;
    default: fprintf(c->file, "<path d=\"M%.1f %.1fl4 4l-4 4l-4-4z\" fill=\"%s\"/>", at.x, at.y - 4, fill); break;
    }
    fputc('\n', c->file);
}

static void draw_tick(const canvas *c, size_t i, vec2 at) {
    fprintf(c->file, "<path d=\"M%.1f %.1fv16\" stroke=\"%s\" stroke-width=\"2.5\"/>\n", at.x, at.y - 8,
            chart_get_color(i));
}

void chart_draw_key(const canvas *c, size_t i, vec2 at) {
    const ovoid_series *s = &c->chart->series[i];
    if (s->kind == OVOID_SERIES_BARS || s->kind == OVOID_SERIES_STACK) {
        fprintf(c->file, "<rect x=\"%.1f\" y=\"%.1f\" width=\"12\" height=\"10\" fill=\"%s\"/>\n", at.x - 6, at.y - 5,
                chart_get_color(i));
        return;
    }
    if (s->kind == OVOID_SERIES_TICKS) {
        draw_tick(c, i, at);
        return;
    }
    if (s->kind == OVOID_SERIES_LINE)
        fprintf(c->file, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"2\"%s/>\n",
                at.x - 11, at.y, at.x + 11, at.y, chart_get_color(i), get_dash(i));
    if (s->kind == OVOID_SERIES_POINTS || s->count <= MARKS_MAX) draw_mark(c, i, at);
}

static vec2 project(const canvas *c, const ovoid_series *s, size_t k, const double *values) {
    return (vec2){axis_project(&c->x, series_get_x(s, k)), axis_project(&c->y, values[k])};
}

static int is_visible(vec2 p) { return isfinite(p.x) && isfinite(p.y); }

// Draws each run of points without a gap.
static void draw_line(const canvas *c, size_t i) {
    const ovoid_series *s = &c->chart->series[i];
    svg_path path = {.file = c->file};
    size_t first = 0;
    while (first < s->count && !is_visible(project(c, s, first, s->y))) first++;
    if (first == s->count) return;
    fputs("<path d=\"", c->file);
    for (size_t k = first, open = 0; k < s->count; k++) {
        vec2 p = project(c, s, k, s->y);
        if (is_visible(p)) (open ? svg_line : svg_move)(&path, p);
        open = is_visible(p);
    }
    fprintf(c->file, "\" fill=\"none\" stroke=\"%s\" stroke-width=\"2\" stroke-linejoin=\"round\"%s/>\n",
            chart_get_color(i), get_dash(i));
}

static int has_band(const canvas *c, const ovoid_series *s, size_t k) {
    return is_visible(project(c, s, k, s->low)) && is_visible(project(c, s, k, s->high));
}

// The band from low to high over the points [begin, end), as one polygon; of one point a stroke.
static void draw_run(const canvas *c, size_t i, size_t begin, size_t end) {
    const ovoid_series *s = &c->chart->series[i];
    svg_path path = {.file = c->file};
    fputs("<path d=\"", c->file);
    svg_move(&path, project(c, s, begin, s->high));
    for (size_t k = begin + 1; k < end; k++) svg_line(&path, project(c, s, k, s->high));
    for (size_t k = end; k-- > begin;) svg_line(&path, project(c, s, k, s->low));
    if (end - begin > 1)
        // The rim keeps a band visible that is thinner than a pixel.
        fprintf(c->file, "\" fill=\"%s\" fill-opacity=\"0.15\" stroke=\"%s\" stroke-opacity=\"0.5\"/>\n",
                chart_get_color(i), chart_get_color(i));
    else
        fprintf(c->file, "\" stroke=\"%s\" stroke-opacity=\"0.4\" stroke-width=\"4\"/>\n", chart_get_color(i));
}

// The band of each run of points without a gap.
static void draw_band(const canvas *c, size_t i) {
    const ovoid_series *s = &c->chart->series[i];
    for (size_t begin = 0, end; begin < s->count; begin = end + 1) {
        end = begin;
        while (end < s->count && has_band(c, s, end)) end++;
        if (end > begin) draw_run(c, i, begin, end);
    }
}

// The number of columns side by side at a place: all bars, and the stack.
static size_t count_columns(const ovoid_chart *chart, size_t until) {
    size_t count = 0, stacks = 0;
    for (size_t i = 0; i < until; i++) {
        count += chart->series[i].kind == OVOID_SERIES_BARS;
        stacks |= chart->series[i].kind == OVOID_SERIES_STACK;
    }
    return count + stacks;
}

// The height of the stack below series i at place k.
static double get_base(const ovoid_chart *chart, size_t i, size_t k) {
    double sum = 0;
    for (size_t n = 0; n < i; n++) {
        const ovoid_series *s = &chart->series[n];
        if (s->kind == OVOID_SERIES_STACK && k < s->count && isfinite(s->y[k])) sum += s->y[k];
    }
    return sum;
}

static void draw_bars(const canvas *c, size_t i) {
    const ovoid_chart *chart = c->chart;
    const ovoid_series *s = &chart->series[i];
    int stacked = s->kind == OVOID_SERIES_STACK;
    size_t columns = count_columns(chart, chart->series_count), column = count_columns(chart, stacked ? 0 : i);
    double room = 0.8 / (double)columns;
    for (size_t k = 0; k < s->count; k++) {
        double base = stacked       ? get_base(chart, i, k)
                      : c->y.is_log ? c->y.low
                                    : 0,
               top = stacked ? base + s->y[k] : s->y[k];
        double left = series_get_x(s, k) - 0.4 + room * (double)column;
        vec2 a = {axis_project(&c->x, left), axis_project(&c->y, base)};
        vec2 b = {axis_project(&c->x, left + room), axis_project(&c->y, top)};
        if (!is_visible(a) || !is_visible(b)) continue;
        fprintf(c->file, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>\n", a.x + 0.5,
                fmin(a.y, b.y), fmax(b.x - a.x - 1, 0.5), fabs(b.y - a.y), chart_get_color(i));
        if (!s->low || !s->high) continue;
        double low = axis_project(&c->y, s->low[k]), high = axis_project(&c->y, s->high[k]), x = (a.x + b.x) / 2;
        if (isfinite(low) && isfinite(high))
            fprintf(c->file, "<path d=\"M%.1f %.1fV%.1fm-3 0h6\" fill=\"none\" stroke=\"#333\"/>\n", x, low, high);
    }
}

void chart_draw_series(const canvas *c) {
    for (size_t i = 0; i < c->chart->series_count; i++) {
        const ovoid_series *s = &c->chart->series[i];
        if (s->kind == OVOID_SERIES_BARS || s->kind == OVOID_SERIES_STACK) {
            draw_bars(c, i);
            continue;
        }
        if (s->low && s->high) draw_band(c, i);
        if (s->kind == OVOID_SERIES_LINE) draw_line(c, i);
        if (s->kind == OVOID_SERIES_LINE && s->count > MARKS_MAX) continue;
        for (size_t k = 0; k < s->count; k++) {
            vec2 p = project(c, s, k, s->y);
            if (is_visible(p)) (s->kind == OVOID_SERIES_TICKS ? draw_tick : draw_mark)(c, i, p);
        }
    }
}
