// Bodies seen along the normal of a contact, in exact arithmetic: with u = n x e and v = n x u a point of the world
// has the coordinates k (u.x, v.x) across the normal and the height k n.x, k = n_a n_b. A length l across is k |v| l in
// the metric |n|^2 x^2 + y^2, an area A is k^2 |u|^2 |n| A.
#ifndef OVOID_JUDGE_ZONE_H
#define OVOID_JUDGE_ZONE_H

#include "flat.h"
#include "posed.h"

/// The coordinates.
typedef struct view {
    pool *p;
    num k;
    nvec n, u, v;
    num nn, uu, vv; ///< squares of the lengths
} view;
view view_make(const posed *s, nvec n);

/// A vertex: its coordinates across, and its height.
typedef struct seen_vertex {
    flat_point at;
    twin height;
} seen_vertex;

/// The plane a x + b y + c z = d of a triangle; outside is where the left side is larger.
typedef struct seen_plane {
    twin a, b, c, d;
} seen_plane;

/// The vertices and the planes of the triangles of a body.
typedef struct seen_body {
    uint32_t count, plane_count;
    seen_vertex *vertices;
    seen_plane *planes;
} seen_body;

/// A body whose coordinates times `scale` have the factor k; side: 1 for A, -1 for B. seen_body_free frees its arrays;
/// numbers are the pool's.
seen_body seen_body_make(const view *w, const body *b, num scale, int side);
void seen_body_free(seen_body *b);

/// A point of the world.
flat_point view_see(const view *w, ovoid_vec3 point);

/// The zone of contact: the points across n over which the hulls of both bodies have points whose heights differ by at
/// most `reach` (a bound of the length times k |n|).
typedef struct zone_terms {
    const seen_body *a, *b;
    num reach;
    int is_outer; ///< 1: a polygon that holds the zone; 0: one that is in it. Both are the zone where each triangle is
                  ///< part of the hull; else planes are moved out to the farthest vertex, or left where they are.
} zone_terms;
/// 0: it has too many corners.
int zone_make(const view *w, const zone_terms *terms, flat_polygon *out);

#endif
