// The search for a path with a planner of OMPL; the only room of the tool in C++. The Python package has it too, in an
// extension of its own.
#ifndef OVOID_CLI_PLAN_SEARCH_H
#define OVOID_CLI_PLAN_SEARCH_H

#include <ovoid/robot_path.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The planners, in the order of the command line's choices.
typedef enum search_planner { SEARCH_RRT_CONNECT, SEARCH_BI_EST } search_planner;

/// What is searched. States are whole states of the robot; borrowed.
typedef struct search_problem {
    ovoid_robot *robot;
    ovoid_robot_cell *cell;
    const double *start, *goals; ///< goal i from i * variable count on
    size_t goal_count;
    const uint32_t *moving; ///< variables
    size_t moving_count;
    ovoid_robot_query_options query;
    search_planner planner;
    unsigned seed; ///< not 0
    double seconds;
    int is_raw;        ///< 1: not shortened
    ovoid_watch watch; ///< ends the search: then there is no path
} search_problem;

/// Room for a sentence about what is wrong.
enum { SEARCH_WHY_ROOM = 400 };

/// What was found.
typedef struct search_result {
    double *q; ///< whole states, to be freed; NULL: no path
    size_t count;
    double length, raw_length; ///< in the planner's space, of what was found and before it was shortened
    double planned, shortened; ///< seconds
    unsigned motions;          ///< that were asked about
    char why[SEARCH_WHY_ROOM]; ///< not "": the planner or the space refused
} search_result;

/// Searches on one thread: the same problem gives the same path. One search at a time in a process, which has one seed.
search_result search_path(const search_problem *problem);

/// Where another library finds the search, of the same version alone.
typedef struct search_entry {
    const char *version; ///< ovoid_get_version()
    search_result (*search)(const search_problem *problem);
} search_entry;

#ifdef __cplusplus
}
#endif
#endif
