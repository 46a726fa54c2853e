// A wide node represents a node of the binary tree. To find its children, the child so far with the largest surface is
// replaced by its own two, until there are eight or all of them are leaves.
#include "world/tree/wide_tree.h"

// The largest number of wide nodes: a larger lane number would not fit in a node's link.
enum { WIDE_MOST = (1u << 31) / BOX8 - 1 };

// A node of the binary tree whose wide node is not made yet, and the lane that will name it.
typedef struct waiting {
    uint32_t node, depth, link;
} waiting;

// Node numbers of the children.
typedef struct family {
    uint32_t node[BOX8];
    double surface[BOX8]; // of leaves -1
    uint32_t count;
} family;

static void put(const dynamic_tree *t, family *f, uint32_t i, uint32_t node) {
    const tree_node *n = &t->nodes[node];
    f->node[i] = node;
    f->surface[i] = n->child ? box_compute_surface(&n->bounds) : -1;
}

static family find_children(dynamic_tree *t, uint32_t root) {
    family f = {.count = 0};
    if (t->nodes[root].child) {
        put(t, &f, 0, t->nodes[root].child);
        put(t, &f, 1, t->nodes[root].child + 1);
        f.count = 2;
    } else {
        put(t, &f, 0, root);
        f.count = 1;
    }
    while (f.count < BOX8) {
        uint32_t largest = 0;
        for (uint32_t i = 1; i < f.count; i++)
            if (f.surface[i] > f.surface[largest]) largest = i;
        tree_node *n = &t->nodes[f.node[largest]];
        if (!n->child) break;
        n->link = NONE;
        put(t, &f, largest, n->child);
        put(t, &f, f.count++, n->child + 1);
    }
    return f;
}

// A box of NaN overlaps nothing; an empty box would overlap one whose ends are beyond all floats.
static void clear(box8 *wide) {
    *wide = (box8){.leaves = 0};
    for (int i = 0; i < BOX8; i++) wide->low[0][i] = NAN;
}

// Makes a wide node; those of its children are pushed. Returns the number of waiting nodes.
static uint32_t make_node(dynamic_tree *t, uint32_t own, const waiting *entry, waiting *stack, uint32_t waits) {
    family f = find_children(t, entry->node);
    box8 *wide = &t->wide[own];
    clear(wide);
    for (uint32_t i = 0; i < f.count; i++) {
        tree_node *n = &t->nodes[f.node[i]];
        n->link = own * BOX8 + i;
        wide_tree_set_box(t, n);
        if (n->child) {
            stack[waits++] = (waiting){f.node[i], entry->depth + 1, n->link};
        } else {
            wide->leaves |= 1u << i;
            wide->child[i] = f.node[i];
        }
    }
    return waits;
}

void wide_tree_build(dynamic_tree *t) {
    waiting stack[BOX8_DEPTH * (BOX8 - 1) + 1];
    uint32_t waits = 0, made = 0;
    t->wide_count = 0;
    if (!t->leaf_count || wide_tree_get_capacity(t->leaf_count) > WIDE_MOST) return;
    t->nodes[0].link = NONE;
    stack[waits++] = (waiting){0, 1, NONE};
    while (waits) {
        waiting entry = stack[--waits];
        if (entry.depth > BOX8_DEPTH) {
            t->wide_count = 0;
            return;
        }
        t->wide_count = made + 1;
        if (entry.link != NONE) t->wide[entry.link / BOX8].child[entry.link % BOX8] = made;
        waits = make_node(t, made++, &entry, stack, waits);
    }
}
