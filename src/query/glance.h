// A first look at a pair, in the world, before B is put in the frame of A: most pairs of a scene are far apart, and
// most of those that are near were apart a moment ago, along a direction that still parts them.
//
// Errors (docs/error-analysis.md): what is measured here is off by less than 60 u s. An answer from here is measured
// again in the frame of A, off by 148 u s, and must hold with 148 u s to spare: hence FRAME_GLANCE.
#ifndef OVOID_QUERY_GLANCE_H
#define OVOID_QUERY_GLANCE_H

#include "query/search.h"

#define FRAME_GLANCE (384 * 0x1p-53)

/// A lower bound above the one asked for, and what shows it.
typedef struct glance {
    double lower;
    vec3 normal;   ///< unit, world
    uint32_t a, b; ///< the vertices behind the upper bound
    ovoid_stage stage;
} glance;

/// The enclosing spheres; 1 where they are farther apart than `far`; found->lower is their bound in any case. The frame
/// needs to be placed only.
int glance_at_spheres(const pair_frame *frame, double far, glance *found);

/// The supports along an earlier proof's normal; 1 where the gap is above `far`. Any numbers are safe.
int glance_at_proof(const pair_frame *frame, double far, const ovoid_proof *earlier, glance *found);

/// The answer to the question, whose tolerance is set. By value: no address of it is taken, so it is made where the
/// caller of the query wants it.
ovoid_answer glance_make_answer(const glance *g, const pair_frame *f, const question *ask);

#endif
