// The contact function of two ellipsoids. J. W. Perram and M. S. Wertheim, Statistical mechanics of hard ellipsoids I:
// overlap algorithm and the contact function, 1985; I. Gilitschenski and U. D. Hanebeck, A robust computational test
// for overlap of two arbitrary-dimensional ellipsoids in fault-detection of Kalman filters, 2012.
//
// For s in (0, 1) let G = (1 - s) Qa + s Qb, G v = d = cb - ca. The point x = ca + (1 - s) Qa v = cb - s Qb v has
//     (x - ca)' Qa^-1 (x - ca) = (1 - s)^2 v' Qa v = ma,    (x - cb)' Qb^-1 (x - cb) = s^2 v' Qb v = mb,
// and minimises s ma(x) + (1 - s) mb(x), whose value there is F(s) = s (1 - s) d' v = s ma + (1 - s) mb. So one solve
// gives two answers: F(s) > 1 shows that no point is in both, ma, mb <= 1 that x is. F is concave with slope ma - mb,
// so at its maximum ma = mb = F: the only third case is touching. No matrix is inverted, so one of the two may be flat.
// Cost: one evaluation for most pairs (30 ns), two or three near contact, where Newton's method runs inside a bracket.
#include "ellipsoid/distance/pencil.h"

int ldl3_make(sym3 q, ldl3 *f) {
    if (!(q.xx > 0)) return 0;
    f->r0 = 1 / q.xx;
    f->l10 = q.xy * f->r0;
    f->l20 = q.xz * f->r0;
    double d1 = q.yy - f->l10 * q.xy, e = q.yz - f->l10 * q.xz;
    if (!(d1 > 0)) return 0;
    f->r1 = 1 / d1;
    f->l21 = e * f->r1;
    double d2 = (q.zz - f->l20 * q.xz) - f->l21 * e;
    if (!(d2 > 0)) return 0;
    f->r2 = 1 / d2;
    return 1;
}

vec3 ldl3_solve(const ldl3 *f, vec3 b) {
    double y1 = b.y - f->l10 * b.x, y2 = (b.z - f->l20 * b.x) - f->l21 * y1;
    double z = y2 * f->r2, y = y1 * f->r1 - f->l21 * z;
    return (vec3){(b.x * f->r0 - f->l10 * y) - f->l20 * z, y, z};
}

pencil pencil_search(sym3 qa, sym3 qb, vec3 d) {
    // Start at the ratio of the two radii along the line of centres.
    double sa = sqrt(max2(sym3_quadratic(qa, d), 0)), sb = sqrt(max2(sym3_quadratic(qb, d), 0));
    double low = 0, high = 1, s = sa + sb > 0 ? min2(max2(sa / (sa + sb), 1e-6), 1 - 1e-6) : 0.5;
    pencil r = {s, {0, 0, 0}, 0, 0, PENCIL_TOUCHING};

    for (int round = 0; round < 20; round++) {
        double t = 1 - s;
        ldl3 f;
        if (!ldl3_make(sym3_add(sym3_scale(qa, t), sym3_scale(qb, s)), &f)) return r;
        r.s = s;
        r.v = ldl3_solve(&f, d);
        vec3 ua = sym3_mul_vec3(qa, r.v), ub = sym3_mul_vec3(qb, r.v);
        double alpha = vec3_dot(r.v, ua), beta = vec3_dot(r.v, ub);
        r.ma = t * t * alpha;
        r.mb = s * s * beta;
        r.state = s * r.ma + t * r.mb > 1 ? PENCIL_APART : r.ma < 1 && r.mb < 1 ? PENCIL_COMMON : PENCIL_TOUCHING;
        // A point well inside both is easier to prove than one near the surface, so a few more rounds look for one.
        if (r.state == PENCIL_APART || max2(r.ma, r.mb) <= 0.999) return r;

        // Newton's step for (1 - s) sqrt(alpha) = s sqrt(beta), kept in the bracket.
        double ra = sqrt(alpha), rb = sqrt(beta), slope = t * ra - s * rb;
        if (slope > 0)
            low = s;
        else
            high = s;
        vec3 turn = ldl3_solve(&f, vec3_sub(ub, ua));
        double change = (s * vec3_dot(turn, ub) / rb - t * vec3_dot(turn, ua) / ra) - (ra + rb);
        double step = slope / change, next = s - step;
        if (fabs(step) <= 1e-15 * min2(s, t)) return r;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        s = next;
    }
    return r;
}
