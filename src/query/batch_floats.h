// The yes or no of couples in single precision, sixteen at a time (simd/float_gjk.h): from the poses to the verdict.
// Couples wait until there are sixteen for the spheres, sixteen for the ellipsoids, then sixteen of like numbers of
// vertices for the search, whose group is filled again when few of its lanes are live; supports of bodies of many
// vertices are found one by one (batch_supports.h). What floats leave open is left
// to the caller. A couple's bits do not depend on the others.
#ifndef OVOID_QUERY_BATCH_FLOATS_H
#define OVOID_QUERY_BATCH_FLOATS_H

#include "exact/closed.h"
#include "query/goal.h"
#include "shape/floats.h"

/// What is kept of a couple beside its lane.
typedef struct float_couple {
    size_t index;
    const ovoid_shape *a, *b;
    float unit, lower, upper, size; ///< the bounds by the spheres; s
} float_couple;

/// Couples that wait, or are at work, at most.
enum {
    FLOAT_QUEUES = FLOAT_GJK_BLOCKS + 1,
    FLOAT_WAITING = (FLOAT_QUEUES + 1) * (FLOATS - 1) + FLOATS,
    FLOAT_COUPLES = FLOAT_WAITING + FLOATS
};

/// Couples on their way to the spheres.
typedef struct float_block {
    float_rows rows;
    size_t index[FLOATS];
    unsigned count;
} float_block;

/// The state of a batch: 40 KB.
typedef struct batch_floats {
    // Set by batch_floats_begin.
    float_queue entry; ///< for the ellipsoids
    /// For the search, by the eights of vertices of the larger body; 0: more than the columns have.
    float_queue queues[FLOAT_QUEUES];
    float_gjk group; ///< at work, a quarter of it at most between calls
    // Set by the caller.
    const float_gjk_kernels *kernels, *alone;
    const query_goal *goal; ///< without the tolerance
    const ovoid_options *options;
    const ovoid_batch *batch;
    ovoid_verdict *verdicts;
    float (*normals)[3]; ///< NULL, or of couples that are apart by more than their spheres the direction of the lower
                         ///< bound, in the axes of A, of any length
    uint16_t (*corners)[4][2]; ///< NULL, or of couples whose search ends with an overlap the vertices of A and B whose
                               ///< differences have the origin inside
    void (*leave_open)(void *self, size_t index); ///< a couple that the search leaves open
    void (*pass_on)(void *self, size_t index);    ///< a couple that is not for floats, of which nothing is known
    void *self;
    // Set by batch_floats_begin.
    float_block next, few; ///< the next couples; those that wait for others, as not all beside them were for floats
    float_couple couples[FLOAT_COUPLES]; ///< by the columns' ids
    unsigned used, free_count;
    int is_wide; ///< no bracket is within the tolerance: all are wider than 2^-23 of s, what the spheres claim
    uint8_t free[FLOAT_COUPLES]; ///< of the first `used` ids
} batch_floats;

void batch_floats_begin(batch_floats *s);

/// Takes the FLOATS couples of the batch from `first` on, those after the ones that were taken before. They may be
/// answered, left open or passed on now, as may those that waited.
void batch_floats_take(batch_floats *s, size_t first);

/// 1 if a couple is for batch_floats_add: of up to FLOAT_GJK_POINTS vertices.
int batch_floats_fit(const ovoid_shape *a, const ovoid_shape *b);

/// Where a couple's numbers are.
typedef struct float_posed_pair {
    const ovoid_shape *a, *b;
    const ovoid_pose *pose_a, *pose_b;
} float_posed_pair;

/// Takes a couple that fits, in the place of those of a batch.
void batch_floats_add(batch_floats *s, size_t index, const float_posed_pair *bodies);

/// Ends all that wait.
void batch_floats_end(batch_floats *s);

#endif
