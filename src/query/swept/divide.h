// The least overlap of two cores shown by dividing the directions.
#ifndef OVOID_QUERY_SWEPT_DIVIDE_H
#define OVOID_QUERY_SWEPT_DIVIDE_H

#include "query/swept/descend.h"

/// The directions whose cosine with a unit n is not below `cosine`.
typedef struct direction_cap {
    vec3 n;
    double cosine;
} direction_cap;

enum { MOST_CAPS = 64 };
typedef struct direction_caps {
    uint32_t count;
    direction_cap cap[MOST_CAPS];
} direction_caps;

/// 1 if it is seen that no overlap along directions of these caps is less than `wanted` by more than 384 u of the size;
/// *at is the least one known.
int cores_divide(const cores *p, const least_overlap *at, double wanted, const direction_caps *open);

#endif
