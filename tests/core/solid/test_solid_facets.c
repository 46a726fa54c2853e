// The flat facets of solids, and how their edges bend. Truth: counted by hand, and by the angles between triangles.

#include "solid/solid.h"
#include "solids.h"

static double level(double x, double y) { return 0 * x * y; }
static double sloped(double x, double y) { return 0.3 * x - 0.7 * y; }
static double roof(double x, double y) { return -0.5 * fabs(x) + 0 * y; }
static double trough(double x, double y) { return 0.5 * fabs(x) + 0 * y; }

static uint32_t count_facets(const ovoid_solid *s) {
    uint32_t count = 0;
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        CHECK_EQ(s->facets[s->facets[t]], s->facets[t]);
        count += s->facets[t] == t && !(s->bends[t] & SOLID_NO_AREA);
    }
    return count;
}

static uint32_t count_bends(const ovoid_solid *s, solid_bend bend) {
    uint32_t count = 0;
    for (uint32_t t = 0; t < s->triangle_count; t++)
        for (int i = 0; i < 3; i++) count += solid_get_bend(s, t, i) == bend;
    return count;
}

static double compute_area(const ovoid_solid *s, uint32_t t) {
    vec3 a = solid_get_corner(s, t, 0);
    return vec3_norm(vec3_cross(vec3_sub(solid_get_corner(s, t, 1), a), vec3_sub(solid_get_corner(s, t, 2), a)));
}

// The first triangle of a facet is its largest, of equal ones the first in the tree; the facet's corners are in its
// plane.
static void check_planes(const ovoid_solid *s) {
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        vec3 n = solid_compute_facet_normal(s, s->facets[t]), at = solid_get_corner(s, s->facets[t], 0);
        CHECK_NEAR(vec3_norm(n), 1, 1e-15);
        CHECK_LE(compute_area(s, t), compute_area(s, s->facets[t]) * (1 + 1e-12));
        for (int i = 0; i < 3; i++)
            CHECK_LE(fabs(vec3_dot(n, vec3_sub(solid_get_corner(s, t, i), at))), s->flatness * (1 + 1e-9));
    }
}

static void test_grounds(void) {
    uint64_t seed = check_seed = 1;
    const struct {
        double (*height)(double, double);
        uint32_t facets, convex, concave;
    } trials[] = {{level, 6, 12, 0}, {sloped, 6, 12, 0}, {roof, 7, 13, 0}, {trough, 7, 12, 1}};
    for (int k = 0; k < 4; k++)
        for (uint32_t n = 2; n < 20; n += 6) {
            const ground of = {n, 2, -3, trials[k].height, k < 2 ? 0.2 : 0};
            ovoid_solid *s = ground_make(&of, &seed);
            CHECK_EQ(count_facets(s), trials[k].facets);
            check_planes(s);
            // Around the top and the bottom 4 n edges each, and 4 upright ones, each of two triangles; the crease n
            // more.
            uint32_t crease = k < 2 ? 0 : n;
            CHECK_EQ(count_bends(s, SOLID_CONVEX), 2 * (8 * n + 4 + (k == 2 ? crease : 0)));
            CHECK_EQ(count_bends(s, SOLID_CONCAVE), 2 * (k == 3 ? crease : 0));
            CHECK_EQ(count_bends(s, SOLID_OPEN), 0);
            ovoid_solid_destroy(s);
        }
}

// A ring is round: no two quadrangles are one facet, and coordinates rounded to floats change that for none.
static void test_ring(void) {
    uint64_t seed = check_seed = 2;
    mesh m = {0};
    mesh_add_ring(&m, 3, 1, 60, 40, 0, &seed);
    ovoid_solid *s = mesh_make_solid(&m);
    CHECK_EQ(count_facets(s), 60 * 40);
    for (size_t i = 0; i < 3 * m.points; i++) m.xyz[i] = (double)(float)m.xyz[i];
    ovoid_solid *rounded = mesh_make_solid(&m);
    CHECK_EQ(count_facets(rounded), 60 * 40);
    CHECK_EQ(count_bends(rounded, SOLID_FLAT), 2 * 60 * 40);
    check_planes(rounded);
    ovoid_solid_destroy(s);
    ovoid_solid_destroy(rounded);
    mesh_clear(&m);
}

// A square with a triangle without area along its diagonal is one facet with four open edges, beside those at the
// diagonal.
static void test_no_area(void) {
    static const double xyz[] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 1, 0};
    static const uint32_t indices[] = {0, 1, 2, 0, 4, 3, 4, 2, 3, 0, 2, 4};
    ovoid_solid *s = ovoid_solid_create_from_triangles(&(ovoid_triangles){xyz, 5, indices, 4}, NULL, NULL);
    CHECK_EQ(count_facets(s), 1);
    uint32_t empty = 0;
    for (uint32_t t = 0; t < 4; t++) empty += (s->bends[t] & SOLID_NO_AREA) != 0;
    CHECK_EQ(empty, 1);
    CHECK_EQ(count_bends(s, SOLID_OPEN), 4 + 3);
    ovoid_solid_destroy(s);
}

int main(void) {
    test_grounds();
    test_ring();
    test_no_area();
    return check_end();
}
