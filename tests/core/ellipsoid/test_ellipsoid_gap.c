// The proven gap of two ellipsoids along a direction is never more than the exact one. Truth: double-double (2^-102),
// of the exact unit vector along n; ellipsoids of every kind, and points, whose gap is a sum of three products.
#include "check.h"
#include "ellipsoid/distance/gap.h"
#include "linear/dd3.h"

// sqrt(n'Qn) in double-double; only its first digits matter where it is nearly nothing.
static dd spread(sym3 q, vec3 n) {
    dd3 m = dd3_from(n);
    const dd form[6] = {dd_mul(dd_mul(m.x, m.x), dd_from(q.xx)),     dd_mul(dd_mul(m.x, m.y), dd_from(2 * q.xy)),
                        dd_mul(dd_mul(m.x, m.z), dd_from(2 * q.xz)), dd_mul(dd_mul(m.y, m.y), dd_from(q.yy)),
                        dd_mul(dd_mul(m.y, m.z), dd_from(2 * q.yz)), dd_mul(dd_mul(m.z, m.z), dd_from(q.zz))};
    dd sum = {0, 0};
    for (int i = 0; i < 6; i++) sum = dd_add(sum, form[i]);
    return dd_sqrt(sum);
}

static dd gap_of(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b, vec3 n) {
    dd3 d = {two_sum(b->center.x, -a->center.x), two_sum(b->center.y, -a->center.y),
             two_sum(b->center.z, -a->center.z)};
    dd gap = dd_sub(dd_sub(dd3_dot(dd3_from(n), d), spread(a->q, n)), spread(b->q, n));
    return dd_div(gap, dd3_norm(dd3_from(n)));
}

static vec3 random_vec3(uint64_t *s) {
    double x = random_normal(s), y = random_normal(s), z = random_normal(s);
    return (vec3){x, y, z};
}

// A sum of three squares of vectors, of lengths down to a thousandth; none where `thin` says so.
static ovoid_ellipsoid make_ellipsoid(uint64_t *s) {
    ovoid_ellipsoid e = {random_vec3(s), {0, 0, 0, 0, 0, 0}};
    uint64_t kind = random_next(s) % 4;
    double scale = kind == 3 ? 1e-9 : 1;
    for (uint64_t i = 0; i < (kind == 0 ? 0 : 3); i++)
        e.q = sym3_add(e.q, sym3_outer(random_vec3(s), scale * (kind == 1 ? 1 : 1e-3)));
    return e;
}

int main(void) {
    double widest = 0;
    for (uint64_t seed = 0; seed < 200000; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_ellipsoid a = make_ellipsoid(&s), b = make_ellipsoid(&s);
        if (seed % 5 == 0) b.center = vec3_scale(b.center, 1e6);
        // Also directions along which there is next to nothing: a sum of large terms.
        vec3 n = vec3_unit(random_vec3(&s));
        if (seed % 3 == 0) n = vec3_unit(vec3_cross(random_vec3(&s), vec3_sub(b.center, a.center)));
        double proven = ellipsoids_compute_gap(&a, &b, n);
        dd rest = dd_sub(gap_of(&a, &b, n), dd_from(proven));
        double size = vec3_norm(vec3_sub(b.center, a.center)) + sqrt(sym3_trace(a.q)) + sqrt(sym3_trace(b.q));
        CHECK_LE(0, rest.high);
        widest = fmax(widest, rest.high / size);
    }
    printf("at most %.2g of the size is given away\n", widest);
    CHECK_LE(widest, 1e-7);
    return check_end();
}
