// The exact sign of an orientation: a filter in doubles, one in double-double, then Shewchuk expansions of the full
// determinant. Planes across or along an axis are seen from the coordinates.
// J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates, 1997.
#include "linear/exact.h"

// An expansion: components of increasing magnitude, nonoverlapping, whose sum is the number.
typedef struct expansion {
    int count;
    double part[192];
} expansion;

// e + b, exactly (GROW-EXPANSION, zeros dropped).
static void expansion_grow(expansion *e, double b) {
    int count = 0;
    for (int i = 0; i < e->count; i++) {
        dd s = two_sum(b, e->part[i]);
        if (s.low != 0) e->part[count++] = s.low;
        b = s.high;
    }
    if (b != 0) e->part[count++] = b;
    e->count = count;
}

// e + s f g h for exact two-part factors: the sum of all products of parts, each exact.
static void expansion_add_product(expansion *e, dd f, dd g, dd h, double s) {
    double fs[2] = {s * f.high, s * f.low}, gs[2] = {g.high, g.low}, hs[2] = {h.high, h.low};
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            if (fs[i] == 0 || gs[j] == 0) continue;
            dd fg = two_product(fs[i], gs[j]);
            for (int k = 0; k < 2; k++) {
                if (hs[k] == 0) continue;
                dd p = two_product(fg.high, hs[k]), q = two_product(fg.low, hs[k]);
                expansion_grow(e, q.low);
                expansion_grow(e, q.high);
                expansion_grow(e, p.low);
                expansion_grow(e, p.high);
            }
        }
}

static int sign_exact(vec3 a, vec3 b, vec3 c, vec3 d) {
    dd ax = two_sum(a.x, -d.x), ay = two_sum(a.y, -d.y), az = two_sum(a.z, -d.z);
    dd bx = two_sum(b.x, -d.x), by = two_sum(b.y, -d.y), bz = two_sum(b.z, -d.z);
    dd cx = two_sum(c.x, -d.x), cy = two_sum(c.y, -d.y), cz = two_sum(c.z, -d.z);
    expansion e = {0, {0}};
    expansion_add_product(&e, ax, by, cz, 1);
    expansion_add_product(&e, ay, bz, cx, 1);
    expansion_add_product(&e, az, bx, cy, 1);
    expansion_add_product(&e, az, by, cx, -1);
    expansion_add_product(&e, ay, bx, cz, -1);
    expansion_add_product(&e, ax, bz, cy, -1);
    if (e.count == 0) return 0;
    double top = e.part[e.count - 1];
    return (top > 0) - (top < 0);
}

// The sign in double-double; 0 if rounding may hide it. The differences are exact; 5 operations follow for each of
// the 6 products, each within 2^-102 of their sizes, so 2^-97 of the permanent is a bound; products that underflow are
// left to the expansions.
static int sign_double_double(vec3 a, vec3 b, vec3 c, vec3 d, double permanent) {
    dd ax = two_sum(a.x, -d.x), ay = two_sum(a.y, -d.y), az = two_sum(a.z, -d.z);
    dd bx = two_sum(b.x, -d.x), by = two_sum(b.y, -d.y), bz = two_sum(b.z, -d.z);
    dd cx = two_sum(c.x, -d.x), cy = two_sum(c.y, -d.y), cz = two_sum(c.z, -d.z);
    dd x = dd_mul(ax, dd_sub(dd_mul(by, cz), dd_mul(bz, cy)));
    dd y = dd_mul(ay, dd_sub(dd_mul(bz, cx), dd_mul(bx, cz)));
    dd z = dd_mul(az, dd_sub(dd_mul(bx, cy), dd_mul(by, cx)));
    double det = dd_add(dd_add(x, y), z).high, bound = 0x1p-96 * permanent + 1e-270;
    return (det > bound) - (-det > bound);
}

// Points that agree in one coordinate lie in a plane across its axis. Points that are pairwise above one another along
// an axis, as the corners of a prism's side are, lie in a plane along it. Boxes, prisms and cylinders have many of
// both, whose signs neither filter finds.
static int is_along(vec3 a, vec3 b, int axis) {
    return (axis == 0 || a.x == b.x) && (axis == 1 || a.y == b.y) && (axis == 2 || a.z == b.z);
}

static int is_in_axis_plane(vec3 a, vec3 b, vec3 c, vec3 d) {
    if (a.x == d.x && b.x == d.x && c.x == d.x) return 1;
    if (a.y == d.y && b.y == d.y && c.y == d.y) return 1;
    if (a.z == d.z && b.z == d.z && c.z == d.z) return 1;
    for (int axis = 0; axis < 3; axis++) {
        if (is_along(a, d, axis) && is_along(b, c, axis)) return 1;
        if (is_along(b, d, axis) && is_along(a, c, axis)) return 1;
        if (is_along(c, d, axis) && is_along(a, b, axis)) return 1;
    }
    return 0;
}

int orient3d_sign(vec3 a, vec3 b, vec3 c, vec3 d) {
    vec3 p = vec3_sub(a, d), q = vec3_sub(b, d), r = vec3_sub(c, d);
    double yz = fabs(q.y * r.z) + fabs(q.z * r.y), zx = fabs(q.z * r.x) + fabs(q.x * r.z);
    double xy = fabs(q.x * r.y) + fabs(q.y * r.x);
    double det = vec3_dot(p, vec3_cross(q, r));
    // Shewchuk's bound (7 + 56 u) u on the permanent, rounded up.
    double permanent = fabs(p.x) * yz + fabs(p.y) * zx + fabs(p.z) * xy, bound = 8e-16 * permanent;
    if (det > bound) return 1;
    if (-det > bound) return -1;
    if (is_in_axis_plane(a, b, c, d)) return 0;
    int sign = sign_double_double(a, b, c, d, permanent);
    return sign ? sign : sign_exact(a, b, c, d);
}
