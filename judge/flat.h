// Convex polygons in the plane, in exact arithmetic. A polygon is kept by the lines of its edges, and a corner is where
// two of them meet: so numbers do not grow from one cut to the next. Lengths are x^2 metric + y^2. Each number has a
// double beside it, which decides the signs that it can.
#ifndef OVOID_JUDGE_FLAT_H
#define OVOID_JUDGE_FLAT_H

#include "number.h"

#include <stdint.h>

/// Most corners of a polygon.
enum { FLAT_CORNERS = 512 };

/// A number, and a double that is off by at most a few roundings.
typedef struct twin {
    num n;
    double d;
} twin;
twin twin_make(num n);

/// The point (x / w, y / w), w > 0.
typedef struct flat_point {
    twin x, y, w;
} flat_point;

/// The half-plane { x, y: a x + b y + c >= 0 }.
typedef struct flat_line {
    twin a, b, c;
} flat_line;

/// Counter-clockwise; edge i is on line i, from corner i to the next. One corner: a point; two: a segment.
typedef struct flat_polygon {
    uint32_t count;
    flat_point corners[FLAT_CORNERS];
    flat_line lines[FLAT_CORNERS];
} flat_polygon;

/// A point whose coordinates are numbers.
flat_point flat_point_make(pool *p, num x, num y);

/// The sign of a x + b y + c at a point.
int flat_find_side(pool *p, const flat_line *line, const flat_point *at);

/// The hull of points with w = 1, which are sorted; without corners on its edges.
void flat_make_hull(pool *p, flat_point *points, uint32_t count, flat_polygon *out);

/// Cuts a polygon of at least three corners by a half-plane; none are left where the rest has no area. 0: it has too
/// many corners.
int flat_cut(pool *p, const flat_line *line, flat_polygon *polygon);

/// A lower and an upper bound of a number.
typedef struct num_bracket {
    num below, above;
} num_bracket;

/// Twice the area, 0 of points and segments, to about 2^-200 of its terms.
num_bracket flat_find_area(pool *p, const flat_polygon *g);

/// 1 if a point is farther from a polygon than sqrt(square).
int flat_is_farther(pool *p, const flat_polygon *g, const flat_point *at, const num metric_and_square[2]);

#endif
