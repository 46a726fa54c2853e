// The dynamic tree once more, eight boxes to a node in single precision, for the search of all leaves that overlap a
// box. It follows the binary tree's boxes; a leaf that is added or removed makes it void, until it is made anew.
#ifndef OVOID_WORLD_TREE_WIDE_TREE_H
#define OVOID_WORLD_TREE_WIDE_TREE_H

#include "world/tree/dynamic_tree.h"

/// Room for so many wide nodes is enough for a tree of so many leaves: each has eight children, or leaves alone, at
/// least two; so at most half of the leaves' number hold leaves alone, and a seventh of that the others.
static inline size_t wide_tree_get_capacity(uint32_t leaf_count) { return (size_t)leaf_count * 4 / 7 + 2; }

/// Makes the tree's wide nodes anew; there must be room. None are made of a tree that is too deep or too large.
void wide_tree_build(dynamic_tree *t);

/// The box of a node of the binary tree, where it has a place among the wide ones.
static inline void wide_tree_set_box(dynamic_tree *t, const tree_node *n) {
    if (!t->wide_count || n->link == NONE) return;
    box8 *wide = &t->wide[n->link / BOX8];
    uint32_t i = n->link % BOX8;
    const double *low = &n->bounds.min.x, *high = &n->bounds.max.x;
    for (int k = 0; k < 3; k++) {
        wide->low[k][i] = box8_round_down(low[k]);
        wide->high[k][i] = box8_round_up(high[k]);
    }
}

#endif
