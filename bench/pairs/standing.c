// The number of cells in which ovoid is the fastest, and the others.
#include "pairs/standing.h"

#include <stdio.h>

static const char *const ways[] = {"ovoid", "prepared", "batch"};
enum { WAYS = sizeof ways / sizeof ways[0] };

/// The peer's time relative to ovoid's; 0 if one of them was not measured.
static double get_lead(const entrant *other, const entrant *own) {
    return other && own ? other->time.median / own->time.median : 0;
}

/// The goal: how many times as fast as the fastest peer this kind of query should be.
static double get_goal(const cell *c, const char *way) {
    int is_distance = c->what == QUESTION_DISTANCE;
    if (way == ways[2]) return is_distance ? 5 : 10;
    return is_distance ? 2 : 3;
}

static void print_way(const cells *all, const char *way, int right) {
    uint32_t count = 0, ahead = 0, goal = 0;
    for (uint32_t i = 0; i < all->count; i++) {
        const cell *c = &all->items[i];
        double lead = get_lead(cell_find_fastest_peer(c, all->own, right), cell_find_fastest_own(c, all->own, way));
        count += lead > 0;
        ahead += lead > 1;
        goal += lead >= get_goal(c, way);
    }
    printf("%-10s %-6s %6u %6u %6u\n", way, right ? "right" : "all", count, ahead, goal);
}

/// The faster of a pair's query and that of prepared shapes.
static const entrant *find_single(const cells *all, const cell *c) {
    const entrant *pair = cell_find_fastest_own(c, all->own, ways[0]),
                  *ready = cell_find_fastest_own(c, all->own, ways[1]);
    if (!pair || !ready) return pair ? pair : ready;
    return ready->time.median < pair->time.median ? ready : pair;
}

static void print_behind(const cells *all) {
    printf("Cells in which neither a query nor one of prepared shapes is ahead of every peer: the peer, its time over "
           "ovoid's, right peers\n");
    for (uint32_t i = 0; i < all->count; i++) {
        const cell *c = &all->items[i];
        const entrant *own = find_single(all, c), *other = cell_find_fastest_peer(c, all->own, 0);
        double lead = get_lead(other, own);
        if (!(lead > 0) || lead > 1) continue;
        printf("%-18s %5u %-8s %-9s %5.2f %5.2f\n", c->workload, c->vertices, question_get_name(c->what),
               other->who->name, lead, get_lead(cell_find_fastest_peer(c, all->own, 1), own));
    }
}

void standing_print(const cells *all) {
    printf("\nCells; of them ahead of every peer (those wrong in at most 1 %% of the cell: right); at the goal of "
           "three times "
           "the fastest, for distances twice, in batches ten and five times\n");
    printf("%-10s %-6s %6s %6s %6s\n", "", "peers", "cells", "ahead", "goal");
    for (int i = 0; i < WAYS; i++)
        for (int right = 0; right < 2; right++) print_way(all, ways[i], right);
    print_behind(all);
}
