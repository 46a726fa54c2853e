// The last stage: the sign, and the bracket, that doubles cannot tell.
#ifndef OVOID_QUERY_REFINE_H
#define OVOID_QUERY_REFINE_H

#include "query/search.h"

/// Goes on in double-double where the search ended near contact, or short of the tolerance, without an answer; else
/// does nothing. What it finds goes into the search: bounds with their evidence, the direction in world and world_low.
/// earlier: the pair's earlier proof, or NULL.
void refine_run(search *s, const ovoid_pair *pair, const ovoid_proof *earlier);

#endif
