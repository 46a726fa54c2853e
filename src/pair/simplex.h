// The point of a simplex nearest to the origin: the inner step of GJK. The signed-volume view of M. Montanari,
// N. Petrinic, E. Barbieri, Improving the GJK algorithm for faster and more reliable distance queries between convex
// objects, 2017: each face of the simplex is tested for the side that the origin lies on.
//
// Nothing here is trusted: every result is a convex combination of the simplex's points, so its norm is an upper bound,
// and the direction only proposes a lower bound that the supports then prove.
#ifndef OVOID_PAIR_SIMPLEX_H
#define OVOID_PAIR_SIMPLEX_H

#include "linear/vec3.h"

/// A difference of two vertices.
typedef struct difference {
    vec3 w;
    uint32_t a, b;
} difference;

/// One to four differences with the weights of the point nearest to the origin.
typedef struct simplex {
    difference p[4];
    double weight[4]; ///< >= 0, sum 1 to rounding
    int count;
} simplex;

/// Reduces the simplex to its smallest face that holds the nearest point, sets the weights and returns the unit
/// direction from the origin to that point, orthogonal to the face to rounding. Zero if the origin lies in the simplex,
/// to rounding: then all points are kept, with the weights of the origin.
vec3 simplex_reduce(simplex *s);

/// Weights of the nearest point of a simplex of 1 to 3 points, which lies inside it, so no point may be left out. If
/// rounding gives another result, the simplex is reduced.
void simplex_compute_weights(simplex *s);

/// Weights of the origin, which lies in the tetrahedron.
void simplex_compute_inside_weights(simplex *s);

/// The nearest point, from the weights.
vec3 simplex_compute_point(const simplex *s);

/// The unit normal of the triangle with edges e1 and e2, orthogonal to them to rounding u; of a sliver, whose edges
/// have the sine s between them, to a few (u / s)^2. Zero where it has no area.
vec3 simplex_compute_normal(vec3 e1, vec3 e2);

#endif
