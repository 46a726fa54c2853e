// The dynamic tree of boxes: a binary tree whose leaves are bodies, in one array. Siblings lie side by side, so a node
// names its two children by one index, and is one cache line.
//
// Built from the top by the surface area heuristic in bins (I. Wald, On fast construction of SAH-based bounding volume
// hierarchies, 2007). A new leaf descends to the sibling that costs least surface (E. Catto, Dynamic bounding volume
// hierarchies, GDC 2019). A leaf whose box changes refits its ancestors as far as they change. All of it is serial and
// depends only on the order of the calls.
#ifndef OVOID_WORLD_TREE_DYNAMIC_TREE_H
#define OVOID_WORLD_TREE_DYNAMIC_TREE_H

#include "base/allocator.h"
#include "linear/box.h"
#include "simd/box8.h"

#define NONE 0xffffffffu

typedef struct tree_node {
    box bounds;
    uint32_t parent;
    uint32_t child; ///< the first of two children; 0: a leaf (empty where body is NONE)
    uint32_t body;  ///< of a leaf: its body
    uint32_t link;  ///< of a free couple of nodes: the next free couple; else its lane among the wide nodes, or NONE
} tree_node;

/// Node 0 is the root, node 1 is not used; couples (2 k, 2 k + 1) follow.
typedef struct dynamic_tree {
    tree_node *nodes;
    uint32_t leaf_count, capacity; ///< capacity: most leaves
    uint32_t used, free;           ///< nodes ever used; the first free couple, or 0
    uint32_t changes;              ///< leaves added, removed or moved to another sibling since it was built
    double built;                  ///< the cost when it was built
    box8 *wide;                    ///< the owner's memory for the wide nodes (wide_tree.h)
    uint32_t wide_count;           ///< 0: there are none
} dynamic_tree;

/// An empty tree in memory for `capacity` leaves. The caller owns the nodes.
void dynamic_tree_make(dynamic_tree *t, tree_node *nodes, uint32_t capacity);

/// Adds a leaf; leaf_of[body] receives its node, and is updated for leaves that move in memory.
void dynamic_tree_add(dynamic_tree *t, uint32_t body, const box *bounds, uint32_t *leaf_of);
void dynamic_tree_remove(dynamic_tree *t, uint32_t leaf, uint32_t *leaf_of);
/// Changes the bounds of a leaf and refits its ancestors; the leaf keeps its place in the tree.
void dynamic_tree_refit(dynamic_tree *t, uint32_t leaf, const box *bounds);

/// The next node after `at` in the order of a traversal that does not go below it; NONE at the end. So a traversal
/// needs no stack and a tree may be of any depth:
///     for (at = 0; at != NONE;) at = descends ? nodes[at].child : dynamic_tree_skip(t, at)
static inline uint32_t dynamic_tree_skip(const dynamic_tree *t, uint32_t at) {
    while (at & 1u) at = t->nodes[at].parent;
    return at ? at + 1 : NONE;
}

/// The largest stack of a traversal before it continues without one; no tree that is built is as deep.
enum { TREE_STACK = 256 };

/// The sum of all inner nodes' surfaces over the root's: the expected number of nodes that a query visits.
double dynamic_tree_compute_cost(const dynamic_tree *t);

/// A leaf to build a tree from: its box and body.
typedef struct tree_item {
    box bounds;
    uint32_t body;
} tree_item;
/// Builds a new tree over `count` leaves; items is overwritten.
void dynamic_tree_build(dynamic_tree *t, tree_item *items, uint32_t count, uint32_t *leaf_of);

#endif
