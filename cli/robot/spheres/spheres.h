// What ovoid robot spheres works on: lists of spheres for a robot's links, what is proven of them, and their files.
#ifndef OVOID_CLI_ROBOT_SPHERES_SPHERES_H
#define OVOID_CLI_ROBOT_SPHERES_SPHERES_H

#include "robot/states/states.h"

#include <ovoid/robot_compare.h>

/// Spheres of a robot's links, those of a link one after another, in the order of the links.
typedef struct sphere_list {
    ovoid_robot_link_sphere *items;
    size_t count, capacity;
} sphere_list;

/// Adds one; 0 after a message where memory is out.
int sphere_list_add(sphere_list *list, uint32_t link, ovoid_robot_sphere ball);
/// The first sphere of a link, and how many it has.
size_t sphere_list_find(const sphere_list *list, uint32_t link, size_t *count);
void sphere_list_clear(sphere_list *list);

/// Reads spheres for the robot of the cell: those of the file `given`, a URDF or an SRDF, or of the robot's own SRDF
/// where it is NULL. Links go by their names. 0, or an exit code after a message, with nothing kept.
int spheres_read(const cli_command *command, const cli_cell *cell, const robot_settings *settings, const char *urdf,
                 const char *given, sphere_list *list);

/// What is proven of one link's spheres.
typedef struct sphere_row {
    uint32_t link;
    size_t count; ///< 0: there are none, and the audit has nothing
    ovoid_robot_sphere_audit audit;
} sphere_row;

/// A comparison of states: which pairs were looked at, and how they agree.
typedef struct sphere_states {
    const char *pairs; ///< "links" or "obstacles"
    ovoid_robot_comparison found;
} sphere_states;

/// One list of spheres and all that is proven of it.
typedef struct sphere_set {
    const char *name; ///< "given" or "found"
    sphere_list list;
    sphere_row *rows;
    size_t row_count;
    sphere_states states[2];
    int states_count;
} sphere_set;

/// The states of a comparison: read, or random ones within the limits.
typedef struct sphere_samples {
    cli_states states;
    int is_random;
    unsigned seed;
    size_t fixed_count; ///< variables without limits, which stay at their default in random states
} sphere_samples;

/// Random states: joints within their limits, continuous ones within a turn, all else at its default. 0, or an exit
/// code.
int sphere_samples_draw(sphere_samples *samples, const cli_cell *cell, unsigned count, unsigned seed);

/// Compares the robot with its model of spheres over all states. 0, or an exit code after a message.
int spheres_compare(const cli_cell *cell, const cell_settings *settings, const sphere_samples *samples,
                    sphere_set *set);

/// What a report tells.
typedef struct sphere_report {
    const cli_cell *cell;
    const sphere_set *sets;
    int set_count;
    const sphere_samples *samples; ///< NULL: no states were compared
    int has_parts;                 ///< 1: meshes count as their parts, not as their hulls
} sphere_report;

void spheres_write_text(FILE *file, const sphere_report *report);
void spheres_write_json(FILE *file, const sphere_report *report);

/// Writes spheres to a file that appears whole or not at all: a URDF (the robot's own text with spheres in the place of
/// the links' collision elements), an SRDF (the robot's own, or a new one), CSV or JSON, by the extension. 0, or an
/// exit code after a message.
int spheres_write(const char *path, const cli_cell *cell, const sphere_list *list, const char *urdf, const char *srdf);

#endif
