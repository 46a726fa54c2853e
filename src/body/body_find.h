// Two bodies of any kind, for callers that ask about bodies whatever they are.
#ifndef OVOID_SOLID_BODY_FIND_H
#define OVOID_SOLID_BODY_FIND_H

#include "body/body_view.h"
#include "ovoid/solid.h"

static inline int body_pair_has_solid(const ovoid_body_pair *pair) { return pair->a.solid || pair->b.solid; }

/// The pipeline of ovoid_solid_collide and its sisters, for callers inside a public function.
void solid_find_internal(const ovoid_body_pair *pair, const ovoid_options *options, const query_goal *goal,
                         const ovoid_compound_proof *earlier, ovoid_exclusions *exclusions, ovoid_solid_answer *out);

/// compound_find_internal for all kinds of bodies. Of a pair with a solid the answer is that of the surfaces, with
/// status, limit and bracket of the bodies, and the triangles as parts; no depth is searched for. What is inside what
/// is not in it: such an answer is checked by asking solid_find_internal.
void body_find_internal(const ovoid_body_pair *pair, const ovoid_options *options, query_goal goal,
                        const ovoid_compound_proof *earlier, ovoid_exclusions *exclusions, ovoid_compound_answer *out);

#endif
