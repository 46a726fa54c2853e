// First rejections of a pair, in the world, before B is put in the frame of A: most pairs of a scene are far apart, and
// most of the near pairs were apart in the last frame, along a direction that still separates them.
//
// Errors (docs/error-analysis.md): the measurements here are off by less than 60 u s. A verifier measures the answer
// again in the frame of A, off by 148 u s, and needs 148 u s to spare: hence FRAME_REJECT.
#ifndef OVOID_PAIR_REJECT_H
#define OVOID_PAIR_REJECT_H

#include "pair/search.h"

#define FRAME_REJECT (384 * 0x1p-53)

/// The length by which a bound that was measured in the world is widened.
static inline double reject_get_claim(const pair_frame *f) { return FRAME_REJECT * f->size + 3 * f->hidden; }

/// A lower bound above the goal's `far`, and its evidence.
typedef struct rejection {
    double lower;
    vec3 normal;   ///< unit, world
    uint32_t a, b; ///< the vertices behind the upper bound
    ovoid_stage stage;
} rejection;

/// By the enclosing spheres: 1 if they are farther apart than `far`; found->lower is their bound in any case. The frame
/// needs only frame_place.
static inline int reject_by_spheres(const pair_frame *f, double far, rejection *found) {
    vec3 d = f->between;
    double distance = vec3_norm(d),
           lower = distance - (f->a->reach + f->b->reach) - f->lower_radii - reject_get_claim(f);
    found->lower = lower;
    if (!(lower > far)) return 0;
    *found = (rejection){lower, vec3_scale(d, 1 / distance), 0, 0, OVOID_STAGE_SPHERE};
    return 1;
}

/// By the supports along an earlier proof's normal: 1 if the gap is above `far`. The proof may hold any numbers.
/// found->a and b are the vertices of the supports in any case; otherwise *found is unchanged.
int reject_by_normal(const pair_frame *frame, double far, const ovoid_proof *earlier, rejection *found);

/// The answer to the query, whose goal has its tolerance. Returned by value: its address is not taken, so the compiler
/// can build it in the place of the caller's result.
ovoid_answer rejection_make_answer(const rejection *g, const pair_frame *f, const query_goal *goal);

/// The same, of which only the verdict and the proof are wanted.
ovoid_verdict rejection_write_proof(const rejection *g, const pair_frame *f, const query_goal *goal, ovoid_proof *to);

#endif
