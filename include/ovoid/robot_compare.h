/**
 * @file robot_compare.h
 * Comparison of a robot with a model of it, for example of spheres: in which states do the two disagree? A planner that
 * uses only the model passes through collisions that the model misses, and goes around collisions that it invents.
 * docs/robot-spheres.md shows how far real models are from their robots.
 */
#ifndef OVOID_ROBOT_COMPARE_H
#define OVOID_ROBOT_COMPARE_H

#include "ovoid/robot.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The statuses of a robot and its model in a state. */
typedef enum ovoid_robot_agreement {
    OVOID_ROBOT_COMPARED_OPEN = 0,  /**< one of the two is undecided, or refuses the state */
    OVOID_ROBOT_COMPARED_BOTH_FREE, /**< both are free, proven */
    OVOID_ROBOT_COMPARED_BOTH_HIT,  /**< both are hits, proven */
    OVOID_ROBOT_COMPARED_MISSED,    /**< proven: the robot hits, and its model is free */
    OVOID_ROBOT_COMPARED_INVENTED   /**< proven: the robot is free, and its model hits */
} ovoid_robot_agreement;

/** How many agreements there are. */
#define OVOID_ROBOT_AGREEMENTS 5

/** "open", "both free", "both hit", "missed", "invented"; never NULL. */
OVOID_API const char *ovoid_robot_agreement_get_name(ovoid_robot_agreement agreement);

/** States to compare. */
typedef struct ovoid_robot_comparison_batch {
    ovoid_robot_checker *robot, *model; /**< of cells that have the same variables; both are reset */
    const double *q;                    /**< state i from i * variable count on */
    size_t count;
    const ovoid_robot_query_options *options; /**< of both; NULL: the default. Pairs of links or obstacles may be left
                                                 out, so two calls can tell them apart */
    ovoid_robot_agreement *agreements;        /**< count, or NULL: only counts are written */
} ovoid_robot_comparison_batch;

/** Counts of the agreements of two robots over states. Set it to zero before the first batch. */
typedef struct ovoid_robot_comparison {
    size_t states;                         /**< how many were compared */
    size_t counts[OVOID_ROBOT_AGREEMENTS]; /**< of these, by agreement */
    size_t deepest_state; /**< of the missed states the one with the deepest overlap, counted from the first state of
                             the first batch. 0 if none was missed */
    ovoid_robot_near deepest; /**< its pair, which is of the robot; the model misses at least -upper, proven */
} ovoid_robot_comparison;

/**
 * Compares states and adds them to *comparison: checks each with the robot and with the model, and finds the deepest
 * pair of each missed state. The same states in the same batches give the same bits. Errors: ARGUMENT (NULL, options,
 * numbers of variables that differ), MEMORY; then *comparison is unchanged. Cost: two checks a state, and a search of
 * the nearest pair for each missed state.
 */
OVOID_API ovoid_code ovoid_robot_compare_states(const ovoid_robot_comparison_batch *batch,
                                                ovoid_robot_comparison *comparison, ovoid_error *error);

#ifdef __cplusplus
}
#endif
#endif
