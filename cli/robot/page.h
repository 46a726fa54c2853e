// The pages of ovoid robot check and path: the robot, its obstacles, the states and what was found of them.
#ifndef OVOID_CLI_ROBOT_PAGE_H
#define OVOID_CLI_ROBOT_PAGE_H

#include "page/page.h"
#include "robot/path/path.h"
#include "robot/report.h"

/// A page, with the answers as they come. It stays where it was opened: the stream knows its members.
typedef struct robot_page {
    cli_page page;
    FILE *answers; ///< into `text`: of states or of paths, between commas
    char *text;
    size_t size, count;
} robot_page;

/// Opens a page; path NULL: none is wanted, and nothing is done below. 0, or EXIT_INPUT after a message.
int robot_page_open(robot_page *page, const char *path);

/// Adds the answer to a state, or to a path; in their order.
void robot_page_add_state(robot_page *page, const report_form *form, const report_state *state);
void robot_page_add_path(robot_page *page, const path_report *report);

/// What a page shows.
typedef struct robot_page_source {
    const char *urdf;
    const cell_settings *settings;
    const cli_cell *cell;
    const cli_states *states;
    ovoid_robot_checker *checker; ///< of a path, NULL: the answers are those of states
    const path_report *path;      ///< one path, with its steps; NULL: several, or states
} robot_page_source;

/// Writes the page. 0, or EXIT_INPUT after a message.
int robot_page_write(robot_page *page, const robot_page_source *source);

void robot_page_close(robot_page *page);

#endif
