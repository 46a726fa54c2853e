// Traversals of the tree: the nearest leaves first, up to a bound that may fall on the way; and all leaves that overlap
// a box.
#ifndef OVOID_WORLD_TREE_DYNAMIC_TREE_TRAVERSE_H
#define OVOID_WORLD_TREE_DYNAMIC_TREE_TRAVERSE_H

#include "world/tree/dynamic_tree.h"

/// A lower bound, over all bodies in the box, of the quantity that is minimised; INFINITY: none of them counts.
typedef double tree_measure(const void *context, const box *bounds);
/// Called for a leaf.
typedef void tree_visit(void *context, uint32_t body);

typedef struct tree_traversal {
    const dynamic_tree *tree;
    tree_measure *measure;
    tree_visit *visit;
    void *context;
    double *bound; ///< nodes that measure above it are skipped
} tree_traversal;

void dynamic_tree_find_nearest(const tree_traversal *traversal);

/// Called for a leaf whose box overlaps; 0 ends the traversal.
typedef int tree_touch(void *context, const tree_node *leaf);

/// dynamic_tree_find_overlaps below a node of a tree deeper than its stack.
int dynamic_tree_find_overlaps_below(const dynamic_tree *t, const box *bounds, uint32_t root, tree_touch *touch,
                                     void *context);

/// The number of leaves that the wide nodes return at once.
enum { TREE_LEAVES = 64 };

/// The traversal by the wide nodes, begun by the caller; `next` goes on with it. The wide nodes' boxes are larger by a
/// rounding, so each leaf's own box is compared too.
static inline int dynamic_tree_find_wide(const dynamic_tree *t, const box *bounds, box8_walk *walk, box8_next *next,
                                         tree_touch *touch, void *context) {
    uint32_t leaves[TREE_LEAVES], count;
    while ((count = next(walk, leaves, TREE_LEAVES)) > 0)
        for (uint32_t i = 0; i < count; i++) {
            const tree_node *leaf = &t->nodes[leaves[i]];
            if (box_is_overlapping(bounds, &leaf->bounds) && !touch(context, leaf)) return 0;
        }
    return 1;
}

/// The traversal by the binary tree. Both children are tested and pushed without a branch, since it cannot be predicted
/// which of them overlap.
static inline int dynamic_tree_find_narrow(const dynamic_tree *t, const box *bounds, tree_touch *touch, void *context) {
    const tree_node *nodes = t->nodes;
    uint32_t stack[TREE_STACK + 2], count = t->leaf_count && box_is_overlapping(bounds, &nodes[0].bounds);
    stack[0] = 0;
    while (count) {
        const tree_node *n = &nodes[stack[--count]];
        if (!n->child) {
            if (!touch(context, n)) return 0;
        } else if (count >= TREE_STACK) {
            if (!dynamic_tree_find_overlaps_below(t, bounds, (uint32_t)(n - nodes), touch, context)) return 0;
        } else {
            stack[count] = n->child;
            count += (uint32_t)box_is_overlapping(bounds, &nodes[n->child].bounds);
            stack[count] = n->child + 1;
            count += (uint32_t)box_is_overlapping(bounds, &nodes[n->child + 1].bounds);
        }
    }
    return 1;
}

/// All leaves whose boxes overlap the bounds; 0 if a leaf ended the traversal. `touch` may make the bounds smaller.
/// Inline, so that `touch` is inlined too.
static inline int dynamic_tree_find_overlaps(const dynamic_tree *t, const box *bounds, tree_touch *touch,
                                             void *context) {
    if (!t->wide_count) return dynamic_tree_find_narrow(t, bounds, touch, context);
    box8_walk walk;
    box8_begin(&walk, t->wide, &bounds->min.x);
    return dynamic_tree_find_wide(t, bounds, &walk, box8_find_leaves, touch, context);
}

/// dynamic_tree_find_overlaps, but leaves that overlap `seen` too may be left out, except those that
/// wide_tree_set_fresh has named: mostly these are not even read.
static inline int dynamic_tree_find_new(const dynamic_tree *t, const box *bounds, const box *seen, tree_touch *touch,
                                        void *context) {
    if (!t->wide_count) return dynamic_tree_find_narrow(t, bounds, touch, context);
    box8_walk walk;
    box8_begin_new(&walk, t->wide, &bounds->min.x, &seen->min.x);
    return dynamic_tree_find_wide(t, bounds, &walk, box8_find_new_leaves, touch, context);
}

#endif
