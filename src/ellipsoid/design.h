// Weights on points whose weighted covariance has the largest determinant: the D-optimal design, which is the dual of
// the smallest enclosing ellipsoid. L. Khachiyan, Rounding of polytopes in the real number model of computation, 1996.
#ifndef OVOID_ELLIPSOID_DESIGN_H
#define OVOID_ELLIPSOID_DESIGN_H

#include "linear/mat3.h"
#include "ovoid/ellipsoid.h"

/// Orthonormal axes and a box along them that contain the points: y = (axes (x - origin)) / half lies in about [-1,
/// 1]^3, and the points fill a fair part of it, however thin they are.
typedef struct frame {
    uint32_t rank;
    vec3 origin, half;   ///< half: half lengths of the box; beyond the rank that of the first axis
    mat3 axes;           ///< rows
    uint32_t extreme[6]; ///< the two extreme points of each coordinate, 2 rank of them
} frame;

/// The frame of the vertices, at least two of them; rank 1 to 3.
frame frame_compute(const ovoid_polytope *polytope, uint32_t rank);
/// The coordinates y of x; those beyond the rank are 0.
vec3 frame_compute_local(const frame *f, vec3 x);

/// The largest number of points that carry weight at a time.
#define DESIGN_SUPPORT 256

typedef struct design {
    const ovoid_ellipsoid *near; ///< an ellipsoid near the smallest enclosing one, from which to start; NULL: none
    uint32_t rank;
    double *local;       ///< 3 coordinates a point, in the frame
    uint32_t *candidate; ///< points that may still carry weight at the optimum
    uint32_t candidate_count;
    uint32_t count;                  ///< points that carry weight
    uint32_t point[DESIGN_SUPPORT];  ///< the points with weight, by index
    double weight[DESIGN_SUPPORT];   ///< their weights, of sum 1 to rounding
    double variance[DESIGN_SUPPORT]; ///< of the last evaluation
    vec3 mean;                       ///< weighted, in the frame
    sym3 inverse;                    ///< of the weighted covariance, with ones on the diagonal beyond the rank
    double excess;                   ///< largest variance of a candidate, over rank + 1, less 1
    uint32_t steps;                  ///< exchanges of weight
} design;

/// Starts with equal weights on the frame's extreme points and on the vertices farthest out in the metric of `near`,
/// and moves weight until d->excess is at most `excess`, or there is no progress. The caller sets near, candidate and
/// local (room for one and three numbers a vertex).
void design_solve(design *d, const frame *f, const ovoid_polytope *polytope, double excess);

#endif
