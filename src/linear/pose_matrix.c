// Poses from rotation matrices, from an axis and an angle, and matrices from poses.
//
// Matrix to quaternion: of all rotations the one nearest to M in the Frobenius norm has the quaternion q that maximises
// q' K(M) q, the leading eigenvector of a symmetric 4x4 matrix linear in M (P. B. Davenport, A vector approach to the
// algebra of rotations with applications, 1968; I. Y. Bar-Itzhack, New method for extracting the quaternion from a
// rotation matrix, 2000). For a rotation K + 1 is 4 q q', so each of its columns is q, scaled; the one with the largest
// diagonal entry is the safe one (S. W. Shepperd, Quaternion from rotation matrix, 1978; F. L. Markley, Unit quaternion
// from rotation matrix, 2008). That column is multiplied by K + 1 three more times, the power method.
//
// Error, with u = 2^-53 and t = OVOID_ROTATION_TOLERANCE. If no entry of M'M - 1 is above t, |M - R| <= 1.5 t (1 +
// t) in the operator norm for the nearest rotation R, so K + 1 is off 4 q q' by at most 2 sqrt(3) 1.5 t < 5.3 t: the
// power method gains a factor 5.3 t / 3.9 a step and starts within 2.7 t, hence ends within 7e-20. Rounding of K + 1: 9
// u an entry of the diagonal, 2 u beside it, together below 20 u, which turns the eigenvector by 20 u / 3.9. The last
// step: 4 u of each component; the division: u. Together 10.2 u of q, hence 21 u of the rotation.
#include "base/environment.h"
#include "base/error.h"
#include "linear/pose.h"
#include "linear/rotation.h"

/// K + 1 for a matrix, in the order w, x, y, z.
typedef struct quat_form {
    double e[4][4];
} quat_form;

static quat_form quat_form_make(const double *m) {
    double xx = m[0], yy = m[4], zz = m[8];
    double wx = m[7] - m[5], wy = m[2] - m[6], wz = m[3] - m[1];
    double xy = m[1] + m[3], xz = m[2] + m[6], yz = m[5] + m[7];
    return (quat_form){{{1 + xx + yy + zz, wx, wy, wz},
                        {wx, 1 + xx - yy - zz, xy, xz},
                        {wy, xy, 1 - xx + yy - zz, yz},
                        {wz, xz, yz, 1 - xx - yy + zz}}};
}

static void quat_form_multiply(const quat_form *form, double q[4]) {
    double p[4];
    for (int i = 0; i < 4; i++) {
        const double *row = form->e[i];
        p[i] = (row[0] * q[0] + row[1] * q[1]) + (row[2] * q[2] + row[3] * q[3]);
    }
    for (int i = 0; i < 4; i++) q[i] = p[i];
}

/// The quaternion of the rotation nearest to m: unit to rounding, w >= 0.
static ovoid_quat compute_nearest_rotation(const double *m) {
    quat_form form = quat_form_make(m);
    int best = 0;
    for (int i = 1; i < 4; i++)
        if (form.e[i][i] > form.e[best][best]) best = i;
    double q[4];
    for (int i = 0; i < 4; i++) q[i] = form.e[i][best];
    for (int step = 0; step < 3; step++) quat_form_multiply(&form, q);
    double norm = sqrt(quat_norm_squared((ovoid_quat){q[0], q[1], q[2], q[3]}));
    if (q[0] < 0) norm = -norm;
    return (ovoid_quat){q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm};
}

/// The largest entry of |M'M - 1|; NaN or infinity if a product overflows.
static double compute_deviation(const double *m) {
    double largest = 0;
    for (int i = 0; i < 3; i++) {
        for (int j = i; j < 3; j++) {
            double entry = fabs((m[i] * m[j] + m[3 + i] * m[3 + j]) + m[6 + i] * m[6 + j] - (i == j));
            if (!(entry <= largest)) largest = entry;
        }
    }
    return largest;
}

static double compute_determinant(const double *m) {
    return vec3_dot(vec3_at(m, 0), vec3_cross(vec3_at(m, 1), vec3_at(m, 2)));
}

static ovoid_code refuse_entry(int i, ovoid_error *error) {
    return error_set(error, OVOID_ERROR_NOT_FINITE, i, "entry %d of the matrix is not finite", i);
}

ovoid_code pose_make_matrix(const double *m, ovoid_vec3 position, ovoid_pose *pose, ovoid_error *error) {
    for (int i = 0; i < 9; i++)
        if (!isfinite(m[i]))
            return error_set(error, OVOID_ERROR_NOT_FINITE, i, "entry %d of the matrix is not finite", i);
    double deviation = compute_deviation(m);
    if (!(deviation <= OVOID_ROTATION_TOLERANCE))
        return error_set(
            error, OVOID_ERROR_ROTATION, -1,
            "the matrix is no rotation: its columns are not orthogonal unit vectors, an entry of M'M is off "
            "by %.3g; take scale and shear out of it",
            deviation);
    if (compute_determinant(m) < 0)
        return error_set(error, OVOID_ERROR_ROTATION, -1,
                         "the matrix is a reflection: its determinant is -1; one axis is turned over");
    ovoid_pose made = {position, compute_nearest_rotation(m)};
    ovoid_code code = pose_validate(&made);
    if (code == OVOID_ERROR_NOT_FINITE) return error_set(error, code, -1, "the position is not finite");
    if (code == OVOID_ERROR_RANGE) return error_set(error, code, -1, "the position is above %g", OVOID_LENGTH_MAX);
    *pose = made;
    return OVOID_OK;
}

ovoid_code ovoid_pose_make_matrix(const double matrix[9], ovoid_vec3 position, ovoid_pose *pose, ovoid_error *error) {
    if (!matrix || !pose) return error_set(error, OVOID_ERROR_ARGUMENT, -1, "matrix and pose must not be NULL");
    ENVIRONMENT_RETURN(ovoid_code, position, pose_make_matrix(matrix, position, pose, error));
}

static ovoid_code make_transform(const double *m, ovoid_pose *pose, ovoid_error *error) {
    for (int i = 0; i < 16; i++)
        if (!isfinite(m[i])) return refuse_entry(i, error);
    if (!(m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1))
        return error_set(
            error, OVOID_ERROR_ROTATION, -1,
            "the last row of the matrix is %g %g %g %g, not 0 0 0 1: not stored row by row, or no rigid motion", m[12],
            m[13], m[14], m[15]);
    const double rotation[9] = {m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]};
    return pose_make_matrix(rotation, (vec3){m[3], m[7], m[11]}, pose, error);
}

ovoid_code ovoid_pose_make_transform(const double matrix[16], ovoid_pose *pose, ovoid_error *error) {
    if (!matrix || !pose) return error_set(error, OVOID_ERROR_ARGUMENT, -1, "matrix and pose must not be NULL");
    ENVIRONMENT_RETURN(ovoid_code, matrix, make_transform(matrix, pose, error));
}

// With n = unit(axis): its direction is off by 2 u, its length by 4.5 u; the sine and the cosine by an ulp each. So q
// is turned by at most half of the 9.5 u in which w and the rest differ, and 2 u: 7 u, hence 14 u of the rotation.
static ovoid_code make_axis_angle(ovoid_vec3 position, ovoid_vec3 axis, double angle, ovoid_pose *pose) {
    if (!vec3_is_finite(axis) || !isfinite(angle)) return OVOID_ERROR_NOT_FINITE;
    vec3 n = vec3_scale(vec3_unit(axis), sin(angle / 2));
    if (vec3_max_abs(axis) == 0) return OVOID_ERROR_ROTATION;
    ovoid_pose made = {position, {cos(angle / 2), n.x, n.y, n.z}};
    ovoid_code code = pose_validate(&made);
    if (code == OVOID_OK) *pose = made;
    return code;
}

ovoid_code ovoid_pose_make_axis_angle(ovoid_vec3 position, ovoid_vec3 axis, double angle, ovoid_pose *pose) {
    if (!pose) return OVOID_ERROR_ARGUMENT;
    ENVIRONMENT_RETURN(ovoid_code, axis, make_axis_angle(position, axis, angle, pose));
}

void ovoid_pose_compute_matrix(const ovoid_pose *pose, double matrix[9]) {
    environment before = environment_enter();
    mat3 m = quat_to_mat3(pose->rotation);
    const vec3 rows[3] = {m.r0, m.r1, m.r2};
    for (int i = 0; i < 3; i++) {
        matrix[3 * i] = rows[i].x;
        matrix[3 * i + 1] = rows[i].y;
        matrix[3 * i + 2] = rows[i].z;
    }
    environment_hide(*matrix);
    environment_leave(before);
}

void ovoid_pose_compute_transform(const ovoid_pose *pose, double matrix[16]) {
    double rotation[9];
    ovoid_pose_compute_matrix(pose, rotation);
    const double position[3] = {pose->position.x, pose->position.y, pose->position.z};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) matrix[4 * i + j] = rotation[3 * i + j];
        matrix[4 * i + 3] = position[i];
        matrix[12 + i] = 0;
    }
    matrix[15] = 1;
}
