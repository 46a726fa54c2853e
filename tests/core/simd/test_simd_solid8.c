// One triangle beside eight, one box beside eight: every instruction set against the scalar twin, bit for bit. Of the
// eight triangles some are so far that a gap along the given normal or the line of the middles is enough, others not,
// in every mixture: what one lane needs must not show in another.
#include "simd/solid8.h"

#include "check.h"

static vec3 make_point(uint64_t *s, double size) {
    return (vec3){random_uniform(s, -size, size), random_uniform(s, -size, size), random_uniform(s, -size, size)};
}

static mat3 make_rotation(uint64_t *s) {
    vec3 a = vec3_unit(make_point(s, 1)), b = vec3_unit(vec3_cross(a, make_point(s, 1)));
    return (mat3){a, b, vec3_cross(a, b)};
}

static void check_bits(const double *a, const double *b, size_t count) { CHECK(!memcmp(a, b, count * sizeof *a)); }

static long open_lanes, closed_lanes, across_lanes;

static void check_triangles(uint64_t *s, const solid8_kernels *twin, const solid8_kernels *kernels) {
    solid8_triangle one = {.rotation = make_rotation(s),
                           .translation = make_point(s, 0.5),
                           .normal = vec3_unit(make_point(s, 1)),
                           .enough = random_uniform(s, 0, 1)};
    solid8_triangles eight;
    for (int i = 0; i < 3; i++) one.corner[i] = make_point(s, 1);
    for (int lane = 0; lane < BOX8; lane++) {
        vec3 middle = make_point(s, 2);
        for (int i = 0; i < 3; i++) {
            vec3 p = vec3_add(middle, make_point(s, 0.5));
            eight.corner[i][0][lane] = p.x, eight.corner[i][1][lane] = p.y, eight.corner[i][2][lane] = p.z;
        }
    }
    solid8_gaps a, b;
    twin->triangles(&one, &eight, &a);
    kernels->triangles(&one, &eight, &b);
    check_bits(a.lower, b.lower, BOX8);
    check_bits(a.upper, b.upper, BOX8);
    for (int k = 0; k < 3; k++) check_bits(a.normal[k], b.normal[k], BOX8);
    for (int lane = 0; lane < BOX8; lane++) {
        // A lane that needed no nearest points has a gap above what is enough, and the others have an upper bound.
        CHECK(a.upper[lane] < INFINITY || a.lower[lane] > one.enough);
        if (a.upper[lane] < INFINITY)
            open_lanes++;
        else
            closed_lanes++;
    }
}

static void check_boxes(uint64_t *s, const solid8_kernels *twin, const solid8_kernels *kernels) {
    solid8_other other = {.center = make_point(s, 3), .half = {0.3, 0.2, 0.5}, .rotation = make_rotation(s), .unit = 1};
    // Axes that are parallel have none across them.
    if (random_next(s) % 4 == 0) other.rotation = (mat3){{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const mat3 r = other.rotation;
    other.absolute = (mat3){{fabs(r.r0.x), fabs(r.r0.y), fabs(r.r0.z)},
                            {fabs(r.r1.x), fabs(r.r1.y), fabs(r.r1.z)},
                            {fabs(r.r2.x), fabs(r.r2.y), fabs(r.r2.z)}};
    other.turned = mat3_mul_transposed_vec3(other.absolute, other.half);
    other.normal = vec3_unit(make_point(s, 1));
    other.reach = random_uniform(s, 0.2, 1);
    other.across = random_next(s) % 2;
    other.least = random_uniform(s, 0, 0.1);
    if (other.across) other.normal = (vec3){0, 0, 0}, other.reach = INFINITY;
    box8 node = {0};
    for (uint32_t lane = 0; lane < BOX8; lane++) {
        box b = box_make_empty();
        b = box_add_point(&b, make_point(s, 2));
        b = box_add_point(&b, make_point(s, 2));
        box8_set_lane(&node, lane, &b);
    }
    double a[BOX8], b[BOX8];
    twin->boxes(&node, &other, a);
    kernels->boxes(&node, &other, b);
    check_bits(a, b, BOX8);
    int has_across = other.across;
    other.across = 0;
    twin->boxes(&node, &other, b);
    for (int lane = 0; lane < BOX8; lane++) {
        CHECK(a[lane] >= b[lane]);
        if (a[lane] > b[lane]) CHECK(has_across && a[lane] > other.least);
        across_lanes += a[lane] > b[lane];
    }
}

int main(void) {
    uint64_t state = 23;
    const solid8_kernels *twin = solid8_get_kernels_of(SIMD_SCALAR);
    for (int isa = 0; isa < SIMD_ISA_COUNT; isa++) {
        const solid8_kernels *kernels = solid8_get_kernels_of((simd_isa)isa);
        for (int i = 0; kernels && i < 3000; i++) {
            check_triangles(&state, twin, kernels);
            check_boxes(&state, twin, kernels);
        }
    }
    CHECK(open_lanes > 1000 && closed_lanes > 1000);
    CHECK(across_lanes > 100);
    return check_end();
}
