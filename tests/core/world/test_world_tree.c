// The dynamic tree by itself: leaves come, change their boxes and go. Truth: the tree's own definition, looked at in
// full after every step (each inner node's box is exactly that of its two children, each leaf is where leaf_of says, no
// node has two parents), and brute force over all boxes for what a traversal must find. The set of ignored pairs beside
// a table of all pairs; the sort of keys beside its definition.
#include "check.h"
#include "world/ignored.h"
#include "world/tree/dynamic_tree_traverse.h"
#include "world/tree/radix_sort.h"
#include "world/tree/wide_tree.h"

enum { BODIES = 60, STEPS = 4000 };

static tree_node nodes[2 * BODIES + 2];
static uint32_t leaf_of[BODIES];
static box boxes[BODIES];
static box8 wide_nodes[BODIES * 4 / 7 + 2];

static box make_box(uint64_t *s) {
    // Whole numbers, so that faces meet exactly and boxes are equal now and then.
    vec3 at = {floor(random_uniform(s, 0, 30)), floor(random_uniform(s, 0, 30)), floor(random_uniform(s, 0, 4))};
    vec3 wide = {floor(random_uniform(s, 0, 5)), floor(random_uniform(s, 0, 5)), floor(random_uniform(s, 0, 5))};
    return (box){at, vec3_add(at, wide)};
}

// How many leaves there are below a node whose parent must be the one given.
static uint32_t check_node(const dynamic_tree *t, uint32_t at, uint32_t parent) {
    const tree_node *n = &t->nodes[at];
    CHECK_EQ(n->parent, parent);
    if (!n->child) {
        CHECK(n->body < BODIES && leaf_of[n->body] == at && box_is_same(&n->bounds, &boxes[n->body]));
        return 1;
    }
    box joined = box_join(&t->nodes[n->child].bounds, &t->nodes[n->child + 1].bounds);
    CHECK(box_is_same(&joined, &n->bounds));
    return check_node(t, n->child, at) + check_node(t, n->child + 1, at);
}

typedef struct found {
    uint32_t count;
    uint8_t is_in[BODIES];
    vec3 from;
    double bound;
} found;

static int take(void *context, const tree_node *leaf) {
    found *f = context;
    f->count++;
    f->is_in[leaf->body]++;
    return 1;
}

static int count_leaf(void *context, const tree_node *leaf) {
    (void)leaf;
    ((found *)context)->count++;
    return 1;
}

static void check_overlaps(const dynamic_tree *t, const box *wanted) {
    found f = {.count = 0};
    CHECK(dynamic_tree_find_overlaps(t, wanted, take, &f));
    uint32_t expected = 0;
    for (uint32_t i = 0; i < BODIES; i++) {
        int is_in = leaf_of[i] != NONE && box_is_overlapping(&boxes[i], wanted);
        CHECK_EQ(f.is_in[i], is_in);
        expected += (uint32_t)is_in;
    }
    CHECK_EQ(f.count, expected);
}

// All instruction sets find the same leaves in the same order, however little room they are given.
static void check_kernels(const dynamic_tree *t, const box *wanted) {
    uint32_t first[BODIES + BOX8], count = 0;
    for (int isa = SIMD_SCALAR; t->wide_count && isa < SIMD_ISA_COUNT; isa++) {
        box8_function *find = box8_get((simd_isa)isa);
        if (!find) continue;
        box8_walk walk;
        uint32_t leaves[BODIES + BOX8], here, all = 0;
        box8_begin(&walk, t->wide, &wanted->min.x);
        while ((here = find(&walk, leaves + all, isa == SIMD_SCALAR ? BODIES + BOX8 - all : BOX8)) > 0) all += here;
        if (isa == SIMD_SCALAR) {
            count = all;
            memcpy(first, leaves, sizeof first);
        }
        CHECK(all == count && !memcmp(first, leaves, all * sizeof *leaves));
    }
}

// Leaves that overlap the wanted box, but not the seen one, and fresh leaves are found, by all instruction sets the
// same. Of the others those that overlap the seen box by more than roundings are left out.
static void check_new(dynamic_tree *t, const box *wanted, const box *seen, uint64_t fresh) {
    uint32_t first[BODIES + BOX8], count = 0;
    for (uint32_t i = 0; i < BODIES; i++)
        if (leaf_of[i] != NONE) wide_tree_set_fresh(t, leaf_of[i], (int)(fresh >> i % 64 & 1));
    for (int isa = SIMD_SCALAR; t->wide_count && isa < SIMD_ISA_COUNT; isa++) {
        box8_function *find = box8_get_new((simd_isa)isa);
        if (!find) continue;
        box8_walk walk;
        uint32_t leaves[BODIES + BOX8], here, all = 0;
        box8_begin_new(&walk, t->wide, &wanted->min.x, &seen->min.x);
        while ((here = find(&walk, leaves + all, BODIES + BOX8 - all)) > 0) all += here;
        if (isa == SIMD_SCALAR) {
            count = all;
            memcpy(first, leaves, sizeof first);
        }
        CHECK(all == count && !memcmp(first, leaves, all * sizeof *leaves));
    }
    uint8_t is_found[BODIES] = {0};
    for (uint32_t k = 0; k < count; k++) is_found[t->nodes[first[k]].body] = 1;
    vec3 more = {1e-4, 1e-4, 1e-4};
    box less = {vec3_add(seen->min, more), vec3_sub(seen->max, more)};
    for (uint32_t i = 0; i < BODIES && t->wide_count; i++) {
        if (leaf_of[i] == NONE || !box_is_overlapping(&boxes[i], wanted)) continue;
        if ((fresh >> i % 64 & 1) || !box_is_overlapping(&boxes[i], seen)) CHECK_EQ(is_found[i], 1);
        if (!(fresh >> i % 64 & 1) && box_is_overlapping(&boxes[i], &less)) CHECK_EQ(is_found[i], 0);
    }
    for (uint32_t i = 0; i < BODIES; i++)
        if (leaf_of[i] != NONE) wide_tree_set_fresh(t, leaf_of[i], 0);
    for (uint32_t i = 0; i < t->wide_count; i++) CHECK_EQ(t->wide[i].fresh, 0);
}

// The seen box: another one, one that ends less than single precision tells before a leaf begins, an empty one.
static void check_seen(dynamic_tree *t, const box *wanted, uint64_t *s) {
    box seen = make_box(s), empty = box_make_empty(), near = seen;
    check_new(t, wanted, &seen, random_next(s) & random_next(s));
    uint32_t i = (uint32_t)(random_next(s) % BODIES);
    near = boxes[i];
    near.max.x = boxes[i].min.x - 1e-9;
    near.min.x = near.max.x - 1;
    check_new(t, &boxes[i], &near, 0);
    near = (box){{boxes[i].max.x + 1e-9, near.min.y, near.min.z}, {boxes[i].max.x + 1, near.max.y, near.max.z}};
    check_new(t, &boxes[i], &near, 0);
    check_new(t, wanted, &empty, 0);
}

// Boxes of the wide nodes hold those of the leaves, and are larger by less than 1e-6 of the numbers.
static void check_wide(const dynamic_tree *t) {
    uint32_t leaves = 0;
    for (uint32_t at = 0; at < t->wide_count; at++)
        for (uint32_t i = 0; i < BOX8; i++) {
            if (!(t->wide[at].leaves >> i & 1)) continue;
            const tree_node *n = &t->nodes[t->wide[at].child[i]];
            const double *low = &n->bounds.min.x, *high = &n->bounds.max.x;
            leaves++;
            for (int k = 0; k < 3; k++) {
                double down = t->wide[at].low[k][i], up = t->wide[at].high[k][i];
                CHECK(down <= low[k] && high[k] <= up);
                CHECK_LE(low[k] - down, 1e-6 * fabs(low[k]) + 1e-40);
                CHECK_LE(up - high[k], 1e-6 * fabs(high[k]) + 1e-40);
            }
        }
    if (t->wide_count) CHECK_EQ(leaves, t->leaf_count);
}

static double measure(const void *context, const box *b) {
    const found *f = context;
    box point = {f->from, f->from};
    return box_compute_distance(&point, b);
}
static void visit(void *context, uint32_t body) {
    found *f = context;
    f->is_in[body] = 1;
    f->bound = min2(f->bound, measure(f, &boxes[body]));
}

// The nearest box; and every box that is as near as the bound from the start is visited where the bound stays.
static void check_nearest(const dynamic_tree *t, vec3 from) {
    found f = {.from = from, .bound = INFINITY};
    dynamic_tree_find_nearest(&(tree_traversal){t, measure, visit, &f, &f.bound});
    double least = INFINITY, kept;
    for (uint32_t i = 0; i < BODIES; i++)
        if (leaf_of[i] != NONE) least = min2(least, measure(&f, &boxes[i]));
    CHECK(f.bound == least);
    found g = {.from = from, .bound = INFINITY};
    kept = least;
    dynamic_tree_find_nearest(&(tree_traversal){t, measure, visit, &g, &kept});
    for (uint32_t i = 0; i < BODIES; i++)
        if (leaf_of[i] != NONE) CHECK_EQ(g.is_in[i], measure(&g, &boxes[i]) <= least);
}

static void rebuild(dynamic_tree *t) {
    static tree_item items[BODIES];
    uint32_t count = 0;
    for (uint32_t i = 0; i < BODIES; i++)
        if (leaf_of[i] != NONE) items[count++] = (tree_item){boxes[i], i};
    dynamic_tree_build(t, items, count, leaf_of);
}

static void step(dynamic_tree *t, uint64_t *s) {
    uint32_t i = (uint32_t)(random_next(s) % BODIES);
    uint64_t what = random_next(s) % 8;
    if (leaf_of[i] == NONE) {
        boxes[i] = make_box(s);
        dynamic_tree_add(t, i, &boxes[i], leaf_of);
    } else if (what < 3) {
        dynamic_tree_remove(t, leaf_of[i], leaf_of);
        leaf_of[i] = NONE;
    } else {
        boxes[i] = make_box(s);
        dynamic_tree_refit(t, leaf_of[i], &boxes[i]);
    }
}

static void test_tree(void) {
    dynamic_tree t;
    uint64_t s = 7;
    dynamic_tree_make(&t, nodes, BODIES);
    t.wide = wide_nodes;
    for (uint32_t i = 0; i < BODIES; i++) leaf_of[i] = NONE;
    for (int k = 0; k < STEPS; k++) {
        check_seed = (uint64_t)k;
        if (k % 500 == 499) rebuild(&t);
        step(&t, &s);
        uint32_t leaves = 0;
        for (uint32_t i = 0; i < BODIES; i++) leaves += leaf_of[i] != NONE;
        CHECK_EQ(t.leaf_count, leaves);
        CHECK_LE(t.used, 2 * BODIES + 2);
        if (!leaves) continue;
        CHECK_EQ(check_node(&t, 0, NONE), leaves);
        box wanted = make_box(&s);
        check_overlaps(&t, &wanted);
        if (!t.wide_count && k % 4) {
            wide_tree_build(&t);
            CHECK(t.wide_count > 0 && t.wide_count <= wide_tree_get_capacity(leaves));
            check_overlaps(&t, &wanted);
        }
        // Boxes that met are now apart by less than single precision tells.
        box less = {vec3_add(wanted.min, (vec3){1e-9, 1e-9, 1e-9}), vec3_sub(wanted.max, (vec3){1e-9, 1e-9, 1e-9})};
        check_overlaps(&t, &less);
        check_wide(&t);
        check_kernels(&t, &wanted);
        check_seen(&t, &wanted, &s);
        check_nearest(&t, wanted.min);
    }
    // Empty again.
    for (uint32_t i = 0; i < BODIES; i++)
        if (leaf_of[i] != NONE) dynamic_tree_remove(&t, leaf_of[i], leaf_of), leaf_of[i] = NONE;
    CHECK_EQ(t.leaf_count, 0);
    check_overlaps(&t, &(box){{0, 0, 0}, {99, 99, 99}});
}

// Numbers as far apart as a world's: each is at most rounded outward, and what is beyond all floats is found.
static void test_rounding(void) {
    uint64_t s = 11;
    for (int k = 0; k < 100000; k++) {
        double x = ldexp(random_uniform(&s, -1, 1), (int)(random_next(&s) % 340) - 170);
        double down = box8_round_down(x), up = box8_round_up(x);
        CHECK(down <= x && x <= up);
        if (fabs(x) < 1e38) CHECK(x - down <= 1e-6 * fabs(x) + 1e-40 && up - x <= 1e-6 * fabs(x) + 1e-40);
    }
    CHECK(box8_round_down(0) <= 0 && box8_round_up(0) >= 0);
    // A box with an end that a node would cut off is no seen box: it may not overlap what it seems to overlap there.
    const double ends[6] = {0, 0, 0, 1, 1, 1}, far[6] = {0, 0, 0, 1, 1, 1e45};
    box8_walk walk;
    box8_begin_new(&walk, NULL, ends, far);
    for (int k = 0; k < 3; k++) CHECK(walk.seen_low[k] > walk.seen_high[k]);
}

// Boxes at powers of 1.5, added one after another, make a chain. It has wide nodes as long as no path is too long.
static void test_chain(uint32_t count) {
    static tree_node chain[2 * 1200 + 2];
    static uint32_t leaf[1200];
    static box8 of_chain[1200 * 4 / 7 + 2];
    dynamic_tree t;
    dynamic_tree_make(&t, chain, 1200);
    t.wide = of_chain;
    double x = 1e50;
    for (uint32_t i = 0; i < count; i++, x /= 1.5) dynamic_tree_add(&t, i, &(box){{x, -x, -x}, {1.2 * x, x, x}}, leaf);
    wide_tree_build(&t);
    CHECK_EQ(t.wide_count > 0, count < 430);
    box all = {{-1e50, -1e50, -1e50}, {1e50, 1e50, 1e50}};
    found f = {.count = 0};
    CHECK(dynamic_tree_find_overlaps(&t, &all, count_leaf, &f));
    CHECK_EQ(f.count, count);
}

// The distance of two boxes is below the true one, in exact integers: coordinates below 2^20, so that squares and sums
// are exact, and the root is compared by its square.
static void test_distance(void) {
    uint64_t s = 8;
    for (int k = 0; k < 100000; k++) {
        double range = k % 2 ? 1e3 : 0x1p20;
        vec3 p = {floor(random_uniform(&s, 0, range)), floor(random_uniform(&s, 0, range)),
                  floor(random_uniform(&s, 0, range))};
        vec3 q = {-floor(random_uniform(&s, 1, range)), -floor(random_uniform(&s, 1, range)), k % 3 ? p.z : 0};
        box a = {p, vec3_add(p, (vec3){1, 2, 3})}, b = {vec3_sub(q, (vec3){3, 2, 0}), q};
        double square = vec3_norm_squared(vec3_sub(p, q)), d = box_compute_distance(&a, &b);
        // d^2 <= square, without rounding: d^2 = high + low.
        double high = d * d, low = fma(d, d, -high);
        CHECK(high < square || (high == square && low <= 0));
        CHECK_LE(square * (1 - 1e-14), high);
    }
}

// All pairs of 40 bodies, ignored and taken back at random, and whole bodies that go.
static void test_ignored(void) {
    enum { N = 40, CAPACITY = 1024 };
    static uint64_t keys[CAPACITY];
    static uint8_t table[N][N];
    memset(keys, 0xff, sizeof keys);
    ignored set = {.keys = keys, .capacity = CAPACITY};
    uint64_t s = 9;
    size_t count = 0;
    for (int k = 0; k < 20000; k++) {
        uint32_t a = (uint32_t)(random_next(&s) % N), b = (uint32_t)(random_next(&s) % N);
        if (a == b) continue;
        uint8_t *is_in = a < b ? &table[a][b] : &table[b][a];
        if (random_next(&s) % 400 == 0) {
            ignored_remove_body(&set, a);
            for (uint32_t i = 0; i < N; i++) {
                count -= table[a][i] + table[i][a];
                table[a][i] = table[i][a] = 0;
            }
        } else if (count < CAPACITY / 2 && random_next(&s) % 2) {
            CHECK_EQ(ignored_add(&set, key_make(a, b)), !*is_in);
            count += !*is_in;
            *is_in = 1;
        } else {
            CHECK_EQ(ignored_remove(&set, key_make(b, a)), *is_in);
            count -= *is_in;
            *is_in = 0;
        }
        CHECK_EQ(set.count, count);
        for (int j = 0; j < 8; j++) {
            uint32_t x = (uint32_t)(random_next(&s) % N), y = (uint32_t)(random_next(&s) % N);
            if (x != y) CHECK_EQ(ignored_is_in(&set, key_make(x, y)), x < y ? table[x][y] : table[y][x]);
        }
    }
}

static void test_sort(void) {
    static uint64_t keys[2000], scratch[2000];
    uint64_t s = 10;
    for (int k = 0; k < 60; k++) {
        uint64_t sum = 0, sorted_sum = 0, mask = ~0ull >> k;
        for (int i = 0; i < 2000; i++) sum += keys[i] = random_next(&s) & mask;
        radix_sort(keys, scratch, 2000);
        for (int i = 0; i < 2000; i++) sorted_sum += keys[i];
        for (int i = 1; i < 2000; i++)
            if (keys[i - 1] > keys[i]) CHECK(!"sorted");
        CHECK(sum == sorted_sum);
    }
}

int main(void) {
    test_tree();
    test_rounding();
    test_chain(6);
    test_chain(400);
    test_chain(600);
    test_chain(1150);
    check_seed = 0;
    test_distance();
    test_ignored();
    test_sort();
    return check_end();
}
