// Charts: axes with round numbers, grid, labels and legend; chart_series.c draws the series. Plain SVG, no script,
// readable on screen and on paper.
#include "io/draw/chart_series.h"
#include "io/locale.h"

#include <math.h>
#include <string.h>

enum { LEFT = 66, RIGHT = 18, TOP = 22, BOTTOM = 44, LEGEND_LINE = 18 };

// The range of the values, opened to round numbers; bars start at zero.
typedef struct range {
    double low, high;
} range;

static void take(range *r, double value, int is_log) {
    if (!isfinite(value) || (is_log && value <= 0)) return;
    r->low = fmin(r->low, value);
    r->high = fmax(r->high, value);
}

static int is_bar(const ovoid_series *s) { return s->kind == OVOID_SERIES_BARS || s->kind == OVOID_SERIES_STACK; }

static double get_stack(const ovoid_chart *c, size_t at) {
    double sum = 0;
    for (size_t i = 0; i < c->series_count; i++) {
        const ovoid_series *s = &c->series[i];
        if (s->kind == OVOID_SERIES_STACK && at < s->count && isfinite(s->y[at])) sum += s->y[at];
    }
    return sum;
}

static range find_y_range(const ovoid_chart *c) {
    range r = {INFINITY, -INFINITY};
    for (size_t i = 0; i < c->series_count; i++) {
        const ovoid_series *s = &c->series[i];
        if (is_bar(s) && !c->y_log) take(&r, 0, 0);
        for (size_t k = 0; k < s->count; k++) {
            take(&r, s->kind == OVOID_SERIES_STACK ? get_stack(c, k) : s->y[k], c->y_log);
            if (s->low) take(&r, s->low[k], c->y_log);
            if (s->high) take(&r, s->high[k], c->y_log);
        }
    }
    if (c->y_max > c->y_min) r = (range){c->y_min, c->y_max};
    return r;
}

static range find_x_range(const ovoid_chart *c) {
    range r = {INFINITY, -INFINITY};
    if (c->categories) return (range){-0.5, (double)c->category_count - 0.5};
    for (size_t i = 0; i < c->series_count; i++)
        for (size_t k = 0; k < c->series[i].count; k++) {
            double x = series_get_x(&c->series[i], k), half = is_bar(&c->series[i]) ? 0.5 : 0;
            take(&r, x - half, c->x_log);
            take(&r, x + half, c->x_log);
        }
    return r;
}

// The pixels of an axis.
typedef struct pixels {
    double from, to;
} pixels;

// The axis of a range; its length is never 0. `open`: the axis ends at a round number.
static axis make_axis(range r, int is_log, int open, pixels p) {
    if (!(r.low <= r.high)) r = is_log ? (range){1, 10} : (range){0, 1};
    if (is_log) {
        if (!(r.high > r.low * 1.0001)) r = (range){r.low / 2, r.high * 2};
        if (open) {
            double low = pow(10, floor(log10(r.low) + 1e-9)), high = pow(10, ceil(log10(r.high) - 1e-9));
            r = high / low > 2000 ? (range){low, high} : (range){r.low / 1.2, r.high * 1.2};
        }
        return (axis){r.low, r.high, p.from, p.to, 1};
    }
    if (!(r.high > r.low)) r = (range){r.low - fmax(0.5, 0.5 * fabs(r.low)), r.high + fmax(0.5, 0.5 * fabs(r.high))};
    if (open) {
        double step = axis_find_step(r.high - r.low, fabs(p.to - p.from));
        r = (range){step * floor(r.low / step + 1e-9), step * ceil(r.high / step - 1e-9)};
    }
    return (axis){r.low, r.high, p.from, p.to, 0};
}

// ---- texts

// Where a text stands, and its attributes beside the anchor.
typedef struct text_place {
    double x, y;
    const char *anchor, *extra;
} text_place;

static void write_text(FILE *file, text_place at, const char *text) {
    fprintf(file, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\"%s>", at.x, at.y, at.anchor, at.extra);
    svg_escape(file, text);
    fputs("</text>\n", file);
}

// The label of a tick: as short as it can be, large and small numbers with an exponent.
static void format_tick(double value, int is_log, char out[32]) {
    if (!is_log && fabs(value) < 1e-12) value = 0;
    double size = fabs(value);
    if (size >= 1e6 || (size > 0 && size < 1e-4))
        snprintf(out, 32, "%.0e", value);
    else
        snprintf(out, 32, "%.6g", value);
    // "1e-05" is written 1e-5.
    char *e = strchr(out, 'e');
    if (!e) return;
    char *digits = e + 2;
    while (*digits == '0' && digits[1]) digits++;
    char *to = e[1] == '-' ? e + 2 : e + 1;
    memmove(to, digits, strlen(digits) + 1);
}

static void draw_y_axis(const canvas *c) {
    double ticks[TICKS_MAX];
    size_t count = axis_find_ticks(&c->y, ticks);
    for (size_t i = 0; i < count; i++) {
        double y = axis_project(&c->y, ticks[i]);
        char text[32];
        format_tick(ticks[i], c->y.is_log, text);
        fprintf(c->file, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#e3e3e3\"/>\n", c->x.from, y,
                c->x.to, y);
        write_text(c->file, (text_place){c->x.from - 6, y + 4, "end", ""}, text);
    }
    if (!c->chart->y_label) return;
    char turn[96];
    snprintf(turn, sizeof turn, " transform=\"rotate(-90 15 %.1f)\"", (c->y.from + c->y.to) / 2);
    write_text(c->file, (text_place){15, (c->y.from + c->y.to) / 2, "middle", turn}, c->chart->y_label);
}

// Of labels that would overlap, only every n-th is drawn.
static void draw_categories(const canvas *c) {
    const ovoid_chart *chart = c->chart;
    size_t longest = 1;
    for (size_t i = 0; i < chart->category_count; i++) {
        size_t length = strlen(chart->categories[i]);
        if (length > longest) longest = length;
    }
    double room = fabs(c->x.to - c->x.from) / (double)chart->category_count;
    size_t each = (size_t)ceil(6.6 * (double)(longest + 1) / room);
    for (size_t i = 0; i < chart->category_count; i += each ? each : 1)
        write_text(c->file, (text_place){axis_project(&c->x, (double)i), c->y.from + 17, "middle", ""},
                   chart->categories[i]);
}

// A label under its tick; at the ends of the axis it is moved into the picture, and left out where it would run into
// the one before it, which ends at *end.
static void write_x_label(const canvas *c, double x, const char *text, double *end) {
    double half = 3.5 * (double)strlen(text), middle = fmin(x, c->x.to + RIGHT - 2 - half);
    if (middle - half < *end + 4) return;
    write_text(c->file, (text_place){middle, c->y.from + 17, "middle", ""}, text);
    *end = middle + half;
}

static void draw_x_axis(const canvas *c) {
    double ticks[TICKS_MAX], end = 0;
    size_t count = c->chart->categories ? 0 : axis_find_ticks(&c->x, ticks);
    for (size_t i = 0; i < count; i++) {
        double x = axis_project(&c->x, ticks[i]);
        char text[32];
        format_tick(ticks[i], c->x.is_log, text);
        fprintf(c->file, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#999\"/>\n", x, c->y.from, x,
                c->y.from + 4);
        write_x_label(c, x, text, &end);
    }
    if (c->chart->categories) draw_categories(c);
    fprintf(c->file, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#999\"/>\n", c->x.from, c->y.from,
            c->x.to, c->y.from);
    if (c->chart->x_label)
        write_text(c->file, (text_place){(c->x.from + c->x.to) / 2, c->y.from + 36, "middle", ""}, c->chart->x_label);
}

// ---- the legend: above the area, in as many lines as it needs

// Pixels that an entry takes: its key, its name and the room to the next.
static double get_entry_width(const char *name) { return 26 + text_get_width(name, 12) + 10; }

static double draw_legend(const canvas *c, double top, double width, int is_drawn) {
    double x = LEFT, y = top;
    size_t named = 0;
    for (size_t i = 0; i < c->chart->series_count; i++) {
        const char *name = c->chart->series[i].name;
        if (!name) continue;
        if (named++ && x + get_entry_width(name) > width - RIGHT) x = LEFT, y += LEGEND_LINE;
        if (is_drawn) {
            chart_draw_key(c, i, (vec2){x + 11, y - 4});
            write_text(c->file, (text_place){x + 26, y, "start", ""}, name);
        }
        x += get_entry_width(name);
    }
    return named ? y + LEGEND_LINE : top;
}

static ovoid_code write_chart(FILE *file, const ovoid_chart *chart) {
    double width = chart->width ? chart->width : 720, height = chart->height ? chart->height : 400;
    canvas c = {.file = file, .chart = chart};
    double head = TOP + (chart->title ? 20 : 0), top = draw_legend(&c, head, width, 0);
    c.x = make_axis(find_x_range(chart), chart->x_log, 0, (pixels){LEFT, width - RIGHT});
    c.y = make_axis(find_y_range(chart), chart->y_log, !(chart->y_max > chart->y_min), (pixels){height - BOTTOM, top});
    fprintf(file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" height=\"%.0f\" "
            "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\" fill=\"#333\">\n",
            width, height, width, height);
    fputs("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n", file);
    if (chart->title)
        write_text(file, (text_place){LEFT, TOP, "start", " font-size=\"14\" font-weight=\"bold\""}, chart->title);
    (void)draw_legend(&c, head, width, 1);
    draw_y_axis(&c);
    chart_draw_series(&c);
    draw_x_axis(&c);
    fputs("</svg>\n", file);
    return ferror(file) ? OVOID_ERROR_FILE : OVOID_OK;
}

ovoid_code ovoid_chart_write_svg(FILE *file, const ovoid_chart *chart) {
    if (chart->series_count > SERIES_MAX) return OVOID_ERROR_LIMIT;
    locale_scope locale = locale_enter();
    ovoid_code code = write_chart(file, chart);
    locale_leave(locale);
    return code;
}
