// A true ellipsoid and another body: the distance of their cores.
#ifndef OVOID_EXACT_CORES_H
#define OVOID_EXACT_CORES_H

#include "pair/search.h"

/// Takes the bounds of a pair with a true ellipsoid, in a frame of true bodies; 1 if that answers the query.
int cores_run(search *s);

#endif
