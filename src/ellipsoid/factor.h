// A proven factor of an ellipsoid's matrix Q, and its determinant, for Q as ill-conditioned as doubles can store.
//
// Let W be any lower triangular matrix of doubles, I + R = W Q W' and |R| <= defect < 1. Then Q is positive definite
// and Q^-1 = W' (I + R)^-1 W, so that (1 - defect) x' Q^-1 x <= |W x|^2 for every x. W is made from a Cholesky factor
// in double-double, but need not be trusted: the defect is computed from W and Q themselves.
#ifndef OVOID_ELLIPSOID_FACTOR_H
#define OVOID_ELLIPSOID_FACTOR_H

#include "linear/exact.h"
#include "linear/mat3.h"

/// A symmetric matrix in double-double; both halves are stored.
typedef struct sym3dd {
    dd m[3][3];
} sym3dd;

/// The matrix in double-double.
sym3dd sym3dd_from(sym3 s);
/// The doubles nearest to its entries.
sym3 sym3dd_truncate(const sym3dd *s);
/// Doubles near s, chosen together (round.c): the ellipsoid of the result is as near to that of s, in its own metric,
/// as doubles allow, even for a needle or a slab.
sym3 sym3dd_round(const sym3dd *s);

/// The factor, with a unit for every axis: powers of two, so that conversion is exact.
typedef struct factor {
    int count;       ///< axes along which Q is not exactly zero
    int axis[3];     ///< these axes, ascending
    double scale[3]; ///< a length along axis[i] times scale[i] is in units of the factor
    double w[3][3];  ///< W, lower triangular
    double defect;   ///< at least |W Q W' - I|, rounding included
} factor;

/// 1 and the factor, or 0 if Q is not proven positive definite on its nonzero axes.
int factor_make(sym3 q, factor *f);
/// The same in doubles, with all units 1, for matrices of entries between 1e-200 and 1e200 that are not thin: 0 if the
/// ratio of radii is about 1e5 or more. *size: the largest row sum of |W| |E| |W'| over all E with |E_ij| <= sqrt(Q_ii
/// Q_jj), at least 3. An error of k roundings in each entry of Q, relative to that, is at most k u *size in W Q W'.
int factor_make_quickly(sym3 q, factor *f, double *size);
/// The product of the radii, for a factor of three axes in units of 1, to a share of 2 defect and 4 roundings: the
/// determinant of W Q W' is within 1.5 defect of 1, for its root.
static inline double factor_get_content(const factor *f) { return 1 / (f->w[0][0] * f->w[1][1] * f->w[2][2]); }
/// The largest defect of a factor in doubles that stands for one in double-double where digits are wanted.
#define FACTOR_DEFECT_MOST 1e-12
/// A factor of a matrix in double-double, with no defect computed.
int factor_make_unproven(const sym3dd *s, factor *f);

/// The square root of the sum of the principal minors of order `rank` (1 to 3): the product of the radii of a solid, of
/// the two radii of a flat ellipsoid, the radius of a segment. 0 if the sum is not positive. *error (may be NULL)
/// bounds the relative error, for entries with an error of up to 2^-92 of the diagonal.
double sym3dd_compute_content(const sym3dd *s, int rank, double *error);

/// The measure of the unit ball of that dimension: 4/3 pi, pi, 2, 0.
double ball_get_measure(int rank);

#endif
