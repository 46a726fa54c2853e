// The kernels of contact polygons: every instruction set against the scalar twin, bit for bit, for all numbers of
// corners; and the twin against the definitions in long double. Tolerance: coordinates are of size 1 to 4, each number
// is off by a few roundings of them, 1e-14.
#include "simd/patch.h"

#include "check.h"

typedef long double real;

#define TOLERANCE 1e-14

enum { POINTS = 80 };
static double xyz[3][POINTS];

static simd_patch make_patch(uint64_t *s, uint32_t count) {
    simd_patch p;
    memset(&p, 0, sizeof p);
    p.count = p.side_count = count;
    for (uint32_t i = 0; i < count; i++) p.vertices[i] = (uint32_t)(random_next(s) % POINTS);
    // Now and then an edge of no length.
    if (count > 2 && random_next(s) % 4 == 0) p.vertices[count - 1] = p.vertices[count - 2];
    for (uint32_t i = count; i < simd_patch_pad(count); i++) p.vertices[i] = p.vertices[0];
    return p;
}

static simd_placing make_placing(uint64_t *s) {
    simd_placing f = {{xyz[0], xyz[1], xyz[2], POINTS}, {0}, {0}};
    for (int i = 0; i < 9; i++) f.rows[i] = random_uniform(s, -1, 1);
    for (int i = 0; i < 3; i++) f.shift[i] = random_uniform(s, -1, 1);
    return f;
}

static real place(const simd_placing *f, int row, uint32_t v) {
    const double *r = f->rows + 3 * row;
    return (real)r[0] * xyz[0][v] + (real)r[1] * xyz[1][v] + (real)r[2] * xyz[2][v] + f->shift[row];
}

static void check_place(const simd_placing *f, const simd_patch *p) {
    for (uint32_t i = 0; i < p->count; i++) {
        const double is[3] = {p->x[i], p->y[i], p->z[i]};
        for (int row = 0; row < 3; row++) CHECK_NEAR(is[row], (double)place(f, row, p->vertices[i]), TOLERANCE);
        if (p->count < 2) continue;
        uint32_t k = (i + 1) % p->count;
        real dx = (real)p->x[k] - p->x[i], dy = (real)p->y[k] - p->y[i], length = sqrtl(dx * dx + dy * dy);
        if (!(length > 0)) {
            CHECK(p->side_x[i] == 0 && p->side_y[i] == 0 && p->side_at[i] == -INFINITY);
            continue;
        }
        // The direction of a short edge is off by more, and counts by as much less.
        CHECK_NEAR(p->side_x[i], (double)(-dy / length), TOLERANCE / (double)length);
        CHECK_NEAR(p->side_y[i], (double)(dx / length), TOLERANCE / (double)length);
        CHECK_NEAR(p->side_at[i], p->side_x[i] * p->x[i] + p->side_y[i] * p->y[i], TOLERANCE);
    }
    if (p->count) CHECK(p->x[p->count] == p->x[0] && p->y[p->count] == p->y[0]);
}

static void check_table(const simd_patch *p, const simd_patch *other, const simd_patch_table *t) {
    for (uint32_t k = 0; k < other->count; k++) {
        double least = INFINITY;
        for (uint32_t i = 0; i < p->side_count; i++) {
            double d = (p->side_x[i] * other->x[k] + p->side_y[i] * other->y[k]) - p->side_at[i];
            least = d < least ? d : least;
            CHECK_LE(d, t->most[i]);
            CHECK_EQ(t->outside[i] >> k & 1, (uint64_t)(d < 0));
        }
        CHECK(t->least[k] == least);
    }
    for (uint32_t i = 0; i < p->side_count; i++) {
        int is_one = 0;
        for (uint32_t k = 0; k < other->count; k++)
            is_one |= (p->side_x[i] * other->x[k] + p->side_y[i] * other->y[k]) - p->side_at[i] == t->most[i];
        CHECK(is_one);
        CHECK(other->count == 64 || t->outside[i] >> other->count == 0);
    }
}

static int are_same(const double *p, const double *q, uint32_t count) { return !memcmp(p, q, count * sizeof *p); }

static void check_same(const simd_patch *p, const simd_patch *q) {
    uint32_t sides = p->count > 1 ? p->count : 0;
    CHECK(are_same(p->x, q->x, p->count + 1) && are_same(p->y, q->y, p->count + 1) && are_same(p->z, q->z, p->count));
    CHECK(are_same(p->side_x, q->side_x, sides) && are_same(p->side_y, q->side_y, sides));
    CHECK(are_same(p->side_at, q->side_at, sides));
}

static void check_same_table(const simd_patch *p, const simd_patch *other, const simd_patch_table *t,
                             const simd_patch_table *u) {
    CHECK(are_same(t->most, u->most, p->side_count) && are_same(t->least, u->least, other->count));
    CHECK(!memcmp(t->outside, u->outside, p->side_count * sizeof *t->outside));
}

static void check_counts(uint64_t *s, uint32_t count, uint32_t other_count) {
    const patch_kernels *scalar = patch_get_kernels_of(SIMD_SCALAR);
    simd_placing f = make_placing(s), g = make_placing(s);
    simd_patch from = make_patch(s, count), other_from = make_patch(s, other_count), p = from, other = other_from;
    simd_patch_table t;
    scalar->place(&f, &p);
    scalar->place(&g, &other);
    check_place(&f, &p);
    // A point has four sides of its own, which the caller sets.
    if (count == 1) p.side_x[0] = 1, p.side_y[0] = 0, p.side_at[0] = p.x[0];
    scalar->measure(&p, &other, &t);
    check_table(&p, &other, &t);
    for (int isa = SIMD_SCALAR + 1; isa < SIMD_ISA_COUNT; isa++) {
        const patch_kernels *kernels = patch_get_kernels_of((simd_isa)isa);
        if (!kernels) continue;
        simd_patch q = from;
        simd_patch_table u;
        kernels->place(&f, &q);
        check_same(&p, &q);
        kernels->measure(&p, &other, &u);
        check_same_table(&p, &other, &t, &u);
    }
}

int main(void) {
    uint64_t s = 3;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < POINTS; i++) xyz[k][i] = random_uniform(&s, -1, 1);
    for (uint32_t count = 1; count <= PATCH_CORNERS; count++)
        for (uint32_t other = 1; other <= PATCH_CORNERS; other += count % 3 + 1) check_counts(&s, count, other);
    CHECK(patch_get_kernels() == patch_get_kernels_of(SIMD_SCALAR) ||
          patch_get_kernels() == patch_get_kernels_of(SIMD_AVX2));
    return check_end();
}
