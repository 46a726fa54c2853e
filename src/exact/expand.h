// A convex hull of few points that grows: the polytope of EPA. Its memory is the caller's, a room for a number of
// points that he knows: an expansion is to be given one before anything else, and can be moved to a larger one.
#ifndef OVOID_EXACT_EXPAND_H
#define OVOID_EXACT_EXPAND_H

#include "linear/vec3.h"
#include "ovoid/query.h"
#include "simd/epa8.h"
#include "simd/planes.h"

enum { EXPANSION_POINTS = OVOID_COVER_POINTS, EXPANSION_FACES = 2 * EXPANSION_POINTS, EXPANSION_NONE = 0xffff };

typedef struct expansion_face {
    vec3 n;           ///< unit, outward
    double low;       ///< n.w of its corners, to rounding
    uint16_t v[3];    ///< corners, counter-clockwise from outside
    uint16_t twin[3]; ///< the face across the edge v[e], v[e + 1]
    uint8_t alive;    ///< 0: replaced
    uint8_t outward;  ///< the origin is behind its triangle, beyond any rounding
} expansion_face;

typedef struct expansion {
    double slack; ///< how far above a face a point must be to see it, for rounding
    double doubt; ///< how small det(corners)^2 may be against the square of the edges before its sign is in doubt
    double bound; ///< faces at least this far need not be searched; at first infinity
    uint32_t points, faces, free_count, open_count, ring_count;
    uint32_t most_points, most_faces;
    simd_cone cone;
    // Into its room.
    vec3 *w;
    uint32_t *a, *b;           ///< where each point came from
    uint16_t *leaving, *stamp; ///< the new face from a point, as of which apex
    expansion_face *f;
    uint16_t *ring;           ///< the last point's new faces, around it
    uint16_t *free;           ///< faces that can be used again; from its end down those that the last point saw
    uint16_t *open;           ///< faces nearer than `bound`; some may have been replaced
    uint32_t leaves, slots;   ///< of the next two; 0: the expansion was not moved, and the lists are searched
    uint16_t *winners;        ///< a tournament of the faces: the nearer one of two children, the nearest at 1
    uint16_t *index;          ///< of the points, by where they came from
    uint16_t (*triangles)[3]; ///< of the surface, by expansion_pack
} expansion;

/// The type NAME is the memory of an expansion of at most POINTS points and FACES faces, NAME_give gives it to one. A
/// surface has at most 2 POINTS - 4 faces; while a point is joined, fewer than POINTS new ones stand beside the old
/// ones. The lists that only growth needs end when the triangles are packed.
// NOLINTBEGIN(bugprone-macro-parentheses): sizes of members
#define EXPANSION_ROOM(NAME, POINTS, FACES)                                                                            \
    typedef struct NAME {                                                                                              \
        vec3 w[POINTS];                                                                                                \
        uint32_t a[POINTS], b[POINTS];                                                                                 \
        uint16_t leaving[POINTS], stamp[POINTS];                                                                       \
        union {                                                                                                        \
            struct {                                                                                                   \
                uint16_t ring[POINTS], free[FACES], open[(FACES) + (POINTS)];                                          \
            };                                                                                                         \
            uint16_t triangles[FACES][3];                                                                              \
        };                                                                                                             \
        expansion_face f[FACES];                                                                                       \
    } NAME;                                                                                                            \
    static inline void NAME##_give(NAME *room, expansion *p) {                                                         \
        p->most_points = (POINTS);                                                                                     \
        p->most_faces = (FACES);                                                                                       \
        p->w = room->w, p->a = room->a, p->b = room->b, p->leaving = room->leaving, p->stamp = room->stamp;            \
        p->f = room->f, p->ring = room->ring, p->free = room->free, p->open = room->open;                              \
        p->triangles = room->triangles;                                                                                \
        p->leaves = p->slots = 0;                                                                                      \
    }                                                                                                                  \
    typedef NAME NAME
// NOLINTEND(bugprone-macro-parentheses)

EXPANSION_ROOM(expansion_room, EXPANSION_POINTS, EXPANSION_FACES);

/// Bytes of a room of any number of points, at most OVOID_COVER_POINTS_MAX, and twice as many faces.
size_t expansion_get_room_size(uint32_t points);

/// Moves the expansion to such a room, which is aligned to 8 bytes and larger than the one that it has. A point that
/// could not be joined for want of memory can be joined then.
void expansion_move(expansion *p, void *room, uint32_t points);

/// Clears the expansion: it has no points then.
void expansion_clear(expansion *p, double slack);

/// Adds a point without joining it to the surface; there must be room.
uint16_t expansion_add_point(expansion *p, vec3 w, uint32_t a, uint32_t b);

/// 1 if a point came from there already.
int expansion_has_point(const expansion *p, uint32_t a, uint32_t b);

/// The surface of the first four points, which must span space.
void expansion_make_tetrahedron(expansion *p);

/// The surface that was grown in lanes, to go on from; the number of its nearest face. There must be room.
uint16_t expansion_take(expansion *p, const epa8 *from);

/// Joins a point to the surface: it replaces the faces visible from it, `first` among them. 0 if rounding or memory
/// make that impossible; the surface is then as it was, and no point can be joined to it any more.
int expansion_join(expansion *p, uint16_t first, uint16_t apex);

/// The face of least offset.
uint16_t expansion_find_nearest(expansion *p);

/// Writes the triangles of the surface, which cannot grow any more then; their number.
uint32_t expansion_pack(expansion *p);

/// The hull of points (a[i] is then the index of point i), those inside to rounding left out; 0 if they are flat.
int expansion_make_hull(expansion *p, const vec3 *w, int count, double slack);

#endif
