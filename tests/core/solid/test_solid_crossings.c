// Where a surface meets itself. Truth: pairs of triangles whose answer is plain, at three sizes and in all orders of
// their corners; and of random solids in no special position, all pairs of triangles that share no corner, an edge of
// one through the inside of the other, in extended precision.
#include "solids.h"

static ovoid_solid_crossings find(const double *xyz, size_t points, const uint32_t *indices, size_t count) {
    ovoid_solid *s = ovoid_solid_create_from_triangles(&(ovoid_triangles){xyz, points, indices, count}, NULL, NULL);
    ovoid_solid_crossings x = {.pairs = UINT64_MAX};
    if (CHECK(s != NULL)) x = ovoid_solid_compute_crossings(s, UINT64_MAX);
    ovoid_solid_destroy(s);
    return x;
}

/// Two triangles of six points, the second one's corners in any turn.
static void check_two(const char *what, const double *own, uint64_t pairs) {
    static const double sizes[3] = {1, 1e-30, 1e30};
    for (int size = 0; size < 3; size++)
        for (uint32_t turn = 0; turn < 6; turn++) {
            double xyz[18];
            for (int i = 0; i < 18; i++) xyz[i] = sizes[size] * own[i];
            uint32_t k = turn % 3, way = turn / 3 ? 2 : 1;
            const uint32_t indices[6] = {0, 1, 2, 3 + k, 3 + (k + way) % 3, 3 + (k + 2 * way) % 3};
            ovoid_solid_crossings x = find(xyz, 6, indices, 2);
            if (!CHECK_EQ(x.pairs, pairs)) printf("  %s, size %d, turn %u\n", what, size, turn);
            CHECK_EQ(x.is_complete, 1);
            CHECK_EQ(x.triangle_b, pairs);
        }
}

static void check_pairs(void) {
    check_two("beside", (const double[18]){0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 3, 0, 0, 2, 1, 0}, 0);
    check_two("above", (const double[18]){0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1}, 0);
    check_two("boxes meet", (const double[18]){0, 0, 0, 4, 0, 0, 0, 4, 0, 3, 3, -1, 3, 3, 1, 4, 4, 1}, 0);
    check_two("an edge through the inside", (const double[18]){0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, 5, 5, 1},
              1);
    check_two("a corner on the inside", (const double[18]){0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 0, 1, 1, 1, 2, 1, 1}, 1);
    check_two("a corner on an edge", (const double[18]){0, 0, 0, 4, 0, 0, 0, 4, 0, 2, 0, 0, 2, -1, 1, 2, 1, 1}, 1);
    check_two("edges that cross", (const double[18]){0, 0, 0, 4, 0, 0, 0, 4, 0, 2, 0, -1, 2, 0, 1, 2, -3, 0}, 1);
    check_two("a star in a plane", (const double[18]){0, 0, 0, 4, 0, 0, 2, 3, 0, 0, 2, 0, 4, 2, 0, 2, -1, 0}, 1);
    check_two("inside in a plane", (const double[18]){0, 0, 0, 8, 0, 0, 0, 8, 0, 1, 1, 0, 2, 1, 0, 1, 2, 0}, 1);
    check_two("a common corner", (const double[18]){0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 0, -1, 0, 1, 0, -1, 1}, 0);
    check_two("a common corner, through", (const double[18]){0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 0, 1, 1, 1, 1, 1, -1}, 1);
    check_two("a common corner, in a plane", (const double[18]){0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 0, 1, 1, 0, 1, -1, 0},
              1);
    check_two("a common edge", (const double[18]){0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 0, 4, 0, 0, 1, 1, 1}, 0);
    check_two("a common edge, flat", (const double[18]){0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 0, 4, 0, 0, 0, -4, 0}, 0);
    check_two("a common edge, folded", (const double[18]){0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 0, 4, 0, 0, 1, 1, 0}, 1);
    check_two("the same", (const double[18]){0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 0);
    check_two("without area", (const double[18]){0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, 1, 1, 2}, 0);
    // The least that doubles can be apart.
    double under = nextafter(0.25, 0);
    check_two("by a hair above", (const double[18]){0, 0, 0.25, 4, 0, 0.25, 0, 4, 0.25, 1, 1, 0.25, 1, 1, 1, 2, 1, 1},
              1);
    check_two("by a hair below",
              (const double[18]){0, 0, under, 4, 0, under, 0, 4, under, 1, 1, 0.25, 1, 1, 1, 2, 1, 1}, 0);
}

static uint64_t count_by_force(const mesh *m, uint32_t first[2]) {
    ovoid_pose here = ovoid_pose_make_identity();
    long3 *t = long_place_mesh(m, &here);
    uint64_t count = 0;
    for (uint32_t i = 0; i < m->triangles; i++)
        for (uint32_t j = i + 1; j < m->triangles; j++) {
            int shared = 0, crossing = 0;
            for (int k = 0; k < 9; k++) shared += m->indices[3 * i + k / 3] == m->indices[3 * j + k % 3];
            for (int k = 0; k < 3; k++)
                crossing |= long_is_crossing(t[3 * i + k], t[3 * i + (k + 1) % 3], t + 3 * j) ||
                            long_is_crossing(t[3 * j + k], t[3 * j + (k + 1) % 3], t + 3 * i);
            if (shared || !crossing) continue;
            if (!count++) first[0] = i, first[1] = j;
        }
    free(t);
    return count;
}

static void check_random(int round) {
    uint64_t s = check_seed = 70 + (uint64_t)round;
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_star(&m, (ovoid_vec3){random_uniform(&s, 0, 2.2), 0.1, 0.2}, 1, 6, 9, 0.1, &s);
    mesh_add_star(&m, (ovoid_vec3){0, 0, 0}, 1, 7, 8, 0.1, &s);
    uint32_t first[2] = {0, 0};
    uint64_t wanted = count_by_force(&m, first);
    ovoid_solid *solid = mesh_make_solid(&m);
    if (CHECK(solid != NULL)) {
        ovoid_solid_crossings x = ovoid_solid_compute_crossings(solid, UINT64_MAX), some;
        CHECK_EQ(x.pairs, wanted);
        CHECK_EQ(x.is_complete, 1);
        CHECK((x.triangle_a < x.triangle_b) == (wanted > 0));
        some = ovoid_solid_compute_crossings(solid, 3);
        CHECK_EQ(some.pairs, wanted < 3 ? wanted : 3);
        CHECK_EQ(some.is_complete, wanted < 3);
        CHECK_EQ(some.triangle_a, x.triangle_a);
    }
    ovoid_solid_destroy(solid);
    mesh_clear(&m);
}

// Two cubes: one in the other's corner crosses it, in its middle does not, the same twice has nothing but copies.
static void check_cubes(void) {
    static const double at[4] = {0.5, 5, 0.125, 0};
    static const int has[4] = {1, 0, 0, 0};
    for (int i = 0; i < 4; i++) {
        mesh m = {NULL, NULL, 0, 0, 0, 0};
        for (int k = 0; k < 2; k++) {
            double from = k ? at[i] : 0, size = k && i == 2 ? 0.5 : 1;
            for (int c = 0; c < 8; c++)
                mesh_add_point(&m, from + size * (c & 1), from + size * (c >> 1 & 1), from + size * (c >> 2));
            static const uint8_t faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
            for (int f = 0; f < 12; f++)
                mesh_add_triangle(&m, 8 * (uint32_t)k + faces[f][0], 8 * (uint32_t)k + faces[f][1],
                                  8 * (uint32_t)k + faces[f][2]);
        }
        ovoid_solid_crossings x = find(m.xyz, m.points, m.indices, m.triangles);
        CHECK_EQ(x.pairs > 0, has[i]);
        mesh_clear(&m);
    }
}

int main(void) {
    check_pairs();
    check_cubes();
    for (int i = 0; i < 12; i++) check_random(i);
    check_seed = 0;
    return check_end();
}
