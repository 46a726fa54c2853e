// Building a tree from the top: the leaves of a node are sorted into bins along the longest axis of their centres, and
// cut where the sum of surface times count on both sides is least; in the middle where all are in one bin, or where the
// tree is already deep. Cost: n log n.
#include "world/tree/dynamic_tree.h"

// From depth DEEP on nodes are cut in halves, so that no path is longer than DEEP + 32.
enum { BINS = 16, DEEP = 80, STACK = DEEP + 40 };

typedef struct range {
    uint32_t first, end, node, depth;
} range;

typedef struct bin {
    box bounds;
    uint32_t count;
} bin;

// Twice a centre: it is only compared and put into bins.
static double center(const box *b, int axis) {
    return axis == 0 ? b->min.x + b->max.x : axis == 1 ? b->min.y + b->max.y : b->min.z + b->max.z;
}

// The longest axis of the centres and their extent along it; 0 if all centres are equal.
static double find_axis(const tree_item *items, range r, int *axis, double *low) {
    double best = 0;
    *axis = 0;
    *low = 0;
    for (int k = 0; k < 3; k++) {
        double least = INFINITY, most = -INFINITY;
        for (uint32_t i = r.first; i < r.end; i++) {
            double c = center(&items[i].bounds, k);
            least = min2(least, c);
            most = max2(most, c);
        }
        if (most - least > best) {
            best = most - least;
            *axis = k;
            *low = least;
        }
    }
    return best;
}

static uint32_t find_bin(const box *b, int axis, double low, double scale) {
    double at = (center(b, axis) - low) * scale;
    return at >= BINS - 1 ? BINS - 1 : at > 0 ? (uint32_t)at : 0;
}

// The cut after the bin with the least cost, or -1 if all are in one bin.
static int find_cut(const bin *bins) {
    double right_cost[BINS];
    box right = box_make_empty();
    uint32_t count = 0;
    for (int i = BINS - 1; i > 0; i--) {
        right = box_join(&right, &bins[i].bounds);
        count += bins[i].count;
        right_cost[i] = count ? box_compute_surface(&right) * count : INFINITY;
    }
    box left = box_make_empty();
    int best = -1;
    double least = INFINITY;
    count = 0;
    for (int i = 0; i + 1 < BINS; i++) {
        left = box_join(&left, &bins[i].bounds);
        count += bins[i].count;
        double cost = count ? box_compute_surface(&left) * count + right_cost[i + 1] : INFINITY;
        if (cost < least) {
            least = cost;
            best = i;
        }
    }
    return best;
}

// Partitions the items in two; returns where the second half begins.
static uint32_t divide(tree_item *items, range r) {
    uint32_t middle = r.first + (r.end - r.first) / 2;
    int axis;
    double low, span = find_axis(items, r, &axis, &low), scale = BINS / span;
    if (r.depth >= DEEP || !(span > 0) || !(scale < INFINITY) || r.end - r.first <= 2) return middle;
    bin bins[BINS];
    for (int i = 0; i < BINS; i++) bins[i] = (bin){box_make_empty(), 0};
    for (uint32_t i = r.first; i < r.end; i++) {
        bin *b = &bins[find_bin(&items[i].bounds, axis, low, scale)];
        b->bounds = box_join(&b->bounds, &items[i].bounds);
        b->count++;
    }
    int cut = find_cut(bins);
    if (cut < 0) return middle;
    uint32_t left = r.first, right = r.end;
    while (left < right) {
        if (find_bin(&items[left].bounds, axis, low, scale) <= (uint32_t)cut) {
            left++;
        } else {
            tree_item swapped = items[--right];
            items[right] = items[left];
            items[left] = swapped;
        }
    }
    return left > r.first && left < r.end ? left : middle;
}

static box join_all(const tree_item *items, range r) {
    box all = items[r.first].bounds;
    for (uint32_t i = r.first + 1; i < r.end; i++) all = box_join(&all, &items[i].bounds);
    return all;
}

void dynamic_tree_build(dynamic_tree *t, tree_item *items, uint32_t count, uint32_t *leaf_of) {
    box8 *wide = t->wide;
    dynamic_tree_make(t, t->nodes, t->capacity);
    t->wide = wide;
    t->leaf_count = count;
    if (!count) return;
    range stack[STACK];
    uint32_t depth = 0;
    range r = {0, count, 0, 0};
    for (;;) {
        tree_node *n = &t->nodes[r.node];
        uint32_t parent = r.node ? n->parent : NONE;
        *n = (tree_node){.bounds = join_all(items, r), .parent = parent, .body = NONE};
        if (r.end - r.first > 1) {
            uint32_t cut = divide(items, r), couple = t->used;
            t->used += 2;
            n->child = couple;
            t->nodes[couple].parent = t->nodes[couple + 1].parent = r.node;
            stack[depth++] = (range){cut, r.end, couple + 1, r.depth + 1};
            r = (range){r.first, cut, couple, r.depth + 1};
            continue;
        }
        n->body = items[r.first].body;
        leaf_of[n->body] = r.node;
        if (!depth) break;
        r = stack[--depth];
    }
    t->built = dynamic_tree_compute_cost(t);
}
