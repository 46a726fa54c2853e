// A growing polytope of few points with its faces in lanes, eight of them a group: the inner loop of EPA (exact/epa.c),
// with supports in lanes too where the bodies are small. The nearest face is a vector minimum, what a point sees one
// comparison a group, the horizon the edges of seen faces whose reverse is not seen, the new faces one group. Nothing
// is a list, and no step waits for more than one support.
//
// It ends where the common case does: at a sliver, a horizon that is no simple loop, a point or a group too many. The
// surface is then the one before that step, and whoever asked goes on from it.
#ifndef OVOID_SIMD_EPA8_H
#define OVOID_SIMD_EPA8_H

#include "simd/pair.h"

enum { EPA8 = 8, EPA8_GROUPS = 16, EPA8_FACES = EPA8 * EPA8_GROUPS, EPA8_POINTS = 32, EPA8_START = 4 };

/// A surface to begin with, of the polytope's `points` differences a and b: in range, and some difference more up to a
/// multiple of EPA8.
typedef struct epa8_kept {
    const uint16_t (*triangles)[3];     ///< counter-clockwise from outside; any numbers: it is found out what they are
    uint32_t faces;                     ///< 1 to 64
    double rotation[9], translation[3]; ///< where `find` is asked, rows that bring b's points into the frame of a's
} epa8_kept;

/// What is asked: the bodies in one frame and when to stop.
typedef struct epa8_query {
    simd_points a, b; ///< at most 64 points each
    /// Where it is not NULL, it finds the supports in their place: the difference B minus A that is greatest along a
    /// direction of any length, and the gap along its reverse.
    simd_difference (*find)(const void *bodies, vec3 n);
    const void *bodies;
    double claim;          ///< what rounding does to a gap: one above it proves the bodies apart; also the least depth
    double narrow;         ///< how far above the nearest face its support may be for the depth to be known
    double near;           ///< faces that much farther than the nearest may yet be the nearest, for rounding
    double slack;          ///< how far above a face a point must be to see it
    double doubt;          ///< as in exact/expand.h
    uint32_t most;         ///< supports of faces
    const epa8_kept *kept; ///< NULL: the growth begins with the points alone
} epa8_query;

/// Why the growth ended.
typedef enum epa8_end {
    EPA8_NARROW, ///< the nearest face's support is near enough
    EPA8_APART,  ///< a gap proves the bodies apart
    EPA8_LEFT,   ///< not the common case, or `most` supports: to be continued from the surface
    EPA8_FLAT    ///< there is no surface: the first points make none of plain faces, or the kept one is none around the
                 ///< origin
} epa8_end;

/// The polytope.
typedef struct epa8 {
    _Alignas(64) double w[3][EPA8_POINTS];
    double n[3][EPA8_FACES];                 ///< unit, outward
    double low[EPA8_FACES];                  ///< n.w of its corners, to rounding
    uint32_t a[EPA8_POINTS], b[EPA8_POINTS]; ///< where each point came from
    uint8_t v[EPA8_FACES][4];                ///< three corners, counter-clockwise from outside
    uint8_t left[EPA8_POINTS][EPA8_POINTS];  ///< the face to the left of an edge, of those that there are; not set of a
                                             ///< kept surface that was NARROW at once
    uint64_t alive[2], inward[2];            ///< faces that there are; those that may not have the origin behind them
    uint32_t points, groups;
    uint32_t supports; ///< of faces
    uint32_t nearest;  ///< face
    double gap;        ///< NARROW: along its normal
    uint64_t near[2];  ///< NARROW: the faces that may be the nearest
    double best_gap;   ///< the greatest gap along a face's normal, -best_n
    vec3 best_n;
} epa8;

/// The kernel of one instruction set: grows from the first `points` of w, a, b, one to four; or from the kept surface.
/// The same bits from each.
typedef epa8_end epa8_function(epa8 *s, const epa8_query *query);

/// Runs the kernel of the widest instruction set of this machine.
epa8_end epa8_grow(epa8 *s, const epa8_query *query);

/// The kernel of one instruction set, for tests; NULL where this machine or build lacks it.
epa8_function *epa8_get(simd_isa isa);

#endif
