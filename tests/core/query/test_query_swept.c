// Swept spheres (query/swept/swept.c): their brackets beside those of the same bodies as shapes, whose answers are put
// before ovoid_answer_verify. Axes are the columns of the shapes' rotations, off by 36 roundings, so two true brackets
// have a common point to 2e-14 of the size. Depths also beside the widths along many directions, by supports of this
// file. Random pairs of all types and scales, parallel, right-angled and nearly parallel axes, pairs that touch; points
// in the bodies, and refused numbers.
#include "ovoid/ovoid.h"

#include "check.h"
#include "places.h"

#include <string.h>

typedef struct body {
    ovoid_swept_sphere swept;
    ovoid_posed_shape shape;
} body;

/// Has the core an axis in the place of the shape's z?
static int is_around_axis(ovoid_swept_core core) {
    return core == OVOID_SWEPT_SEGMENT || core == OVOID_SWEPT_CYLINDER || core == OVOID_SWEPT_CONE;
}
static int is_round(ovoid_swept_core core) {
    return core == OVOID_SWEPT_CYLINDER || core == OVOID_SWEPT_CONE || core == OVOID_SWEPT_ELLIPSOID;
}

/// Is a pair searched, so that its distance is within 1e-9 of the size?
static int is_searched(ovoid_swept_core a, ovoid_swept_core b) {
    if (a >= OVOID_SWEPT_ELLIPSOID || b >= OVOID_SWEPT_ELLIPSOID) return 1;
    if (a == OVOID_SWEPT_POINT || b == OVOID_SWEPT_POINT) return 0;
    return is_round(a) || is_round(b) || (a == OVOID_SWEPT_BOX && b == OVOID_SWEPT_BOX);
}

static ovoid_shape *create_shape(const ovoid_swept_sphere *s) {
    const double *half = s->half;
    ovoid_shape_options options = {0};
    switch (s->core) {
    case OVOID_SWEPT_POINT: return ovoid_shape_create_sphere(s->radius, NULL, NULL);
    case OVOID_SWEPT_SEGMENT: return ovoid_shape_create_capsule(s->radius, half[0], NULL, NULL);
    case OVOID_SWEPT_BOX:
        options.radius = s->radius;
        return ovoid_shape_create_box((ovoid_vec3){half[0], half[1], half[2]}, &options, NULL);
    case OVOID_SWEPT_POINTS:
        options.radius = s->radius;
        return ovoid_shape_create_from_points(s->points, s->count, &options, NULL);
    case OVOID_SWEPT_ELLIPSOID:
        return ovoid_shape_create_ellipsoid((ovoid_vec3){half[0], half[1], half[2]}, NULL, NULL);
    default: break;
    }
    options.tolerance = 1e-3 * half[1];
    return s->core == OVOID_SWEPT_CYLINDER ? ovoid_shape_create_cylinder(half[1], half[0], &options, NULL)
                                           : ovoid_shape_create_cone(half[1], half[0], &options, NULL);
}

/// Points in the box of the half lengths, moved off its centre by it; their mean is in their hull. Few, or more than a
/// search turns.
static void set_points(ovoid_swept_sphere *s) {
    enum { MOST = 40 };
    static double kept[2][3 * MOST];
    static int turn;
    static uint64_t r = 3;
    double *xyz = kept[turn++ % 2], mean[3] = {0, 0, 0};
    s->count = turn % 5 ? 1 + (uint32_t)random_uniform(&r, 0, 12) : MOST;
    for (uint32_t i = 0; i < 3 * s->count; i++) {
        xyz[i] = s->half[i % 3] * (1 + random_uniform(&r, -1, 1));
        mean[i % 3] += xyz[i] / s->count;
    }
    s->points = xyz;
    for (int k = 0; k < 3; k++) s->half[k] = mean[k];
}

/// The axis of a capsule, a cylinder and a cone is the third one of its frame.
static body make_body(ovoid_swept_core core, double radius, const double half[3], ovoid_vec3 center, ovoid_quat q) {
    body b = {{center, radius, core, {half[0], half[1], half[2]}, {{0, 0, 0}}, NULL, 0, NULL}, {0}};
    if (core == OVOID_SWEPT_POINTS) set_points(&b.swept);
    ovoid_pose pose = {center, q};
    double rows[9];
    ovoid_pose_compute_matrix(&pose, rows);
    for (int k = 0; k < 3; k++) b.swept.axis[k] = (ovoid_vec3){rows[k], rows[3 + k], rows[6 + k]};
    if (is_around_axis(core)) b.swept.axis[0] = b.swept.axis[2];
    b.shape = (ovoid_posed_shape){create_shape(&b.swept), {center, q}};
    // Of some hulls the faces are known.
    if (core == OVOID_SWEPT_POINTS && b.swept.count % 2) b.swept.shape = b.shape.shape;
    CHECK(b.shape.shape != NULL);
    return b;
}

static double dot(ovoid_vec3 a, ovoid_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static ovoid_vec3 between(ovoid_vec3 a, ovoid_vec3 b) { return (ovoid_vec3){b.x - a.x, b.y - a.y, b.z - a.z}; }

/// How far a point is beyond a body's surface; in a box's core -1 is enough to say.
static double measure_beyond(const ovoid_swept_sphere *s, ovoid_vec3 p) {
    ovoid_vec3 y = between(s->center, p);
    double square = dot(y, y), z = dot(y, s->axis[0]);
    if (s->core == OVOID_SWEPT_BOX) {
        double inside = 0;
        for (int i = 0; i < 3; i++) {
            double beyond = fmax(0, fabs(dot(y, s->axis[i])) - s->half[i]);
            inside += beyond * beyond;
        }
        return sqrt(inside) - s->radius;
    }
    if (s->core == OVOID_SWEPT_POINT) return sqrt(square) - s->radius;
    // Of a hull the witness' difference and the bracket tell.
    if (s->core == OVOID_SWEPT_POINTS) return -1;
    if (s->core == OVOID_SWEPT_ELLIPSOID) {
        double x = z / s->half[0], other = dot(y, s->axis[1]) / s->half[1], third = dot(y, s->axis[2]) / s->half[2];
        return (sqrt(x * x + other * other + third * third) - 1) * fmin(s->half[0], fmin(s->half[1], s->half[2]));
    }
    double along = fmax(0, fabs(z) - s->half[0]);
    ovoid_vec3 off = {y.x - z * s->axis[0].x, y.y - z * s->axis[0].y, y.z - z * s->axis[0].z};
    double r = sqrt(dot(off, off));
    if (s->core == OVOID_SWEPT_SEGMENT) return sqrt(r * r + along * along) - s->radius;
    if (s->core == OVOID_SWEPT_CYLINDER) return fmax(fabs(z) - s->half[0], r - s->half[1]);
    double h = s->half[0], R = s->half[1];
    return fmax(-h - z, (2 * h * r + R * (z - h)) / sqrt(4 * h * h + R * R));
}

/// How far a core reaches from its centre, at most.
static double measure_reach(const ovoid_swept_sphere *s) {
    double reach = 0;
    if (s->core == OVOID_SWEPT_POINTS)
        for (uint32_t i = 0; i < s->count; i++) {
            const double *p = s->points + 3 * (size_t)i;
            reach = fmax(reach, sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]));
        }
    else
        for (int k = 0; k < 3 && s->core != OVOID_SWEPT_POINT; k++) reach += s->half[k];
    return reach;
}

/// The size of a pair: no coordinate that enters the answer is larger.
static double measure_size(const body *a, const body *b) {
    ovoid_vec3 d = between(a->swept.center, b->swept.center);
    return sqrt(dot(d, d)) + (measure_reach(&a->swept) + a->swept.radius) +
           (measure_reach(&b->swept) + b->swept.radius);
}

typedef struct truth {
    double lower, upper, size;
} truth;

static truth find_truth(const body *a, const body *b) {
    ovoid_pair pair = {a->shape.shape, b->shape.shape, a->shape.pose, b->shape.pose};
    ovoid_options options = {0, 1e-11, 0, 0};
    const ovoid_answer_basis basis = {&options, NULL};
    ovoid_answer depth = ovoid_depth(&pair, &options, NULL, NULL);
    ovoid_error error = {0};
    // Without its cover only the lower bound of a depth is proven; its upper bound is that of a translation.
    if (depth.lower > 0 && !CHECK(ovoid_answer_verify(&pair, &depth, &basis, &error) == OVOID_OK))
        printf("%s\n", error.message);
    double size = measure_size(a, b), slack = 2e-14 * size;
    return (truth){depth.lower - slack, depth.upper + slack, size};
}

static void check_bracket(const ovoid_verdict *v, const truth *t) {
    CHECK_LE(v->lower, t->upper);
    CHECK_LE(t->lower, v->upper);
    CHECK_EQ((int)v->status, (int)(v->lower > 0 ? OVOID_SEPARATED : v->upper < 0 ? OVOID_OVERLAPPING : OVOID_TOUCHING));
}

/// Points on the bodies, their difference along the normal.
static void check_witness(const body *a, const body *b, const ovoid_verdict *v, const ovoid_witness *w, double size) {
    double distance = 0.5 * (v->lower + v->upper), far = fabs(a->swept.center.x) + size, slack = 1e-12 * far;
    double open = slack + (v->upper - v->lower);
    CHECK_NEAR(dot(w->normal, w->normal), 1, 1e-14);
    CHECK_NEAR(dot(between(w->point_a, w->point_b), w->normal), distance, open);
    CHECK_LE(measure_beyond(&a->swept, w->point_a), slack);
    CHECK_LE(measure_beyond(&b->swept, w->point_b), slack);
    if (distance > 0)
        CHECK_NEAR(sqrt(dot(between(w->point_a, w->point_b), between(w->point_a, w->point_b))), distance, open);
}

/// Two points of a common part: each is in its own body, and A's or B's is in both.
static void check_common(const body *a, const body *b, const ovoid_witness *w, double size) {
    double slack = 1e-12 * (fabs(a->swept.center.x) + size);
    CHECK_LE(measure_beyond(&a->swept, w->point_a), slack);
    CHECK_LE(measure_beyond(&b->swept, w->point_b), slack);
    CHECK_LE(fmin(measure_beyond(&a->swept, w->point_b), measure_beyond(&b->swept, w->point_a)), slack);
    CHECK_NEAR(dot(w->normal, w->normal), 1, 1e-14);
}

typedef struct tally {
    long calls, signs, distances, depths;
} tally;

/// A core's point that is the farthest along n, from its centre.
static ovoid_vec3 find_farthest(const ovoid_swept_sphere *s, ovoid_vec3 n) {
    const double *h = s->half;
    double along[3] = {dot(s->axis[0], n), dot(s->axis[1], n), dot(s->axis[2], n)}, m[3] = {0, 0, 0};
    if (s->core == OVOID_SWEPT_POINTS) {
        double most = -INFINITY;
        for (uint32_t i = 0; i < s->count; i++) {
            const double *p = s->points + 3 * (size_t)i;
            double height = p[0] * along[0] + p[1] * along[1] + p[2] * along[2];
            if (height > most) most = height, memcpy(m, p, sizeof m);
        }
    } else if (s->core == OVOID_SWEPT_ELLIPSOID) {
        double length = sqrt(h[0] * h[0] * along[0] * along[0] + h[1] * h[1] * along[1] * along[1] +
                             h[2] * h[2] * along[2] * along[2]);
        for (int k = 0; k < 3; k++) m[k] = h[k] * h[k] * along[k] / length;
    } else if (s->core == OVOID_SWEPT_BOX) {
        for (int k = 0; k < 3; k++) m[k] = copysign(h[k], along[k]);
    } else if (s->core == OVOID_SWEPT_SEGMENT) {
        m[0] = copysign(h[0], along[0]);
    }
    ovoid_vec3 to = {0, 0, 0}, *axis = (ovoid_vec3 *)s->axis;
    if (s->core == OVOID_SWEPT_CYLINDER || s->core == OVOID_SWEPT_CONE) {
        // Twice, since rounding leaves some of the axis in what is small.
        ovoid_vec3 off = n;
        for (int i = 0; i < 2; i++) {
            double z = dot(axis[0], off);
            off = (ovoid_vec3){off.x - z * axis[0].x, off.y - z * axis[0].y, off.z - z * axis[0].z};
        }
        double r = sqrt(dot(off, off)), scale = r > 1e-15 ? h[1] / r : 0;
        int is_apex = s->core == OVOID_SWEPT_CONE && 2 * h[0] * along[0] >= h[1] * r;
        double z = is_apex ? h[0] : s->core == OVOID_SWEPT_CONE ? -h[0] : copysign(h[0], along[0]);
        if (is_apex) scale = 0;
        return (ovoid_vec3){z * axis[0].x + scale * off.x, z * axis[0].y + scale * off.y,
                            z * axis[0].z + scale * off.z};
    }
    for (int k = 0; k < 3 && s->core != OVOID_SWEPT_POINT; k++)
        to = (ovoid_vec3){to.x + m[k] * axis[k].x, to.y + m[k] * axis[k].y, to.z + m[k] * axis[k].z};
    return to;
}

/// How far the bodies overlap along a unit n from A to B: a translation of B by that parts them.
static double measure_overlap(const body *a, const body *b, ovoid_vec3 n) {
    ovoid_vec3 back = {-n.x, -n.y, -n.z}, d = between(a->swept.center, b->swept.center);
    return dot(n, find_farthest(&a->swept, n)) - dot(n, find_farthest(&b->swept, back)) - dot(n, d) + a->swept.radius +
           b->swept.radius;
}

/// By supports of this file alone: along the normal the bodies overlap by the depth, and along no direction by less,
/// of a thousand in all directions and near the normal.
static void check_least(const body *a, const body *b, const ovoid_verdict *v, const ovoid_witness *w, double size) {
    static uint64_t r = 11;
    double slack = 1e-13 * size;
    CHECK_NEAR(measure_overlap(a, b, w->normal), -v->lower, 1e-12 * size);
    double least = INFINITY;
    for (int i = 0; i < 1000; i++) {
        double spread = i % 2 ? 1e3 : exp(random_uniform(&r, -12, 0));
        ovoid_vec3 off = random_vec3(&r, spread);
        ovoid_vec3 n = {w->normal.x + off.x, w->normal.y + off.y, w->normal.z + off.z};
        double length = sqrt(dot(n, n));
        least = fmin(least, measure_overlap(a, b, (ovoid_vec3){n.x / length, n.y / length, n.z / length}));
    }
    CHECK_LE(-v->upper - slack, least);
}

static void check_pair(const body *a, const body *b, tally *all) {
    const ovoid_swept_pair pair = {&a->swept, &b->swept};
    truth t = find_truth(a, b);
    ovoid_witness w, again;
    ovoid_verdict sign = ovoid_swept_collide(pair), depth = ovoid_swept_depth(pair, &w);
    all->calls++;
    all->signs += sign.status != OVOID_UNDECIDED;
    all->depths += depth.status != OVOID_UNDECIDED;
    if (sign.status != OVOID_UNDECIDED) check_bracket(&sign, &t);
    if (depth.status != OVOID_UNDECIDED) {
        check_bracket(&depth, &t);
        int is_loose = depth.status != OVOID_OVERLAPPING && is_searched(a->swept.core, b->swept.core);
        CHECK_LE(depth.upper - depth.lower, (is_loose ? 1e-9 : 1e-12) * t.size);
        check_witness(a, b, &depth, &w, t.size);
    }
    // What asks for less has the same answer, and an answer where that has one.
    ovoid_verdict distance = ovoid_swept_distance(pair, &again);
    all->distances += distance.status != OVOID_UNDECIDED;
    if (depth.status == OVOID_SEPARATED) CHECK(memcmp(&again, &w, sizeof w) == 0 && distance.lower == depth.lower);
    if (depth.status != OVOID_UNDECIDED) CHECK_EQ((int)distance.status, (int)depth.status);
    if (distance.status != OVOID_UNDECIDED) check_bracket(&distance, &t);
    if (distance.status == OVOID_OVERLAPPING) check_common(a, b, &again, t.size);
    ovoid_verdict contact = ovoid_swept_contact(pair, &again);
    if (depth.status == OVOID_OVERLAPPING) CHECK(memcmp(&again, &w, sizeof w) == 0 && contact.lower == depth.lower);
    if (depth.status == OVOID_OVERLAPPING && all->calls % 4 == 0) check_least(a, b, &depth, &w, t.size);
    // Two boxes that touch may be seen to overlap: then there is no contact, or that of the overlap.
    int is_as_good =
        depth.status == OVOID_TOUCHING && (contact.status == OVOID_UNDECIDED ||
                                           (contact.status == OVOID_OVERLAPPING && contact.lower >= -1e-11 * t.size));
    if (depth.status != OVOID_UNDECIDED && !is_as_good) CHECK_EQ((int)contact.status, (int)depth.status);
    if (contact.status != OVOID_UNDECIDED) check_bracket(&contact, &t);
}

static void destroy(body *b) { ovoid_shape_destroy((ovoid_shape *)b->shape.shape); }

/// Turns: none, by right angles, nearly none, any.
static ovoid_quat make_turn(int kind, uint64_t *r) {
    const double tiny = exp(random_uniform(r, -40, -2));
    if (kind == 0) return (ovoid_quat){1, 0, 0, 0};
    if (kind == 1) return (ovoid_quat){1, random_uniform(r, 0, 1) < 0.5 ? 1 : 0, 0, 0};
    if (kind == 2) return (ovoid_quat){1, tiny, -tiny, 0.5 * tiny};
    return random_quat(r);
}

static void test_random(void) {
    uint64_t r = 7;
    for (ovoid_swept_core x = OVOID_SWEPT_POINT; x <= OVOID_SWEPT_POINTS; x++)
        for (ovoid_swept_core y = OVOID_SWEPT_POINT; y <= OVOID_SWEPT_POINTS; y++) {
            int is_point = x == OVOID_SWEPT_POINT || y == OVOID_SWEPT_POINT;
            tally all = {0, 0, 0, 0};
            for (int i = 0; i < 600; i++) {
                double scale = i % 5 ? 1 : exp(random_uniform(&r, -20, 20));
                double half[2][3], radius[2];
                for (int k = 0; k < 2; k++) {
                    for (int n = 0; n < 3; n++) half[k][n] = scale * random_uniform(&r, 0.1, 1);
                    radius[k] = scale * random_uniform(&r, 0, 0.5);
                }
                // Cylinders, cones and ellipsoids have no radii as shapes; two boxes are asked with and without.
                int is_bare = x == OVOID_SWEPT_BOX && y == x && i % 2;
                if (is_round(x) || is_bare) radius[0] = 0;
                if (is_round(y) || is_bare) radius[1] = 0;
                int is_far = i % 7 == 0;
                ovoid_vec3 at = random_vec3(&r, is_far ? 1e3 * scale : scale), off = random_vec3(&r, 1.5 * scale);
                if (i % 11 == 0) off = (ovoid_vec3){0, off.y, 0};
                if (i % 13 == 0) off.x = half[0][0] + half[1][0] + radius[0] + radius[1];
                body a = make_body(x, radius[0], half[0], at, make_turn(i % 4, &r));
                body b = make_body(y, radius[1], half[1], (ovoid_vec3){at.x + off.x, at.y + off.y, at.z + off.z},
                                   make_turn(i % 3 + i % 2, &r));
                check_pair(&a, &b, &all);
                destroy(&a);
                destroy(&b);
            }
            // Most pairs are answered: where a sign is left open they touch, or edges are nearly parallel.
            int has_closed_depth = x < OVOID_SWEPT_ELLIPSOID && y < OVOID_SWEPT_ELLIPSOID;
            CHECK_LE(0.85 * (double)all.calls, (double)all.signs);
            CHECK_LE(0.85 * (double)all.calls, (double)all.distances);
            if (is_point && has_closed_depth) CHECK_LE(0.9 * (double)all.calls, (double)all.depths);
            if (!is_point) CHECK_LE(0.8 * (double)all.calls, (double)all.depths);
        }
}

/// Two boxes that only the cross product of two edges separates, and the same a little nearer; parallel edges.
static void test_edges(void) {
    const double half[3] = {1, 1, 1};
    const double turn = 0.3826834323650898, rest = 0.9238795325112867; // sine and cosine of 22.5 degrees
    tally all = {0, 0, 0, 0};
    for (int k = 0; k < 2; k++) {
        // An edge of each faces the other one: they are sqrt(2) from the centres, at right angles to each other.
        double d = 2 * 1.4142135623730951 + (k ? -1e-6 : 1e-6);
        body a = make_body(OVOID_SWEPT_BOX, 0, half, (ovoid_vec3){0, 0, 0}, (ovoid_quat){rest, 0, turn, 0});
        body b = make_body(OVOID_SWEPT_BOX, 0, half, (ovoid_vec3){d, 0, 0}, (ovoid_quat){rest, 0, 0, turn});
        const ovoid_swept_pair pair = {&a.swept, &b.swept};
        CHECK_EQ((int)ovoid_swept_collide(pair).status, (int)(k ? OVOID_OVERLAPPING : OVOID_SEPARATED));
        check_pair(&a, &b, &all);
        destroy(&a);
        destroy(&b);
        body c = make_body(OVOID_SWEPT_BOX, 0, half, (ovoid_vec3){0, 0, 0}, (ovoid_quat){1, 0, 0, 0});
        body e =
            make_body(OVOID_SWEPT_BOX, 0, half, (ovoid_vec3){k ? 1.999 : 2.001, 0.5, 0.25}, (ovoid_quat){1, 0, 0, 0});
        const ovoid_swept_pair aligned = {&c.swept, &e.swept};
        CHECK_EQ((int)ovoid_swept_collide(aligned).status, (int)(k ? OVOID_OVERLAPPING : OVOID_SEPARATED));
        destroy(&c);
        destroy(&e);
    }
}

/// A point in a box, with and without a radius: the depth is the way to the nearest face.
static void test_inside(void) {
    const double half[3] = {1, 2, 3};
    for (int i = 0; i < 12; i++) {
        double radius = i % 2 ? 0.25 : 0;
        ovoid_vec3 at = {i % 4 < 2 ? 0.75 : -0.75, 0.5, i < 6 ? 0.25 : -0.25};
        body box = make_body(OVOID_SWEPT_BOX, 0, half, (ovoid_vec3){0, 0, 0}, (ovoid_quat){1, 0, 0, 0});
        ovoid_swept_sphere ball = {at, radius, OVOID_SWEPT_POINT, {0, 0, 0}, {{0, 0, 0}}, NULL, 0, NULL};
        const ovoid_swept_pair pair = {i % 3 ? &box.swept : &ball, i % 3 ? &ball : &box.swept};
        ovoid_witness w;
        ovoid_verdict v = ovoid_swept_depth(pair, &w), sign = ovoid_swept_collide(pair);
        CHECK_NEAR(0.5 * (v.lower + v.upper), -0.25 - radius, 1e-12);
        CHECK_EQ((int)v.status, (int)OVOID_OVERLAPPING);
        CHECK_NEAR(w.normal.x, (at.x > 0) == (i % 3 > 0) ? 1 : -1, 0);
        CHECK_LE(sign.lower, -0.25 - radius);
        CHECK_EQ((int)sign.status, (int)OVOID_OVERLAPPING);
        destroy(&box);
    }
}

/// The distance of two points, a point and a segment, and a point and a box along the world's axes, in long double: the
/// bracket holds it, which the distance as it is computed in doubles is seldom.
static void test_rounding(void) {
    typedef long double real;
    uint64_t r = 21;
    const ovoid_vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const ovoid_swept_core cores[3] = {OVOID_SWEPT_POINT, OVOID_SWEPT_SEGMENT, OVOID_SWEPT_BOX};
    for (int i = 0; i < 600; i++) {
        ovoid_swept_sphere a = {random_vec3(&r, 1),
                                random_uniform(&r, 0, 0.5),
                                OVOID_SWEPT_POINT,
                                {0, 0, 0},
                                {{0, 0, 0}},
                                NULL,
                                0,
                                NULL},
                           b = a;
        b.center = random_vec3(&r, 1);
        b.core = cores[i % 3];
        for (int k = 0; k < 3; k++) b.axis[k] = axes[k], b.half[k] = random_uniform(&r, 0.01, 0.5);
        real square = 0;
        const double *from = &a.center.x, *to = &b.center.x;
        for (int k = 0; k < 3; k++) {
            real off = fabsl((real)from[k] - to[k]) - (k < (int)b.core ? b.half[k] : 0);
            square += off > 0 ? off * off : 0;
        }
        const ovoid_swept_pair pair = {i % 2 ? &a : &b, i % 2 ? &b : &a};
        ovoid_witness w;
        ovoid_verdict v = ovoid_swept_depth(pair, &w), sign = ovoid_swept_collide(pair);
        real distance = sqrtl(square) - ((real)a.radius + b.radius);
        if (v.status == OVOID_UNDECIDED || !(square > 0)) continue;
        CHECK(v.lower < distance && distance < v.upper);
        if (sign.status != OVOID_UNDECIDED) CHECK(sign.lower < distance && distance < sign.upper);
    }
}

/// Points on the axis of a cylinder and a cone, in them and beyond their ends, and in the base's plane.
static void test_axis(void) {
    const double half[3] = {2, 0.5, 0}, radius = 0.25;
    body can = make_body(OVOID_SWEPT_CYLINDER, 0, half, (ovoid_vec3){0, 0, 0}, (ovoid_quat){1, 0, 0, 0});
    body hat = make_body(OVOID_SWEPT_CONE, 0, half, (ovoid_vec3){0, 0, 0}, (ovoid_quat){1, 0, 0, 0});
    const double sine = 0.5 / sqrt(16.25);
    for (int i = 0; i < 2; i++) {
        const struct {
            double z, cylinder, cone;
        } known[4] = {{3, 1, 1}, {-3, 1, 1}, {1, -0.5, -sine}, {-1.75, -0.25, -0.25}};
        for (int k = 0; k < 4; k++) {
            ovoid_swept_sphere ball = {
                {i ? 1e-17 : 0, 0, known[k].z}, radius, OVOID_SWEPT_POINT, {0, 0, 0}, {{0, 0, 0}}, NULL, 0, NULL};
            for (int n = 0; n < 2; n++) {
                const ovoid_swept_pair pair = {&ball, n ? &hat.swept : &can.swept};
                double exact = (n ? known[k].cone : known[k].cylinder) - radius;
                ovoid_witness w;
                ovoid_verdict v = ovoid_swept_depth(pair, &w), sign = ovoid_swept_collide(pair);
                CHECK_LE(sign.lower, exact);
                CHECK_LE(exact, sign.upper);
                CHECK_EQ((int)sign.status, (int)(exact > 0 ? OVOID_SEPARATED : OVOID_OVERLAPPING));
                // From the axis to the mantle no direction has digits.
                CHECK_EQ((int)v.status, (int)(k == 2 ? OVOID_UNDECIDED : sign.status));
                if (k != 2) CHECK_NEAR(0.5 * (v.lower + v.upper), exact, 1e-12);
            }
        }
    }
    destroy(&can);
    destroy(&hat);
}

static void check_refused(const ovoid_swept_sphere *a, const ovoid_swept_sphere *b) {
    const ovoid_swept_pair pair = {a, b}, other = {b, a};
    ovoid_witness w, before;
    memset(&w, 7, sizeof w);
    before = w;
    CHECK_EQ((int)ovoid_swept_collide(pair).status, (int)OVOID_UNDECIDED);
    CHECK_EQ((int)ovoid_swept_collide(other).status, (int)OVOID_UNDECIDED);
    CHECK_EQ((int)ovoid_swept_depth(pair, &w).status, (int)OVOID_UNDECIDED);
    CHECK_EQ((int)ovoid_swept_distance(other, &w).status, (int)OVOID_UNDECIDED);
    CHECK_EQ((int)ovoid_swept_contact(pair, &w).status, (int)OVOID_UNDECIDED);
    CHECK(memcmp(&w, &before, sizeof w) == 0);
}

static void test_refused(void) {
    const ovoid_swept_sphere plain[3] = {
        {{0.1, 0.2, 0.3}, 0.5, OVOID_SWEPT_POINT, {0, 0, 0}, {{0, 0, 0}}, NULL, 0, NULL},
        {{0.1, 0.2, 0.3}, 0.5, OVOID_SWEPT_SEGMENT, {1, 0, 0}, {{1, 0, 0}}, NULL, 0, NULL},
        {{0.1, 0.2, 0.3}, 0, OVOID_SWEPT_BOX, {1, 1, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, NULL, 0, NULL}};
    for (int k = 0; k < 3; k++)
        for (int n = 0; n < 3; n++) {
            ovoid_swept_sphere wrong = plain[n];
            wrong.center.y = NAN;
            check_refused(&plain[k], &wrong);
            wrong.center.y = 1e60;
            check_refused(&plain[k], &wrong);
            wrong.center.y = 3;
            wrong.radius = -0.1;
            check_refused(&plain[k], &wrong);
            wrong.radius = NAN;
            check_refused(&plain[k], &wrong);
        }
    // A length that a core has, and only that, is not below 0.
    static const int lengths[] = {0, 1, 2, 3, 2, 3};
    for (int core = OVOID_SWEPT_POINT; core <= OVOID_SWEPT_ELLIPSOID; core++)
        for (int k = 0; k < 3; k++) {
            ovoid_swept_sphere below = plain[2];
            below.core = (ovoid_swept_core)core;
            below.radius = 0.5;
            below.center.x = 9;
            below.half[k] = -1;
            if (k < lengths[core])
                for (int n = 0; n < 3; n++) check_refused(&plain[n], &below);
            else
                CHECK_EQ((int)ovoid_swept_distance((ovoid_swept_pair){&plain[1], &below}, NULL).status,
                         (int)OVOID_SEPARATED);
        }
    const ovoid_swept_sphere small = {{0, 0, 0}, 1e-60, OVOID_SWEPT_POINT, {0, 0, 0}, {{0, 0, 0}}, NULL, 0, NULL};
    check_refused(&small, &small);
}

int main(void) {
    test_random();
    test_edges();
    test_inside();
    test_rounding();
    test_axis();
    test_refused();
    return check_end();
}
