// Pairs of which a body is a solid: a pair's shapes are then the convex hulls of these. What parts the hulls parts the
// bodies; where that is not enough, the bodies themselves are asked.
#ifndef OVOID_ROBOT_CELL_SOLID_PAIR_H
#define OVOID_ROBOT_CELL_SOLID_PAIR_H

#include "ovoid/body.h"

#include <math.h>

/// The solids of a pair of hulls; NULL: that body is the shape itself.
typedef struct solid_sides {
    const ovoid_solid *a, *b;
    double gap; ///< how much farther apart than the hulls they are at most; infinity where that is not known
} solid_sides;

static inline int sides_have_solid(const solid_sides *s) { return s->a || s->b; }

/// The upper end of the bodies' distance from that of their hulls, rounded up.
static inline double solid_sides_raise(const solid_sides *s, double upper) {
    return upper + s->gap + 0x1p-51 * (fabs(upper) + s->gap);
}

/// Whether the bodies are within a margin, or their distance with the nearest points, from the answer of their hulls.
/// Its points and normal are those of the deciding pair of triangles. clear: by how much the bodies may be nearer than
/// these are, by padding and by the errors of poses. A lower end that is not above it is that of the hulls: solids that
/// interlock are parted by no small translation, so where bodies may overlap their distance says nothing of that.
ovoid_answer solid_pair_within(const ovoid_pair *hulls, const solid_sides *solids, double margin,
                               const ovoid_answer *of_hulls, double clear);
ovoid_answer solid_pair_distance(const ovoid_pair *hulls, const solid_sides *solids, const ovoid_options *options,
                                 const ovoid_answer *of_hulls, double clear);

#endif
