// The depth of two cores that overlap.
#ifndef OVOID_QUERY_SWEPT_OVERLAP_H
#define OVOID_QUERY_SWEPT_OVERLAP_H

#include "query/swept/pair.h"

/// The verdict, undecided where the cores are apart or their depth is not found; witness: written unless undecided; may
/// be NULL.
ovoid_verdict swept_measure_overlap(const swept_placed *pair, ovoid_witness *witness);

#endif
