// Measured curves as lines of text, CSV and a sheet of charts, all axes logarithmic.
#include "common/rows.h"

#include "common/build.h"
#include "common/sheet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void rows_add(rows *all, row one) {
    if (all->count == ROWS_MOST) return;
    const row *last = all->count ? &all->items[all->count - 1] : NULL;
    if (!last || strcmp(last->chart, one.chart) != 0)
        printf("\n%s\n%12s  %-24s %12s %12s %12s %12s\n", one.chart, one.x_name, "", one.y_name, "quartile 1",
               "quartile 3", "mean");
    printf("%12.0f  %-24s %12.6g %12.6g %12.6g %12.6g", one.x, one.line, one.y.median, one.y.low, one.y.high,
           one.y.mean);
    if (one.judged > 0) printf("   wrong %.0f of %.0f", one.wrong, one.judged);
    printf("\n");
    (void)fflush(stdout);
    all->items[all->count++] = one;
}

int rows_write_csv(const rows *all, const char *path) {
    FILE *file = fopen(path, "w");
    if (!file) return 0;
    (void)fprintf(file, "# %s\nchart,line,x_name,x,y_name,median,quartile1,quartile3,minimum,mean,judged,wrong\n",
                  get_build());
    for (uint32_t i = 0; i < all->count; i++) {
        const row *r = &all->items[i];
        (void)fprintf(file, "\"%s\",\"%s\",%s,%.0f,%s,%.6g,%.6g,%.6g,%.6g,%.6g,%.0f,%.0f\n", r->chart, r->line,
                      r->x_name, r->x, r->y_name, r->y.median, r->y.low, r->y.high, r->y.least, r->y.mean, r->judged,
                      r->wrong);
    }
    return fclose(file) == 0;
}

enum { LINES = 12, POINTS = 24, CHARTS = 12 };

typedef struct curve {
    size_t count;
    double x[POINTS], y[POINTS], low[POINTS], high[POINTS];
} curve;

typedef struct page {
    curve curves[CHARTS][LINES];
    ovoid_series series[CHARTS][LINES];
    ovoid_chart charts[CHARTS];
    char places[CHARTS][40];
    const char *categories[CHARTS];
    uint32_t count;
} page;

/// The number of the chart of that name, made if it is new.
static uint32_t get_chart(page *p, const row *r) {
    for (uint32_t i = 0; i < p->count; i++)
        if (!strcmp(p->charts[i].title, r->chart)) return i;
    p->charts[p->count] = (ovoid_chart){.title = r->chart,
                                        .x_label = r->x_name,
                                        .y_label = r->y_name,
                                        .series = p->series[p->count],
                                        .x_log = 1,
                                        .y_log = 1,
                                        .width = 480,
                                        .height = 360};
    return p->count++;
}

static size_t get_line(page *p, uint32_t chart, const row *r) {
    ovoid_chart *c = &p->charts[chart];
    for (size_t k = 0; k < c->series_count; k++)
        if (!strcmp(p->series[chart][k].name, r->line)) return k;
    curve *v = &p->curves[chart][c->series_count];
    p->series[chart][c->series_count] =
        (ovoid_series){.name = r->line, .x = v->x, .y = v->y, .low = v->low, .high = v->high};
    return c->series_count++;
}

static void add_to_page(page *p, const row *r) {
    uint32_t chart = get_chart(p, r);
    size_t line = get_line(p, chart, r), k = p->curves[chart][line].count;
    if (k == POINTS) return;
    curve *v = &p->curves[chart][line];
    v->x[k] = r->x;
    v->y[k] = r->y.median;
    v->low[k] = r->y.low;
    v->high[k] = r->y.high;
    p->series[chart][line].count = ++v->count;
    // Whole decades, so that flat curves look flat.
    ovoid_chart *c = &p->charts[chart];
    double low = pow(10, floor(log10(r->y.low))), high = pow(10, ceil(log10(r->y.high)));
    c->y_min = c->y_min > 0 ? fmin(c->y_min, low) : low;
    c->y_max = fmax(c->y_max, high);
}

/// Draws a chart whose lines are points at one place as bars side by side.
static void make_bars(page *p, uint32_t chart) {
    ovoid_chart *c = &p->charts[chart];
    double first = p->curves[chart][0].x[0];
    for (size_t k = 0; k < c->series_count; k++)
        for (size_t i = 0; i < p->curves[chart][k].count; i++)
            if (p->curves[chart][k].x[i] != first) return;
    for (size_t k = 0; k < c->series_count; k++)
        p->series[chart][k].kind = OVOID_SERIES_BARS, p->series[chart][k].x = NULL;
    (void)snprintf(p->places[chart], sizeof p->places[chart], "%g %s", first, c->x_label);
    p->categories[chart] = p->places[chart];
    c->categories = &p->categories[chart];
    c->category_count = 1;
    c->x_label = NULL;
    c->x_log = 0;
}

int rows_write_svg(const rows *all, const char *path) {
    page *p = calloc(1, sizeof *p);
    if (!p) return 0;
    for (uint32_t i = 0; i < all->count; i++) add_to_page(p, &all->items[i]);
    for (uint32_t i = 0; i < p->count; i++) make_bars(p, i);
    int good = sheet_write(path, p->charts, p->count, 3, get_build());
    free(p);
    return good;
}
