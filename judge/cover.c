// Do rectangles in a table of all pairs of parts cover it? A sweep along the rows: a tree over the columns counts how
// many rectangles cover each of them (J. L. Bentley, Algorithms for Klee's rectangle problems, 1977).
#include "parts.h"

#include <stdlib.h>

/// Where a rectangle begins (delta 1) or ends (-1).
typedef struct event {
    uint32_t row, first, end;
    int delta;
} event;

static int compare_events(const void *a, const void *b) {
    const event *x = a, *y = b;
    return x->row != y->row ? (x->row < y->row ? -1 : 1) : 0;
}

/// Coverage of the columns: a node has the least of its columns, without what `own` of the nodes above adds.
typedef struct columns {
    int *least, *own;
    size_t leaves; ///< a power of two
} columns;

static void columns_add(columns *c, size_t first, size_t end, int delta) {
    size_t low = first + c->leaves, high = end + c->leaves;
    for (; low < high; low /= 2, high /= 2) {
        if (low & 1) c->least[low] += delta, c->own[low] += delta, low++;
        if (high & 1) --high, c->least[high] += delta, c->own[high] += delta;
    }
    const size_t ends[2] = {first + c->leaves, end - 1 + c->leaves};
    for (int i = 0; i < 2; i++)
        for (size_t node = ends[i] / 2; node > 0; node /= 2) {
            int left = c->least[2 * node], right = c->least[2 * node + 1];
            c->least[node] = c->own[node] + (left < right ? left : right);
        }
}

static uint32_t columns_find_least(const columns *c) {
    size_t node = 1;
    while (node < c->leaves) node = 2 * node + (c->least[2 * node + 1] < c->least[2 * node]);
    return (uint32_t)(node - c->leaves);
}

static void fill_events(const pair_table *t, event *events) {
    for (size_t i = 0; i < t->count; i++) {
        const ovoid_exclusion *e = &t->items[i];
        events[2 * i] = (event){e->first_a, e->first_b, e->end_b, 1};
        events[2 * i + 1] = (event){e->end_a, e->first_b, e->end_b, -1};
    }
    events[2 * t->count] = (event){t->row, t->column, t->column + 1, 1};
    events[2 * t->count + 1] = (event){t->row + 1, t->column, t->column + 1, -1};
    qsort(events, 2 * t->count + 2, sizeof *events, compare_events);
}

// 1 if no row has a column that is not covered.
static int sweep(const pair_table *t, const event *events, columns *c, uint32_t *row, uint32_t *column) {
    size_t count = 2 * t->count + 2, next = 0;
    // Leaves beyond the columns count as covered.
    if (t->columns < c->leaves) columns_add(c, t->columns, c->leaves, 1);
    for (*row = 0; *row < t->rows; *row = events[next].row) {
        for (; next < count && events[next].row == *row; next++)
            columns_add(c, events[next].first, events[next].end, events[next].delta);
        *column = columns_find_least(c);
        if (c->least[1] <= 0) return 0;
    }
    return 1;
}

int judge_is_covered(const pair_table *t, uint32_t *row, uint32_t *column) {
    columns c = {.leaves = 2};
    while (c.leaves < t->columns) c.leaves *= 2;
    c.least = judge_allocate(2 * c.leaves, sizeof *c.least);
    c.own = judge_allocate(2 * c.leaves, sizeof *c.own);
    event *events = judge_allocate(2 * t->count + 2, sizeof *events);
    fill_events(t, events);
    int is = sweep(t, events, &c, row, column);
    free(events);
    free(c.own);
    free(c.least);
    return is;
}

int judge_is_order(const uint32_t *order, uint32_t count, uint32_t of, uint32_t *place) {
    unsigned char *seen = judge_allocate(count, 1);
    uint32_t named = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (order[i] < count && !seen[order[i]]) seen[order[i]] = 1, named++;
        if (order[i] == of) *place = i;
    }
    free(seen);
    return named == count;
}
