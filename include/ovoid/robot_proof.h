/**
 * @file robot_proof.h
 * Files of path proofs, as `ovoid robot path --proofs` writes them: JSON Lines with the robot, the obstacles and the
 * options first, then for each path its states, its answer and its steps. docs/robot-path.md has the format. A file
 * only claims; ovoid_robot_path_verify says whether the claim holds.
 */
#ifndef OVOID_ROBOT_PROOF_H
#define OVOID_ROBOT_PROOF_H

#include "ovoid/robot_path.h"

#ifdef __cplusplus
extern "C" {
#endif

/** One side of a pair by its names: views. */
typedef struct ovoid_robot_proof_side {
    const char *link;     /**< NULL: an obstacle */
    const char *obstacle; /**< NULL: a link */
    const char *name;     /**< of the link's element; NULL: it has none */
    uint32_t number;      /**< of the element among those of its link, of the obstacle among those of the same name */
} ovoid_robot_proof_side;

/** The robot, the obstacles and the options of the paths of a file. Texts are views, NULL if the file has none. */
typedef struct ovoid_robot_proof_source {
    const char *robot, *srdf, *scene; /**< paths, as they were given */
    const char *const *packages;      /**< NAME=DIR */
    size_t package_count;
    const char *const *scales, *const *paddings; /**< LINK=X, or X: of all other links */
    size_t scale_count, padding_count;
    int parts, hull, visual, fixed_base; /**< as in ovoid_robot_read_options */
    double tolerance;                    /**< of cylinders, as in ovoid_robot_read_options */
    double margin, limit_slack;          /**< as in ovoid_robot_query_options */
    size_t path_count;                   /**< paths that follow */
    uint64_t digest;                     /**< of the robot and its obstacles */
    const char *const *variables;        /**< names */
    size_t variable_count;
    const ovoid_robot_proof_side *pairs; /**< the sides of pair i are 2 i and 2 i + 1 */
    size_t pair_count;
} ovoid_robot_proof_source;

/** A path, its answer, and the steps that prove it. Views, valid until the next call. */
typedef struct ovoid_robot_proof {
    size_t source;        /**< the number of sources in the file before the one of this path */
    size_t number;        /**< the number in the file: 0 for the first path of a source, and so on */
    int64_t line;         /**< of the answer; step i is on line + 1 + i */
    const double *states; /**< state i from i * variable_count on */
    size_t count;
    const double *times; /**< of each state, in seconds; NULL: none */
    double margin;
    ovoid_robot_path_answer answer;      /**< except the sides of `hit`, its code and `refused` */
    int has_pair;                        /**< HIT: 1; UNDECIDED: 0 if none was measured */
    size_t segment;                      /**< has_pair: the segment of free_until */
    uint32_t pair;                       /**< has_pair */
    ovoid_robot_proof_side a, b;         /**< its sides */
    double free_until_time, hit_at_time; /**< NaN if the file has none */
    const ovoid_robot_step *steps;       /**< answer.step_count */
} ovoid_robot_proof;

/** A file that is read path by path. */
typedef struct ovoid_robot_proofs_reader ovoid_robot_proofs_reader;

/** Opens a file, "-": standard input. NULL on failure: FILE, MEMORY. */
OVOID_API ovoid_robot_proofs_reader *ovoid_robot_proofs_reader_open(const char *path, ovoid_error *error);
/** Closes it; NULL is allowed. */
OVOID_API void ovoid_robot_proofs_reader_close(ovoid_robot_proofs_reader *proofs);

/**
 * Reads the next path, and the source before it if there is one. Strict: the keys of the format, in any order, each
 * once, no other; whole numbers for counts; as many steps as the answer says. 1; 0: the file ends; -1: *error is filled
 * (place: the line): FORMAT, FILE, MEMORY. NOT_FINITE if a number of a state is not finite. Cost: linear in the text.
 */
OVOID_API int ovoid_robot_proofs_reader_read(ovoid_robot_proofs_reader *proofs, ovoid_robot_proof *proof,
                                             ovoid_error *error);
/**
 * The source of the path that was read last: a view, valid until the next call of ovoid_robot_proofs_reader_read. NULL:
 * none was read.
 */
OVOID_API const ovoid_robot_proof_source *ovoid_robot_proofs_reader_get_source(const ovoid_robot_proofs_reader *proofs);
/**
 * What links of that source hold beside the scene's own: texts as "ovoid robot path --attach" takes them; *count of
 * them. Views, valid as the source is.
 */
OVOID_API const char *const *ovoid_robot_proofs_reader_get_attached(const ovoid_robot_proofs_reader *proofs,
                                                                    size_t *count);
/** The line that was read last. */
OVOID_API int64_t ovoid_robot_proofs_reader_get_line(const ovoid_robot_proofs_reader *proofs);

#ifdef __cplusplus
}
#endif
#endif
