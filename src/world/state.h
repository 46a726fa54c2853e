// The parts of a world: bodies, tree, pairs, and the state that changes with the motion.
//
// A body's reference point r is the centre of its enclosing sphere, in the world. When the body moves, no point of it
// moves by more than |step of r| + turn, where turn is the chord of the rotation times the sphere's reach. So of any
// two bodies with d = r_b - r_a and t = turns of both since some moment (docs/world.md):
//   along a fixed direction n the gap is at least   gap before + n.(d now - d before) - t,
//   the signed distance is within                   |d now - d before| + t   of what it was.
// A body's `travel` is the sum of all its turns and of what rounding can hide in r, always rounded up.
#ifndef OVOID_WORLD_STATE_H
#define OVOID_WORLD_STATE_H

#include "base/compiler.h"
#include "exact/cover_memory.h"
#include "ovoid/world_manifolds.h"
#include "world/body_bounds.h"
#include "world/ignored.h"
#include "world/thread_pool.h"
#include "world/tree/dynamic_tree.h"

/// The place of a body, as pairs read it: half a cache line.
typedef struct body_place {
    vec3 at;       ///< r, rounded
    double travel; ///< sum of turns, rounded up
} body_place;

/// Marks of a body since the last step: its box changed, all its pairs must be found again, its pairs must be compared
/// again, it has another pose. NAMED, LEFT (its box) and AWAY (its new box does not overlap the old one) are used
/// within one call.
enum { MARK_BOX = 1, MARK_FRESH = 2, MARK_MOVED = 4, MARK_NAMED = 8, MARK_LEFT = 16, MARK_POSED = 32, MARK_AWAY = 64 };

/// Four cache lines, of which pairs read the first two.
typedef struct world_body {
    _Alignas(64) ovoid_body body;
    double reach;        ///< no point of the body without its radius is farther from r
    double radius;       ///< its rounding radius, with what its allowance adds
    double center_error; ///< error of r at the present pose, length
    uint64_t user;
    ovoid_groups groups;
    uint32_t next;               ///< of a free index: the next one; else the number of the body's ignored pairs
    uint32_t boxes;              ///< the number of boxes since it was added
    vec3 local;                  ///< r in the body's local frame
    double size;                 ///< bounds all lengths in its local frame
    body_place placed;           ///< its place when its box was computed
    float low[3], high[3];       ///< how far it may move from that place, against and along each axis
    float displacement[3], turn; ///< of the last move: only a forecast of the next one
} world_body;

/// The groups of a body or a probe; if both are zero, all bits of both.
static inline ovoid_groups groups_make(ovoid_groups given) {
    return given.group || given.mask ? given : (ovoid_groups){~0u, ~0u};
}

static inline int groups_are_paired(const ovoid_groups *a, const ovoid_groups *b) {
    return (a->group & b->mask) && (b->group & a->mask);
}

/// The part of a pair's state that every step reads. Whether a cached answer still holds is one comparison:
///   PLANE:  c + v.d - t > 0        v the normal, farther than the margin
///   BALL:   c - |d - v| - t > 0    v was d, within the margin or overlapping
///   SPHERE: |d| - c > 0            the enclosing spheres are farther than the margin
/// with t the sum of both travels.
typedef enum pair_kind { PAIR_OPEN = 0, PAIR_PLANE, PAIR_BALL, PAIR_SPHERE } pair_kind;
enum { PAIR_CONTACT = 1, PAIR_STILL = 2, PAIR_KNOWN = 4, PAIR_CHECK = 8, PAIR_FULL = 16 };
typedef struct world_pair {
    uint32_t a, b;
    vec3 v;
    double c;
    uint32_t slot; ///< of pair_cache and witnesses
    uint16_t kind;
    uint16_t flags; ///< CONTACT: reported; STILL: neither body has moved since the query; KNOWN: it has been queried;
                    ///< CHECK: kind and c are new in this step, and not yet compared
} world_pair;

/// The cached answer of a pair's last query: two cache lines. Contacts are written from the first one.
typedef struct pair_cache {
    _Alignas(64) vec3 between; ///< d at that time
    double travel;             ///< t at that time
    double lower, upper;       ///< of the signed distance at that time
    uint32_t part_a, part_b;
    uint32_t iterations;
    uint8_t status, stage, limit, proof; ///< ovoid_status, ovoid_stage, ovoid_limit, ovoid_proof_kind
    vec3 normal;                         ///< of the lower bound, world; zero: none
    union {
        vec3 inner;           ///< INNER: the common point, A's body frame
        uint16_t entry[6][2]; ///< the proof's vertices of A and B
    } of;
    uint8_t count; ///< entries of the proof
} pair_cache;

/// The surface that the next depth of a pair of shapes starts from; only where the pair's cached proof is a cover.
typedef struct kept_depth {
    uint32_t point_count, triangle_count; ///< 0: none
    small_cover of;
} kept_depth;

/// Prefetches two cache lines: a cached answer, or what queries read of a body.
static inline void prefetch_two_lines(const void *at) {
    compiler_prefetch(at);
    compiler_prefetch((const char *)at + 64);
}

/// What one worker found: the keys of new pairs; the first move that is refused, and whether moves are out of order.
typedef struct gathered {
    uint64_t *keys;
    size_t count, capacity;
    int failed;
    uint32_t refused; ///< NONE: no move
    int is_unordered; ///< the indices of the bodies that are moved do not rise
} gathered;

/// Counts of a chunk of CHUNK pairs: its contacts, later the contacts before it; its pairs that were queried again, and
/// those of them whose search for a depth filled its memory.
typedef struct chunk {
    size_t contacts, queried, full;
} chunk;

/// How far beyond the margin contacts of a body are wanted.
typedef struct body_range {
    double now;
    double boxed; ///< for which its box has room
    double spare; ///< for which its next box gets room beside that, as a body that accelerates needs more in each step
} body_range;

/// The manifolds of the last step that asked for them (manifolds.h).
typedef struct manifolds manifolds;

struct ovoid_world {
    ovoid_allocator allocator;
    task_host host;
    uint32_t threads;
    double enlargement;
    ovoid_shape *point;
    ovoid_filter *filter;
    void *filter_context;
    // Bodies, by index. leaf_of is NONE for a free index.
    world_body *bodies;
    body_place *places;
    uint8_t *marks;
    box *seen; ///< MARK_BOX: the box from which the list of pairs was made; empty if MARK_FRESH
    uint32_t *leaf_of, *changed, *generations;
    uint32_t capacity, used, count, free;
    int has_vast;           ///< a compound or solid larger than half of OVOID_LENGTH_MAX was added
    uint32_t changed_count; ///< bodies with MARK_BOX or MARK_FRESH: changed[0 ..]
    dynamic_tree tree;
    size_t wide_capacity;
    ignored ignored;
    // Pairs, sorted by a, then b.
    world_pair *pairs;
    size_t pair_count, pair_capacity;
    uint64_t *ended; ///< a bit for each pair: its boxes no longer overlap
    size_t ended_capacity;
    pair_cache *pair_cache;
    ovoid_witness *witnesses; ///< beside pair_cache, once a distance or depth was queried
    kept_depth *depths;       ///< beside pair_cache, once a depth was queried
    size_t slot_used, slot_capacity, witness_slots, depth_slots;
    uint32_t *free_slots;
    size_t free_slot_count, free_slot_capacity;
    gathered *gathered; ///< one for each worker
    uint64_t *keys;     ///< room for 2 key_capacity
    size_t key_capacity;
    chunk *chunks;
    size_t chunk_capacity;
    unsigned char *cover_memory; ///< of searches for depths that fill their own; NULL: none did yet
    size_t cover_size;
    // The last step.
    int has_query, wants_manifolds;
    ovoid_query_kind kind;
    double margin;               ///< of the boxes and of the query
    ovoid_options query_options; ///< as given; zeros for NULL
    uint32_t steps;              ///< steps so far
    ovoid_contact *contacts;
    ovoid_witness *contact_witnesses;
    size_t contact_count, contact_capacity, witness_capacity;
    manifolds *manifolds; ///< NULL: none were computed yet
    // What callers set of bodies for their manifolds, and how far these reach; none for an index beyond the capacity.
    ovoid_material *materials;
    body_range *ranges;
    size_t material_capacity, range_capacity;
    size_t memory; ///< bytes allocated
};

/// By how much farther than the margin the pairs of a step get their answers.
static inline double world_get_range(const ovoid_world *w, uint32_t i) {
    return i < w->range_capacity ? w->ranges[i].now : 0;
}
static inline double world_get_pair_range(const ovoid_world *w, uint32_t a, uint32_t b) {
    return w->wants_manifolds && w->range_capacity ? world_get_range(w, a) + world_get_range(w, b) : 0;
}

// ---- memory, counted

void *world_allocate(ovoid_world *w, size_t count, size_t size);
void world_release(ovoid_world *w, void *memory, size_t count, size_t size);
/// Room for `count` items, at least doubling; the first `used` are copied. 0: no memory, and nothing has changed.
int world_reserve(ovoid_world *w, void **items, size_t *capacity, size_t used, size_t count, size_t size);

/// The number of bytes that the world holds.
size_t world_get_memory(const ovoid_world *w);

/// 1 if contacts have witness points.
static inline int world_has_witnesses(const ovoid_world *w) { return w->kind >= OVOID_QUERY_DISTANCE; }
/// 1 if the query's answers have points, which move with the bodies.
static inline int world_is_measuring(const ovoid_world *w) { return world_has_witnesses(w) || w->wants_manifolds; }

// ---- bodies

static inline ovoid_id body_get_id(const ovoid_world *w, uint32_t i) { return (uint64_t)i << 32 | w->generations[i]; }
/// The index of an id; NONE if it is not a body's.
uint32_t world_find_body(const ovoid_world *w, ovoid_id id);
ovoid_code world_refuse_id(ovoid_error *error, int64_t place, ovoid_id id);
/// The largest length in the frame of a compound or a solid; 0 of a shape.
double world_get_extent(const ovoid_body *body);
/// OVOID_OK, or what is wrong with a body or its pose.
ovoid_code world_validate_body(const ovoid_body *body, int64_t place, ovoid_error *error);
/// 1 if groups, ignored pairs and the filter let a pair through.
int world_is_pair(const ovoid_world *w, uint32_t a, uint32_t b);
/// Builds a new tree if the old one is worn: 1. 0: it is not worn, or memory ran out; then the old one stays.
int world_mend_tree(ovoid_world *w);
/// Builds the tree's wide nodes, if it has none; if memory runs out, the world works without them.
void world_widen_tree(ovoid_world *w);
/// Gives all bodies new boxes, for another margin.
void world_set_margin(ovoid_world *w, double margin);

/// The body's enclosing sphere.
static inline body_sphere body_get_sphere(const world_body *b) {
    return (body_sphere){b->local, b->reach, b->radius, b->size};
}

// ---- pairs

/// Updates the list of pairs for the boxes that changed. 0: memory ran out, and nothing is lost.
int world_update_pairs(ovoid_world *w, ovoid_contacts *counts);

#endif
