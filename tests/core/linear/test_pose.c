// Poses from rotation matrices, from axis and angle, and back. Truth: rotations of quaternions in double-double (off by
// 2^-96), Rodrigues' formula in long double (off by 2^-60), matrices whose rotation is known exactly, and of matrices
// that are off what the nearest rotation R is known by: R'M is symmetric and positive definite.
#include "check.h"
#include "linear/dd3.h"

static const double u = 0x1p-53;

/// Two rotations whose difference is a turn by a have a difference of norm a and of Frobenius norm sqrt(2) a.
static double distance_of(const double *a, const dd33 *b) {
    const dd rows[9] = {b->r0.x, b->r0.y, b->r0.z, b->r1.x, b->r1.y, b->r1.z, b->r2.x, b->r2.y, b->r2.z};
    double sum = 0;
    for (int i = 0; i < 9; i++) {
        double d = dd_sub(dd_from(a[i]), rows[i]).high;
        sum += d * d;
    }
    return sqrt(sum);
}
static double distance_of_rotations(const dd33 *a, const dd33 *b) {
    const dd3 d[3] = {dd3_sub(a->r0, b->r0), dd3_sub(a->r1, b->r1), dd3_sub(a->r2, b->r2)};
    double sum = 0;
    for (int i = 0; i < 3; i++) sum += vec3_norm_squared(dd3_high(d[i]));
    return sqrt(sum);
}
static void round_rows(const dd33 *r, double m[9]) {
    const vec3 rows[3] = {dd3_high(r->r0), dd3_high(r->r1), dd3_high(r->r2)};
    memcpy(m, rows, sizeof rows);
}
static dd33 exact_rotation(const ovoid_pose *pose) { return dd33_from_quat(quat_scaled(pose->rotation)); }

// A quaternion of every kind: any, one component far the largest, nearly half a turn, with zeros, with ties.
static ovoid_quat make_quaternion(int i, uint64_t *s) {
    double q[4];
    for (int k = 0; k < 4; k++) q[k] = random_normal(s);
    if (i % 4 == 1) q[(i / 4) % 4] *= 1e6;
    if (i % 4 == 2) q[0] *= pow(10, random_uniform(s, -20, -3));
    if (i % 4 == 3)
        for (int k = 0; k < 4; k++) q[k] = (double)(random_next(s) % 3) - 1;
    if (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0) q[i / 4 % 4] = 1;
    return (ovoid_quat){q[0], q[1], q[2], q[3]};
}

// The rounded matrix of an exact rotation: it is off by half an ulp an entry, the rotation by that and 24 u; and the
// matrix of a pose is off by 12 u an entry.
static void check_round_trip(void) {
    uint64_t s = 5;
    int branches[4] = {0};
    for (int i = 0; i < 40000; i++) {
        check_seed = s;
        ovoid_pose pose = {{i, -1, 2}, make_quaternion(i, &s)}, made;
        double m[9], back[9], transform[16];
        dd33 exact = exact_rotation(&pose);
        round_rows(&exact, m);
        CHECK_EQ(ovoid_pose_make_matrix(m, pose.position, &made, NULL), OVOID_OK);
        dd33 got = exact_rotation(&made);
        CHECK_LE(distance_of_rotations(&got, &exact), sqrt(2) * 24 * u + distance_of(m, &exact));
        const ovoid_quat q = made.rotation;
        CHECK_NEAR(sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z), 1, 6 * u);
        CHECK(q.w >= 0 && made.position.x == i && made.position.y == -1 && made.position.z == 2);
        const double size[4] = {fabs(q.w), fabs(q.x), fabs(q.y), fabs(q.z)};
        for (int k = 0; k < 4; k++) branches[k] += size[k] > 0.9;
        ovoid_pose_compute_matrix(&pose, back);
        for (int k = 0; k < 9; k++) CHECK_LE(fabs(back[k] - m[k]), 13 * u);
        ovoid_pose_compute_transform(&pose, transform);
        for (int k = 0; k < 9; k++) CHECK_EQ(transform[4 * (k / 3) + k % 3], back[k]);
        CHECK(transform[3] == i && transform[7] == -1 && transform[11] == 2);
        CHECK(transform[12] == 0 && transform[13] == 0 && transform[14] == 0 && transform[15] == 1);
        ovoid_pose whole;
        CHECK_EQ(ovoid_pose_make_transform(transform, &whole, NULL), OVOID_OK);
        CHECK_EQ(ovoid_pose_make_matrix(back, pose.position, &made, NULL), OVOID_OK);
        CHECK(memcmp(&whole, &made, sizeof whole) == 0);
    }
    check_seed = 0;
    for (int k = 0; k < 4; k++) CHECK_LE(1000, branches[k]);
}

static void expect_quaternion(const double m[9], double w, double x, double y, double z) {
    ovoid_pose pose;
    CHECK_EQ(ovoid_pose_make_matrix(m, (vec3){0, 0, 0}, &pose, NULL), OVOID_OK);
    CHECK(pose.rotation.w == w && pose.rotation.x == x && pose.rotation.y == y && pose.rotation.z == z);
}

// Rotations whose quaternion is exact in doubles: none, half a turn about each axis and about a diagonal of the third
// kind, a third of a turn about the main diagonal, which moves the axes on by one.
static void check_exact(void) {
    expect_quaternion((double[9]){1, 0, 0, 0, 1, 0, 0, 0, 1}, 1, 0, 0, 0);
    expect_quaternion((double[9]){1, 0, 0, 0, -1, 0, 0, 0, -1}, 0, 1, 0, 0);
    expect_quaternion((double[9]){-1, 0, 0, 0, 1, 0, 0, 0, -1}, 0, 0, 1, 0);
    expect_quaternion((double[9]){-1, 0, 0, 0, -1, 0, 0, 0, 1}, 0, 0, 0, 1);
    expect_quaternion((double[9]){0, 0, 1, 1, 0, 0, 0, 1, 0}, 0.5, 0.5, 0.5, 0.5);
    expect_quaternion((double[9]){0, 1, 0, 0, 0, 1, 1, 0, 0}, 0.5, -0.5, -0.5, -0.5);
    // A quarter turn about z takes x to y: the sense of rotation, and rows, not columns.
    ovoid_pose pose;
    CHECK_EQ(ovoid_pose_make_matrix((double[9]){0, -1, 0, 1, 0, 0, 0, 0, 1}, (vec3){5, 0, 0}, &pose, NULL), OVOID_OK);
    ovoid_vec3 to = ovoid_pose_compute_point(&pose, (vec3){1, 0, 0});
    CHECK_NEAR(to.x, 5, 1e-15);
    CHECK_NEAR(to.y, 1, 1e-15);
}

// Matrices that are off by up to the tolerance: R'M is symmetric to what R is off, and its diagonal is near 1.
static void check_nearest(void) {
    uint64_t s = 9;
    int taken = 0;
    for (int i = 0; i < 20000; i++) {
        check_seed = s;
        ovoid_pose pose = {{0, 0, 0}, make_quaternion(i, &s)};
        double m[9], largest = pow(10, random_uniform(&s, -12, -5));
        dd33 exact = exact_rotation(&pose);
        round_rows(&exact, m);
        for (int k = 0; k < 9; k++) m[k] += largest * random_uniform(&s, -1, 1);
        if (ovoid_pose_make_matrix(m, pose.position, &pose, NULL) != OVOID_OK) continue;
        taken++;
        dd33 r = exact_rotation(&pose);
        const dd3 rows[3] = {r.r0, r.r1, r.r2};
        dd product[3][3] = {{{0, 0}}};
        for (int k = 0; k < 3; k++) {
            const dd of_row[3] = {rows[k].x, rows[k].y, rows[k].z};
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++)
                    product[a][b] = dd_add(product[a][b], dd_mul_double(of_row[a], m[3 * k + b]));
        }
        for (int a = 0; a < 3; a++) {
            CHECK_NEAR(product[a][a].high, 1, 2e-5);
            // A turn by 24 u about an axis makes up to twice that of asymmetry.
            CHECK_LE(fabs(dd_sub(product[a][(a + 1) % 3], product[(a + 1) % 3][a]).high), 2 * 24.01 * u);
        }
    }
    check_seed = 0;
    CHECK_LE(15000, taken);
    // Matrices in single precision, and with six digits, are taken.
    for (int i = 0; i < 2000; i++) {
        ovoid_pose pose = {{0, 0, 0}, make_quaternion(i, &s)};
        double m[9], single[9], text[9];
        ovoid_pose_compute_matrix(&pose, m);
        for (int k = 0; k < 9; k++) {
            single[k] = (float)m[k];
            text[k] = round(m[k] * 1e6) / 1e6;
        }
        CHECK_EQ(ovoid_pose_make_matrix(single, pose.position, &pose, NULL), OVOID_OK);
        CHECK_EQ(ovoid_pose_make_matrix(text, pose.position, &pose, NULL), OVOID_OK);
    }
}

static void expect_refusal(const double *m, int size, vec3 position, ovoid_code code, int place, const char *word) {
    ovoid_error error = {0};
    ovoid_pose pose = {{7, 7, 7}, {7, 7, 7, 7}}, before = pose;
    ovoid_code got =
        size == 9 ? ovoid_pose_make_matrix(m, position, &pose, &error) : ovoid_pose_make_transform(m, &pose, &error);
    CHECK_EQ(got, code);
    CHECK_EQ(error.code, code);
    CHECK_EQ(error.place, place);
    CHECK(strstr(error.message, word) != NULL);
    CHECK(memcmp(&pose, &before, sizeof pose) == 0);
}

// What is refused, with which code, place and word.
static void check_refused(void) {
    const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const vec3 zero = {0, 0, 0};
    double m[9];
    for (int k = 0; k < 9; k++) {
        memcpy(m, one, sizeof m);
        m[k] = k % 2 ? NAN : INFINITY;
        expect_refusal(m, 9, zero, OVOID_ERROR_NOT_FINITE, k, "not finite");
        memcpy(m, one, sizeof m);
        m[k] += 1.1e-5; // on the diagonal M'M is off by twice that, beside it by once
        expect_refusal(m, 9, zero, OVOID_ERROR_ROTATION, -1, "orthogonal");
        m[k] = 1e200;
        expect_refusal(m, 9, zero, OVOID_ERROR_ROTATION, -1, "orthogonal");
    }
    expect_refusal((double[9]){1, 0, 0, 0, 1, 0, 0, 0, -1}, 9, zero, OVOID_ERROR_ROTATION, -1, "reflection");
    expect_refusal((double[9]){0, 1, 0, 1, 0, 0, 0, 0, 1}, 9, zero, OVOID_ERROR_ROTATION, -1, "reflection");
    expect_refusal((double[9]){0}, 9, zero, OVOID_ERROR_ROTATION, -1, "orthogonal");
    expect_refusal(one, 9, (vec3){0, NAN, 0}, OVOID_ERROR_NOT_FINITE, -1, "position");
    expect_refusal(one, 9, (vec3){0, 0, 2e50}, OVOID_ERROR_RANGE, -1, "position");
    expect_refusal(NULL, 9, zero, OVOID_ERROR_ARGUMENT, -1, "NULL");
    expect_refusal(NULL, 16, zero, OVOID_ERROR_ARGUMENT, -1, "NULL");
    CHECK_EQ(ovoid_pose_make_matrix(one, zero, NULL, NULL), OVOID_ERROR_ARGUMENT);
    // By columns the position comes last.
    expect_refusal((double[16]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}, 16, zero, OVOID_ERROR_ROTATION, -1,
                   "1 2 3 1");
    expect_refusal((double[16]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2}, 16, zero, OVOID_ERROR_ROTATION, -1,
                   "last row");
    expect_refusal((double[16]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, NAN, 0, 1}, 16, zero, OVOID_ERROR_NOT_FINITE, 13,
                   "entry 13");
    expect_refusal((double[16]){1, 0, 0, INFINITY, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, 16, zero,
                   OVOID_ERROR_NOT_FINITE, 3, "entry 3");
}

/// Rodrigues, 1840: R = 1 + sin a [n] + (1 - cos a) [n]^2, in long double; the difference to the pose's rotation.
static double compare_rodrigues(const ovoid_pose *pose, vec3 axis, double angle) {
    long double x = axis.x, y = axis.y, z = axis.z;
    long double scale = fmaxl(fabsl(x), fmaxl(fabsl(y), fabsl(z)));
    x /= scale, y /= scale, z /= scale;
    long double norm = sqrtl(x * x + y * y + z * z), sine = sinl(angle),
                versine = 2 * sinl(angle / 2) * sinl(angle / 2);
    x /= norm, y /= norm, z /= norm;
    const long double truth[9] = {
        1 - versine * (y * y + z * z), versine * x * y - sine * z,    versine * x * z + sine * y,
        versine * x * y + sine * z,    1 - versine * (x * x + z * z), versine * y * z - sine * x,
        versine * x * z - sine * y,    versine * y * z + sine * x,    1 - versine * (x * x + y * y)};
    dd33 r = exact_rotation(pose);
    const dd rows[9] = {r.r0.x, r.r0.y, r.r0.z, r.r1.x, r.r1.y, r.r1.z, r.r2.x, r.r2.y, r.r2.z};
    long double sum = 0;
    for (int i = 0; i < 9; i++) {
        long double d = ((long double)rows[i].high - truth[i]) + rows[i].low;
        sum += d * d;
    }
    return (double)sqrtl(sum);
}

// Any axis, of any length; angles small, any, near half a turn and many turns.
static void check_axis_angle(void) {
    uint64_t s = 13;
    for (int i = 0; i < 40000; i++) {
        check_seed = s;
        double length = pow(10, i % 3 ? random_uniform(&s, -3, 3) : random_uniform(&s, -300, 300));
        vec3 axis = {length * random_normal(&s), length * random_normal(&s), length * random_normal(&s)};
        double angle = random_uniform(&s, -7, 7);
        if (i % 4 == 1) angle *= pow(10, random_uniform(&s, -20, 0));
        if (i % 4 == 2) angle = 3.141592653589793 + pow(10, random_uniform(&s, -16, -2));
        if (i % 4 == 3) angle *= 1000;
        ovoid_pose pose;
        CHECK_EQ(ovoid_pose_make_axis_angle((vec3){1, 2, 3}, axis, angle, &pose), OVOID_OK);
        CHECK_LE(compare_rodrigues(&pose, axis, angle), sqrt(2) * 16 * u);
        CHECK(pose.position.x == 1 && pose.position.y == 2 && pose.position.z == 3);
    }
    check_seed = 0;
    ovoid_pose pose = {{7, 7, 7}, {7, 7, 7, 7}}, before = pose;
    const vec3 zero = {0, 0, 0}, z = {0, 0, 3};
    CHECK_EQ(ovoid_pose_make_axis_angle(zero, zero, 1, &pose), OVOID_ERROR_ROTATION);
    CHECK_EQ(ovoid_pose_make_axis_angle(zero, (vec3){0, NAN, 0}, 1, &pose), OVOID_ERROR_NOT_FINITE);
    CHECK_EQ(ovoid_pose_make_axis_angle(zero, z, INFINITY, &pose), OVOID_ERROR_NOT_FINITE);
    CHECK_EQ(ovoid_pose_make_axis_angle((vec3){NAN, 0, 0}, z, 1, &pose), OVOID_ERROR_NOT_FINITE);
    CHECK_EQ(ovoid_pose_make_axis_angle((vec3){2e50, 0, 0}, z, 1, &pose), OVOID_ERROR_RANGE);
    CHECK_EQ(ovoid_pose_make_axis_angle(zero, z, 1, NULL), OVOID_ERROR_ARGUMENT);
    CHECK(memcmp(&pose, &before, sizeof pose) == 0);
    // A quarter turn about z, closed form; the same as rpy's.
    CHECK_EQ(ovoid_pose_make_axis_angle(zero, z, 1.5707963267948966, &pose), OVOID_OK);
    CHECK_NEAR(pose.rotation.w, sqrt(0.5), u);
    CHECK_NEAR(pose.rotation.z, sqrt(0.5), u);
}

int main(void) {
    check_round_trip();
    check_exact();
    check_nearest();
    check_refused();
    check_axis_angle();
    return check_end();
}
