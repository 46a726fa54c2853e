/**
 * @file robot_matrix.h
 * The collision matrix of a robot: which pairs of its links can never touch, which always do, and which sometimes do. A
 * statement about all states is either proven over the whole box of the joints' limits, by dividing it, or rests on a
 * number of random states and is marked as sampled. docs/robot-matrix.md has the mathematics.
 */
#ifndef OVOID_ROBOT_MATRIX_H
#define OVOID_ROBOT_MATRIX_H

#include "ovoid/robot.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What is known about two links. "All states" are those within the limits; continuous joints turn by any angle. */
typedef enum ovoid_robot_touch {
    OVOID_ROBOT_TOUCH_OPEN =
        0,                   /**< nothing: a joint between the two is planar or floating, or mimics a continuous one */
    OVOID_ROBOT_TOUCH_NEVER, /**< proven: apart in all states */
    OVOID_ROBOT_TOUCH_SAMPLED_NEVER,  /**< not proven: no sample was a hit */
    OVOID_ROBOT_TOUCH_ALWAYS,         /**< proven: in contact in all states */
    OVOID_ROBOT_TOUCH_SAMPLED_ALWAYS, /**< not proven: a hit was found, and no state that is proven free */
    OVOID_ROBOT_TOUCH_SOMETIMES,      /**< proven: one state is a hit and one is free */
    OVOID_ROBOT_TOUCH_RIGID           /**< only fixed joints are between the two: they are never queried */
} ovoid_robot_touch;

/** "open", "never", "sampled never", "always", "sampled always", "sometimes", "rigid"; never NULL. */
OVOID_API const char *ovoid_robot_touch_get_name(ovoid_robot_touch touch);

/** How a matrix is computed; all zero, or NULL, is the default. */
typedef struct ovoid_robot_matrix_options {
    size_t samples; /**< random states, for all pairs; 0: 10 000 */
    size_t budget;  /**< the largest number of cells of joint space that a pair's proof examines; 0: 100 000 */
    uint64_t seed;  /**< of the states: the same seed gives the same matrix */
    ovoid_watch
        watch; /**< asked before each eight states and each cell. If it stops the call: as if those so far were all */
    const ovoid_allocator *allocator; /**< NULL: malloc and free; copied */
} ovoid_robot_matrix_options;

/** Two links that both have elements, a < b. */
typedef struct ovoid_robot_matrix_pair {
    uint32_t a, b;
    ovoid_robot_touch touch;
    int is_neighbour;   /**< 1: no link with elements is between the two, if links that are joined by fixed joints count
                           as one: MoveIt calls this adjacent */
    size_t samples;     /**< states checked; 0 if the pair is OPEN or RIGID */
    size_t hits, frees; /**< of these, proven in contact and proven apart; the others are undecided */
    size_t cells;       /**< cells of joint space that the proof examined */
    const double *hit;  /**< a state in which they touch, proven; NULL: none was found. A view */
    const double *free; /**< a state in which they are apart, proven; NULL: none was found. A view */
} ovoid_robot_matrix_pair;

/** The matrix of a robot. Immutable. */
typedef struct ovoid_robot_matrix ovoid_robot_matrix;

/**
 * The matrix of all links that have elements; pairs that the description disables are included. The robot is read only
 * during the call. NULL on failure with *error filled (may be NULL): ARGUMENT (no robot), MEMORY, LIMIT (more than 2^24
 * pairs of elements). Cost: per sample as ovoid_robot_find_near without distances, per cell some microseconds; at most
 * budget cells a pair.
 */
OVOID_API ovoid_robot_matrix *ovoid_robot_matrix_create(const ovoid_robot *robot,
                                                        const ovoid_robot_matrix_options *options, ovoid_error *error);
/** Frees it; NULL is allowed. */
OVOID_API void ovoid_robot_matrix_destroy(ovoid_robot_matrix *matrix);
/** How many pairs there are. */
OVOID_API size_t ovoid_robot_matrix_get_count(const ovoid_robot_matrix *matrix);
/** Pair i < count, in the order of a, then b. */
OVOID_API ovoid_robot_matrix_pair ovoid_robot_matrix_get_pair(const ovoid_robot_matrix *matrix, size_t i);
/** The pair of two links, in either order, or NULL: one of them has no element, or both are the same link. */
OVOID_API const ovoid_robot_matrix_pair *ovoid_robot_matrix_find_pair(const ovoid_robot_matrix *matrix, uint32_t a,
                                                                      uint32_t b);

/**
 * Why a pair may be left out, in MoveIt's words: "Adjacent" (neighbours, rigid pairs), "Never", "Always"; NULL: query
 * it. with_sampled 1: sampled statements count as if proven.
 */
OVOID_API const char *ovoid_robot_matrix_pair_get_reason(const ovoid_robot_matrix_pair *pair, int with_sampled);

#ifdef __cplusplus
}
#endif
#endif
