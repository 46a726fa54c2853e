// The ellipsoid as a value: radii, volume, and the ellipsoid under a pose.
#include "ovoid/ellipsoid.h"

#include "base/environment.h"
#include "ellipsoid/factor.h"
#include "linear/rotation.h"

// In eigenvalues of Q rounding loses those far below the largest; they are recomputed as the largest of Q^-1 = W' W.
static void improve_small(sym3 q, double square[3]) {
    factor f;
    if (!factor_make(q, &f) || f.count < 3) return;
    double h[3][3] = {{0}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) h[i][j] += f.w[k][i] * f.w[k][j] * f.scale[i] * f.scale[j];
    eigen3 e = sym3_compute_eigen((sym3){h[0][0], h[0][1], h[0][2], h[1][1], h[1][2], h[2][2]});
    square[0] = 1 / e.value[2];
    // The middle one is nearer to the largest or to the smallest.
    if (square[1] < sqrt(square[0]) * sqrt(square[2])) square[1] = 1 / e.value[1];
    square[1] = fmin(fmax(square[1], square[0]), square[2]);
}

static ovoid_vec3 compute_radii(const ovoid_ellipsoid *ellipsoid) {
    eigen3 e = sym3_compute_eigen(ellipsoid->q);
    improve_small(ellipsoid->q, e.value);
    return vec3_make(sqrt(fmax(e.value[2], 0)), sqrt(fmax(e.value[1], 0)), sqrt(fmax(e.value[0], 0)));
}

ovoid_vec3 ovoid_ellipsoid_compute_radii(const ovoid_ellipsoid *ellipsoid) {
    ENVIRONMENT_RETURN(ovoid_vec3, ellipsoid, compute_radii(ellipsoid));
}

static double compute_volume(const ovoid_ellipsoid *ellipsoid) {
    sym3dd q = sym3dd_from(ellipsoid->q);
    return ball_get_measure(3) * sym3dd_compute_content(&q, 3, NULL);
}

double ovoid_ellipsoid_compute_volume(const ovoid_ellipsoid *ellipsoid) {
    ENVIRONMENT_RETURN(double, ellipsoid, compute_volume(ellipsoid));
}

static ovoid_ellipsoid compute_posed(const ovoid_ellipsoid *ellipsoid, const ovoid_pose *pose) {
    mat3 r = quat_to_mat3(pose->rotation);
    return (ovoid_ellipsoid){vec3_add(pose->position, mat3_mul_vec3(r, ellipsoid->center)),
                             sym3_rotate(ellipsoid->q, r)};
}

ovoid_ellipsoid ovoid_ellipsoid_compute_posed(const ovoid_ellipsoid *ellipsoid, const ovoid_pose *pose) {
    ENVIRONMENT_RETURN(ovoid_ellipsoid, ellipsoid, compute_posed(ellipsoid, pose));
}
