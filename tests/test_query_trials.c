// Trials of the query floor: pairs of every kind of trouble, by family, every answer of every query put before the
// exact judge (GMP), which trusts nothing but the vertices and the poses. Truth: exact arithmetic; for some small pairs
// also brute force over all features. No tolerance is involved but the judge's for witness points (their rounding).
// Without options: the first 150 rounds of seed 1, so that every run sees the same pairs (10 to 20 seconds).
//   --seconds S: as many rounds as that takes; --seed N; --family NAME; --trial SEED with a family: one trial again.
#include "trial.h"

typedef struct trial {
    ovoid_shape *a, *b;
    ovoid_pose pose_a, pose_b;
} trial;

// --- making shapes

static double log_uniform(uint64_t *r, double low, double high) {
    return low * exp(random_uniform(r, 0, 1) * log(high / low));
}

static ovoid_vec3 random_vec3(uint64_t *r, double s) {
    double x = random_normal(r), y = random_normal(r), z = random_normal(r);
    return (ovoid_vec3){s * x, s * y, s * z};
}

static ovoid_quat random_quat(uint64_t *r) {
    double w = random_normal(r), x = random_normal(r), y = random_normal(r), z = random_normal(r);
    return (ovoid_quat){w, x, y, z};
}

static ovoid_shape *make_points(const double *xyz, size_t count, double radius) {
    ovoid_shape_options options = {.radius = radius};
    ovoid_error error = {0};
    ovoid_shape *shape = ovoid_shape_create_from_points(xyz, count, &options, &error);
    if (!shape) {
        printf("no shape of %zu points (seed %llu): %s\n", count, (unsigned long long)check_seed, error.message);
        for (size_t i = 0; i < count; i++) printf(" %.17g %.17g %.17g\n", xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
        CHECK(shape != NULL);
        exit(check_end());
    }
    return shape;
}

// count points on an ellipsoid of these half axes, or filling it.
static ovoid_shape *make_hull(uint64_t *r, size_t count, ovoid_vec3 axes, ovoid_vec3 center, double radius) {
    static double xyz[3 * 5000];
    int fill = random_next(r) % 3 == 0;
    for (size_t i = 0; i < count; i++) {
        ovoid_vec3 v = random_vec3(r, 1);
        double s = (fill ? random_uniform(r, 0.2, 1) : 1) / sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
        xyz[3 * i] = center.x + axes.x * v.x * s;
        xyz[3 * i + 1] = center.y + axes.y * v.y * s;
        xyz[3 * i + 2] = center.z + axes.z * v.z * s;
    }
    return make_points(xyz, count, radius);
}

static const ovoid_vec3 origin = {0, 0, 0};

static size_t random_count(uint64_t *r, double most) { return (size_t)log_uniform(r, 4, most + 0.99); }

static ovoid_shape *make_random_hull(uint64_t *r, double most, double scale) {
    double x = log_uniform(r, 1, 4), y = log_uniform(r, 1, 4), z = log_uniform(r, 1, 4);
    return make_hull(r, random_count(r, most), (ovoid_vec3){scale * x, scale * y, scale * z}, origin, 0);
}

static ovoid_shape *make_needle(uint64_t *r) {
    double thin = log_uniform(r, 1e-8, 1e-2);
    return make_hull(r, random_count(r, 40), (ovoid_vec3){1, thin, thin}, origin, 0);
}

static ovoid_shape *make_slab(uint64_t *r) {
    return make_hull(r, random_count(r, 40), (ovoid_vec3){1, 1, log_uniform(r, 1e-8, 1e-2)}, origin, 0);
}

// A polygon in a coordinate plane (exactly flat), or in any plane (flat to rounding).
static ovoid_shape *make_flat(uint64_t *r, double radius) {
    double xyz[3 * 16];
    size_t count = 3 + (size_t)(random_next(r) % 10);
    int exact = random_next(r) % 2;
    ovoid_pose pose = {{0, 0, 0}, random_quat(r)};
    for (size_t i = 0; i < count; i++) {
        ovoid_vec3 v = {random_uniform(r, -1, 1), random_uniform(r, -1, 1), 0};
        if (!exact) v = ovoid_pose_compute_point(&pose, v);
        xyz[3 * i] = v.x, xyz[3 * i + 1] = v.y, xyz[3 * i + 2] = v.z;
    }
    return make_points(xyz, count, radius);
}

static ovoid_shape *make_segment(uint64_t *r, double radius) {
    double xyz[6];
    for (int i = 0; i < 6; i++) xyz[i] = random_uniform(r, -1, 1);
    return make_points(xyz, 2, radius);
}

static ovoid_shape *make_point(uint64_t *r, double radius) {
    double xyz[3];
    for (int i = 0; i < 3; i++) xyz[i] = random_uniform(r, -1, 1);
    return make_points(xyz, 1, radius);
}

static ovoid_shape *make_box(double x, double y, double z, double radius) {
    ovoid_shape_options options = {.radius = radius};
    return ovoid_shape_create_box((ovoid_vec3){x, y, z}, &options, NULL);
}

// Points of a coarse grid moved by rounding-sized steps: near-coplanar faces, near-duplicates, exact duplicates.
static ovoid_shape *make_grid(uint64_t *r) {
    double xyz[3 * 64];
    double jitter = random_next(r) % 3 ? log_uniform(r, 1e-17, 1e-9) : 0;
    for (int i = 0; i < 64; i++)
        for (int k = 0; k < 3; k++)
            xyz[3 * i + k] = (double)(random_next(r) % 4) - 1.5 + jitter * random_uniform(r, -1, 1);
    return make_points(xyz, 20 + (size_t)(random_next(r) % 44), 0);
}

static ovoid_shape *make_round(uint64_t *r) {
    double radius = random_next(r) % 4 ? log_uniform(r, 1e-3, 10) : log_uniform(r, 1e-12, 1e6);
    switch (random_next(r) % 6) {
    case 0: return ovoid_shape_create_sphere(radius, NULL, NULL);
    case 1: return ovoid_shape_create_capsule(1, radius, NULL, NULL);
    case 2: return make_box(1, 0.5, 0.25, radius);
    case 3: return make_flat(r, radius);
    case 4: return make_point(r, radius);
    default: return make_hull(r, random_count(r, 40), (ovoid_vec3){1, 2, 1}, origin, radius);
    }
}

static ovoid_shape *make_prism(uint64_t *r) {
    uint32_t sides = 3 + (uint32_t)(random_next(r) % 40);
    double radius = log_uniform(r, 0.2, 5);
    return random_next(r) % 2 ? ovoid_shape_create_cylinder(radius, 1, sides, NULL, NULL)
                              : ovoid_shape_create_cone(radius, 1, sides, NULL, NULL);
}

static ovoid_shape *make_any(uint64_t *r) {
    switch (random_next(r) % 9) {
    case 0: return make_needle(r);
    case 1: return make_slab(r);
    case 2: return make_flat(r, 0);
    case 3: return make_segment(r, 0);
    case 4: return make_point(r, 0);
    case 5: return make_round(r);
    case 6: return make_prism(r);
    case 7: return make_grid(r);
    default: return make_random_hull(r, 60, 1);
    }
}

// --- making pairs

static double sphere_radius(const ovoid_shape *s) {
    return ovoid_shape_get_measures(s).sphere_radius + ovoid_shape_get_radius(s);
}

// B somewhere around A: far, middle, near, over, in one place.
static trial place(uint64_t *r, ovoid_shape *a, ovoid_shape *b) {
    double size = sphere_radius(a) + sphere_radius(b);
    const double far[] = {6, 1.5, 1, 0.6, 0.2, 0};
    trial t = {a, b, {random_vec3(r, size), random_quat(r)}, {{0, 0, 0}, random_quat(r)}};
    ovoid_vec3 d = random_vec3(r, 0.6 * size * far[random_next(r) % 6]), p = t.pose_a.position;
    t.pose_b.position = (ovoid_vec3){p.x + d.x, p.y + d.y, p.z + d.z};
    return t;
}

// Moves B along the normal until the signed distance is about gap.
static void close_in(trial *t, double gap) {
    for (int i = 0; i < 4; i++) {
        ovoid_pair pair = {t->a, t->b, t->pose_a, t->pose_b};
        ovoid_answer x = ovoid_depth(&pair, NULL, NULL, NULL);
        double step = gap - (isfinite(x.lower) ? x.lower : x.upper);
        t->pose_b.position.x += x.normal.x * step;
        t->pose_b.position.y += x.normal.y * step;
        t->pose_b.position.z += x.normal.z * step;
    }
}

static trial hulls(uint64_t *r) { return place(r, make_random_hull(r, 64, 1), make_random_hull(r, 64, 1)); }
// Up to 512 vertices, and now and then 5000.
static trial large_hulls(uint64_t *r) {
    const ovoid_vec3 axes = {1, 1, 2};
    ovoid_shape *a = random_next(r) % 64 ? make_random_hull(r, 512, 1) : make_hull(r, 5000, axes, origin, 0);
    return place(r, a, make_random_hull(r, 512, 1));
}
static trial mixed(uint64_t *r) { return place(r, make_any(r), make_any(r)); }
static trial needles(uint64_t *r) { return place(r, make_needle(r), make_needle(r)); }
static trial slabs(uint64_t *r) { return place(r, make_slab(r), make_slab(r)); }
static trial flats(uint64_t *r) { return place(r, make_flat(r, 0), make_flat(r, 0)); }
static trial low_ranks(uint64_t *r) {
    ovoid_shape *a = random_next(r) % 2 ? make_segment(r, 0) : make_point(r, 0);
    return place(r, a, random_next(r) % 2 ? make_segment(r, 0) : make_any(r));
}
static trial rounds(uint64_t *r) { return place(r, make_round(r), random_next(r) % 2 ? make_round(r) : make_any(r)); }
static trial grids(uint64_t *r) { return place(r, make_grid(r), make_grid(r)); }
static trial prisms(uint64_t *r) { return place(r, make_prism(r), make_prism(r)); }

// Gaps and depths of every order, from far below rounding to a thousand sizes.
static trial gaps(uint64_t *r) {
    trial t = place(r, random_next(r) % 2 ? make_any(r) : make_random_hull(r, 40, 1), make_random_hull(r, 40, 1));
    double gap = log_uniform(r, 1e-15, random_next(r) % 2 ? 1e-6 : 1e3);
    close_in(&t, random_next(r) % 2 ? gap : -fmin(gap, 0.1));
    return t;
}

// Axis-aligned boxes of the same axes at small distances: parallel faces and edges, nothing unique.
static trial boxes(uint64_t *r) {
    const double steps[] = {0, 0.5, 1, 1.5, 2, 2.5, 1 + 0x1p-50, 2 - 0x1p-50, 2 + 0x1p-40};
    trial t = {
        make_box(0.5, 1, 1.5, 0), make_box(0.5, 1, 0.5, 0), {{0, 0, 0}, {1, 0, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}};
    double x = steps[random_next(r) % 9], y = steps[random_next(r) % 9], z = steps[random_next(r) % 9];
    t.pose_b.position = (ovoid_vec3){x, -y, z};
    // Both turned alike, by a quarter, by 3-4-5, or by anything.
    const ovoid_quat turns[] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {2, 0, 1, 0}, random_quat(r)};
    ovoid_quat q = turns[random_next(r) % 4];
    ovoid_pose turn = {{0, 0, 0}, q};
    t.pose_a.rotation = t.pose_b.rotation = q;
    t.pose_b.position = ovoid_pose_compute_point(&turn, t.pose_b.position);
    return t;
}

// One of the ways in which two boxes on dyadic coordinates touch in exactly one face, edge or point.
static trial touching(uint64_t *r) {
    // B's nearest corner, edge or face is at x = 0, A's face at x = 0 or A's edge along y at x = 0.
    static const double cube[] = {-2, -1, -1, 0, -1, -1, -2, 1, -1, 0, 1, -1, -2, -1, 1, 0, -1, 1, -2, 1, 1, 0, 1, 1};
    static const double ridge[] = {0, -1, 0, 0, 1, 0, -1, -1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1};
    static const double tip[] = {0, 0, 0, 2, 1, 1, 2, -1, 1, 2, 1, -1, 2, -1, -1};
    static const double wedge[] = {0, 0, -1, 0, 0, 1, 1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1};
    static const double plate[] = {0, -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1};
    ovoid_shape *a = random_next(r) % 3 == 0   ? make_points(ridge, 6, 0)
                     : random_next(r) % 3 == 0 ? make_points(plate, 4, 0)
                                               : make_points(cube, 8, 0);
    ovoid_shape *b = NULL;
    switch (random_next(r) % 4) {
    case 0: b = make_points(tip, 5, 0); break;
    case 1: b = make_points(wedge, 6, 0); break;
    case 2: b = make_points(plate, 4, 0); break;
    default: b = make_box(1, 0.5, 0.25, 0); break;
    }
    trial t = {a, b, {{0, 0, 0}, {1, 0, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}};
    if (ovoid_shape_get_polytope(b).vertex_count == 8) t.pose_b.position.x = 1;
    // Quarter turns about x leave x = 0 where it is; the scale is a power of two in the quaternions only.
    if (random_next(r) % 2) t.pose_b.rotation.x = 1;
    if (random_next(r) % 2) t.pose_a.rotation = (ovoid_quat){0.25, 0.25, 0, 0};
    // The same place elsewhere, exactly.
    double shift = (double)(random_next(r) % 3) * 1024.25;
    t.pose_a.position.y += shift, t.pose_b.position.y += shift;
    return t;
}

static trial identical(uint64_t *r) {
    ovoid_shape *a = make_any(r);
    trial t = {
        a, ovoid_shape_create_copy(a, NULL, NULL), {random_vec3(r, 1), random_quat(r)}, {{0, 0, 0}, {0, 0, 0, 0}}};
    t.pose_b = t.pose_a;
    return t;
}

static trial contained(uint64_t *r) {
    trial t = place(r, make_random_hull(r, 100, 1), make_random_hull(r, 30, log_uniform(r, 1e-6, 0.2)));
    ovoid_vec3 d = random_vec3(r, 0.1), p = t.pose_a.position;
    t.pose_b.position = (ovoid_vec3){p.x + d.x, p.y + d.y, p.z + d.z};
    return t;
}

// Lengths of 1e-9, 1e9, and both in one pair; then of any order that the library accepts.
static trial scales(uint64_t *r) {
    const double orders[] = {1e-9, 1, 1e9};
    double sa = orders[random_next(r) % 3], sb = random_next(r) % 2 ? sa : orders[random_next(r) % 3];
    trial t = place(r, make_random_hull(r, 40, sa), make_random_hull(r, 40, sb));
    if (random_next(r) % 2) close_in(&t, random_normal(r) * 0.01 * fmin(sa, sb));
    return t;
}
static trial wild_scales(uint64_t *r) {
    double sa = log_uniform(r, 1e-80, 1e45), sb = random_next(r) % 2 ? sa : log_uniform(r, 1e-80, 1e45);
    return place(r, make_random_hull(r, 20, sa), make_random_hull(r, 20, sb));
}

// At the ends of what is accepted: lengths up to 1e50, and below 1e-130, where nothing is resolved.
static trial huge(uint64_t *r) {
    double scale = log_uniform(r, 1e35, 2e48);
    return place(r, make_random_hull(r, 20, scale), make_random_hull(r, 20, scale * log_uniform(r, 1e-3, 1)));
}
static trial tiny(uint64_t *r) {
    double scale = log_uniform(r, 1e-305, 1e-110);
    return place(r, make_random_hull(r, 20, scale), make_random_hull(r, 20, scale * log_uniform(r, 1e-3, 1)));
}

// Far from the world's origin, and vertices far from their own.
static trial far_poses(uint64_t *r) {
    trial t = hulls(r);
    if (random_next(r) % 2) close_in(&t, random_normal(r) * 0.01);
    ovoid_vec3 d = random_vec3(r, 1e7);
    ovoid_vec3 *a = &t.pose_a.position, *b = &t.pose_b.position;
    *a = (ovoid_vec3){a->x + d.x, a->y + d.y, a->z + d.z};
    *b = (ovoid_vec3){b->x + d.x, b->y + d.y, b->z + d.z};
    return t;
}
static trial far_vertices(uint64_t *r) {
    ovoid_shape *a = make_hull(r, random_count(r, 40), (ovoid_vec3){1, 2, 1}, random_vec3(r, 1e7), 0);
    ovoid_shape *b = make_hull(r, random_count(r, 40), (ovoid_vec3){1, 2, 1}, random_vec3(r, 1e7), 0);
    ovoid_vec3 oa = ovoid_shape_get_polytope(a).origin, ob = ovoid_shape_get_polytope(b).origin;
    trial t = {a, b, {{0, 0, 0}, random_quat(r)}, {{0, 0, 0}, random_quat(r)}};
    // Brings the two clouds together again.
    ovoid_vec3 pa = ovoid_pose_compute_point(&t.pose_a, oa), pb = ovoid_pose_compute_point(&t.pose_b, ob);
    ovoid_vec3 d = random_vec3(r, 1.5);
    t.pose_b.position = (ovoid_vec3){pa.x - pb.x + d.x, pa.y - pb.y + d.y, pa.z - pb.z + d.z};
    return t;
}

static trial quaternions(uint64_t *r) {
    trial t = hulls(r);
    double norms[2] = {log_uniform(r, 1e-150, 1e150), log_uniform(r, 1e-150, 1e150)};
    ovoid_quat *q[2] = {&t.pose_a.rotation, &t.pose_b.rotation};
    for (int i = 0; i < 2; i++)
        *q[i] = (ovoid_quat){q[i]->w * norms[i], q[i]->x * norms[i], q[i]->y * norms[i], q[i]->z * norms[i]};
    if (random_next(r) % 4 == 0) q[0]->w = q[0]->x = 0x1p-1060;
    return t;
}

static trial small(uint64_t *r) {
    trial t = place(r, make_random_hull(r, 7, 1), make_random_hull(r, 7, 1));
    if (random_next(r) % 2) close_in(&t, random_normal(r) * log_uniform(r, 1e-14, 0.1));
    return t;
}

typedef struct family {
    tally counts;
    trial (*make)(uint64_t *state);
    int frames;      // moves B a little, again and again, with the last proof
    int wants_truth; // brute force too
} family;

static family families[] = {
    {{.name = "hulls"}, hulls, 1, 0},
    {{.name = "large hulls"}, large_hulls, 1, 0},
    {{.name = "small, brute force"}, small, 1, 1},
    {{.name = "mixed"}, mixed, 1, 0},
    {{.name = "needles"}, needles, 1, 0},
    {{.name = "slabs"}, slabs, 1, 0},
    {{.name = "flat"}, flats, 1, 0},
    {{.name = "segments and points"}, low_ranks, 1, 0},
    {{.name = "round"}, rounds, 1, 0},
    {{.name = "grids"}, grids, 1, 0},
    {{.name = "prisms"}, prisms, 1, 0},
    {{.name = "gaps"}, gaps, 1, 0},
    {{.name = "boxes"}, boxes, 1, 0},
    {{.name = "exact touching"}, touching, 1, 0},
    {{.name = "identical"}, identical, 1, 0},
    {{.name = "contained"}, contained, 1, 0},
    {{.name = "scales"}, scales, 1, 0},
    {{.name = "wild scales"}, wild_scales, 1, 0},
    {{.name = "huge"}, huge, 1, 0},
    {{.name = "tiny", .may_be_undecided = 1}, tiny, 1, 0},
    {{.name = "far poses"}, far_poses, 1, 0},
    {{.name = "far vertices"}, far_vertices, 1, 0},
    {{.name = "quaternions"}, quaternions, 1, 0},
    {{.name = "motion"}, mixed, 8, 0},
    {{.name = "motion of hulls"}, hulls, 8, 0},
};
#define FAMILY_COUNT (sizeof families / sizeof *families)

// The brute force's answer against the library's bracket and status.
static void compare_truth(tally *t, const ovoid_pair *pair) {
    judge_truth truth;
    if (judge_compute_truth(trial_judge, pair, &truth, NULL) != OVOID_OK) return;
    ovoid_answer x = ovoid_depth(pair, NULL, NULL, NULL);
    if (!(x.lower <= truth.high && truth.low <= x.upper))
        trial_fail(t, pair, &x, "depth", "brute force says otherwise");
    if ((x.status == OVOID_SEPARATED && truth.sign <= 0) || (x.status == OVOID_OVERLAPPING && truth.sign >= 0))
        trial_fail(t, pair, &x, "depth", "brute force has another sign");
}

static void move(trial *t, uint64_t *r) {
    double size = sphere_radius(t->a) + sphere_radius(t->b);
    ovoid_vec3 d = random_vec3(r, 0.01 * size), *p = &t->pose_b.position;
    ovoid_quat *q = &t->pose_b.rotation;
    double norm = sqrt(q->w * q->w + q->x * q->x + q->y * q->y + q->z * q->z);
    *p = (ovoid_vec3){p->x + d.x, p->y + d.y, p->z + d.z};
    *q = (ovoid_quat){q->w + 0.01 * norm * random_normal(r), q->x + 0.01 * norm * random_normal(r), q->y, q->z};
}

static void run_trial(family *f, uint64_t seed) {
    static ovoid_proof foreign;
    static int has_foreign;
    uint64_t r = check_seed = seed;
    trial t = f->make(&r);
    ovoid_proof last = foreign;
    for (int i = 0; i < f->frames; i++) {
        ovoid_pair pair = {t.a, t.b, t.pose_a, t.pose_b};
        last = trial_ask(&f->counts, &pair, i > 0 || has_foreign ? &last : NULL, &r);
        if (f->wants_truth) compare_truth(&f->counts, &pair);
        move(&t, &r);
    }
    foreign = last;
    has_foreign = 1;
    ovoid_shape_destroy(t.a);
    ovoid_shape_destroy(t.b);
    judge_forget(trial_judge);
}

#define ROUNDS 150

// seconds 0: the fixed number of rounds.
static void run_all(double seconds, uint64_t seed, const char *only) {
    double end = seconds_now() + seconds;
    for (uint64_t round = 0; seconds > 0 ? round == 0 || seconds_now() < end : round < ROUNDS; round++)
        for (size_t i = 0; i < FAMILY_COUNT; i++) {
            if (only && strcmp(only, families[i].counts.name) != 0) continue;
            uint64_t state = seed + 1000003 * round + i;
            run_trial(&families[i], random_next(&state));
        }
}

// Poses and options that are none: refused by every query, and the judge agrees.
static void test_refusals(void) {
    ovoid_shape *box = make_box(1, 1, 1, 0);
    const ovoid_pose good = {{0, 0, 0}, {1, 0, 0, 0}};
    const ovoid_pose bad[] = {
        {{NAN, 0, 0}, {1, 0, 0, 0}}, {{0, INFINITY, 0}, {1, 0, 0, 0}}, {{0, 0, 2 * OVOID_LENGTH_MAX}, {1, 0, 0, 0}},
        {{0, 0, 0}, {0, 0, 0, 0}},   {{0, 0, 0}, {1, NAN, 0, 0}},      {{0, 0, 0}, {1, 0, 0, -INFINITY}}};
    for (size_t i = 0; i < 2 * sizeof bad / sizeof *bad; i++) {
        ovoid_pair pair = {box, box, i % 2 ? bad[i / 2] : good, i % 2 ? good : bad[i / 2]};
        const ovoid_answer all[] = {ovoid_collide(&pair, NULL, NULL), ovoid_within(&pair, 1, NULL, NULL),
                                    ovoid_distance(&pair, NULL, NULL), ovoid_depth(&pair, NULL, NULL, NULL),
                                    ovoid_bounds(&pair)};
        for (int k = 0; k < 5; k++) {
            CHECK_EQ(all[k].limit, i % 2 ? OVOID_LIMIT_POSE_A : OVOID_LIMIT_POSE_B);
            CHECK_EQ(judge_check_answer(trial_judge, &pair, &all[k], NULL, NULL), OVOID_OK);
        }
    }
    ovoid_shape_destroy(box);
    judge_forget(trial_judge);
}

int main(int count, char **arguments) {
    double seconds = 0;
    uint64_t seed = 1, one = 0;
    const char *only = NULL;
    for (int i = 1; i + 1 < count; i += 2) {
        if (strcmp(arguments[i], "--seconds") == 0) seconds = atof(arguments[i + 1]);
        if (strcmp(arguments[i], "--seed") == 0) seed = strtoull(arguments[i + 1], NULL, 10);
        if (strcmp(arguments[i], "--family") == 0) only = arguments[i + 1];
        if (strcmp(arguments[i], "--trial") == 0) one = strtoull(arguments[i + 1], NULL, 10);
    }
    trial_judge = judge_create();
    if (!CHECK(trial_judge != NULL)) return check_end();
    test_refusals();
    if (one && only) {
        for (size_t i = 0; i < FAMILY_COUNT; i++)
            if (strcmp(only, families[i].counts.name) == 0) run_trial(&families[i], one);
    } else
        run_all(seconds, seed, only);
    judge_destroy(trial_judge);
    printf("seed %llu\n", (unsigned long long)seed);
    tally_print_header();
    for (size_t i = 0; i < FAMILY_COUNT; i++)
        if (families[i].counts.pairs) tally_print(&families[i].counts);
    return check_end();
}
