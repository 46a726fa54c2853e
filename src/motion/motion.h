// Motions, split into pieces of constant velocity, and bodies that move along them.
//
// A piece is x(t) = from + s travel + exp(s turn [axis]) x0, s = (t - begin) / span, where x0 = inner(x) is a point of
// the body at the piece's begin, seen from the pivot. docs/motion.md derives what rounding does:
// - the rotation of a computed pose is off by (160 + 16 s turn) u in norm, its position by 16 u |s travel| + 4 u of the
//   starting position + 160 u of the pivot, and what the rotation's error does to the pivot's arm;
// - a part adds 16 u to the rotation and 64 u of its position and of the pose's.
// Poses that are given, at a piece's ends, are exact.
#ifndef OVOID_MOTION_MOTION_H
#define OVOID_MOTION_MOTION_H

#include "linear/mat3.h"
#include "ovoid/motion.h"

typedef struct motion_piece {
    double begin, end; ///< times; infinite where the body stands still
    double span;
    int is_still, has_last; ///< has_last: the pose at the end is given
    ovoid_pose first, last;
    ovoid_pose inner; ///< of the body at the begin, relative to the pivot
    vec3 from, travel, axis;
    double turn;       ///< >= 0, in radians, over the whole piece (s from 0 to 1)
    double turn_error; ///< of the vector turn axis, at s = 1
    double fixed;      ///< error of the position at any time, without the arm's share
} motion_piece;

/// ovoid_motion_validate, for the pieces within [begin, end] only.
ovoid_code motion_validate(const ovoid_motion *m, double begin, double end, ovoid_error *error);

/// The first and the last time of a motion; infinite where it stands still.
double motion_get_begin(const ovoid_motion *m);
double motion_get_end(const ovoid_motion *m);

/// The piece at a time, at a knot the later one; a time outside belongs to the first or last piece. The motion must be
/// valid.
void motion_find_piece(const ovoid_motion *m, double time, motion_piece *p);

/// The computed pose at a time of the piece, and its error.
typedef struct motion_place {
    ovoid_pose pose;
    double shift; ///< of the position, length
    double turn;  ///< of the rotation, norm
} motion_place;
void motion_piece_find_place(const motion_piece *p, double time, motion_place *out);

/// ovoid_moving_shape_compute_pose for callers inside a public function.
void moving_find_pose(const ovoid_moving_shape *moving, double time, ovoid_pose *pose);

/// Two shapes that move. Borrowed.
typedef struct moving_shapes {
    const ovoid_moving_shape *a, *b;
} moving_shapes;

/// A shape in a piece of its motion. Lengths are rounded up.
typedef struct motion_body {
    const ovoid_moving_shape *moving;
    motion_piece piece;
    int has_part;
    double radius;          ///< what the body stands out of its vertices in all directions, however it turns
    double across;          ///< and across the axis of its allowance, or as an ellipsoid, which turns with it
    double reach;           ///< no vertex, and nothing across, is farther from the local frame's origin, or the pivot
    vec3 pivot;             ///< from the origin of the shape's body frame, along its axes
    double low, high, wide; ///< a cylinder about the axis through the pivot that holds these
    vec3 axis;              ///< in the shape's axes, at the piece's begin
    double axis_error;      ///< of the unit axis, at most 1
} motion_body;

/// The piece at a time. 0 where the pose of `part` is invalid.
int motion_body_make(const ovoid_moving_shape *moving, double time, motion_body *b);

/// The shape's computed pose; returns the most by which any of its points may be elsewhere in the exact motion.
double motion_body_find_pose(const motion_body *b, double time, ovoid_pose *pose);

#endif
