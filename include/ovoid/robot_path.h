/**
 * @file robot_path.h
 * Proven motions of a robot: is a path free for all times in between, and if not, when and where is the first hit?
 *
 * A path goes through states; between two neighbours every variable is linear in the path's parameter s, which is i at
 * state i. Free means: at every real s, every queried pair of the cell is farther apart than the margin, in the exact
 * kinematics. The proof consists of steps, each of a pair and an interval, which ovoid_robot_path_verify measures again
 * without a search. docs/robot-path.md has the mathematics.
 */
#ifndef OVOID_ROBOT_PATH_H
#define OVOID_ROBOT_PATH_H

#include "ovoid/robot.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The largest number of states of a path. */
#define OVOID_ROBOT_PATH_STATES_MAX ((size_t)1 << 20)

/** The states that a path goes through. */
typedef struct ovoid_robot_path {
    const double *states; /**< state i from i * variable count on; borrowed */
    size_t count;         /**< >= 1 */
} ovoid_robot_path;

/** The measurement of a step. Motion: a bound of how far a point of one body moves in the frame of the other one. */
typedef enum ovoid_robot_step_kind {
    OVOID_ROBOT_STEP_OUTER = 1, /**< at the middle of the interval, spheres or boxes around the bodies are farther apart
                                   than margin and motion */
    OVOID_ROBOT_STEP_MIDDLE,    /**< at the middle, the gap along `normal` is above margin and motion */
    OVOID_ROBOT_STEP_ENDS, /**< at both ends, the gap along `normal` is above the margin by more than it may fall below
                              its chord in between */
    OVOID_ROBOT_STEP_SOLID /**< for a pair with a solid: at the middle, the distance of the bodies is above margin and
                              motion. The check queries the distance again */
} ovoid_robot_step_kind;

/**
 * A proof that a pair, or with OUTER up to eight, stay apart over an interval of s between two neighbouring states.
 * Pairs are numbers of the cell (ovoid_robot_cell_get_pair), valid until the cell changes.
 */
typedef struct ovoid_robot_step {
    double begin, end;
    uint32_t pair;     /**< the pair; of OUTER the first of eight */
    uint16_t kind;     /**< ovoid_robot_step_kind */
    uint16_t mask;     /**< bit i: the step is of pair + i */
    ovoid_vec3 normal; /**< unit, in the frame of the lowest link above both bodies; for an obstacle in that of the
                          root. Zero for OUTER and SOLID */
} ovoid_robot_step;

/** Options of a path's query; all zero, or NULL, is the default. */
typedef struct ovoid_robot_path_options {
    ovoid_robot_query_options query; /**< margin, limits, which pairs */
    double tolerance; /**< of hit_at - free_until, in s; 0 means 2^-20. Up to 1/32 if a body's allowance leaves the time
                         of contact open. Of a clearance: of its bracket, a length; 0 means 1/1024 of the radius of the
                         robot's largest element */
    uint32_t
        states; /**< the largest number of states checked; 0 means 100 000, for a clearance 100 more for each segment */
    ovoid_robot_step *steps; /**< receives the proof's steps, up to capacity; NULL: not written. Only for
                                ovoid_robot_path_find_hit, like the fields that follow */
    size_t capacity;
    ovoid_watch watch; /**< asked before each state. If it stops the call: as if `states` were used up */
    int any_hit; /**< 1: any hit ends the search: some states are checked before anything is proven. Then hit_at need
                    not be the first hit, and free_until is what was proven so far, often 0. The answer whether the path
                    is free is the same as without it, and sooner if it is not. Without `steps`, covers prove most of
                    it: sooner in both cases, if the bodies move far (docs/robot-path.md), and the bracket of a hit may
                    be as wide as that of ovoid_robot_collide */
} ovoid_robot_path_options;

/** A query of a path. */
typedef struct ovoid_robot_path_query {
    const ovoid_robot_path *path;
    const ovoid_robot_path_options *options; /**< NULL: the default */
} ovoid_robot_path_query;

/** The answer to a path. */
typedef struct ovoid_robot_path_answer {
    ovoid_robot_status status; /**< UNDECIDED: the pair of `hit` stays so near the margin that doubles cannot decide, or
                                  options.states are used up, or (hit.code EMPTY) no pair is queried; REFUSED: see
                                  hit.code, hit.variable and `refused` */
    double free_until;         /**< proven: free at all s before it */
    double hit_at;             /**< HIT: the state there is within the margin, proven; else infinity */
    size_t
        refused; /**< REFUSED: the number of the refused state, or of the state at which the refused segment begins */
    ovoid_robot_answer
        hit; /**< HIT: of the state at hit_at; UNDECIDED: the pair, and its bracket where it was last measured */
    uint32_t states;   /**< states checked one by one; of covers only one that hits counts */
    size_t step_count; /**< steps that prove free_until; if more than the capacity, the others were not written. With
                          any_hit and without `steps`: 0, because covers write none */
} ovoid_robot_path_answer;

/**
 * Is the path free, and if not, when is the first hit? F. Schwarzer, M. Saha, J.-C. Latombe, Exact collision checking
 * of robot paths, 2002, bound how far bodies move; here each bound counts only the joints between the two bodies,
 * includes rounding, and is of second order along one normal. A segment along which a floating joint turns is refused
 * (ARGUMENT), as interpolated quaternion numbers are not a motion. Errors: ARGUMENT (options, no states, too many),
 * MEMORY; then *answer is UNDECIDED. The checker keeps the search's memory: only the first path after a change of the
 * cell allocates, and the first one with any_hit and without steps. Cost: some tens of states a segment.
 */
OVOID_API ovoid_code ovoid_robot_path_find_hit(ovoid_robot_checker *checker, const ovoid_robot_path_query *query,
                                               ovoid_robot_path_answer *answer, ovoid_error *error);

/** Edges: each is a path of two states. */
typedef struct ovoid_robot_edge_batch {
    const double *states; /**< the two states of edge i from 2 i * variable count on; borrowed */
    size_t count;
    const ovoid_robot_path_options *options; /**< NULL: the default. No steps are written */
    ovoid_robot_path_answer *answers;        /**< count */
} ovoid_robot_edge_batch;

/**
 * Checks many edges, in blocks of OVOID_ROBOT_BLOCK, on as many threads as there are checkers (of one cell, each given
 * once), the caller's included. Each edge gets the status that ovoid_robot_path_find_hit gives to it alone. With
 * any_hit several short edges are proven side by side, which is sooner. The answers do not depend on the number of
 * threads. Edges that are not looked at because the watch has stopped the call are UNDECIDED. Errors: ARGUMENT
 * (options, also steps; no checker), MEMORY; then all answers are UNDECIDED. LIMIT: no thread could be started; the
 * others did the work, and all answers are written.
 */
OVOID_API ovoid_code ovoid_robot_path_find_hit_batch(ovoid_robot_checker *const *checkers, size_t checker_count,
                                                     const ovoid_robot_edge_batch *batch, ovoid_error *error);

/** What an answer to a path is verified with. */
typedef struct ovoid_robot_path_basis {
    ovoid_robot_path_query query;  /**< margin, limits and pairs of its options are used */
    const ovoid_robot_step *steps; /**< all step_count of them */
} ovoid_robot_path_basis;

/**
 * Verifies an answer without any search: the steps hold, those of each pair reach from 0 to free_until, the state at
 * hit_at is within the margin, and the bracket of the hit contains the distance there. The bracket of UNDECIDED is not
 * checked.
 * OVOID_OK; PROOF with a sentence (place: the step, or -1); ARGUMENT, MEMORY. The cell must be as it was in the query.
 */
OVOID_API ovoid_code ovoid_robot_path_verify(const ovoid_robot_cell *cell, const ovoid_robot_path_answer *answer,
                                             const ovoid_robot_path_basis *basis, ovoid_error *error);

/** The smallest clearance of a path: the least signed distance of any queried pair at any real s. */
typedef struct ovoid_robot_clearance {
    ovoid_robot_status status; /**< FREE: lower is above the margin; HIT: upper is not; UNDECIDED, with the code EMPTY
                                  if no pair is queried; REFUSED */
    double lower, upper;   /**< bracket of the least distance, padding included; both infinite if no pair is queried.
                              Wider than the tolerance if options.states were used up, or an allowance is wider */
    double at;             /**< s at which a pair is no farther apart than `upper` */
    ovoid_robot_side a, b; /**< that pair; valid for a finite upper */
    size_t
        refused; /**< REFUSED: the number of the refused state, or of the state at which the refused segment begins */
    ovoid_code code;   /**< REFUSED, and UNDECIDED without a queried pair: why */
    uint32_t variable; /**< REFUSED: which */
    uint32_t states;   /**< states checked */
} ovoid_robot_clearance;

/**
 * The smallest clearance of a path, by branch and bound with the bounds of ovoid_robot_path_find_hit: pairs and
 * intervals that are proven to be no nearer than the nearest found so far, less the tolerance, are not examined again.
 * Errors: ARGUMENT (options, no states, too many), MEMORY; then the bracket is all numbers. Cost: some tens of states a
 * segment; more for smaller tolerances, about as 1/sqrt(tolerance).
 */
OVOID_API ovoid_code ovoid_robot_path_compute_clearance(ovoid_robot_checker *checker,
                                                        const ovoid_robot_path_query *query,
                                                        ovoid_robot_clearance *clearance, ovoid_error *error);

/** The number of pairs of a cell, queried or excluded; their numbers begin at 0. */
OVOID_API size_t ovoid_robot_cell_get_pair_count(const ovoid_robot_cell *cell);
/** The two sides of a pair. */
typedef struct ovoid_robot_sides {
    ovoid_robot_side a, b;
} ovoid_robot_sides;

/** The two sides of a pair. Errors: INDEX. */
OVOID_API ovoid_code ovoid_robot_cell_get_pair(const ovoid_robot_cell *cell, size_t pair, ovoid_robot_sides *sides,
                                               ovoid_error *error);

#ifdef __cplusplus
}
#endif
#endif
