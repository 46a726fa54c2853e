/**
 * @file robot.h
 * Robots: links connected by joints, their poses for given joint values, and what they touch. A library of its own,
 * libovoid_robot, on top of the core, so that a program without robots does not carry it.
 *
 * A robot is immutable: any number of threads share it. Links, joints and elements keep the order of the description
 * and are named by their index in it; OVOID_ROBOT_NONE means none. Lengths are in the caller's unit (metres in URDF),
 * angles in radians, quaternions as in ovoid_pose. docs/robot-states.md has the mathematics.
 */
#ifndef OVOID_ROBOT_H
#define OVOID_ROBOT_H

#include "ovoid/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/** No link, no joint. */
#define OVOID_ROBOT_NONE 0xffffffffu

/** The largest number of links of a robot. */
#define OVOID_ROBOT_LINKS_MAX ((size_t)1 << 20)

/** How a joint moves its child link. */
typedef enum ovoid_joint_type {
    OVOID_JOINT_FIXED = 0,
    OVOID_JOINT_REVOLUTE,   /**< 1 variable: the angle about the axis, within limits */
    OVOID_JOINT_CONTINUOUS, /**< 1 variable: the angle about the axis, any */
    OVOID_JOINT_PRISMATIC,  /**< 1 variable: the length along the axis, within limits */
    OVOID_JOINT_PLANAR, /**< 3 variables: x and y in the plane normal to the axis, then the angle about it; for the axes
                           z and -z, x is the x of the frame */
    OVOID_JOINT_FLOATING /**< 7 variables: x y z, then a quaternion w x y z of any norm but zero; no axis */
} ovoid_joint_type;

/** The name of a type as URDF has it, for example "revolute"; never NULL. */
OVOID_API const char *ovoid_joint_type_get_name(ovoid_joint_type type);
/** How many variables a joint of that type has: 0, 1, 3 or 7. */
OVOID_API uint32_t ovoid_joint_type_get_variable_count(ovoid_joint_type type);

/* ---- the description ---- */

/** A link. */
typedef struct ovoid_robot_link {
    const char *name;
} ovoid_robot_link;

/**
 * A joint: child frame = parent frame, then `origin`, then the motion of the joint along or about its axis, as in URDF.
 */
typedef struct ovoid_robot_joint {
    const char *name;
    ovoid_joint_type type;
    uint32_t parent, child; /**< links */
    ovoid_pose origin;      /**< of the joint's frame in the parent link's */
    ovoid_vec3 axis;        /**< in the joint's frame, of any length but zero; not used by FIXED and FLOATING */
    double lower, upper;    /**< of the variable of REVOLUTE and PRISMATIC; not used by the others */
    double velocity;        /**< the largest, per second; 0: not given */
    uint32_t mimic; /**< the joint whose variable it follows, as multiplier * q + offset; NONE: it has its own. Only for
                       types of 1 variable */
    double multiplier, offset;
} ovoid_robot_joint;

/** A part of a link's collision geometry, convex or a solid. */
typedef struct ovoid_robot_element {
    uint32_t link;
    const char *name; /**< may be NULL */
    const ovoid_shape *shape;
    ovoid_pose pose; /**< in the link's frame */
    const ovoid_solid
        *solid; /**< NULL; or the solid that is the element: `shape` must then be the convex hull of all its points, and
                   is queried first where it suffices. Borrowed, whatever `takes_shapes` is */
} ovoid_robot_element;

/** Two links. */
typedef struct ovoid_robot_pair {
    uint32_t a, b;
    const char *reason; /**< may be NULL */
} ovoid_robot_pair;

/** Everything that defines a robot. Names are not NULL, unless the field says so. */
typedef struct ovoid_robot_description {
    const char *name; /**< may be NULL */
    const ovoid_robot_link *links;
    size_t link_count;
    const ovoid_robot_joint *joints; /**< in any order; they make one tree of all links */
    size_t joint_count;
    const ovoid_robot_element *elements; /**< in any order */
    size_t element_count;
    const ovoid_robot_pair *disabled; /**< pairs of links that are never queried; one may come twice */
    size_t disabled_count;
    const char *frame; /**< another name of the root link's frame, which scenes may use; may be NULL */
} ovoid_robot_description;

/** Options of a robot; all zero, or NULL, is the default. */
typedef struct ovoid_robot_options {
    int takes_shapes; /**< 0: the shapes are borrowed and must outlive the robot; 1: the robot owns them and destroys
                         each once. If the robot could not be created they remain the caller's */
    const ovoid_allocator *allocator; /**< NULL: malloc and free; copied */
} ovoid_robot_options;

/** A robot: a description, checked and compiled. */
typedef struct ovoid_robot ovoid_robot;

/**
 * Compiles a description, all of which but the shapes is copied. NULL on failure with *error filled (may be NULL); the
 * sentence names the link or joint, and place is its index: ARGUMENT (two roots, a loop, a link with two parents, a
 * duplicate or empty name, lower above upper limits, a mimic of itself or in a ring or of a joint without one variable,
 * an element without a shape), INDEX (a link or joint that does not exist), NOT_FINITE, RANGE, ROTATION (a quaternion
 * or an axis of zeros), EMPTY (no links), LIMIT, MEMORY. Cost: n log n; 0.1 s for 10^5 links.
 */
OVOID_API ovoid_robot *ovoid_robot_create(const ovoid_robot_description *description,
                                          const ovoid_robot_options *options, ovoid_error *error);
/** Frees it; NULL is allowed. Nothing may be using it. */
OVOID_API void ovoid_robot_destroy(ovoid_robot *robot);

/* ---- what it is made of ---- */

/** The description as compiled: a view into the robot. disabled is sorted, a < b, each pair once. */
OVOID_API ovoid_robot_description ovoid_robot_get_description(const ovoid_robot *robot);
/** The link of that name, or OVOID_ROBOT_NONE. */
OVOID_API uint32_t ovoid_robot_find_link(const ovoid_robot *robot, const char *name);
/** The joint of that name, or OVOID_ROBOT_NONE. */
OVOID_API uint32_t ovoid_robot_find_joint(const ovoid_robot *robot, const char *name);
/** The link that is not the child of a joint. */
OVOID_API uint32_t ovoid_robot_get_root(const ovoid_robot *robot);
/** The joint whose child the link is; OVOID_ROBOT_NONE for the root. */
OVOID_API uint32_t ovoid_robot_get_parent_joint(const ovoid_robot *robot, uint32_t link);

/** A variable: one number of a state. */
typedef struct ovoid_robot_variable {
    uint32_t joint;      /**< the joint that it belongs to; others may mimic it */
    uint32_t component;  /**< of the joint: 0, up to 2 of PLANAR, up to 6 of FLOATING */
    double lower, upper; /**< limits; -infinity and infinity if there are none */
    double velocity;     /**< the largest, per second; 0: not given */
} ovoid_robot_variable;

/** How many numbers a state has. */
OVOID_API size_t ovoid_robot_get_variable_count(const ovoid_robot *robot);
/** Variable i of a state, in the order of the joints; joints that are fixed or mimic others have none. */
OVOID_API ovoid_robot_variable ovoid_robot_get_variable(const ovoid_robot *robot, size_t i);
/** The first variable that moves the joint: its own, or that of the joint that it follows; OVOID_ROBOT_NONE: fixed. */
OVOID_API uint32_t ovoid_robot_get_joint_variable(const ovoid_robot *robot, uint32_t joint);

/* ---- where its links are ---- */

/** Angles above this, in radians, are refused. */
#define OVOID_ROBOT_ANGLE_MAX 1e9

/**
 * How far a pose is from that of the exact kinematics: the origin by at most `position`, the rotation by at most
 * `rotation` in the operator norm. So a point at x in the link's frame is off by at most position + rotation |x|. The
 * exact kinematics uses the given numbers, for every joint the rotation of its normalised quaternion and normalised
 * axis, and the exact sines and cosines of the angles.
 */
typedef struct ovoid_robot_pose_error {
    double position, rotation;
} ovoid_robot_pose_error;

/**
 * The poses of all links in the root link's frame. q: variable count numbers; poses: link count. Allocates nothing.
 * Limits are not checked (ovoid_robot_validate_limits). Errors (place: the variable): NOT_FINITE, RANGE (an angle above
 * OVOID_ROBOT_ANGLE_MAX, a length above OVOID_LENGTH_MAX), ROTATION (a floating joint's quaternion is zero).
 */
OVOID_API ovoid_code ovoid_robot_compute_poses(const ovoid_robot *robot, const double *q, ovoid_pose *poses,
                                               ovoid_error *error);

/**
 * Bounds of the error of each pose. q, poses: of a call of ovoid_robot_compute_poses that succeeded; errors: link
 * count.
 */
OVOID_API void ovoid_robot_compute_pose_errors(const ovoid_robot *robot, const double *q, const ovoid_pose *poses,
                                               ovoid_robot_pose_error *errors);

/** States, and room for the poses of their links. */
typedef struct ovoid_robot_pose_batch {
    const double *q; /**< state i from i * variable count on */
    size_t count;
    ovoid_pose *poses; /**< receives those of state i from i * link count on */
} ovoid_robot_pose_batch;

/**
 * The poses of many states, with the bits of ovoid_robot_compute_poses, eight at a time if the machine has vectors.
 * Working memory is allocated once a call by the robot's allocator. Errors: MEMORY, and those of the first state that
 * is refused; then poses are not complete.
 */
OVOID_API ovoid_code ovoid_robot_compute_poses_batch(const ovoid_robot *robot, const ovoid_robot_pose_batch *batch,
                                                     ovoid_error *error);

/**
 * OVOID_OK if every variable, and every joint that follows another one, is within its limits or outside by at most
 * `slack`; RANGE (place: the variable, of a following joint that of the joint it follows; the sentence names the
 * joint), NOT_FINITE.
 */
OVOID_API ovoid_code ovoid_robot_validate_limits(const ovoid_robot *robot, const double *q, double slack,
                                                 ovoid_error *error);

/* ---- a robot among obstacles ---- */

/**
 * A robot, the obstacles around it, the bodies that it holds, and the pairs that are excluded. One thread may change
 * it, while no checker queries it. A change that fails leaves it unchanged, except if memory runs out (or LIMIT is met)
 * while a body is removed or a pair allowed: then queries return MEMORY until a change succeeds. A pair of links is
 * queried unless the description disables it, the cell allows it, or only fixed joints are between the two, so that
 * they never move relative to each other (ovoid_robot_is_rigid_pair).
 */
typedef struct ovoid_robot_cell ovoid_robot_cell;

/** Options of a cell; all zero, or NULL, is the default. */
typedef struct ovoid_robot_cell_options {
    const ovoid_allocator *allocator; /**< NULL: malloc and free; copied */
} ovoid_robot_cell_options;

/** A cell without obstacles; NULL on failure: MEMORY, LIMIT (more than 2^24 pairs of elements). Borrows the robot. */
OVOID_API ovoid_robot_cell *ovoid_robot_cell_create(const ovoid_robot *robot, const ovoid_robot_cell_options *options,
                                                    ovoid_error *error);
/** Frees it; NULL is allowed. No checker may use it any more. */
OVOID_API void ovoid_robot_cell_destroy(ovoid_robot_cell *cell);

/** 1: only fixed joints are between the two links. */
OVOID_API int ovoid_robot_is_rigid_pair(const ovoid_robot *robot, uint32_t a, uint32_t b);

/**
 * Adds an obstacle, which is borrowed and posed in the root link's frame. Returns its id, as those of ovoid_world; 0 on
 * failure: ARGUMENT (not exactly one of shape, compound and solid), the codes of ovoid_pose_validate, MEMORY, LIMIT.
 * The cell computes the hull of a solid.
 */
OVOID_API ovoid_id ovoid_robot_cell_add(ovoid_robot_cell *cell, const ovoid_body *body, ovoid_error *error);
/** A body that a link holds. */
typedef struct ovoid_robot_attachment {
    uint32_t link;
    ovoid_body body;          /**< borrowed; its pose is in the link's frame */
    const uint32_t *touching; /**< other links that may touch it, touching_count of them; may be NULL */
    size_t touching_count;
} ovoid_robot_attachment;

/**
 * Attaches a body to a link: it moves with the link, and is queried against obstacles and all links but this one and
 * those that may touch it. Errors as in ovoid_robot_cell_add, and INDEX.
 */
OVOID_API ovoid_id ovoid_robot_cell_attach(ovoid_robot_cell *cell, const ovoid_robot_attachment *attachment,
                                           ovoid_error *error);
/** Removes an obstacle or an attached body. Errors: INDEX. */
OVOID_API ovoid_code ovoid_robot_cell_remove(ovoid_robot_cell *cell, ovoid_id id, ovoid_error *error);
/** Moves an obstacle, or an attached body in its link's frame. Errors: INDEX, those of ovoid_pose_validate. */
OVOID_API ovoid_code ovoid_robot_cell_move(ovoid_robot_cell *cell, ovoid_id id, const ovoid_pose *pose,
                                           ovoid_error *error);
/**
 * Allows two links to touch, in addition to the pairs that the description disables. Errors: INDEX, ARGUMENT (a is b),
 * MEMORY.
 */
OVOID_API ovoid_code ovoid_robot_cell_add_allowed(ovoid_robot_cell *cell, uint32_t a, uint32_t b, ovoid_error *error);
/** Queries two links again that were allowed to touch. Errors: those of ovoid_robot_cell_add_allowed. */
OVOID_API ovoid_code ovoid_robot_cell_remove_allowed(ovoid_robot_cell *cell, uint32_t a, uint32_t b,
                                                     ovoid_error *error);
/**
 * Allows a link, with the bodies attached to it, to touch an obstacle; or an attached body to touch a link. Errors:
 * INDEX, MEMORY.
 */
OVOID_API ovoid_code ovoid_robot_cell_add_body_allowed(ovoid_robot_cell *cell, ovoid_id id, uint32_t link,
                                                       ovoid_error *error);
/** Queries a pair again that ovoid_robot_cell_add_body_allowed excluded. Errors: those of that function. */
OVOID_API ovoid_code ovoid_robot_cell_remove_body_allowed(ovoid_robot_cell *cell, ovoid_id id, uint32_t link,
                                                          ovoid_error *error);
/**
 * Enlarges a link, with the bodies attached to it, against obstacles, by a rounding radius >= 0, exactly: an obstacle
 * nearer than that counts as touched. Pairs of links are not padded. Errors: INDEX, RADIUS.
 */
OVOID_API ovoid_code ovoid_robot_cell_set_padding(ovoid_robot_cell *cell, uint32_t link, double padding,
                                                  ovoid_error *error);

/**
 * 1: a pair of links is not queried: the description disables it, the cell allows it, the two never move relative to
 * each other, or they are the same link. Links must be of the robot.
 */
OVOID_API int ovoid_robot_cell_is_allowed(const ovoid_robot_cell *cell, uint32_t a, uint32_t b);
/** 1: an obstacle or an attached body of the cell is not queried with a link. 0 for an unknown id. */
OVOID_API int ovoid_robot_cell_is_body_allowed(const ovoid_robot_cell *cell, ovoid_id id, uint32_t link);
/** By how much a link is enlarged against obstacles. */
OVOID_API double ovoid_robot_cell_get_padding(const ovoid_robot_cell *cell, uint32_t link);

/**
 * What one thread needs to query states of a cell: memory, and the proofs of its last state, from which the next query
 * starts.
 */
typedef struct ovoid_robot_checker ovoid_robot_checker;

/** Options of a checker; all zero, or NULL, is the default. */
typedef struct ovoid_robot_checker_options {
    const ovoid_allocator *allocator; /**< NULL: malloc and free; copied */
} ovoid_robot_checker_options;

/**
 * A checker; NULL on failure: MEMORY. Its queries allocate only after the cell has changed, and 4.9 MB once where the
 * depth of a near pair needs them. The first checker of a robot makes tables for pairs of its links, shared by all its
 * checkers, by the robot's allocator: some tens of milliseconds and about a megabyte for an arm (docs/robot-states.md).
 */
OVOID_API ovoid_robot_checker *ovoid_robot_checker_create(const ovoid_robot_cell *cell,
                                                          const ovoid_robot_checker_options *options,
                                                          ovoid_error *error);
/** Frees it; NULL is allowed. */
OVOID_API void ovoid_robot_checker_destroy(ovoid_robot_checker *checker);
/** Forgets the last state: the next query has the bits of a new checker's query. */
OVOID_API void ovoid_robot_checker_reset(ovoid_robot_checker *checker);

/** The status of a state. */
typedef enum ovoid_robot_status {
    OVOID_ROBOT_UNDECIDED = 0, /**< some pair could not be decided: treat it as a hit. With the code EMPTY: no pair is
                                  queried, so nothing is claimed */
    OVOID_ROBOT_FREE,   /**< every queried pair is farther apart than the margin, proven; there is at least one pair */
    OVOID_ROBOT_HIT,    /**< a pair is within the margin, proven */
    OVOID_ROBOT_REFUSED /**< the state is not valid: see code and variable */
} ovoid_robot_status;

/** One side of a pair. */
typedef struct ovoid_robot_side {
    uint32_t link;    /**< OVOID_ROBOT_NONE: an obstacle */
    uint32_t element; /**< of the description; OVOID_ROBOT_NONE: an obstacle, or a body attached to the link */
    ovoid_id body;    /**< the obstacle or the attached body; 0: an element */
    uint32_t part;    /**< of the body, if that is a compound */
} ovoid_robot_side;

/** The answer to a state. */
typedef struct ovoid_robot_answer {
    ovoid_robot_status status;
    ovoid_code code;   /**< REFUSED: why, as ovoid_robot_compute_poses and ovoid_robot_validate_limits say */
    uint32_t variable; /**< REFUSED: which */
    ovoid_robot_side a,
        b; /**< the pair of HIT and UNDECIDED; a is of the robot; if both are, a is of the link with the lower index */
    double lower,
        upper; /**< bracket of that pair's signed distance, with padding and the errors of the poses included */
} ovoid_robot_answer;

/** How a state is checked; all zero, or NULL, is the default. */
typedef struct ovoid_robot_query_options {
    double margin;         /**< >= 0: pairs nearer than this are hits */
    double limit_slack;    /**< by how much variables may be outside their limits; >= 0, infinity: limits are ignored */
    int without_self;      /**< 1: pairs of links are not queried */
    int without_obstacles; /**< 1: obstacles are not queried */
} ovoid_robot_query_options;

/** A query of one state. */
typedef struct ovoid_robot_query {
    const double *q;                          /**< the state: variable count numbers */
    const ovoid_robot_query_options *options; /**< NULL: the default */
} ovoid_robot_query;

/**
 * Is the state free? Ends at the first pair that is proven within the margin, and begins with the pair that ended the
 * last state. Which pair is named depends on the states before (ovoid_robot_checker_reset); so does the status if a
 * pair is within rounding of the margin. Errors: ARGUMENT (options), MEMORY; then *answer is UNDECIDED.
 */
OVOID_API ovoid_code ovoid_robot_collide(ovoid_robot_checker *checker, const ovoid_robot_query *query,
                                         ovoid_robot_answer *answer, ovoid_error *error);

/** States to check. */
typedef struct ovoid_robot_batch {
    const double *q; /**< state i from i * variable count on */
    size_t count;
    const ovoid_robot_query_options *options; /**< NULL: the default */
    ovoid_robot_answer *answers;              /**< count */
} ovoid_robot_batch;

/** The number of states of a batch that are checked one after another by a checker that starts as if it were new. */
#define OVOID_ROBOT_BLOCK 256

/**
 * Checks many states, eight at a time, in blocks of OVOID_ROBOT_BLOCK, on as many threads as there are checkers (of one
 * cell, each given once), the caller's included. Each state gets the bits that ovoid_robot_collide gives if the states
 * of its block are queried in order after ovoid_robot_checker_reset; they do not depend on the number of threads. The
 * call starts its threads, so more than one thread pays for thousands of states. Errors: ARGUMENT (options, no
 * checker), MEMORY, LIMIT (no thread could be started; the others did the work, and all answers are written).
 */
OVOID_API ovoid_code ovoid_robot_collide_batch(ovoid_robot_checker *const *checkers, size_t checker_count,
                                               const ovoid_robot_batch *batch, ovoid_error *error);

/** A near pair of a state. */
typedef struct ovoid_robot_near {
    ovoid_robot_side a, b;
    ovoid_status status;
    double lower, upper; /**< bracket of the signed distance, with padding and the errors of the poses included */
    ovoid_vec3 point_a, point_b; /**< root link's frame; of the padded link */
    ovoid_vec3 normal;           /**< unit, from a to b */
    int has_gradient; /**< 1: proven that the distance of the true bodies is differentiable here, and that this is its
                         gradient, in the form of ovoid_gradient, by translations and rotations */
} ovoid_robot_near;

/** Memory for near pairs. */
typedef struct ovoid_robot_nears {
    ovoid_robot_near *items; /**< owned by the caller; nearest first, by lower */
    double *gradients;       /**< d(distance)/d(variables): of item i from i * variable count on; or NULL */
    size_t capacity;
    size_t count;       /**< written: how many pairs there are; if more than capacity, the nearest were written */
    int without_depths; /**< 1, for ovoid_robot_find_near only: most pairs that overlap are reported without their
                           depths: a wide bracket that ends below zero, no points, no gradient */
} ovoid_robot_nears;

/**
 * All pairs that are not proven farther apart than query->options->margin, with their distances; overlapping ones with
 * their depths. Errors: ARGUMENT, MEMORY, and those that ovoid_robot_collide reports in a refused answer.
 */
OVOID_API ovoid_code ovoid_robot_find_near(ovoid_robot_checker *checker, const ovoid_robot_query *query,
                                           ovoid_robot_nears *nears, ovoid_error *error);

/**
 * The nearest pair, unless all pairs are proven farther apart than query->options->margin, which may be infinity: nears
 * gets one item, or none, whatever its capacity (>= 1). Errors as in ovoid_robot_find_near.
 */
OVOID_API ovoid_code ovoid_robot_find_nearest(ovoid_robot_checker *checker, const ovoid_robot_query *query,
                                              ovoid_robot_nears *nears, ovoid_error *error);

#ifdef __cplusplus
}
#endif
#endif
