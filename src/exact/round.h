// A true cylinder or cone and a point, or a sphere, in closed form.
#ifndef OVOID_EXACT_ROUND_H
#define OVOID_EXACT_ROUND_H

#include "pair/search.h"

/// Takes the bounds of a pair of them; 1 if that answers the query. The frame is that of true bodies.
int round_take_point(search *s);

#endif
