// Proves, without a search, that a given surface is the boundary of its points' hull.
#ifndef OVOID_POLYTOPE_SURFACE_PROOF_H
#define OVOID_POLYTOPE_SURFACE_PROOF_H

#include "polytope/hull.h"
#include "polytope/quickhull.h"

/// The claimed surface, proven to be the hull of the points, with each of these extreme. p: the claim's points, taken
/// as distinct; the proof shows that they are. MEMORY, or HULL and *flaw filled; then *s needs no destroying. s->state
/// stays NULL. Cost: linear.
ovoid_code surface_create_proven(const surface_claim *claim, const points *p, const ovoid_allocator *allocator,
                                 surface *s, surface_flaw *flaw);

#endif
