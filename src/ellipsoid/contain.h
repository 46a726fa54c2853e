// Does an ellipsoid enclose a polytope, or lie in one? Rigorous: rounding can turn a yes into a no, never a no into a
// yes. No memory is allocated; cost linear in vertices and triangles.
#ifndef OVOID_ELLIPSOID_CONTAIN_H
#define OVOID_ELLIPSOID_CONTAIN_H

#include "ellipsoid/factor.h"
#include "ovoid/ellipsoid.h"

/// 1 only if it is proven that Q - (v - c)(v - c)' is positive semidefinite for every vertex v. This is equivalent to
/// h(n) >= n . v for every direction n and vertex v, whether Q is singular or not. The result is 0 for a Q that is
/// singular in any other way than by zero rows.
int ellipsoid_is_enclosing(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid);

/// 1 only if it is proven that the ellipsoid lies in the convex hull of the vertices, and that Q is positive definite
/// or that the ellipsoid is only a vertex (Q zero). The caller guarantees indices in range, finite vertices, and that
/// the triangles are a closed surface (each directed edge is matched by its opposite). The planes may be any. Always 0
/// for a rank < 3: flat bodies have no proof.
int ellipsoid_is_enclosed(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid);

/// 1 only if Q is positive definite and it is proven that the ellipsoid meets no triangle: then it is enclosed if the
/// surface winds around its centre.
int ellipsoid_is_clear(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid);

/// 1 for an ellipsoid that is only a vertex.
int ellipsoid_is_vertex(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid);

/// An upper bound of the largest (v - c)' Q^-1 (v - c) over the vertices; INFINITY if Q has no proven factor.
double ellipsoid_compute_enclosing_bound(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid);

/// The same from a factor of Q.
double factor_compute_enclosing_bound(const factor *f, const ovoid_polytope *polytope, ovoid_vec3 center);

/// 1 only if the mean of the vertices is proven to be in the ellipsoid of a factor of factor_make_quickly.
int factor_holds_mean(const factor *f, const ovoid_polytope *polytope, ovoid_vec3 center);

/// A factor s such that the ellipsoid, scaled by s about its centre, meets no triangle of the surface: a lower bound of
/// the largest factor with this property. At most zero if none is proven.
double ellipsoid_compute_clear_bound(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid);

/// The same in doubles alone, along the planes of the facets alone: no larger. If Q, scaled by the square of the
/// result, is rounded, at most three roundings of an entry, the bound of the stored Q is at least 1.
double ellipsoid_compute_clear_bound_roughly(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid);

/// The unit normal of a triangle, accurate to a few roundings unless it is degenerate. (Computed in doubles, the normal
/// of a needle's side would lean along the needle.) Zero for a degenerate one.
ovoid_vec3 triangle_compute_normal(const ovoid_vec3 corner[3]);

#endif
