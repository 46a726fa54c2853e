// Workloads: pairs of bodies at given kinds of distance, at rest or moving.
#ifndef OVOID_BENCH_COMMON_WORK_H
#define OVOID_BENCH_COMMON_WORK_H

#include "common/bodies.h"

/// The distance, relative to the pair's size (the sum of the radii of the enclosing spheres).
typedef enum placement {
    PLACE_FAR,    ///< a gap of five sizes
    PLACE_MID,    ///< a gap of one half
    PLACE_TENTH,  ///< a gap of a tenth
    PLACE_NEAR,   ///< a gap of a hundredth
    PLACE_SLIGHT, ///< an overlap of a hundredth
    PLACE_OVER,   ///< the centres of the spheres 0.3 apart
    PLACE_COUNT
} placement;

/// "gap 500%" and so on.
const char *placement_get_name(placement place);

/// Neighbours in the list, uncorrelated poses. pairs NULL if memory runs out. Free with workload_destroy.
workload workload_create_still(const char *name, const bodies *all, placement place);

/// As workload_create_still, with each pair over so many frames: both turn, and B goes around A by 1 % of the size a
/// frame, at that distance.
workload workload_create_moving(const char *name, const bodies *all, placement place, uint32_t frames);

/// Body 0 goes past each of the others from `first` to `last` on a straight line, 1 % of the size a frame, coming as
/// near as 1 % of the size.
workload workload_create_passing(const char *name, const bodies *all, uint32_t first, uint32_t last, uint32_t frames);

void workload_destroy(workload *work);

/// The pair in ovoid's form.
ovoid_pair workload_get_pair(const workload *work, uint32_t index);

#endif
