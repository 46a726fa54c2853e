// The stages before the exact search, in the order of their cost. Each may answer the query, and each passes its
// direction or its points to the next. Bounds are stored in the search; only hints are returned.
#ifndef OVOID_PAIR_STAGES_H
#define OVOID_PAIR_STAGES_H

#include "pair/search.h"

/// The pair's earlier proof: its normal is measured again, its differences become the first simplex. *start stays empty
/// if the proof is NULL or not sound for this pair.
void stage_proof(search *s, const ovoid_proof *earlier, simplex *start);

/// Outer ellipsoids; *n receives the unit direction of their largest gap.
void stage_outer(search *s, vec3 *n);

/// The polyhedra's own supports along n; the vertex pair goes into *start.
void stage_support(search *s, vec3 n, simplex *start);

/// Inner ellipsoids: a common point proves an overlap.
void stage_inner(search *s);

/// The direction n = unit((QA/sA + QB/sB + g I)^-1 d), two rounds, of ellipsoids whose centres are d apart; s =
/// sqrt(n'Qn), g their gap along the n before, or 0: the nearest points have d = (QA/sA + QB/sB) n + g n. The support
/// gap of the two along it goes into *gap (rounded).
vec3 ellipsoids_find_direction(sym3 qa, sym3 qb, vec3 d, double *gap);

/// An upper bound of n'Qn, the rounding of a posed Q included.
double ellipsoid_compute_spread(sym3 q, vec3 n);

#endif
