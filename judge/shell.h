// Closed surfaces of triangles in exact arithmetic: closedness, winding number, distance from the origin.
#ifndef OVOID_JUDGE_SHELL_H
#define OVOID_JUDGE_SHELL_H

#include "number.h"

#include <stdint.h>

/// Triangles (three indices each) over points.
typedef struct shell {
    const nvec *points;
    const uint32_t *triangles;
    uint32_t point_count, triangle_count;
} shell;

/// 1 if all indices are in range and each directed edge is met once and its reverse once. 0 also if memory runs out.
int shell_is_closed(const shell *s);

/// 1 if the closed surface winds a nonzero number of times around the origin; 0 if not, or if the origin lies on it.
int shell_is_winding(pool *p, const shell *s);

/// 1 if no point of the triangle (of the segment) is nearer to the origin than sqrt(square).
int triangle_is_farther(pool *p, nvec a, nvec b, nvec c, num square);
int segment_is_farther(pool *p, nvec a, nvec b, num square);

#endif
