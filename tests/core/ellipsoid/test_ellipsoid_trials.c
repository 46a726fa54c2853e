// All offline steps on random bodies of six kinds, mapped by random affine maps to needles and slabs in any direction,
// and on real hulls. Truth: the promises themselves (gap, containment), John's theorem between outer and inner, and
// that no phase of the paper beats the proven bound of the largest inscribed ellipsoid.
#include "ellipsoid/contain.h"
#include "ovoid/shape.h"
#include "polytopes.h"

// Points of kind: 0 on a sphere, 1 with a long tail, 2 on two rings far apart, 3 near the corners of a 3 x 2 grid, 4
// spread over decades, 5 normal. All but the sphere's have many interior ones, or optima that are flat in the weights.
static vec3 make_point(uint32_t kind, uint32_t k, uint64_t *s) {
    vec3 p = vec3_random(s), unit = vec3_unit(p);
    switch (kind) {
    case 0: return unit;
    case 1: return vec3_make(p.x * p.x * p.x, p.y, p.z);
    case 2: return vec3_make(unit.x, unit.y, unit.z * 1e-3 + (k % 2 ? 1 : -1));
    case 3: return vec3_add_scaled(vec3_make(k % 3, k % 2, 0), p, 1e-4);
    case 4: return vec3_make(exp(p.x), exp(p.y), p.z);
    default: return p;
    }
}

static made make_body(uint32_t trial, uint64_t *s) {
    double xyz[3 * 54], thin = pow(10, -random_uniform(s, 0, 4));
    uint32_t count = 4 + trial % 50;
    for (uint32_t k = 0; k < count; k++) {
        vec3 p = make_point(trial % 6, k, s);
        memcpy(xyz + 3 * k, &p, sizeof p);
    }
    made m = made_hull(xyz, count);
    mat3 before = mat3_random_rotation(s), after = mat3_random_rotation(s);
    mat3 map = mat3_mul(after, mat3_mul(mat3_diagonal(1, trial % 2 ? thin : 1, thin), before));
    made_map(&m, map, vec3_random(s));
    return m;
}

// All steps of one body; the share of the largest volume that the three phases reach.
static double check_steps(const ovoid_polytope *p) {
    ovoid_fit outer, inner, phase;
    CHECK_EQ(ovoid_ellipsoid_compute_outer(p, NULL, &outer, NULL), OVOID_OK);
    CHECK_EQ(ovoid_ellipsoid_compute_inner(p, NULL, &inner, NULL), OVOID_OK);
    CHECK(ellipsoid_is_enclosing(p, &outer.ellipsoid));
    // Below an aspect of 1e7, doubles hold ellipsoids of any direction to 1e-6.
    vec3 radii = ovoid_ellipsoid_compute_radii(&outer.ellipsoid);
    if (p->rank < 3 || radii.x < 1e7 * radii.z) {
        CHECK_LE(outer.gap, 1e-6);
        CHECK_LE(inner.gap, 1e-6);
    }
    if (p->rank < 3) return 1;
    CHECK(ellipsoid_is_enclosed(p, &inner.ellipsoid));
    CHECK_LE(outer.volume / (1 + outer.gap), 27 * inner.volume * (1 + inner.gap));
    phase = ovoid_ellipsoid_compute_shrunk(p, &outer.ellipsoid);
    CHECK(ellipsoid_is_enclosed(p, &phase.ellipsoid));
    phase = ovoid_ellipsoid_compute_stretched(p, &phase.ellipsoid);
    CHECK(ellipsoid_is_enclosed(p, &phase.ellipsoid));
    phase = ovoid_ellipsoid_compute_enlarged(p, &phase.ellipsoid);
    CHECK(ellipsoid_is_enclosed(p, &phase.ellipsoid));
    CHECK_LE(phase.volume, inner.volume * (1 + inner.gap));
    return phase.volume / inner.volume;
}

static void check_random(void) {
    for (uint32_t trial = 0; trial < 600; trial++) {
        uint64_t s = check_seed = 1 + trial * (uint64_t)7919;
        made m = make_body(trial, &s);
        (void)check_steps(&m.p);
        made_destroy(&m);
    }
    check_seed = 0;
}

// Real hulls of games, every fourth: records of a count and that many points of floats.
static void check_real(void) {
    const char *folder = check_data_folder();
    char path[1024];
    if (folder) (void)snprintf(path, sizeof path, "%s/pieces/game_hulls.bin", folder);
    FILE *file = folder ? fopen(path, "rb") : NULL;
    if (!file) {
        check_skip("no real hulls: the folder of data is absent");
        return;
    }
    double share = 0, bodies = 0;
    uint32_t count;
    for (uint32_t record = 0; fread(&count, sizeof count, 1, file) == 1; record++) {
        float *points = malloc(3 * sizeof(float) * count);
        double *xyz = malloc(3 * sizeof(double) * count);
        if (fread(points, 3 * sizeof(float), count, file) != count) count = 0;
        for (uint32_t i = 0; i < 3 * count; i++) xyz[i] = points[i];
        ovoid_error error;
        ovoid_shape *shape = record % 4 ? NULL : ovoid_shape_create_from_points(xyz, count, NULL, &error);
        CHECK(record % 4 || shape);
        if (shape) {
            check_seed = record;
            ovoid_polytope p = ovoid_shape_get_polytope(shape);
            share += check_steps(&p);
            bodies++;
        }
        ovoid_shape_destroy(shape);
        free(points);
        free(xyz);
    }
    check_seed = 0;
    (void)fclose(file);
    printf("%.0f real hulls: the three phases reach %.1f %% of the largest volume on average\n", bodies,
           100 * share / bodies);
}

int main(void) {
    check_random();
    check_real();
    return check_end();
}
