// All offline steps on random bodies of six kinds, mapped by random affine maps to needles and slabs in any direction.
// Truth: the promises themselves (gap, containment), John's theorem between outer and inner, and that no phase of the
// paper beats the proven bound of the largest inscribed ellipsoid.
#include "ellipsoid/contain.h"
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

int main(void) {
    for (uint32_t trial = 0; trial < 600; trial++) {
        uint64_t s = check_seed = 1 + trial * (uint64_t)7919;
        made m = make_body(trial, &s);
        ovoid_fit outer, inner, phase;
        CHECK_EQ(ovoid_ellipsoid_compute_outer(&m.p, 0, &outer, NULL), OVOID_OK);
        CHECK_EQ(ovoid_ellipsoid_compute_inner(&m.p, 0, &inner, NULL), OVOID_OK);
        CHECK(ellipsoid_is_enclosing(&m.p, &outer.ellipsoid));
        CHECK(ellipsoid_is_enclosed(&m.p, &inner.ellipsoid));
        // Below an aspect of 1e7, doubles hold ellipsoids of any direction to 1e-6.
        vec3 radii = ovoid_ellipsoid_compute_radii(&outer.ellipsoid);
        if (radii.x < 1e7 * radii.z) {
            CHECK_LE(outer.gap, 1e-6);
            CHECK_LE(inner.gap, 1e-6);
        }
        CHECK_LE(outer.volume / (1 + outer.gap), 27 * inner.volume * (1 + inner.gap));
        phase = ovoid_ellipsoid_compute_shrunk(&m.p, &outer.ellipsoid);
        CHECK(ellipsoid_is_enclosed(&m.p, &phase.ellipsoid));
        phase = ovoid_ellipsoid_compute_stretched(&m.p, &phase.ellipsoid);
        CHECK(ellipsoid_is_enclosed(&m.p, &phase.ellipsoid));
        phase = ovoid_ellipsoid_compute_enlarged(&m.p, &phase.ellipsoid);
        CHECK(ellipsoid_is_enclosed(&m.p, &phase.ellipsoid));
        CHECK_LE(phase.volume, inner.volume * (1 + inner.gap));
        made_destroy(&m);
    }
    check_seed = 0;
    return check_end();
}
