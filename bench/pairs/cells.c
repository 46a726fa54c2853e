// Results as a table and as CSV.
#include "pairs/cells.h"

#include "common/build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int cells_add(cells *all, const cell *one) {
    if (all->count == all->room) {
        uint32_t room = all->room ? 2 * all->room : 64;
        cell *items = realloc(all->items, room * sizeof *items);
        if (!items) return 0;
        all->items = items;
        all->room = room;
    }
    all->items[all->count++] = *one;
    return 1;
}

void cells_destroy(cells *all) {
    free(all->items);
    all->items = NULL;
}

const char *question_get_name(question what) {
    static const char *const names[QUESTION_COUNT] = {"collide", "within", "distance", "depth"};
    return names[what];
}

/// 1 if wrong in more than 1 % of its answers.
static int is_wrong(const entrant *e) { return 100 * faults_get_wrong(&e->wrong) > e->wrong.asked; }

const entrant *cell_find_fastest_peer(const cell *c, uint32_t own, int right) {
    const entrant *best = NULL;
    for (uint32_t i = own; i < c->count; i++) {
        const entrant *e = &c->entrants[i];
        if (e->time.median > 0 && !(right && is_wrong(e)) && (!best || e->time.median < best->time.median)) best = e;
    }
    return best;
}

const entrant *cell_find_fastest_own(const cell *c, uint32_t own, const char *name) {
    const entrant *best = NULL;
    for (uint32_t i = 0; i < own && i < c->count; i++) {
        const entrant *e = &c->entrants[i];
        if (strcmp(e->who->name, name) != 0 || !(e->time.median > 0)) continue;
        if (!best || e->time.median < best->time.median) best = e;
    }
    return best;
}

static const char *get_entrant_name(const entrant *e) {
    static char name[32];
    (void)snprintf(name, sizeof name, "%s%s", e->who->name, e->warm ? "+" : "");
    return name;
}

void cells_print_head(const cell *c) {
    printf("\n%-16s %5s %-8s", "", "n", "question");
    for (uint32_t i = 0; i < c->count; i++) printf(" %9s", get_entrant_name(&c->entrants[i]));
    printf("  %-23s  %s\n", "fastest peer / us, batch", "fastest right peer");
}

/// The peer's time relative to ovoid's calls and to its batches.
static void print_ratio(const cell *c, uint32_t own, const entrant *other) {
    const entrant *single = cell_find_fastest_own(c, own, "ovoid"), *batch = cell_find_fastest_own(c, own, "batch");
    if (!other || !single || !batch)
        printf("  %-23s", "-");
    else
        printf("  %-9s %6.2f %6.2f", get_entrant_name(other), other->time.median / single->time.median,
               other->time.median / batch->time.median);
}

void cells_print_row(const cell *c, uint32_t own) {
    printf("%-16s %5u %-8s", c->workload, c->vertices, question_get_name(c->what));
    for (uint32_t i = 0; i < c->count; i++) {
        const entrant *e = &c->entrants[i];
        char mark = faults_get_wrong(&e->wrong) == 0 ? ' ' : is_wrong(e) ? '!' : '*';
        if (e->time.median > 0)
            printf(" %8.0f%c", e->time.median, mark);
        else
            printf(" %9s", "-");
    }
    print_ratio(c, own, cell_find_fastest_peer(c, own, 0));
    print_ratio(c, own, cell_find_fastest_peer(c, own, 1));
    printf("\n");
    (void)fflush(stdout);
}

static void add_faults(faults *sum, const faults *f) {
    sum->asked += f->asked;
    sum->none += f->none;
    sum->sign += f->sign;
    sum->off += f->off;
    sum->off_fine += f->off_fine;
    sum->points += f->points;
}

/// The sums of one contestant, cold and warm together; one line for each of its queries.
static void print_faults_of(const cells *all, const peer *who) {
    for (int what = 0; what < QUESTION_COUNT; what++) {
        faults sum = {0};
        for (uint32_t i = 0; i < all->count; i++)
            for (uint32_t k = 0; k < all->items[i].count; k++)
                if (all->items[i].what == (question)what && all->items[i].entrants[k].who == who)
                    add_faults(&sum, &all->items[i].entrants[k].wrong);
        if (sum.asked)
            printf("%-10s %-6s %-8s %9u %8u %8u %8u %8u %8u\n", who->name, who->is_float ? "float" : "",
                   question_get_name((question)what), sum.asked, sum.none, sum.sign, sum.off, sum.off_fine, sum.points);
    }
}

void cells_print_faults(const cells *all) {
    uint32_t unproven = 0, open = 0, pairs = 0;
    for (uint32_t i = 0; i < all->count; i++) {
        unproven += all->items[i].unproven;
        open += all->items[i].open;
        pairs += all->items[i].pairs;
    }
    printf("\nOf %u answers of ovoid %u failed ovoid_answer_verify or left the question open; %u references are wider "
           "than 1e-7 of the size.\n",
           pairs, unproven, open);
    printf("Wrong answers: none given; sign; off by 1e-4 (depth 1e-3) of itself; off by 1e-6; points or normal\n");
    printf("%-10s %-6s %-8s %9s %8s %8s %8s %8s %8s\n", "", "", "question", "asked", "none", "sign", "off", "off 1e-6",
           "points");
    for (uint32_t i = 0; all->count && i < all->items[0].count; i++) {
        const peer *who = all->items[0].entrants[i].who;
        if (i == 0 || who != all->items[0].entrants[i - 1].who) print_faults_of(all, who);
    }
}

int cells_write_csv(const cells *all, const char *path) {
    FILE *file = fopen(path, "w");
    if (!file) return 0;
    (void)fprintf(file, "# %s\n", get_build());
    (void)fprintf(file, "workload,vertices,question,contestant,warm,float,pairs,median_ns,quartile1_ns,quartile3_ns,"
                        "minimum_ns,asked,none,sign,off,off_1e-6,points\n");
    for (uint32_t i = 0; i < all->count; i++)
        for (uint32_t k = 0; k < all->items[i].count; k++) {
            const cell *c = &all->items[i];
            const entrant *e = &c->entrants[k];
            if (!(e->time.median > 0)) continue;
            (void)fprintf(file, "%s,%u,%s,%s,%d,%d,%u,%.1f,%.1f,%.1f,%.1f,%u,%u,%u,%u,%u,%u\n", c->workload,
                          c->vertices, question_get_name(c->what), e->who->name, e->warm, e->who->is_float, c->pairs,
                          e->time.median, e->time.low, e->time.high, e->time.least, e->wrong.asked, e->wrong.none,
                          e->wrong.sign, e->wrong.off, e->wrong.off_fine, e->wrong.points);
        }
    return fclose(file) == 0;
}
