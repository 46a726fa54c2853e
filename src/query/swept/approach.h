// Swept spheres without a closed form: a cylinder, a cone or an ellipsoid, and another core.
#ifndef OVOID_QUERY_SWEPT_APPROACH_H
#define OVOID_QUERY_SWEPT_APPROACH_H

#include "query/swept/pair.h"

/// The verdict; of what is asked for as in ovoid/swept.h. witness: written unless undecided; may be NULL.
ovoid_verdict swept_approach(const swept_placed *pair, swept_question asked, ovoid_witness *witness);

#endif
