/**
 * @file robot_io.h
 * Robots from files: URDF and SRDF, scenes of obstacles (MoveIt's YAML, ovoid's JSON), planning problems and
 * trajectories. A part of libovoid_robot, which needs libovoid_io, expat and libyaml. docs/robot.md describes the
 * formats.
 *
 * Every function returns a code or NULL and fills *error (which may be NULL); message is "path:line: what is wrong,
 * what to do", place the line. Facts that are no errors but should be known are reported as notes: see
 * ovoid_robot_note. Nothing prints, exits or leaks; memory and time are bounded by a small multiple of the sizes of the
 * files. Memory comes from malloc, except that of shapes. One object must not be used by several threads while it is
 * read; afterwards it is immutable.
 */
#ifndef OVOID_ROBOT_IO_H
#define OVOID_ROBOT_IO_H

#include "ovoid/io.h"
#include "ovoid/robot_spheres.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The folder of a package, for addresses of the form package://NAME/PATH. */
typedef struct ovoid_robot_package {
    const char *name; /**< the name behind package://; may hold more than one folder: "robots/panda_description" */
    const char *folder;
} ovoid_robot_package;

/** Enlarges or shrinks a link's geometry. */
typedef struct ovoid_robot_link_scale {
    const char *link; /**< NULL: every link that no other item names */
    double factor;    /**< > 0: of each shape's size, about the origin of its element; multiplies the scale of meshes */
} ovoid_robot_link_scale;

/**
 * A fact that is no error by itself, in the order of the files: an unknown name in an SRDF, an element without effect,
 * each of several absent meshes. Valid only during the call.
 */
typedef struct ovoid_robot_note {
    const char *path; /**< of the file */
    int64_t line;     /**< 0: none */
    const char *text; /**< a sentence of any length */
} ovoid_robot_note;

/** How to read a robot; all zero, or NULL, is the default. */
typedef struct ovoid_robot_read_options {
    const ovoid_robot_package *packages; /**< searched before all other places; the longest name that fits is taken */
    size_t package_count;
    const char *ros_package_path;         /**< folders with colons between; NULL: the environment's ROS_PACKAGE_PATH */
    const char *ament_prefix_path;        /**< the same; NULL: the environment's AMENT_PREFIX_PATH */
    int parts;                            /**< 0: a mesh is one body; 1: the hulls of its objects (OBJ `o`, nodes) */
    int visual;                           /**< 1: a link without collision geometry takes its visual one */
    int fixed_base;                       /**< 1: the SRDF's virtual joint adds nothing: the root link is the base */
    int trusted;                          /**< as in ovoid_read_options */
    double tolerance;                     /**< of cylinders: the largest `outside` of their allowance; 0: radius/200 */
    const ovoid_robot_link_scale *scales; /**< NULL: every factor is 1; a link occurs at most once */
    size_t scale_count;
    const ovoid_shape_options *shape; /**< of all shapes; their radius must be 0; NULL: the default */
    int hull; /**< 0: a mesh is what its triangles are (ovoid_triangles_compute_hull_match): its hull, exactly or with
                 an allowance that keeps brackets true; the solid that they enclose; or, if they are not closed, their
                 surface, which a note reports. 1: its hull. Without effect with `parts` */
    void (*note)(void *context, const ovoid_robot_note *note); /**< NULL: notes are dropped */
    void *context;
} ovoid_robot_read_options;

/** A URDF, perhaps with an SRDF: names, numbers and shapes. Owned by the caller. */
typedef struct ovoid_robot_file ovoid_robot_file;

/**
 * Reads a URDF, the meshes of its collision geometry and, if srdf is not NULL, an SRDF. Meshes are read as by
 * ovoid_mesh_read; each file and scale is read once and its shapes shared. Boxes, spheres, capsules are exact,
 * cylinders have an allowance. All lengths are metres, as in URDF.
 *
 * Errors: FILE (also absent meshes, each reported by a note with the places that were searched), FORMAT (input that
 * does not follow the format; a loop, a link without a joint, two roots, a duplicate name, a mimic of itself or in a
 * ring, lower above upper limits), NOT_FINITE, RANGE, ROTATION (an axis of zero), RADIUS, ARGUMENT (an option; a scale
 * of an unknown link), LIMIT, MEMORY and those of ovoid_mesh_read. xacro files are refused with the command that
 * expands them. Cost: n log n in the links, plus the shapes.
 */
OVOID_API ovoid_robot_file *ovoid_robot_file_read(const char *urdf, const char *srdf,
                                                  const ovoid_robot_read_options *options, ovoid_error *error);

/** A URDF or an SRDF in memory, as ROS keeps it in the parameter robot_description. */
typedef struct ovoid_robot_text {
    const char *path; /**< errors name the text by it; meshes are looked for from its folder. It need not be there */
    const char *data; /**< NULL: the file of the path is read */
    size_t size;
} ovoid_robot_text;

/** As ovoid_robot_file_read, of texts. srdf: NULL for none. Errors: as there; LIMIT: a text of more than 64 MB. */
OVOID_API ovoid_robot_file *ovoid_robot_file_read_text(const ovoid_robot_text *urdf, const ovoid_robot_text *srdf,
                                                       const ovoid_robot_read_options *options, ovoid_error *error);
/** Frees it and its shapes; NULL is allowed. */
OVOID_API void ovoid_robot_file_destroy(ovoid_robot_file *file);
/**
 * The argument of ovoid_robot_create: a view. Links and joints are in the order of the file. An SRDF's virtual joint,
 * unless fixed_base is set, adds a link, its parent frame, which is then the root, and a joint, each after those of the
 * URDF.
 */
OVOID_API ovoid_robot_description ovoid_robot_file_get_description(const ovoid_robot_file *file);

/** One mesh file, at one scale: a view. */
typedef struct ovoid_robot_mesh {
    const char *path;          /**< where it was found */
    const char *address;       /**< what the URDF says */
    ovoid_vec3 scale;          /**< negative factors mirror */
    size_t part_count;         /**< hulls: 1, or with options->parts the objects */
    size_t use_count;          /**< collision elements that share them */
    ovoid_convexity convexity; /**< summed over the parts; mesh_volume is NaN if one is not known */
    ovoid_mesh_kind kind;      /**< the kind as which it is queried: HULL, PARTS, SOLID or SURFACE */
    double allowance; /**< of HULL: the `inside` of the shape's allowance, 0 where the mesh is the hull exactly */
} ovoid_robot_mesh;

/** How many meshes there are. */
OVOID_API size_t ovoid_robot_file_get_mesh_count(const ovoid_robot_file *file);
/** Mesh i < mesh count, in the order of their paths. */
OVOID_API ovoid_robot_mesh ovoid_robot_file_get_mesh(const ovoid_robot_file *file, size_t i);

/**
 * Elements that were not read, by their path, "link/inertial", "robot/transmission", "joint/dynamics"; and
 * attributes without effect of elements that were read, "limit@uper".
 */
typedef struct ovoid_robot_ignored {
    const char *name;
    size_t count;
} ovoid_robot_ignored;

/** How many kinds of ignored elements there are. */
OVOID_API size_t ovoid_robot_file_get_ignored_count(const ovoid_robot_file *file);
/** Kind i < that count, in the order of their names. */
OVOID_API ovoid_robot_ignored ovoid_robot_file_get_ignored(const ovoid_robot_file *file, size_t i);

/** The number of mimics on fixed joints, which some public files have: they mean nothing and are dropped. */
OVOID_API size_t ovoid_robot_file_get_fixed_mimic_count(const ovoid_robot_file *file);

/** A group of an SRDF, its subgroups and chains resolved: indices of the description, ascending. A view. */
typedef struct ovoid_robot_group {
    const char *name;
    const uint32_t *joints;
    size_t joint_count;
    const uint32_t *links;
    size_t link_count;
} ovoid_robot_group;

/** How many groups there are. */
OVOID_API size_t ovoid_robot_file_get_group_count(const ovoid_robot_file *file);
/** Group i < group count, in the order of the file. */
OVOID_API ovoid_robot_group ovoid_robot_file_get_group(const ovoid_robot_file *file, size_t i);

/** An end effector of an SRDF: the group of its own links, and the link that carries it. A view. */
typedef struct ovoid_robot_end_effector {
    const char *name;
    uint32_t link; /**< parent_link */
    size_t group;  /**< an index below the group count */
} ovoid_robot_end_effector;

/** How many end effectors there are. */
OVOID_API size_t ovoid_robot_file_get_end_effector_count(const ovoid_robot_file *file);
/** End effector i < that count, in the order of the file. */
OVOID_API ovoid_robot_end_effector ovoid_robot_file_get_end_effector(const ovoid_robot_file *file, size_t i);

/** The values of one joint in a state. */
typedef struct ovoid_robot_value {
    uint32_t joint;
    uint32_t count;       /**< of variables: 1, or 3 and 7 for planar and floating joints */
    const double *values; /**< floating: x, y, z, quaternion w x y z */
} ovoid_robot_value;

/** A named state of an SRDF: the values of some joints. A view. */
typedef struct ovoid_robot_state {
    const char *name, *group; /**< group: "" if none is named */
    const ovoid_robot_value *values;
    size_t value_count;
} ovoid_robot_state;

/** How many named states there are. */
OVOID_API size_t ovoid_robot_file_get_state_count(const ovoid_robot_file *file);
/** State i < state count, in the order of the file. */
OVOID_API ovoid_robot_state ovoid_robot_file_get_state(const ovoid_robot_file *file, size_t i);

/** The spheres of an SRDF's link_sphere_approximation; *count of them. A view. */
OVOID_API const ovoid_robot_link_sphere *ovoid_robot_file_get_spheres(const ovoid_robot_file *file, size_t *count);
/** The passive joints; *count of them. A view. */
OVOID_API const uint32_t *ovoid_robot_file_get_passive(const ovoid_robot_file *file, size_t *count);

/* ---- obstacles ---- */

/** Obstacles, from a scene. Owned by the caller. */
typedef struct ovoid_obstacles ovoid_obstacles;

/** An obstacle: a view. An object of several parts is several obstacles of one name. */
typedef struct ovoid_obstacle {
    const char *name;
    const ovoid_shape *shape; /**< of a solid its hull */
    ovoid_pose pose; /**< for an object with a pose and parts with poses: ovoid_pose_compute_product, by definition */
    const ovoid_solid
        *solid;        /**< a solid or a surface, which is queried instead of the hull; NULL: the shape is queried */
    const char *frame; /**< the frame of the pose: a link or a fixed frame of the scene; NULL: the root link's */
    const char *link;  /**< the link that holds it; NULL: none */
} ovoid_obstacle;

/**
 * Reads a scene: MoveIt's planning scene (.yaml, .yml), its text (.scene, older and newer format), or ovoid's own
 * (.json, .ovoids: ovoid_scene_read), in metres: another unit is refused (FORMAT). Meshes are hulls, solids or surfaces
 * by their triangles, or with options->hull their hulls; then a scene that asks for a solid is refused. Equal
 * primitives share a shape. docs/robot.md describes each key of a planning scene, and which have no effect; any other
 * key, and everything that cannot be obeyed (octomaps, planes, scaled links), is refused with its line. options:
 * tolerance (of planning scenes: cylinders of ovoid's own scenes have theirs there), shape, hull, note. Errors: those
 * of ovoid_robot_file_read.
 */
OVOID_API ovoid_obstacles *ovoid_obstacles_read(const char *path, const ovoid_robot_read_options *options,
                                                ovoid_error *error);
/** Frees them and their shapes; NULL is allowed. */
OVOID_API void ovoid_obstacles_destroy(ovoid_obstacles *obstacles);
/** The number of obstacles; may be 0. */
OVOID_API size_t ovoid_obstacles_get_count(const ovoid_obstacles *obstacles);
/** Obstacle i < count, in the order of the file. */
OVOID_API ovoid_obstacle ovoid_obstacles_get(const ovoid_obstacles *obstacles, size_t i);

/** The pose of an obstacle in a cell. */
typedef struct ovoid_placed_obstacle {
    ovoid_id id;
    uint32_t link;   /**< the link that holds it; OVOID_ROBOT_NONE: none */
    ovoid_pose pose; /**< in that link's frame, or in the root link's */
} ovoid_placed_obstacle;

/**
 * Puts a scene around a robot: adds its obstacles to the cell, attaches the bodies that links hold, pads links, and
 * allows the collisions that the scene allows. If an obstacle's frame is a link, it is placed where that link is in the
 * scene's robot_state, as in MoveIt, and stays there. The allowed_collision_matrix of a scene replaces the pairs that
 * the SRDF disables; without one these remain disabled. The obstacles are borrowed. placed: room for their count, or
 * NULL. Errors, with the line of the scene: FORMAT (an unknown frame or link; an ambiguous entry of the matrix), those
 * of ovoid_robot_cell_add and ovoid_robot_cell_attach; then the cell has none of the obstacles.
 */
OVOID_API ovoid_code ovoid_robot_cell_add_obstacles(ovoid_robot_cell *cell, const ovoid_obstacles *obstacles,
                                                    ovoid_placed_obstacle *placed, ovoid_error *error);

/* ---- planning problems ---- */

/** The value of one joint, by its name. */
typedef struct ovoid_joint_position {
    const char *joint;
    double position;
} ovoid_joint_position;

/** A motion planning request of MoveIt: a start, and alternative goals. Owned by the caller. */
typedef struct ovoid_motion_request ovoid_motion_request;

/**
 * Reads a request (YAML): start_state: joint_state, goal_constraints: joint_constraints, group_name. Keys that
 * configure a planner's search have no effect; constraints of the path and reference trajectories are not read, and a
 * note names them. Any other key is refused with its line, as are goals that are not given by joints, and a base that
 * is not at its frame.
 */
OVOID_API ovoid_motion_request *ovoid_motion_request_read(const char *path, const ovoid_robot_read_options *options,
                                                          ovoid_error *error);
/** Frees it; NULL is allowed. */
OVOID_API void ovoid_motion_request_destroy(ovoid_motion_request *request);
/** Its group_name; "" if it has none. */
OVOID_API const char *ovoid_motion_request_get_group(const ovoid_motion_request *request);
/** The joint values at the start; *count of them. A view. */
OVOID_API const ovoid_joint_position *ovoid_motion_request_get_start(const ovoid_motion_request *request,
                                                                     size_t *count);
/** How many goals there are. */
OVOID_API size_t ovoid_motion_request_get_goal_count(const ovoid_motion_request *request);
/** The joint values at goal i < goal count; *count of them. A view. */
OVOID_API const ovoid_joint_position *ovoid_motion_request_get_goal(const ovoid_motion_request *request, size_t i,
                                                                    size_t *count);

/** The planning problems of a folder: pairs of a scene and a request. Owned by the caller. */
typedef struct ovoid_problems ovoid_problems;

/** A problem: paths to be read by ovoid_obstacles_read and ovoid_motion_request_read. A view. */
typedef struct ovoid_problem {
    const char *name; /**< "box_panda/0001": the folder below the given one, and the common part of the file names */
    const char *scene, *request;
} ovoid_problem;

/**
 * Finds the problems of a folder and the folders in it, three deep, in the order of their names: files sceneX.yaml and
 * requestX.yaml (or .yml) beside each other. A request without a scene is an error (FILE); EMPTY if there are none.
 */
OVOID_API ovoid_problems *ovoid_problems_find(const char *folder, ovoid_error *error);
/** Frees them; NULL is allowed. */
OVOID_API void ovoid_problems_destroy(ovoid_problems *problems);
/** How many there are, at least 1. */
OVOID_API size_t ovoid_problems_get_count(const ovoid_problems *problems);
/** Problem i < count. */
OVOID_API ovoid_problem ovoid_problems_get(const ovoid_problems *problems, size_t i);

/* ---- trajectories ---- */

/** A trajectory of MoveIt or ROS: joints' numbers at points, one after another. Owned by the caller. */
typedef struct ovoid_trajectory ovoid_trajectory;

/**
 * Reads a trajectory (YAML or JSON): moveit_msgs/RobotTrajectory, moveit_msgs/DisplayTrajectory and other messages that
 * hold one or several as "trajectory", trajectory_msgs/JointTrajectory, or one sensor_msgs/JointState. Several
 * trajectories follow one another: each begins at the time at which the one before ended. A first point at that time is
 * left out where it repeats that state, and refused where it does not. Velocities, accelerations, efforts and
 * tolerances are not used. Any other key is refused with its line, as are joints of several variables
 * (multi_dof_joint_trajectory), a start that holds an object, points of which only some have times, and times that do
 * not rise. A first point more than 0.01 from trajectory_start is a note. options: note. Errors: FILE, FORMAT,
 * NOT_FINITE, EMPTY (no points), LIMIT, MEMORY.
 */
OVOID_API ovoid_trajectory *ovoid_trajectory_read(const char *path, const ovoid_robot_read_options *options,
                                                  ovoid_error *error);
/** Frees it; NULL is allowed. */
OVOID_API void ovoid_trajectory_destroy(ovoid_trajectory *trajectory);
/** The joints' numbers of trajectory_start; *count of them, 0 where there is none. A view. */
OVOID_API const ovoid_joint_position *ovoid_trajectory_get_start(const ovoid_trajectory *trajectory, size_t *count);
/** How many points there are, at least 1. */
OVOID_API size_t ovoid_trajectory_get_count(const ovoid_trajectory *trajectory);
/** The joints' numbers at point i < count; *count of them. Joints that it does not name stand still. A view. */
OVOID_API const ovoid_joint_position *ovoid_trajectory_get_point(const ovoid_trajectory *trajectory, size_t i,
                                                                 size_t *count);
/** The time of point i < count in seconds from the start; NaN where the points have none, or all are 0. */
OVOID_API double ovoid_trajectory_get_time(const ovoid_trajectory *trajectory, size_t i);
/** The line of point i < count in the file. */
OVOID_API int64_t ovoid_trajectory_get_line(const ovoid_trajectory *trajectory, size_t i);

#ifdef __cplusplus
}
#endif
#endif
