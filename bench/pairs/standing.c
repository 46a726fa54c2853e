// Where ovoid stands among the contestants: leads, numbers of cells, and the cells in which a peer is faster.
#include "pairs/standing.h"

#include <stdio.h>
#include <string.h>

static const char *const way_names[WAY_COUNT] = {"ovoid", "prepared", "batch"};

/// The peer's time relative to ovoid's; 0 if one of them was not measured.
static double get_ratio(const entrant *other, const entrant *own) {
    return other && own ? other->time.median / own->time.median : 0;
}

double standing_get_lead(const cells *all, const cell *c, way how, int right) {
    return get_ratio(cell_find_fastest_peer(c, all->own, right), cell_find_fastest_own(c, all->own, way_names[how]));
}

double standing_get_goal(const cell *c, way how) {
    int is_distance = c->what == QUESTION_DISTANCE;
    if (how == WAY_BATCH) return is_distance ? 5 : 10;
    if (c->tracks) return 4;
    return is_distance ? 2 : 3;
}

standing standing_count(const cells *all, way how, int right) {
    standing sum = {0};
    for (uint32_t i = 0; i < all->count; i++) {
        const cell *c = &all->items[i];
        double lead = standing_get_lead(all, c, how, right);
        sum.cells += lead > 0;
        sum.ahead += lead > 1;
        sum.goal += lead >= standing_get_goal(c, how);
    }
    return sum;
}

// --- the leads

enum { COLUMNS_MOST = 16 };

/// The different numbers of vertices, in the order of the cells; 0 stands for bodies that differ.
static uint32_t find_columns(const cells *all, uint32_t *vertices) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < all->count; i++) {
        uint32_t k = 0;
        while (k < count && vertices[k] != all->items[i].vertices) k++;
        if (k == count && count < COLUMNS_MOST) vertices[count++] = all->items[i].vertices;
    }
    return count;
}

static const cell *find_cell(const cells *all, const cell *like, uint32_t vertices) {
    for (uint32_t i = 0; i < all->count; i++) {
        const cell *c = &all->items[i];
        if (c->vertices == vertices && c->what == like->what && !strcmp(c->workload, like->workload)) return c;
    }
    return NULL;
}

static void print_lead(const cells *all, const cell *c, way how) {
    double lead = c ? standing_get_lead(all, c, how, 0) : 0, right = c ? standing_get_lead(all, c, how, 1) : 0;
    if (!(lead > 0))
        printf(" %5s%8s", "-", "");
    else if (right > lead)
        printf(" %5.2f (%5.2f)", lead, right);
    else
        printf(" %5.2f%8s", lead, "");
}

/// A row for each workload and question, a column for each number of vertices.
static void print_leads(const cells *all, way how) {
    uint32_t vertices[COLUMNS_MOST], count = find_columns(all, vertices);
    printf("\nThe fastest peer's time over that of %s, by vertices (of right peers, if another):\n%-25s",
           way_names[how], "");
    for (uint32_t k = 0; k < count; k++) printf(" %5u%8s", vertices[k], "");
    printf("\n");
    for (uint32_t i = 0; i < all->count; i++) {
        const cell *c = &all->items[i];
        // A row stands where its first cell is.
        int first = 1;
        for (uint32_t k = 0; k < count; k++) {
            const cell *other = find_cell(all, c, vertices[k]);
            if (other && other < c) first = 0;
        }
        if (!first) continue;
        printf("%-16s %-8s", c->workload, question_get_name(c->what));
        for (uint32_t k = 0; k < count; k++) print_lead(all, find_cell(all, c, vertices[k]), how);
        printf("\n");
    }
}

// --- the numbers of cells

/// The faster of a pair's query and that of prepared shapes.
static const entrant *find_single(const cells *all, const cell *c) {
    const entrant *pair = cell_find_fastest_own(c, all->own, way_names[WAY_PAIR]),
                  *ready = cell_find_fastest_own(c, all->own, way_names[WAY_PREPARED]);
    if (!pair || !ready) return pair ? pair : ready;
    return ready->time.median < pair->time.median ? ready : pair;
}

static void print_behind(const cells *all) {
    printf("Cells in which neither a query nor one of prepared shapes is ahead of every peer: the peer, its time over "
           "ovoid's; the fastest right peer, its time over ovoid's\n");
    for (uint32_t i = 0; i < all->count; i++) {
        const cell *c = &all->items[i];
        const entrant *own = find_single(all, c), *other = cell_find_fastest_peer(c, all->own, 0),
                      *right = cell_find_fastest_peer(c, all->own, 1);
        double lead = get_ratio(other, own);
        if (!(lead > 0) || lead > 1) continue;
        printf("%-18s %5u %-8s %-9s %5.2f  %-9s %5.2f\n", c->workload, c->vertices, question_get_name(c->what),
               other->who->name, lead, right ? right->who->name : "-", get_ratio(right, own));
    }
}

void standing_print(const cells *all) {
    print_leads(all, WAY_PAIR);
    print_leads(all, WAY_BATCH);
    printf("\nCells; of them ahead of every peer (those wrong in at most 1 %% of the cell: right); at the goal of "
           "three times the fastest, for distances twice, in motion four times, in batches ten and five times\n");
    printf("%-10s %-6s %6s %6s %6s\n", "", "peers", "cells", "ahead", "goal");
    for (int how = 0; how < WAY_COUNT; how++)
        for (int right = 0; right < 2; right++) {
            standing sum = standing_count(all, (way)how, right);
            printf("%-10s %-6s %6u %6u %6u\n", way_names[how], right ? "right" : "all", sum.cells, sum.ahead, sum.goal);
        }
    print_behind(all);
}
