// The least overlap of a box and a cylinder or a cone, along a few directions and circles of directions.
#ifndef OVOID_QUERY_SWEPT_CIRCLES_H
#define OVOID_QUERY_SWEPT_CIRCLES_H

#include "query/swept/descend.h"

/// 1 if one core is a box and the other one a cylinder or a cone.
int cores_have_circles(const cores *p);

/// The least overlap of such cores: of *at the direction, the value and both points are set. 0 if it is not found. Else
/// no overlap is less than the value by more than `tolerance` and 100 u of the size.
int cores_search_circles(const cores *p, double tolerance, least_overlap *at);

#endif
