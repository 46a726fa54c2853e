// Step (e) of the paper: the points X* and Y* of two ellipsoids by the map that makes the first the unit sphere. W.-K.
// Su, J.-S. Liu, I-F. Chen, Enhancing Collision Detection Method Based on Enclosed Ellipsoid by Facial Areas Splitting,
// section 3.2.
//
// The paper maps x' = M^(1/2) (x - ca), M = Qa^-1. Any other factor, x' = E^-1 (x - ca) with Qa = E E', differs from
// that by a rotation of the sphere's space and gives the same X* and Y*; here it is Cholesky's, which needs no
// eigenvalues. There b is an ellipsoid about z = E^-1 (cb - ca) with Q' = E^-1 Qb E'^-1. Its point y nearest to the
// sphere's centre and the sphere's point y / |y| are mapped back. So X*, Y* and ca lie on one line: they are not the
// Euclidean closest points, and |X* Y*| is only an upper bound of the distance. But a and b share a point if and only
// if |y| <= 1, and the plane perpendicular to y, which separates sphere and b', maps back to one whose normal is E'^-1
// y: a lower bound that is positive whenever the ellipsoids are apart. Cost: one 3x3 eigenproblem.
#include "base/environment.h"
#include "ellipsoid/distance/gap.h"

/// Lower triangular E with E E' = Q.
typedef struct cholesky3 {
    double xx, yx, yy, zx, zy, zz;
} cholesky3;

/// 0 if Q is so thin (radii 1 : 1e-5) that the map would lose half the digits, or flat.
static int cholesky3_make(sym3 q, cholesky3 *e) {
    double least = 1e-10 * sym3_trace(q);
    if (!(q.xx > least)) return 0;
    e->xx = sqrt(q.xx);
    e->yx = q.xy / e->xx;
    e->zx = q.xz / e->xx;
    double yy = q.yy - e->yx * e->yx;
    if (!(yy > least)) return 0;
    e->yy = sqrt(yy);
    e->zy = (q.yz - e->yx * e->zx) / e->yy;
    double zz = (q.zz - e->zx * e->zx) - e->zy * e->zy;
    if (!(zz > least)) return 0;
    e->zz = sqrt(zz);
    return 1;
}

/// E p
static vec3 map_back(const cholesky3 *e, vec3 p) {
    return (vec3){e->xx * p.x, e->yx * p.x + e->yy * p.y, (e->zx * p.x + e->zy * p.y) + e->zz * p.z};
}
/// E^-1 x
static vec3 map_to_sphere(const cholesky3 *e, vec3 x) {
    double px = x.x / e->xx, py = (x.y - e->yx * px) / e->yy;
    return (vec3){px, py, ((x.z - e->zx * px) - e->zy * py) / e->zz};
}
/// E'^-1 n
static vec3 map_normal_back(const cholesky3 *e, vec3 n) {
    double z = n.z / e->zz, y = (n.y - e->zy * z) / e->yy;
    return (vec3){((n.x - e->yx * y) - e->zx * z) / e->xx, y, z};
}

/// E^-1 Q E'^-1: columns first, then rows.
static sym3 map_form(const cholesky3 *e, sym3 q) {
    vec3 c0 = map_to_sphere(e, (vec3){q.xx, q.xy, q.xz}), c1 = map_to_sphere(e, (vec3){q.xy, q.yy, q.yz}),
         c2 = map_to_sphere(e, (vec3){q.xz, q.yz, q.zz});
    vec3 r0 = map_to_sphere(e, (vec3){c0.x, c1.x, c2.x}), r1 = map_to_sphere(e, (vec3){c0.y, c1.y, c2.y}),
         r2 = map_to_sphere(e, (vec3){c0.z, c1.z, c2.z});
    return (sym3){r0.x, r0.y, r0.z, r1.y, r1.z, r2.z};
}

static ovoid_nearest compute_nearest_by_sphere(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b) {
    scaled_pair p = ellipsoids_make_scaled(a, b);
    cholesky3 e;
    if (!cholesky3_make(p.qa, &e)) return ovoid_ellipsoid_compute_nearest(a, b);

    // The nearest point of the mapped b to the sphere's centre.
    ovoid_ellipsoid mapped = {map_to_sphere(&e, p.d), map_form(&e, p.qb)};
    ovoid_nearest in_sphere = ovoid_ellipsoid_compute_nearest_to_point(&mapped, (vec3){0, 0, 0});
    vec3 y = in_sphere.point_a;
    double length = vec3_norm(y);

    // The sphere's point on the same line; y itself, if it is in the sphere.
    ovoid_nearest r = {.iterations = in_sphere.iterations, .overlap = length <= 1};
    vec3 x = r.overlap ? y : vec3_scale(y, 1 / length);
    r.point_a = vec3_add_scaled(a->center, map_back(&e, x), p.unit);
    r.point_b = r.overlap ? r.point_a : vec3_add_scaled(a->center, map_back(&e, y), p.unit);

    // The separating plane; if y is the sphere's centre, the direction to the other centre is used.
    r.normal = vec3_unit(map_normal_back(&e, length > 0 ? y : mapped.center));
    if (!(vec3_norm_squared(r.normal) > 0)) r.normal = (vec3){1, 0, 0};
    r.distance = vec3_norm(vec3_sub(r.point_b, r.point_a));
    r.lower = fmin(ellipsoids_compute_gap(a, b, r.normal), r.distance);
    return r;
}

ovoid_nearest ovoid_ellipsoid_compute_nearest_by_sphere(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b) {
    ENVIRONMENT_RETURN(ovoid_nearest, a, compute_nearest_by_sphere(a, b));
}
