// The state of a query of two bodies, and the steps of it: what is left out, pairs of leaves, the traversal.
#ifndef OVOID_SOLID_SEARCH_H
#define OVOID_SOLID_SEARCH_H

#include "body/body_view.h"
#include "body/clearance.h"
#include "body/frame.h"

/// A pair that may decide: its bracket, and the direction in the world that shows the lower end.
typedef struct solid_candidate {
    uint32_t place_a, place_b;
    double lower, upper;
    vec3 normal, normal_low;
} solid_candidate;

/// Most normals that are tried one after another; later best pairs leave the last one.
enum { SEARCH_NORMALS = 64 };

typedef struct solid_search {
    triangle_shape room_a, room_b;
    solid_view a, b;
    solid_frame frame;
    const solid8_kernels *kernels;
    ovoid_options options;       ///< of the queries of pairs
    query_goal whole_goal, goal; ///< the query's goal, and what is left of it: once a margin is met, the sign
    double tolerance, allowance;
    double far;    ///< bounds above this are left out; at least the claim, so that containment can be decided
    double enough; ///< and bounds from here on: at least the best pair's upper bound
    double lower;  ///< the least of what was left out
    ovoid_exclusions *exclusions;
    ovoid_body_answer *out; ///< its `surfaces` are of the best pair where is_answered
    solid_candidate best;
    // Normals of best pairs, in a's frame; the last one is tried on all boxes. A pair that waits knows which one its
    // bound may rest on.
    vec3 normals[SEARCH_NORMALS];
    uint32_t normal_count;
    int has_best, is_answered;
    flush_pairs flush; ///< of the pairs of leaves that may touch, as many as there is room for
    ovoid_limit trouble;
    uint32_t warm_a, warm_b; ///< the pair of the earlier answer, or count_a
    // Of a solid and a shape or a compound: the direction of the best pair, from the solid to the other in the solid's
    // frame, and of a shape its least extent along it.
    vec3 filter;
    double filter_support;
    ovoid_answer spare;
} solid_search;

/// A pair of nodes or triangles that waits, with its bound.
typedef struct waiting_pair {
    solid_ref a, b;
    double lower;
    uint32_t normal; ///< the normal that was tried on it
} waiting_pair;

static inline int search_is_left_out(const solid_search *h, double lower) {
    return lower > h->far || lower >= h->enough;
}
/// 1 if nothing that is left can change the answer: two triangles cross.
static inline int search_is_decided(const solid_search *h) { return h->has_best && h->best.upper < 0; }

/// Leaves out a pair of nodes or triangles, whose bound is that of their boxes, or another one with its normal.
void search_exclude_boxes(solid_search *h, const waiting_pair *w);
void search_exclude(solid_search *h, uint32_t a, uint32_t b, double lower, vec3 normal, vec3 normal_low);

/// Queries two leaves in full, and takes them as the best pair or leaves them out.
void search_visit_leaves(solid_search *h, uint32_t a, uint32_t b, const ovoid_proof *earlier);
/// A pair of leaves of which the bracket is known: the best pair or left out.
void search_take(solid_search *h, const solid_candidate *x);
/// Triangles of the body `side` (0: a) at places, with one triangle of the other, in lanes. count <= 8.
void search_visit_triangles(solid_search *h, int side, uint32_t one, const uint32_t *places, uint32_t count);
/// 1 where two leaves, of which one is no triangle, are left out by the normal of the best pair.
int search_is_filtered(solid_search *h, uint32_t a, uint32_t b);
/// Two leaves as an ordinary pair; triangles are made in the search's rooms.
ovoid_pair search_get_pair(solid_search *h, uint32_t a, uint32_t b);

static inline vec3 search_get_normal(const solid_search *h) { return h->normals[h->normal_count - 1]; }
/// The pair of roots, with its bound.
waiting_pair search_make_roots(const solid_search *h);
/// From the roots down.
void search_traverse(solid_search *h);

#endif
