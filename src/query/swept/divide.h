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

/// Bodies whose overlap is nowhere less than `wanted`, beside the directions around a minimum in which that is known.
typedef struct division {
    const void *of;
    vec3 (*find)(const void *of, vec3 n); ///< a point of the difference body, far along a unit n
    vec3 n;                               ///< of the minimum,
    double cosine;                        ///< and the least one of the angle to it that is proven; 2: none
    double wanted;
    int left;  ///< points that may be asked for
    vec3 less; ///< a unit direction along which that found less; else none
} division;

/// A division of these cores beside that minimum.
division division_make(const cores *p, const least_overlap *at, double wanted);

/// 1 if it is seen that no overlap along directions of the spherical triangle between three is less than what is wanted
/// by more than rounding. known: a point of the difference body.
int division_hold(division *d, const vec3 corner[3], const vec3 *known);

/// 1 if it is seen that no overlap along directions of these caps is less than `wanted` by more than 384 u of the size;
/// *at is the least one known.
int cores_divide(const cores *p, const least_overlap *at, double wanted, const direction_caps *open);

#endif
