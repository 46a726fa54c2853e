// The small quadratic program that both ellipsoids come down to in each of their Newton steps.
#ifndef OVOID_ELLIPSOID_QP_H
#define OVOID_ELLIPSOID_QP_H

#include <stdint.h>

/// The largest number of unknowns, and the entries of their rows.
enum { QP_SIZE = 12, QP_WIDTH = 10 };

/// Minimise 1/2 |sum x_i row_i|^2 - c.x over x >= 0, for the unknowns that may be above zero.
typedef struct qp {
    int count;
    uint32_t item[QP_SIZE]; ///< what the unknown belongs to, for the caller
    double row[QP_SIZE][QP_WIDTH];
    double c[QP_SIZE], x[QP_SIZE];
    double gram[QP_SIZE][QP_SIZE];                     ///< row_i . row_j for j <= i
    int factored;                                      ///< unknowns whose rows of the factor below are there
    double factor[QP_SIZE][QP_SIZE], inverse[QP_SIZE]; ///< L, below its diagonal of ones; of D, its inverse
    double column[QP_SIZE][QP_SIZE];                   ///< L by columns
    double half[QP_SIZE];                              ///< L^-1 c
} qp;

/// A program without unknowns.
void qp_clear(qp *q);

/// Adds the unknown whose item, row and c stand at index q->count, with the value x >= 0.
void qp_add(qp *q, double x);

/// A step of refinement of a settled program, which removes most of the ridge, unless an unknown would leave.
void qp_refine(qp *q);

/// Moves x from a feasible point to the minimum of the unknowns it has; those that reach zero are dropped. Cost: the
/// rows of a Cholesky factor for the unknowns that are new, and for those behind each that is dropped.
void qp_settle(qp *q);

/// 1 if an unknown belongs to that item.
int qp_has(const qp *q, uint32_t item);

#endif
