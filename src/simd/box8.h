// A tree of boxes, eight to a node, in single precision, rounded outward: which leaves may overlap a box? All eight are
// compared at once (I. Wald, C. Benthin, S. Boulos, Getting rid of packets: efficient SIMD single-ray traversal using
// multi-branching BVHs, 2008). Comparisons only, so every instruction set finds the same leaves in the same order.
#ifndef OVOID_SIMD_BOX8_H
#define OVOID_SIMD_BOX8_H

#include "linear/box.h"
#include "simd/support.h"

enum { BOX8 = 8 };

/// A node: four cache lines. Lanes that are not used hold a box that overlaps none.
typedef struct box8 {
    _Alignas(64) float low[3][BOX8];
    float high[3][BOX8];
    uint32_t child[BOX8]; ///< a node, or the caller's number of a leaf
    uint32_t leaves;      ///< the lanes that are leaves
    uint32_t fresh;       ///< of these, those that box8_find_new_leaves always returns
} box8;

/// Numbers rounded down and up to single precision: off by a rounding of the product, of the sum and of the conversion,
/// together below 2^-23 |x| + 2^-140. An end beyond the largest float is set to that float.
static inline float box8_round_down(double x) {
    double low = x - ((x < 0 ? -x : x) * 0x1p-22 + 0x1p-140);
    return (float)(low < 0x1p127 ? low : 0x1p127);
}
static inline float box8_round_up(double x) { return -box8_round_down(-x); }
/// A box rounded outward.
static inline void box8_round_out(const box *b, float low[3], float high[3]) {
    for (int k = 0; k < 3; k++) {
        low[k] = box8_round_down(vec3_get(b->min, k));
        high[k] = box8_round_up(vec3_get(b->max, k));
    }
}

/// The box of a lane, rounded outward.
static inline void box8_set_lane(box8 *node, uint32_t lane, const box *b) {
    float low[3], high[3];
    box8_round_out(b, low, high);
    for (int k = 0; k < 3; k++) {
        node->low[k][lane] = low[k];
        node->high[k][lane] = high[k];
    }
}

/// No path from the root of a tree to a leaf is longer.
enum { BOX8_DEPTH = 64 };

/// A traversal: nodes that wait.
typedef struct box8_walk {
    const box8 *nodes;
    float low[3], high[3];           ///< of the box, rounded outward
    float seen_low[3], seen_high[3]; ///< of another box, made smaller by more than a node's roundings
    uint32_t count;
    uint32_t stack[BOX8_DEPTH * (BOX8 - 1) + 1];
} box8_walk;

/// Begins at node 0. The box: x, y, z of its lower, then of its upper ends.
void box8_begin(box8_walk *walk, const box8 *nodes, const double *ends);

/// Begins at node 0, for box8_find_new_leaves: `seen` are the ends of another box, or of an empty one.
void box8_begin_new(box8_walk *walk, const box8 *nodes, const double *ends, const double *seen);

/// Goes on until there is no room for eight leaves more, or nothing waits any more; how many leaves were written.
typedef uint32_t box8_function(box8_walk *walk, uint32_t *leaves, uint32_t room);
uint32_t box8_find_leaves(box8_walk *walk, uint32_t *leaves, uint32_t room);

/// box8_find_leaves without leaves that certainly overlap the other box too, except fresh ones.
uint32_t box8_find_new_leaves(box8_walk *walk, uint32_t *leaves, uint32_t room);

/// How a walk goes on: either of these two.
typedef uint32_t box8_next(box8_walk *walk, uint32_t *leaves, uint32_t room);

/// The kernels of one instruction set, for tests; NULL where this machine or build lacks them, or has no use for them.
box8_function *box8_get(simd_isa isa);
box8_function *box8_get_new(simd_isa isa);

#endif
