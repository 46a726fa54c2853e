// Swept spheres in rare places: a vertex of a hull or a box on the axis of a cone, where all directions around the side
// are as good, and near it, where rounding chooses one; and numbers that are not finite. Truth: the depth of a corner
// in a cone by hand, and that a query of no numbers is undecided.
#include "ovoid/shape.h"
#include "ovoid/swept.h"

#include "check.h"
#include "places.h"

static void turn(ovoid_swept_sphere *s, ovoid_quat rotation) {
    double rows[9];
    const ovoid_pose pose = {{0, 0, 0}, rotation};
    ovoid_pose_compute_matrix(&pose, rows);
    for (int k = 0; k < 3; k++) s->axis[k] = (ovoid_vec3){rows[k], rows[3 + k], rows[6 + k]};
}

// Of half length h and radius r: the sine and cosine of the side's normals with the axis.
static double find_sine(double h, double r) { return r / sqrt(4 * h * h + r * r); }

static void check_depth(const ovoid_swept_sphere *a, const ovoid_swept_sphere *b, double depth) {
    const ovoid_swept_pair pairs[2] = {{a, b}, {b, a}};
    for (int i = 0; i < 2; i++) {
        ovoid_witness w;
        const ovoid_verdict v = ovoid_swept_depth(pairs[i], &w);
        if (!CHECK_EQ((int)v.status, (int)OVOID_OVERLAPPING)) continue;
        CHECK_NEAR(v.lower, -depth, 1e-10);
        CHECK_NEAR(v.upper, -depth, 1e-10);
    }
}

// An octahedron around the middle of a flat cone, its tips on the axis or off it by some roundings.
static void test_hull_on_axis(void) {
    const double points[18] = {0.7, 0, 0, -0.7, 0, 0, 0, 0.7, 0, 0, -0.7, 0, 0, 0, 0.5, 0, 0, -0.5};
    uint64_t r = 3;
    ovoid_shape *shape = ovoid_shape_create_from_points(points, 6, NULL, NULL);
    if (!CHECK(shape != NULL)) return;
    for (int i = 0; i < 600; i++) {
        check_seed = (uint64_t)i;
        ovoid_swept_sphere hull = {.core = OVOID_SWEPT_POINTS, .points = points, .count = 6, .shape = shape};
        ovoid_swept_sphere cone = {.core = OVOID_SWEPT_CONE, .half = {0.06, 0.4}};
        const ovoid_quat rotation = i % 3 ? random_quat(&r) : (ovoid_quat){1, 0, 0, 0};
        turn(&hull, rotation);
        turn(&cone, rotation);
        cone.axis[0] = cone.axis[2];
        const double off = i % 2 ? pow(10, -random_uniform(&r, 13, 18)) : 0;
        cone.center = random_vec3(&r, off);
        check_depth(&hull, &cone, find_sine(0.06, 0.4) * (0.06 + 0.5));
    }
    check_seed = 0;
    ovoid_shape_destroy(shape);
}

// A cone whose middle is a corner of a box, along the diagonal.
static void test_box_on_axis(void) {
    uint64_t r = 9;
    for (int i = 0; i < 600; i++) {
        check_seed = (uint64_t)i;
        ovoid_swept_sphere box = {.core = OVOID_SWEPT_BOX, .half = {5, 5, 5}};
        ovoid_swept_sphere cone = {.core = OVOID_SWEPT_CONE, .half = {0.06, 0.4}};
        turn(&box, i % 3 ? random_quat(&r) : (ovoid_quat){1, 0, 0, 0});
        for (int k = 0; k < 3; k++) {
            const ovoid_vec3 x = box.axis[k];
            cone.center = (ovoid_vec3){cone.center.x + 5 * x.x, cone.center.y + 5 * x.y, cone.center.z + 5 * x.z};
        }
        const double scale = -1 / sqrt(75);
        cone.axis[0] = (ovoid_vec3){scale * cone.center.x, scale * cone.center.y, scale * cone.center.z};
        check_depth(&box, &cone, find_sine(0.06, 0.4) * 0.06);
    }
    check_seed = 0;
}

static void check_undecided(const ovoid_swept_sphere *a, const ovoid_swept_sphere *b) {
    const ovoid_swept_pair pairs[2] = {{a, b}, {b, a}};
    for (int i = 0; i < 2; i++) {
        ovoid_witness w;
        CHECK_EQ((int)ovoid_swept_collide(pairs[i]).status, (int)OVOID_UNDECIDED);
        CHECK_EQ((int)ovoid_swept_contact(pairs[i], &w).status, (int)OVOID_UNDECIDED);
        CHECK_EQ((int)ovoid_swept_distance(pairs[i], &w).status, (int)OVOID_UNDECIDED);
        CHECK_EQ((int)ovoid_swept_depth(pairs[i], &w).status, (int)OVOID_UNDECIDED);
    }
}

// Points, the hull's middle, and axes of the bodies near it.
static void test_no_numbers(void) {
    static const double none[] = {NAN, INFINITY, -INFINITY};
    static const ovoid_swept_core cores[] = {OVOID_SWEPT_CYLINDER, OVOID_SWEPT_CONE, OVOID_SWEPT_ELLIPSOID,
                                             OVOID_SWEPT_BOX};
    uint64_t r = 21;
    for (int i = 0; i < 3000; i++) {
        check_seed = (uint64_t)i;
        double points[36];
        for (int k = 0; k < 36; k++) points[k] = random_uniform(&r, -1, 1);
        ovoid_swept_sphere hull = {.core = OVOID_SWEPT_POINTS, .points = points, .count = 12};
        ovoid_swept_sphere other = {.center = random_vec3(&r, 0.7), .core = cores[i % 4], .half = {0.4, 0.3, 0.2}};
        turn(&hull, random_quat(&r));
        turn(&other, random_quat(&r));
        const double bad = none[random_next(&r) % 3];
        switch (random_next(&r) % 4) {
        case 0: points[random_next(&r) % 36] = bad; break;
        case 1: hull.half[random_next(&r) % 3] = bad; break;
        case 2: hull.axis[random_next(&r) % 3].y = bad; break;
        default: other.axis[i % 4 < 2 ? 0 : random_next(&r) % 3].z = bad; break;
        }
        // Where spheres around the bodies are apart they decide.
        if (!isfinite(points[0]) || ovoid_swept_collide((ovoid_swept_pair){&hull, &other}).status != OVOID_SEPARATED)
            check_undecided(&hull, &other);
        other = (ovoid_swept_sphere){.core = OVOID_SWEPT_ELLIPSOID, .half = {0.4, 0.3, 0.2}};
        turn(&other, random_quat(&r));
        ovoid_swept_sphere ball = {.center = random_vec3(&r, 1), .radius = 0.1};
        other.half[random_next(&r) % 3] = bad;
        check_undecided(&ball, &other);
    }
    check_seed = 0;
}

int main(void) {
    test_hull_on_axis();
    test_box_on_axis();
    test_no_numbers();
    return check_end();
}
