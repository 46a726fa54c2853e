// The vector kernels against their scalar twin, bit for bit: no tolerance. The scalar twin itself against its
// definition, read off a sorted copy of the values.
#include "simd/pair.h"
#include "simd/planes.h"
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
    simd_points points = {x, y, z, n};
    support_result r = simd_find_support_scalar(&points, vec3_at(d, 0));
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
    simd_points points = {x, y, z, n};
    vec3 along = vec3_at(d, 0);
    support_result expected = simd_find_support_scalar(&points, along);
    for (simd_isa isa = SIMD_SCALAR; isa <= SIMD_ISA_COUNT; isa++) {
        simd_support_function *find = isa == SIMD_ISA_COUNT ? simd_find_support : simd_get_support(isa);
        if (!find) continue;
        support_result r = find(&points, &along);
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
        simd_points points = {x + shift, y + shift, z + shift, LONGEST};
        support_result a = simd_find_support_scalar(&points, (vec3){1, 2, 3});
        support_result b = simd_find_support(&points, &(vec3){1, 2, 3});
        CHECK(a.index == b.index && bits_of(a.value) == bits_of(b.value));
    }
}

static void check_pair(const simd_points *high, const simd_points *low, vec3 d) {
    vec3 e = {d.y, -d.x, -d.z};
    simd_pair expected = simd_get_pair(SIMD_SCALAR)(high, d, low, e);
    for (simd_isa isa = SIMD_SCALAR; isa <= SIMD_ISA_COUNT; isa++) {
        simd_pair_function *find = isa == SIMD_ISA_COUNT ? simd_find_pair : simd_get_pair(isa);
        if (!find || (isa != SIMD_ISA_COUNT && (high->padded_count > 64 || low->padded_count > 64))) continue;
        simd_pair r = find(high, d, low, e);
        CHECK_EQ(r.high.index, expected.high.index);
        CHECK_EQ(r.low.index, expected.low.index);
        CHECK(bits_of(r.high.value) == bits_of(expected.high.value));
        CHECK(bits_of(r.low.value) == bits_of(expected.low.value));
    }
}

/// The difference along n is that of the pair along n and -n; points turned and moved are the scalar twin's.
static void check_difference(const simd_points *a, const simd_points *b, vec3 n) {
    simd_pair expected = simd_get_pair(SIMD_SCALAR)(a, n, b, vec3_neg(n));
    simd_difference d = simd_find_difference(a, b, n);
    CHECK(d.a == expected.high.index && d.b == expected.low.index);
    CHECK(bits_of(d.gap) == bits_of(-expected.low.value - expected.high.value));
    CHECK(d.x == b->x[d.b] - a->x[d.a] && d.y == b->y[d.b] - a->y[d.a] && d.z == b->z[d.b] - a->z[d.a]);
}

static void check_posed(const simd_points *from, uint64_t *state) {
    static double one[3][COUNT_MANY], two[3][COUNT_MANY];
    double rows[9], t[3];
    for (int i = 0; i < 9; i++) rows[i] = random_normal(state);
    for (int i = 0; i < 3; i++) t[i] = random_normal(state);
    simd_pose_points(from, rows, t, (double *[]){one[0], one[1], one[2]});
    simd_pose_points_scalar(from, rows, t, (double *[]){two[0], two[1], two[2]});
    for (int k = 0; k < 3; k++) CHECK(memcmp(one[k], two[k], from->padded_count * sizeof(double)) == 0);
}

/// Both bodies at once, of all lengths, with and without ties: what two calls of the scalar twin give.
static void test_pairs(void) {
    static const vec3 ties[] = {{1, 0, 0}, {0, 0, 0}, {-0.0, 0, -0.0}, {1, -1, 1}};
    for (uint32_t n = 8; n <= 80; n += 8)
        for (uint32_t m = 8; m <= 80; m += 8) {
            uint64_t state = check_seed = 100 * n + m;
            simd_points high = {x, y, z, n}, low = {x + 100, y + 100, z + 100, m};
            fill_ties(&state, 200);
            for (size_t k = 0; k < sizeof ties / sizeof ties[0]; k++) {
                check_pair(&high, &low, ties[k]);
                check_difference(&high, &low, ties[k]);
            }
            fill_random(&state, 200, 1, 0);
            vec3 d = {random_normal(&state), random_normal(&state), random_normal(&state)};
            check_pair(&high, &low, d);
            check_difference(&high, &low, d);
            check_posed(&high, &state);
        }
}

/// Cones of every length, some triangles without area: the scalar twin's bits.
static void test_cones(void) {
    static simd_cone a, b;
    for (uint32_t count = 1; count <= SIMD_CONE; count++)
        for (uint64_t seed = 1; seed <= 200; seed++) {
            uint64_t state = check_seed = seed;
            double scale = seed % 5 == 0 ? 1e-70 : seed % 7 == 0 ? 1e45 : 1;
            for (int k = 0; k < 3; k++)
                for (int i = 0; i < SIMD_CONE + 4; i++)
                    a.edge[k][i] = random_next(&state) % 8 ? scale * random_normal(&state) : 0;
            b = a;
            vec3 w = {scale * random_normal(&state), scale * random_normal(&state), scale * random_normal(&state)};
            simd_compute_cone(&a, count, w);
            simd_compute_cone_scalar(&b, count, w);
            for (uint32_t i = 0; i < count; i++) {
                for (int k = 0; k < 3; k++) CHECK(bits_of(a.n[k][i]) == bits_of(b.n[k][i]));
                CHECK(bits_of(a.offset[i]) == bits_of(b.offset[i]));
                CHECK(bits_of(a.area[i]) == bits_of(b.area[i]));
                CHECK(bits_of(a.product[i]) == bits_of(b.product[i]));
                CHECK(bits_of(a.sum[i]) == bits_of(b.sum[i]));
            }
            // The definition, by its property: the plane's normal is orthogonal to both edges.
            for (uint32_t i = 0; i < count; i++) {
                if (!(b.area[i] > 1e-2 * b.product[i])) continue;
                double e = 0;
                for (int k = 0; k < 3; k++) e += b.n[k][i] * b.edge[k][i];
                CHECK_LE(fabs(e), 1e-13 * scale);
            }
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
    test_pairs();
    test_cones();
    return check_end();
}
