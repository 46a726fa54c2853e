// The least overlap of two cylinders or cones, in the coordinates of their axes.
#ifndef OVOID_QUERY_SWEPT_REVOLVED_H
#define OVOID_QUERY_SWEPT_REVOLVED_H

#include "query/swept/profile.h"

/// What is known of the overlaps along all directions beside that of a spot: none is less, by more than half of the
/// tolerance and 1400 u of the size; it is not known; one is less.
typedef enum held { HELD, OPEN, LOWER } held;

/// Sets the least overlap to that of the spot. lower: a and b of what is less.
held revolved_hold(profiles *q, const profile_spot *spot, double lower[2]);

/// 1 if each core is a cylinder or a cone.
int cores_are_revolved(const cores *p);

/// The least overlap of such cores: of *at the direction, the value and both points are set; no overlap is less than
/// the value by more than `tolerance` and 1400 u of the size. 0 if it is not found; then the direction and the value
/// are those of an overlap that is no more than others, or the value is INFINITY.
int cores_search_revolved(const cores *p, double tolerance, least_overlap *at);

#endif
