// The largest ellipsoid in many halfspaces, of which few are touched: solved on a working set.
#ifndef OVOID_ELLIPSOID_WORKING_SET_H
#define OVOID_ELLIPSOID_WORKING_SET_H

#include "ellipsoid/inscribe.h"

/// inscribe_solve for any count. guess: an ellipsoid of about the size, from which the first working set is chosen. The
/// order of the constraints changes. h and w are those of the result, y is zero outside of the working set. Cost: five
/// to ten rounds of one pass over all constraints and inscribe_solve on some hundred of them.
inscribed working_set_solve(constraint_set all, const inscribed *guess, double gap);

#endif
