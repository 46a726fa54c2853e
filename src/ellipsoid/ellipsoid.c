// The ellipsoid as a value: radii, volume, and what a pose makes of it.
#include "ovoid/ellipsoid.h"

#include "ellipsoid/factor.h"
#include "linear/rotation.h"

ovoid_vec3 ovoid_ellipsoid_compute_radii(const ovoid_ellipsoid *ellipsoid) {
    eigen3 e = sym3_compute_eigen(ellipsoid->q);
    return vec3_make(sqrt(fmax(e.value[2], 0)), sqrt(fmax(e.value[1], 0)), sqrt(fmax(e.value[0], 0)));
}

double ovoid_ellipsoid_compute_volume(const ovoid_ellipsoid *ellipsoid) {
    sym3dd q = sym3dd_from(ellipsoid->q);
    return ball_get_measure(3) * sym3dd_compute_content(&q, 3);
}

ovoid_ellipsoid ovoid_ellipsoid_compute_posed(const ovoid_ellipsoid *ellipsoid, const ovoid_pose *pose) {
    mat3 r = quat_to_mat3(pose->rotation);
    return (ovoid_ellipsoid){vec3_add(pose->position, mat3_mul_vec3(r, ellipsoid->center)),
                             sym3_rotate(ellipsoid->q, r)};
}
