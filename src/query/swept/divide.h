// The least overlap of two cores shown by dividing the directions.
#ifndef OVOID_QUERY_SWEPT_DIVIDE_H
#define OVOID_QUERY_SWEPT_DIVIDE_H

#include "query/swept/descend.h"

/// 1 if it is seen that no overlap is less than `wanted` by more than 384 u of the size; *at is the least one known.
int cores_divide(const cores *p, const least_overlap *at, double wanted);

#endif
