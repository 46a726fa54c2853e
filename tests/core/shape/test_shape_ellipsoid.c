// Ellipsoids: the points that proofs name, supports, the polyhedron, and answers. Truths: the definition in query.h
// evaluated in long double; the ball 1 - 1 / n^2 against each facet; ellipsoids of which all half axes are equal are
// spheres; ellipsoids and boxes along common axes are as far apart as their tips.
#include "check.h"

#include "linear/vec3.h"
#include "ovoid/ovoid.h"
#include "places.h"
#include "shape/ellipsoid.h"
#include "shape/rim.h"
#include "shape_files.h"

#include <string.h>

static vec3 random_half_axes(uint64_t *s) {
    double size = exp(random_uniform(s, -40, 40));
    vec3 half = {exp(random_uniform(s, -3, 3)), exp(random_uniform(s, -3, 3)), exp(random_uniform(s, -3, 3))};
    if (random_next(s) % 8 == 0) half.y = half.x;
    return vec3_scale(half, size);
}

// The definition of a number, in integers and long double.
static void find_point(vec3 half, uint32_t number, long double v[3]) {
    long place = (long)(number & 0x7fffffff), side = 46339, steps = 23169, i = place / side - steps,
         j = place % side - steps, z = steps - labs(i) - labs(j), x = i, y = j;
    if (z < 0) {
        x = (steps - labs(j)) * (i < 0 ? -1 : 1);
        y = (steps - labs(i)) * (j < 0 ? -1 : 1);
    }
    CHECK_EQ(labs(x) + labs(y) + labs(z), steps);
    long double length = sqrtl((long double)(x * x + y * y + z * z));
    v[0] = half.x * (x / length), v[1] = half.y * (y / length), v[2] = half.z * (z / length);
}

static double find_most(vec3 v) { return vec3_max_abs(v); }

static void test_points(void) {
    uint64_t s = 7;
    for (int i = 0; i < 1000000; i++) {
        check_seed = s;
        vec3 half = i % 16 ? (vec3){1, 1, 1} : random_half_axes(&s);
        // The number near a direction is near it, and that of its own direction it is itself.
        vec3 m = i % 5 ? random_vec3(&s, 1) : (vec3){(int)(random_next(&s) % 3) - 1, (int)(random_next(&s) % 3) - 1, 0};
        if (i % 10 == 0) m.z = (int)(random_next(&s) % 3) - 1;
        uint32_t number = ellipsoid_find_number(vec3_scale(m, exp(random_uniform(&s, -100, 100))));
        CHECK(number - RIM_POINT < ELLIPSOID_POINTS);
        vec3 v = ellipsoid_compute_point(half, number);
        long double exact[3];
        find_point(half, number, exact);
        double slack = 4 * 0x1p-53 * find_most(half);
        CHECK(fabsl(v.x - exact[0]) <= slack && fabsl(v.y - exact[1]) <= slack && fabsl(v.z - exact[2]) <= slack);
        vec3 on = {v.x / half.x, v.y / half.y, v.z / half.z}, off = vec3_sub(on, vec3_unit(m));
        if (vec3_max_abs(m) > 0) CHECK_LE(vec3_norm(off), 1e-4);
        vec3 again = ellipsoid_compute_point(half, ellipsoid_find_number(on));
        CHECK(again.x == v.x && again.y == v.y && again.z == v.z);
        // The support, as |m|, and no point of the ellipsoid is farther.
        vec3 n = vec3_unit(m);
        ellipsoid_end end = ellipsoid_find_support(half, n);
        long double x = (long double)half.x * n.x, y = (long double)half.y * n.y, z = (long double)half.z * n.z;
        CHECK_LE(fabsl(end.value - sqrtl(x * x + y * y + z * z)), slack);
        CHECK_LE(vec3_dot(n, v), end.value + 2 * slack);
        vec3 best = ellipsoid_compute_point(half, ellipsoid_find_number(end.m));
        CHECK_LE(end.value - vec3_dot(n, best), 1e-8 * end.value + 2 * slack);
    }
    check_seed = 0;
    CHECK(ellipsoid_find_number((vec3){0, 0, 0}) - RIM_POINT < ELLIPSOID_POINTS);
}

static void test_numbers(void) {
    ovoid_shape *e = ovoid_shape_create_ellipsoid((ovoid_vec3){1, 2, 3}, NULL, NULL);
    if (!CHECK(e != NULL)) return;
    const uint32_t last = RIM_POINT + ELLIPSOID_POINTS - 1,
                   numbers[] = {0, 37, 38, 0x7fffffff, RIM_POINT, last, last + 1};
    const int has[] = {1, 1, 0, 0, 1, 1, 0};
    for (size_t i = 0; i < sizeof has / sizeof *has; i++) CHECK_EQ(shape_has_vertex(e, numbers[i]), has[i]);
    ovoid_shape_destroy(e);
}

// The closed form against the hull of the same vertices in reverse order, which is searched for: edges and measures.
static void check_hull(const ovoid_shape *e, vec3 half) {
    ovoid_polytope p = ovoid_shape_get_polytope(e);
    uint32_t count = p.vertex_count;
    double *xyz = malloc(3 * sizeof *xyz * count);
    if (!CHECK(xyz != NULL)) return;
    for (uint32_t i = 0; i < count; i++) memcpy(xyz + 3 * (size_t)i, p.vertices + 3 * (size_t)(count - 1 - i), 24);
    ovoid_shape *other = ovoid_shape_create_from_points(xyz, count, NULL, NULL);
    free(xyz);
    if (!CHECK(other != NULL)) return;
    ovoid_polytope q = ovoid_shape_get_polytope(other);
    CHECK(q.triangle_count == p.triangle_count && q.facet_count == p.facet_count);
    for (uint32_t v = 0; v < count; v++) {
        uint32_t w = count - 1 - v, degree = p.neighbor_starts[v + 1] - p.neighbor_starts[v];
        const uint32_t *of_v = p.neighbors + p.neighbor_starts[v], *end = q.neighbors + q.neighbor_starts[w + 1];
        CHECK_EQ(degree, q.neighbor_starts[w + 1] - q.neighbor_starts[w]);
        for (uint32_t k = 0; k < degree; k++) CHECK_EQ(of_v[k], count - 1 - end[-1 - (int)k]);
    }
    ovoid_measures m = ovoid_shape_get_measures(e), n = ovoid_shape_get_measures(other);
    CHECK_NEAR(m.volume / n.volume, 1, 1e-12);
    CHECK_NEAR(m.area / n.area, 1, 1e-12);
    CHECK_NEAR(m.inertia.xx / n.inertia.xx, 1, 1e-12);
    CHECK_NEAR(m.inertia.yy / n.inertia.yy, 1, 1e-12);
    CHECK_NEAR(m.inertia.zz / n.inertia.zz, 1, 1e-12);
    // The ellipsoids of one are as large as of the other, to the gap of those that are searched for.
    ovoid_fit fits[4] = {ovoid_shape_get_outer(e), ovoid_shape_get_outer(other), ovoid_shape_get_inner(e),
                         ovoid_shape_get_inner(other)};
    CHECK_NEAR(fits[0].volume / fits[1].volume, 1, 2e-6);
    CHECK_NEAR(fits[2].volume / fits[3].volume, 1, 2e-6);
    CHECK(fits[0].gap < 1e-9 && fits[2].gap < 1e-9 && fits[0].ellipsoid.q.xx >= half.x * half.x);
    for (uint32_t f = 0; f < p.facet_count; f++)
        for (int k = 0; k < 3; k++) {
            const double *v = p.vertices + 3 * (size_t)p.triangles[3 * (size_t)f + (size_t)k];
            double height = vec3_dot(p.planes[f].normal, (vec3){v[0], v[1], v[2]});
            CHECK(height <= p.planes[f].offset && height >= p.planes[f].offset * (1 - 1e-13));
        }
    ovoid_shape_destroy(other);
}

// Each number of steps: its tolerance is met, no vertex is beyond the ellipsoid, and no facet is inside of the ball, in
// units of the half axes.
static void test_polyhedra(void) {
    uint64_t s = 3;
    for (int n = 2; n <= 64; n++) {
        vec3 half = random_half_axes(&s);
        double most = find_most(half), tolerance = most / (n * n) * (1 + 1e-12);
        ovoid_shape_options o = {.tolerance = tolerance};
        ovoid_shape *e = ovoid_shape_create_ellipsoid(half, &o, NULL);
        if (!CHECK(e != NULL)) return;
        ovoid_polytope p = ovoid_shape_get_polytope(e);
        CHECK_EQ(p.vertex_count, 4 * n * n + 2);
        CHECK_EQ(p.triangle_count, 8 * n * n);
        ovoid_allowance known = ovoid_shape_get_allowance(e);
        CHECK(known.outside <= tolerance && known.outside > 0 && known.inside > 0 && known.inside < 1e-15 * most);
        for (uint32_t i = 0; i < p.vertex_count; i++) {
            const double *v = p.vertices + 3 * (size_t)i;
            CHECK_LE(fabs(vec3_norm((vec3){v[0] / half.x, v[1] / half.y, v[2] / half.z}) - 1), 1e-15);
        }
        for (uint32_t t = 0; t < p.triangle_count; t++) {
            vec3 c[3];
            for (int k = 0; k < 3; k++) {
                const double *v = p.vertices + 3 * (size_t)p.triangles[3 * (size_t)t + (size_t)k];
                c[k] = (vec3){v[0] / half.x, v[1] / half.y, v[2] / half.z};
            }
            vec3 normal = vec3_unit(vec3_cross(vec3_sub(c[1], c[0]), vec3_sub(c[2], c[0])));
            CHECK(vec3_dot(normal, c[0]) >= 1 - 1.0 / (n * n));
        }
        if (n <= 24 || n % 16 == 0) check_hull(e, half);
        ovoid_round round = ovoid_shape_get_round(e);
        CHECK_EQ(round.kind, OVOID_ROUND_ELLIPSOID);
        CHECK(!memcmp(&round.half_axes, &half, sizeof half));
        ovoid_shape_destroy(e);
    }
}

static void check_refused(vec3 half, double tolerance, ovoid_code code) {
    ovoid_error error;
    CHECK(!ovoid_shape_create_ellipsoid(half, &(ovoid_shape_options){.tolerance = tolerance}, &error));
    CHECK_EQ(error.code, code);
}

static void test_options(void) {
    check_refused((vec3){-1, 1, 1}, 0, OVOID_ERROR_ARGUMENT);
    check_refused((vec3){1, NAN, 1}, 0, OVOID_ERROR_NOT_FINITE);
    check_refused((vec3){1, 1, 1e51}, 0, OVOID_ERROR_RANGE);
    check_refused((vec3){1, 1, 1}, -1, OVOID_ERROR_ARGUMENT);
    check_refused((vec3){1, 1, 1}, NAN, OVOID_ERROR_ARGUMENT);
    check_refused((vec3){1, 1, 1}, 1e-4, OVOID_ERROR_LIMIT);
    // Flat ones, and ones with an allowance of their own, are polyhedra.
    const vec3 halves[] = {{1, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 1e-7, 1}, {1e-80, 1e-80, 1e-80}, {1, 2, 3}};
    for (int i = 0; i < 6; i++) {
        ovoid_shape_options o = {.allowance = {.outside = i == 5 ? 0.25 : 0, .axis = {0, 0, 1}}};
        ovoid_shape *e = ovoid_shape_create_ellipsoid(halves[i], &o, NULL);
        if (!CHECK(e != NULL)) return;
        CHECK_EQ(ovoid_shape_get_round(e).kind, OVOID_ROUND_NONE);
        ovoid_allowance known = ovoid_shape_get_allowance(e);
        CHECK(known.outside >= 0.05 * find_most(halves[i]) + o.allowance.outside && known.axis.z == 0);
        ovoid_shape_destroy(e);
    }
}

static void write_again(unsigned char *bytes, size_t size, size_t at, double value) {
    memcpy(bytes + at, &value, sizeof value);
    shape_files_mend(bytes, size);
}

// The file holds the same shape; one whose half axes or allowance are others than its vertices' is refused.
static void test_files(void) {
    static unsigned char bytes[1 << 14], other[1 << 14];
    enum { OUTSIDE_AT = 328, INSIDE_AT = 336, HALF_AXES_AT = 344 };
    ovoid_shape_options o = {.radius = 0.25};
    ovoid_shape *e = ovoid_shape_create_ellipsoid((ovoid_vec3){1, 0.5, 0.25}, &o, NULL);
    size_t size = ovoid_shape_write(e, bytes, sizeof bytes);
    ovoid_shape *again = ovoid_shape_read(bytes, size, NULL, NULL);
    if (CHECK(e && again && size <= sizeof bytes)) {
        ovoid_round a = ovoid_shape_get_round(e), b = ovoid_shape_get_round(again);
        CHECK(a.kind == b.kind && !memcmp(&a.half_axes, &b.half_axes, sizeof a.half_axes));
        CHECK_EQ(ovoid_shape_get_size(e), ovoid_shape_get_size(again));
        CHECK(!memcmp(shape_vertices(e), shape_vertices(again), e->at.size - e->at.vertices));
    }
    const struct {
        size_t at;
        double value;
    } lies[] = {{OUTSIDE_AT, 1.0 / 17},   {OUTSIDE_AT, 1.0 / 15},        {INSIDE_AT, 1e-10},
                {HALF_AXES_AT, 1.0001},   {HALF_AXES_AT + 8, 0.5000001}, {HALF_AXES_AT + 16, -0.25},
                {HALF_AXES_AT + 16, NAN}, {HALF_AXES_AT + 8, 0}};
    for (size_t i = 0; i < sizeof lies / sizeof *lies; i++) {
        ovoid_error error;
        memcpy(other, bytes, size);
        write_again(other, size, lies[i].at, lies[i].value);
        CHECK(!ovoid_shape_read(other, size, NULL, &error));
        CHECK_EQ(error.code, OVOID_ERROR_FORMAT);
    }
    ovoid_shape_destroy(e);
    ovoid_shape_destroy(again);
}

// Checks all queries of a pair whose distance is known to 1e-13.
static void check_distance(const ovoid_pair *p, double truth) {
    ovoid_answer all[] = {ovoid_distance(p, NULL, NULL), ovoid_depth(p, NULL, NULL, NULL), ovoid_collide(p, NULL, NULL),
                          ovoid_within(p, 1e-3, NULL, NULL)};
    for (int i = 0; i < 4; i++) {
        const ovoid_answer *x = &all[i];
        CHECK(x->lower <= truth + 1e-13 && truth - 1e-13 <= x->upper);
        if (x->proof.kind != OVOID_PROOF_COVER) CHECK_EQ(ovoid_answer_verify(p, x, NULL, NULL), OVOID_OK);
        int is_sign = i < 3 && fabs(truth) > 5e-8;
        if (is_sign) CHECK_EQ(x->status, truth > 0 ? OVOID_SEPARATED : OVOID_OVERLAPPING);
        if (i < 2 && (i == 1 || truth > 0)) CHECK_LE(x->upper - x->lower, 1e-8);
    }
}

static void test_touching(void) {
    uint64_t s = 11;
    const double gaps[] = {1e-7, -1e-7, 1e-6, -1e-6, 1e-2, -1e-2, 0.3};
    for (int i = 0; i < 3000; i++) {
        check_seed = s;
        vec3 a = {random_uniform(&s, 0.2, 1), random_uniform(&s, 0.2, 1), random_uniform(&s, 0.2, 1)},
             b = {random_uniform(&s, 0.2, 1), random_uniform(&s, 0.2, 1), random_uniform(&s, 0.2, 1)};
        double gap = gaps[i % 7], ends[2] = {a.z, b.z};
        ovoid_shape *of_a = ovoid_shape_create_ellipsoid(a, NULL, NULL), *of_b;
        switch (i % 4) {
        case 0: of_b = ovoid_shape_create_ellipsoid(b, NULL, NULL); break;
        case 1: of_b = ovoid_shape_create_box(b, NULL, NULL); break;
        case 2: of_b = ovoid_shape_create_cylinder(b.x, b.z, NULL, NULL); break;
        default: of_b = ovoid_shape_create_sphere(b.z, NULL, NULL); break;
        }
        ovoid_pose pose = {random_vec3(&s, 1), random_quat(&s)};
        ovoid_pair p = {of_a, of_b, pose, pose};
        p.pose_b.position = ovoid_pose_compute_point(&pose, (vec3){0, 0, ends[0] + ends[1] + gap});
        if (i % 3 == 0) p = (ovoid_pair){of_b, of_a, p.pose_b, p.pose_a};
        check_distance(&p, gap);
        ovoid_shape_destroy(of_a);
        ovoid_shape_destroy(of_b);
    }
    check_seed = 0;
}

// Ellipsoids of three equal half axes, and a rounding radius, are spheres.
static void test_spheres(void) {
    uint64_t s = 13;
    for (int i = 0; i < 2000; i++) {
        check_seed = s;
        double a = random_uniform(&s, 0.2, 1), b = random_uniform(&s, 0.2, 1), scale = pow(10, (int)(i % 21) - 10);
        ovoid_shape_options o = {.radius = i % 2 ? 0 : 0.5 * a * scale};
        ovoid_shape *of_a = ovoid_shape_create_ellipsoid((vec3){a * scale, a * scale, a * scale}, &o, NULL),
                    *of_b = ovoid_shape_create_ellipsoid((vec3){b * scale, b * scale, b * scale}, NULL, NULL);
        ovoid_pair p = {
            of_a, of_b, {random_vec3(&s, scale), random_quat(&s)}, {random_vec3(&s, scale), random_quat(&s)}};
        vec3 d = vec3_sub(p.pose_b.position, p.pose_a.position);
        double truth = vec3_norm(d) - (a + b) * scale - o.radius, slack = 1e-13 * scale;
        ovoid_answer x = ovoid_depth(&p, NULL, NULL, NULL);
        CHECK(x.lower <= truth + slack && truth - slack <= x.upper);
        CHECK_LE(x.upper - x.lower, 1e-8 * scale);
        ovoid_shape_destroy(of_a);
        ovoid_shape_destroy(of_b);
    }
    check_seed = 0;
}

// The enclosing spheres overlap, so that a depth begins without a simplex; the cores part the bodies, but do not reach
// the tolerance.
static void test_parted(void) {
    const double radius = 101339119.83043617;
    const ovoid_shape_options coarse = {.tolerance = 1e-3 * radius};
    ovoid_shape *cone = ovoid_shape_create_cone(radius, 131844415.32621855, &coarse, NULL);
    ovoid_shape *of_b =
        ovoid_shape_create_ellipsoid((vec3){47119792.924772255, 131362769.64498395, 115408223.9957737}, NULL, NULL);
    const double x = 8615537.4424748719, z = 137791766.41143426;
    const ovoid_quat turn = {1, 1.8338628275278196e-15, -1.8338628275278196e-15, 9.1693141376390982e-16};
    const ovoid_pair p = {cone, of_b, {{x, 66791126.735175282, z}, {1, 0, 0, 0}}, {{x, -142586245.53224561, z}, turn}};
    const ovoid_options fine = {0, 1e-11, 0, 0};
    const ovoid_answer_basis basis = {&fine, NULL};
    ovoid_answer depth = ovoid_depth(&p, &fine, NULL, NULL), distance = ovoid_distance(&p, &fine, NULL);
    CHECK_EQ(depth.status, OVOID_SEPARATED);
    CHECK(depth.lower <= distance.upper && distance.lower <= depth.upper);
    CHECK_EQ(ovoid_answer_verify(&p, &depth, &basis, NULL), OVOID_OK);
    ovoid_shape_destroy(cone);
    ovoid_shape_destroy(of_b);
}

int main(void) {
    test_parted();
    test_points();
    test_numbers();
    test_polyhedra();
    test_options();
    test_files();
    test_touching();
    test_spheres();
    return check_end();
}
