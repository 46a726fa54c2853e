// The eight facial areas as seen from the centre of the inner ellipsoid (W.-K. Su, J.-S. Liu, I-F. Chen, Enhancing
// Collision Detection Method Based on Enclosed Ellipsoid by Facial Areas Splitting), by the signs of the coordinates in
// sphere space, x' = Q^-1/2 (x - c) with the symmetric root. The root comes from Q and the ellipsoid's radii by the
// theorem of Cayley and Hamilton (A. Hoger, D. E. Carlson, Determination of the stretch and rotation in the polar
// decomposition of the deformation gradient, 1984). For a picture: signs within rounding of 0 may be either.
#include "page/areas.h"

/// The least ratio of the radii of an ellipsoid with octants.
#define FLAT 1e-6

page_areas page_areas_make(const ovoid_shape *shape) {
    ovoid_ellipsoid e = ovoid_shape_get_inner(shape).ellipsoid;
    ovoid_vec3 r = ovoid_ellipsoid_compute_radii(&e);
    page_areas areas = {.center = e.center};
    if (!(r.z > FLAT * r.x)) return areas;
    areas.is_there = 1;
    // In units of the longest radius, so that no product over- or underflows.
    const double x = 1, y = r.y / r.x, z = r.z / r.x, f = 1 / r.x / r.x;
    const double q[9] = {f * e.q.xx, f * e.q.xy, f * e.q.xz, f * e.q.xy, f * e.q.yy,
                         f * e.q.yz, f * e.q.xz, f * e.q.yz, f * e.q.zz};
    const double i1 = x + y + z, i2 = x * y + y * z + z * x, i3 = x * y * z;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            // Q^1/2 = (i1 i3 I + (i1^2 - i2) Q - Q^2) / (i1 i2 - i3), and i3 Q^-1/2 = Q - i1 Q^1/2 + i2 I.
            double one = i == k, square = 0;
            for (int m = 0; m < 3; m++) square += q[3 * i + m] * q[3 * m + k];
            double root = (i1 * i3 * one + (i1 * i1 - i2) * q[3 * i + k] - square) / (i1 * i2 - i3);
            areas.root[3 * i + k] = q[3 * i + k] - i1 * root + i2 * one;
        }
    return areas;
}

unsigned page_areas_get_octant(const page_areas *areas, ovoid_vec3 point) {
    const ovoid_vec3 u = {point.x - areas->center.x, point.y - areas->center.y, point.z - areas->center.z};
    unsigned octant = 0;
    for (unsigned i = 0; i < 3; i++) {
        const double *row = areas->root + 3 * i;
        octant |= (unsigned)(row[0] * u.x + row[1] * u.y + row[2] * u.z < 0) << i;
    }
    return octant;
}
