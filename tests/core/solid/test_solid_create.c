// Making solids: what is reported of closed, open, doubled, inside-out and bad triangles; winding numbers against solid
// angles; memory that fails; kernels against their scalar twins. Truth: counts by construction (Euler), closed forms,
// and for winding numbers the solid angles in extended precision, trusted to 1e-6 away from the surface.
#include "countdown.h"
#include "simd/solid8.h"
#include "solids.h"

static const double corners[24] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
static const uint32_t cube[36] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                  1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

static ovoid_solid *make_cube(size_t count) {
    return ovoid_solid_create_from_triangles(&(ovoid_triangles){corners, 8, cube, count}, NULL, NULL);
}

static void check_reports(void) {
    ovoid_solid *s = make_cube(12);
    ovoid_solid_report r = ovoid_solid_get_report(s);
    CHECK_EQ(r.is_closed, 1);
    CHECK_EQ(r.points, 8);
    CHECK_EQ(r.components, 1);
    CHECK_EQ(r.degenerate + r.duplicates + r.edges_crowded + r.edges_unmatched, 0);
    CHECK_NEAR(r.volume, 1, 1e-15);
    CHECK_NEAR(r.area, 6, 1e-14);
    for (size_t i = 0; i < 12; i++) {
        uint32_t p[3];
        ovoid_solid_get_triangle(s, i, p);
        for (int k = 0; k < 3; k++) // merged points are in the order of first use
            CHECK(memcmp(ovoid_solid_get_points(s) + 3 * p[k], corners + 3 * cube[3 * i + (size_t)k], 24) == 0);
    }
    ovoid_solid_destroy(s);
    s = make_cube(11);
    r = ovoid_solid_get_report(s);
    int64_t winding;
    CHECK_EQ(r.is_closed, 0);
    CHECK_EQ(r.edges_unmatched, 3);
    CHECK_NEAR(r.volume, 0, 0);
    CHECK_EQ(ovoid_solid_compute_winding(s, (ovoid_vec3){0.4, 0.5, 0.6}, &winding), 0);
    ovoid_solid_destroy(s);

    // One triangle turned over: each edge has two triangles, but three are run through twice the same way.
    uint32_t one_turned[36];
    memcpy(one_turned, cube, sizeof cube);
    one_turned[0] = cube[1], one_turned[1] = cube[0];
    s = ovoid_solid_create_from_triangles(&(ovoid_triangles){corners, 8, one_turned, 12}, NULL, NULL);
    CHECK_EQ(ovoid_solid_get_report(s).is_closed, 0);
    CHECK_EQ(ovoid_solid_get_report(s).edges_unmatched, 3);
    CHECK_EQ(ovoid_solid_get_report(s).edges_crowded, 0);
    ovoid_solid_destroy(s);

    // Twice the same, each triangle with corners of its own, one copy turned in its order: copies that coincide.
    double soup[2 * 36 * 3];
    uint32_t indices[2 * 36];
    for (uint32_t i = 0; i < 72; i++) {
        uint32_t t = i % 36 / 3, c = i % 36 % 3;
        memcpy(soup + 3 * i, corners + 3 * cube[3 * t + (i < 36 ? c : (c + 1) % 3)], 24);
        if (i % 2)
            for (int k = 0; k < 3; k++)
                if (soup[3 * i + (uint32_t)k] <= 0) soup[3 * i + (uint32_t)k] = -0.0;
        indices[i] = i;
    }
    s = ovoid_solid_create_from_triangles(&(ovoid_triangles){soup, 72, indices, 24}, NULL, NULL);
    r = ovoid_solid_get_report(s);
    CHECK_EQ(r.points, 8);
    CHECK_EQ(r.duplicates, 12);
    CHECK_EQ(r.edges_crowded, 18);
    CHECK_EQ(r.is_closed, 1);
    CHECK(ovoid_solid_compute_winding(s, (ovoid_vec3){0.5, 0.5, 0.5}, &winding) && winding == 2);
    ovoid_solid_destroy(s);

    // Inside out, and with triangles of no area: a needle of three points on a line, one with two corners the same.
    uint32_t turned[42];
    for (int t = 0; t < 12; t++)
        turned[3 * t] = cube[3 * t], turned[3 * t + 1] = cube[3 * t + 2], turned[3 * t + 2] = cube[3 * t + 1];
    turned[36] = 0, turned[37] = 6, turned[38] = 8, turned[39] = 1, turned[40] = 1, turned[41] = 2;
    double more[27];
    memcpy(more, corners, sizeof corners);
    more[24] = more[25] = more[26] = 0.25;
    s = ovoid_solid_create_from_triangles(&(ovoid_triangles){more, 9, turned, 12}, NULL, NULL);
    CHECK_NEAR(ovoid_solid_get_report(s).volume, -1, 1e-15);
    CHECK(ovoid_solid_compute_winding(s, (ovoid_vec3){0.5, 0.5, 0.5}, &winding) && winding == -1);
    // On a diagonal of a side, straight under an edge, on the surface itself.
    CHECK(ovoid_solid_compute_winding(s, (ovoid_vec3){0.5, 0, 0.5}, &winding) == 0 || winding == 0 || winding == -1);
    CHECK_EQ(ovoid_solid_compute_winding(s, (ovoid_vec3){1, 0.5, 0.25}, &winding), 0);
    CHECK_EQ(ovoid_solid_compute_winding(s, (ovoid_vec3){NAN, 0, 0}, &winding), 0);
    CHECK(ovoid_solid_compute_winding(s, (ovoid_vec3){1e300, 0, 0}, &winding) && winding == 0);
    ovoid_solid_destroy(s);
    s = ovoid_solid_create_from_triangles(&(ovoid_triangles){more, 9, turned, 14}, NULL, NULL);
    CHECK_EQ(ovoid_solid_get_report(s).degenerate, 2);
    ovoid_solid_destroy(s);
}

// A strip with half a turn is no solid, though each edge of it has at most two triangles.
static void check_strip(void) {
    enum { COUNT = 24 };
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    for (int i = 0; i < COUNT; i++)
        for (int side = -1; side < 2; side += 2) {
            double a = 6.283185307179586 * i / COUNT, r = 2 + side * 0.5 * cos(a / 2);
            mesh_add_point(&m, r * cos(a), r * sin(a), side * 0.5 * sin(a / 2));
        }
    for (uint32_t i = 0; i < COUNT; i++) {
        uint32_t a = 2 * i, b = a + 1, c = i + 1 < COUNT ? a + 2 : 1, d = i + 1 < COUNT ? a + 3 : 0;
        mesh_add_triangle(&m, a, b, d);
        mesh_add_triangle(&m, a, d, c);
    }
    ovoid_solid *s = mesh_make_solid(&m);
    CHECK_EQ(ovoid_solid_get_report(s).is_closed, 0);
    CHECK_EQ(ovoid_solid_get_report(s).components, 1);
    ovoid_solid_destroy(s);
    mesh_clear(&m);
}

static void check_refused(const double *xyz, size_t points, const uint32_t *indices, size_t count, ovoid_code code,
                          int64_t place) {
    ovoid_error error = {OVOID_OK, -1, ""};
    CHECK(ovoid_solid_create_from_triangles(&(ovoid_triangles){xyz, points, indices, count}, NULL, &error) == NULL);
    CHECK_EQ(error.code, code);
    CHECK_EQ(error.place, place);
    CHECK(error.message[0] != 0);
}

static void check_bad_input(void) {
    const uint32_t beyond[6] = {0, 1, 2, 0, 1, 8};
    double bad[24];
    check_refused(NULL, 8, cube, 12, OVOID_ERROR_ARGUMENT, -1);
    check_refused(corners, 8, NULL, 12, OVOID_ERROR_ARGUMENT, -1);
    check_refused(corners, 8, cube, 0, OVOID_ERROR_EMPTY, -1);
    check_refused(corners, 8, cube, OVOID_SOLID_TRIANGLES_MAX + 1, OVOID_ERROR_LIMIT, -1);
    check_refused(corners, SIZE_MAX / 8, cube, 12, OVOID_ERROR_LIMIT, -1);
    check_refused(corners, 8, beyond, 2, OVOID_ERROR_INDEX, 1);
    const double values[4] = {NAN, INFINITY, -INFINITY, 1.1e50};
    for (int i = 0; i < 4; i++) {
        memcpy(bad, corners, sizeof bad);
        bad[17] = values[i];
        check_refused(bad, 8, cube, 12, i < 3 ? OVOID_ERROR_NOT_FINITE : OVOID_ERROR_RANGE, 5);
    }
    countdown memory = {0, 0};
    ovoid_allocator allocator = countdown_make_allocator(&memory);
    long k = 0;
    for (ovoid_solid *s = NULL; !s && k < 100; k++) {
        ovoid_error error = {OVOID_OK, -1, ""};
        memory = (countdown){k, 0};
        s = ovoid_solid_create_from_triangles(&(ovoid_triangles){corners, 8, cube, 12},
                                              &(ovoid_solid_options){&allocator}, &error);
        CHECK_EQ(memory.held, s ? 1 : 0);
        if (!s) CHECK_EQ(error.code, OVOID_ERROR_MEMORY);
        if (s) CHECK_EQ(ovoid_solid_get_size(s) % 64, 0);
        if (s) ovoid_solid_destroy(s), k = 1000;
    }
    CHECK(k >= 1000);
    CHECK_EQ(memory.held, 0);
}

// Points around random solids; truth by solid angles.
static void check_windings(void) {
    long inside = 0;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        uint64_t s = check_seed = seed;
        mesh m = {NULL, NULL, 0, 0, 0, 0};
        double scale = seed % 3 == 0 ? 1e-100 : seed % 3 == 1 ? 1 : 1e49;
        mesh_add_random(&m, scale, &s);
        // On a grid of halves many points are straight beside edges and corners.
        if (seed % 2)
            for (size_t i = 0; i < 3 * m.points; i++) m.xyz[i] = round(m.xyz[i] / scale * 4) / 4 * scale;
        ovoid_solid *solid = mesh_make_solid(&m);
        ovoid_pose here = ovoid_pose_make_identity();
        long3 *t = long_place_mesh(&m, &here);
        for (size_t i = 0; i < 3 * m.triangles; i++) t[i] = (long3){t[i].x / scale, t[i].y / scale, t[i].z / scale};
        for (int i = 0; i < 60; i++) {
            ovoid_vec3 p = random_vec3(&s, 1.2);
            if (seed % 2) p = (ovoid_vec3){round(p.x * 8) / 8, round(p.y * 4) / 4, round(p.z * 4) / 4};
            long double truth = long_winding(t, m.triangles, (long3){p.x, p.y, p.z});
            int64_t winding = 99;
            int found =
                ovoid_solid_compute_winding(solid, (ovoid_vec3){p.x * scale, p.y * scale, p.z * scale}, &winding);
            // On the surface solid angles are no whole numbers, or anything.
            if (found && fabsl(truth - roundl(truth)) < 1e-6L) CHECK_EQ((double)winding, (double)roundl(truth));
            inside += found && winding != 0;
            if (!(seed % 2)) CHECK_EQ(found, 1);
        }
        free(t);
        ovoid_solid_destroy(solid);
        mesh_clear(&m);
    }
    check_seed = 0;
    CHECK(inside > 50);
}

static void fill(double *to, size_t count, double scale, uint64_t *s) {
    for (size_t i = 0; i < count; i++)
        to[i] = random_next(s) % 8 ? scale * random_uniform(s, -1, 1) : scale * (double)(random_next(s) % 3);
}

static void check_kernels(void) {
    const solid8_kernels *scalar = solid8_get_kernels_of(SIMD_SCALAR);
    for (uint64_t seed = 1; seed <= 2000; seed++) {
        uint64_t s = check_seed = seed;
        double scale = pow(10, random_uniform(&s, -20, 20)), lower[8], wanted[8];
        solid8_triangle one;
        solid8_triangles eight;
        solid8_other other;
        box8 node;
        fill((double *)&one, sizeof one / sizeof(double), scale, &s);
        fill((double *)&eight, sizeof eight / sizeof(double), scale, &s);
        fill((double *)&other, sizeof other / sizeof(double), 1, &s);
        if (seed % 2) one.enough = INFINITY;
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 8; i++) {
                node.low[k][i] = (float)random_uniform(&s, -1, 1);
                node.high[k][i] = node.low[k][i] + (float)random_uniform(&s, 0, 1);
            }
        solid8_gaps truth, found;
        scalar->triangles(&one, &eight, &truth);
        scalar->boxes(&node, &other, wanted);
        for (int isa = 0; isa < SIMD_ISA_COUNT; isa++) {
            const solid8_kernels *k = solid8_get_kernels_of((simd_isa)isa);
            if (!k) continue;
            k->boxes(&node, &other, lower);
            CHECK(memcmp(lower, wanted, sizeof lower) == 0);
            // With directions alone, fewer lanes look for nearest points: then only the search is the same in all.
            k->triangles(&one, &eight, &found);
            if (seed % 2) CHECK(memcmp(&found, &truth, sizeof found) == 0);
        }
    }
    check_seed = 0;
}

// Triangles on the scale of 1e-300 beside those of 1, and bodies of nothing but such ones: true brackets or a refusal.
static void check_slivers(void) {
    const double xyz[18] = {0, 0, 0, 1, 0, 0, 0, 1e-300, 0, 0, 0, 0, 1e-300, 0, 0, 0, 0, 1e-300};
    const uint32_t t[6] = {0, 1, 2, 3, 4, 5};
    ovoid_solid *s = ovoid_solid_create_from_triangles(&(ovoid_triangles){xyz, 6, t, 2}, NULL, NULL);
    ovoid_solid *tiny = ovoid_solid_create_from_triangles(&(ovoid_triangles){xyz, 6, t + 3, 1}, NULL, NULL);
    ovoid_exclusion items[16];
    ovoid_exclusions all = {.items = items, .capacity = 16};
    ovoid_error error;
    for (int i = 0; i < 2; i++) {
        ovoid_body_pair pair = {{.solid = i ? tiny : s, .pose = ovoid_pose_make_identity()},
                                {.solid = tiny, .pose = {{0.5, 0, 0.25}, {1, 2, 3, 4}}}};
        ovoid_body_answer x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        CHECK_EQ(x.status, OVOID_SEPARATED);
        CHECK_NEAR(x.lower, i ? sqrt(0.3125) : 0.25, 1e-9);
        CHECK_EQ(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, &error), OVOID_OK);
        pair.b.pose.position = (ovoid_vec3){0, 0, 0};
        x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        CHECK(x.lower <= 0 && x.upper >= 0 && x.status != OVOID_SEPARATED);
        CHECK_EQ(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, &error), OVOID_OK);
    }
    ovoid_solid_destroy(s);
    ovoid_solid_destroy(tiny);
}

// Altered answers must not pass, and queries refuse what no body is.
static void check_altered(void) {
    ovoid_solid *s = make_cube(12);
    static ovoid_exclusion items[4096];
    ovoid_exclusions all = {.items = items, .capacity = 4096};
    ovoid_body_pair pair = {{.solid = s, .pose = ovoid_pose_make_identity()},
                            {.solid = s, .pose = {{2.5, 0.25, 0.125}, {9, 1, 2, 3}}}};
    const ovoid_body_answer x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    CHECK_EQ(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_OK);
    ovoid_body_answer y = x;
    y.lower = y.deciding.lower += 1e-6, y.upper = y.deciding.upper += 1e-6;
    CHECK_EQ(ovoid_body_verify(&pair, &y, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_ERROR_PROOF);
    y = x, y.upper = y.deciding.upper -= 1e-6, y.lower = y.deciding.lower -= 1e-6;
    CHECK_EQ(ovoid_body_verify(&pair, &y, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_ERROR_PROOF);
    y = x, y.lower += 1e-12;
    CHECK_EQ(ovoid_body_verify(&pair, &y, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_ERROR_PROOF);
    y = x, y.status = OVOID_OVERLAPPING, y.upper = -x.lower, y.lower = -9, y.inside = OVOID_BODY_A_INSIDE;
    y.parting = x.deciding.normal;
    CHECK_EQ(ovoid_body_verify(&pair, &y, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_ERROR_PROOF);
    y = x, y.part_a = 12;
    CHECK_EQ(ovoid_body_verify(&pair, &y, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_ERROR_PROOF);
    for (size_t i = 0; i < all.count; i++) {
        // Without one of them there is a hole; with more than it shows it is refused.
        ovoid_exclusion kept = items[i], last = items[all.count - 1];
        items[i].lower += 1e-3 + fabs(items[i].lower);
        CHECK_EQ(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_ERROR_PROOF);
        items[i] = kept;
        memmove(items + i, items + i + 1, (all.count - i - 1) * sizeof *items);
        all.count--;
        CHECK_EQ(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_ERROR_PROOF);
        all.count++;
        memmove(items + i + 1, items + i, (all.count - i - 1) * sizeof *items);
        items[i] = kept;
        items[all.count - 1] = i + 1 == all.count ? kept : last;
    }
    CHECK_EQ(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_OK);

    // One in the other: not apart, and not deeper than the surfaces and the boxes show.
    ovoid_shape *ball = ovoid_shape_create_sphere(0.125, NULL, NULL);
    pair.b = (ovoid_body){.shape = ball, .pose = {{0.5, 0.5, 0.5}, {1, 0, 0, 0}}};
    const ovoid_body_answer in = ovoid_body_collide(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    CHECK_EQ(in.status, OVOID_OVERLAPPING);
    CHECK_EQ(in.inside, OVOID_BODY_B_INSIDE);
    CHECK_EQ(ovoid_body_verify(&pair, &in, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_OK);
    y = in, y.status = OVOID_SEPARATED, y.lower = in.deciding.lower, y.upper = in.deciding.upper;
    CHECK_EQ(ovoid_body_verify(&pair, &y, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_ERROR_PROOF);
    y = in, y.upper *= 1.01;
    CHECK_EQ(ovoid_body_verify(&pair, &y, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_ERROR_PROOF);
    y = in, y.lower *= 0.99;
    CHECK_EQ(ovoid_body_verify(&pair, &y, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_ERROR_PROOF);

    ovoid_body_pair bad = pair;
    bad.a.shape = ball;
    CHECK_EQ(ovoid_body_distance(&bad, NULL, NULL).limit, OVOID_LIMIT_SHAPE_A);
    bad = pair, bad.b.shape = NULL;
    CHECK_EQ(ovoid_body_collide(&bad, NULL, NULL).limit, OVOID_LIMIT_SHAPE_B);
    bad = pair, bad.b.pose.rotation = (ovoid_quat){0, 0, 0, 0};
    const ovoid_body_answer none = ovoid_body_collide(&bad, NULL, &(ovoid_body_evidence){.exclusions = &all});
    CHECK_EQ(none.limit, OVOID_LIMIT_POSE_B);
    CHECK_EQ(ovoid_body_verify(&bad, &none, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_OK);
    CHECK_EQ(ovoid_body_within(&pair, -1, NULL, NULL).limit, OVOID_LIMIT_OPTIONS);
    ovoid_shape_destroy(ball);
    ovoid_solid_destroy(s);
}

// A prism over a triangle whose top is that much above its bottom, at any scale and place: flat below a thickness of
// 2^-40.
static void check_flat(void) {
    static const double scales[] = {1, 1e-60, 1e40, 1e-100}, heights[] = {0, 1e-18, -1e-13, 1e-11, 0.5};
    static const uint32_t faces[] = {0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 5; k++) {
            double s = scales[i], h = heights[k] * s;
            const double points[] = {0, 0, 0, s, 0, 0, 0, s, 0, 0, 0, h, s, 0, h, 0, s, h};
            ovoid_solid *solid = ovoid_solid_create_from_triangles(&(ovoid_triangles){points, 6, faces, 8}, NULL, NULL);
            ovoid_solid *open = ovoid_solid_create_from_triangles(&(ovoid_triangles){points, 6, faces, 7}, NULL, NULL);
            if (!CHECK(solid && open)) return;
            CHECK_EQ(ovoid_solid_get_report(solid).is_flat, k < 3);
            CHECK(ovoid_solid_get_report(solid).is_closed);
            if (h != 0) CHECK(!ovoid_solid_get_report(open).is_closed && !ovoid_solid_get_report(open).is_flat);
            ovoid_solid_destroy(solid);
            ovoid_solid_destroy(open);
        }
}

int main(void) {
    check_reports();
    check_flat();
    check_strip();
    check_bad_input();
    check_windings();
    check_kernels();
    check_slivers();
    check_altered();
    return check_end();
}
