// The answer to a path with the steps that prove it, and their check.
#ifndef OVOID_CLI_ROBOT_PATH_ANSWER_H
#define OVOID_CLI_ROBOT_PATH_ANSWER_H

#include "robot/path/path.h"

/// Room for the steps of a proof at first; NULL: out of memory.
ovoid_robot_step *path_create_steps(void);

/// Checks the path; where report->steps is not NULL, it is made as large as the proof needs. 0, or EXIT_INPUT after a
/// message.
int path_find_answer(path_report *report, ovoid_robot_checker *checker, const ovoid_robot_path *path,
                     ovoid_robot_path_options *options);

/// Measures all steps again. 0, or EXIT_NOT_PROVEN after a message.
int path_check_proofs(const path_report *report, const ovoid_robot_path *path, const ovoid_robot_path_options *options);

#endif
