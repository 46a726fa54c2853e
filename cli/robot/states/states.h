// States of a robot: from a CSV file with a header, a trajectory or a request of MoveIt, by the SRDF's names, or
// written on the command line.
#ifndef OVOID_CLI_ROBOT_STATES_H
#define OVOID_CLI_ROBOT_STATES_H

#include "robot/cell_files.h"

/// Options of every command that takes states.
typedef struct states_settings {
    const char *path;    ///< NULL: not given
    const char *request; ///< NULL: not given
    const char *group;   ///< NULL: named states of all groups
    const char *others;  ///< of what a state does not give; NULL: MoveIt's default
    char scene[4096];    ///< the scene beside the request
    args_list texts;     ///< names and assignments
} states_settings;

/// The rows of these options; `states` is the member of the settings that holds them.
#define STATES_OPTIONS(settings)                                                                                       \
    {"states",                                                                                                         \
     0,                                                                                                                \
     OPTION_FILE,                                                                                                      \
     offsetof(settings, states.path),                                                                                  \
     "FILE",                                                                                                           \
     NULL,                                                                                                             \
     "states: CSV, one a line below a header of joints' or variables' names in any order (\"-\": standard input), "    \
     "also "                                                                                                           \
     "the joint states of a bag by rostopic echo -p or PlotJuggler; or a trajectory of MoveIt (.json, .yaml)"},        \
        {"request",                                                                                                    \
         0,                                                                                                            \
         OPTION_FILE,                                                                                                  \
         offsetof(settings, states.request),                                                                           \
         "FILE",                                                                                                       \
         NULL,                                                                                                         \
         "the start and the goals of a motion planning request of MoveIt (.yaml); requestX.yaml takes the obstacles "  \
         "of sceneX.yaml beside it, unless --scene is given"},                                                         \
        {"group",                                                                                                      \
         0,                                                                                                            \
         OPTION_TEXT,                                                                                                  \
         offsetof(settings, states.group),                                                                             \
         "NAME",                                                                                                       \
         NULL,                                                                                                         \
         "named states are those of this group of the SRDF (default: of all groups)"},                                 \
        {"others",                                                                                                     \
         0,                                                                                                            \
         OPTION_TEXT,                                                                                                  \
         offsetof(settings, states.others),                                                                            \
         "STATE",                                                                                                      \
         NULL,                                                                                                         \
         "variables that a state does not give are as in STATE, a name of the SRDF's or \"joint=number,...\" "         \
         "(default: 0, or the middle of the limits where 0 is outside)"},                                              \
    {                                                                                                                  \
        "state", 0, OPTION_LIST, offsetof(settings, states.texts), "STATE", NULL,                                      \
            "a state: a name of the SRDF's, \"joint=number,...\", or \"\", all at their default; may be given "        \
            "several times"                                                                                            \
    }

/// The states. Variables that are not given have MoveIt's default: 0, or the middle of the limits where 0 is outside.
typedef struct cli_states {
    double *q; ///< one state after another; of a part only its own
    size_t count, variable_count;
    size_t stored, capacity;
    double *times;   ///< of each state that is stored, in seconds: the column "time" of a file; NULL: there is none
    shard_part part; ///< of the blocks of OVOID_ROBOT_BLOCK states, dealt out in turn
    const args_list *texts; ///< of the states, NULL where they come from a file
    const char *group;      ///< whose named states are meant; NULL: all groups
} cli_states;

/// Refuses a command line without states, or with two kinds of them. With a request that has a scene beside it, that is
/// the cell's, unless there is one. -1 to go on, or EXIT_USAGE.
int states_settle(const cli_command *command, states_settings *settings, cell_settings *cell);

/// A path leads from a request's start to one goal. 0, or EXIT_INPUT after a message.
int states_check_goal(const states_settings *settings, const cli_states *states);

/// Reads the states; of a file those of states->part alone are looked at, all others are only counted. 0, or an exit
/// code after a message, with nothing left open.
int states_open(const cli_command *command, const states_settings *settings, const cli_cell *cell, cli_states *states);

/// The variables of state i, which is one of the part; those of the states behind it in its block follow.
const double *states_get(const cli_states *states, size_t i);
void states_close(cli_states *states);
/// Writes the first `count` states as a member of an object, and their times where they have some.
void states_write_json(FILE *file, const cli_states *states, const char *key, size_t count);

/// Writes all states as a file that states_open reads.
void states_write_csv(FILE *file, const cli_cell *cell, const cli_states *states);
/// Refuses states that states_write_trajectory cannot write: a joint of several variables moves. 0, or EXIT_INPUT after
/// a message.
int states_check_trajectory(const cli_cell *cell, const cli_states *states);
/// Writes all states as moveit_msgs/RobotTrajectory, without joints of several variables, which stand still.
void states_write_trajectory(FILE *file, const cli_cell *cell, const cli_states *states);

/// The number of a variable that is not given.
double states_get_default(const cli_cell *cell, size_t variable);

/// What the command line calls state i; NULL for those of a file.
const char *states_get_name(const cli_states *states, size_t i);

#endif
