// A few points that strictly contain the origin: the proof of an overlap.
#ifndef OVOID_QUERY_HULL_H
#define OVOID_QUERY_HULL_H

#include "linear/vec3.h"

/// A proven distance, from below, of the origin to the surface of 4 points (a tetrahedron) or of 5 or 6 (a double
/// pyramid with the tips 0 and 1 over the ring 2, 3, ...) that winds around it, when each coordinate may be off by
/// `error`; 0 if none is proven.
double hull_compute_depth(const vec3 *w, int count, double error);

/// Likewise by the surface's distance alone: dearer, and better where the tetrahedron is thin; the greater of both is
/// never below what a larger error gave.
double hull_compute_clearance(const vec3 *w, int count, double error);

/// Chooses 4 to 6 of the points (at most HULL_POINTS_MAX) for hull_compute_depth, in its order, into kept. Returns
/// their number; 0 if the points do not contain the origin, as far as can be proven, or no such choice is found. Drops
/// points one after another as long as the origin stays inside the hull of the rest; what cannot be reduced has at most
/// six (Steinitz 1913), and six only as three opposite pairs. Cost: at most a hull for each point.
enum { HULL_POINTS_MAX = 32 };
int hull_find_few(const vec3 *w, int count, double error, double slack, int kept[6]);

#endif
