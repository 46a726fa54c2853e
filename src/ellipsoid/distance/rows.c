// Householder's QR factorisation with column and row interchanges. M. J. D. Powell and J. K. Reid, On applying
// Householder transformations to linear least squares problems, 1969; N. J. Higham, Accuracy and Stability of Numerical
// Algorithms, 2002, section 20.3: with these interchanges the error of each row is small against that row.
#include "ellipsoid/distance/rows.h"

#include <math.h>

static void swap(double *a, double *b) {
    double t = *a;
    *a = *b;
    *b = t;
}

/// Moves the longest remaining column to column k; returns its squared length.
static double pivot_column(double m[ROWS_COUNT][ROWS_WIDTH], int count, int k, int *column) {
    double longest = -1;
    int best = k;
    for (int j = k; j < count; j++) {
        double sum = 0;
        for (int i = k; i < ROWS_COUNT; i++) sum += m[i][j] * m[i][j];
        if (sum > longest) {
            longest = sum;
            best = j;
        }
    }
    for (int i = 0; i < ROWS_COUNT; i++) swap(&m[i][k], &m[i][best]);
    int t = column[k];
    column[k] = column[best];
    column[best] = t;
    return longest;
}

/// Moves the row with the largest entry in column k to row k.
static void pivot_row(double m[ROWS_COUNT][ROWS_WIDTH], int count, int k) {
    int best = k;
    for (int i = k + 1; i < ROWS_COUNT; i++)
        if (fabs(m[i][k]) > fabs(m[best][k])) best = i;
    for (int j = 0; j <= count; j++) swap(&m[k][j], &m[best][j]);
}

void rows_factor_make(double m[ROWS_COUNT][ROWS_WIDTH], int count, rows_factor *f) {
    f->count = count;
    for (int j = 0; j < count; j++) f->column[j] = j;
    for (int k = 0; k < count; k++) {
        double square = pivot_column(m, count, k, f->column);
        pivot_row(m, count, k);
        // Reflect column k onto its first entry, and the others along.
        double norm = -copysign(sqrt(square), m[k][k]), head = m[k][k] - norm, scale = 1 / (norm * head);
        m[k][k] = norm;
        for (int j = k + 1; j <= count; j++) {
            double sum = head * m[k][j];
            for (int i = k + 1; i < ROWS_COUNT; i++) sum += m[i][k] * m[i][j];
            sum *= scale;
            m[k][j] += sum * head;
            for (int i = k + 1; i < ROWS_COUNT; i++) m[i][j] += sum * m[i][k];
        }
    }
    for (int i = 0; i < count; i++) {
        for (int j = i; j < count; j++) f->r[i][j] = m[i][j];
        f->right[i] = m[i][count];
    }
}

void rows_solve(const rows_factor *f, double *x) {
    for (int i = f->count - 1; i >= 0; i--) {
        double sum = f->right[i];
        for (int j = i + 1; j < f->count; j++) sum -= f->r[i][j] * x[f->column[j]];
        x[f->column[i]] = sum / f->r[i][i];
    }
}

void rows_solve_transposed(const rows_factor *f, const double *b, double *y) {
    for (int i = 0; i < f->count; i++) {
        double sum = b[f->column[i]];
        for (int j = 0; j < i; j++) sum -= f->r[j][i] * y[j];
        y[i] = sum / f->r[i][i];
    }
}
