// The kernel of extents against the scalar support along each direction and against it: the same numbers, by all
// instruction sets, for all numbers of points that a shape may have. No tolerance.
#include "simd/support.h"

#include "check.h"

enum { MOST = 96, ROUNDS = 200 };

static void check_extents(simd_extents_function *find, const simd_points *points, const mat3 *m) {
    const vec3 rows[3] = {m->r0, m->r1, m->r2};
    simd_extents found = find(points, m);
    for (int k = 0; k < 3; k++) {
        CHECK_EQ(found.high[k], simd_find_support_scalar(points, rows[k]).value);
        CHECK_EQ(found.low[k], -simd_find_support_scalar(points, vec3_neg(rows[k])).value);
    }
}

int main(void) {
    uint64_t s = 29;
    for (int round = 0; round < ROUNDS; round++) {
        check_seed = (uint64_t)round;
        double x[3][MOST];
        uint32_t count = 8 * (1 + (uint32_t)round % (MOST / 8));
        for (uint32_t i = 0; i < count; i++)
            for (int k = 0; k < 3; k++) x[k][i] = round % 7 ? random_uniform(&s, -1, 1) : random_uniform(&s, 1, 2);
        mat3 m;
        double *row = &m.r0.x;
        for (int i = 0; i < 9; i++) row[i] = random_uniform(&s, -1, 1);
        const simd_points points = {x[0], x[1], x[2], count};
        for (simd_isa isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++)
            if (simd_get_extents(isa)) check_extents(simd_get_extents(isa), &points, &m);
        check_extents(simd_find_extents, &points, &m);
    }
    return check_end();
}
