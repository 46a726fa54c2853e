// Rounding a matrix to doubles without losing its thin axes.
//
// An error of one rounding in an entry of Q changes the thin axis of a slab of aspect a by the factor 1 + 2^-54 a^2,
// far more than the others. The six entries together have room for better: the changes D of Q by whole units in the
// last place are a lattice, and the nearest of its points to the matrix wanted, in the metric |W D W'| of the ellipsoid
// itself, is off by about 2^-53 a^(2/3) for a slab, 2^-53 a^(4/3) for a needle. A reduced basis (A. K. Lenstra, H. W.
// Lenstra, L. Lovasz, Factoring polynomials with rational coefficients, 1982) and the nearest plane (L. Babai, On
// Lovasz' lattice reduction and the nearest lattice point problem, 1986) find a point nearly as near. All in
// double-double, as the six basis vectors of a slab are parallel to 1 / a^2. Nothing is promised: the caller checks the
// result.
#include "ellipsoid/factor.h"

enum { ENTRIES = 6 };
static const int row_of[ENTRIES] = {0, 0, 0, 1, 1, 2}, column_of[ENTRIES] = {0, 1, 2, 1, 2, 2};

typedef struct vector6 {
    dd x[ENTRIES];
} vector6;

typedef struct lattice {
    vector6 b[ENTRIES + 1];          // basis, and the vector to reduce
    int64_t c[ENTRIES + 1][ENTRIES]; // these as multiples of the units; sums may wrap on the way, and end small
    vector6 star[ENTRIES];           // orthogonalised
    dd size[ENTRIES];                // of these, squared
} lattice;

static dd dot(const vector6 *a, const vector6 *b) {
    dd sum = dd_mul(a->x[0], b->x[0]);
    for (int i = 1; i < ENTRIES; i++) sum = dd_add(sum, dd_mul(a->x[i], b->x[i]));
    return sum;
}

static void subtract(vector6 *a, const vector6 *b, dd times) {
    for (int i = 0; i < ENTRIES; i++) a->x[i] = dd_sub(a->x[i], dd_mul(b->x[i], times));
}

// a . b over the size of b; 0 if that is 0.
static dd project(const vector6 *a, const lattice *l, int j) {
    return l->size[j].high > 0 ? dd_div(dot(a, &l->star[j]), l->size[j]) : dd_from(0);
}

// Gram and Schmidt, from row `first` on.
static void orthogonalise(lattice *l, int first) {
    for (int i = first; i < ENTRIES; i++) {
        l->star[i] = l->b[i];
        for (int j = 0; j < i; j++) subtract(&l->star[i], &l->star[j], project(&l->star[i], l, j));
        l->size[i] = dot(&l->star[i], &l->star[i]);
    }
}

// Row k less `times` row j.
static void subtract_row(lattice *l, int k, int j, double times) {
    if (times == 0 || !(fabs(times) < 0x1p62)) return;
    subtract(&l->b[k], &l->b[j], dd_from(times));
    for (int i = 0; i < ENTRIES; i++)
        l->c[k][i] = (int64_t)((uint64_t)l->c[k][i] - (uint64_t)(int64_t)times * (uint64_t)l->c[j][i]);
}

static void swap_rows(lattice *l, int i, int j) {
    vector6 b = l->b[i];
    l->b[i] = l->b[j], l->b[j] = b;
    for (int k = 0; k < ENTRIES; k++) {
        int64_t c = l->c[i][k];
        l->c[i][k] = l->c[j][k], l->c[j][k] = c;
    }
}

static void reduce(lattice *l) {
    orthogonalise(l, 0);
    for (int k = 1, step = 0; k < ENTRIES && step < 1000; step++) {
        for (int j = k - 1; j >= 0; j--) subtract_row(l, k, j, nearbyint(project(&l->b[k], l, j).high));
        double mu = project(&l->b[k], l, k - 1).high;
        if (l->size[k].high >= (0.99 - mu * mu) * l->size[k - 1].high) {
            k++;
            continue;
        }
        swap_rows(l, k, k - 1);
        orthogonalise(l, k - 1);
        k = k > 1 ? k - 1 : 1;
    }
}

// W D W' for D with ones at one entry and its mirror, times the unit, as a vector with the Frobenius norm.
static vector6 compute_image(const factor *f, int entry, double unit) {
    vector6 image;
    int p = row_of[entry], q = column_of[entry];
    for (int k = 0; k < ENTRIES; k++) {
        int i = row_of[k], j = column_of[k];
        dd x = two_product(f->w[i][p], f->w[j][q]);
        if (p != q) x = dd_add(x, two_product(f->w[i][q], f->w[j][p]));
        image.x[k] = dd_mul(x, dd_from(f->scale[p] * f->scale[q] * unit * (i == j ? 1 : sqrt(2))));
    }
    return image;
}

sym3 sym3dd_round(const sym3dd *s) {
    double entry[ENTRIES], unit[ENTRIES];
    for (int k = 0; k < ENTRIES; k++) entry[k] = s->m[row_of[k]][column_of[k]].high;
    sym3 plain = {entry[0], entry[1], entry[2], entry[3], entry[4], entry[5]};
    factor f;
    if (!factor_make_unproven(s, &f) || f.count < 3) return plain;
    // The units, no finer than useful and up to twice as coarse, so that a sum stays representable; and the errors of
    // rounding to them and of plain rounding.
    lattice l = {.c = {{0}}};
    vector6 missed = {{{0, 0}}};
    for (int k = 0; k < ENTRIES; k++) {
        int e, i = row_of[k], j = column_of[k];
        (void)frexp(fmax(fabs(entry[k]), 0x1p-8 * (sqrt(s->m[i][i].high) * sqrt(s->m[j][j].high))), &e);
        unit[k] = ldexp(1, e - 52);
        entry[k] = nearbyint(entry[k] / unit[k]) * unit[k];
        l.b[k] = compute_image(&f, k, unit[k]);
        l.c[k][k] = 1;
        subtract(&missed, &l.b[k], dd_from(-s->m[i][j].low / unit[k]));
        subtract(&l.b[ENTRIES], &l.b[k], dd_from(-dd_sub(s->m[i][j], dd_from(entry[k])).high / unit[k]));
    }
    double before = dot(&missed, &missed).high;
    if (!(before > 0x1p-84)) return plain;
    // The nearest plane: the error is added to the basis as one more row, and reduced.
    reduce(&l);
    for (int k = ENTRIES - 1; k >= 0; k--) subtract_row(&l, ENTRIES, k, nearbyint(project(&l.b[ENTRIES], &l, k).high));
    if (!(dot(&l.b[ENTRIES], &l.b[ENTRIES]).high < before)) return plain;
    for (int k = 0; k < ENTRIES; k++) entry[k] -= (double)l.c[ENTRIES][k] * unit[k];
    return (sym3){entry[0], entry[1], entry[2], entry[3], entry[4], entry[5]};
}
