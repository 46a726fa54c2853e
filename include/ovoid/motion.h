/**
 * @file motion.h
 * Bodies that move: their poses, when they meet, how near they come, casts and rays, and the boxes that they sweep.
 * Every answer is a bracket that holds for all times in between, rounding included; its proof is a sequence of steps
 * that can be checked without a search. Nothing is allocated, locked or kept; work is bounded; stack as in
 * <ovoid/query.h>.
 */
#ifndef OVOID_MOTION_H
#define OVOID_MOTION_H

#include "ovoid/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How a motion is given. */
typedef enum ovoid_motion_kind {
    OVOID_MOTION_STILL = 0, /**< at `start`, at all times */
    OVOID_MOTION_VELOCITY,  /**< a constant linear and angular velocity from time 0 to `duration` */
    OVOID_MOTION_POSES,     /**< from `start` at time 0 to `end` at time `duration` */
    OVOID_MOTION_PATH       /**< through poses[i] at times[i] */
} ovoid_motion_kind;

/**
 * A motion is an exact mathematical object. With p, R the position and rotation of `start`, c = p + R pivot:
 * - VELOCITY: x(t) = c + t linear + exp(t [angular]) R (x - pivot). Angular is in the world frame, in radians per unit
 *   of time; `pivot`, in the body's local frame, is the point that moves along a straight line.
 * - POSES: the position is linear in time; the rotation is about one fixed axis with constant velocity, by the shorter
 * way (slerp); at half a turn, the sign of the computed product of both quaternions decides the way.
 * - PATH: POSES between each two neighbours of the path.
 * At the ends of POSES and at the times of a PATH the pose is the given one, bit for bit.
 */
typedef struct ovoid_motion {
    ovoid_motion_kind kind;
    ovoid_pose start, end;
    ovoid_vec3 linear, angular, pivot;
    double duration;         /**< > 0; VELOCITY and POSES */
    const double *times;     /**< PATH: count >= 2, strictly increasing; borrowed */
    const ovoid_pose *poses; /**< PATH: count; borrowed */
    size_t count;
} ovoid_motion;

/** A body that stands still. */
OVOID_API ovoid_motion ovoid_motion_make_still(ovoid_pose pose);
/** Constant velocities, turning about the origin of the body's local frame. */
OVOID_API ovoid_motion ovoid_motion_make_velocity(ovoid_pose start, ovoid_vec3 linear, ovoid_vec3 angular,
                                                  double duration);
/** From one pose to another. */
OVOID_API ovoid_motion ovoid_motion_make_poses(ovoid_pose start, ovoid_pose end, double duration);
/** Through poses at times; both arrays are borrowed. */
OVOID_API ovoid_motion ovoid_motion_make_path(const double *times, const ovoid_pose *poses, size_t count);

/**
 * OVOID_OK, or what is wrong with a motion: NOT_FINITE, ROTATION, RANGE (a position above OVOID_LENGTH_MAX anywhere, a
 * time above 1e100, more than 1e9 radians in a piece), ARGUMENT (kind, duration, times that do not increase, fewer than
 * two), with a sentence in *error (may be NULL); place: of a path, the pose.
 */
OVOID_API ovoid_code ovoid_motion_validate(const ovoid_motion *motion, ovoid_error *error);

/**
 * The pose at a time, rounded; before and after its times a motion rests. It differs from the exact motion by at most
 * 16 u of the distance travelled, 4 u of the starting position, 160 u of the pivot and, in the rotation, 160 u + 16 u
 * of the angle turned, u = 2^-53; docs/motion.md derives this. The motion must be valid (ovoid_motion_validate).
 */
OVOID_API ovoid_pose ovoid_motion_compute_pose(const ovoid_motion *motion, double time);

/** A shape that moves. The shape and a path's arrays are borrowed. */
typedef struct ovoid_moving_shape {
    const ovoid_shape *shape;
    ovoid_motion motion;
    ovoid_pose part; /**< all zero: none. Else the shape is fixed to the moving frame, as a part of a compound: its pose
                        is ovoid_pose_compute_product of the motion's pose and this one */
} ovoid_moving_shape;

/** The shape's pose at a time, rounded: that of the motion, times `part`. */
OVOID_API ovoid_pose ovoid_moving_shape_compute_pose(const ovoid_moving_shape *moving, double time);

/**
 * A box that holds the body at all times of [begin, end], rounding included. It is exact to rounding if the body does
 * not turn; wider by at most a 32nd of the width of the body if it turns by less than 4 radians; and the box of all
 * rotated positions if it turns by more. NaN if there is no shape, the motion is invalid or begin > end. Cost: some
 * supports a piece.
 */
OVOID_API ovoid_box ovoid_moving_shape_compute_box(const ovoid_moving_shape *moving, double begin, double end);

/** Two shapes that move. */
typedef struct ovoid_moving_pair {
    ovoid_moving_shape a, b;
    double
        margin; /**< >= 0: the distance at which they meet (ovoid_impact_find); ovoid_approach_find does not use it */
} ovoid_moving_pair;

/** What a query about two moving bodies proves. */
typedef enum ovoid_impact_status {
    OVOID_IMPACT_UNDECIDED = 0, /**< neither an impact nor its absence is proven; `limit` says why */
    OVOID_IMPACT_FREE,          /**< never within the margin, proven */
    OVOID_IMPACT_HIT            /**< within the margin at hit_at, proven */
} ovoid_impact_status;

/** The motion that a step's direction turns with. */
typedef enum ovoid_step_frame {
    OVOID_STEP_WORLD = 0, /**< none: the direction is fixed in the world */
    OVOID_STEP_A = 1,     /**< the motion of A */
    OVOID_STEP_B = 2      /**< the motion of B */
} ovoid_step_frame;

/**
 * A step of the proof that two bodies stay apart. From the step before (for the first, from `begin`) until `until`
 * their gap along a direction is above the level. The direction is `normal` (world, unit) at the step's beginning and
 * turns with `frame`. Over a step, with s from 0 to 1, the gap is at least (1 - s) g(0) + s g(1) - s (1 - s) K, where K
 * depends only on the angles turned and the lengths (docs/motion.md).
 */
typedef struct ovoid_step {
    double until;
    ovoid_vec3 normal;
    ovoid_step_frame frame;
} ovoid_step;

/**
 * A group of steps, for compounds: the next `count` steps hold for each part of a at [first_a, end_a) of its tree's
 * order against each part of b at [first_b, end_b): by their own gap for two single parts, else by the gap of the balls
 * around the parts. If the interval is a single time, each group has one step, which ends where it begins.
 */
typedef struct ovoid_step_group {
    uint32_t first_a, end_a, first_b, end_b;
    size_t count;
} ovoid_step_group;

/** Options of queries about motions; all zero, or NULL, is the default. */
typedef struct ovoid_motion_options {
    double begin, end; /**< the times queried, which both motions must have; both 0: from the later begin to the earlier
                          end of the motions, from 0 to 0 if both stand still */
    double tolerance;  /**< impact: of hit_at - free_until, relative to end - begin; 0 means 1e-9, for casts 1e-12.
                          approach: of upper - lower, relative to the pair's size; 0 means 1e-6 */
    uint32_t iterations;        /**< most steps and queries; 0 means 10 000 */
    const ovoid_options *query; /**< for the queries at single times; NULL: the default */
    ovoid_step *steps;          /**< receives the proof's steps, up to capacity; NULL: no steps are written */
    size_t capacity;
    ovoid_step_group *groups; /**< compounds only: receives the steps' groups, up to group_capacity; NULL: the steps are
                                 those of the deciding pair of parts alone */
    size_t group_capacity;
} ovoid_motion_options;

/** When two moving bodies come within a margin of each other. */
typedef struct ovoid_impact {
    ovoid_impact_status status;
    ovoid_limit limit;   /**< SHAPE_A, SHAPE_B: there is no shape; POSE_A, POSE_B: that motion is refused
                            (ovoid_motion_validate says why); OPTIONS: margin, times or options are refused; ITERATIONS;
                            PRECISION: the gap stays so near the margin that doubles cannot decide */
    uint32_t iterations; /**< queries at single times */
    double begin, end;   /**< the times queried */
    double free_until;   /**< proven: farther apart than the margin at all times from begin to before this one */
    double hit_at; /**< proven: within the margin at that time; infinity if none is proven. So the true time of impact
                      is in [free_until, hit_at] */
    size_t step_count;      /**< steps that prove free_until; if more than the capacity, the others were not written */
    ovoid_answer free, hit; /**< the answers for the poses (ovoid_moving_shape_compute_pose) at free_until and at
                               hit_at; if UNDECIDED, `hit` is the answer of the last query */
} ovoid_impact;

/**
 * When do two moving bodies first come within the margin of each other? Conservative advancement: B. Mirtich,
 * Impulse-based dynamic simulation of rigid body systems, 1996; X. Zhang, M. Lee, Y. J. Kim, Interactive continuous
 * collision detection for non-convex polyhedra, 2006; here with a bound of second order along one normal. If they are
 * within the margin at the beginning, hit_at = begin. Cost: a distance query and some supports a step, two to twenty
 * steps for most motions.
 */
OVOID_API ovoid_impact ovoid_impact_find(const ovoid_moving_pair *pair, const ovoid_motion_options *options);

/** What an impact or an approach is verified with, beside the answer itself. */
typedef struct ovoid_motion_basis {
    const ovoid_motion_options *options; /**< those of the query; NULL: the default, at the answer's own times */
    const ovoid_step *steps;             /**< all step_count of them */
    const ovoid_step_group *groups;      /**< of ovoid_body_impact_find: all group_count of them */
} ovoid_motion_basis;

/**
 * Verifies an impact without any search: its times are those asked for, each step's gap is above the margin from its
 * beginning to its end, the steps reach free_until, the bodies are within the margin at hit_at, the status follows, and
 * a refusal is right and claims nothing. Not checked, since they claim nothing: iterations; the limit of a query that
 * is not refused; `hit` if there is none. basis: NULL if there are no steps. OVOID_OK, or PROOF with a sentence in
 * *error (may be NULL); place: the step.
 */
OVOID_API ovoid_code ovoid_impact_verify(const ovoid_moving_pair *pair, const ovoid_impact *impact,
                                         const ovoid_motion_basis *basis, ovoid_error *error);

/**
 * The first time at which B, moved along `displacement` (time 0: its pose, 1: the whole displacement), is within margin
 * of A, which stands still; neither rotates. G. van den Bergen, Ray casting against general convex objects with
 * application to continuous collision detection, 2004. The bracket of the time is narrowed to rounding.
 */
OVOID_API ovoid_impact ovoid_shape_cast(const ovoid_pair *pair, ovoid_vec3 displacement, double margin,
                                        const ovoid_motion_options *options);

/** A ray of finite or infinite length; a moving ball if radius > 0. */
typedef struct ovoid_ray {
    ovoid_vec3 origin, direction; /**< world; the direction has any length but zero */
    double length;                /**< of t, in lengths of `direction`; may be infinity */
    double radius;                /**< >= 0: of the ball that moves along the ray */
} ovoid_ray;

/** Where a ray meets a body. */
typedef struct ovoid_ray_hit {
    ovoid_impact_status status;
    ovoid_limit limit;
    uint32_t iterations;
    double lower, upper; /**< bracket of the first t at which origin + t direction is in the body, its radius included;
                            lower = upper = 0 if the ray begins inside; for a miss, the length and infinity */
    ovoid_vec3 point;    /**< the body's point that is hit (its closest point if the ray begins outside) */
    ovoid_vec3 normal;   /**< unit, out of the body */
} ovoid_ray_hit;

/**
 * Where a ray first hits a body. A body without an inside (a flat polygon or a segment, without a radius) meets a ray
 * without a radius in one point at most, which no arithmetic of rounded numbers can prove: UNDECIDED, with lower at
 * that point. Give the ray a radius. Refused: SHAPE_B, POSE_B (the body's), OPTIONS (the ray: NaN, infinity, lengths
 * above OVOID_LENGTH_MAX, a direction of zero).
 */
OVOID_API ovoid_ray_hit ovoid_shape_cast_ray(const ovoid_posed_shape *body, const ovoid_ray *ray);

/** The smallest distance of two moving bodies. */
typedef struct ovoid_approach {
    ovoid_status status; /**< SEPARATED: lower > 0; OVERLAPPING: they overlap at `time`, upper < 0; TOUCHING: the
                            bracket is around 0 and as narrow as the tolerance */
    ovoid_limit limit;
    uint32_t iterations;
    double begin, end;
    double lower, upper; /**< bracket of the smallest signed distance over [begin, end]; an overlap ends the search */
    double time;         /**< the distance at this time is at most upper */
    size_t step_count;
    ovoid_answer answer; /**< for the poses at that time */
} ovoid_approach;

/**
 * The smallest distance of two moving bodies over an interval, and when. The steps are as in ovoid_impact_find, above a
 * level that follows the smallest distance found. Cost: some tens of queries for a turn or less, in proportion to the
 * number of turns if a body spins.
 */
OVOID_API ovoid_approach ovoid_approach_find(const ovoid_moving_pair *pair, const ovoid_motion_options *options);

/**
 * Verifies an approach without any search: the steps prove lower over all of [begin, end], the answer proves upper, and
 * the status follows, TOUCHING within the options' tolerance. Arguments and errors as in ovoid_impact_verify.
 */
OVOID_API ovoid_code ovoid_approach_verify(const ovoid_moving_pair *pair, const ovoid_approach *approach,
                                           const ovoid_motion_basis *basis, ovoid_error *error);

/** The name of a status in results, for example "hit"; never NULL. */
OVOID_API const char *ovoid_impact_status_get_name(ovoid_impact_status status);

#ifdef __cplusplus
}
#endif
#endif
