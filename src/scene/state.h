// What a world is made of: bodies, tree, pairs, and what ages between them.
//
// A body's reference point r is the centre of its enclosing sphere, in the world. When the body moves, no point of it
// moves by more than |step of r| + turn, where turn is the chord of the rotation times the sphere's reach. So of any
// two bodies with d = r_b - r_a and t = turns of both since some moment (docs/world.md):
//   along a fixed direction n the gap is at least   gap before + n.(d now - d before) - t,
//   the signed distance is within                   |d now - d before| + t   of what it was.
// A body's `travel` is the sum of all its turns and of what rounding can hide in r, always rounded up.
#ifndef OVOID_SCENE_STATE_H
#define OVOID_SCENE_STATE_H

#include "ovoid/world.h"
#include "scene/broad.h"
#include "scene/ignored.h"
#include "scene/pool.h"
#include "scene/solid.h"

/// Where a body is, as the pairs need it: half a cache line.
typedef struct body_place {
    vec3 at;       ///< r, rounded
    double travel; ///< sum of turns, rounded up
} body_place;

/// Marks of a body since the last frame: it has another box, all its pairs are to be found afresh, it was moved. NAMED
/// and LEFT, its box, are used within one call.
enum { MARK_BOX = 1, MARK_FRESH = 2, MARK_MOVED = 4, MARK_NAMED = 8, MARK_LEFT = 16 };

typedef struct world_body {
    ovoid_solid solid;
    vec3 local;            ///< r in the user's local frame
    double reach;          ///< no point of the body without its radius is farther from r
    double radius;         ///< its rounding radius
    double size;           ///< bounds all lengths in its local frame
    double blur;           ///< what rounding hides in r at the present pose
    body_place placed;     ///< where it was when its box was made,
    float low[3], high[3]; ///< how far it may go from there, against and along each axis
    float way[3], turn;    ///< how far the last move took it, and by how much it turned it: only a forecast
    box seen;              ///< MARK_BOX: the box that the list of pairs is made of; empty where MARK_FRESH
    uint64_t user;
    uint32_t group, mask;
    uint32_t next; ///< of a free index: the next one; else the number of its ignored pairs
} world_body;

/// What of a pair is read every frame. The state of an answer that lasts is one comparison:
///   PLANE:  c + v.d - t > 0        v the normal, farther than the margin
///   BALL:   c - |d - v| - t > 0    v was d, within the margin or overlapping
///   SPHERE: |d| - c > 0            the enclosing spheres are farther than the margin
/// with t the sum of both travels.
typedef enum pair_kind { PAIR_OPEN = 0, PAIR_PLANE, PAIR_BALL, PAIR_SPHERE } pair_kind;
enum { PAIR_CONTACT = 1, PAIR_STILL = 2, PAIR_KNOWN = 4, PAIR_CHECK = 8 };
typedef struct world_pair {
    uint32_t a, b;
    vec3 v;
    double c;
    uint32_t slot; ///< of what is kept
    uint16_t kind;
    uint16_t flags; ///< CONTACT: reported; STILL: neither body has moved since the query; KNOWN: it was asked;
                    ///< CHECK: kind and c are of this frame, not yet compared
} world_pair;

/// What is kept of a pair's last query.
typedef struct kept {
    vec3 between;        ///< d then
    double travel;       ///< t then
    double lower, upper; ///< then
    vec3 normal;         ///< of the lower bound, world; zero: none
    union {
        vec3 inner;           ///< INNER: the common point, A's body frame
        uint16_t entry[6][2]; ///< the proof's vertices of A and B
    } of;
    uint32_t part_a, part_b;
    uint32_t iterations;
    uint8_t status, stage, limit, proof; ///< ovoid_status, ovoid_stage, ovoid_limit, ovoid_proof_kind
    uint8_t count;                       ///< entries of the proof
} kept;

/// What a worker collects.
typedef struct gathered {
    uint64_t *keys;
    size_t count, capacity;
    int failed;
} gathered;

/// Of some hundred pairs: contacts, then contacts before them; pairs that were asked anew.
typedef struct chunk {
    size_t contacts, queried;
} chunk;

struct ovoid_world {
    ovoid_allocator allocator;
    pool_host host;
    uint32_t threads;
    double enlargement;
    ovoid_shape *point;
    ovoid_filter *filter;
    void *filter_context;
    // Bodies, by index. leaf_of is NONE where there is none.
    world_body *bodies;
    body_place *places;
    uint8_t *marks;
    uint32_t *leaf_of, *changed, *generations;
    uint32_t capacity, used, count, free;
    int has_vast;           ///< a compound of more than half of OVOID_LENGTH_MAX was added
    uint32_t changed_count; ///< bodies with MARK_BOX or MARK_FRESH: changed[0 ..]
    broad tree;
    ignored ignored;
    // Pairs, sorted by a, then b.
    world_pair *pairs;
    size_t pair_count, pair_capacity;
    kept *kept;
    ovoid_witness *witnesses; ///< beside kept, once a distance or depth was asked for
    size_t slot_used, slot_capacity, witness_slots;
    uint32_t *free_slots;
    size_t free_slot_count, free_slot_capacity;
    gathered *gathered; ///< of each worker
    uint64_t *keys;     ///< twice key_capacity
    size_t key_capacity;
    chunk *chunks;
    size_t chunk_capacity;
    // The last frame.
    int is_asked;
    ovoid_question question;
    double margin;       ///< of the boxes and of the question
    ovoid_options asked; ///< as given, zeros for NULL
    uint32_t frames;     ///< counted
    ovoid_contact *contacts;
    ovoid_witness *contact_witnesses;
    size_t contact_count, contact_capacity, witness_capacity;
    size_t memory; ///< bytes allocated
};

// ---- memory: counted

void *world_allocate(ovoid_world *w, size_t count, size_t size);
void world_release(ovoid_world *w, void *memory, size_t count, size_t size);
/// Room for `count` items, at least doubling; the first `used` are kept. 0: no memory, and nothing has changed.
int world_reserve(ovoid_world *w, void **items, size_t *capacity, size_t used, size_t count, size_t size);

/// All that the world holds.
size_t world_get_memory(const ovoid_world *w);

/// 1: the question wants points, which move with the bodies.
static inline int world_is_measuring(const ovoid_world *w) { return w->question >= OVOID_QUESTION_DISTANCE; }

// ---- bodies

static inline ovoid_id body_get_id(const ovoid_world *w, uint32_t i) { return (uint64_t)i << 32 | w->generations[i]; }
/// The index of an id; NONE where it names no body.
uint32_t world_find_body(const ovoid_world *w, ovoid_id id);
ovoid_code world_refuse_id(ovoid_error *error, int64_t place, ovoid_id id);
/// What is wrong with a solid or its pose.
ovoid_code world_check_solid(const ovoid_solid *solid, int64_t place, ovoid_error *error);
/// Whether groups, ignored pairs and the filter let a pair through.
int world_is_pair(const ovoid_world *w, uint32_t a, uint32_t b);
/// A new tree where the old one is worn: 1. 0: it is not, or there is no memory for it; then the old one stays.
int world_mend_tree(ovoid_world *w);
/// The bodies' boxes with another margin.
void world_set_margin(ovoid_world *w, double margin);

/// What solid_compute_ball says of the body.
static inline solid_ball body_get_ball(const world_body *b) {
    return (solid_ball){b->local, b->reach, b->radius, b->size};
}

// ---- pairs

/// Brings the list of pairs up to date with the boxes. 0: no memory, and nothing is lost.
int world_update_pairs(ovoid_world *w, ovoid_frame *counts);

#endif
