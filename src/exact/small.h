// The exact search of small bodies: after the spheres, before any ellipsoid. With few vertices a support costs less
// than the ellipsoids' direction, and most of a query's time is what goes on around the search; so it works in the
// world's axes, where the bodies are when the spheres are done, in one kernel (simd/small_gjk.h), and its answer is
// made from the kernel's corners at once.
//
// Errors (docs/error-analysis.md): as in reject.h, FRAME_REJECT.
#ifndef OVOID_EXACT_SMALL_H
#define OVOID_EXACT_SMALL_H

#include "pair/reject.h"
#include "simd/small_gjk.h"

#include <string.h>

/// Most vertices of a body: of a couple in lanes; of a pair alone, for a yes or no, and for a distance. A yes or no of
/// more is as often decided by the outer ellipsoids.
enum { SMALL_POINTS = 32, SMALL_POINTS_SIGN = 48, SMALL_POINTS_DISTANCE = 64 };

/// What the search found: bounds that answer the query, and what proves them.
typedef struct small_end {
    double lower;
    vec3 normal; ///< of the lower bound: unit, world
    double upper;
    /// Differences in the world's axes with weights: of the nearest point, or of the origin inside. Indices and weights
    /// of those that do not count are zero, so that sums run over all.
    simplex points;
    vec3 inner;            ///< INNER: the common point, A's body frame; else zero
    int has_witness;       ///< witness points are known: those of `points`, or of INNER
    vec3 point_a, point_b; ///< if so: world
    ovoid_proof_kind kind; ///< POINTS, HULL or INNER
    ovoid_stage stage;
    uint32_t iterations;
} small_end;

/// Sets the first of the weights, all others and all indices to zero: the weights in one, as they are copied from
/// there.
static inline void simplex_clear(simplex *points, double first) {
    const double weight[4] = {first, 0, 0, 0};
    memcpy(points->weight, weight, sizeof weight);
    for (int i = 0; i < 4; i++) points->p[i].a = points->p[i].b = 0;
    points->count = 0;
}

/// Sets the difference of vertices a and b as the proof of the upper bound.
static inline void small_end_set_corner(small_end *end, vec3 w, uint32_t a, uint32_t b) {
    simplex_clear(&end->points, 1);
    end->points.p[0] = (difference){w, a, b};
    end->points.count = 1;
    end->kind = OVOID_PROOF_POINTS;
    end->inner = (vec3){0, 0, 0};
    end->has_witness = 0;
}

/// A query whose pair is placed in the world, once the enclosing spheres have left it open.
typedef struct placed_query {
    const pair_frame *frame; ///< as frame_place makes it
    const query_goal *goal;
    const ovoid_proof *earlier; ///< of an earlier call, or NULL; it may hold any bytes
    double sphere_gap;          ///< the lower bound of reject_by_spheres
    int is_bare;                ///< no proof is wanted: closed_run leaves end->points as they are
} placed_query;

/// 1 if both bodies have at most that many vertices and no allowance, and no depth is asked for. sphere_gap: the lower
/// bound of reject_by_spheres.
static inline int small_has(const query_goal *goal, const ovoid_shape *a, const ovoid_shape *b, double sphere_gap,
                            uint32_t most) {
    int is_small = (a->padded_count <= most) & (b->padded_count <= most) & !(a->has_allowance | b->has_allowance);
    return is_small & (!goal->wants_depth | (sphere_gap > 0));
}

/// 1 if the pair is one for small_run, alone and in lanes.
static inline int small_takes(const query_goal *goal, const ovoid_shape *a, const ovoid_shape *b, double sphere_gap) {
    return small_has(goal, a, b, sphere_gap, goal->far < INFINITY ? SMALL_POINTS_SIGN : SMALL_POINTS_DISTANCE);
}
static inline int small_fits(const query_goal *goal, const ovoid_shape *a, const ovoid_shape *b, double sphere_gap) {
    return small_has(goal, a, b, sphere_gap, SMALL_POINTS);
}

/// Searches from the line of centres, by the inner ellipsoids first where the spheres overlap much, without the earlier
/// proof. 1: answered; 0: unusual, and nothing is known.
int small_run(const placed_query *query, small_end *end);

/// 1 where the spheres overlap so deeply that the inner ellipsoids are likely to overlap too. reach: the sum of the
/// spheres' radii.
static inline int small_tries_inner(double sphere_gap, double reach) { return sphere_gap < -0.4 * reach; }

/// The pair as the kernel takes it, from the line of centres.
small_gjk_query small_make_query(const pair_frame *frame, const query_goal *goal);

/// small_run in parts, for searches in lanes. Before the kernel's search: 1 if the inner ellipsoids have a common
/// point, which answers the query; the end at one that is known, in A's body frame. After it: 1: answered, 0: unusual;
/// small_end_at_hull: of four differences around the origin, of which nothing is known but the vertices.
/// Of the frame small_end_at_inner reads the line of centres, small_finish the size, what is hidden and the radii.
int small_run_inner(const placed_query *query, small_end *end);
void small_end_at_inner(const placed_query *query, vec3 common, double upper, small_end *end);
int small_end_at_hull(const placed_query *query, const uint32_t a[4], const uint32_t b[4], small_end *end);
int small_finish(const pair_frame *frame, const query_goal *goal, const small_gjk_result *result, small_end *end);

typedef enum small_outcome {
    SMALL_ANSWERED,
    SMALL_REJECTED, ///< along the earlier proof's normal
    SMALL_OPEN,     ///< searched, unusual: as small_run's 0
    SMALL_UNKNOWN   ///< the earlier proof says nothing of the pair as it is now; nothing was searched
} small_outcome;

/// For a pair that fits: what the earlier proof shows of it now, and for bodies that were apart a search that goes on
/// from there. found: as reject_by_spheres left it; if REJECTED is returned, the rejection.
small_outcome small_run_earlier(const placed_query *query, rejection *found, small_end *end);

#endif
