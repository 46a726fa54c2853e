// The manifolds of a world: those of the last call, with which the next one compares, and room for those of a step.
#ifndef OVOID_WORLD_MANIFOLD_LIST_H
#define OVOID_WORLD_MANIFOLD_LIST_H

#include "world/step.h"

/// Manifolds of pairs, sorted, and those of their parts.
typedef struct manifold_list {
    ovoid_world_manifold *items;
    ovoid_body_manifold *parts;
    ovoid_manifold_points *points; ///< beside the parts
    size_t count, part_count, capacity, part_capacity, point_capacity;
} manifold_list;

/// What one worker finds, chunk after chunk.
typedef struct manifold_room {
    manifold_list list;
    int failed; ///< memory ran out
} manifold_room;

/// The manifolds of one chunk: a range in its worker's room, and where that comes in the list.
typedef struct manifold_chunk {
    uint32_t worker, queried;
    size_t first, first_part, count, part_count;
    size_t at, part_at;
    size_t begun, kept; ///< of the pairs, and of the parts
} manifold_chunk;

struct manifolds {
    manifold_list last, next; ///< of the last call, and room for those of this one
    manifold_room *rooms;     ///< one for each worker
    manifold_chunk *chunks;   ///< beside those of the world
    ovoid_world_parting *ended;
    size_t chunk_capacity, ended_capacity;
    ovoid_manifold_options options, last_options; ///< of this step, and of the one that made `last`
    uint32_t steps;                               ///< of the world, with the one that made `last`
    int is_current;                               ///< the step before this one made `last`, with the same options
};

/// Creates them if there are none. 0: memory ran out.
int manifolds_create(ovoid_world *w);
/// Frees them, if there are any.
void manifolds_destroy(ovoid_world *w);
/// The bytes that workers allocated.
size_t manifolds_get_memory(const ovoid_world *w);

/// Adds to a room, which fails if memory runs out.
void manifold_room_add(const ovoid_world *w, manifold_room *room, const ovoid_world_manifold *item);
void manifold_room_add_part(const ovoid_world *w, manifold_room *room, const ovoid_body_manifold *part,
                            const ovoid_manifold_points *points);

/// Decides the pairs of a chunk, and finds their manifolds.
void manifolds_find_chunk(ovoid_world *w, uint32_t c, uint32_t worker);

#endif
