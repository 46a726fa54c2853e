// The planes of two parallelepipeds' difference: every instruction set against the scalar twin, bit for bit; and the
// twin against the definition in long double: the least of height - error is no more than the depth that 64 corners
// have along any of many directions, and within the error of the height along the exact normal. A sign that is said to
// be known must be that of long double. Tolerance: the error that the kernel itself states, of size 1 a few 1e-15.
#include "simd/box_axes.h"

#include "check.h"

typedef long double real;

static long known, unknown;

static box_axes_query make_query(uint64_t *s) {
    box_axes_query q = {.error = 64 * 0x1p-53 * 12, .doubt = 1e-20};
    int kind = (int)(random_next(s) % 5);
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < BOX_AXES_SEGMENTS; i++) q.segment[k][i] = random_uniform(s, -1, 1);
        q.center[k] = 0.3 * random_uniform(s, -1, 1);
    }
    // Boxes of common axes; two edges that are nearly parallel; a slab; three edges of a plane.
    double tilt = kind == 2 ? pow(10, random_uniform(s, -17, -1)) : 0;
    for (int k = 0; k < 3; k++) {
        if (kind == 1)
            for (int i = 0; i < BOX_AXES_SEGMENTS; i++) q.segment[k][i] = i % 3 == k ? random_uniform(s, 0.1, 1) : 0;
        if (kind == 2) q.segment[k][4] = q.segment[k][1] + tilt * q.segment[k][4];
        if (kind == 3) q.segment[k][5] *= 1e-12;
        if (kind == 4) q.segment[k][5] = 0.7 * q.segment[k][0] - 0.3 * q.segment[k][1];
    }
    return q;
}

static real dot(const real n[3], const double x[3]) { return n[0] * x[0] + n[1] * x[1] + n[2] * x[2]; }

static void get_segment(const box_axes_query *q, int k, double x[3]) {
    for (int i = 0; i < 3; i++) x[i] = q->segment[i][k];
}

static void check_pair(const box_axes_query *q, const box_axes *x, int i, int is_known) {
    double u[3], v[3], g[3];
    get_segment(q, box_axes_first[i], u);
    get_segment(q, box_axes_second[i], v);
    real n[3], norm = 0, height = 0;
    for (int k = 0; k < 3; k++) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        n[k] = (real)u[a] * v[b] - (real)u[b] * v[a];
        norm += n[k] * n[k];
    }
    norm = sqrtl(norm);
    if (!(norm > 1e-13)) return;
    for (int k = 0; k < BOX_AXES_SEGMENTS; k++) {
        get_segment(q, k, g);
        real along = dot(n, g) / norm;
        if (k == box_axes_first[i] || k == box_axes_second[i]) continue;
        height += fabsl(along);
        if (is_known) CHECK((x->positive[k] >> i & 1) == (along > 0));
    }
    height -= fabsl(dot(n, q->center) / norm);
    CHECK(fabsl(height - x->height[i]) <= x->error[i]);
    real squares = 0;
    for (int k = 0; k < 3; k++) squares += (real)u[k] * u[k] + (real)v[k] * v[k];
    if (is_known) CHECK(height * norm > 0.999e-10L * sqrtl(squares));
    CHECK(x->error[i] >= q->error * (1 - 1e-12));
}

/// No face is deeper than the corners along its normal, and some face is as near as any direction.
static void check_least(const box_axes_query *q, const box_axes *x, uint64_t *s) {
    double least = INFINITY, g[3];
    for (int i = 0; i < BOX_AXES_PAIRS; i++) least = fmin(least, x->height[i] - x->error[i]);
    for (int i = 0; i < 20; i++) {
        double d[3] = {random_normal(s), random_normal(s), random_normal(s)};
        double norm = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        real n[3] = {d[0] / norm, d[1] / norm, d[2] / norm}, reach = -fabsl(dot(n, q->center));
        for (int k = 0; k < BOX_AXES_SEGMENTS; k++) {
            get_segment(q, k, g);
            reach += fabsl(dot(n, g));
        }
        CHECK(least <= 0 || (double)reach >= least);
    }
}

static int is_same(const box_axes *x, const box_axes *y) {
    return memcmp(x->n, y->n, sizeof x->n) == 0 && memcmp(x->height, y->height, sizeof x->height) == 0 &&
           memcmp(x->error, y->error, sizeof x->error) == 0 && memcmp(x->along, y->along, sizeof x->along) == 0 &&
           memcmp(x->positive, y->positive, sizeof x->positive) == 0;
}

static void test_kernels(void) {
    uint64_t s = 11;
    static box_axes x, y;
    for (int trial = 0; trial < 20000; trial++) {
        box_axes_query q = make_query(&s);
        int is_known = box_axes_get(SIMD_SCALAR)(&q, &x);
        known += is_known;
        unknown += !is_known;
        for (int i = 0; i < BOX_AXES_PAIRS && trial % 10 == 0; i++) check_pair(&q, &x, i, is_known);
        if (is_known && trial % 10 == 0) check_least(&q, &x, &s);
        for (int isa = SIMD_AVX2; isa <= SIMD_AVX512; isa++) {
            box_axes_function *other = box_axes_get((simd_isa)isa);
            if (!other) continue;
            CHECK(other(&q, &y) == is_known);
            if (is_known) CHECK(is_same(&x, &y));
        }
    }
    CHECK(known > 5000);
    CHECK(unknown > 5000);
}

/// Each of the 15 pairs once.
static void test_pairs(void) {
    int met[BOX_AXES_SEGMENTS][BOX_AXES_SEGMENTS] = {{0}};
    for (int i = 0; i < BOX_AXES_PAIRS; i++) {
        CHECK(box_axes_first[i] < box_axes_second[i]);
        CHECK(!met[box_axes_first[i]][box_axes_second[i]]++);
    }
}

int main(void) {
    test_pairs();
    test_kernels();
    return check_end();
}
