// The depth of an overlap, and the sign near exact touching, by an expanding polytope.
#ifndef OVOID_EXACT_EPA_H
#define OVOID_EXACT_EPA_H

#include "pair/search.h"

/// Runs from at most four differences and narrows the bracket. 1: the query is answered, or a limit is met, which goes
/// into s->limit. 0: EPA can do no more; where is_first is set also if the cores are apart, so that GJK should go on
/// from the differences in *points. *cover (may be NULL) receives the surface where the upper bound rests on it.
int epa_run(search *s, simplex *points, int is_first, ovoid_cover *cover);

#endif
