// The active-set method for nonnegative least squares. C. L. Lawson and R. J. Hanson, Solving Least Squares Problems,
// 1974, chapter 23: the minimum without signs on the present unknowns, or as much of the way to it as keeps all of them
// nonnegative; then those at zero leave. The caller decides which unknowns enter. A row of the Gram matrix's factor
// depends on the rows before it alone, so only the rows of new unknowns, and those behind one that left, are computed.
// Nothing is trusted: the callers prove what they make of it.
#include "ellipsoid/qp.h"

#include "linear/both.h"

// A pivot below this share of its diagonal entry belongs to a row that the earlier ones span.
#define QP_DEPENDENT 1e-13
// Added to the diagonal, relative to it. Along a dependence of the rows the minimum is then far away in the direction
// of growth, and one of the unknowns reaches zero on the way, as it should.
#define QP_RIDGE 1e-11

// The inner product of at least `count` entries, an even number of them: even and odd ones are summed in two lanes.
static double compute_dot(const double *a, const double *b, int count) {
    both sum = {0, 0};
    for (int k = 0; k < count; k += 2) sum += both_load(a + k) * both_load(b + k);
    return sum[0] + sum[1];
}

void qp_clear(qp *q) {
    q->count = q->factored = 0;
    memset(q->column, 0, sizeof q->column);
}

void qp_add(qp *q, double x) {
    int last = q->count++;
    q->x[last] = x;
    for (int j = 0; j <= last; j++) q->gram[last][j] = compute_dot(q->row[last], q->row[j], QP_WIDTH);
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
    for (int j = 0; j < i; j++) q->gram[i][j] = q->gram[last][j];
    for (int j = i + 1; j < last; j++) q->gram[j][i] = q->gram[last][j];
    q->gram[i][i] = q->gram[last][last];
}

// Completes the factors L D L' of the Gram matrix with its ridge, and L^-1 c. Returns -1, or the first unknown whose
// row the earlier ones span. As soon as an entry of a row is known, its part is taken from all that follow, two at a
// time: the chain of steps that wait for each other is then one product and one difference an entry.
static int complete_factor(qp *q) {
    for (; q->factored < q->count; q->factored++) {
        int i = q->factored;
        double rest[QP_SIZE], *row = q->factor[i], d = q->gram[i][i] * (1 + QP_RIDGE), half = q->c[i];
        // Rows and columns are read two entries at a time, from or up to their diagonal.
        row[i] = q->column[i][i] = 0;
        for (int k = 0; k < i; k += 2) both_store(rest + k, both_load(q->gram[i] + k));
        for (int j = 0; j < i; j++) {
            double value = rest[j], *column = q->column[j];
            for (int k = (j + 1) & ~1; k < i; k += 2)
                both_store(rest + k, both_load(rest + k) - both_load(column + k) * both_set(value));
            row[j] = column[i] = value * q->inverse[j];
            d -= value * row[j];
            half -= row[j] * q->half[j];
        }
        if (!(d > QP_DEPENDENT * q->gram[i][i])) return i;
        q->inverse[i] = 1 / d;
        q->half[i] = half;
    }
    return -1;
}

// x = L'^-1 D^-1 x
static void solve_upper(const qp *q, double *x) {
    for (int i = 0; i < q->count; i++) x[i] *= q->inverse[i];
    for (int i = q->count - 1; i > 0; i--) {
        both value = both_set(x[i]);
        for (int k = 0; k < i; k += 2) both_store(x + k, both_load(x + k) - both_load(q->factor[i] + k) * value);
    }
}

// The rest of the equations without the ridge, solved with it.
void qp_refine(qp *q) {
    double more[QP_SIZE] = {0};
    for (int i = 0; i < q->count; i++) {
        double rest = q->c[i];
        for (int j = 0; j < q->count; j++) rest -= (i > j ? q->gram[i][j] : q->gram[j][i]) * q->x[j];
        more[i] = rest - compute_dot(q->factor[i], more, i);
    }
    solve_upper(q, more);
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
            for (int i = 0; i < QP_SIZE; i++) goal[i] = i < q->count ? q->half[i] : 0;
            solve_upper(q, goal);
            for (int i = 0; i < q->count; i++)
                if (goal[i] <= 0 && part * (q->x[i] - goal[i]) >= q->x[i])
                    part = q->x[i] / (q->x[i] - goal[i]), gone = i;
            for (int i = 0; i < q->count; i++) q->x[i] += part * (goal[i] - q->x[i]);
            if (gone < 0) return;
        }
        drop(q, gone);
    }
}
