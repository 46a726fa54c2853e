// FCL's module of many bodies.
#include "peers/peer_many_fcl.h"

many_peers bench_get_many_peers(void) { return {fcl_swarms, fcl_cells}; }
