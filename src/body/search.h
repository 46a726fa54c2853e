// The search for the pair of leaves that decides a query of two bodies: its state, and what all kinds of bodies have in
// common. A kind of search (search_kind) knows the bounds of nodes and how its leaves are queried; the traversal
// (traverse.h) is one.
#ifndef OVOID_BODY_SEARCH_H
#define OVOID_BODY_SEARCH_H

#include "body/clearance.h"
#include "body/exclusions.h"
#include "body/node_bounds.h"
#include "query/answer.h"

/// A pair of leaves that may decide: its bracket, and the direction in the world that shows the lower end.
typedef struct leaf_pair {
    uint32_t place_a, place_b;
    double lower, upper;
    vec3 normal, normal_low;
} leaf_pair;

/// A pair of nodes or leaves that waits, with its bound, in 16 bytes. Its reason, what shows the bound as its kind of
/// search numbers it, is in six bits that the numbers of nodes and leaves leave free.
typedef struct waiting_pair {
    uint32_t tagged_a, tagged_b;
    double lower;
} waiting_pair;

enum { SEARCH_REASONS = 64, TAG_SHIFT = 28, TAG_MASK = 7 };
#define TAG_BITS ((uint32_t)TAG_MASK << TAG_SHIFT)
_Static_assert(OVOID_SOLID_TRIANGLES_MAX <= (size_t)1 << TAG_SHIFT, "the number of a triangle or node has room");
_Static_assert(2 * OVOID_COMPOUND_PARTS_MAX <= (size_t)1 << TAG_SHIFT, "the number of a part's node has room");
_Static_assert(SEARCH_REASONS <= (TAG_MASK + 1) * (TAG_MASK + 1), "the number of a reason has room");

static inline waiting_pair waiting_make(tree_ref a, tree_ref b, double lower, uint32_t reason) {
    uint32_t low = reason & TAG_MASK, high = reason / (TAG_MASK + 1);
    return (waiting_pair){a | low << TAG_SHIFT, b | high << TAG_SHIFT, lower};
}
static inline tree_ref waiting_get_a(const waiting_pair *w) { return w->tagged_a & ~TAG_BITS; }
static inline tree_ref waiting_get_b(const waiting_pair *w) { return w->tagged_b & ~TAG_BITS; }
static inline uint32_t waiting_get_reason(const waiting_pair *w) {
    return (w->tagged_b >> TAG_SHIFT & TAG_MASK) * (TAG_MASK + 1) + (w->tagged_a >> TAG_SHIFT & TAG_MASK);
}
/// 1 if both are leaves.
static inline int waiting_is_leaves(const waiting_pair *w) { return ref_is_leaf(w->tagged_a & w->tagged_b); }

struct waiting;
struct body_search;

/// What a search is made of. The traversal is compiled for each kind with these functions as constants.
typedef struct search_kind {
    /// The pair of roots with its bound; a bound above `enough` need not be the best.
    waiting_pair (*bound_roots)(const struct body_search *state, double enough);
    /// The exclusion of a pair whose bound says that it cannot decide.
    void (*leave_out)(struct body_search *state, const waiting_pair *pair);
    /// A pair of leaves.
    void (*visit_leaves)(struct body_search *state, const waiting_pair *pair);
    /// Replaces the larger node of a pair by its children.
    void (*open)(struct body_search *state, const waiting_pair *pair, struct waiting *waiting);
    /// Traverses from the roots down: search_traverse with this kind.
    void (*traverse)(struct body_search *state);
    /// A pair of leaves of which the bracket is known: search_take, and what the kind notes of it. 1: the best pair.
    int (*take)(struct body_search *state, const leaf_pair *pair);
    /// Two leaves, by their places, that no bound leaves out: search_query_new, or what else is asked of each pair.
    void (*query_leaves)(struct body_search *state, uint32_t a, uint32_t b);
} search_kind;

/// Of two bodies without a solid.
typedef struct parts_state {
    const compound_node *nodes[2]; ///< of a and of b
    const compound_part *parts[2];
    compound_node own_node; ///< the tree of a shape beside a compound
    compound_part own_part;
    nodes_other turned;        ///< a node along the axes of the other body, shared by several of its nodes
    parts_direction direction; ///< of the best pair
} parts_state;

/// Of two bodies with a solid.
typedef struct solids_state {
    triangle_shape rooms[2];
    const solid8_kernels *kernels;
    box_gap roots; ///< of the boxes of both roots, before there is a normal to try
    // Normals of best pairs, in a's frame; the last one is tried on all boxes. A pair that waits knows which one its
    // bound may rest on.
    vec3 normals[SEARCH_REASONS];
    uint32_t normal_count;
    flush_pairs flush; ///< of the pairs of leaves that may touch, as many as there is room for
    // Of a solid and a shape: the direction of the best pair, from the solid to the shape in the solid's frame, and the
    // shape's least extent along it.
    vec3 filter;
    double filter_support;
} solids_state;

typedef struct body_search {
    body_tree a, b;
    tree_frame frame;
    const search_kind *kind;
    int has_solid;
    ovoid_options options;       ///< of the queries of pairs of leaves
    query_goal whole_goal, goal; ///< the query's goal, and what is left of it: once a margin is met, the sign
    double tolerance, allowance; ///< of the bodies; the latter is not in the former
    double slack;                ///< a pair is looked at if its bound is below the best upper bound by more than this
    double least_far;            ///< the least `far`: what containment is decided by
    double far;                  ///< bounds above this are left out
    double enough;               ///< bounds from here on are left out: at least the best pair's upper bound less slack
    double lower;                ///< the least bound of all that was left out
    ovoid_exclusions *exclusions;
    ovoid_body_answer *out; ///< its `deciding` is of the best pair where is_answered
    leaf_pair best;
    int has_best, is_answered;
    uint32_t warm_a, warm_b; ///< the pair of the earlier answer, or the counts of leaves
    ovoid_limit trouble;     ///< why a pair's bracket stayed wide, or NONE
    // The pair of leaves queried last, in the world.
    ovoid_pair pair;
    uint32_t posed_a, posed_b;
    ovoid_answer spare;
    // The one that the kind needs; it is on the stack of who asks, since that of solids takes kilobytes.
    parts_state *parts;
    solids_state *solids; ///< NULL where no body is a solid
} body_search;

static inline int search_is_left_out(const body_search *state, double lower) {
    return lower > state->far || lower >= state->enough;
}
/// 1 if nothing that is left can change the answer: the best pair overlaps, and no depth is wanted.
static inline int search_is_decided(const body_search *state) {
    return state->has_best && state->best.upper < 0 && !state->goal.wants_depth;
}

/// The state before the first pair; the trees, the frame, the options and tolerances, kind and out are set.
void search_begin(body_search *state, const query_goal *goal);
/// From the pair of an earlier answer (or NULL) and the roots to the answer's `deciding` and parts.
void search_run(body_search *state, const ovoid_body_proof *earlier);

/// Leaves out the leaves of an exclusion, or two leaves by their bracket.
void search_exclude(body_search *state, const ovoid_exclusion *x);
void search_exclude_leaves(body_search *state, const leaf_pair *pair);
/// Takes a pair of leaves as the best, 1, or leaves it out, 0.
int search_take(body_search *state, const leaf_pair *pair);
/// Queries two leaves in full, and takes them; earlier may be NULL.
void search_query_leaves(body_search *state, uint32_t a, uint32_t b, const ovoid_proof *earlier);
void search_query_new(body_search *state, uint32_t a, uint32_t b);
/// The leaves at two places, in the world, until the next call.
const ovoid_pair *search_pose_leaves(body_search *state, uint32_t a, uint32_t b);
/// The limit of a bracket with that status.
ovoid_limit search_find_limit(const body_search *state, double lower, double upper, ovoid_status status);

/// The kinds of search, of bodies without a solid and with one.
extern const search_kind parts_kind, solids_kind;

/// Begins a search of two bodies without a solid, not both shapes, whose trees and options are made.
void parts_begin(body_search *state, const query_goal *goal);
#endif
