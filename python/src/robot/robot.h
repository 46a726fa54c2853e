// Robots and their cells, and what the files about them share. Compiled where there is libovoid_robot.
#ifndef OVOID_PYTHON_ROBOT_ROBOT_H
#define OVOID_PYTHON_ROBOT_ROBOT_H

#include "src/module.h"

#include <ovoid/robot.h>
#include <ovoid/robot_path.h>

/// A robot. Immutable, so that any number of threads and cells share it.
typedef struct robot_object {
    PyObject_HEAD ovoid_robot *robot;
    PyObject *shapes; ///< a tuple: keeps those of the elements
    PyObject *facts;  ///< a dict: what its files say beside the description; empty where there is no file
} robot_object;

/// What is kept of an obstacle or of a body that a link holds: the body, its name, the index of the link or None, its
/// Pose in the frame of that link or the root link.
typedef enum kept_place { KEPT_BODY, KEPT_NAME, KEPT_LINK, KEPT_POSE } kept_place;

/// A body that the library took.
typedef struct placed_body {
    ovoid_id id;
    uint32_t link; ///< OVOID_ROBOT_NONE: an obstacle
    ovoid_pose pose;
} placed_body;

/// A robot among obstacles, with the checkers that no call is using.
typedef struct cell_object {
    PyObject_HEAD ovoid_robot_cell *cell;
    robot_object *robot;
    PyObject *kept; ///< a dict: of each id a tuple, by the kept_place
    ovoid_robot_checker **idle;
    size_t idle_count, idle_capacity;
    size_t version; ///< grows with every change
    int readers;    ///< calls that run without the interpreter's lock
} cell_object;

// ---- robot.c

/// A new Robot around a C robot, which it takes over, as it does the two references. NULL robot: raises the error.
PyObject *robot_wrap(PyTypeObject *type, ovoid_robot *robot, PyObject *shapes, PyObject *facts,
                     const ovoid_error *error);
/// A Robot by a named argument.
int robot_read(module_state *state, PyObject *from, const char *what, robot_object **to);
/// A link by its name or index.
int link_read(const robot_object *self, PyObject *from, uint32_t *to);
/// States (n, variables), or one (variables,): then axes is 1. The caller frees states->data. A state is numbers, its
/// name in the SRDF, or a dict by the variables' names.
int states_read(const robot_object *self, PyObject *from, const char *what, int *axes, items *states);
/// States (n, variables) alone.
int state_rows_read(const robot_object *self, PyObject *from, const char *what, items *states);
/// One state into memory of its own, which the caller frees; NULL: an exception.
double *state_read(const robot_object *self, PyObject *from);
size_t robot_variable_count(const robot_object *self);

// ---- robot_create.c, robot_facts.c

PyObject *robot_new(PyTypeObject *type, PyObject *arguments, PyObject *keywords);
/// A name as a string, which need not be UTF-8; NULL: None.
PyObject *robot_name_make(const char *name);
/// "shoulder", or of a joint of several variables "floor/x".
PyObject *robot_variable_name_make(const robot_object *self, size_t i);
/// A Shape for each element of a robot whose shapes `owner` keeps; equal ones are one object.
PyObject *robot_shapes_make(module_state *state, const ovoid_robot_description *d, PyObject *owner);

// ---- robot_cell.c

/// Every query of a cell is between these: count checkers, from the idle ones or new.
int checkers_borrow(cell_object *self, ovoid_robot_checker **checkers, size_t count);
void checkers_return(cell_object *self, ovoid_robot_checker *const *checkers, size_t count);
/// Keeps an obstacle or attached body that the library took alive, with its name (NULL: "body ID") and its place.
int cell_keep(cell_object *self, const placed_body *placed, PyObject *body, PyObject *name);

// ---- side.c

/// The Side of Python.
PyObject *side_make(const cell_object *cell, const ovoid_robot_side *side);

// ---- collide.c

/// The options that every query of a cell takes, as arguments of arguments_read.
#define ROBOT_QUERY_FORMAT "ddpp"
#define ROBOT_QUERY_SIGNATURE                                                                                          \
    "margin: float = 0, limit_slack: float = 0, without_self: bool = False, without_obstacles: bool = False"
#define ROBOT_QUERY_NAMES "margin", "limit_slack", "without_self", "without_obstacles"
#define ROBOT_QUERY_TARGETS(o) &(o).margin, &(o).limit_slack, &(o).without_self, &(o).without_obstacles

/// What a question about a path is given.
typedef struct path_arguments {
    items states; ///< (n, variables); the caller frees states.data
    ovoid_robot_query_options query;
    double tolerance;
    uint32_t most_states;
    int any_hit; ///< of find_hit
} path_arguments;
#define PATH_NAMES "states", ROBOT_QUERY_NAMES, "tolerance", "most_states"
/// Reads them; format, names: as arguments_read has them, with the question's name and PATH_NAMES. -1:
/// raised, nothing to free.
int path_arguments_read(cell_object *cell, PyObject *arguments, PyObject *keywords, const char *format, char **names,
                        path_arguments *in);
/// 1: an answer names a pair.
int state_has_pair(const ovoid_robot_answer *answer);
/// The StateAnswer of Python.
PyObject *state_answer_make(const cell_object *cell, const ovoid_robot_answer *answer);
/// Refuses options that C would read in another order, or not at all.
int query_options_validate(module_state *state, const ovoid_robot_query_options *o);

// ---- tables of methods, and what each file adds

extern PyMethodDef robot_constructors[], robot_spheres_methods[], robot_matrix_methods[], robot_file_functions[],
    robot_message_functions[];
extern PyMethodDef cell_queries[], cell_clearances[], cell_sides[], cell_plans[], cell_scenes[], cell_proofs[],
    robot_functions[];
extern PyMethodDef robot_facts_methods[];
extern PyGetSetDef robot_fields[];
extern PyMethodDef robot_proof_functions[];

// ---- robot_path.c

/// Checks a proven path by its steps.
ovoid_code path_verify(PyObject *object, ovoid_error *error);
/// A RobotPath of what a file claims of a path of this cell.
struct ovoid_robot_proof;
PyObject *path_claim(cell_object *cell, const struct ovoid_robot_proof *proof, double limit_slack);

#endif
