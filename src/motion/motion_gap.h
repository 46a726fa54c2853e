// The gap of two moving bodies along one direction of the world, at a time and over an interval of times.
//
// Theorem. Let g(t) be the gap along the fixed unit n: the least n.x of B minus the largest of A, minus the radii and
// what the allowances add to them. (What stands out across the axis of an allowance turns with the body: it is a part
// of the body's support, H below, and r counts it.) In an interval in which both bodies move in one piece, with s from
// 0 to 1 over it,
//     g(s) >= (1 - s) g(0) + s g(1) - s (1 - s) K,    K = sum over A and B of phi^2 |n x axis| r / 2,
// phi the angle that the body turns in the interval and r the largest distance of its vertices from its axis. For the
// support of a body is n.c(s) + H(m(s)): c, its pivot, is linear in s; m = R(s)'n, n as the body sees it, is a curve
// with |m''| <= phi^2 |n x axis|, across the axis, so it leaves its chord by at most s (1 - s) / 2 of that; and H, the
// support function of the vertices about the pivot, is convex, so it is at most linear along the chord, and at most r
// times what m leaves it by. Where the angle is large, H may be replaced by that of the cylinder about the axis:
// constant, K = 0.
//
// The direction may instead turn with one of the bodies, X, say: n' = w x n, w the angular velocity of X. Then X's m is
// constant, and with the other body's angular velocity v and the pivots' difference c, per unit of time,
//     |m''| <= |w - v|^2 + |w x v| for the other body (w^2 |n x axis| where it does not turn),
//     |(n.c)''| <= (w^2 |c| + 2 w |c'|) |n x axis|,
// each half of it, times the square of the time (and the other body's reach), a part of K. A face that turns toward
// another body needs this: along a fixed normal the gap falls faster than the distance, and steps converge linearly.
//
// Directional motion bounds are those of X. Zhang, M. Lee, Y. J. Kim (Interactive continuous collision detection for
// non-convex polyhedra, 2006); the first order is measured here instead of bounded.
#ifndef OVOID_MOTION_MOTION_GAP_H
#define OVOID_MOTION_MOTION_GAP_H

#include "motion/motion.h"

/// A pair of bodies, each in a piece of its motion.
typedef struct motion_pair {
    motion_body a, b;
    double begin, end; ///< the times that both pieces have in common
} motion_pair;

/// The pieces at a time. OVOID_LIMIT_NONE, or POSE_A, POSE_B where the pose of a part is invalid.
ovoid_limit motion_pair_make(const ovoid_moving_shape *a, const ovoid_moving_shape *b, double time, motion_pair *pair);

/// The pair at a time, by computed poses; returns the sum of the bodies' errors there, length.
double motion_pair_find_pair(const motion_pair *m, double time, ovoid_pair *at);

/// The gap at one time.
typedef struct motion_gap {
    double time;
    vec3 normal;
    double base;          ///< n.(origin of B - origin of A) - radii
    double support[2][2]; ///< of A along n, of B along -n, from the origins: of the body, of its cylinder
    double error;         ///< of base and supports, errors of the poses included
    double speed[2][2];   ///< how fast each support grows: only a guess for the length of steps
    vec3 apart;           ///< support vertex of B minus that of A, world; only a guess, too
    double size;          ///< of the pair
} motion_gap;
/// The gap along n, nearly unit. base is -infinity where a pose is refused: then nothing is proven.
void motion_gap_find(const motion_pair *p, double time, vec3 n, motion_gap *g);

/// The gap of the bodies themselves, from below.
static inline double motion_gap_get_lower(const motion_gap *g) {
    return ((g->base - g->support[0][0]) - g->support[1][0]) - g->error;
}

/// The direction n of a step's beginning, turned to a later time; *error: of the direction.
vec3 motion_pair_turn_normal(const motion_pair *p, ovoid_step_frame frame, double from, double to, vec3 n,
                             double *error);

/// The gap at the end of a step that begins with `from`.
void motion_gap_find_end(const motion_pair *p, const motion_gap *from, ovoid_step_frame frame, double until,
                         motion_gap *to);

/// The least gap over all times between the two gaps of a step, from below, by the theorem above: where the direction
/// is fixed, the better of body and cylinder for each.
double motion_gap_compute_lower(const motion_pair *p, ovoid_step_frame frame, const motion_gap *from,
                                const motion_gap *to);

/// A guess at the time until which the gap stays above the level; g->time where nothing turns with that frame.
double motion_gap_guess_reach(const motion_pair *p, ovoid_step_frame frame, const motion_gap *g, double level);

#endif
