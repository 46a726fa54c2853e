// The manifolds of two bodies for callers inside a public function, with room wherever the caller has it.
#ifndef OVOID_BODY_MANIFOLDS_BODY_CONTACTS_H
#define OVOID_BODY_MANIFOLDS_BODY_CONTACTS_H

#include "body/body_tree.h"
#include "ovoid/body_manifolds.h"

/// Takes each manifold that is found, in the order of the traversal, with its points where they are asked for.
typedef void manifold_taker(void *context, const ovoid_body_manifold *manifold, const ovoid_manifold_points *points);

/// What is asked of two bodies.
typedef struct manifolds_request {
    const ovoid_manifold_options *options; ///< as the caller gave them; NULL: the default
    const ovoid_body_manifold *earlier;    ///< sorted manifolds of an earlier call
    size_t earlier_count;
    int has_points; ///< points are asked for
    manifold_taker *take;
    void *context; ///< of take
} manifolds_request;

/// What is found beside the manifolds.
typedef struct manifolds_found {
    double lower, upper; ///< of the smallest signed distance over all pairs of parts
    uint32_t visited, tested, through;
} manifolds_found;

/// The earlier manifold of the same two parts, or NULL.
const ovoid_manifold *manifolds_request_find_earlier(const manifolds_request *request, const ovoid_body_manifold *of);

/// The pipeline of ovoid_body_manifolds_find; the reason of a refusal.
ovoid_limit body_manifolds_find_internal(const ovoid_body_pair *pair, const manifolds_request *request,
                                         manifolds_found *found);

/// Sorts manifolds by part_a, then part_b, with the points beside them (NULL: none). Of a solid a facet and a part may
/// be found from several triangles: one manifold of them stays, along the facet's normal if there is one. Returns how
/// many there are.
size_t body_manifolds_sort(ovoid_body_manifold *items, ovoid_manifold_points *points, size_t count);

#endif
