// The vector kernels against their scalar twin, bit for bit: no tolerance. The scalar twin itself against its
// definition, read off a sorted copy of the values.
#include "simd/support.h"

#include "check.h"

enum { LONGEST = 256, COUNT_MANY = 5000 };
static double x[COUNT_MANY + 8], y[COUNT_MANY + 8], z[COUNT_MANY + 8];

static uint64_t bits_of(double v) {
    uint64_t b;
    memcpy(&b, &v, sizeof b);
    return b;
}

/// The definition: the largest value, the first index that has it.
static void check_scalar(uint32_t n, const double *d) {
    support_result r = simd_find_support_scalar(x, y, z, n, d[0], d[1], d[2]);
    int is_first = 1, is_largest = 1;
    for (uint32_t i = 0; i < n; i++) {
        double v = (x[i] * d[0] + y[i] * d[1]) + z[i] * d[2];
        if (v > r.value) is_largest = 0;
        if (v == r.value && i < r.index) is_first = 0;
        if (i == r.index) CHECK_EQ(v, r.value);
    }
    CHECK(is_first && is_largest && r.index < n && !(r.value == 0 && signbit(r.value)));
}

/// Every kernel of this machine gives the scalar twin's bits.
static void check_kernels(uint32_t n, const double *d) {
    check_scalar(n, d);
    support_result expected = simd_find_support_scalar(x, y, z, n, d[0], d[1], d[2]);
    for (simd_isa isa = SIMD_SCALAR; isa <= SIMD_ISA_COUNT; isa++) {
        simd_support_function *find = isa == SIMD_ISA_COUNT ? simd_find_support : simd_get_support(isa);
        if (!find) continue;
        support_result r = find(x, y, z, n, d[0], d[1], d[2]);
        CHECK_EQ(r.index, expected.index);
        CHECK(bits_of(r.value) == bits_of(expected.value));
    }
}

/// Points on a small integer grid: most values tie, and many are zeros of both signs.
static void fill_ties(uint64_t *state, uint32_t n) {
    for (uint32_t i = 0; i < n; i++) {
        x[i] = (double)(random_next(state) % 3) - 1;
        y[i] = (double)(random_next(state) % 3) - 1;
        z[i] = (double)(random_next(state) % 3) - 1;
    }
}

static void fill_random(uint64_t *state, uint32_t n, double scale, double offset) {
    for (uint32_t i = 0; i < n; i++) {
        x[i] = offset + scale * random_normal(state);
        y[i] = offset + scale * random_normal(state);
        z[i] = offset + scale * random_normal(state);
    }
}

static void test_lengths(void) {
    static const double ties[][3] = {{1, 0, 0},  {0, -1, 0}, {0, 0, 0}, {-0.0, 0, -0.0}, {1, 1, 1},
                                     {-1, 1, 0}, {0, 0, 1},  {1, 2, 4}, {1e-300, 0, 0},  {-1e90, 1e90, -1e90}};
    for (uint32_t n = 8; n <= LONGEST; n += 8)
        for (uint64_t seed = 1; seed <= 6; seed++) {
            uint64_t state = check_seed = seed * 1000 + n;
            fill_ties(&state, n);
            for (size_t k = 0; k < sizeof ties / sizeof ties[0]; k++) check_kernels(n, ties[k]);
            // The winner at every place: last block, first lane, and so on.
            uint32_t place = (uint32_t)(random_next(&state) % n);
            x[place] = 5;
            check_kernels(n, ties[0]);
            fill_random(&state, n, 1, 0);
            // Padding as shapes have it: copies of point 0.
            for (uint32_t i = n - 7; i < n; i++) x[i] = x[0], y[i] = y[0], z[i] = z[0];
            for (int k = 0; k < 10; k++) {
                double d[3] = {random_normal(&state), random_normal(&state), random_normal(&state)};
                check_kernels(n, d);
            }
            double at_first[3] = {x[0], y[0], z[0]};
            check_kernels(n, at_first);
        }
}

static void test_scales(void) {
    static const double scales[][2] = {{1e-9, 0}, {1e9, 0}, {1, 1e7}, {1e90, 0}, {1e-130, 0}};
    for (size_t k = 0; k < sizeof scales / sizeof scales[0]; k++)
        for (uint64_t seed = 1; seed <= 20; seed++) {
            uint64_t state = check_seed = seed;
            fill_random(&state, COUNT_MANY, scales[k][0], scales[k][1]);
            double d[3] = {random_normal(&state), random_normal(&state), random_normal(&state)};
            check_kernels(COUNT_MANY, d);
        }
}

/// Arrays that are not aligned to a vector.
static void test_unaligned(void) {
    uint64_t state = check_seed = 7;
    fill_random(&state, LONGEST + 8, 1, 0);
    for (uint32_t shift = 0; shift < 8; shift++) {
        support_result a = simd_find_support_scalar(x + shift, y + shift, z + shift, LONGEST, 1, 2, 3);
        support_result b = simd_find_support(x + shift, y + shift, z + shift, LONGEST, 1, 2, 3);
        CHECK(a.index == b.index && bits_of(a.value) == bits_of(b.value));
    }
}

int main(void) {
    for (simd_isa isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++)
        if (!simd_get_support(isa)) {
            char why[80];
            snprintf(why, sizeof why, "this machine or build has no %s", simd_isa_get_name(isa));
            check_skip(why);
        }
    test_lengths();
    test_scales();
    test_unaligned();
    return check_end();
}
