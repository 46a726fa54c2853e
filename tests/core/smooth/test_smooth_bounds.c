// The steps of the smooth bracket by themselves. Truth: the root of an ellipsoid against its matrix in long double; an
// upper bound of two overlapping ellipsoids' largest gap against the gaps of many directions, from each of which a
// search climbs: none may be above the bound, wherever the bound was found.
#include "check.h"
#include "extended.h"

#include "smooth/smooth.h"

static vec3 random_vec3(uint64_t *s) {
    double x = random_normal(s), y = random_normal(s);
    return (vec3){x, y, random_normal(s)};
}

// A matrix with radii from 1 down to `thin`.
static sym3 make_matrix(uint64_t *s, double thin) {
    vec3 e0 = vec3_unit(random_vec3(s)), e1 = vec3_orthogonal(e0), e2 = vec3_cross(e0, e1);
    double r = exp(random_uniform(s, log(thin), 0)), t = exp(random_uniform(s, log(thin), 0));
    return sym3_add(sym3_outer(e0, 1), sym3_add(sym3_outer(e1, r * r), sym3_outer(e2, t * t)));
}

static long double compute_spread(sym3 q, extended3 n) {
    return sqrtl(q.xx * n.x * n.x + q.yy * n.y * n.y + q.zz * n.z * n.z +
                 2 * (q.xy * n.x * n.y + q.xz * n.x * n.z + q.yz * n.y * n.z));
}

// No support is farther from the matrix' own than the pad.
static void check_root(uint64_t seed) {
    uint64_t s = check_seed = seed;
    sym3 q = make_matrix(&s, seed % 3 ? 0.05 : 1e-6);
    mat3 none = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    smooth_body x = smooth_body_make(&(ovoid_ellipsoid){{0, 0, 0}, q}, &none, 1);
    for (int k = 0; k < 40; k++) {
        extended3 n = extended3_from(vec3_unit(random_vec3(&s)));
        long double sum = 0;
        for (int i = 0; i < 3; i++) {
            long double p = extended3_dot(extended3_from(x.root.axis[i]), n);
            sum += p * p;
        }
        CHECK(fabsl(sqrtl(sum) - compute_spread(q, n)) <= x.pad + 1e3 * EXTENDED_ROUNDING);
    }
}

static smooth_pair make_pair(uint64_t *s, double thin) {
    mat3 none = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    smooth_pair p = {.unit = 1, .size = 4};
    p.a = smooth_body_make(&(ovoid_ellipsoid){{0, 0, 0}, make_matrix(s, thin)}, &none, 1);
    p.b = smooth_body_make(&(ovoid_ellipsoid){{0, 0, 0}, make_matrix(s, thin)}, &none, 1);
    p.d = vec3_scale(random_vec3(s), 0.3);
    p.claim = 192 * 0x1p-53 * p.size;
    return p;
}

// Overlapping: local tops of the gap are many, the bound is of the highest.
static void check_bounds(uint64_t seed) {
    enum { STARTS = 60 };
    uint64_t s = check_seed = seed;
    smooth_pair p = make_pair(&s, 0.1);
    smooth_state tops[STARTS];
    double highest = -INFINITY;
    for (int k = 0; k < STARTS; k++) {
        (void)smooth_climb(&p, vec3_unit(random_vec3(&s)), &tops[k]);
        highest = max2(highest, tops[k].gap);
    }
    if (!(highest < 0)) return;
    for (int k = 0; k < STARTS; k++) CHECK_LE(highest, smooth_compute_bound(&p, &tops[k]));
    vec3 n;
    uint32_t steps = 0;
    double grown = smooth_grow(&p, &n, &steps);
    CHECK_LE(highest, grown);
    // Each is worth something: the hull's is near, and that of the highest top is mostly there.
    CHECK_LE(grown - highest, 1e-6);
}

int main(void) {
    for (uint64_t seed = 1; EXTENDED && seed <= 400; seed++) check_root(seed);
    for (uint64_t seed = 1; seed <= 300; seed++) check_bounds(seed);
    if (!EXTENDED) check_skip("long double has no more digits than double here");
    return check_end();
}
