// The summary of a check. Pairs are kept sorted, each once, so that any number of states takes the memory of the pairs.
#include "robot/tally.h"

#include "base/message.h"
#include "tools/array.h"

#include <stdlib.h>
#include <string.h>

/// Most pairs that are reported.
#define REPORTED_MAX 10

static int compare_sides(const ovoid_robot_side *p, const ovoid_robot_side *q) {
    if (p->link != q->link) return p->link < q->link ? -1 : 1;
    if (p->element != q->element) return p->element < q->element ? -1 : 1;
    return p->body < q->body ? -1 : p->body > q->body;
}

static int compare_pairs(const tally_pair *p, const tally_pair *q) {
    int first = compare_sides(&p->a, &q->a);
    return first ? first : compare_sides(&p->b, &q->b);
}

/// The place of a pair, or where it would be.
static size_t find_place(const tally *t, const tally_pair *pair) {
    size_t low = 0, high = t->pair_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (compare_pairs(&t->pairs[middle], pair) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

int tally_add(tally *t, const ovoid_robot_answer *answer) {
    t->statuses[answer->status]++;
    t->empty += answer->status == OVOID_ROBOT_UNDECIDED && answer->code == OVOID_ERROR_EMPTY;
    t->outside += (size_t)cell_is_outside(answer);
    int is_of_links =
        cell_has_pair(answer) && answer->a.element != OVOID_ROBOT_NONE && answer->b.element != OVOID_ROBOT_NONE;
    if (is_of_links && !t->links.count) t->links = (tally_pair){answer->a, answer->b, 1};
    if (answer->status != OVOID_ROBOT_HIT) return 1;
    const tally_pair pair = {answer->a, answer->b, 0};
    size_t at = find_place(t, &pair);
    if (at == t->pair_count || compare_pairs(&t->pairs[at], &pair) != 0) {
        if (!array_reserve((void **)&t->pairs, &t->capacity, t->pair_count, sizeof *t->pairs)) return 0;
        memmove(t->pairs + at + 1, t->pairs + at, (t->pair_count - at) * sizeof *t->pairs);
        t->pairs[at] = pair;
        t->pair_count++;
    }
    t->pairs[at].count++;
    return 1;
}

int tally_get_exit(const tally *t) {
    if (t->statuses[OVOID_ROBOT_UNDECIDED] || t->statuses[OVOID_ROBOT_REFUSED]) return EXIT_NOT_PROVEN;
    return t->statuses[OVOID_ROBOT_HIT] ? EXIT_TOUCH : EXIT_APART;
}

/// The most frequent first; of equal ones the order of the robot.
static int compare_counts(const void *a, const void *b) {
    const tally_pair *p = a, *q = b;
    if (p->count != q->count) return p->count > q->count ? -1 : 1;
    return compare_pairs(p, q);
}

/// The pairs that were named most often.
static void report_pairs(tally *t, const cli_cell *cell) {
    char a[CELL_SIDE_ROOM], b[CELL_SIDE_ROOM];
    if (t->pair_count) qsort(t->pairs, t->pair_count, sizeof *t->pairs, compare_counts);
    for (size_t i = 0; i < t->pair_count && i < REPORTED_MAX; i++) {
        (void)cell_format_side(a, cell, &t->pairs[i].a);
        (void)cell_format_side(b, cell, &t->pairs[i].b);
        message_note("  %s, %s: %zu", a, b, t->pairs[i].count);
    }
    if (t->pair_count > REPORTED_MAX) message_note("  and %zu more pairs", t->pair_count - REPORTED_MAX);
    if (t->links.count) cell_tell_links(cell, &t->links.a, &t->links.b);
}

void tally_report(tally *t, const cli_cell *cell, double seconds) {
    const size_t *n = t->statuses;
    size_t all = n[0] + n[1] + n[2] + n[3];
    message_note("%zu state%s in %.2f s; free: %zu, hit: %zu, undecided: %zu, refused: %zu", all, all == 1 ? "" : "s",
                 seconds, n[OVOID_ROBOT_FREE], n[OVOID_ROBOT_HIT], n[OVOID_ROBOT_UNDECIDED], n[OVOID_ROBOT_REFUSED]);
    if (t->empty) message_warning("%s", cell_get_empty());
    report_pairs(t, cell);
    if (t->outside) cell_tell_outside();
}

void tally_clear(tally *t) {
    free(t->pairs);
    *t = (tally){.pairs = NULL};
}
