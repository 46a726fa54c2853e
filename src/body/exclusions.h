// Exclusions: writing and sorting them, and whether they leave out a pair of leaves.
#ifndef OVOID_BODY_EXCLUSIONS_H
#define OVOID_BODY_EXCLUSIONS_H

#include "ovoid/body.h"

/// Forgets what an earlier query wrote; exclusions may be NULL.
void exclusions_begin(ovoid_exclusions *exclusions);
/// Doubles the room of exclusions that grow; where there is no memory they stay as they are.
void exclusions_grow(ovoid_exclusions *exclusions);
/// Counts an exclusion, and keeps it where there is room.
static inline void exclusions_add(ovoid_exclusions *exclusions, const ovoid_exclusion *x) {
    if (exclusions->count == exclusions->capacity && exclusions->grows) exclusions_grow(exclusions);
    if (exclusions->count < exclusions->capacity) exclusions->items[exclusions->count] = *x;
    exclusions->count++;
}
/// Sorts them by their ranges where all are there; exclusions may be NULL.
void exclusions_finish(ovoid_exclusions *exclusions);
/// 1 if one of the sorted exclusions has the ranges of `wanted`.
int exclusions_have(const ovoid_exclusions *exclusions, const ovoid_exclusion *wanted);

#endif
