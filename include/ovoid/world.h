/**
 * @file world.h
 * Many bodies that move: which of them touch, and which are near, in each step; each pair's proof is cached.
 *
 * A world holds bodies by ids, a dynamic tree of enlarged boxes over them, the list of pairs whose enlarged boxes
 * overlap, and the last proof of each of these pairs. A step of the host ends with ovoid_world_compute_contacts: one
 * query of all pairs at once. Its contacts are the same, bit for bit, whatever the number of threads. docs/world.md has
 * the mathematics.
 *
 * Functions that take a const world may run at the same time in any number of threads; all others need exclusive access
 * to the world. Stack as in <ovoid/query.h>, with solids as in <ovoid/body.h>; the world's own threads have 1 MB. A
 * child process made by fork, while no function was changing the world, can use the world in one thread. Lengths are in
 * the caller's unit, poses in the world frame, quaternions as in ovoid_pose.
 */
#ifndef OVOID_WORLD_H
#define OVOID_WORLD_H

#include "ovoid/body.h"
#include "ovoid/motion.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Bodies, their pairs, and the cached answers of the pairs. */
typedef struct ovoid_world ovoid_world;

/**
 * The id of a body of a world: index << 32 | generation; 0 is no body. The index of a removed body is used again with
 * another generation, so an old id is refused and never taken for another body. Comparing ids compares indices.
 */
typedef uint64_t ovoid_id;

/** The largest number of threads of a world. */
#define OVOID_WORLD_THREADS_MAX 256u

/** The largest number of bodies of a world. */
#define OVOID_WORLD_BODIES 0x7fffff00u

/**
 * The host's task system. start: calls run(work, first, end, worker) for parts [first, end) that together make [0,
 * count), in any threads, at once or later, with parts of at least `least` items if possible; worker differs between
 * threads that run at the same time, and is below ovoid_world_options.threads. finish: returns when all of a started
 * work is done. Both are called by the thread that called the world. All zero: the world's own threads.
 */
typedef struct ovoid_tasks {
    void *(*start)(void *context, void (*run)(void *work, uint32_t first, uint32_t end, uint32_t worker), void *work,
                   uint32_t count, uint32_t least);
    void (*finish)(void *context, void *handle);
    void *context;
} ovoid_tasks;

/** 1: the pair is queried, 0: never. The result must depend on the ids alone; several threads may call it. */
typedef int ovoid_filter(void *context, ovoid_id a, ovoid_id b);

/** Options of a world; all zero, or NULL, is the default. */
typedef struct ovoid_world_options {
    uint32_t threads; /**< workers, the caller's thread included; 0: 1. At most
                           OVOID_WORLD_THREADS_MAX */
    ovoid_tasks
        tasks; /**< what runs them; all zero: threads of the world's own, which sleep when there is nothing to do */
    double enlargement; /**< of a body's box to each side, in units of the body's size: how far the body may move before
                           the tree is updated. 0: chosen by the world. At most 100 */
    const ovoid_allocator *allocator; /**< NULL: malloc and free; copied. Called from the workers too */
    ovoid_filter *filter;             /**< NULL: all pairs */
    void *filter_context;             /**< passed to the filter */
} ovoid_world_options;

/** A world without bodies; NULL on failure: ARGUMENT, MEMORY, LIMIT (threads could not be started). */
OVOID_API ovoid_world *ovoid_world_create(const ovoid_world_options *options, ovoid_error *error);

/** Ends its threads and frees it; NULL is allowed. The shapes remain the caller's. */
OVOID_API void ovoid_world_destroy(ovoid_world *world);

/**
 * Which bodies are queried with one another: two are a pair if a.group & b.mask and b.group & a.mask are both not zero.
 * Both zero means all bits of both.
 */
typedef struct ovoid_groups {
    uint32_t group, mask;
} ovoid_groups;

/** What ovoid_world_add takes. */
typedef struct ovoid_world_body {
    ovoid_body body; /**< everything that it points to must live as long as the body */
    ovoid_groups groups;
    uint64_t user; /**< the caller's own; the world only stores it */
} ovoid_world_body;

/**
 * Adds a body; 0 on failure, and the world is unchanged: ARGUMENT, the codes of ovoid_pose_validate, LIMIT, MEMORY.
 * Cost: one insertion into the tree.
 */
OVOID_API ovoid_id ovoid_world_add(ovoid_world *world, const ovoid_world_body *body, ovoid_error *error);
/** Bodies to add. */
typedef struct ovoid_world_additions {
    const ovoid_world_body *bodies;
    size_t count;
    ovoid_id *ids; /**< receives their ids, in their order; may be NULL */
} ovoid_world_additions;

/** Adds many bodies, all or none (place: the body that is refused). Faster than one by one. */
OVOID_API ovoid_code ovoid_world_add_many(ovoid_world *world, const ovoid_world_additions *additions,
                                          ovoid_error *error);

/** Removes a body with its ignored pairs. Errors: INDEX, the id was never this world's, or is no longer. */
OVOID_API ovoid_code ovoid_world_remove(ovoid_world *world, ovoid_id id, ovoid_error *error);
/**
 * Removes many bodies, all or none: if an id is refused (INDEX, also for an id that occurs twice; place: which of ids),
 * the world is unchanged.
 */
OVOID_API ovoid_code ovoid_world_remove_many(ovoid_world *world, const ovoid_id *ids, size_t count, ovoid_error *error);

/**
 * Moves a body to a pose, allocating nothing. Errors: INDEX, and the codes of ovoid_pose_validate; then the body is not
 * moved.
 */
OVOID_API ovoid_code ovoid_world_move(ovoid_world *world, ovoid_id id, const ovoid_pose *pose, ovoid_error *error);
/** Bodies to move, and their new poses. */
typedef struct ovoid_world_moves {
    const ovoid_id *ids;
    const ovoid_pose *poses;
    size_t count;
} ovoid_world_moves;

/** Moves many bodies, in the given order; all or none (place: the first that is refused). LIMIT: 2^32 - 1 or more. */
OVOID_API ovoid_code ovoid_world_move_many(ovoid_world *world, const ovoid_world_moves *moves, ovoid_error *error);

/** The body in its present state. Errors: INDEX. */
OVOID_API ovoid_code ovoid_world_get(const ovoid_world *world, ovoid_id id, ovoid_world_body *body, ovoid_error *error);
/** Number of bodies. */
OVOID_API size_t ovoid_world_get_count(const ovoid_world *world);
/** The first body after the given one in the order of ids (after 0: the first of all); 0 if there is none. */
OVOID_API ovoid_id ovoid_world_find_next(const ovoid_world *world, ovoid_id after);

/** Sets new groups for a body; its pairs are found again. Errors: INDEX. */
OVOID_API ovoid_code ovoid_world_set_groups(ovoid_world *world, ovoid_id id, ovoid_groups groups, ovoid_error *error);
/**
 * Tells the world that the filter's answers for this body may have changed: its pairs are found again. Errors: INDEX.
 */
OVOID_API ovoid_code ovoid_world_renew(ovoid_world *world, ovoid_id id, ovoid_error *error);
/** Excludes a pair from now on. Errors: INDEX, ARGUMENT (a is b), MEMORY. */
OVOID_API ovoid_code ovoid_world_add_ignored(ovoid_world *world, ovoid_id a, ovoid_id b, ovoid_error *error);
/** Queries an excluded pair again. Errors: INDEX, ARGUMENT (a is b). */
OVOID_API ovoid_code ovoid_world_remove_ignored(ovoid_world *world, ovoid_id a, ovoid_id b, ovoid_error *error);
/** 1 if groups, ignored pairs and the filter allow a query of the two; 0 if not, or if an id is stale. */
OVOID_API int ovoid_world_is_pair(const ovoid_world *world, ovoid_id a, ovoid_id b);

/** The query of each pair. */
typedef enum ovoid_query_kind {
    OVOID_QUERY_COLLIDE = 0, /**< do they touch? (ovoid_collide) margin must be 0 */
    OVOID_QUERY_WITHIN,      /**< are they within the margin? (ovoid_within) */
    OVOID_QUERY_DISTANCE,    /**< how far apart, if within the margin? (ovoid_distance with the margin as cap) */
    OVOID_QUERY_DEPTH /**< how far apart, or how deep, if within the margin? (ovoid_depth); with a solid the bracket of
                         the depth is that of ovoid_body_distance */
} ovoid_query_kind;

/** The query of all pairs of a world. */
typedef struct ovoid_contact_query {
    ovoid_query_kind kind;
    double margin; /**< >= 0, finite; boxes are enlarged by half of it, so a new margin costs a rebuild */
    const ovoid_options *options; /**< of each query; NULL: the default. Its cap is not used: the margin is the cap */
} ovoid_contact_query;

/**
 * A pair that is not proven farther than the margin. verdict.lower <= d <= verdict.upper holds at the present poses.
 */
typedef struct ovoid_contact {
    ovoid_id a, b;           /**< a < b */
    uint64_t user_a, user_b; /**< stored with the bodies (ovoid_world_body) */
    uint32_t part_a, part_b; /**< the deciding parts of compounds or triangles of solids; 0 for a shape */
    ovoid_verdict verdict; /**< stage PROOF with 0 iterations: from the kept bounds of an earlier step's proof, adjusted
                              for the motion since */
} ovoid_contact;

/**
 * The contacts of a step. The arrays belong to the world and are valid until the next call with a world that is not
 * const.
 */
typedef struct ovoid_contacts {
    const ovoid_contact *items; /**< sorted by a, then b */
    const ovoid_witness
        *witnesses; /**< beside them for DISTANCE and DEPTH; else NULL (ovoid_world_compute_proof has more) */
    size_t count;
    size_t bodies;  /**< in the world */
    size_t pairs;   /**< pairs whose enlarged boxes overlap */
    size_t aged;    /**< of these, answered by the adjusted bounds of an earlier proof, without reading geometry */
    size_t queried; /**< the others: the proof was measured again, or the pair queried */
    size_t added, dropped; /**< pairs since the step before */
    size_t moved;          /**< bodies that left their enlarged boxes since the step before, or are new */
    uint32_t rebuilt;      /**< 1: the tree was rebuilt */
    size_t memory;         /**< bytes that the world holds */
} ovoid_contacts;

/**
 * All pairs that are not proven farther apart than the margin, with their answers: the statuses are those of a query of
 * each pair alone. Errors: ARGUMENT (query, margin), MEMORY; then nothing is lost, and the call can be repeated. Cost:
 * docs/world.md.
 */
OVOID_API ovoid_code ovoid_world_compute_contacts(ovoid_world *world, const ovoid_contact_query *query,
                                                  ovoid_contacts *contacts, ovoid_error *error);

/** The whole answer of a contact, and its proof. */
typedef struct ovoid_contact_proof {
    ovoid_exclusions *exclusions; /**< room for exclusions, owned by the caller; NULL: none are written */
    ovoid_body_answer answer;     /**< written */
} ovoid_contact_proof;

/**
 * The whole answer of a contact at the present poses, with the proof for ovoid_body_verify (of two shapes: for
 * ovoid_answer_verify). The query is that of the last step, with its cached proof as warm start. Errors: INDEX (place
 * 0: a, 1: b), ARGUMENT. Cost: one query.
 */
OVOID_API ovoid_code ovoid_world_compute_proof(const ovoid_world *world, const ovoid_contact *contact,
                                               ovoid_contact_proof *proof, ovoid_error *error);

/*
 * Queries between steps. None of them allocates or changes anything; each uses the present poses, in any thread, while
 * no other thread changes the world. Pairs that are filtered out (ovoid_world_is_pair) are left out; for a probe, which
 * is not a body of the world, only groups and masks apply, not ignored pairs and the filter. Answers are those of
 * <ovoid/body.h> without a warm start. Errors of all: ARGUMENT (options, margin), INDEX (an id), and for a probe those
 * of ovoid_world_add.
 */

/** The pair that a query found. */
typedef struct ovoid_world_hit {
    ovoid_id a, b; /**< b: the body found; 0: none. a: the querying body; for a probe 0, or its number of several */
    double lower;  /**< nearest: no queried pair is nearer, unless two overlap, which ends the search; if no pair was
                      found, the cap or infinity */
    ovoid_body_answer answer; /**< of the bodies of a and b, in that order */
} ovoid_world_hit;

/** Some bodies of a world. */
typedef struct ovoid_world_ids {
    const ovoid_id *items;
    size_t count;
} ovoid_world_ids;

/**
 * Does any of these bodies touch another one? ids NULL: any of all. Stops at the first pair that is not proven apart:
 * hit->b is 0 if all are apart. Cost: a traversal of the tree for each body, and the queries of the bodies whose boxes
 * its box meets.
 */
OVOID_API ovoid_code ovoid_world_find_any(const ovoid_world *world, const ovoid_world_ids *ids, ovoid_world_hit *hit,
                                          ovoid_error *error);

/**
 * Bodies that are not in the world, for example the links of a robot in a state, and which of them are queried with one
 * another.
 */
typedef struct ovoid_world_probes {
    const ovoid_world_body *items;
    size_t count;
    const ovoid_couple
        *couples; /**< pairs of items, by number; groups do not apply here. couple_count of them, or none */
    size_t couple_count;
} ovoid_world_probes;

/** Marks the number of a probe in the place of a body's id. */
#define OVOID_WORLD_PROBE ((ovoid_id)1 << 63)

/**
 * Does any of these bodies, which are not in the world, touch a body of it, or one another? For a planner that checks
 * states of its robot, from any number of threads. First the probes in their given order, up to the first that is not
 * proven apart: hit->a is its number, hit->b the body. Then the couples of probes in their given order, each probe
 * placed once: hit->a is the number of one probe, hit->b OVOID_WORLD_PROBE | that of the other. Errors: place is the
 * probe that is refused, and those before it are apart; INDEX, a couple with a number that is not a probe (place: which
 * of couples), before anything is queried. Cost: for each probe its box, a traversal, and the queries of the bodies
 * that the box meets.
 */
OVOID_API ovoid_code ovoid_world_find_any_of(const ovoid_world *world, const ovoid_world_probes *probes,
                                             ovoid_world_hit *hit, ovoid_error *error);

/** A query of one body: of a body of the world by its id, or of a probe. */
typedef struct ovoid_world_query {
    ovoid_id id;                   /**< 0: `probe` is the querying body */
    const ovoid_world_body *probe; /**< a body that is not in the world; not used if there is an id */
    double margin;                 /**< >= 0, finite; of ovoid_world_find_overlaps */
    const ovoid_options *options;  /**< of each query; NULL: the default */
} ovoid_world_query;

/** The body nearest to a body, within query->options->cap; one of the overlapping bodies if there are any. */
OVOID_API ovoid_code ovoid_world_find_nearest(const ovoid_world *world, const ovoid_world_query *query,
                                              ovoid_world_hit *hit, ovoid_error *error);
/**
 * The nearest two of all bodies, within options->cap; two that overlap end the search. The tree is traversed against
 * itself.
 */
OVOID_API ovoid_code ovoid_world_find_nearest_pair(const ovoid_world *world, const ovoid_options *options,
                                                   ovoid_world_hit *hit, ovoid_error *error);

/** Memory for hits. */
typedef struct ovoid_world_hits {
    ovoid_world_hit *items; /**< owned by the caller; may be NULL if capacity is 0 */
    size_t capacity;
    size_t count; /**< written: how many there are; if more than capacity, those found first were written */
} ovoid_world_hits;

/** All bodies that are not proven farther than query->margin from a body, sorted by id. */
OVOID_API ovoid_code ovoid_world_find_overlaps(const ovoid_world *world, const ovoid_world_query *query,
                                               ovoid_world_hits *hits, ovoid_error *error);

/** A probe that is a point, to find the bodies that contain it, or the nearest one. The world owns its shape. */
OVOID_API ovoid_world_body ovoid_world_make_point(const ovoid_world *world, ovoid_vec3 point);

/** The first hit of a ray or of a moved body. */
typedef struct ovoid_world_cast {
    ovoid_id body;        /**< 0: none */
    uint32_t part, probe; /**< part of the body, and of the probe; of solids the triangles */
    double lower, upper;  /**< bracket of the first t; if nothing is hit, the whole length and infinity */
    ovoid_vec3 point;     /**< of the body, world */
    ovoid_vec3 normal;    /**< unit, out of the body */
    uint32_t undecided;   /**< casts that ended without a bracket; lower includes them, upper does not */
} ovoid_world_cast;

/** A ray, and the groups whose bodies it can hit. */
typedef struct ovoid_world_ray {
    ovoid_ray ray;
    ovoid_groups groups; /**< as of a body */
} ovoid_world_ray;

/**
 * The first hit of a ray, thick if its radius is above 0; t in lengths of its direction. A ray without a radius that
 * enters a closed solid is proven by a point inside, at least 1e-12 of the size further; a ray that only grazes a
 * solid, or meets a surface without an inside, is undecided. Errors: ARGUMENT (the ray).
 */
OVOID_API ovoid_code ovoid_world_cast_ray(const ovoid_world *world, const ovoid_world_ray *ray, ovoid_world_cast *cast,
                                          ovoid_error *error);
/** A body that is not in the world, moved along `displacement` without rotation. */
typedef struct ovoid_world_sweep {
    ovoid_world_body probe;
    ovoid_vec3 displacement;
} ovoid_world_sweep;

/** The first hit of a body on its way; t from 0 to 1. */
OVOID_API ovoid_code ovoid_world_cast_body(const ovoid_world *world, const ovoid_world_sweep *sweep,
                                           ovoid_world_cast *cast, ovoid_error *error);

#ifdef __cplusplus
}
#endif
#endif
