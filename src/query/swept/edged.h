// A body with edges, a box or a hull, and a cylinder or a cone, in the axes of the former: what a search for their
// least overlap knows (query/swept/circles.c, query/swept/hull_arcs.c).
#ifndef OVOID_QUERY_SWEPT_EDGED_H
#define OVOID_QUERY_SWEPT_EDGED_H

#include "query/swept/descend.h"

/// Which body has more than one farthest point along a direction.
typedef enum free_body { FREE_EDGED, FREE_ROUND, FREE_BOTH } free_body;

typedef struct plane_vector {
    double x, y;
} plane_vector;

/// A round body in the axes of the one with edges, from its centre. Directions go from there to the round body.
typedef struct edged_search {
    double axis[3], center[3];
    double height, radius; ///< half of the former
    int is_cone;
    double sine, cosine; ///< of the side's normals: their height along the axis, and across it
    double inside;       ///< how far the side is from the centre
    double ball;         ///< a ball around the centre that the body holds
    double size, tolerance;
    double value; ///< the least so far
    double low;   ///< what is to be shown
    int left;     ///< how many times arcs may be halved
    free_body free;
    int edge;              ///< of that direction's arc, and of FREE_BOTH; the owner's number
    int is_on_arc;         ///< the direction is known in the plane across the edge
    plane_vector in_plane; ///< that
    double n[3];           ///< or as it is
} edged_search;

static inline double dot3(const double a[3], const double b[3]) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

/// The search of two cores of which B or A has the edges; axis, center: the round body's in those axes.
edged_search edged_make(const cores *p, int is_edged_b, vec3 axis, vec3 center, double tolerance);

/// How far the round body reaches against a unit direction, from its centre.
static inline double edged_measure_round(const edged_search *q, const double n[3]) {
    const double *w = q->axis, t = dot3(n, w), x = n[1] * w[2] - n[2] * w[1], y = n[2] * w[0] - n[0] * w[2],
                 z = n[0] * w[1] - n[1] * w[0], rim = q->radius * sqrt((x * x + y * y) + z * z), along = q->height * t;
    return q->is_cone ? max2(-along, along + rim) : fabs(along) + rim;
}

static inline void edged_set_value(edged_search *q, double value, free_body free, int edge) {
    q->value = value;
    q->low = value - 0.5 * q->tolerance;
    q->free = free;
    q->edge = edge;
}

/// Takes the overlap along a direction if it is less.
static inline void edged_take(edged_search *q, double value, const double n[3], free_body free, int edge) {
    if (!(value < q->value)) return;
    edged_set_value(q, value, free, edge);
    q->is_on_arc = 0;
    for (int i = 0; i < 3; i++) q->n[i] = n[i];
}

/// A direction in which a corner goes straight to the axis of a cylinder, or to the side of a cone: v the corner from
/// the round body's centre. 0 if the overlap of that corner alone is not above 0, or not less than the least so far.
static inline int edged_aim_corner(const edged_search *q, const double v[3], double n[3]) {
    const vec3 w = {q->axis[0], q->axis[1], q->axis[2]}, at = {v[0], v[1], v[2]};
    // Its depth is `most` less what it is off the axis.
    const double along = vec3_dot(at, w), most = q->inside - q->sine * along, left = most - q->value;
    vec3 off = patch_find_across(w, at, along, vec3_norm_squared(at));
    const double square = vec3_norm_squared(off), squared = q->cosine * q->cosine * square;
    if (!(most > 0) || squared > most * most || (left > 0 && squared < left * left)) return 0;
    // On the axis all directions across it are as good.
    off = square > 0 ? vec3_scale(off, q->cosine / sqrt(square)) : vec3_scale(vec3_orthogonal(w), q->cosine);
    const vec3 to = vec3_neg(vec3_add_scaled(off, w, q->sine));
    n[0] = to.x, n[1] = to.y, n[2] = to.z;
    return 1;
}

/// A direction of the body with edges, and what goes with it, in the world.
typedef struct edged_direction {
    int is_edged_b;
    vec3 n, edge; ///< unit, from that body to the round one; along the edge of FREE_BOTH, of any length
} edged_direction;

/// Of *at the direction, the overlap along it and its points. 0 if these are not found.
int edged_set_points(const cores *p, const edged_search *q, const edged_direction *of, least_overlap *at);

// ---- a box (query/swept/circles.c)

/// 1 if one core is a box and the other one a cylinder or a cone.
int cores_have_circles(const cores *p);

/// The least overlap of such cores: of *at the direction, the value and both points are set. 0 if it is not found. Else
/// no overlap is less than the value by more than `tolerance` and 100 u of the size.
int cores_search_circles(const cores *p, double tolerance, least_overlap *at);

#endif
