// The depth of an overlap, and the sign near exact touching, by an expanding polytope.
#ifndef OVOID_QUERY_EPA_H
#define OVOID_QUERY_EPA_H

#include "query/search.h"

/// Runs from the differences that GJK ended with; narrows the bracket until the question is answered or a limit is met
/// (which goes into s->limit). *cover (may be NULL) receives the surface where the upper bound rests on it.
void epa_run(search *s, const simplex *from, ovoid_cover *cover);

#endif
