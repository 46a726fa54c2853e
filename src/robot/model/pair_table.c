// The tables of a robot: which pairs of links have one, and look-ups of ranges.
//
// The tables are made by the first checker, as a robot that is only placed or drawn needs none. Two threads that come
// first at the same time both make them, with the same bits; one of them throws its own away.
#include "robot/model/pair_table.h"

#include "base/allocator.h"
#include "robot/model/pair_table_fill.h"

#include <string.h>

// Of robots with more links that have elements no pair is looked at; exact queries for a table, and for a robot's.
enum { LINKS_MOST = 128, QUERIES_A_TABLE = 1 << 14, QUERIES_MOST = 1 << 17 };

// ---- look-ups

const pair_table *pair_tables_find(const pair_tables *tables, uint32_t a, uint32_t b) {
    uint32_t first = a < b ? a : b, second = a < b ? b : a, low = 0, high = tables->count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        const pair_table *t = &tables->items[middle];
        if (t->a == first && t->b == second) return t;
        if (t->a < first || (t->a == first && t->b < second))
            low = middle + 1;
        else
            high = middle;
    }
    return NULL;
}

// The cells from first to before end along an axis; those of a whole turn go around.
typedef struct cell_span {
    uint32_t first, end;
} cell_span;

// Up to two spans of an interval; how many, 0: it leaves the axis.
static int find_spans(const table_axis *x, double low, double high, cell_span spans[2]) {
    double from = table_axis_locate(x, low), width = (high - low) * x->scale;
    uint32_t first = table_axis_find_cell(x, from - TABLE_EDGE > 0 ? from - TABLE_EDGE : from);
    if (first == x->count || !(fabs(high) <= x->most)) return 0;
    double to = from + width + TABLE_EDGE;
    if (!(to < x->count + 2 * TABLE_EDGE)) {
        if (!(x->period > 0)) return 0;
        spans[0] = (cell_span){first, x->count};
        double beyond = to - x->count;
        spans[1] = (cell_span){0, beyond < first ? (uint32_t)beyond + 1 : first};
        return 2;
    }
    uint32_t last = (uint32_t)to;
    spans[0] = (cell_span){first, (last < x->count ? last : x->count - 1) + 1};
    return 1;
}

static uint32_t count_open(const pair_table *t, cell_span x, cell_span y) {
    size_t row = (size_t)t->axes[0].count + 1;
    const uint32_t *below = t->sums + y.first * row, *above = t->sums + y.end * row;
    return (above[x.end] - above[x.first]) - (below[x.end] - below[x.first]);
}

int pair_table_is_apart(const pair_table *t, const table_range *range) {
    cell_span spans[2][2];
    int counts[2];
    for (int k = 0; k < 2; k++) {
        counts[k] = find_spans(&t->axes[k], range->low[k], range->high[k], spans[k]);
        if (counts[k] == 0) return 0;
    }
    if (!t->sums) return 1;
    uint32_t open = 0;
    for (int i = 0; i < counts[0]; i++)
        for (int k = 0; k < counts[1]; k++) open |= count_open(t, spans[0][i], spans[1][k]);
    return open == 0;
}

// ---- creation

static uint32_t find_least(const uint8_t *codes, size_t count) {
    uint8_t least = 255;
    for (size_t i = 0; i < count; i++) least = codes[i] < least ? codes[i] : least;
    return least;
}

static void set_sums(pair_table *t) {
    size_t count = t->axes[0].count, row = count + 1;
    memset(t->sums, 0, row * sizeof *t->sums);
    for (size_t k = 0; k < t->axes[1].count; k++) {
        uint32_t *to = t->sums + (k + 1) * row, open = 0;
        to[0] = 0;
        for (size_t i = 0; i < count; i++) {
            open += t->codes[k * count + i] == 0;
            to[i + 1] = (to - row)[i + 1] + open;
        }
    }
}

// Takes the pair that was filled over; 0: no memory. Where no cell is proven there is no table.
static int add_table(const ovoid_robot *r, pair_tables *tables, const table_maker *m) {
    pair_table t = {m->sides[0].link, m->sides[1].link, {m->axes[0], m->axes[1]}, m->unit, 0, NULL, NULL};
    size_t cells = (size_t)t.axes[0].count * t.axes[1].count,
           sums = ((size_t)t.axes[0].count + 1) * ((size_t)t.axes[1].count + 1);
    int is_empty = 1;
    for (size_t i = 0; is_empty && i < cells; i++) is_empty = m->codes[i] == 0;
    if (is_empty) return 1;
    if (tables->count == tables->capacity) {
        uint32_t capacity = 2 * tables->capacity + 8;
        pair_table *items = allocator_allocate(&r->allocator, capacity, sizeof *items);
        if (!items) return 0;
        if (tables->count) memcpy(items, tables->items, tables->count * sizeof *items);
        allocator_release(&r->allocator, tables->items);
        tables->items = items;
        tables->capacity = capacity;
    }
    t.all = find_least(m->codes, cells);
    if (t.all == 0) {
        t.codes = allocator_allocate(&r->allocator, cells, 1);
        t.sums = allocator_allocate(&r->allocator, sums, sizeof *t.sums);
        if (t.codes && t.sums) {
            memcpy(t.codes, m->codes, cells);
            set_sums(&t);
            tables->memory += cells + sums * sizeof *t.sums;
        }
    }
    tables->items[tables->count++] = t;
    return t.all > 0 || (t.codes && t.sums);
}

static int is_disabled(const ovoid_robot *r, uint32_t a, uint32_t b) {
    for (uint32_t i = 0; i < r->disabled_count; i++)
        if (r->disabled[i].a == a && r->disabled[i].b == b) return 1;
    return 0;
}

// The links with elements, in order; how many, at most one more than LINKS_MOST.
static uint32_t find_links(const ovoid_robot *r, uint32_t links[LINKS_MOST + 1]) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < r->element_count; i++) {
        uint32_t link = r->elements[i].link, at = 0;
        while (at < count && links[at] < link) at++;
        if (at < count && links[at] == link) continue;
        if (count == LINKS_MOST) return LINKS_MOST + 1;
        memmove(links + at + 1, links + at, (count - at) * sizeof *links);
        links[at] = link;
        count++;
    }
    return count;
}

static int add_tables(const ovoid_robot *r, pair_tables *tables, table_maker *m) {
    uint32_t links[LINKS_MOST + 1], count = find_links(r, links);
    if (count > LINKS_MOST) return 1;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = i + 1; k < count; k++) {
            if (m->queries > QUERIES_MOST) return 1;
            if (is_disabled(r, links[i], links[k]) || !table_maker_set_pair(m, links[i], links[k])) continue;
            m->most = m->queries + QUERIES_A_TABLE;
            table_maker_fill(m);
            if (!add_table(r, tables, m)) return 0;
        }
    return 1;
}

static void destroy(const ovoid_robot *r, pair_tables *tables) {
    if (!tables) return;
    for (uint32_t i = 0; i < tables->count; i++) {
        allocator_release(&r->allocator, tables->items[i].codes);
        allocator_release(&r->allocator, tables->items[i].sums);
    }
    allocator_release(&r->allocator, tables->items);
    allocator_release(&r->allocator, tables);
}

static pair_tables *create(const ovoid_robot *r) {
    pair_tables *tables = allocator_allocate(&r->allocator, 1, sizeof *tables);
    if (!tables) return NULL;
    *tables = (pair_tables){0, 0, NULL, 0};
    table_maker m;
    int has_memory = table_maker_create(&m, r);
    if (has_memory) {
        has_memory = add_tables(r, tables, &m);
        table_maker_destroy(&m);
    }
    if (has_memory) return tables;
    destroy(r, tables);
    return NULL;
}

void pair_tables_begin(pair_tables_once *once) {
    atomic_init(&once->made, NULL);
    once->is_off = 0;
}
void robot_leave_out_pair_tables(const ovoid_robot *r) { r->tables->is_off = 1; }
void pair_tables_end(const ovoid_robot *r) { destroy(r, atomic_load(&r->tables->made)); }

const pair_tables *robot_get_pair_tables(const ovoid_robot *r) {
    static const pair_tables none = {0, 0, NULL, 0};
    pair_tables *made = atomic_load(&r->tables->made);
    if (made || r->tables->is_off) return made ? made : &none;
    pair_tables *own = create(r), *first = NULL;
    if (!own || atomic_compare_exchange_strong(&r->tables->made, &first, own)) return own;
    destroy(r, own);
    return first;
}
