// Contacts of hard bodies in hard positions: needles, slabs, flat bodies, points; scales of 1e-9 and 1e9; the same
// pose, exact touching, a margin larger than the bodies; far from the origin; earlier contacts of any bytes. Truth:
// what manifolds.h finds without the contact's proof, the verifier, and bits.
#include "bits.h"
#include "manifolds.h"
#include "places.h"
#include "proofs/covers.h"

enum { SHAPES = 14 };

static ovoid_shape *hull_of(const double *xyz, size_t count, double scale) {
    double scaled[3 * 128];
    ovoid_error error;
    for (size_t i = 0; i < 3 * count; i++) scaled[i] = scale * xyz[i];
    return ovoid_shape_create_from_points(scaled, count, NULL, &error);
}

static ovoid_shape *random_hull(int count, double scale, uint64_t *s) {
    double xyz[3 * 128];
    for (int i = 0; i < count; i++) {
        vec3 p = vec3_unit((vec3){random_normal(s), random_normal(s), random_normal(s)});
        for (int k = 0; k < 3; k++) xyz[3 * i + k] = (&p.x)[k];
    }
    return hull_of(xyz, (size_t)count, scale);
}

static ovoid_shape *create_shape(int kind, double l, uint64_t *s) {
    static const double needle[] = {0, 0, 5, 0.01, 0, -1, -0.01, 0.01, -1, 0, -0.01, -1};
    static const double triangle[] = {1, 0, 0, -0.5, 0.8, 0, -0.5, -0.8, 0};
    ovoid_error error;
    ovoid_shape_options o = {.radius = 0}, round = {.radius = 0.1 * l};
    switch (kind) {
    case 0: return ovoid_shape_create_box((ovoid_vec3){l, l, l}, &o, &error);
    case 1: return hull_of(needle, 4, l);
    case 2: return ovoid_shape_create_box((ovoid_vec3){l, l, 1e-4 * l}, &o, &error);
    case 3: return ovoid_shape_create_box((ovoid_vec3){l, 0.7 * l, 0}, &o, &error);
    case 4: return hull_of(triangle, 3, l);
    case 5: return ovoid_shape_create_sphere(0.5 * l, &o, &error);
    case 6: return ovoid_shape_create_capsule(0.2 * l, l, &o, &error);
    case 7: return ovoid_shape_create_cylinder(0.5 * l, l, &o, &error);
    case 8: return ovoid_shape_create_cone(0.5 * l, l, &o, &error);
    case 9: return ovoid_shape_create_box((ovoid_vec3){l, 0.5 * l, 0.3 * l}, &round, &error);
    case 10: return ovoid_shape_create_prism(&(ovoid_prism){l, 0.3 * l, 100}, &o, &error);
    case 11: return ovoid_shape_create_capsule(0, l, &o, &error);
    case 12: return random_hull(12, l, s);
    default: return random_hull(100, l, s);
    }
}

// Moves B along d until it is about that far.
static void place(ovoid_pair *pair, vec3 d, double want, double most) {
    double near = 0, far = most;
    vec3 at = pair->pose_a.position;
    for (int k = 0; k < 40; k++) {
        double middle = (near + far) / 2;
        pair->pose_b.position = vec3_add_scaled(at, d, middle);
        if (ovoid_depth(pair, NULL, NULL, NULL).lower > want)
            far = middle;
        else
            near = middle;
    }
}

// All that is true of one contact (of the same body twice there is no other side): cold, exchanged, its points in the
// same call, and from earlier contacts.
static void check_all(const ovoid_pair *pair, const ovoid_manifold_options *options, int is_same_twice) {
    ovoid_manifold_points points;
    ovoid_manifold_options o = *options;
    asked_manifold q = ask_manifold(pair, &o, NULL);
    check_manifold(&q);
    o.points = &points;
    ovoid_manifold again = ovoid_manifold_find(pair, &o, NULL);
    CHECK(memcmp(&again, &q.manifold, sizeof again) == 0);
    ovoid_manifold_points later = ovoid_manifold_compute_points(pair, &again);
    CHECK(points_are_same(&points, &later));
    if (points.count) CHECK(memcmp(&points.grown, &later.grown, sizeof points.grown) == 0);
    ovoid_pair other = {pair->shape_b, pair->shape_a, pair->pose_b, pair->pose_a};
    if (!is_same_twice) {
        ovoid_manifold found = ovoid_manifold_find(&other, &o, NULL), back = ovoid_manifold_make_swapped(&found);
        CHECK(memcmp(&back, &q.manifold, sizeof back) == 0);
        ovoid_manifold earlier = ovoid_manifold_make_swapped(&q.manifold);
        found = ovoid_manifold_find(&other, &o, &earlier);
        back = ovoid_manifold_make_swapped(&found);
        ovoid_manifold warm = ovoid_manifold_find(pair, &o, &q.manifold);
        CHECK(memcmp(&back, &warm, sizeof back) == 0);
    }
    ovoid_manifold_polygon polygon;
    if (q.manifold.count) {
        CHECK_EQ(ovoid_manifold_compute_polygon(pair, &q.manifold, &o, &polygon), OVOID_OK);
        CHECK_LE(polygon.inner, polygon.outer);
        CHECK_EQ(polygon.count, q.manifold.corners);
    }
    asked_manifold warm = ask_manifold(pair, options, &q.manifold);
    check_manifold(&warm);
}

// Each pair of shapes, apart, touching and overlapping, at three scales.
static void test_pairs(void) {
    STATIC_COVER(cover);
    static const double scales[] = {1, 1e-9, 1e9};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < SHAPES; i++)
            for (int j = i; j < SHAPES; j++)
                for (int gap = -1; gap <= 1; gap++) {
                    uint64_t s = check_seed = (uint64_t)(((k * SHAPES + i) * SHAPES + j) * 3 + gap + 2);
                    double l = scales[k];
                    ovoid_shape *a = create_shape(i, l, &s), *b = create_shape(j, l, &s);
                    ovoid_pair pair = {a, b, {{l, 2 * l, 0}, random_quat(&s)}, {{0, 0, 0}, random_quat(&s)}};
                    vec3 d = vec3_unit((vec3){random_normal(&s), random_normal(&s), random_normal(&s)});
                    if (s & 1) pair.pose_b.rotation = pair.pose_a.rotation;
                    place(&pair, d, 0.02 * l * gap, 12 * l);
                    ovoid_manifold_options o = {.margin = 0.03 * l, .cover = &cover};
                    check_all(&pair, &o, 0);
                    ovoid_shape_destroy(a);
                    ovoid_shape_destroy(b);
                }
    check_seed = 0;
}

// Bodies in the same pose, and one whose centre is that of the other; margins up to 100 times the bodies.
static void test_positions(void) {
    STATIC_COVER(cover);
    for (int i = 0; i < SHAPES; i++)
        for (int j = 0; j < SHAPES; j++) {
            uint64_t s = check_seed = (uint64_t)(1000 + i * SHAPES + j);
            ovoid_shape *a = create_shape(i, 1, &s), *b = create_shape(j, 1, &s);
            ovoid_pose pose = {{1e6, -2e6, 3}, random_quat(&s)}, home = ovoid_pose_make_identity();
            ovoid_pair same = {a, b, pose, pose}, plain = {a, b, home, home},
                       far = {a, b, home, {{30, 20, 10}, pose.rotation}};
            ovoid_manifold_options o = {.cover = &cover}, wide = {.margin = 100, .cover = &cover};
            check_all(&same, &o, i == j);
            check_all(&plain, &o, i == j);
            check_all(&far, &wide, 0);
            ovoid_shape_destroy(a);
            ovoid_shape_destroy(b);
        }
    check_seed = 0;
}

// Boxes that touch exactly: by a face, by part of it, along an edge, at a corner.
static void test_touching(void) {
    STATIC_COVER(cover);
    static const vec3 at[] = {{2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {2, 2, 2}, {0, 2, 1}, {2, 1e-7, 0}, {1, 2, 2}};
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error);
    ovoid_manifold_options o = {.margin = 1e-6, .cover = &cover};
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        ovoid_pair pair = {box, box, ovoid_pose_make_identity(), {at[i], {1, 0, 0, 0}}};
        check_all(&pair, &o, 0);
        ovoid_manifold m = ovoid_manifold_find(&pair, &o, NULL);
        CHECK(m.count >= 1);
        CHECK(m.lower <= 0 && m.upper >= 0);
    }
    ovoid_shape_destroy(box);
}

// Earlier contacts of any bytes: nothing breaks, and all but `upper` is true.
static void test_bytes(void) {
    STATIC_COVER(cover);
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error);
    for (uint64_t seed = 1; seed <= 20000; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_pair pair = {
            box, box, ovoid_pose_make_identity(), {{0.3, 0.2, 1.95}, {1, 0.01 * random_normal(&s), 0, 0}}};
        ovoid_manifold_options o = {.cover = &cover, .keep = seed & 1 ? 0.01 : 0};
        ovoid_manifold right = ovoid_manifold_find(&pair, &o, NULL), earlier = right;
        unsigned char *bytes = (unsigned char *)&earlier;
        for (int k = 0; k < 1 + (int)(seed % 40); k++)
            bytes[random_next(&s) % sizeof earlier] = (unsigned char)random_next(&s);
        earlier.memory.flags &= ~1U;
        ovoid_manifold m = ovoid_manifold_find(&pair, &o, &earlier);
        CHECK(ovoid_manifold_verify(&pair, &m, &o, NULL) == OVOID_OK);
        CHECK_LE(m.lower, right.upper);
        CHECK_LE(right.lower, m.upper);
        (void)ovoid_manifold_compute_points(&pair, &earlier);
        (void)ovoid_manifold_verify(&pair, &earlier, &o, NULL);
        ovoid_manifold_polygon polygon;
        (void)ovoid_manifold_compute_polygon(&pair, &earlier, &o, &polygon);
    }
    check_seed = 0;
    ovoid_shape_destroy(box);
}

/// Bipyramids on one another: polygons so thin that rounding makes their area less than that of four of their corners.
static void test_slivers(void) {
    STATIC_COVER(cover);
    long few = 0;
    for (int sides = 4; sides <= 12; sides += 2) {
        double xyz[3 * 14] = {0, 0, 100, 0, 0, -100};
        for (int i = 0; i < sides; i++) {
            double angle = 6.283185307179586 * i / sides;
            xyz[3 * i + 6] = cos(angle), xyz[3 * i + 7] = sin(angle);
        }
        ovoid_shape *shape = hull_of(xyz, (size_t)sides + 2, 1);
        for (uint64_t seed = 1; seed <= 60; seed++) {
            uint64_t s = check_seed = seed;
            double turn = 3.141592653589793 / sides * (double)(seed % 5);
            ovoid_pair pair = {
                shape, shape, ovoid_pose_make_identity(), {random_vec3(&s, 5e-7), {cos(turn), 0, 0, sin(turn)}}};
            ovoid_manifold_options o = {.cover = &cover};
            ovoid_manifold m = ovoid_manifold_find(&pair, &o, NULL);
            CHECK(ovoid_manifold_verify(&pair, &m, &o, NULL) == OVOID_OK);
            few += m.share == 1 && m.corners > 4;
        }
        ovoid_shape_destroy(shape);
    }
    check_seed = 0;
    CHECK(few > 10);
}

int main(void) {
    test_touching();
    test_positions();
    test_pairs();
    test_bytes();
    test_slivers();
    return check_end();
}
