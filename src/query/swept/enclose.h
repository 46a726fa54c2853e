// The proof that two cores overlap by no less than a length along any direction.
#ifndef OVOID_QUERY_SWEPT_ENCLOSE_H
#define OVOID_QUERY_SWEPT_ENCLOSE_H

#include "query/swept/descend.h"

/// Searches for the least overlap from a local minimum, or if its value is INFINITY from the direction at->of.n alone.
/// A lesser one that is found takes its place. 1 if it is shown to be the least of all but for `tolerance`: no overlap
/// is less than *lower. claim: how far off rounding may be.
int cores_enclose(const cores *p, double claim, double tolerance, least_overlap *at, double *lower);

#endif
