// The simplex that an earlier proof of a distance holds. Bodies that moved a little since mostly have their nearest
// points on the same vertices, with other weights: then one support along the direction of that point answers the
// query, and no stage before the exact search is asked.
#ifndef OVOID_EXACT_KEPT_H
#define OVOID_EXACT_KEPT_H

#include "exact/small.h"

/// The difference of a proof's entry, in the world's axes. Its indices must be in range.
static inline difference kept_get_difference(const pair_frame *f, const ovoid_proof *p, uint32_t i) {
    vec3 a = vec3_at(shape_vertices(f->a), p->a[i]), b = vec3_at(shape_vertices(f->b), p->b[i]);
    return (difference){frame_world_difference(f, a, b), p->a[i], p->b[i]};
}

/// The one to three differences of a proof that a search may go on from; count 0: there are none, or the proof's normal
/// says more. The proof may hold any bytes.
small_gjk_kept kept_get_simplex(const pair_frame *frame, const query_goal *goal, const ovoid_proof *earlier);

/// Most vertices of both bodies for a distance: the nearest points of larger ones move on to other vertices mostly.
enum { KEPT_VERTICES = 2048 };

/// 1 if kept_run may be asked: for a bracket, of bodies without an allowance. sphere_gap: as in small_fits.
static inline int kept_fits(const query_goal *goal, const ovoid_shape *a, const ovoid_shape *b, double sphere_gap) {
    int is_few = (goal->far < INFINITY) | (a->vertex_count + b->vertex_count <= KEPT_VERTICES);
    return is_few & goal->wants_bracket & !(a->has_allowance | b->has_allowance) &
           (!goal->wants_depth | (sphere_gap > 0));
}

/// Bodies with any number of vertices, which were apart: 1 if the point between the kept differences answers the query.
int kept_run(const placed_query *query, small_end *end);

#endif
