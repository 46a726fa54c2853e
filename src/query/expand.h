// A convex hull of few points that grows: the polytope of EPA. Fixed memory.
#ifndef OVOID_QUERY_EXPAND_H
#define OVOID_QUERY_EXPAND_H

#include "linear/vec3.h"
#include "ovoid/query.h"
#include "simd/planes.h"

enum { EXPANSION_POINTS = OVOID_COVER_POINTS, EXPANSION_FACES = 2 * OVOID_COVER_POINTS, EXPANSION_NONE = 0xffff };

typedef struct expansion_face {
    vec3 n;           ///< unit, outward
    double low;       ///< n.w of its corners, to rounding
    uint16_t v[3];    ///< corners, counter-clockwise from outside
    uint16_t twin[3]; ///< across the edge v[e], v[e + 1]: 4 face + edge
    uint8_t alive;    ///< 0: replaced
    uint8_t sliver;   ///< its plane is uncertain
    uint8_t outward;  ///< the origin is behind its triangle, beyond any rounding
} expansion_face;

typedef struct expansion {
    double slack; ///< of rounding, when a point is held against a face
    double doubt; ///< how small det(corners)^2 may be against the square of the edges before its sign is in doubt
    double bound; ///< faces at least this far need not be looked at: at first infinity
    uint32_t points, faces, free_count, open_count, ring_count;
    simd_cone cone;
    vec3 w[EXPANSION_POINTS];
    uint32_t a[EXPANSION_POINTS], b[EXPANSION_POINTS];           ///< where each point came from
    uint16_t leaving[EXPANSION_POINTS], stamp[EXPANSION_POINTS]; ///< the new face from a point, as of which apex
    uint16_t ring[EXPANSION_POINTS];                             ///< the last point's new faces, around it
    expansion_face f[EXPANSION_FACES];
    uint16_t free[EXPANSION_FACES]; ///< faces that can be used again
    uint16_t visible[EXPANSION_FACES];
    uint16_t open[EXPANSION_FACES + EXPANSION_POINTS]; ///< faces nearer than `bound`; some may have been replaced
} expansion;

/// No points yet.
void expansion_clear(expansion *p, double slack);

/// Adds a point without joining it to the surface; there must be room.
uint16_t expansion_add_point(expansion *p, vec3 w, uint32_t a, uint32_t b);

/// The surface of the first four points, which must span space.
void expansion_make_tetrahedron(expansion *p);

/// Joins a point to the surface: it replaces the faces that it sees, `first` among them. 0 if rounding or memory make
/// that impossible; the surface is spoilt then.
int expansion_join(expansion *p, uint16_t first, uint16_t apex);

/// The face of least offset.
uint16_t expansion_find_nearest(expansion *p);

/// The triangles of the surface; their number.
uint32_t expansion_pack(const expansion *p, uint16_t (*triangles)[3]);

/// The hull of points (a[i] is then the index of point i), those inside to rounding left out; 0 if they are flat.
int expansion_make_hull(expansion *p, const vec3 *w, int count, double slack);

#endif
