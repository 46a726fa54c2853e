// The depth of an overlap, and the sign near exact touching, by an expanding polytope.
#ifndef OVOID_QUERY_EPA_H
#define OVOID_QUERY_EPA_H

#include "query/search.h"

/// Runs from at most four differences; narrows the bracket until the question is answered or a limit is met (which goes
/// into s->limit): 1. 0 where it can say no more; is_first: also where the cores are apart, so that GJK should go on,
/// from the differences in *x then. *cover (may be NULL) receives the surface where the upper bound rests on it.
int epa_run(search *s, simplex *x, int is_first, ovoid_cover *cover);

#endif
