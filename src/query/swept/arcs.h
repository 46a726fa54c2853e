// Arcs of directions across an edge, along which its overlap with a cylinder or a cone may be the least.
#ifndef OVOID_QUERY_SWEPT_ARCS_H
#define OVOID_QUERY_SWEPT_ARCS_H

#include "query/swept/edged.h"

static inline double dot2(plane_vector a, plane_vector b) { return a.x * b.x + a.y * b.y; }
static inline double cross2(plane_vector a, plane_vector b) { return a.x * b.y - a.y * b.x; }
static inline plane_vector unit2(double x, double y) {
    const double scale = 1 / sqrt(x * x + y * y);
    return (plane_vector){x * scale, y * scale};
}

/// The plane across an edge, and directions in it: those nearest to the round body's axis and its reverse, and where
/// that body goes from one piece to another.
typedef struct arc_plane {
    int edge;
    plane_vector axis;
    double square;      ///< of the axis along the edge
    plane_vector at[4]; ///< the last two are the kinks
    int breaks;
    plane_vector first, last; ///< of the arc that is looked at: less than a half turn
    plane_vector corner;      ///< of the edge, from the round body's centre
    double side;              ///< 1 if the arc turns to the left, or -1
    double up;                ///< in the part that is looked at, the rim's height along the axis in parts of the body's
} arc_plane;

/// A plane without an arc. axis, square: as above.
arc_plane arcs_make_plane(const edged_search *q, int edge, plane_vector axis, double square);

/// Is a direction between the ends of the arc?
static inline int arcs_is_within(const arc_plane *o, plane_vector n) {
    return o->side * cross2(o->first, n) > 0 && o->side * cross2(n, o->last) > 0;
}

/// 1 if no overlap along the arc is less than the least so far, which is taken from it, by more than the search's
/// tolerance and 100 u of the size; 0 if that is not found. All values along ends of arcs have been taken.
int arcs_hold(edged_search *q, arc_plane *o);

#endif
