// The points of the rims of true cylinders and cones and of the surface of true ellipsoids, as vertices of proofs.
//
// A number below the shape's count is a vertex of the polyhedron. With its highest bit set a number is a point of a rim
// of radius R: bit 30 is 1 on the rim of a cylinder's upper end, bits 29 and 28 are the quarter of the circle, and the
// other 28 bits the place in it: with t = bits / 2^28, the tangent of half the angle from the quarter's begin, the
// point is R ((1 - t^2), 2 t) / (1 + t^2), turned by the quarters. Computed in doubles it is within 4 u R of the
// circle, u = 2^-53, as the polyhedron's vertices are within the `inside` of its allowance, 8 u R. Neighbours are less
// than 2^-27 apart as angles, so that the rim reaches no farther along a direction than the nearest of them by 2^-57 R.
//
// Of ellipsoids the other 31 bits are a point of a grid (shape/ellipsoid.h).
#ifndef OVOID_SHAPE_RIM_H
#define OVOID_SHAPE_RIM_H

#include "shape/ellipsoid.h"

#define RIM_POINT 0x80000000u
#define RIM_UPPER 0x40000000u
#define RIM_STEPS 0x10000000u

/// The number of the point nearest to the direction (x, y), of length `length`; 0 of all directions if that is zero.
static inline uint32_t rim_find(double x, double y, double length, int is_upper) {
    uint32_t quarter = y >= 0 ? (x > 0 ? 0 : 1) : (x < 0 ? 2 : 3), first = RIM_POINT | (is_upper ? RIM_UPPER : 0);
    if (!(length > 0)) return first;
    double c = quarter & 1 ? fabs(y) : fabs(x), s = quarter & 1 ? fabs(x) : fabs(y);
    uint32_t step = (uint32_t)(s / (c + length) * (double)RIM_STEPS + 0.5);
    return step < RIM_STEPS ? first | quarter << 28 | step : first | ((quarter + 1) & 3) << 28;
}

/// 1 if a proof may name that vertex of the shape.
static inline int shape_has_vertex(const ovoid_shape *s, uint32_t number) {
    if (number < s->vertex_count) return 1;
    if (!(number & RIM_POINT) || !shape_is_round(s)) return 0;
    if (shape_is_ellipsoid(s)) return number - RIM_POINT < ELLIPSOID_POINTS;
    return s->round.kind == OVOID_ROUND_CYLINDER || !(number & RIM_UPPER);
}

/// The point of a rim or of an ellipsoid, in the body frame.
vec3 rim_compute_point(const ovoid_shape *shape, uint32_t number);

/// A vertex that the shape has, in its body frame.
static inline vec3 shape_get_vertex(const ovoid_shape *s, uint32_t number) {
    return number & RIM_POINT ? rim_compute_point(s, number) : vec3_at(shape_vertices(s), number);
}

#endif
