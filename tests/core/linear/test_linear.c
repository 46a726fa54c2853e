// The linear floor against closed forms and identities.
#include "check.h"
#include "linear/dd3.h"
#include "linear/exact.h"
#include "linear/mat3.h"
#include "linear/rotation.h"

// Eigenvalues of Q = R D R' are D to rounding of the largest.
// All orders of three numbers, equal ones among them: the first of the largest.
static void check_largest(void) {
    for (int order = 0; order < 27; order++) {
        const double x[3] = {order % 3, order / 3 % 3, order / 9};
        int largest = 0;
        for (int k = 1; k < 3; k++)
            if (x[k] > x[largest]) largest = k;
        CHECK_EQ(vec3_find_largest(vec3_at(x, 0)), largest);
    }
}

static void check_eigen(void) {
    uint64_t s = 1;
    for (int i = 0; i < 2000; i++) {
        check_seed = s;
        ovoid_quat q = {random_normal(&s), random_normal(&s), random_normal(&s), random_normal(&s)};
        double d[3] = {pow(10, random_uniform(&s, -8, 8)), pow(10, random_uniform(&s, -8, 8)), 0};
        mat3 r = quat_to_mat3(q);
        sym3 m = sym3_rotate(sym3_diagonal(d[0], d[1], d[2]), r);
        eigen3 e = sym3_compute_eigen(m);
        double top = fmax(d[0], d[1]), bottom = fmin(d[0], d[1]);
        CHECK_NEAR(e.value[2], top, 1e-14 * top);
        CHECK_NEAR(e.value[1], bottom, 1e-14 * top);
        CHECK_NEAR(e.value[0], 0, 1e-14 * top);
        CHECK_NEAR(vec3_dot(e.v.r0, vec3_cross(e.v.r1, e.v.r2)), 1, 1e-14);
        sym3 back = sym3_from_eigen(e.value, e.v);
        CHECK_NEAR(back.xy, m.xy, 1e-14 * top);
        CHECK_NEAR(back.zz, m.zz, 1e-14 * top);
    }
    check_seed = 0;
}

// Gives some points coordinates of others, so that planes across and along an axis are common.
static void share_coordinates(int64_t p[4][3], uint64_t *s) {
    for (int k = 0; k < 8; k++) {
        uint64_t bits = random_next(s);
        p[bits % 4][bits / 16 % 3] = p[bits / 4 % 4][bits / 16 % 3];
    }
}

// The sign of det(p0 - p3, p1 - p3, p2 - p3), of integers whose products fit 64 bits.
static int find_sign(int64_t p[4][3]) {
    int64_t m[3][3];
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 3; j++) m[k][j] = p[k][j] - p[3][j];
    int64_t det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                  m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    return (det > 0) - (det < 0);
}

// Points that a plane across or along an axis misses by so little that doubles cannot tell: (x + 1) (x + 1) and x (x +
// 2) differ by 1. In all orders, along all axes.
static void check_axis_planes(void) {
    const int64_t x = (int64_t)1 << 27;
    const int64_t given[2][4][3] = {{{x + 1, x, 3}, {0, 0, 1}, {x + 2, x + 1, 5}, {0, 0, 0}},
                                    {{x + 1, x, 0}, {x + 2, x + 1, 0}, {2, 3, 1}, {0, 0, 0}}};
    for (int turn = 0; turn < 2 * 3 * 256; turn++) {
        int64_t p[4][3];
        vec3 v[4];
        for (int k = 0; k < 4; k++) {
            for (int j = 0; j < 3; j++) p[k][j] = given[turn % 2][turn / 6 >> 2 * k & 3][(turn / 2 + j) % 3];
            v[k] = vec3_make((double)p[k][0], (double)p[k][1], (double)p[k][2]);
        }
        CHECK_EQ(orient3d_sign(v[0], v[1], v[2], v[3]), find_sign(p));
    }
}

// Orientation of points that are coplanar but for the last bit; integer coordinates give the truth exactly.
static void check_orientation(void) {
    vec3 a = {0, 0, 0}, b = {1, 0, 0}, c = {0, 1, 0};
    CHECK_EQ(orient3d_sign(a, b, c, vec3_make(0.3, 0.3, -1)), 1);
    CHECK_EQ(orient3d_sign(a, b, c, vec3_make(0.3, 0.3, 1)), -1);
    CHECK_EQ(orient3d_sign(a, b, c, vec3_make(0.3, 0.3, 0)), 0);
    CHECK_EQ(orient3d_sign(a, b, c, vec3_make(1e6, 1e6, 1e-80)), -1);
    uint64_t s = 7;
    for (int i = 0; i < 20000; i++) {
        check_seed = s;
        int64_t p[4][3];
        vec3 v[4];
        for (int k = 0; k < 4; k++) {
            // Near-coplanar: the last point is a small combination of the others, moved by at most one unit.
            for (int j = 0; j < 3; j++) p[k][j] = (int64_t)(random_next(&s) % 200001) - 100000;
            if (k == 3)
                for (int j = 0; j < 3; j++) p[3][j] = p[0][j] + p[1][j] - p[2][j] + (int64_t)(random_next(&s) % 3) - 1;
        }
        if (i % 2) share_coordinates(p, &s);
        for (int k = 0; k < 4; k++)
            v[k] = vec3_make((double)p[k][0] * 0x1p-40 + 0x1p10, (double)p[k][1] * 0x1p-40 + 0x1p10,
                             (double)p[k][2] * 0x1p-40 + 0x1p10);
        CHECK_EQ(orient3d_sign(v[0], v[1], v[2], v[3]), find_sign(p));
    }
    check_seed = 0;
}

// Double-double by what undoes it: roots by squares, quotients by products, rotations by their transposes, each to a
// few E = 2^-102; and against numbers whose exact value is known.
static void check_dd3(void) {
    uint64_t s = 3;
    const double E = 0x1p-102;
    for (int i = 0; i < 20000; i++) {
        check_seed = s;
        double high = pow(2, random_uniform(&s, -60, 60)), low = high * 0x1p-54 * random_uniform(&s, -1, 1);
        dd a = two_sum(high, low), b = two_sum(random_uniform(&s, 1, 2), random_uniform(&s, -1, 1) * 0x1p-60);
        dd root = dd_sqrt(a), back = dd_sub(dd_mul(root, root), a);
        CHECK_LE(fabs(back.high), 4 * E * a.high);
        back = dd_sub(dd_mul(dd_div(a, b), b), a);
        CHECK_LE(fabs(back.high), 4 * E * a.high);
        back = dd_sub(dd_mul_double(a, b.high), dd_mul(a, dd_from(b.high)));
        CHECK_LE(fabs(back.high), 4 * E * a.high);
        CHECK(dd_round_down(a) <= a.high && dd_round_up(a) >= a.high);
        CHECK(dd_sub(a, dd_from(dd_round_down(a))).high >= 0 && dd_sub(dd_from(dd_round_up(a)), a).high >= 0);
        // R R' = 1, and R v has the length of v.
        double q[4];
        for (int k = 0; k < 4; k++) q[k] = random_uniform(&s, -1, 1);
        dd33 r = dd33_from_quat((ovoid_quat){q[0], q[1], q[2], q[3]});
        CHECK_LE(fabs(dd3_dot(r.r0, r.r1).high), 64 * E);
        CHECK_LE(fabs(dd_sub(dd3_dot(r.r2, r.r2), dd_from(1)).high), 64 * E);
        vec3 v = {high, q[1], -high};
        dd difference = dd_sub(dd3_norm(dd33_mul_vec3(&r, v)), dd3_norm(dd3_from(v)));
        CHECK_LE(fabs(difference.high), 48 * E * vec3_norm(v));
    }
    check_seed = 0;
    // 3-4-5: cosine 3/5, sine 4/5; a fifth is 0.2 + what 0.2 lacks. The root of 2 + 2^-60 squared out is 2 + 2^-60.
    dd33 r = dd33_from_quat((ovoid_quat){2, 0, 0, 1});
    dd off = dd_sub(dd_mul(r.r0.x, dd_from(5)), dd_from(3));
    CHECK_LE(fabs(off.high), 16 * E);
    off = dd_add(dd_mul(r.r0.y, dd_from(5)), dd_from(4));
    CHECK_LE(fabs(off.high), 16 * E);
    CHECK_EQ(dd_sqrt(dd_from(9)).high, 3);
    CHECK_EQ(dd_sqrt(dd_from(0)).high, 0);
    CHECK(dd_is_less((dd){1, -0x1p-60}, dd_from(1)) && !dd_is_less(dd_from(1), dd_from(1)));
}

static void check_rotation(void) {
    mat3 m = quat_to_mat3((ovoid_quat){1e-300, 0, 0, 1e-300});
    CHECK_NEAR(m.r0.y, -1, 1e-15);
    CHECK_NEAR(m.r1.x, 1, 1e-15);
    m = quat_to_mat3((ovoid_quat){1e300, 1e300, 0, 0});
    CHECK_NEAR(m.r1.z, -1, 1e-15);
    m = quat_to_mat3((ovoid_quat){5e-324, 0, 0, 0});
    CHECK_EQ(m.r0.x, 1);
}

static void check_double_double(void) {
    // (1/3) 3 = 1 to 2^-100; 1/3 in double-double.
    dd third = dd_div(dd_from(1), dd_from(3));
    dd one = dd_sub(dd_mul(third, dd_from(3)), dd_from(1));
    CHECK_LE(fabs(one.high), 0x1p-100);
    CHECK(third.low != 0);
}

// A point through two poses, one after the other, in double-double: E = 2^-102 of what enters.
static dd3 pose_point(const ovoid_pose *pose, dd3 local) {
    dd33 r = dd33_from_quat(quat_scaled(pose->rotation));
    return (dd3){dd_add(dd3_dot(r.r0, local), dd_from(pose->position.x)),
                 dd_add(dd3_dot(r.r1, local), dd_from(pose->position.y)),
                 dd_add(dd3_dot(r.r2, local), dd_from(pose->position.z))};
}
static double dd3_distance(dd3 a, dd3 b) {
    vec3 d = {dd_sub(a.x, b.x).high, dd_sub(a.y, b.y).high, dd_sub(a.z, b.z).high};
    return vec3_norm(d);
}

// The product of two poses against the two in double-double, within the bounds that linear.h states; a pose with its
// inverse is the identity. Quaternions of every length, positions near and far.
static void check_product(void) {
    uint64_t s = 11;
    const double u = 0x1p-53;
    for (int i = 0; i < 20000; i++) {
        check_seed = s;
        ovoid_pose p[2];
        for (int k = 0; k < 2; k++) {
            double norm = pow(10, i % 3 ? random_uniform(&s, -2, 2) : random_uniform(&s, -300, 300));
            double far = pow(10, random_uniform(&s, -9, 9));
            p[k].rotation = (ovoid_quat){norm * random_uniform(&s, -1, 1), norm * random_uniform(&s, -1, 1),
                                         norm * random_uniform(&s, -1, 1), norm * random_uniform(&s, -1, 1)};
            p[k].position = (vec3){far * random_uniform(&s, -1, 1), far * random_uniform(&s, -1, 1),
                                   far * random_uniform(&s, -1, 1)};
        }
        ovoid_pose product = ovoid_pose_compute_product(&p[0], &p[1]);
        CHECK_EQ(ovoid_pose_validate(&product), OVOID_OK);
        double inner = vec3_norm(p[1].position), allowed = 46 * u * inner + 2 * u * vec3_norm(p[0].position);
        dd3 zero = dd3_from((vec3){0, 0, 0}), at = pose_point(&p[0], pose_point(&p[1], zero));
        CHECK_LE(dd3_distance(at, dd3_from(product.position)), allowed);
        vec3 far = vec3_scale((vec3){random_uniform(&s, -1, 1), random_uniform(&s, -1, 1), 1}, 1e20);
        at = pose_point(&p[0], pose_point(&p[1], dd3_from(far)));
        CHECK_LE(dd3_distance(at, pose_point(&product, dd3_from(far))), 16 * u * vec3_norm(far) + allowed);
        ovoid_pose inverse = ovoid_pose_compute_inverse(&p[0]);
        allowed = 45 * u * vec3_norm(p[0].position);
        CHECK_LE(dd3_distance(pose_point(&inverse, pose_point(&p[0], zero)), zero), allowed);
    }
    check_seed = 0;
    // Closed form: two quarter turns about z, and the second's way is turned by the first.
    ovoid_pose turn = {{1, 2, 3}, {1, 0, 0, 1}}, both = ovoid_pose_compute_product(&turn, &turn);
    CHECK(both.rotation.w == 0 && both.rotation.x == 0 && both.rotation.y == 0 && both.rotation.z == 2);
    CHECK(both.position.x == -1 && both.position.y == 3 && both.position.z == 6);
}

int main(void) {
    check_largest();
    check_product();
    check_eigen();
    check_orientation();
    check_axis_planes();
    check_dd3();
    check_rotation();
    check_double_double();
    return check_end();
}
