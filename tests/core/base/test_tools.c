// The tools that all floors share: heaps, hash tables, growing arrays. Truth: sorted numbers, all pairs of points, the
// numbers that were put in.
#include "check.h"

#include "tools/array.h"
#include "tools/hash.h"
#include "tools/heap.h"

enum { MOST = 200, SLOTS = 512 };

static int is_above(const void *a, const void *b) { return *(const uint64_t *)a < *(const uint64_t *)b; }

static int compare_numbers(const void *a, const void *b) { return is_above(b, a) - is_above(a, b); }

// What is pushed comes out in order, also where numbers are equal and where pushing goes on in between.
static void test_heap(void) {
    uint64_t s = 1, items[MOST], sorted[MOST], top;
    for (size_t count = 1; count <= MOST; count++) {
        check_seed = count;
        for (size_t i = 0; i < count; i++) {
            sorted[i] = random_next(&s) % count;
            heap_push((heap){items, i, sizeof *items, is_above}, &sorted[i]);
        }
        qsort(sorted, count, sizeof *sorted, compare_numbers);
        for (size_t i = 0; i < count; i++) {
            heap_pop((heap){items, count - i, sizeof *items, is_above}, &top);
            CHECK_EQ(top, sorted[i]);
            heap_push((heap){items, count - i - 1, sizeof *items, is_above}, &top);
            heap_pop((heap){items, count - i, sizeof *items, is_above}, &top);
            CHECK_EQ(top, sorted[i]);
        }
    }
    check_seed = 0;
}

// Two columns that are sorted together.
typedef struct columns {
    uint64_t key[MOST], beside[MOST];
} columns;

static int is_after(const void *items, size_t i, size_t k) {
    const columns *c = items;
    return c->key[i] > c->key[k];
}

static void exchange(void *items, size_t i, size_t k) {
    columns *c = items, was = {{c->key[i]}, {c->beside[i]}};
    c->key[i] = c->key[k], c->beside[i] = c->beside[k];
    c->key[k] = was.key[0], c->beside[k] = was.beside[0];
}

static void test_sort(void) {
    uint64_t s = 1, sorted[MOST];
    columns all = {{0}, {0}};
    for (size_t count = 0; count < MOST; count++) {
        check_seed = count;
        for (size_t i = 0; i < count; i++)
            sorted[i] = all.key[i] = random_next(&s) % (count + 1), all.beside[i] = 3 * all.key[i];
        all.key[count] = 0; // which is beyond the end, and stays
        qsort(sorted, count, sizeof *sorted, compare_numbers);
        heap_sort(&(heap_places){&all, is_after, exchange}, count);
        for (size_t i = 0; i < count; i++) CHECK_EQ(all.key[i], sorted[i]), CHECK_EQ(all.beside[i], 3 * sorted[i]);
        CHECK_EQ(all.key[count], 0);
    }
    check_seed = 0;
}

static int ends_search(const void *table, size_t slot, const void *key) {
    const double *point = (const double *)table + 3 * slot;
    return isnan(point[0]) || hash_is_same_point(point, key);
}

// Points of few coordinates, zeros of both signs among them: each is found where an equal one was put.
static void test_hash(void) {
    static double points[SLOTS][3], table[SLOTS][3];
    uint64_t s = 2;
    for (int i = 0; i < SLOTS; i++) table[i][0] = NAN;
    for (int i = 0; i < SLOTS / 2; i++) {
        for (int k = 0; k < 3; k++) points[i][k] = (double)(random_next(&s) % 5) * (random_next(&s) % 2 ? -0.5 : 0.5);
        size_t at = hash_find(hash_point(points[i]), SLOTS, table, points[i], ends_search);
        int is_new = 1;
        for (int j = 0; j < i; j++)
            is_new &= points[i][0] != points[j][0] || points[i][1] != points[j][1] || points[i][2] != points[j][2];
        CHECK_EQ(isnan(table[at][0]) != 0, is_new);
        memcpy(table[at], points[i], sizeof *table);
    }
    const double zeros[3] = {0, -0.0, 0};
    for (int k = 0; k < 3; k++) {
        double other[3] = {0, 0, 0};
        CHECK(hash_is_same_point(zeros, other));
        other[k] = 1;
        CHECK(!hash_is_same_point(zeros, other));
    }
    CHECK(hash_pair(1, 2) != hash_pair(2, 1) && hash_pair(1, 2) == hash_number((uint64_t)1 << 32 | 2));
}

static void test_array(void) {
    uint64_t *items = NULL;
    size_t capacity = 0;
    for (size_t count = 0; count < 5000; count++) {
        if (!CHECK(array_reserve((void **)&items, &capacity, count, sizeof *items)) || !CHECK(capacity > count)) break;
        items[count] = count * count;
    }
    for (size_t i = 0; i < 5000; i++) CHECK_EQ(items[i], i * i);
    CHECK_EQ(capacity, 16 * 512);
    // The size in bytes of twice as much would overflow to a small one: the array stays as it was.
    size_t huge = SIZE_MAX / 16 + 9;
    uint64_t *before = items;
    CHECK(!array_reserve((void **)&items, &huge, huge, sizeof *items));
    CHECK(items == before && huge == SIZE_MAX / 16 + 9);
    free(items);
}

int main(void) {
    test_heap();
    test_sort();
    test_hash();
    test_array();
    return check_end();
}
