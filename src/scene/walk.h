// Walks through the tree: the nearest first, up to a bound that may fall on the way; and all that overlaps a box.
#ifndef OVOID_SCENE_WALK_H
#define OVOID_SCENE_WALK_H

#include "scene/broad.h"

/// No more than how far away anything in the box is, in whatever is to be least; INFINITY: out of the question.
typedef double walk_measure(const void *context, const box *bounds);
/// Looks at a leaf.
typedef void walk_visit(void *context, uint32_t body);

typedef struct walk {
    const broad *tree;
    walk_measure *measure;
    walk_visit *visit;
    void *context;
    double *bound; ///< what is measured above it is passed over
} walk;

void walk_run(const walk *x);

/// Looks at a leaf whose box overlaps; 0 ends the walk.
typedef int walk_touch(void *context, const broad_node *leaf);

/// walk_touching below a node of a tree deeper than its stack.
int walk_touching_below(const broad *t, const box *bounds, uint32_t root, walk_touch *touch, void *context);

/// All leaves whose boxes overlap the bounds; 0 where a leaf ended the walk. Inline, so that `touch` is, too. Both
/// children are looked at together and pushed without a branch: which of them overlap cannot be predicted.
static inline int walk_touching(const broad *t, const box *bounds, walk_touch *touch, void *context) {
    const broad_node *nodes = t->nodes;
    uint32_t stack[BROAD_STACK + 2], count = t->leaf_count && box_is_overlapping(bounds, &nodes[0].bounds);
    stack[0] = 0;
    while (count) {
        const broad_node *n = &nodes[stack[--count]];
        if (!n->child) {
            if (!touch(context, n)) return 0;
        } else if (count >= BROAD_STACK) {
            if (!walk_touching_below(t, bounds, (uint32_t)(n - nodes), touch, context)) return 0;
        } else {
            stack[count] = n->child;
            count += (uint32_t)box_is_overlapping(bounds, &nodes[n->child].bounds);
            stack[count] = n->child + 1;
            count += (uint32_t)box_is_overlapping(bounds, &nodes[n->child + 1].bounds);
        }
    }
    return 1;
}

#endif
