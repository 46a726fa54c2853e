// The offline steps give the same bits with every compiler, level of optimisation and machine of IEEE doubles: a hash
// of results, made with gcc 12 at -O3. Inputs come from integers, sums, products and square roots alone, since libm's
// other functions may differ. A change of any step's arithmetic changes the number; then take the one printed, after a
// look at the other tests.
#include "polytopes.h"

#include "ovoid/ellipsoid.h"

static uint64_t hash = 14695981039346656037u;

// FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo, 1991).
static void add(const void *data, size_t size) {
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++) hash = (hash ^ bytes[i]) * 1099511628211u;
}

static void add_fit(const ovoid_fit *fit) {
    add(&fit->ellipsoid, sizeof fit->ellipsoid);
    add(&fit->volume, sizeof fit->volume);
    if (!isnan(fit->gap)) add(&fit->gap, sizeof fit->gap);
}

static vec3 random_point(uint64_t *s) {
    vec3 p;
    p.x = random_uniform(s, -1, 1);
    p.y = random_uniform(s, -1, 1);
    p.z = random_uniform(s, -1, 1);
    return p;
}

static made make_body(uint32_t trial, uint64_t *s) {
    double xyz[3 * 64], thin = 1;
    for (uint32_t k = 0; k < 8 + trial; k++) {
        vec3 p = trial % 2 ? vec3_unit(random_point(s)) : random_point(s);
        memcpy(xyz + 3 * k, &p, sizeof p);
    }
    for (uint32_t k = 0; k < trial % 8; k++) thin *= 0.125;
    made m = made_hull(xyz, 8 + trial);
    vec3 p = random_point(s);
    mat3 r = quat_to_mat3((ovoid_quat){0.3, p.x, p.y, p.z});
    made_map(&m, mat3_mul(r, mat3_diagonal(1, trial % 3 ? thin : 1, thin)), random_point(s));
    return m;
}

int main(void) {
    for (uint32_t trial = 0; trial < 40; trial++) {
        uint64_t s = trial;
        made m = make_body(trial, &s);
        ovoid_fit fit;
        (void)ovoid_ellipsoid_compute_outer(&m.p, NULL, &fit, NULL);
        add_fit(&fit);
        fit = ovoid_ellipsoid_compute_shrunk(&m.p, &fit.ellipsoid);
        fit = ovoid_ellipsoid_compute_stretched(&m.p, &fit.ellipsoid);
        fit = ovoid_ellipsoid_compute_enlarged(&m.p, &fit.ellipsoid);
        add_fit(&fit);
        (void)ovoid_ellipsoid_compute_inner(&m.p, NULL, &fit, NULL);
        add_fit(&fit);
        ovoid_vec3 radii = ovoid_ellipsoid_compute_radii(&fit.ellipsoid);
        add(&radii, sizeof radii);
        made_destroy(&m);
    }
    if (!CHECK(hash == 0x968456e9fef2adb5u)) printf("hash %016llx\n", (unsigned long long)hash);
    return check_end();
}
