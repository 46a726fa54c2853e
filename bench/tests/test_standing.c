// Leads, goals and numbers of cells over made-up times. Truth: the times and the wrong answers are written here.
#include "pairs/standing.h"

#include <stdio.h>

static int passed, failed;

static void check_equal(const char *what, double value, double expected) {
    if (value == expected) {
        passed++;
        return;
    }
    failed++;
    printf("FAILED %s: %.17g, expected %.17g\n", what, value, expected);
}

enum { OWN = 4 };

/// ovoid 100 ns, with its last proof 50; prepared 80; in batches 20; a right peer, and one that is wrong in `wrong` of
/// 100 answers.
static cell make_cell(question what, uint32_t tracks, double right, double other, uint32_t wrong) {
    static const peer own = {.name = "ovoid"}, ready = {.name = "prepared"}, batch = {.name = "batch"};
    static const peer good = {.name = "good"}, bad = {.name = "bad"};
    cell c = {.workload = "hulls", .vertices = 8, .tracks = tracks, .what = what, .count = OWN + 2};
    c.entrants[0] = (entrant){.who = &own, .time = {.median = 100}};
    c.entrants[1] = (entrant){.who = &own, .warm = 1, .time = {.median = tracks ? 50 : 0}};
    c.entrants[2] = (entrant){.who = &ready, .time = {.median = 80}};
    c.entrants[3] = (entrant){.who = &batch, .time = {.median = 20}};
    c.entrants[4] = (entrant){.who = &good, .time = {.median = right}, .wrong = {.asked = 100}};
    c.entrants[5] = (entrant){.who = &bad, .time = {.median = other}, .wrong = {.asked = 100, .sign = wrong}};
    return c;
}

static void check_leads(const cells *all) {
    const cell *still = &all->items[0], *moving = &all->items[1], *absent = &all->items[4];
    check_equal("against all", standing_get_lead(all, still, WAY_PAIR, 0), 0.9);
    check_equal("against right peers", standing_get_lead(all, still, WAY_PAIR, 1), 3);
    check_equal("prepared", standing_get_lead(all, still, WAY_PREPARED, 1), 3.75);
    check_equal("in batches", standing_get_lead(all, still, WAY_BATCH, 1), 15);
    check_equal("the faster of cold and warm", standing_get_lead(all, moving, WAY_PAIR, 0), 3.5);
    check_equal("one wrong of a hundred is right", standing_get_lead(all, &all->items[2], WAY_PAIR, 1), 2);
    check_equal("without a peer", standing_get_lead(all, absent, WAY_PAIR, 0), 0);
}

static void check_goals(const cells *all) {
    check_equal("yes or no", standing_get_goal(&all->items[0], WAY_PAIR), 3);
    check_equal("motion", standing_get_goal(&all->items[1], WAY_PREPARED), 4);
    check_equal("distance", standing_get_goal(&all->items[2], WAY_PAIR), 2);
    check_equal("depth", standing_get_goal(&all->items[3], WAY_PREPARED), 3);
    check_equal("a batch", standing_get_goal(&all->items[1], WAY_BATCH), 10);
    check_equal("a batch of distances", standing_get_goal(&all->items[2], WAY_BATCH), 5);
}

static void check_counts(const cells *all) {
    standing every = standing_count(all, WAY_PAIR, 0), right = standing_count(all, WAY_PAIR, 1);
    check_equal("cells", every.cells, 4);
    check_equal("level is not ahead", every.ahead, 2);
    check_equal("at the goal", every.goal, 1);
    check_equal("ahead of right peers", right.ahead, 3);
    check_equal("at the goal of right peers", right.goal, 2);
    check_equal("batches at the goal", standing_count(all, WAY_BATCH, 1).goal, 2);
}

int main(void) {
    cell items[] = {make_cell(QUESTION_COLLIDE, 0, 300, 90, 2), make_cell(QUESTION_COLLIDE, 10, 175, 500, 0),
                    make_cell(QUESTION_DISTANCE, 0, 400, 200, 1), make_cell(QUESTION_DEPTH, 0, 100, 250, 0),
                    make_cell(QUESTION_DEPTH, 0, 0, 0, 0)};
    cells all = {.items = items, .count = sizeof items / sizeof items[0], .own = OWN};
    check_leads(&all);
    check_goals(&all);
    check_counts(&all);
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
