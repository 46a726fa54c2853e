// Motions over eight intervals of a segment side by side, each a lane: frames' and points' rates in the middles, and
// what balls that move so may meet. Time runs from -1 to 1 over an interval. docs/robot-path.md has the mathematics.
#ifndef OVOID_SIMD_ROBOT_COVER8_H
#define OVOID_SIMD_ROBOT_COVER8_H

#include "linear/mat3.h"

enum { COVER8 = 8 };

/// How fast the own values of a step go, in each lane, and whether its child moves in the world in any.
typedef struct step_rate8 {
    _Alignas(64) double length[3][COVER8];
    double turn[COVER8];
    int is_moving;
} step_rate8;

/// A frame's rates in the world: velocity and acceleration of its origin, angular velocity and acceleration, and the
/// matrix B of a point's acceleration: B r for the point r from the origin, acceleration of the origin aside.
enum {
    RATE8_VELOCITY = 0,
    RATE8_ACCELERATION = 3,
    RATE8_TURN = 6,
    RATE8_BEND = 9,
    RATE8_MATRIX = 12,
    RATE8_COLUMNS = 21
};
typedef struct rate8 {
    _Alignas(64) double column[RATE8_COLUMNS][COVER8];
} rate8;

/// A point: its place, its velocity, and a quarter of its acceleration, all in the world.
enum { MOTION8_PLACE = 0, MOTION8_VELOCITY = 3, MOTION8_QUARTER = 6, MOTION8_COLUMNS = 9 };
typedef struct motion8 {
    _Alignas(64) double column[MOTION8_COLUMNS][COVER8];
} motion8;

/// A box whose axes are those of its group: centre and half sizes along them, what the body stands out of it, and what
/// rounding may do.
typedef struct cover_box {
    double center[3], half[3], radius;
} cover_box;

/// Boxes along the same axes: the columns of `rotation`.
typedef struct cover_boxes {
    mat3 rotation;
    const cover_box *boxes;
    uint32_t count;
} cover_boxes;

/// A body between parallel planes in its link's frame: along x, y, z; x+y, x-y, x+z, x-z, y+z, y-z; x+y+z, x+y-z,
/// x-y+z, x-y-z; those are not unit, and the numbers are for them as they are. Rounding counted.
enum { SLABS = 13 };
typedef struct body_slabs {
    double middle[SLABS], half[SLABS];
} body_slabs;

/// Eight balls that cover a body, in its frame: centres and radii.
enum { BALLS8_CENTER = 0, BALLS8_RADIUS = 3, BALLS8_COLUMNS = 4 };
typedef struct balls8 {
    _Alignas(64) double column[BALLS8_COLUMNS][COVER8];
} balls8;

/// Where a body's frame is in another body's.
typedef struct body_place {
    mat3 rotation;
    vec3 position;
} body_place;

/// A frame and its rates in eight lanes.
typedef struct moving8 {
    const struct frame8 *frame;
    const rate8 *rate;
} moving8;

/// Vertices of a body that are near each other, xyz, in the frame of its link: all within `radius` of the centre.
typedef struct vertex_cluster {
    const double *vertices;
    uint32_t count;
    vec3 center;
    double radius;
} vertex_cluster;

/// A body whose vertices move; seen from a frame that moves too, in which `normal`, a unit vector, is fixed, and
/// another body reaches no farther along it than `support` from the origin.
typedef struct moving_hull {
    moving8 from, link;
    const vertex_cluster *clusters;
    uint32_t count;
    vec3 center; ///< all vertices are within `radius` of it
    double radius;
    vec3 normal;
    double support;
} moving_hull;

/// Steps, parents before children, how fast each goes, and the frames that they made.
typedef struct rate_chain {
    const struct chain_step *steps;
    const step_rate8 *rates;
    const struct frame8 *frames;
    uint32_t count;
} rate_chain;

#endif
