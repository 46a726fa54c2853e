// Is a surface that somebody hands over the boundary of its points' hull? A proof without a search.
#ifndef OVOID_POLYTOPE_SURFACE_PROOF_H
#define OVOID_POLYTOPE_SURFACE_PROOF_H

#include "polytope/quickhull.h"
#include "polytope/surface_claim.h"

/// The surface that is claimed, proven to be the hull of the points and each of these to be extreme. p: the claim's
/// points, taken as distinct; the proof shows that they are. MEMORY, or HULL and *flaw filled; *s needs no destroying
/// then. s->state stays NULL. Cost: linear.
ovoid_code surface_create_proven(const surface_claim *claim, const points *p, const ovoid_allocator *allocator,
                                 surface *s, surface_flaw *flaw);

#endif
