// Weights on points whose weighted covariance has the largest determinant: the D-optimal design, which is the dual of
// the smallest enclosing ellipsoid. L. Khachiyan, Rounding of polytopes in the real number model of computation, 1996.
#ifndef OVOID_ELLIPSOID_DESIGN_H
#define OVOID_ELLIPSOID_DESIGN_H

#include <stdint.h>

/// The largest number of points that carry weight at a time.
#define DESIGN_SUPPORT 64

typedef struct design {
    uint32_t rank;        ///< 1 to 3; coordinates beyond it are 0
    uint32_t point_count; ///< at least 1
    double *local;        ///< 3 coordinates a point; overwritten
    uint32_t count;       ///< points that carry weight
    uint32_t point[DESIGN_SUPPORT];
    double weight[DESIGN_SUPPORT]; ///< of sum 1 to rounding
    uint32_t steps;                ///< Newton steps
} design;

/// Sets weights for which no point's variance exceeds that of the optimum by more than the share `excess`, or for which
/// there is no more progress; the caller sets rank, points and coordinates. 0, with equal weights on extreme points, if
/// the points are too thin for doubles. Cost: three to five Newton steps on some ten points, and as many passes over
/// all points.
int design_solve(design *d, double excess);

#endif
