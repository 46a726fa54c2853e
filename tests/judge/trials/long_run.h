// The long run: 10^9 queries and more, every answer checked by its proof, one in a thousand by exact arithmetic. Its
// work is cut into blocks. A block is one family's: a pool of shapes from the block's seed, then a fixed number of
// queries on pairs of that pool. A block makes the same queries whenever and wherever it is run, so the run can stop
// and go on between any two, and a failure is seen again from the family and the block's number.
#ifndef OVOID_TRIALS_LONG_RUN_H
#define OVOID_TRIALS_LONG_RUN_H

#include "clouds.h"
#include "judge.h"
#include "ovoid/ovoid.h"

#define BLOCK_QUERIES 100000
#define POOL_MOST 24

typedef enum question_kind { ASK_COLLIDE, ASK_WITHIN, ASK_DISTANCE, ASK_DEPTH, ASK_BOUNDS, ASK_KINDS } question_kind;

// What the query was handed as earlier proof.
typedef enum warm_kind { WARM_NONE, WARM_LAST, WARM_STALE, WARM_FOREIGN, WARM_GARBAGE, WARM_KINDS } warm_kind;

/// What is counted, all of them uint64_t; every one is a sum but the last, which is a maximum.
typedef struct counts {
    uint64_t blocks, queries, exact, wrong;
    uint64_t vague; // true, but wider than promised with no limit that says why
    uint64_t open,
        wide; // the sign not proven; a distance or depth wider than 1e-9 of the size. Both only by default options
    uint64_t pairs, nanoseconds;
    uint64_t questions[ASK_KINDS], warm[WARM_KINDS], limited; // limited: with options of the caller's
    uint64_t statuses[OVOID_OVERLAPPING + 1], stages[OVOID_STAGE_REFINE + 1], limits[OVOID_LIMIT_SHAPE_B + 1];
    uint64_t iterations;
} counts;

void counts_add(counts *sum, const counts *more);

/// One shape of the pool, and what placing it needs.
typedef struct item {
    ovoid_shape *shape;
    double extent; // about its frame's origin, radius not included
    double reach;  // of its smallest sphere, radius included
    double radius;
    ovoid_vec3 center; // of that sphere, user's frame
    ovoid_vec3 origin;
} item;

/// How B is placed by A.
typedef enum place_kind {
    PLACE_ANY,     // anywhere, in any orientation, then along the normal to a gap of any order
    PLACE_FAR,     // as ANY, 1e7 away from the world's origin
    PLACE_NORMS,   // as ANY, quaternions of norms 1e-150 to 1e150
    PLACE_ALIGNED, // of one orientation, at multiples of a half
    PLACE_COMMON,  // both in one pose: what the vertices share, they share exactly
    PLACE_INSIDE,  // centres nearly in one place
    PLACE_SAME,    // the same shape in the same pose, and moved from there
    PLACE_STACKED  // B stands on A, or hangs above it, or is in it: the distance is known exactly
} place_kind;

/// A family of the long run.
typedef struct long_family {
    const char *name;
    ovoid_shape *(*make)(uint64_t *r); // NULL: from the clouds
    uint32_t pool;                     // shapes
    uint32_t share;                    // of all blocks, in parts of the sum
    place_kind place;
    ovoid_shape *(*make_b)(
        uint64_t *r); // of the second half of the pool, from where B is taken; NULL: one pool for both
} long_family;

extern const long_family long_families[];
extern const size_t long_family_count;

/// The two poses of a scene's first pair. Returns the signed distance where it is known, else NAN.
double place_pair(const long_family *f, const item *a, const item *b, ovoid_pair *pair, uint64_t *r);
/// A gap of any order, in parts of the size; often none or a small one.
double random_gap(uint64_t *r);

/// Where a failure goes: called by any thread, one at a time is the callee's business.
typedef void report_failure(void *context, const long_family *f, uint64_t block, const ovoid_pair *pair,
                            const ovoid_answer *answer, const char *question, const char *why);

/// What a block needs. One thread each.
typedef struct block_run {
    const long_family *family;
    uint64_t number, seed;
    uint64_t sample; // one answer of so many goes before the judge
    int is_shown;    // answers that are open or wide are reported too
    const clouds *clouds;
    judge *judge;
    report_failure *report;
    void *context;
} block_run;

/// Runs the block; adds to *sum.
void block_execute(const block_run *run, counts *sum);

#endif
