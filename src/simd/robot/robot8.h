// Kernels of robots: eight states side by side, each a lane. A state in a lane gets the bits that it gets alone
// (robot/model/kinematics.h has the twin of the chain). Compiled into libovoid_robot.
#ifndef OVOID_SIMD_ROBOT_ROBOT8_H
#define OVOID_SIMD_ROBOT_ROBOT8_H

#include "linear/rotation.h"
#include "simd/robot/cover8.h"
#include "simd/support.h"

enum { ROBOT8 = 8 };

/// What a step of the chain does.
typedef enum step_kind { STEP_FIXED, STEP_TURN, STEP_SLIDE, STEP_PLANE, STEP_FREE } step_kind;

/// A joint, or an element that is not where its link is: the frame `child` from the frame `parent`. With o the origin's
/// rotation, a the axis: turn by the quaternion cos o + sin (o a) of half the angle, and moved by origin + along value.
typedef struct chain_step {
    step_kind kind;
    uint32_t parent, child; ///< frames; parent NONE: the world
    uint32_t value;         ///< the first of its values
    ovoid_quat rest;        ///< o, unit
    ovoid_quat turned;      ///< o a
    vec3 origin;            ///< in the parent's frame
    vec3 along[3];          ///< of the lengths among its values, in the parent's frame
    vec3 axis;              ///< that it turns about, unit, in the child's frame
} chain_step;

/// The columns of a frame of eight states: position, quaternion, rotation by rows.
enum { FRAME8_POSITION = 0, FRAME8_QUATERNION = 3, FRAME8_ROTATION = 7, FRAME8_COLUMNS = 16 };
typedef struct frame8 {
    _Alignas(64) double column[FRAME8_COLUMNS][ROBOT8];
} frame8;

/// Eight boxes in the world, each enlarged by a radius: centre, rotation by rows, half sizes, radius; and the radius of
/// a ball around that.
enum { BOX8_CENTER = 0, BOX8_ROTATION = 3, BOX8_HALF = 12, BOX8_RADIUS = 15, BOX8_BALL = 16, BOX8_COLUMNS = 17 };
typedef struct box8 {
    _Alignas(64) double column[BOX8_COLUMNS][ROBOT8];
} box8;

/// 256 u: what rounding may do to a centre and a distance, in parts of the lengths that they are made of.
#define ROBOT8_SLACK 0x1p-45

/// A sphere of eight states: its centre, and its radius with what rounding may do to the centre.
enum { SPHERE8_CENTER = 0, SPHERE8_REACH = 3, SPHERE8_COLUMNS = 4 };
typedef struct sphere8 {
    _Alignas(64) double column[SPHERE8_COLUMNS][ROBOT8];
} sphere8;

/// A box in the frame of a link, of eight states: its axes are the frame's.
typedef struct linked_box8 {
    const frame8 *frame;
    vec3 middle, half;
    double radius;
} linked_box8;

/// Balls that lie in a body, side by side: centres and radii. One of a radius below zero says that the body comes
/// within its size of the centre. Fewer are repeated.
enum { BALLS = 16, BALLS_CENTER = 0, BALLS_RADIUS = 3, BALLS_COLUMNS = 4 };
typedef struct inner_balls {
    _Alignas(64) double column[BALLS_COLUMNS][BALLS];
} inner_balls;

/// A region inside another body, in the world. A ball of radius r at c meets it where |max(|map (c - center)| - half,
/// 0)| is below scale r + offset: a box' map is its rotation, an ellipsoid's one to the unit ball, its half zero.
typedef struct inner_region {
    mat3 map;
    vec3 center, half;
    double scale, offset;
    double condition; ///< a centre that is off by e may change the norm by e times this and the scale
} inner_region;

/// Kernels of one instruction set.
typedef struct robot8_kernels {
    /// All frames, from values[value][lane].
    void (*chain)(const chain_step *steps, uint32_t count, const double (*values)[ROBOT8], frame8 *frames);
    /// A sphere of a frame in the world.
    void (*place)(const frame8 *frame, const double center[3], double reach, sphere8 *sphere);
    /// Cosines and sines of the halves of angles; count: a multiple of 8. What is no angle gets some numbers.
    void (*half_turns)(const double *angles, uint32_t count, double *cosines, double *sines);
    /// One bit for each box that is not proven farther than reach from a point. Reach and radii count what rounding
    /// does to the lengths that point and centres are made of.
    unsigned (*near_boxes)(const box8 *boxes, const double point[3], double reach);
    /// One bit for each state in which a sphere is near a box, for each of the boxes of a mask, as near_boxes has it;
    /// both numbers of `more` are added to the sphere's reach.
    void (*near_boxes8)(const box8 *boxes, unsigned mask, const sphere8 *sphere, const double more[2],
                        unsigned char near[ROBOT8]);
    /// One bit for each state in which two spheres are not proven farther apart than the margin.
    unsigned (*near_spheres)(const sphere8 *a, const sphere8 *b, double margin);
    /// One bit for each state in which two boxes are near each other. robot/cell/oriented_box.h has the scalar twin.
    unsigned (*near_linked_boxes)(const linked_box8 *a, const linked_box8 *b, double margin);
    /// Balls of a frame in the world; their radii lose what rounding does to the centres.
    void (*place_balls)(const mat3 *rotation, const double position[3], const inner_balls *local, inner_balls *world);
    /// How far the balls, each enlarged by `more`, come into the region: the greatest limit^2 - norm^2, by the limit's
    /// sign; above zero: one meets it.
    double (*balls_in_region)(const inner_balls *balls, const inner_region *region, double more);
    /// The greatest (r + s)^2 - distance^2, by the sum's sign, of a ball of the first body and all of the second's, r
    /// and s their radii: of the first ball of which it is above zero, or of all balls that meet `around`.
    double (*balls_in_balls)(const inner_balls *a, const inner_region *around, const inner_balls *b);
    /// The rates of the frames that move, times half of each lane's interval; those of still ones are zero before.
    void (*rates)(const rate_chain *chain, const double half[ROBOT8], rate8 *rates);
    /// The motion of a point of a link, to the second order.
    void (*move)(const moving8 *link, const double center[3], motion8 *motion);
    /// The box around a moving point in all lanes; of numbers only.
    void (*enclose)(const motion8 *motion, double low[3], double high[3]);
    /// For each box one bit for each lane in which a ball around the moving point is not proven to stay away. reach:
    /// its radius, what the point leaves its second order by, and what rounding does to it.
    void (*near_moving)(const cover_boxes *boxes, const motion8 *motion, const double reach[ROBOT8],
                        unsigned char *near);
    /// The same for two balls; reach: both radii, and what both leave.
    unsigned (*near_points)(const motion8 *a, const motion8 *b, const double reach[ROBOT8]);
    /// The same for a point of a body, both seen from the body's frame.
    unsigned (*near_point)(const motion8 *motion, const motion8 *point, const moving8 *body,
                           const double reach[ROBOT8]);
    /// The same for the body between slabs.
    unsigned (*near_slabs)(const motion8 *motion, const moving8 *body, const body_slabs *slabs,
                           const double reach[ROBOT8]);
    /// The same for the vertices of a body along a normal; reach: what both bodies stand out of their vertices.
    unsigned (*near_hull)(const moving_hull *hull, const double reach[ROBOT8]);
    /// 1 where one of eight balls that are at rest is not proven farther than reach from a body between slabs.
    unsigned (*near_resting)(const balls8 *balls, const body_place *place, const body_slabs *slabs, double reach);
} robot8_kernels;

/// The kernels of the widest instruction set of this machine.
const robot8_kernels *robot8_get_kernels(void);
/// The kernels of one instruction set, for tests; NULL where this machine or build lacks them.
const robot8_kernels *robot8_get_kernels_of(simd_isa isa);

#if defined(__x86_64__) && defined(__GNUC__)
extern const robot8_kernels robot8_avx2, robot8_avx512;
#endif

#endif
