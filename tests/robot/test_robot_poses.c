// Poses of links. Truth: matrices in long double, written here without a quaternion (Rodrigues' formula), which is off
// by some 1e-18; on machines whose long double is a double the comparison is skipped. The bounds that come with the
// poses must hold, and be worth having. Lanes: the bits of the single state, for every instruction set.
#include "bits.h"
#include "check.h"
#include "countdown.h"
#include "robots.h"
#include "simd/robot8.h"

#include "robot/kinematics.h"

#include <float.h>

typedef long double real;
typedef struct exact_frame {
    real r[3][3], p[3];
} exact_frame;

// The rotation of a normalised quaternion.
static void exact_rotation(ovoid_quat q, real r[3][3]) {
    real w = q.w, x = q.x, y = q.y, z = q.z, s = 2 / (w * w + x * x + y * y + z * z);
    real m[3][3] = {{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                    {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
                    {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}};
    memcpy(r, m, sizeof m);
}

static void multiply(real a[3][3], real b[3][3], real out[3][3]) {
    real m[3][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) m[i][k] = a[i][0] * b[0][k] + a[i][1] * b[1][k] + a[i][2] * b[2][k];
    memcpy(out, m, sizeof m);
}

static void unit_axis(ovoid_vec3 a, real n[3]) {
    real x = a.x, y = a.y, z = a.z, norm = sqrtl(x * x + y * y + z * z);
    n[0] = x / norm, n[1] = y / norm, n[2] = z / norm;
}

// Rodrigues: I + sin K + (1 - cos) K K.
static void axis_rotation(const real n[3], real angle, real r[3][3]) {
    real k[3][3] = {{0, -n[2], n[1]}, {n[2], 0, -n[0]}, {-n[1], n[0], 0}}, kk[3][3];
    multiply(k, k, kk);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) r[i][j] = (i == j) + sinl(angle) * k[i][j] + (1 - cosl(angle)) * kk[i][j];
}

// The x of the plane of a planar joint, as the header has it for z and -z; else the formula of its source.
static void plane_axes(const real n[3], real x[3], real y[3]) {
    real sign = n[2] < 0 ? -1 : 1, a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
    x[0] = 1 + sign * n[0] * n[0] * a, x[1] = sign * b, x[2] = -sign * n[0];
    y[0] = b, y[1] = sign + n[1] * n[1] * a, y[2] = -n[1];
}

// The value of a joint of one variable.
static real find_value(const ovoid_robot_description *d, const ovoid_robot *r, uint32_t i, const double *q) {
    const ovoid_robot_joint *j = &d->joints[i];
    if (j->mimic == OVOID_ROBOT_NONE) return q[ovoid_robot_get_joint_variable(r, i)];
    return j->multiplier * find_value(d, r, j->mimic, q) + j->offset;
}

static void exact_joint(const ovoid_robot_description *d, const ovoid_robot *r, uint32_t i, const double *q,
                        exact_frame *local) {
    const ovoid_robot_joint *j = &d->joints[i];
    real n[3] = {0, 0, 1}, x[3], y[3], t[3] = {0, 0, 0}, spin[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, o[3][3];
    const double *v = q + (j->type == OVOID_JOINT_FIXED ? 0 : ovoid_robot_get_joint_variable(r, i));
    if (j->type != OVOID_JOINT_FIXED && j->type != OVOID_JOINT_FLOATING) unit_axis(j->axis, n);
    exact_rotation(j->origin.rotation, o);
    if (j->type == OVOID_JOINT_REVOLUTE || j->type == OVOID_JOINT_CONTINUOUS)
        axis_rotation(n, find_value(d, r, i, q), spin);
    if (j->type == OVOID_JOINT_PRISMATIC)
        for (int k = 0; k < 3; k++) t[k] = n[k] * find_value(d, r, i, q);
    if (j->type == OVOID_JOINT_PLANAR) {
        plane_axes(n, x, y);
        for (int k = 0; k < 3; k++) t[k] = v[0] * x[k] + v[1] * y[k];
        axis_rotation(n, v[2], spin);
    }
    if (j->type == OVOID_JOINT_FLOATING) {
        for (int k = 0; k < 3; k++) t[k] = v[k];
        exact_rotation((ovoid_quat){v[3], v[4], v[5], v[6]}, spin);
    }
    const double p[3] = {j->origin.position.x, j->origin.position.y, j->origin.position.z};
    for (int k = 0; k < 3; k++) local->p[k] = p[k] + o[k][0] * t[0] + o[k][1] * t[1] + o[k][2] * t[2];
    multiply(o, spin, local->r);
}

static void exact_poses(const ovoid_robot *r, const double *q, exact_frame *frames) {
    ovoid_robot_description d = ovoid_robot_get_description(r);
    exact_frame world = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
    frames[ovoid_robot_get_root(r)] = world;
    // The tests' joints come with parents before children.
    for (uint32_t i = 0; i < d.joint_count; i++) {
        const exact_frame *up = &frames[d.joints[i].parent];
        exact_frame local, f;
        exact_joint(&d, r, i, q, &local);
        multiply((real(*)[3])(uintptr_t)up->r, local.r, f.r);
        for (int k = 0; k < 3; k++)
            f.p[k] = up->p[k] + up->r[k][0] * local.p[0] + up->r[k][1] * local.p[1] + up->r[k][2] * local.p[2];
        frames[d.joints[i].child] = f;
    }
}

static double worst_position, worst_rotation, worst_bound;

static void compare(const ovoid_pose *pose, const ovoid_robot_pose_error *e, const exact_frame *exact) {
    real r[3][3], square = 0;
    exact_rotation(pose->rotation, r);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) square += (r[i][k] - exact->r[i][k]) * (r[i][k] - exact->r[i][k]);
    // Of two rotations the operator norm of the difference is Frobenius' over the root of two. 1e-17: long double's
    // own.
    CHECK_LE((double)sqrtl(square / 2), e->rotation + 1e-17);
    real x = pose->position.x - exact->p[0], y = pose->position.y - exact->p[1], z = pose->position.z - exact->p[2];
    CHECK_LE((double)sqrtl(x * x + y * y + z * z), e->position + 1e-17);
    worst_rotation = fmax(worst_rotation, (double)sqrtl(square / 2) / (e->rotation + 1e-16));
    worst_position = fmax(worst_position, (double)sqrtl(x * x + y * y + z * z) / (e->position + 1e-16));
    worst_bound = fmax(worst_bound, e->position + e->rotation);
}

static void test_exact(void) {
    uint64_t s = 1;
    for (int round = 0; round < 400; round++) {
        random_robot a;
        ovoid_error error;
        check_seed = (uint64_t)round;
        make_random_robot(&s, &a);
        ovoid_robot *r = ovoid_robot_create(&a.d, NULL, &error);
        CHECK(r != NULL);
        for (int k = 0; r && k < 10; k++) {
            double q[7 * ROBOT_LINKS];
            ovoid_pose poses[ROBOT_LINKS];
            ovoid_robot_pose_error errors[ROBOT_LINKS];
            exact_frame exact[ROBOT_LINKS];
            make_random_state(&s, r, q);
            CHECK_EQ(ovoid_robot_compute_poses(r, q, poses, errors, &error), OVOID_OK);
            exact_poses(r, q, exact);
            for (size_t i = 0; i < a.d.link_count; i++) compare(&poses[i], &errors[i], &exact[i]);
        }
        ovoid_robot_destroy(r);
    }
    check_seed = 0;
    printf("errors: at most %.3g of the bound of the rotation, %.3g of that of the position; bounds at most %.3g\n",
           worst_rotation, worst_position, worst_bound);
    // Chains of up to 23 joints over some ten lengths, with mimics of mimics that double angles.
    CHECK_LE(worst_bound, 2e-10);
    CHECK_LE(0.05, worst_rotation);
    CHECK_LE(0.03, worst_position);
}

// A mimic's own rounding, far above that of the rest: multiplied by a third, and a thousand turns on.
static void test_mimic(void) {
    random_robot a = {.d = {.links = a.links, .link_count = 3, .joints = a.joints, .joint_count = 2}};
    uint64_t s = 12;
    for (uint32_t i = 0; i < 3; i++) a.links[i].name = i == 0 ? "a" : i == 1 ? "b" : "c";
    for (uint32_t i = 0; i < 2; i++)
        a.joints[i] = (ovoid_robot_joint){.name = a.links[i].name,
                                          .type = OVOID_JOINT_CONTINUOUS,
                                          .parent = i,
                                          .child = i + 1,
                                          .origin = {{1, 0, 0}, {1, 0, 0, 0}},
                                          .axis = {0, 0, 1},
                                          .mimic = i ? 0 : OVOID_ROBOT_NONE,
                                          .multiplier = 1.0 / 3,
                                          .offset = 6283.1};
    ovoid_error error;
    ovoid_robot *r = ovoid_robot_create(&a.d, NULL, &error);
    if (!r) exit(1);
    double worst = 0;
    for (int k = 0; k < 200; k++) {
        double q = random_uniform(&s, -3, 3);
        ovoid_pose poses[3];
        ovoid_robot_pose_error errors[3];
        exact_frame exact[3];
        CHECK_EQ(ovoid_robot_compute_poses(r, &q, poses, errors, &error), OVOID_OK);
        exact_poses(r, &q, exact);
        for (int i = 0; i < 3; i++) compare(&poses[i], &errors[i], &exact[i]);
        worst = fmax(worst, errors[2].rotation);
    }
    CHECK_LE(worst, 1e-10);
    ovoid_robot_destroy(r);
}

// All states of a batch have the bits of each alone; so do the frames of each instruction set, elements included.
static void test_lanes(void) {
    uint64_t s = 2;
    for (int round = 0; round < 60; round++) {
        enum { COUNT = 19 };
        random_robot a;
        ovoid_error error;
        make_random_robot(&s, &a);
        ovoid_robot *r = ovoid_robot_create(&a.d, NULL, &error);
        CHECK(r != NULL);
        if (!r) return;
        size_t n = ovoid_robot_get_variable_count(r), links = a.d.link_count;
        double q[COUNT * 7 * ROBOT_LINKS];
        static ovoid_pose poses[COUNT * ROBOT_LINKS], alone[ROBOT_LINKS];
        for (int k = 0; k < COUNT; k++) make_random_state(&s, r, q + (size_t)k * n);
        if (n) q[n] = -0.0;
        CHECK_EQ(ovoid_robot_compute_poses_batch(r, q, COUNT, poses, &error), OVOID_OK);
        for (size_t k = 0; k < COUNT; k++) {
            CHECK_EQ(ovoid_robot_compute_poses(r, q + k * n, alone, NULL, &error), OVOID_OK);
            CHECK(memcmp(alone, poses + k * links, links * sizeof *alone) == 0);
        }
        ovoid_robot_destroy(r);
    }
}

static void test_kernels(void) {
    static double values[7 * ROBOT_LINKS][ROBOT8];
    static frame8 frames[ROBOT_LINKS], first[ROBOT_LINKS];
    uint64_t s = 3;
    for (int round = 0; round < 60; round++) {
        random_robot a;
        double q[7 * ROBOT_LINKS], magnitude;
        make_random_robot(&s, &a);
        ovoid_robot *r = ovoid_robot_create(&a.d, NULL, NULL);
        if (!r) exit(1);
        for (size_t k = 0; k < ROBOT8; k++) {
            make_random_state(&s, r, q);
            CHECK_EQ(robot_compute_values(r, q, values[0] + k, ROBOT8, &magnitude, NULL), OVOID_OK);
        }
        for (int isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++) {
            const robot8_kernels *kernels = robot8_get_kernels_of((simd_isa)isa);
            if (!kernels && isa >= SIMD_AVX2 && round == 0) check_skip("an instruction set that this machine lacks");
            if (!kernels) continue;
            memset(frames, 0, sizeof frames);
            kernels->chain(r->steps, r->joint_count, (const double(*)[ROBOT8])values, frames);
            if (isa == SIMD_SCALAR) memcpy(first, frames, sizeof frames);
            CHECK(memcmp(first, frames, sizeof frames) == 0);
        }
        ovoid_robot_destroy(r);
    }
}

// The same bits from every compiler, level and machine: a chain of all six types, whose input no mathematics library
// makes.
static void test_bits(void) {
    static const ovoid_joint_type types[] = {OVOID_JOINT_REVOLUTE,  OVOID_JOINT_PLANAR,     OVOID_JOINT_FIXED,
                                             OVOID_JOINT_PRISMATIC, OVOID_JOINT_CONTINUOUS, OVOID_JOINT_FLOATING};
    ovoid_robot_link links[7] = {{"0"}, {"1"}, {"2"}, {"3"}, {"4"}, {"5"}, {"6"}};
    ovoid_robot_joint joints[6];
    uint64_t s = 13, hash = BITS_START;
    for (uint32_t i = 0; i < 6; i++) {
        joints[i] = (ovoid_robot_joint){.name = links[i].name,
                                        .type = types[i],
                                        .parent = i,
                                        .child = i + 1,
                                        .lower = -2,
                                        .upper = 2,
                                        .mimic = OVOID_ROBOT_NONE};
        double *numbers[] = {&joints[i].origin.position.x,
                             &joints[i].origin.position.y,
                             &joints[i].origin.position.z,
                             &joints[i].origin.rotation.w,
                             &joints[i].origin.rotation.x,
                             &joints[i].origin.rotation.y,
                             &joints[i].origin.rotation.z,
                             &joints[i].axis.x,
                             &joints[i].axis.y,
                             &joints[i].axis.z};
        for (int k = 0; k < 10; k++) *numbers[k] = random_uniform(&s, -1, 1);
    }
    ovoid_robot_description d = {.links = links, .link_count = 7, .joints = joints, .joint_count = 6};
    ovoid_robot *r = ovoid_robot_create(&d, NULL, NULL);
    if (!r) exit(1);
    for (int i = 0; i < 200; i++) {
        double q[13];
        ovoid_pose poses[7];
        ovoid_robot_pose_error errors[7];
        for (int k = 0; k < 13; k++) q[k] = random_uniform(&s, -9, 9);
        CHECK_EQ(ovoid_robot_compute_poses(r, q, poses, errors, NULL), OVOID_OK);
        BITS_ADD(hash, poses);
        BITS_ADD(hash, errors);
    }
    ovoid_robot_destroy(r);
    CHECK_EQ(hash, UINT64_C(0x7dbd19a98bf82a1e)); // what gcc 12 gave at -O2
}

// One joint: what is refused, with which place.
static void test_refusals(void) {
    ovoid_robot_link links[3] = {{"a"}, {"b"}, {"c"}};
    ovoid_robot_joint joints[2] = {{.name = "free",
                                    .type = OVOID_JOINT_FLOATING,
                                    .parent = 0,
                                    .child = 1,
                                    .origin = {{0, 0, 0}, {1, 0, 0, 0}},
                                    .mimic = OVOID_ROBOT_NONE},
                                   {.name = "turn",
                                    .type = OVOID_JOINT_REVOLUTE,
                                    .parent = 1,
                                    .child = 2,
                                    .origin = {{0, 0, 0}, {1, 0, 0, 0}},
                                    .axis = {0, 1, 0},
                                    .lower = -1,
                                    .upper = 1,
                                    .mimic = OVOID_ROBOT_NONE}};
    ovoid_robot_description d = {.links = links, .link_count = 3, .joints = joints, .joint_count = 2};
    ovoid_error error;
    ovoid_robot *r = ovoid_robot_create(&d, NULL, &error);
    if (!r) exit(1);
    double q[8] = {1, 2, 3, 1e-200, 0, 0, 1e-200, 0.5};
    ovoid_pose poses[3];
    CHECK_EQ(ovoid_robot_compute_poses(r, q, poses, NULL, &error), OVOID_OK);
    CHECK_NEAR(poses[1].rotation.w, sqrt(0.5), 1e-15);
    CHECK_EQ(poses[2].position.z, 3.0);
    CHECK_EQ(ovoid_robot_check_limits(r, q, 0, &error), OVOID_OK);
    q[7] = 1.25;
    CHECK_EQ(ovoid_robot_check_limits(r, q, 0.125, &error), OVOID_ERROR_RANGE);
    CHECK(error.place == 7 && strstr(error.message, "\"turn\", is 1.25, outside its limits -1 to 1"));
    CHECK_EQ(ovoid_robot_check_limits(r, q, 0.25, &error), OVOID_OK);
    q[7] = 2e9;
    CHECK_EQ(ovoid_robot_compute_poses(r, q, poses, NULL, &error), OVOID_ERROR_RANGE);
    CHECK_EQ(error.place, 7);
    q[7] = 0, q[1] = NAN;
    CHECK_EQ(ovoid_robot_compute_poses(r, q, poses, NULL, &error), OVOID_ERROR_NOT_FINITE);
    CHECK_EQ(error.place, 1);
    CHECK_EQ(ovoid_robot_check_limits(r, q, 1, &error), OVOID_ERROR_NOT_FINITE);
    q[1] = 1e51;
    CHECK_EQ(ovoid_robot_compute_poses_batch(r, q, 1, poses, &error), OVOID_ERROR_RANGE);
    q[1] = 0, q[3] = q[6] = 0;
    CHECK_EQ(ovoid_robot_compute_poses(r, q, poses, NULL, &error), OVOID_ERROR_ROTATION);
    CHECK_EQ(error.place, 6);
    CHECK(strstr(error.message, "\"free\"") != NULL);
    ovoid_robot_destroy(r);
}

static void test_memory(void) {
    random_robot a;
    uint64_t s = 4;
    make_random_robot(&s, &a);
    countdown c = {.left = 1 << 20};
    ovoid_allocator allocator = countdown_make_allocator(&c);
    ovoid_robot *r = ovoid_robot_create(&a.d, &(ovoid_robot_options){.allocator = &allocator}, NULL);
    if (!r) exit(1);
    double q[7 * ROBOT_LINKS];
    ovoid_pose poses[ROBOT_LINKS];
    ovoid_error error;
    make_random_state(&s, r, q);
    for (long k = 0; k < 2; k++) {
        c.left = k;
        CHECK_EQ(ovoid_robot_compute_poses_batch(r, q, 1, poses, &error), OVOID_ERROR_MEMORY);
        CHECK_EQ(c.held, 1);
    }
    c.left = 0;
    CHECK_EQ(ovoid_robot_compute_poses(r, q, poses, NULL, &error), OVOID_OK); // allocates nothing
    ovoid_robot_destroy(r);
    CHECK_EQ(c.held, 0);
}

int main(void) {
    if (LDBL_MANT_DIG >= 64)
        test_exact(), test_mimic();
    else
        check_skip("long double is no longer than double here");
    test_lanes();
    test_kernels();
    test_bits();
    test_refusals();
    test_memory();
    return check_end();
}
