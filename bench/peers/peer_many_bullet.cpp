// Bullet's module of many bodies.
#include "peers/peer_many_bullet.h"

many_peers bench_get_many_peers(void) { return {bullet_swarms, bullet_cells}; }
