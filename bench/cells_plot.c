// The results over random hulls as a picture: a panel for each question and placement, ovoid beside the fastest peer of
// each cell, and beside the fastest whose answers there are right.
#include "cells.h"
#include "plot.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void add_cell(panel *p, const cell *c, uint32_t own) {
    const entrant *best = cell_find_fastest_own(c, own);
    if (best) panel_add_point(p, 0, c->vertices, best->time.median);
    for (int right = 0; right < 2; right++) {
        const entrant *other = cell_find_fastest_peer(c, own, right);
        if (other) panel_add_point(p, 1 + (uint32_t)right, c->vertices, other->time.median);
    }
}

/// The panel of that title; a new one where there is none; NULL where there is no room.
static panel *get_panel(panel *panels, uint32_t *count, const char *title) {
    for (uint32_t i = 0; i < *count; i++)
        if (!strcmp(panels[i].title, title)) return &panels[i];
    if (*count == PANELS_MOST) return NULL;
    panel *p = &panels[(*count)++];
    (void)snprintf(p->title, sizeof p->title, "%s", title);
    (void)snprintf(p->x_name, sizeof p->x_name, "vertices");
    (void)snprintf(p->y_name, sizeof p->y_name, "ns");
    static const char *const names[] = {"ovoid", "fastest peer", "fastest right peer"};
    for (int i = 0; i < 3; i++) (void)snprintf(p->lines[i].name, sizeof p->lines[i].name, "%s", names[i]);
    return p;
}

int cells_write_svg(const cells *all, const char *path) {
    panel *panels = calloc(PANELS_MOST, sizeof *panels);
    if (!panels) return 0;
    uint32_t count = 0;
    for (int what = 0; what < QUESTION_COUNT; what++)
        for (uint32_t i = 0; i < all->count; i++) {
            const cell *c = &all->items[i];
            if (c->what != (question)what || what == QUESTION_WITHIN || strncmp(c->workload, "hulls", 5) != 0) continue;
            char title[64];
            (void)snprintf(title, sizeof title, "%s, %s", question_get_name(c->what), c->workload + 6);
            panel *p = get_panel(panels, &count, title);
            if (p) add_cell(p, c, all->own);
        }
    int good = plot_write(path, panels, count, 4, get_build());
    free(panels);
    return good;
}
