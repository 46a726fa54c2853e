// The proven factor: Cholesky in double-double on a matrix whose axes were first scaled, by powers of two, to a unit
// diagonal. A. van der Sluis, Condition numbers and equilibration of matrices, 1969, shows that this scaling is nearly
// the best.
#include "ellipsoid/factor.h"

#include "ellipsoid/root.h"

sym3dd sym3dd_from(sym3 s) {
    dd xy = dd_from(s.xy), xz = dd_from(s.xz), yz = dd_from(s.yz);
    return (sym3dd){{{dd_from(s.xx), xy, xz}, {xy, dd_from(s.yy), yz}, {xz, yz, dd_from(s.zz)}}};
}

sym3 sym3dd_truncate(const sym3dd *s) {
    return (sym3){s->m[0][0].high, s->m[0][1].high, s->m[0][2].high, s->m[1][1].high, s->m[1][2].high, s->m[2][2].high};
}

// Half the exponent of a square: 2^-2k x lies in [1/4, 1).
static int half_exponent(double x) {
    int e;
    (void)frexp(x, &e);
    return e >= 0 ? (e + 1) / 2 : -(-e / 2);
}

// a 2^e
static dd dd_ldexp(dd a, int e) { return (dd){ldexp(a.high, e), ldexp(a.low, e)}; }

// Axes of a matrix with a unit of length for each: lengths along axis[i] are divided by 2^exponent[i].
typedef struct scaling {
    int count;
    int axis[3], exponent[3];
} scaling;

// The axes that are not exactly zero, each with the power of two that brings its diagonal entry to [1/4, 1). 0 if the
// diagonal alone shows that the matrix is not positive semidefinite.
static int find_axes(const sym3dd *s, scaling *u) {
    u->count = 0;
    for (int i = 0; i < 3; i++) {
        double top = 0;
        for (int j = 0; j < 3; j++) top = fmax(top, fabs(s->m[i][j].high));
        if (top == 0) continue;
        if (!(s->m[i][i].high > 0) || !isfinite(top)) return 0;
        u->axis[u->count] = i;
        u->exponent[u->count++] = half_exponent(s->m[i][i].high);
    }
    return 1;
}

// The matrix in the scaled axes.
static void take_scaled(const sym3dd *s, const scaling *u, dd a[3][3]) {
    for (int i = 0; i < u->count; i++)
        for (int j = 0; j < u->count; j++)
            a[i][j] = dd_ldexp(s->m[u->axis[i]][u->axis[j]], -u->exponent[i] - u->exponent[j]);
}

// a = l d l' with unit lower triangular l; 0 if a pivot is not above the rounding of double-double.
static int decompose(int count, dd a[3][3], dd l[3][3], dd d[3]) {
    for (int j = 0; j < count; j++) {
        d[j] = a[j][j];
        for (int k = 0; k < j; k++) d[j] = dd_sub(d[j], dd_mul(dd_mul(l[j][k], l[j][k]), d[k]));
        if (!(d[j].high > 0x1p-96)) return 0;
        for (int i = j + 1; i < count; i++) {
            dd x = a[i][j];
            for (int k = 0; k < j; k++) x = dd_sub(x, dd_mul(dd_mul(l[i][k], l[j][k]), d[k]));
            l[i][j] = dd_div(x, d[j]);
        }
    }
    return 1;
}

// W = d^(-1/2) l^-1, rounded to doubles.
static void invert(int count, dd l[3][3], const dd d[3], double w[3][3]) {
    dd inverse[3][3];
    for (int j = 0; j < count; j++)
        for (int i = 0; i < count; i++) {
            inverse[i][j] = dd_from(i == j);
            for (int k = j; k < i; k++) inverse[i][j] = dd_sub(inverse[i][j], dd_mul(l[i][k], inverse[k][j]));
            w[i][j] = i >= j ? inverse[i][j].high / sqrt(d[i].high) : 0;
        }
}

// An upper bound of |W A W' - I| by its largest row sum. Per entry at most 9 products of three doubles, each within
// 2^-101 of itself, and 9 sums, each within 2^-102 of the sum of sizes: 2^-97 of that sum bounds them all. Entries of
// A or products that are subnormal are wrong by 2^-1020 at most: 2^-800 covers them, as no entry of W is above 2^100.
static double compute_defect(int count, dd a[3][3], double w[3][3]) {
    double defect = 0;
    for (int i = 0; i < count; i++) {
        double row = 0;
        for (int j = 0; j < count; j++) {
            dd sum = dd_from(i == j ? -1 : 0);
            double size = 1;
            for (int k = 0; k <= i; k++)
                for (int n = 0; n <= j; n++) {
                    sum = dd_add(sum, dd_mul(two_product(w[i][k], w[j][n]), a[k][n]));
                    size += fabs(w[i][k] * w[j][n] * a[k][n].high);
                }
            row += fabs(sum.high) + 0x1p-97 * size + 0x1p-800;
        }
        defect = fmax(defect, row);
    }
    return defect * (1 + 8 * ROUNDING);
}

// Everything but the defect; the scaled matrix is in a.
static int make_unproven(const sym3dd *s, factor *f, dd a[3][3]) {
    scaling u;
    if (!find_axes(s, &u)) return 0;
    dd l[3][3], d[3];
    take_scaled(s, &u, a);
    if (!decompose(u.count, a, l, d)) return 0;
    invert(u.count, l, d, f->w);
    f->count = u.count;
    for (int i = 0; i < u.count; i++) f->axis[i] = u.axis[i], f->scale[i] = ldexp(1, -u.exponent[i]);
    return 1;
}

int factor_make(sym3 q, factor *f) {
    sym3dd s = sym3dd_from(q);
    dd a[3][3];
    if (!make_unproven(&s, f, a)) return 0;
    f->defect = compute_defect(f->count, a, f->w);
    return f->defect < 0.5;
}

// With a_i = sum_k |W_ik| sqrt(Q_kk), the row sums of |W| |E| |W'| are at most a_i sum_j a_j. An entry of W Q W' - I in
// doubles is on any path rounded 9 times at most: two products and up to three sums, twice, and the 1; each is relative
// to a_i a_j, and 16 roundings cover the bound's own.
int factor_make_quickly(sym3 q, factor *f, double *size) {
    double trace = sym3_trace(q);
    lower3 root;
    if (!(trace > 1e-200 && trace < 1e200) || !lower3_make_root(q, &root)) return 0;
    lower3 w = lower3_inverse(root);
    *f = (factor){.count = 3, .axis = {0, 1, 2}, .scale = {1, 1, 1}};
    f->w[0][0] = w.xx, f->w[1][0] = w.yx, f->w[1][1] = w.yy, f->w[2][0] = w.zx, f->w[2][1] = w.zy, f->w[2][2] = w.zz;
    vec3 row[3], edge = {sqrt(q.xx), sqrt(q.yy), sqrt(q.zz)};
    double a[3], sum = 0;
    for (int i = 0; i < 3; i++) {
        row[i] = (vec3){f->w[i][0], f->w[i][1], f->w[i][2]};
        a[i] = (fabs(row[i].x) * edge.x + fabs(row[i].y) * edge.y) + fabs(row[i].z) * edge.z;
        sum += a[i];
    }
    *size = max2(a[0], max2(a[1], a[2])) * sum;
    for (int i = 0; i < 3; i++) {
        vec3 qw = sym3_mul_vec3(q, row[i]);
        double off = 0;
        for (int j = 0; j < 3; j++) off += fabs(vec3_dot(row[j], qw) - (i == j));
        f->defect = max2(f->defect, off);
    }
    f->defect += 16 * ROUNDING * *size;
    return f->defect < 1e-6;
}

int factor_make_unproven(const sym3dd *s, factor *f) {
    dd a[3][3];
    f->defect = INFINITY;
    return make_unproven(s, f, a);
}

// The content of a solid, by the pivots of the scaled matrix A. Cholesky is exact for a matrix that differs from A,
// whose diagonal is below 1, by 2^-99 an entry, and the entries themselves by 2^-92; the determinant's relative change
// is at most the sum of all that times the trace of A^-1 = W' W. 2^-90 covers it; 2^-49 the roundings at the end.
static double compute_solid_content(const sym3dd *s, double *error) {
    scaling u;
    if (!find_axes(s, &u) || u.count < 3) return 0;
    dd a[3][3], l[3][3], d[3];
    take_scaled(s, &u, a);
    if (!decompose(3, a, l, d)) return 0;
    double product = 1, trace = 0, w[3][3];
    invert(3, l, d, w);
    for (int i = 0; i < 3; i++) {
        product *= ldexp(sqrt(d[i].high), u.exponent[i]);
        for (int j = 0; j <= i; j++) trace += w[i][j] * w[i][j];
    }
    *error = 0x1p-90 * trace + 0x1p-49;
    return product;
}

double sym3dd_compute_content(const sym3dd *s, int rank, double *error) {
    double unused;
    if (!error) error = &unused;
    *error = 0;
    if (rank == 3) return compute_solid_content(s, error);
    // Scaled so that no square overflows.
    double top = fmax(fabs(s->m[0][0].high), fmax(fabs(s->m[1][1].high), fabs(s->m[2][2].high)));
    if (!(top > 0) || !isfinite(top)) return 0;
    int e = half_exponent(top);
    dd sum = dd_from(0), a[3][3];
    take_scaled(s, &(scaling){3, {0, 1, 2}, {e, e, e}}, a);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        dd minor = rank == 1 ? a[i][i] : dd_sub(dd_mul(a[i][i], a[j][j]), dd_mul(a[i][j], a[i][j]));
        sum = dd_add(sum, minor);
    }
    if (!(sum.high > 0)) return 0;
    // Six products of entries below 1.
    *error = 0x1p-88 / sum.high + 0x1p-49;
    return ldexp(sqrt(sum.high), rank * e);
}

double ball_get_measure(int rank) {
    const double pi = 3.14159265358979323846;
    return rank == 3 ? 4 * pi / 3 : rank == 2 ? pi : rank == 1 ? 2 : 0;
}
