// Every query of a pair, each answer before the exact judge.
#ifndef OVOID_FUZZ_ASK_H
#define OVOID_FUZZ_ASK_H

#include "take.h"

/// Asks all five questions of the pair, cold, with the proof and with the options; aborts on any answer that is not
/// proven, contradicts another, or contradicts brute force where the bodies have few vertices. options may be NULL.
void fuzz_ask(const ovoid_pair *pair, double margin, const ovoid_options *options, const ovoid_proof *earlier);

/// A proof of nothing: any indices, weights and directions.
ovoid_proof fuzz_take_proof(fuzz_bytes *from);

#endif
