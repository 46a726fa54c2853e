// A pair in double-double arithmetic, for cases that doubles cannot decide. Directions are in the world frame, so that
// a proof's direction is measured as it is stated; differences of points are exact to a few E s, E = 2^-102.
//
// With s the pair's size (frame.h), H = 128 E times the distances of the shapes' origins from the frames they are given
// in (since these are rotated; positions do not count, as they differ exactly):
// - a difference x_b - x_a is off by 48 E s + H, a gap along a direction, divided by the direction's length, by 64 E s
//   + H, the distance of two weighted points by 80 E s + H.
// Hence a measurement is off by less than FINE_CHECK s + H, and a claim that is lowered by twice that holds and is
// confirmed by any measurement to within that error. docs/error-analysis.md derives these numbers.
#ifndef OVOID_PAIR_FINE_H
#define OVOID_PAIR_FINE_H

#include "linear/dd3.h"
#include "ovoid/query.h"
#include "shape/rim.h"

#define FINE_CHECK (96 * 0x1p-102)

/// Its lengths are in the unit in which the size is about one.
typedef struct fine_frame {
    const ovoid_shape *a, *b;
    dd33 world_a, world_b;       ///< rotations to the world
    dd3 apart;                   ///< B's body frame's origin minus A's, world
    dd lower_radii, upper_radii; ///< sums of both shapes' (block.h)
    double unit;                 ///< power of two: 1/2 <= size unit < 1
    double check, claim;         ///< what a measurement may be off by; by how much a claim is lowered
} fine_frame;

/// The frame of a pair with valid poses, or 0 if it would resolve little more than doubles do: lengths near
/// OVOID_LENGTH_MIN, or origins so far from the frames in which they are rotated that they hide 2^-60 of the size.
int fine_make(const ovoid_pair *pair, fine_frame *fine);

/// The difference of two vertices, B minus A.
dd3 fine_difference(const fine_frame *f, uint32_t a, uint32_t b);

/// Where A and B are extreme toward each other along n, whose length must be near one. All vertices within the rounding
/// of doubles of the extreme one are compared in double-double, however many.
typedef struct fine_support {
    uint32_t a, b;
    dd gap; ///< min over B of n.x - max over A of n.x, over |n|
} fine_support;
fine_support fine_find_support(const fine_frame *f, dd3 n);

/// Bounds of d, with radii and allowances subtracted, in the world's unit, from a measurement with an error of `error`:
/// `check` or `claim`.
double fine_compute_lower(const fine_frame *f, dd gap, double error);
double fine_compute_upper(const fine_frame *f, dd distance, double error);

/// The distance of the two weighted points of a proof of kind POINTS.
dd fine_measure_points(const fine_frame *f, const ovoid_proof *proof);

/// The upper bound of d by 4 to 6 differences that strictly contain the origin (hull.h), by the signs of their
/// determinants; infinity if that is not proven.
double fine_measure_hull(const fine_frame *f, const dd3 *w, int count, double error);

#endif
