// ovoid as a contestant about many bodies.
#ifndef OVOID_BENCH_MANY_MANY_OURS_H
#define OVOID_BENCH_MANY_MANY_OURS_H

#include "peers/many_peer.h"

many_peers many_get_ours(void);

#endif
