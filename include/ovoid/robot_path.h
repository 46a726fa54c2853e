/**
 * @file robot_path.h
 * Proven motions of a robot: is a path free for all times in between, and if not, when does it first touch what?
 *
 * A path goes through states; between two neighbours every variable is linear in the path's parameter s, which is i at
 * state i. Free means: at every real s, every queried pair of the cell is farther apart than the margin, in the exact
 * kinematics. It is proven by steps, each of a pair and an interval, which ovoid_robot_path_verify measures again
 * without a search. docs/robot-path.md has the mathematics.
 */
#ifndef OVOID_ROBOT_PATH_H
#define OVOID_ROBOT_PATH_H

#include "ovoid/robot.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Most states of a path. */
#define OVOID_ROBOT_PATH_STATES_MAX ((size_t)1 << 20)

/** The states that a path goes through. */
typedef struct ovoid_robot_path {
    const double *states; /**< state i from i * variable count on; borrowed */
    size_t count;         /**< >= 1 */
} ovoid_robot_path;

/** What a step measures. Motion: how far a point of one body may come in the frame of the other one. */
typedef enum ovoid_robot_step_kind {
    OVOID_ROBOT_STEP_OUTER = 1, /**< in the middle of the interval, spheres or boxes around the bodies are farther apart
                                    than margin and motion */
    OVOID_ROBOT_STEP_MIDDLE,    /**< in the middle, the gap along `normal`: above margin and motion */
    OVOID_ROBOT_STEP_ENDS, /**< at both ends, the gap along `normal`: above the margin by what it may fall below its
                              chord in between */
    OVOID_ROBOT_STEP_SOLID /**< of a pair with a solid: in the middle, the distance of the bodies: above margin and
                              motion. Its check asks for the distance again */
} ovoid_robot_step_kind;

/**
 * A pair, or with OUTER up to eight, stay apart over an interval of s that lies between two neighbouring states. Pairs
 * are numbers of the cell (ovoid_robot_cell_get_pair), valid until the cell changes.
 */
typedef struct ovoid_robot_step {
    double begin, end;
    uint32_t pair;     /**< the pair; of OUTER the first of eight */
    uint16_t kind;     /**< ovoid_robot_step_kind */
    uint16_t mask;     /**< bit i: the step is of pair + i */
    ovoid_vec3 normal; /**< unit, in the frame of the link that is the lowest above both bodies; of an obstacle the
                          root's. Not of OUTER and SOLID: zero */
} ovoid_robot_step;

/** How a path is checked; all zero, or NULL, is the default. */
typedef struct ovoid_robot_path_options {
    ovoid_robot_query_options query; /**< margin, limits, which pairs */
    double tolerance; /**< of hit_at - free_until, in s; 0 means 2^-20. Where a body's allowance hides when it is met,
                         up to 1/32. Of a clearance: of its bracket, a length; 0 means 1/1024 of the radius of the
                         robot's largest element */
    uint32_t states;  /**< most states that are looked at; 0 means 100 000, of a clearance 100 more for each segment */
    ovoid_robot_step *steps; /**< receives the proof's steps, up to capacity; NULL: none are wanted. Of
                                ovoid_robot_path_find_hit, as what follows */
    size_t capacity;
    ovoid_watch watch; /**< asked before each state; stopped: as though `states` were used up */
    int any_hit; /**< 1: any hit ends the search, the first one that is found: some states are looked at before anything
                      is proven. hit_at need not be the first hit then, and free_until is what was proven by then, often
                      0. Whether the path is free is answered as without it, and sooner where it is not */
} ovoid_robot_path_options;

/** What is asked of a path. */
typedef struct ovoid_robot_path_query {
    const ovoid_robot_path *path;
    const ovoid_robot_path_options *options; /**< NULL: the default */
} ovoid_robot_path_query;

/** The answer to a path. */
typedef struct ovoid_robot_path_answer {
    ovoid_robot_status status; /**< UNDECIDED: the pair of `hit` stays so near the margin that doubles cannot tell, or
                                    options.states are used up, or (hit.code EMPTY) no pair is queried; REFUSED: see
                                  hit.code, hit.variable and `refused` */
    double free_until;         /**< proven: free at all s before it */
    double hit_at;             /**< HIT: the state there is within the margin, proven; else infinity */
    size_t refused;            /**< REFUSED: the state that is refused, or at whose beginning a segment is */
    ovoid_robot_answer
        hit; /**< HIT: of the state at hit_at; UNDECIDED: the pair, and its bracket where it was last measured */
    uint32_t states;   /**< looked at */
    size_t step_count; /**< that prove free_until; more than the capacity: those beyond it were not written */
} ovoid_robot_path_answer;

/**
 * Is the path free, and if not, when is the first hit? F. Schwarzer, M. Saha, J.-C. Latombe, Exact collision checking
 * of robot paths, 2002, bound how far bodies move; here each bound counts the joints between the two bodies alone,
 * holds with rounding, and has a second order along one normal. A segment along which a floating joint turns is refused
 * (ARGUMENT), as a quaternion's numbers are no motion. Errors: ARGUMENT (options, no states, too many), MEMORY; then
 * *answer is UNDECIDED. The checker keeps the search's memory: only the first path after a change of the
 * cell allocates. Cost: some tens of states a segment.
 */
OVOID_API ovoid_code ovoid_robot_path_find_hit(ovoid_robot_checker *checker, const ovoid_robot_path_query *query,
                                               ovoid_robot_path_answer *answer, ovoid_error *error);

/** What an answer to a path is verified with. */
typedef struct ovoid_robot_path_basis {
    ovoid_robot_path_query query;  /**< margin, limits and pairs of its options count */
    const ovoid_robot_step *steps; /**< all step_count of them */
} ovoid_robot_path_basis;

/**
 * Verifies an answer without any search: that the steps hold, that those of each pair reach from
 * 0 to free_until, that the state at hit_at is within the margin, and that the bracket of the hit holds what is found
 * there. Of UNDECIDED the bracket is not looked at.
 * OVOID_OK; PROOF with a sentence (place: the step, or -1); ARGUMENT, MEMORY. Takes the cell as it was.
 */
OVOID_API ovoid_code ovoid_robot_path_verify(const ovoid_robot_cell *cell, const ovoid_robot_path_answer *answer,
                                             const ovoid_robot_path_basis *basis, ovoid_error *error);

/** The smallest clearance of a path: the least signed distance of any queried pair at any real s. */
typedef struct ovoid_robot_clearance {
    ovoid_robot_status status; /**< FREE: lower is above the margin; HIT: upper is not; UNDECIDED, with the code EMPTY
                                    where no pair is queried; REFUSED */
    double lower, upper;       /**< the least distance is proven to be in here, padding counted; both infinite where no
                                    pair is queried. Wider than the tolerance where options.states were used up, or an
                                    allowance is wider */
    double at;                 /**< s where a pair is no farther apart than `upper` */
    ovoid_robot_side a, b;     /**< that pair; of a finite upper */
    size_t refused;            /**< REFUSED: the state, or that at whose beginning a segment is */
    ovoid_code code;           /**< REFUSED, and UNDECIDED of no pair: why */
    uint32_t variable;         /**< REFUSED: which */
    uint32_t states;           /**< looked at */
} ovoid_robot_clearance;

/**
 * The smallest clearance of a path, by branch and bound with the bounds of ovoid_robot_path_find_hit: what is proven to
 * be no nearer than the nearest that was found, less the tolerance, is not looked at again. Errors: ARGUMENT (options,
 * no states, too many), MEMORY; then the bracket is all numbers. Cost: some tens of states a segment; more the smaller
 * the tolerance, about as 1/sqrt(tolerance).
 */
OVOID_API ovoid_code ovoid_robot_path_compute_clearance(ovoid_robot_checker *checker,
                                                        const ovoid_robot_path_query *query,
                                                        ovoid_robot_clearance *clearance, ovoid_error *error);

/** How many pairs a cell has, queried or left out; their numbers begin at 0. */
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
