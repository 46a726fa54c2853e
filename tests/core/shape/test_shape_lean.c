// Lean shapes. Both ellipsoids are proven by exact arithmetic (ellipsoid_is_enclosing and ellipsoid_is_enclosed, tested
// by themselves). Answers: the brackets of a pair of lean shapes and of the same pair made in full are true, so they
// meet; each proof is verified. The truth of volumes is the largest inscribed ellipsoid. What is copied or read from a
// file is the lean shape, bit for bit.
#include "check.h"
#include "countdown.h"
#include "ellipsoid/contain.h"
#include "ellipsoid/shrink_to_fit.h"
#include "linear/rotation.h"
#include "places.h"
#include "proofs/covers.h"
#include "shape/block.h"
#include "shape/gauss_map.h"
#include "shape_files.h"

#include <ovoid/ovoid.h>

enum { MOST = 400, PAIRS = 60 };

static double cloud[3 * MOST];
static const ovoid_shape_options lean = {.inner = OVOID_INNER_LEAN};

// Points on an ellipsoid of that thickness, or in a box, or on a grid; turned, and away from the origin.
static void fill_cloud(uint64_t *s, size_t count, double thickness) {
    mat3 turn = quat_to_mat3(random_quat(s));
    uint64_t kind = random_next(s) % 3;
    vec3 away = random_vec3(s, 3);
    for (size_t i = 0; i < count; i++) {
        vec3 v = random_vec3(s, 1);
        if (kind == 0) v = vec3_unit(v);
        if (kind == 1) v = (vec3){floor(3 * v.x), floor(3 * v.y), floor(3 * v.z)};
        v = vec3_add(mat3_mul_vec3(turn, (vec3){v.x, v.y, v.z * thickness}), away);
        cloud[3 * i] = v.x, cloud[3 * i + 1] = v.y, cloud[3 * i + 2] = v.z;
    }
}

static ovoid_shape *make(size_t count, ovoid_inner_method inner) {
    ovoid_shape *shape =
        ovoid_shape_create_from_points(cloud, count, &(ovoid_shape_options){.inner = inner, .radius = 0.125}, NULL);
    CHECK(shape != NULL);
    return shape;
}

// What holds of every lean shape, and the part of the largest volume that its inner ellipsoid has.
static double check_lean(const ovoid_shape *s, const ovoid_shape *full) {
    ovoid_polytope p = ovoid_shape_get_polytope(s);
    ovoid_fit outer = ovoid_shape_get_outer(s), inner = ovoid_shape_get_inner(s), most = ovoid_shape_get_inner(full);
    CHECK(ovoid_shape_is_lean(s));
    CHECK(!ovoid_shape_is_lean(full));
    CHECK_EQ(s->support.k, 0);
    CHECK(!shape_get_gauss_map(s));
    CHECK_EQ(s->at.gauss, s->at.vertices);
    CHECK(ellipsoid_is_enclosing(&p, &outer.ellipsoid));
    CHECK_LE(outer.gap, 0.1);
    if (p.rank < 3) return 1;
    CHECK(ellipsoid_is_enclosed(&p, &inner.ellipsoid));
    CHECK_LE(inner.volume, most.volume * (1 + 1.1e-6));
    CHECK(isinf(inner.gap) || inner.gap <= 0.1);
    CHECK_NEAR(inner.volume, ellipsoid_compute_measure(&inner.ellipsoid, 3), 1e-9 * inner.volume);
    return inner.volume / most.volume;
}

static void check_file(const ovoid_shape *s) {
    size_t size = ovoid_shape_write(s, NULL, 0);
    uint8_t *bytes = malloc(size);
    CHECK_EQ(ovoid_shape_write(s, bytes, size), size);
    ovoid_shape *read = ovoid_shape_read(bytes, size, NULL, NULL);
    shape_files_check_same(s, read);
    CHECK(read && ovoid_shape_is_lean(read));
    ovoid_shape_destroy(read);
    // The mark is 0 or 1, and that of the outer ellipsoid 0.
    const size_t marks[] = {212, 324, 324};
    for (size_t i = 0; i < 3; i++) {
        ovoid_error error = {0};
        uint8_t before = bytes[marks[i]];
        bytes[marks[i]] = (uint8_t)(before + (i < 2 ? 1 : 0));
        bytes[marks[i] + 1] = i == 2;
        shape_files_mend(bytes, size);
        read = ovoid_shape_read(bytes, size, NULL, &error);
        CHECK(!read);
        CHECK_EQ(error.code, OVOID_ERROR_FORMAT);
        CHECK_EQ(error.place, i ? 216 : 104);
        ovoid_shape_destroy(read);
        bytes[marks[i]] = before, bytes[marks[i] + 1] = 0;
    }
    free(bytes);
}

static void check_copies(const ovoid_shape *s) {
    ovoid_shape *copy = ovoid_shape_create_copy(s, NULL, NULL);
    ovoid_shape *allowed = ovoid_shape_create_allowed(s, &(ovoid_shape_options){.allowance = {.outside = 0.5}}, NULL);
    CHECK(copy && ovoid_shape_is_lean(copy));
    CHECK(allowed && ovoid_shape_is_lean(allowed));
    ovoid_shape_destroy(allowed);
    ovoid_shape_destroy(copy);
}

static ovoid_answer ask(const ovoid_pair *pair, int question, ovoid_cover *cover) {
    return question == 0   ? ovoid_collide(pair, NULL, NULL)
           : question == 1 ? ovoid_distance(pair, NULL, NULL)
                           : ovoid_depth(pair, NULL, NULL, cover);
}

// The same question of both pairs: proofs are verified, and the brackets meet.
static void check_pair(const ovoid_pair *thin, const ovoid_pair *full) {
    double size = 0x1p-40 * (thin->shape_a->extent + thin->shape_b->extent);
    for (int k = 0; k < 3; k++) {
        STATIC_COVER(cover);
        ovoid_answer x = ask(thin, k, &cover), y = ask(full, k, NULL);
        ovoid_error error;
        if (!CHECK_EQ(ovoid_answer_verify(thin, &x, &(ovoid_answer_basis){.cover = k == 2 ? &cover : NULL}, &error),
                      OVOID_OK))
            fprintf(stderr, "%s\n", error.message);
        CHECK_LE(x.lower, y.upper + size);
        CHECK_LE(y.lower, x.upper + size);
        CHECK_EQ(x.status, y.status);
        if (k == 1 && x.lower > 0) CHECK_LE(x.upper - x.lower, y.upper - y.lower + 2e-9 * (1 + size * 0x1p40));
    }
}

static void check_bodies(void) {
    uint64_t s = 5;
    static const double thickness[] = {1, 1, 1, 0.3, 1e-2, 1e-5, 1e-9, 0};
    double least = 1, sum = 0;
    int plain = 0;
    ovoid_shape *before[2] = {NULL, NULL};
    for (int i = 0; i < PAIRS; i++) {
        check_seed = s;
        size_t count = 8 + random_next(&s) % (i % 3 ? 40 : MOST - 8);
        double thin = thickness[i % 8];
        fill_cloud(&s, count, thin);
        ovoid_shape *shapes[2] = {make(count, OVOID_INNER_LEAN), make(count, OVOID_INNER_MAXIMUM)};
        if (!shapes[0] || !shapes[1]) return;
        double share = check_lean(shapes[0], shapes[1]);
        if (thin > 0.1) {
            least = fmin(least, share), sum += share, plain++;
            CHECK(isinf(ovoid_shape_get_inner(shapes[0]).gap));
        }
        check_file(shapes[0]);
        check_copies(shapes[0]);
        for (int k = 0; k < 4 && before[0]; k++) {
            ovoid_pose a, b;
            a.position = random_vec3(&s, k), a.rotation = random_quat(&s);
            b.position = random_vec3(&s, k), b.rotation = random_quat(&s);
            check_pair(&(ovoid_pair){shapes[0], before[0], a, b}, &(ovoid_pair){shapes[1], before[1], a, b});
        }
        for (int k = 0; k < 2; k++) ovoid_shape_destroy(before[k]), before[k] = shapes[k];
    }
    for (int k = 0; k < 2; k++) ovoid_shape_destroy(before[k]);
    // Measured: 0.76 and 0.88; a ball around the centroid has a half of that.
    CHECK(least > 0.6);
    CHECK(sum > 0.8 * plain);
}

// Bodies of a closed form have the largest ellipsoid at once, and thin ones get it too, as theirs of the moments is not
// proven in doubles; a gap that is asked for is reached.
static void check_others(void) {
    ovoid_shape *box = ovoid_shape_create_box((vec3){1, 2, 3}, &lean, NULL);
    CHECK(ovoid_shape_is_lean(box));
    CHECK_NEAR(ovoid_shape_get_inner(box).volume, 4 * 3.141592653589793 / 3 * 6, 1e-6);
    CHECK_LE(ovoid_shape_get_inner(box).gap, 1e-13);
    check_file(box);
    ovoid_shape_destroy(box);
    ovoid_shape *cylinder = ovoid_shape_create_cylinder(1, 2, &lean, NULL);
    CHECK(ovoid_shape_is_lean(cylinder));
    CHECK(ovoid_shape_get_round(cylinder).kind == OVOID_ROUND_CYLINDER);
    check_file(cylinder);
    ovoid_shape_destroy(cylinder);
    ovoid_shape *ball = ovoid_shape_create_sphere(1, &lean, NULL);
    CHECK(ovoid_shape_is_lean(ball));
    ovoid_shape_destroy(ball);
    uint64_t s = 9;
    fill_cloud(&s, 30, 1e-12);
    ovoid_shape *needle = ovoid_shape_create_from_points(cloud, 30, &lean, NULL);
    CHECK(needle && isfinite(ovoid_shape_get_inner(needle).gap));
    ovoid_shape_destroy(needle);
    fill_cloud(&s, 30, 1);
    ovoid_shape *narrow =
        ovoid_shape_create_from_points(cloud, 30, &(ovoid_shape_options){.inner = OVOID_INNER_LEAN, .gap = 1e-7}, NULL);
    CHECK(narrow && ovoid_shape_get_outer(narrow).gap <= 1e-7);
    ovoid_shape *deformed = ovoid_shape_create_deformed(narrow, shape_vertices(narrow), NULL, NULL);
    CHECK(deformed && !ovoid_shape_is_lean(deformed));
    ovoid_shape_destroy(deformed);
    ovoid_shape_destroy(narrow);
}

static void check_refused(void) {
    for (int i = -1; i <= 3; i += 4) {
        ovoid_error error = {0};
        ovoid_shape_options o = {.inner = (ovoid_inner_method)i};
        CHECK(!ovoid_shape_create_from_points(cloud, 30, &o, &error));
        CHECK_EQ(error.code, OVOID_ERROR_ARGUMENT);
    }
    for (long k = 0; k < 8; k++) {
        countdown c = {k, 0};
        ovoid_allocator counted = countdown_make_allocator(&c);
        ovoid_error error = {0};
        ovoid_shape_options o = {.inner = OVOID_INNER_LEAN, .allocator = &counted};
        uint64_t s = 4;
        fill_cloud(&s, MOST, 1);
        ovoid_shape *shape = ovoid_shape_create_from_points(cloud, MOST, &o, &error);
        CHECK_EQ(error.code, shape ? OVOID_OK : OVOID_ERROR_MEMORY);
        CHECK_EQ(c.held, shape ? 1 : 0);
        ovoid_shape_destroy(shape);
    }
}

int main(void) {
    check_bodies();
    check_others();
    check_refused();
    return check_end();
}
