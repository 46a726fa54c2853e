// The two searches, one a length. The caller has set the body as the problem, room, work, tolerance and options; each
// sets what is below, and returns what is above.
#ifndef OVOID_DECOMPOSE_SEARCHES_H
#define OVOID_DECOMPOSE_SEARCHES_H

#include "decompose/body.h"

double uncovered_search(cell_search *s);
double excess_search(cell_search *s);

#endif
