// Least squares with nine rows of three or six unknowns whose rows differ in size by many orders.
#ifndef OVOID_ELLIPSOID_DISTANCE_ROWS_H
#define OVOID_ELLIPSOID_DISTANCE_ROWS_H

enum { ROWS_COUNT = 9, ROWS_WIDTH = 7 };

/// R of a QR factorisation with the columns in the order `column`, and Q' b.
typedef struct rows_factor {
    int count; ///< unknowns
    int column[6];
    double r[6][6];
    double right[6];
} rows_factor;

/// m: nine rows, the right-hand side in column `count` (3 or 6). Overwrites m. No column may be zero.
void rows_factor_make(double m[ROWS_COUNT][ROWS_WIDTH], int count, rows_factor *f);

/// The least squares solution.
void rows_solve(const rows_factor *f, double *x);

/// R'^-1 b, b in the order of the unknowns: |R'^-1 b|^2 = b' (A'A)^-1 b.
void rows_solve_transposed(const rows_factor *f, const double *b, double *y);

#endif
