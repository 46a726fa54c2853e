// The yes or no of small couples in single precision, sixteen at a time (simd/float_gjk.h): from the spheres to the
// verdict. Couples wait until there are sixteen for the ellipsoids, then sixteen of like numbers of vertices for the
// search, whose group is filled again when few of its lanes are live. What floats leave open is left to the caller. A
// couple's bits do not depend on the others.
#ifndef OVOID_QUERY_BATCH_FLOATS_H
#define OVOID_QUERY_BATCH_FLOATS_H

#include "query/answer.h"
#include "query/lane_group.h"
#include "shape/floats.h"

/// What is kept of a couple beside its lane.
typedef struct float_couple {
    size_t index;
    const ovoid_shape *a, *b;
    double unit, lower, upper, tolerance; ///< the bounds by the spheres
} float_couple;

/// Couples that wait, or are at work, at most.
enum { FLOAT_WAITING = (FLOAT_GJK_BLOCKS + 1) * (FLOATS - 1) + FLOATS, FLOAT_COUPLES = FLOAT_WAITING + PAIR8 };

/// The state of a batch: 36 KB.
typedef struct batch_floats {
    const float_gjk_kernels *kernels, *alone;
    const query_goal *goal; ///< without the tolerance
    ovoid_verdict *verdicts;
    void (*leave_open)(void *self, size_t index);
    void *self;
    int is_begun; ///< the caller begins with 0, and sets only the members before; what follows is written when a couple
                  ///< comes
    float_couple couples[FLOAT_COUPLES]; ///< by the columns' ids
    uint8_t free[FLOAT_COUPLES];         ///< ids
    unsigned free_count;
    float_queue entry;                    ///< for the ellipsoids
    float_queue queues[FLOAT_GJK_BLOCKS]; ///< for the search, by the eights of vertices of the larger body
    float_gjk group;                      ///< at work, a quarter of it at most between calls
} batch_floats;

/// 1 for a pair that may be added.
static inline int batch_floats_fit(const ovoid_shape *a, const ovoid_shape *b) {
    return shape_has_floats(a) & shape_has_floats(b) & !(a->radius > 0) & !(b->radius > 0);
}

/// Adds the lanes `some` of a group: pairs that fit, whose numbers pair8_kernels.floats found. They may be answered or
/// left open now, as may those that waited.
void batch_floats_add(batch_floats *s, const lane_group *e, unsigned some, const pair8_floats *numbers);

/// Ends all that wait.
void batch_floats_end(batch_floats *s);

#endif
