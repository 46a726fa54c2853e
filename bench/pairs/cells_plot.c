// The results over random hulls as a picture: a chart for each question and placement, with ovoid, the fastest peer of
// each cell, and the fastest peer whose answers there are right. Bands: quartiles.
#include "common/build.h"
#include "common/sheet.h"
#include "pairs/cells.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINES = 3, POINTS = 16, PANELS = 16 };
static const char *const line_names[LINES] = {"ovoid", "fastest peer", "fastest right peer"};

typedef struct panel {
    char title[64];
    size_t counts[LINES];
    double x[LINES][POINTS], y[LINES][POINTS], low[LINES][POINTS], high[LINES][POINTS];
    ovoid_series series[LINES];
} panel;

static void add_point(panel *p, int line, uint32_t vertices, const entrant *e) {
    if (!e || p->counts[line] == POINTS) return;
    size_t k = p->counts[line]++;
    p->x[line][k] = vertices;
    p->y[line][k] = e->time.median;
    p->low[line][k] = e->time.low;
    p->high[line][k] = e->time.high;
}

/// The panel of that title; a new one if it is new; NULL if there is no room.
static panel *get_panel(panel *panels, uint32_t *count, const char *title) {
    for (uint32_t i = 0; i < *count; i++)
        if (!strcmp(panels[i].title, title)) return &panels[i];
    if (*count == PANELS) return NULL;
    panel *p = &panels[(*count)++];
    (void)snprintf(p->title, sizeof p->title, "%s", title);
    return p;
}

static void add_cell(panel *panels, uint32_t *count, const cell *c, uint32_t own) {
    char title[64];
    (void)snprintf(title, sizeof title, "%s, %s", question_get_name(c->what), c->workload + strlen("hulls "));
    panel *p = get_panel(panels, count, title);
    if (!p) return;
    add_point(p, 0, c->vertices, cell_find_fastest_own(c, own, "ovoid"));
    add_point(p, 1, c->vertices, cell_find_fastest_peer(c, own, 0));
    add_point(p, 2, c->vertices, cell_find_fastest_peer(c, own, 1));
}

static ovoid_chart make_chart(panel *p) {
    for (int k = 0; k < LINES; k++)
        p->series[k] =
            (ovoid_series){line_names[k], OVOID_SERIES_LINE, p->counts[k], p->x[k], p->y[k], p->low[k], p->high[k]};
    return (ovoid_chart){.title = p->title,
                         .x_label = "vertices",
                         .y_label = "ns",
                         .series = p->series,
                         .series_count = LINES,
                         .x_log = 1,
                         .y_log = 1,
                         .width = 400,
                         .height = 300};
}

int cells_write_svg(const cells *all, const char *path) {
    panel *panels = calloc(PANELS, sizeof *panels);
    if (!panels) return 0;
    uint32_t count = 0;
    for (int what = 0; what < QUESTION_COUNT; what++)
        for (uint32_t i = 0; i < all->count; i++)
            if (all->items[i].what == (question)what && what != QUESTION_WITHIN &&
                !strncmp(all->items[i].workload, "hulls ", 6))
                add_cell(panels, &count, &all->items[i], all->own);
    ovoid_chart charts[PANELS];
    for (uint32_t i = 0; i < count; i++) charts[i] = make_chart(&panels[i]);
    int good = sheet_write(path, charts, count, 4, get_build());
    free(panels);
    return good;
}
