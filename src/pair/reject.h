// First rejections of a pair, in the world, before B is put in the frame of A: most pairs of a scene are far apart, and
// most of those that are near were apart a moment ago, along a direction that still parts them.
//
// Errors (docs/error-analysis.md): what is measured here is off by less than 60 u s. An answer from here is measured
// again in the frame of A, off by 148 u s, and must hold with 148 u s to spare: hence FRAME_REJECT.
#ifndef OVOID_PAIR_REJECT_H
#define OVOID_PAIR_REJECT_H

#include "pair/search.h"

#define FRAME_REJECT (384 * 0x1p-53)

/// What a bound that was measured in the world is widened by.
static inline double reject_get_claim(const pair_frame *f) { return FRAME_REJECT * f->size + 3 * f->hidden; }

/// A lower bound above the goal's `far`, and what shows it.
typedef struct rejection {
    double lower;
    vec3 normal;   ///< unit, world
    uint32_t a, b; ///< the vertices behind the upper bound
    ovoid_stage stage;
} rejection;

/// By the enclosing spheres: 1 where they are farther apart than `far`; found->lower is their bound in any case. The
/// frame needs only frame_place.
static inline int reject_by_spheres(const pair_frame *f, double far, rejection *found) {
    vec3 d = f->between;
    double distance = vec3_norm(d),
           lower = distance - (f->a->reach + f->b->reach) - f->lower_radii - reject_get_claim(f);
    found->lower = lower;
    if (!(lower > far)) return 0;
    *found = (rejection){lower, vec3_scale(d, 1 / distance), 0, 0, OVOID_STAGE_SPHERE};
    return 1;
}

/// By the supports along an earlier proof's normal: 1 where the gap is above `far`. The proof may hold any numbers.
/// found->a and b are vertices in any case, those that the supports met; else *found is as it was.
int reject_by_normal(const pair_frame *frame, double far, const ovoid_proof *earlier, rejection *found);

/// The answer to the query, whose goal has its tolerance. By value: its address is not taken, so the compiler can make
/// it in the place of the caller's result.
ovoid_answer rejection_make_answer(const rejection *g, const pair_frame *f, const query_goal *goal);

#endif
