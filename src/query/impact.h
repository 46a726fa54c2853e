// The time of impact, for those who ask for it inside the library.
#ifndef OVOID_QUERY_IMPACT_H
#define OVOID_QUERY_IMPACT_H

#include "ovoid/motion.h"

/// ovoid_impact_find inside a public function. tolerance: that of the time where the options name none.
void impact_find(const ovoid_moving *a, const ovoid_moving *b, double margin, const ovoid_motion_options *options,
                 double tolerance, ovoid_impact *out);

#endif
