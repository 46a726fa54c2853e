// The searches for the two lengths. The caller sets the body as the problem, room, work, tolerance and options; each
// search finds the lower end and returns the upper end. The first two functions set how cells are bounded and cut.
#ifndef OVOID_DECOMPOSE_SEARCHES_H
#define OVOID_DECOMPOSE_SEARCHES_H

#include "decompose/body.h"

void uncovered_set_functions(cell_search *s);
void excess_set_functions(cell_search *s);
double uncovered_search(cell_search *s);
double excess_search(cell_search *s);

/// A lower bound of the distance of x from all parts; *nearest: a part at about that distance.
double uncovered_find_least(const body *b, vec3 x, uint32_t first, uint32_t *nearest);

#endif
