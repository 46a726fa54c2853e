// A closed surface of differences around the origin: the proof of a depth's upper bound.
#ifndef OVOID_PAIR_COVER_H
#define OVOID_PAIR_COVER_H

#include "pair/frame.h"

/// A surface over points, at most 65535 of them. The points are given, or are differences of the pair's vertices that
/// are computed wherever they are used, which needs no memory.
typedef struct surface {
    const vec3 *points; ///< NULL: b[i] less a[i]
    const uint16_t (*triangles)[3];
    uint32_t point_count, triangle_count;
    const pair_frame *frame;
    const uint32_t *a, *b;
} surface;

/// Over points that are given.
static inline surface surface_make(const vec3 *points, uint32_t point_count, const uint16_t (*triangles)[3],
                                   uint32_t triangle_count) {
    return (surface){
        .points = points, .triangles = triangles, .point_count = point_count, .triangle_count = triangle_count};
}

static inline vec3 surface_get_point(const surface *s, uint32_t i) {
    return s->points ? s->points[i] : frame_proof_difference(s->frame, s->a[i], s->b[i]);
}

/// 1 if a cover has arrays for the points and triangles that it counts.
static inline int cover_has_arrays(const ovoid_cover *cover) {
    return !cover->point_count || (cover->a && cover->b && (cover->triangles || !cover->triangle_count));
}

/// Over the differences of a cover; few points are computed once, into w (OVOID_COVER_POINTS). 0 if counts or vertices
/// are out of range; the triangles are not looked at.
int surface_take_cover(surface *s, const pair_frame *frame, const ovoid_cover *cover, vec3 *w);

/// A triangle (a, b, c) has the origin behind it, whatever the corners' rounding, if det(a, b, c)^2 is above this times
/// the sum |b - a|^2 + |c - a|^2, and det positive. Corners of norm at most `reach`, each off by `error`.
static inline double triangle_compute_doubt(double reach, double error) {
    double off = reach * (error + 8 * 0x1p-53 * reach);
    return 128 * off * off;
}

int triangle_is_outward(vec3 a, vec3 b, vec3 c, double doubt);

/// A lower bound of the distance of the origin to a triangle; negative if none is found. *normal: the unit direction
/// along which all of the triangle is at least that far. A bound of at least `enough` need not be the best.
double triangle_compute_clearance(vec3 a, vec3 b, vec3 c, double enough, vec3 *normal);

/// A radius r > 0 such that no point of the surface is nearer to the origin than r and the surface winds around it,
/// when each coordinate may be off by `error`; 0 if that is not proven. The surface must be closed.
double surface_compute_depth(const surface *s, double error);

/// 1 if each directed edge occurs exactly once and its reverse exactly once, and all indices are in range. Cost: a pass
/// over the triangles for each 1365 of them, 32 KB of stack.
int surface_is_closed(const surface *s);

#endif
