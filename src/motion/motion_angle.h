// Sine and cosine of an angle, and the angle of a sine and cosine, from IEEE operations alone: libm's differ between
// versions in the last bit, and the answers' bits must not.
//
// W. J. Cody, W. M. Waite, Software manual for the elementary functions, 1980, for the reduction: x = k pi/2 + r, with
// pi/2 as the sum of two doubles and k high formed exactly. The sums lose 3 u, and what the two doubles lack of k pi/2
// is below 2e-33 k. Taylor's polynomials of degree 17 and 16 leave less than 4e-18 for |r| <= pi/4 and are evaluated to
// 2 u. So sine and cosine are off by less than 6 u, u = 2^-53, for 0 <= x <= 1e9; the angle, by two steps of Newton's
// method of third order, by less than 10 u.
#ifndef OVOID_MOTION_MOTION_ANGLE_H
#define OVOID_MOTION_MOTION_ANGLE_H

#include "linear/exact.h"

#define HALF_PI 0x1.921fb54442d18p+0
#define HALF_PI_LOW 0x1.1a62633145c07p-54

typedef struct turn {
    double cosine, sine;
} turn;

/// Sine and cosine of 0 <= x <= 1e9.
static inline turn turn_compute(double x) {
    int64_t quadrant = (int64_t)(x * (1 / HALF_PI) + 0.5);
    double k = (double)quadrant;
    dd whole = two_product(k, HALF_PI);
    double r = ((x - whole.high) - whole.low) - k * HALF_PI_LOW, q = r * r;
    double s = 1.0 / 355687428096000;
    s = 1.0 / 1307674368000 - q * s;
    s = 1.0 / 6227020800 - q * s;
    s = 1.0 / 39916800 - q * s;
    s = 1.0 / 362880 - q * s;
    s = 1.0 / 5040 - q * s;
    s = 1.0 / 120 - q * s;
    s = 1.0 / 6 - q * s;
    s = r - r * (q * s);
    double c = 1.0 / 20922789888000;
    c = 1.0 / 87178291200 - q * c;
    c = 1.0 / 479001600 - q * c;
    c = 1.0 / 3628800 - q * c;
    c = 1.0 / 40320 - q * c;
    c = 1.0 / 720 - q * c;
    c = 1.0 / 24 - q * c;
    c = 0.5 - q * c;
    c = 1 - q * c;
    switch (quadrant & 3) {
    case 0: return (turn){c, s};
    case 1: return (turn){-s, c};
    case 2: return (turn){-c, -s};
    default: return (turn){s, -c};
    }
}

/// The angle in [0, pi / 2] of a cosine and a sine >= 0 whose squares sum to 1 within rounding.
static inline double turn_compute_angle(turn of) {
    double x = min2(of.sine, of.cosine), angle = x + x * x * x * (1.0 / 6 + 0.075 * x * x);
    if (of.sine > of.cosine) angle = HALF_PI - angle;
    for (int round = 0; round < 2; round++) {
        turn at = turn_compute(angle);
        double d = of.sine * at.cosine - of.cosine * at.sine;
        angle += d + d * d * d / 6;
    }
    return angle;
}

#endif
