// A robot among the obstacles of a scene, with the names of what can touch.
#ifndef OVOID_CLI_ROBOT_CELL_FILES_H
#define OVOID_CLI_ROBOT_CELL_FILES_H

#include "robot/inputs.h"

#include <ovoid/robot.h>

/// The default of --limit-slack, radians or metres: limits and states are often rounded to six digits.
#define CELL_SLACK 1e-6

/// Options of every command that asks about states.
typedef struct cell_settings {
    const robot_settings *robot; ///< set by the command
    const char *scene;           ///< NULL: no obstacles
    double margin, slack;        ///< slack: of the joints' limits
    args_list paddings;          ///< LINK=P or P
    args_list attached;          ///< LINK=OBJECT ..., of commands that have ATTACH_OPTION
    const char *attached_in;     ///< the file of proofs that these are of; NULL: the command line
} cell_settings;

/// The row of the option that attaches objects; `cell` is the member of the settings that holds it.
#define ATTACH_OPTION(settings)                                                                                        \
    {                                                                                                                  \
        "attach", 0, OPTION_LIST, offsetof(settings, cell.attached), "LINK=OBJECT", NULL,                              \
            "a link holds an object: \"box X Y Z\", \"sphere R\", \"cylinder R LENGTH\", \"capsule R LENGTH\", "       \
            "\"cone R LENGTH\", a mesh file, or an "                                                                   \
            "object of the scene, held where it stands in the first state; then perhaps \"at POSE\" in the link's "    \
            "frame, \"scale S\" of a mesh, "                                                                           \
            "\"touch NAME,...\", links or groups that it may touch (default: the links of the link's end effector); "  \
            "may be given several times"                                                                               \
    }

/// The rows of these options; `cell` is the member of the settings that holds them.
#define CELL_OPTIONS(settings)                                                                                         \
    {"scene",                                                                                                          \
     0,                                                                                                                \
     OPTION_FILE,                                                                                                      \
     offsetof(settings, cell.scene),                                                                                   \
     "FILE",                                                                                                           \
     NULL,                                                                                                             \
     "obstacles, in the root link's frame: MoveIt's planning scene (.yaml, .scene) or a scene of ovoid (.json)"},      \
        {"padding",                                                                                                    \
         0,                                                                                                            \
         OPTION_LIST,                                                                                                  \
         offsetof(settings, cell.paddings),                                                                            \
         "[LINK=]P",                                                                                                   \
         NULL,                                                                                                         \
         "enlarges a link, or all links that have no other padding, by P against obstacles; may be given several "     \
         "times"},                                                                                                     \
        {"margin",                                                                                                     \
         0,                                                                                                            \
         OPTION_LENGTH,                                                                                                \
         offsetof(settings, cell.margin),                                                                              \
         "M",                                                                                                          \
         NULL,                                                                                                         \
         "what is nearer than M counts as a hit (default: 0)"},                                                        \
    {                                                                                                                  \
        "limit-slack", 0, OPTION_LENGTH, offsetof(settings, cell.slack), "S", NULL,                                    \
            "variables may be outside their limits by S, the rounding of URDFs that were written with few digits; 0: " \
            "none, 1e50: limits do not count (default: 1e-6)"                                                          \
    }

/// What stands in the cell or is held by a link: an obstacle of the scene, or an object of --attach.
typedef struct cell_body {
    const char *name;
    const ovoid_shape *shape; ///< of a solid its hull
    const ovoid_solid *solid; ///< NULL: the shape counts
    ovoid_placed_obstacle at;
} cell_body;

/// A body by its id.
typedef struct cell_id {
    ovoid_id id;
    size_t body;
} cell_id;

/// A robot, its obstacles, and both as one cell.
typedef struct cli_cell {
    cli_robot robot;
    ovoid_robot_description description;
    ovoid_obstacles *obstacles; ///< NULL: none
    ovoid_robot_cell *cell;
    cell_body *bodies; ///< those of a name follow one another
    cell_id *ids;      ///< of the bodies, sorted by id
    size_t body_count;
    struct cell_held *held; ///< what --attach made: attach.c
} cli_cell;

/// Reads the files and makes the cell. 0, or an exit code after a message, with nothing left open.
int cell_open(const cli_command *command, const char *urdf, const cell_settings *settings, cli_cell *cell);
void cell_close(cli_cell *cell);

/// Attaches the objects of settings->attached; q: the first state. 0, or an exit code after a message; the cell stays
/// open.
int cell_attach(const cli_command *command, const cell_settings *settings, const double *q, cli_cell *cell);
/// Says what links hold and may touch, where --attach was given.
void cell_tell_held(const cli_cell *cell, const cell_settings *settings);
/// Frees what cell_attach made.
void cell_free_held(cli_cell *cell);
/// Makes room for that many more bodies. 0, or EXIT_INPUT after a message.
int cell_reserve_bodies(cli_cell *cell, size_t more);
/// Puts the ids of the bodies in order, once bodies were added or have another id.
void cell_sort_ids(cli_cell *cell);

/// Sets the paddings of the options in the cell of a robot that has the same links: those of all links first, then each
/// link's own. 0, or an exit code after a message.
int cell_set_paddings(const cli_command *command, const cli_cell *cell, ovoid_robot_cell *padded,
                      const args_list *given);

/// The options of a check by the settings.
ovoid_robot_query_options cell_make_options(const cell_settings *settings);

/// One side of a pair by its names.
typedef struct cell_side {
    const char *link;     ///< NULL: an obstacle
    const char *obstacle; ///< NULL: a link
    const char *element;  ///< the name of the link's element; NULL: it has none
    size_t number;        ///< of the element among those of the link, of the obstacle among those of its name
    int is_alone;         ///< 1: there is no other
} cell_side;

cell_side cell_get_side(const cli_cell *cell, const ovoid_robot_side *side);

/// Room for a side as a text.
enum { CELL_SIDE_ROOM = 160 };

/// "hand", "hand[palm]", "table[2]"; the length.
int cell_format_side(char text[CELL_SIDE_ROOM], const cli_cell *cell, const ovoid_robot_side *side);

/// Writes a side as an object of JSON.
void cell_write_side_json(FILE *file, const cli_cell *cell, const ovoid_robot_side *side);

/// The columns of a pair in CSV, of which the first side is always a link.
#define CELL_PAIR_COLUMNS "link_a,element_a,link_b,element_b,obstacle_b,part_b"

/// Writes these columns; a NULL: all are empty.
void cell_write_pair_csv(FILE *file, const cli_cell *cell, const ovoid_robot_side *a, const ovoid_robot_side *b);

/// Writes a text as a field of CSV; NULL: empty.
void cell_write_field(FILE *file, const char *text);

/// The name of a variable into a text.
void cell_format_variable(char text[CELL_SIDE_ROOM], const cli_cell *cell, size_t variable);

/// The name of a variable, "floor x", as it is, and as a string of JSON.
void cell_write_variable_name(FILE *file, const cli_cell *cell, size_t variable);
void cell_write_variable_json(FILE *file, const cli_cell *cell, size_t variable);

/// "free", "hit", "undecided", "refused".
const char *cell_get_status_name(ovoid_robot_status status);

/// The exit code of a state or a path: free 0, hit 1, undecided and refused 4.
int cell_get_exit(ovoid_robot_status status);

/// Writes a bracket for people into 64 characters: one number where it is narrow.
void cell_format_bracket(char text[64], double lower, double upper);

/// The sentence of an answer with the code EMPTY.
const char *cell_get_empty(void);
/// 1: an answer names a pair.
static inline int cell_has_pair(const ovoid_robot_answer *answer) {
    return answer->status == OVOID_ROBOT_HIT ||
           (answer->status == OVOID_ROBOT_UNDECIDED && answer->code != OVOID_ERROR_EMPTY);
}

/// 1: a variable of the state is outside its limits.
static inline int cell_is_outside(const ovoid_robot_answer *answer) {
    return answer->status == OVOID_ROBOT_REFUSED && answer->code == OVOID_ERROR_RANGE;
}

/// Says what to do where the limits of the URDF are narrower than those that the states were made for.
void cell_tell_outside(void);

/// Says of two links that touch what an SRDF is for, where the robot has none that disables a pair.
void cell_tell_links(const cli_cell *cell, const ovoid_robot_side *a, const ovoid_robot_side *b);

/// Writes why a state is refused: "shoulder: 3 is not within -1.5 .. 2.5".
void cell_write_refusal(FILE *file, const cli_cell *cell, const ovoid_robot_answer *answer, const double *q);

#endif
