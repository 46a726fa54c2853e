// What ovoid robot matrix writes.
#ifndef OVOID_CLI_ROBOT_MATRIX_MATRIX_H
#define OVOID_CLI_ROBOT_MATRIX_MATRIX_H

#include "robot/inputs.h"

#include <ovoid/robot_matrix.h>

/// A matrix, and the robot that it is of.
typedef struct matrix_view {
    const ovoid_robot *robot;
    ovoid_robot_description description;
    const ovoid_robot_matrix *matrix;
    int has_srdf; ///< 1: the description's disabled pairs are those of a file
} matrix_view;

/// What is said of a pair that the file disables or does not.
typedef enum matrix_finding {
    FINDING_NONE,
    FINDING_WRONG,      ///< disabled, not as neighbours, and a state is known in which they touch and another one
    FINDING_NEIGHBOURS, ///< disabled neighbours that sometimes touch
    FINDING_UNPROVEN,   ///< disabled, and no hit is known, but no proof either
    FINDING_MISSING     ///< not disabled, and proven never or always to touch
} matrix_finding;

matrix_finding matrix_find(const matrix_view *v, const ovoid_robot_matrix_pair *pair);

/// The reason that the file gives; NULL: it does not disable the pair.
const char *matrix_get_given_reason(const matrix_view *v, const ovoid_robot_matrix_pair *pair);

void matrix_write_text(FILE *file, const matrix_view *v);
void matrix_write_json(FILE *file, const matrix_view *v);
void matrix_write_srdf(FILE *file, const matrix_view *v, int with_sampled);

/// Writes an SVG of each pair that the file disables wrongly into a folder, which is made where it is not there. 0, or
/// an exit code after a message.
int matrix_write_pictures(const char *folder, const matrix_view *v);

#endif
