// The interface of a contestant with many bodies: a frame of a swarm, a state of a robot in its cell. A peer is a
// shared module that exports bench_get_many_peers; it receives bodies as plain arrays, as in peer.h.
#ifndef OVOID_BENCH_PEERS_MANY_PEER_H
#define OVOID_BENCH_PEERS_MANY_PEER_H

#include "peers/peer.h"

#include <stddef.h>
#include <stdlib.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Bodies that all move, each a little from frame to frame.
typedef struct swarm {
    const body *shapes;
    const uint32_t *shape_of; ///< of each body
    uint32_t shape_count, body_count;
    double step;      ///< about the motion of the outermost points of a body in a frame
    uint32_t threads; ///< for contestants that can use them
} swarm;

/// A robot among parts that stand still. Body k < link_count is a link, link_count + i the part i.
typedef struct workcell {
    const body *shapes;
    const uint32_t *shape_of; ///< of links, then parts
    const ovoid_pose *parts;
    uint32_t shape_count, link_count, part_count;
    const unsigned char *ignored; ///< link_count x link_count: 1 if two links are not queried; symmetric
    double margin;                ///< of the monitor
} workcell;

/// Two bodies a < b, and their distance if it was queried.
typedef struct meeting {
    uint32_t a, b;
    double distance;
} meeting;

typedef struct meetings {
    meeting *items;
    size_t count, room;
    int failed; ///< memory is out
} meetings;

static inline void meetings_add(meetings *all, uint32_t a, uint32_t b, double distance) {
    if (all->count == all->room) {
        size_t room = all->room ? 2 * all->room : 1024;
        meeting *items = (meeting *)realloc(all->items, room * sizeof *items);
        if (!items) {
            all->failed = 1;
            return;
        }
        all->items = items;
        all->room = room;
    }
    meeting *one = &all->items[all->count++];
    one->a = a < b ? a : b;
    one->b = a < b ? b : a;
    one->distance = distance;
}

/// A frame: the bodies have new poses; which pairs touch? In any order. create is not timed; all of run is.
typedef struct swarm_peer {
    const char *name;
    void *(*create)(const swarm *what, const ovoid_pose *poses); ///< NULL: it cannot
    void (*run)(void *self, const ovoid_pose *poses, meetings *touching);
    void (*destroy)(void *self);
} swarm_peer;

/// A state: the links have new poses.
typedef struct cell_peer {
    const char *name;
    void *(*create)(const workcell *what, const ovoid_pose *links);
    int (*is_hit)(void *self, const ovoid_pose *links);                   ///< the planner: does anything touch?
    void (*measure)(void *self, const ovoid_pose *links, meetings *near); ///< the monitor: all within the margin
    void (*destroy)(void *self);
} cell_peer;

/// Lists that end with NULL.
typedef struct many_peers {
    const swarm_peer *const *swarms;
    const cell_peer *const *cells;
} many_peers;

__attribute__((visibility("default"))) many_peers bench_get_many_peers(void);

#ifdef __cplusplus
}
#endif
#endif
