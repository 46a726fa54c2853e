// What ovoid robot path asks and tells of a path through states.
#ifndef OVOID_CLI_ROBOT_PATH_PATH_H
#define OVOID_CLI_ROBOT_PATH_PATH_H

#include "results.h"
#include "robot/states/states.h"

#include <ovoid/robot_path.h>

/// A path with its answer and, where they are wanted, the steps that prove it.
typedef struct path_report {
    const cli_cell *cell;
    const cli_states *states;
    ovoid_robot_path_answer answer;
    ovoid_robot_step *steps; ///< answer.step_count; NULL: not asked for
    int has_proofs;          ///< 1: they are written as lines
    double margin;
    size_t number;                          ///< of the path, from 0
    int is_edge;                            ///< 1: one of many
    const ovoid_robot_clearance *clearance; ///< NULL: not asked for
} path_report;

/// The time at s, linear between those of the states; NaN where they have none.
double path_compute_time(const cli_states *states, double s);

/// The segment in which the free part ends.
size_t path_get_segment(const ovoid_robot_path_answer *answer, size_t count);

/// The state at s, linear between its neighbours, for the answer's pictures and reports.
void path_compute_state(const cli_states *states, double s, double *q);

/// "outer", "middle", "ends", "solid".
const char *path_get_step_kind(uint16_t kind);
/// Writes the numbers of the pairs of a step, as the items of a list.
void path_write_step_pairs(FILE *file, const ovoid_robot_step *step);

void path_write_text(FILE *file, const path_report *report);
void path_write_csv_header(FILE *file);
void path_write_csv(FILE *file, const path_report *report);

/// The answer as a line, and each step as one.
void path_write_json(FILE *file, const path_report *report);

/// Draws the distance of the nearest pair over the path, at samples. 0, or an exit code after a message.
int path_plot(const char *path, const path_report *report, ovoid_robot_checker *checker,
              const ovoid_robot_query_options *options);

#endif
