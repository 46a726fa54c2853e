// The active-set method for nonnegative least squares. C. L. Lawson and R. J. Hanson, Solving Least Squares Problems,
// 1974, chapter 23: the minimum without signs on the present unknowns, or as much of the way to it as keeps all of them
// nonnegative; then those at zero leave. The caller decides which unknowns enter. A row of the Gram matrix's factor
// depends on the rows before it alone, so only the rows of new unknowns, and those behind one that left, are computed.
// Nothing is trusted: the callers prove what they make of it.
#include "ellipsoid/qp.h"

#include <math.h>

// A pivot below this share of its diagonal entry belongs to a row that the earlier ones span.
#define QP_DEPENDENT 1e-13
// Added to the diagonal, relative to it. Along a dependence of the rows the minimum is then far away in the direction
// of growth, and one of the unknowns reaches zero on the way, as it should.
#define QP_RIDGE 1e-11

void qp_clear(qp *q) { q->count = q->factored = 0; }

void qp_add(qp *q, double x) {
    int last = q->count++;
    q->x[last] = x;
    for (int j = 0; j <= last; j++) {
        double sum = 0;
        for (int k = 0; k < QP_WIDTH; k++) sum += q->row[last][k] * q->row[j][k];
        q->gram[last][j] = q->gram[j][last] = sum;
    }
}

int qp_has(const qp *q, uint32_t item) {
    for (int i = 0; i < q->count; i++)
        if (q->item[i] == item) return 1;
    return 0;
}

// The last unknown takes the place of unknown i.
static void drop(qp *q, int i) {
    int last = --q->count;
    if (q->factored > i) q->factored = i;
    if (i == last) return;
    q->item[i] = q->item[last];
    q->c[i] = q->c[last];
    q->x[i] = q->x[last];
    for (int k = 0; k < QP_WIDTH; k++) q->row[i][k] = q->row[last][k];
    for (int j = 0; j < last; j++)
        if (j != i) q->gram[i][j] = q->gram[j][i] = q->gram[last][j];
    q->gram[i][i] = q->gram[last][last];
}

// Completes the Cholesky factor of the Gram matrix with its ridge. Returns -1, or the first unknown whose row the
// earlier ones span.
static int complete_factor(qp *q) {
    for (; q->factored < q->count; q->factored++) {
        int i = q->factored;
        double *row = q->factor[i], d = q->gram[i][i] * (1 + QP_RIDGE);
        for (int j = 0; j < i; j++) {
            double s = q->gram[i][j];
            for (int k = 0; k < j; k++) s -= row[k] * q->factor[j][k];
            row[j] = s * q->inverse[j];
        }
        for (int k = 0; k < i; k++) d -= row[k] * row[k];
        if (!(d > QP_DEPENDENT * q->gram[i][i])) return i;
        q->inverse[i] = 1 / sqrt(d);
    }
    return -1;
}

// x = (L L')^-1 c
static void solve(const qp *q, const double *c, double *x) {
    for (int j = 0; j < q->count; j++) {
        double s = c[j];
        for (int k = 0; k < j; k++) s -= q->factor[j][k] * x[k];
        x[j] = s * q->inverse[j];
    }
    for (int i = q->count - 1; i >= 0; i--) {
        double s = x[i];
        for (int k = i + 1; k < q->count; k++) s -= q->factor[k][i] * x[k];
        x[i] = s * q->inverse[i];
    }
}

// The rest of the equations without the ridge, solved with it.
void qp_refine(qp *q) {
    double rest[QP_SIZE] = {0}, more[QP_SIZE];
    for (int i = 0; i < q->count; i++) {
        rest[i] = q->c[i];
        for (int j = 0; j < q->count; j++) rest[i] -= q->gram[i][j] * q->x[j];
    }
    solve(q, rest, more);
    for (int i = 0; i < q->count; i++)
        if (!(q->x[i] + more[i] > 0)) return;
    for (int i = 0; i < q->count; i++) q->x[i] += more[i];
}

void qp_settle(qp *q) {
    double goal[QP_SIZE];
    // Each round but the last drops an unknown.
    while (q->count > 0) {
        int gone = complete_factor(q);
        double part = 1;
        if (gone < 0) {
            solve(q, q->c, goal);
            for (int i = 0; i < q->count; i++)
                if (goal[i] <= 0 && part * (q->x[i] - goal[i]) >= q->x[i])
                    part = q->x[i] / (q->x[i] - goal[i]), gone = i;
            for (int i = 0; i < q->count; i++) q->x[i] += part * (goal[i] - q->x[i]);
            if (gone < 0) return;
        }
        drop(q, gone);
    }
}
