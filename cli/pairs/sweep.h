// Finding the boxes that are near each other.
#ifndef OVOID_CLI_PAIRS_SWEEP_H
#define OVOID_CLI_PAIRS_SWEEP_H

#include <ovoid/ovoid.h>

/// Receives a pair of boxes, a < b. 0 to go on, or an exit code that ends the sweep.
typedef int (*sweep_visit)(void *context, ovoid_couple couple);

/// Visits each pair of boxes that are not farther apart than the margin, rounding included, in no order. A box of NaN
/// is near all others. Cost: sorting, and the pairs whose boxes overlap along x. 0, or an exit code: that of visit, or
/// EXIT_INPUT after a message.
int sweep_find(const ovoid_box *boxes, size_t count, double margin, sweep_visit visit, void *context);

#endif
