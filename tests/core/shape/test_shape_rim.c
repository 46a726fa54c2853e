// Points of the rims of true cylinders and cones by their numbers. Truth: the circle, cosine and sine of the C library,
// and the definition in query.h evaluated in long double.
#include "check.h"

#include "linear/vec3.h"
#include "ovoid/ovoid.h"
#include "places.h"
#include "proofs/covers.h"
#include "shape/rim.h"
#include "shape/round.h"

static ovoid_shape *make_shape(uint64_t *s, int is_cone, double *radius, double *half) {
    *radius = exp(random_uniform(s, -20, 20));
    *half = random_next(s) % 4 ? *radius * exp(random_uniform(s, -5, 5)) : 0;
    ovoid_shape *shape = (is_cone ? ovoid_shape_create_cone : ovoid_shape_create_cylinder)(*radius, *half, NULL, NULL);
    if (!shape) exit(1);
    return shape;
}

static vec3 find_local(const ovoid_shape *shape, uint32_t number) {
    return vec3_add(shape_get_vertex(shape, number), shape->origin);
}

// A point of the circle, at its end, at the angle that its number says.
static void check_number(const ovoid_shape *shape, uint32_t number, double radius, double half) {
    vec3 v = find_local(shape, number);
    long double t = (long double)(number & 0xfffffff) / 0x1p28L,
                angle = 2 * atanl(t) + (long double)(number >> 28 & 3) * 2 * atanl(1);
    CHECK_LE(fabsl(v.x - radius * cosl(angle)), 4 * 0x1p-53L * radius);
    CHECK_LE(fabsl(v.y - radius * sinl(angle)), 4 * 0x1p-53L * radius);
    CHECK_LE(fabs(v.z - (number & RIM_UPPER ? half : -half)), 2 * 0x1p-53 * half);
}

static void test_points(void) {
    uint64_t s = 5;
    for (int i = 0; i < 2000; i++) {
        check_seed = s;
        double radius, half;
        ovoid_shape *shape = make_shape(&s, i & 1, &radius, &half);
        uint32_t number = RIM_POINT | ((uint32_t)random_next(&s) & (i & 1 ? 0x3fffffff : 0x7fffffff));
        if (i % 5 == 0) number &= 0xf0000000;
        CHECK(shape_has_vertex(shape, number));
        check_number(shape, number, radius, half);
        // The nearest number to a direction is less than 2^-28 off as an angle, and to its own direction it is itself.
        double angle = i % 7 ? random_uniform(&s, -4, 4) : 0.5 * 3.14159265358979323846 * (i % 9 - 4);
        double length = exp(random_uniform(&s, -100, 100)), x = length * cos(angle), y = length * sin(angle);
        uint32_t found = rim_find(x, y, sqrt(x * x + y * y), !(i & 1));
        CHECK(shape_has_vertex(shape, found));
        CHECK_EQ(found & RIM_UPPER, i & 1 ? 0 : RIM_UPPER);
        vec3 v = find_local(shape, found);
        CHECK_LE(fabs(v.x * y - v.y * x), 1.01 * 0x1p-28 * radius * length);
        CHECK(v.x * x + v.y * y > 0);
        CHECK_EQ(rim_find(v.x, v.y, sqrt(v.x * v.x + v.y * v.y), !(i & 1)), found);
        ovoid_shape_destroy(shape);
    }
    check_seed = 0;
    CHECK_EQ(rim_find(0, 0, 0, 0), RIM_POINT);
}

static void test_numbers(void) {
    ovoid_shape *cylinder = ovoid_shape_create_cylinder(1, 1, NULL, NULL),
                *cone = ovoid_shape_create_cone(1, 1, NULL, NULL),
                *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    const uint32_t numbers[] = {0, 7, 8, 0x7fffffff, RIM_POINT, RIM_POINT | RIM_UPPER, 0xffffffff};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        uint32_t k = numbers[i];
        CHECK_EQ(shape_has_vertex(box, k), k < 8);
        CHECK_EQ(shape_has_vertex(cylinder, k), k < cylinder->vertex_count || k >= RIM_POINT);
        CHECK_EQ(shape_has_vertex(cone, k), k < cone->vertex_count || (k >= RIM_POINT && !(k & RIM_UPPER)));
    }
    ovoid_shape_destroy(cylinder);
    ovoid_shape_destroy(cone);
    ovoid_shape_destroy(box);
}

// A proof with points of rims is refused for the polyhedron alone, and with points that a cone has not.
static void test_proofs(void) {
    STATIC_COVER(cover);
    static own_cover other;
    ovoid_shape *cylinder = ovoid_shape_create_cylinder(0.5, 0.5, NULL, NULL),
                *cone = ovoid_shape_create_cone(0.5, 0.5, NULL, NULL),
                *plain =
                    ovoid_shape_create_allowed(cylinder, &(ovoid_shape_options){.allowance = {.outside = 1e-3}}, NULL);
    uint64_t s = 9;
    long rims = 0, covers = 0;
    for (int i = 0; i < 500; i++) {
        check_seed = s;
        ovoid_pair p = {i & 1 ? cone : cylinder,
                        cylinder,
                        {random_vec3(&s, 0.5), random_quat(&s)},
                        {random_vec3(&s, 0.5), random_quat(&s)}};
        ovoid_answer x = ovoid_depth(&p, NULL, NULL, &cover);
        const ovoid_answer_basis basis = {.cover = &cover}, spoilt = {.cover = &other.cover};
        CHECK_EQ(ovoid_answer_verify(&p, &x, &basis, NULL), OVOID_OK);
        CHECK_LE(x.upper - x.lower, 1e-8);
        ovoid_pair q = p;
        q.shape_b = plain;
        int has_rim = 0;
        for (uint32_t k = 0; k < x.proof.count; k++) has_rim |= (x.proof.b[k] & RIM_POINT) != 0;
        if (has_rim) CHECK_EQ(ovoid_answer_verify(&q, &x, &basis, NULL), OVOID_ERROR_PROOF);
        rims += has_rim;
        if (cover.point_count == 0) continue;
        own_cover_copy(&other, &cover);
        other.b[random_next(&s) % cover.point_count] = 0x7fffffff;
        CHECK_EQ(ovoid_answer_verify(&p, &x, &spoilt, NULL), OVOID_ERROR_PROOF);
        own_cover_copy(&other, &cover);
        other.a[random_next(&s) % cover.point_count] = 0xffffffff;
        if (i & 1) CHECK_EQ(ovoid_answer_verify(&p, &x, &spoilt, NULL), OVOID_ERROR_PROOF);
        covers++;
    }
    check_seed = 0;
    CHECK(rims > 200 && covers > 100);
    ovoid_shape_destroy(cylinder);
    ovoid_shape_destroy(cone);
    ovoid_shape_destroy(plain);
}

// A small box over the middle between two corners of the polyhedron, along the normal of the ellipsoid that encloses
// these: it touches the true rim where it is farthest beyond that ellipsoid.
static void test_ellipsoids(void) {
    const double radius = 0.7, half = 0.4, side = 1e-6;
    ovoid_shape_options o = {.tolerance = 0.02 * radius};
    ovoid_shape *cylinder = ovoid_shape_create_cylinder(radius, half, &o, NULL),
                *box = ovoid_shape_create_box((ovoid_vec3){side, side, side}, NULL, NULL);
    ovoid_polytope p = ovoid_shape_get_polytope(cylinder);
    double turn = 0.5 * atan2(p.vertices[4], p.vertices[3]) + 0.5 * atan2(p.vertices[1], p.vertices[0]);
    vec3 n = vec3_unit((vec3){2 * half * cos(turn), 2 * half * sin(turn), radius});
    for (int i = 0; i < 40; i++) {
        double gap = 1e-3 * radius * (i - 20);
        vec3 at = vec3_add_scaled((vec3){radius * cos(turn), radius * sin(turn), half}, n, gap);
        ovoid_pair pair = {cylinder, box, {{0, 0, 0}, {1, 0, 0, 0}}, {at, {1, 0, 0, 0}}};
        if (fabs(gap) < 1e-5) continue;
        ovoid_answer x = ovoid_collide(&pair, NULL, NULL);
        CHECK_EQ(x.status, gap > 0 ? OVOID_SEPARATED : OVOID_OVERLAPPING);
        CHECK_EQ(ovoid_answer_verify(&pair, &x, NULL, NULL), OVOID_OK);
    }
    ovoid_shape_destroy(cylinder);
    ovoid_shape_destroy(box);
}

// A cylinder whose upper ring is higher than it says is not held by its polyhedron, nor one whose rings differ.
static void test_rings(void) {
    ovoid_shape *cylinder = ovoid_shape_create_cylinder(1, 0.5, NULL, NULL), *copy = malloc(cylinder->at.size);
    if (!CHECK(copy != NULL)) return;
    CHECK(round_is_held(cylinder, &cylinder->round));
    uint32_t first = cylinder->vertex_count / 2;
    for (int k = 0; k < 3; k++) {
        memcpy(copy, cylinder, cylinder->at.size);
        double *upper = (double *)((char *)copy + copy->at.vertices) + 3 * (size_t)first;
        for (uint32_t i = 0; i < first; i++) upper[3 * (size_t)i + (size_t)k] += 1e-6;
        CHECK(!round_is_held(copy, &cylinder->round));
    }
    free(copy);
    ovoid_shape_destroy(cylinder);
}

int main(void) {
    test_points();
    test_rings();
    test_ellipsoids();
    test_numbers();
    test_proofs();
    return check_end();
}
