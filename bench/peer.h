// The peer: libccd (D. Fiser), on the same vertices and poses. Its booleans by GJK and by MPR, its depth by GJK and
// EPA.
#ifndef OVOID_BENCH_PEER_H
#define OVOID_BENCH_PEER_H

#include <ovoid/ovoid.h>

/// 1: it says that they overlap.
int peer_collide_gjk(const ovoid_pair *pair);
int peer_collide_mpr(const ovoid_pair *pair);
/// The depth it gives, 0 where it says that they are apart.
double peer_depth(const ovoid_pair *pair);

#endif
