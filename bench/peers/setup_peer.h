// The interface of a contestant in bench --setup. A peer is a shared module (MODULE.so) that exports
// bench_get_setup_peers; it receives points as plain arrays and needs nothing of libovoid.
#ifndef OVOID_BENCH_PEERS_SETUP_PEER_H
#define OVOID_BENCH_PEERS_SETUP_PEER_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct setup_peer {
    const char *name;
    /// Makes what its queries need from the points, x, y, z each, and destroys it. Returns the number of vertices that
    /// are left; 0: it could not.
    uint32_t (*make)(const double *points, uint32_t count);
} setup_peer;

/// A list that ends with NULL.
__attribute__((visibility("default"))) const setup_peer *const *bench_get_setup_peers(void);

#ifdef __cplusplus
}
#endif
#endif
