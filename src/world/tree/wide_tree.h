// A copy of the dynamic tree with eight boxes to a node in single precision, to search all leaves that overlap a box.
// It follows the binary tree's boxes; adding or removing a leaf invalidates it until it is built again.
#ifndef OVOID_WORLD_TREE_WIDE_TREE_H
#define OVOID_WORLD_TREE_WIDE_TREE_H

#include "world/tree/dynamic_tree.h"

/// The number of wide nodes that is enough for a tree of that many leaves: each node has eight children, or only
/// leaves, at least two; so at most half as many nodes as leaves hold only leaves, and a seventh of those the others.
static inline size_t wide_tree_get_capacity(uint32_t leaf_count) { return (size_t)leaf_count * 4 / 7 + 2; }

/// Builds the tree's wide nodes; there must be room. A tree that is too deep or too large gets none.
void wide_tree_build(dynamic_tree *t);

/// Sets the box of a node of the binary tree in the wide tree, if it has a lane there.
static inline void wide_tree_set_box(dynamic_tree *t, const tree_node *n) {
    if (!t->wide_count || n->link == NONE) return;
    box8_set_lane(&t->wide[n->link / BOX8], n->link % BOX8, &n->bounds);
}

/// Names a leaf as fresh, or no longer (dynamic_tree_find_new).
static inline void wide_tree_set_fresh(dynamic_tree *t, uint32_t leaf, int is_fresh) {
    uint32_t link = t->nodes[leaf].link;
    if (!t->wide_count || link == NONE) return;
    uint32_t *fresh = &t->wide[link / BOX8].fresh, bit = 1u << link % BOX8;
    *fresh = is_fresh ? *fresh | bit : *fresh & ~bit;
}

#endif
