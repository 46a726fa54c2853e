// What ovoid robot check tells of its states: as a table, as JSON Lines or as CSV.
#ifndef OVOID_CLI_ROBOT_REPORT_H
#define OVOID_CLI_ROBOT_REPORT_H

#include "results.h"
#include "robot/states/states.h"

/// Options of the robot commands that write results; `out` is an output_settings.
#define REPORT_OPTIONS(settings)                                                                                       \
    {"json", 0, OPTION_FLAG, offsetof(settings, out.json), NULL, NULL, "write JSON Lines, one object a line"},         \
        {"csv", 0, OPTION_FLAG, offsetof(settings, out.csv), NULL, NULL, "write CSV with a header line"}, {            \
        "output", 'o', OPTION_OUTPUT, offsetof(settings, out.path), "FILE", "jsonl|json|csv|txt",                      \
            "write to FILE, which appears whole or not at all; .jsonl and .csv choose the format (default: standard "  \
            "output)"                                                                                                  \
    }

/// What is told of each state.
typedef struct report_form {
    const cli_cell *cell;
    const cli_states *states;
    int has_near, has_gradient;
} report_form;

/// What was found of one state.
typedef struct report_state {
    size_t index;
    ovoid_robot_answer answer;
    const ovoid_robot_near *near; ///< count
    const double *gradients;      ///< count times the variables; NULL: not asked for
    size_t count;
} report_state;

void report_write_json(FILE *file, const report_form *form, const report_state *state);

/// A line a state, or where near pairs are asked for a line for each of them, and for a state that has none.
void report_write_csv_header(FILE *file, const report_form *form);
void report_write_csv(FILE *file, const report_form *form, const report_state *state);

/// The rows of a table, with the same lines; columns are as wide as these states need.
void report_write_table(FILE *file, const report_form *form, const report_state *states, size_t count);

#endif
