// A walk through the tree, the nearest first, up to a bound that may fall on the way.
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

#endif
