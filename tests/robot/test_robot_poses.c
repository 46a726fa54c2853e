// Poses of links. Truth: matrices in long double, written here without a quaternion (Rodrigues' formula), which is off
// by some 1e-18; on machines whose long double is a double the comparison is skipped. The bounds that come with the
// poses must hold, and be worth having. Lanes: the bits of the single state, for every instruction set.
#include "bits.h"
#include "check.h"
#include "countdown.h"
#include "exact_robot.h"
#include "robot/cell/checker.h"
#include "robots.h"

#include "robot/model/kinematics.h"

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
            CHECK_EQ(ovoid_robot_compute_poses(r, q, poses, &error), OVOID_OK);
            ovoid_robot_compute_pose_errors(r, q, poses, errors);
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
        CHECK_EQ(ovoid_robot_compute_poses(r, &q, poses, &error), OVOID_OK);
        ovoid_robot_compute_pose_errors(r, &q, poses, errors);
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
        CHECK_EQ(ovoid_robot_compute_poses_batch(r, &(ovoid_robot_pose_batch){q, COUNT, poses}, &error), OVOID_OK);
        for (size_t k = 0; k < COUNT; k++) {
            CHECK_EQ(ovoid_robot_compute_poses(r, q + k * n, alone, &error), OVOID_OK);
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

// ---- what is near, in lanes

static box8 make_boxes(uint64_t *s, oriented_box *boxes) {
    box8 all = {{{0}}};
    for (int k = 0; k < ROBOT8; k++) {
        ovoid_pose pose = random_pose(s, 2);
        oriented_box *b = &boxes[k];
        *b = (oriented_box){quat_to_mat3(pose.rotation), pose.position, random_vec3(s, 1), random_uniform(s, 0, 0.1)};
        b->half = vec3_abs(b->half);
        const double numbers[] = {b->center.x,
                                  b->center.y,
                                  b->center.z,
                                  b->rotation.r0.x,
                                  b->rotation.r0.y,
                                  b->rotation.r0.z,
                                  b->rotation.r1.x,
                                  b->rotation.r1.y,
                                  b->rotation.r1.z,
                                  b->rotation.r2.x,
                                  b->rotation.r2.y,
                                  b->rotation.r2.z,
                                  b->half.x,
                                  b->half.y,
                                  b->half.z,
                                  b->radius,
                                  1.001 * (vec3_norm(b->half) + b->radius)};
        for (int i = 0; i < BOX8_COLUMNS; i++) all.column[i][k] = numbers[i];
    }
    return all;
}

static oriented_box place_linked_box(const linked_box8 *b, int k) {
    const double(*c)[ROBOT8] = b->frame->column;
    mat3 r = {{c[7][k], c[8][k], c[9][k]}, {c[10][k], c[11][k], c[12][k]}, {c[13][k], c[14][k], c[15][k]}};
    vec3 center = vec3_add((vec3){c[0][k], c[1][k], c[2][k]}, mat3_mul_vec3(r, b->middle));
    return (oriented_box){r, center, b->half, b->radius};
}

// The distance of a point from a box.
static double measure_box(const oriented_box *b, vec3 point) {
    vec3 d = vec3_abs(mat3_mul_transposed_vec3(b->rotation, vec3_sub(point, b->center)));
    vec3 out = {max2(d.x - b->half.x, 0), max2(d.y - b->half.y, 0), max2(d.z - b->half.z, 0)};
    return vec3_norm(out) - b->radius;
}

static long near_count, far_count;

// In each lane what the functions of one state say, and what is true of points and boxes.
static void compare_near(const robot8_kernels *kernels, const frame8 frames[2], uint64_t *s) {
    oriented_box boxes[ROBOT8];
    box8 all = make_boxes(s, boxes);
    sphere8 spheres[2];
    linked_box8 linked[2];
    unsigned char near[ROBOT8];
    const double more[2] = {random_uniform(s, 0, 0.5), 0.02};
    for (int i = 0; i < 2; i++) {
        vec3 c = random_vec3(s, 0.5);
        const double center[3] = {c.x, c.y, c.z};
        kernels->place(&frames[i], center, random_uniform(s, 0.1, 1), &spheres[i]);
        linked[i] = (linked_box8){&frames[i], random_vec3(s, 0.3), vec3_abs(random_vec3(s, 0.6)), 0.01};
    }
    unsigned near_spheres = kernels->near_spheres(&spheres[0], &spheres[1], more[0]);
    unsigned near_linked = kernels->near_linked_boxes(&linked[0], &linked[1], more[0]);
    kernels->near_boxes8(&all, 0x1f, &spheres[0], more, near);
    for (int k = 0; k < ROBOT8; k++) {
        sphere_place places[2];
        for (int i = 0; i < 2; i++) {
            const double(*c)[ROBOT8] = (const double(*)[ROBOT8])spheres[i].column;
            places[i] = (sphere_place){{c[0][k], c[1][k], c[2][k]}, c[SPHERE8_REACH][k]};
        }
        oriented_box a = place_linked_box(&linked[0], k), b = place_linked_box(&linked[1], k);
        CHECK_EQ(near_spheres >> k & 1, !spheres_are_far(&places[0], &places[1], more[0]));
        CHECK_EQ(near_linked >> k & 1, !oriented_boxes_are_far(&a, &b, more[0]));
        unsigned bits = kernels->near_boxes(&all, places[0].center, add_up(places[0].reach, more[0], more[1]));
        for (unsigned i = 0; i < ROBOT8; i++) {
            vec3 point = {places[0].center[0], places[0].center[1], places[0].center[2]};
            double apart = measure_box(&boxes[i], point) - places[0].reach - more[0] - more[1];
            CHECK_EQ(near[i] >> k & 1, i < 5 ? bits >> i & 1 : 0);
            if (fabs(apart) > 1e-9) CHECK_EQ(bits >> i & 1, apart < 0);
            *(apart < 0 ? &near_count : &far_count) += 1;
        }
    }
}

static void test_near(void) {
    static double values[7 * ROBOT_LINKS][ROBOT8];
    static frame8 frames[ROBOT_LINKS];
    for (int isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++) {
        const robot8_kernels *kernels = robot8_get_kernels_of((simd_isa)isa);
        uint64_t s = 14;
        for (int round = 0; kernels && round < 100; round++) {
            random_robot a;
            double q[7 * ROBOT_LINKS], magnitude;
            do make_random_robot(&s, &a);
            while (a.d.link_count < 3);
            ovoid_robot *r = ovoid_robot_create(&a.d, NULL, NULL);
            if (!r) exit(1);
            for (size_t k = 0; k < ROBOT8; k++) {
                make_random_state(&s, r, q);
                CHECK_EQ(robot_compute_values(r, q, values[0] + k, ROBOT8, &magnitude, NULL), OVOID_OK);
            }
            kernels->chain(r->steps, r->joint_count, (const double(*)[ROBOT8])values, frames);
            const frame8 two[2] = {frames[r->steps[0].child], frames[r->steps[1].child]};
            compare_near(kernels, two, &s);
            ovoid_robot_destroy(r);
        }
    }
    CHECK_LE(500, near_count);
    CHECK_LE(500, far_count);
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
        CHECK_EQ(ovoid_robot_compute_poses(r, q, poses, NULL), OVOID_OK);
        ovoid_robot_compute_pose_errors(r, q, poses, errors);
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
    CHECK_EQ(ovoid_robot_compute_poses(r, q, poses, &error), OVOID_OK);
    CHECK_NEAR(poses[1].rotation.w, sqrt(0.5), 1e-15);
    CHECK_EQ(poses[2].position.z, 3.0);
    CHECK_EQ(ovoid_robot_validate_limits(r, q, 0, &error), OVOID_OK);
    q[7] = 1.25;
    CHECK_EQ(ovoid_robot_validate_limits(r, q, 0.125, &error), OVOID_ERROR_RANGE);
    CHECK(error.place == 7 && strstr(error.message, "\"turn\", is 1.25, outside its limits -1 to 1"));
    CHECK_EQ(ovoid_robot_validate_limits(r, q, 0.25, &error), OVOID_OK);
    q[7] = 2e9;
    CHECK_EQ(ovoid_robot_compute_poses(r, q, poses, &error), OVOID_ERROR_RANGE);
    CHECK_EQ(error.place, 7);
    q[7] = 0, q[1] = NAN;
    CHECK_EQ(ovoid_robot_compute_poses(r, q, poses, &error), OVOID_ERROR_NOT_FINITE);
    CHECK_EQ(error.place, 1);
    CHECK_EQ(ovoid_robot_validate_limits(r, q, 1, &error), OVOID_ERROR_NOT_FINITE);
    q[1] = 1e51;
    CHECK_EQ(ovoid_robot_compute_poses_batch(r, &(ovoid_robot_pose_batch){q, 1, poses}, &error), OVOID_ERROR_RANGE);
    q[1] = 0, q[3] = q[6] = 0;
    CHECK_EQ(ovoid_robot_compute_poses(r, q, poses, &error), OVOID_ERROR_ROTATION);
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
    long held = c.held;
    for (long k = 0; k < 2; k++) {
        c.left = k;
        CHECK_EQ(ovoid_robot_compute_poses_batch(r, &(ovoid_robot_pose_batch){q, 1, poses}, &error),
                 OVOID_ERROR_MEMORY);
        CHECK_EQ(c.held, held);
    }
    c.left = 0;
    CHECK_EQ(ovoid_robot_compute_poses(r, q, poses, &error), OVOID_OK); // allocates nothing
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
    test_near();
    test_bits();
    test_refusals();
    test_memory();
    return check_end();
}
