// The interface of a contestant in bench --contacts. A peer is a shared module (MODULE.so) that exports
// bench_get_contact_peers; it receives bodies as plain arrays and needs nothing of libovoid.
#ifndef OVOID_BENCH_PEERS_CONTACT_PEER_H
#define OVOID_BENCH_PEERS_CONTACT_PEER_H

#include "peers/peer.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Pairs in frames: pair i of frame f is pairs[f * pair_count + i], the same bodies, moved a little.
typedef struct contact_work {
    const body *bodies;
    const placed *pairs;
    uint32_t body_count, pair_count, frame_count;
    double margin;    ///< contacts are wanted up to this distance
    double tolerance; ///< of ovoid: the width of a kept contact's bracket
} contact_work;

typedef struct contact_peer {
    const char *name;
    int is_float;                              ///< single precision
    void *(*create)(const contact_work *work); ///< not timed. NULL: it cannot
    /// The contact points of all pairs of a frame; returns their number. warm: from what it keeps of the frame before;
    /// else from nothing.
    uint32_t (*run)(void *self, uint32_t frame, int warm);
    void (*destroy)(void *self);
} contact_peer;

/// A list that ends with NULL.
__attribute__((visibility("default"))) const contact_peer *const *bench_get_contact_peers(void);

#ifdef __cplusplus
}
#endif
#endif
