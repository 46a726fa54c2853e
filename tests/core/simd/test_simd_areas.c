// The kernels of hulls. Areas: every instruction set against the definition in double-double, bit for bit, for all
// numbers of triangles around the widths of lanes; and against long double. Tolerance: coordinates are of size 1, and
// the area is rounded once, so an entry is off by 2^-53 of itself, beside the cancellation of long double, 2^-60.
// Heights: every instruction set against the definition in doubles, bit for bit.
#include "simd/areas.h"

#include "check.h"
#include "linear/exact.h"

enum { POINTS = 50, TRIANGLES = 37 };
static double xyz[3 * POINTS];
static uint32_t corners[3 * TRIANGLES];

static double get_minor(dd a, dd b, dd c, dd d) { return dd_sub(dd_mul(a, b), dd_mul(c, d)).high; }

static vec3 compute_defined(const uint32_t *corner) {
    vec3 a = vec3_at(xyz, corner[0]), b = vec3_at(xyz, corner[1]), c = vec3_at(xyz, corner[2]);
    dd px = two_sum(b.x, -a.x), py = two_sum(b.y, -a.y), pz = two_sum(b.z, -a.z);
    dd qx = two_sum(c.x, -a.x), qy = two_sum(c.y, -a.y), qz = two_sum(c.z, -a.z);
    return (vec3){get_minor(py, qz, pz, qy), get_minor(pz, qx, px, qz), get_minor(px, qy, py, qx)};
}

static void check_long(const uint32_t *corner, const vec3 *area) {
    long double p[3], q[3];
    for (int k = 0; k < 3; k++) {
        p[k] = (long double)xyz[3 * corner[1] + (uint32_t)k] - xyz[3 * corner[0] + (uint32_t)k];
        q[k] = (long double)xyz[3 * corner[2] + (uint32_t)k] - xyz[3 * corner[0] + (uint32_t)k];
    }
    const double entries[3] = {area->x, area->y, area->z};
    for (int k = 0; k < 3; k++) {
        int y = (k + 1) % 3, z = (k + 2) % 3;
        double expected = (double)(p[y] * q[z] - p[z] * q[y]);
        CHECK_NEAR(entries[k], expected, 0x1p-53 * fabs(expected) + 0x1p-59);
    }
}

static void fill(uint64_t *s, double thickness) {
    for (int i = 0; i < 3 * POINTS; i++) xyz[i] = random_uniform(s, -1, 1) * (i % 3 == 2 ? thickness : 1);
    for (int i = 0; i < 3 * TRIANGLES; i++) corners[i] = (uint32_t)(random_next(s) % POINTS);
}

static void check_count(uint32_t count) {
    for (int isa = 0; isa < SIMD_ISA_COUNT; isa++) {
        areas_function *compute = areas_get((simd_isa)isa);
        if (!compute) continue;
        vec3 areas[TRIANGLES + 1];
        memset(areas, 0x55, sizeof areas);
        compute(&(simd_triangles){xyz, corners, count}, areas);
        for (uint32_t i = 0; i < count; i++) {
            vec3 defined = compute_defined(corners + 3 * (size_t)i);
            CHECK(!memcmp(&defined, &areas[i], sizeof defined));
            check_long(corners + 3 * (size_t)i, &areas[i]);
        }
        // Nothing is written behind the last one.
        for (size_t i = 0; i < sizeof *areas; i++) CHECK_EQ(((const uint8_t *)&areas[count])[i], 0x55);
    }
}

// ---- heights ----

enum { PLANES = 200 };
static double plane[4][PLANES];

// Heights are small integers, so that many are exactly the least one.
static void check_heights(uint32_t count, uint64_t *s) {
    for (int i = 0; i < 4 * PLANES; i++) plane[i / PLANES][i % PLANES] = (double)(random_next(s) % 5) - 2;
    heights_query query = {{0.5, -1, 2}, (double)(random_next(s) % 9) - 4};
    for (int isa = 0; isa < SIMD_ISA_COUNT; isa++) {
        heights_function *find = heights_get((simd_isa)isa);
        if (!find) continue;
        double height[PLANES];
        uint16_t near[PLANES];
        uint32_t at = 0;
        uint32_t found = find(&(simd_planes){plane[0], plane[1], plane[2], plane[3], count}, &query,
                              &(heights_result){height, near});
        for (uint32_t i = 0; i < count; i++) {
            vec3 n = {plane[0][i], plane[1][i], plane[2][i]};
            double defined = vec3_dot(n, query.point) - plane[3][i];
            CHECK(!memcmp(&defined, &height[i], sizeof defined));
            if (defined >= query.least) CHECK(at < found && near[at++] == i);
        }
        CHECK_EQ(found, at);
    }
}

int main(void) {
    uint64_t s = 5;
    for (int round = 0; round < 20; round++) {
        fill(&s, round % 2 ? 1 : 1e-12);
        for (uint32_t count = 0; count <= TRIANGLES; count++) check_count(count);
    }
    for (uint32_t count = 0; count <= PLANES - 8; count++) check_heights(count, &s);
    CHECK(areas_get(SIMD_SCALAR) != NULL && heights_get(SIMD_SCALAR) != NULL);
    return check_end();
}
