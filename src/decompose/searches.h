// The two searches, one a length. The caller has set the body as the problem, room, work, tolerance and options; each
// sets what is below, and returns what is above. The first two set how cells are bounded and cut.
#ifndef OVOID_DECOMPOSE_SEARCHES_H
#define OVOID_DECOMPOSE_SEARCHES_H

#include "decompose/body.h"

void uncovered_set_functions(cell_search *s);
void excess_set_functions(cell_search *s);
double uncovered_search(cell_search *s);
double excess_search(cell_search *s);

/// How far x is from all parts, at least; *nearest: a part that is as near.
double uncovered_find_least(const body *b, vec3 x, uint32_t first, uint32_t *nearest);

#endif
