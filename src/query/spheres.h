// Queries of two spheres, which need no rotation: from the pair to the answer at once.
#ifndef OVOID_QUERY_SPHERES_H
#define OVOID_QUERY_SPHERES_H

#include "query/answer.h"

/// 1 for the centre of the body frame and a radius.
static inline int sphere_is_plain(const ovoid_shape *s) {
    return (s->vertex_count == 1) & !(s->has_origin | s->has_allowance) & !(s->extent > 0);
}

/// 1 if both bodies are spheres around the origins of their frames.
static inline int spheres_fit(const ovoid_pair *pair) {
    const ovoid_shape *a = pair->shape_a, *b = pair->shape_b;
    return a && b && sphere_is_plain(a) && sphere_is_plain(b);
}

/// answer_find_by_value, the same bits, of a pair that fits. Cost: a third of that.
COMPILER_NOINLINE ovoid_answer spheres_find(const ovoid_pair *pair, const query_request *request);

#endif
