// The dynamic tree of boxes: a binary tree whose leaves are bodies, in one array. Siblings lie side by side, so a node
// names its two children by one index, and is one cache line.
//
// Built from the top by the surface area heuristic in bins (I. Wald, On fast construction of SAH-based bounding volume
// hierarchies, 2007); a leaf that is added goes down to the sibling that costs least surface (E. Catto, Dynamic
// bounding volume hierarchies, GDC 2019); a leaf that changes its box carries the change up as far as it reaches. All
// of it is serial and depends on nothing but the order of the calls.
#ifndef OVOID_SCENE_BROAD_H
#define OVOID_SCENE_BROAD_H

#include "base/allocator.h"
#include "scene/box.h"

#define NONE 0xffffffffu

typedef struct broad_node {
    box bounds;
    uint32_t parent;
    uint32_t child; ///< the first of two; 0: a leaf (of nothing where body is NONE)
    uint32_t body;  ///< of a leaf
    uint32_t next;  ///< of a free couple of nodes: the next one
} broad_node;

/// Node 0 is the root, node 1 is not used; couples (2 k, 2 k + 1) follow.
typedef struct broad {
    broad_node *nodes;
    uint32_t leaf_count, capacity; ///< capacity: leaves that there is room for
    uint32_t used, free;           ///< nodes ever used; the first free couple or 0
    uint32_t changes;              ///< leaves added, removed and put elsewhere since it was built
    double built;                  ///< the cost when it was built
} broad;

/// Bytes of the nodes for that many leaves.
static inline size_t broad_get_size(uint32_t capacity) { return (2 * (size_t)capacity + 2) * sizeof(broad_node); }

/// An empty tree in memory for `capacity` leaves, or the same tree in larger memory. The caller owns the nodes.
void broad_make(broad *t, broad_node *nodes, uint32_t capacity);

/// Adds a leaf; its node goes to leaf_of[body], and so do those of leaves that move in memory.
void broad_add(broad *t, uint32_t body, const box *bounds, uint32_t *leaf_of);
void broad_remove(broad *t, uint32_t leaf, uint32_t *leaf_of);
/// Other bounds for a leaf, where it stands.
void broad_refit(broad *t, uint32_t leaf, const box *bounds);

/// The next node after `at` in the order of a walk that does not go below it; NONE at the end. So a walk needs no
/// stack and a tree may be of any depth:
///     for (at = 0; at != NONE;) at = looks_below ? nodes[at].child : broad_skip(t, at)
static inline uint32_t broad_skip(const broad *t, uint32_t at) {
    while (at & 1u) at = t->nodes[at].parent;
    return at ? at + 1 : NONE;
}

/// What a walk with a stack pushes at most before it goes on without one; no tree that is built is as deep.
enum { BROAD_STACK = 256 };

/// The sum of all inner nodes' surfaces over the root's: what a query looks at.
double broad_compute_cost(const broad *t);

/// What broad_build works in: room for the leaves.
typedef struct broad_item {
    box bounds;
    uint32_t body;
} broad_item;
/// A new tree over `count` leaves; items is overwritten.
void broad_build(broad *t, broad_item *items, uint32_t count, uint32_t *leaf_of);

#endif
