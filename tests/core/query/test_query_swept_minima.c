// Local minima of the overlap of two cores (query/swept/descend.c), and the proof by dividing the directions that one
// is the least of all (query/swept/divide.c), beside the overlaps along random directions and the minima that descents
// from these find: supports are those of the library, which test_query_swept.c holds against shapes. A box and a
// cylinder or a cone have the least of all along circles of directions (query/swept/circles.c), two of the latter as
// query/swept/revolved.c says, beside the same.
#include "query/swept/circles.h"
#include "query/swept/divide.h"
#include "query/swept/pair.h"
#include "query/swept/revolved.h"

#include "check.h"
#include "places.h"

enum { PAIRS = 1500, ROUND_PAIRS = 2000, REVOLVED_PAIRS = 8000, DIRECTIONS = 400, STARTS = 8, POINTS = 12 };

/// A random core around the origin at a rotation, of about size 1.
static ovoid_swept_sphere make_turned(ovoid_swept_core core, ovoid_quat rotation, double *xyz, uint64_t *r) {
    ovoid_swept_sphere s = {.core = core, .count = POINTS, .points = xyz};
    double rows[9];
    const ovoid_pose pose = {{0, 0, 0}, rotation};
    ovoid_pose_compute_matrix(&pose, rows);
    for (int k = 0; k < 3; k++) {
        s.axis[k] = (ovoid_vec3){rows[k], rows[3 + k], rows[6 + k]};
        s.half[k] = core == OVOID_SWEPT_POINTS ? 0 : random_uniform(r, 0.2, 1);
    }
    for (int i = 0; i < 3 * POINTS; i++) xyz[i] = random_uniform(r, -1, 1);
    for (int i = 0; i < 3 * POINTS && core == OVOID_SWEPT_POINTS; i++) s.half[i % 3] += xyz[i] / POINTS;
    return s;
}

static ovoid_swept_sphere make_core(ovoid_swept_core core, double *xyz, uint64_t *r) {
    return make_turned(core, random_quat(r), xyz, r);
}

static double measure(const cores *p, vec3 n) { return vec3_dot(cores_find_ends(p, n).v, n); }

/// Around both ways of each axis: six that hold all directions.
static const direction_caps all_directions = {6,
                                              {{{1, 0, 0}, 0.577},
                                               {{-1, 0, 0}, 0.577},
                                               {{0, 1, 0}, 0.577},
                                               {{0, -1, 0}, 0.577},
                                               {{0, 0, 1}, 0.577},
                                               {{0, 0, -1}, 0.577}}};

/// What descents found, and how many of their minima were shown to be the least, or not.
typedef struct tally {
    int found, failed, proven, refused;
} tally;

/// The least overlap along random directions, and the direction.
static double sample(const cores *p, uint64_t *r, vec3 *best) {
    double least = INFINITY;
    for (int i = 0; i < DIRECTIONS; i++) {
        const vec3 n = vec3_unit((vec3){random_normal(r), random_normal(r), random_normal(r)});
        const double h = measure(p, n);
        if (h < least) least = h, *best = n;
    }
    return least;
}

/// A minimum is not above the overlap where its descent begins, which is that along its own direction, and its points
/// are apart by that.
static void check_minimum(const cores *p, const least_overlap *at, double height) {
    const double rounding = 1e-11 * p->size;
    const vec3 off = vec3_sub(vec3_sub(vec3_sub(at->on_a, at->on_b), p->d), vec3_scale(at->of.n, at->value));
    CHECK_LE(at->value, height + rounding);
    CHECK_NEAR(measure(p, at->of.n), at->value, rounding);
    CHECK_LE(vec3_norm(off), 1e-8 * p->size);
}

static void check_pair(const cores *p, uint64_t *r, tally *to) {
    vec3 n = {0, 0, 1};
    double least = sample(p, r, &n), proven = -INFINITY;
    if (!(least > 0.01)) return;
    for (int i = 0; i < STARTS; i++) {
        least_overlap at;
        at.count = 0;
        const double height = measure(p, n);
        if (cores_descend(p, n, height, &at) && at.value > 0) {
            to->found++;
            check_minimum(p, &at, height);
            least = min2(least, at.value);
            const double wanted = at.value - 1e-12 * p->size;
            const int is_proven = cores_divide(p, &at, wanted, &all_directions);
            to->proven += is_proven, to->refused += !is_proven;
            if (is_proven) proven = max2(proven, wanted);
        } else {
            to->failed++;
        }
        n = vec3_unit((vec3){random_normal(r), random_normal(r), random_normal(r)});
    }
    // No overlap is less than what was shown to be the least.
    CHECK_LE(proven, least + 1e-12 * p->size);
}

/// How a rotation differs from that of no turn: not, by little, around one axis, or in any way.
static ovoid_quat make_rotation(int kind, uint64_t *r) {
    const double angle = kind == 1 ? random_uniform(r, -1e-7, 1e-7) : random_uniform(r, -3, 3);
    const int axis = (int)(random_next(r) % 3);
    if (kind == 3) return random_quat(r);
    if (kind == 0) return (ovoid_quat){1, 0, 0, 0};
    return (ovoid_quat){1, axis == 0 ? angle : 0, axis == 1 ? angle : 0, axis == 2 ? angle : 0};
}

/// The least overlap along random directions, and where descents from some of them end.
static double sample_minima(const cores *p, uint64_t *r) {
    vec3 n = {0, 0, 1};
    double least = sample(p, r, &n);
    for (int i = 0; i < STARTS && least > 0.01; i++) {
        least_overlap at;
        at.count = 0;
        if (cores_descend(p, n, measure(p, n), &at) && at.value > 0) least = min2(least, at.value);
        n = vec3_unit((vec3){random_normal(r), random_normal(r), random_normal(r)});
    }
    return least;
}

/// A local minimum that is shown to be the least of all is that, whatever it is: a search would not take most of these.
static void check_spots(const cores *p, double least, uint64_t *r, int count[2]) {
    profiles q;
    if (!profiles_make(p, 1e-13 * p->size, &q)) return;
    for (int i = 0; i < 8; i++) {
        const int k = i >> 1 & 1, is_up = i & 1;
        const double sign = is_up ? 1 : -1;
        profile_spot spot = {PROFILE_END, k, is_up, {0, 0}, {sign, sign}, 0, q.end[k][is_up].value};
        spot.y[1 - k] *= q.c;
        double lower[2] = {random_uniform(r, -1, 1), random_uniform(r, -1, 1)};
        if (i > 3 && !profiles_find_spot_near(&q, lower, INFINITY, &spot)) continue;
        const int is_held = revolved_hold(&q, &spot, lower) == HELD;
        count[is_held]++;
        if (is_held) CHECK_LE(spot.value, least + 1e-12 * p->size);
    }
}

/// Of a search that says that it found the least overlap of all: the cores, the tolerance, and the overlap.
typedef int overlap_function(const cores *p, double tolerance, least_overlap *at);

/// No direction has less overlap than that, whose points are in the cores. -1: it was not found; 0: the cores are
/// apart.
static int check_search(const cores *p, overlap_function *find, uint64_t *r) {
    const double least = sample_minima(p, r);
    least_overlap found;
    if (!(least > 0.01)) return 0;
    if (!find(p, 1e-13 * p->size, &found)) return -1;
    check_minimum(p, &found, least);
    CHECK(swept_leave_core(p->a, found.on_a).distance < 1e-12);
    CHECK(swept_leave_core(p->b, found.on_b).distance < 1e-12);
    return 1;
}

static void check_round_pairs(uint64_t *r) {
    int count[3] = {0, 0, 0};
    for (int i = 0; i < ROUND_PAIRS; i++) {
        const ovoid_swept_core core = i & 1 ? OVOID_SWEPT_CONE : OVOID_SWEPT_CYLINDER;
        double xyz[3 * POINTS];
        const ovoid_swept_sphere a = make_core(OVOID_SWEPT_BOX, xyz, r);
        ovoid_swept_sphere b = make_turned(core, make_rotation(i / 4 % 4, r), xyz, r), turned = b;
        for (int k = 0; k < 3; k++) turned.axis[k] = patch_turn_back(&a, b.axis[k]);
        const vec3 d = random_vec3(r, 0.5);
        const cores p = {i & 2 ? &turned : &a, i & 2 ? &a : &turned, d, 4 + vec3_norm(d)};
        CHECK(cores_have_circles(&p));
        count[1 + check_search(&p, cores_search_circles, r)]++;
    }
    // Most overlap, and most of these are found: the axes of half are at right angles, or nearly.
    CHECK_LE(ROUND_PAIRS / 3, count[2]);
    CHECK_LE(20 * count[0], count[2]);
}

/// A cylinder or a cone, of which some are flat and some are needles.
static ovoid_swept_sphere make_revolved(uint64_t *r) {
    double xyz[3 * POINTS];
    ovoid_swept_sphere s = make_core(random_next(r) & 1 ? OVOID_SWEPT_CONE : OVOID_SWEPT_CYLINDER, xyz, r);
    const unsigned kind = random_next(r) % 8;
    if (kind < 2) s.half[kind] *= 0.1;
    return s;
}

/// Of parallel axes nothing is left open: the cores are apart along the direction that is found.
static void check_apart(const cores *p) {
    profile_spot spot;
    vec3 n;
    CHECK(!profiles_search_parallel(p, &spot, &n));
    CHECK_LE(measure(p, n), 0);
}

static void check_revolved_pairs(uint64_t *r) {
    int count[3] = {0, 0, 0}, spots[2] = {0, 0};
    for (int i = 0; i < REVOLVED_PAIRS; i++) {
        ovoid_swept_sphere a = make_revolved(r), b = make_revolved(r);
        const vec3 d = i % 32 == 29 ? vec3_scale(a.axis[0], random_uniform(r, -1, 1)) : random_vec3(r, i & 1 ? 0.5 : 1);
        // Of some the axes are parallel, or one, or nearly parallel; or the centres are nearly in one plane with both.
        if (i % 8 == 1) b.axis[0] = vec3_unit(vec3_add_scaled(a.axis[0], b.axis[0], 0.1));
        if (i % 8 == 5) b.axis[0] = i & 8 ? a.axis[0] : vec3_neg(a.axis[0]);
        if (i % 8 == 3) b.axis[0] = vec3_unit(vec3_add_scaled(vec3_add_scaled(d, a.axis[0], 0.5), b.axis[0], 1e-3));
        const cores p = {&a, &b, d, 4 + vec3_norm(d)};
        CHECK(cores_are_revolved(&p));
        const int is_found = check_search(&p, cores_search_revolved, r);
        count[1 + is_found]++;
        if (i % 8 == 5 && is_found < 0) check_apart(&p);
        const double least = sample_minima(&p, r);
        if (least > 0.01) check_spots(&p, least, r, spots);
    }
    // Most of those that overlap are found.
    CHECK_LE(REVOLVED_PAIRS / 3, count[2]);
    CHECK_LE(3 * count[0], count[2]);
    CHECK_LE(REVOLVED_PAIRS / 3, spots[0]);
    CHECK_LE(REVOLVED_PAIRS / 3, spots[1]);
}

int main(void) {
    static const ovoid_swept_core types[] = {OVOID_SWEPT_SEGMENT, OVOID_SWEPT_CYLINDER,  OVOID_SWEPT_BOX,
                                             OVOID_SWEPT_CONE,    OVOID_SWEPT_ELLIPSOID, OVOID_SWEPT_POINTS};
    uint64_t r = check_seed = 5;
    tally all = {0, 0, 0, 0};
    for (int i = 0; i < PAIRS; i++) {
        double xyz[2][3 * POINTS];
        const ovoid_swept_sphere a = make_core(types[random_next(&r) % 6], xyz[0], &r),
                                 b = make_core(types[random_next(&r) % 6], xyz[1], &r);
        const vec3 d = random_vec3(&r, 0.5);
        check_pair(&(cores){&a, &b, d, 4 + vec3_norm(d)}, &r, &all);
    }
    // Most descents end, and of the minima some are the least and shown to be, others are not the least.
    CHECK_LE(20 * all.failed, all.found);
    CHECK_LE(all.found, 5 * all.proven);
    CHECK_LE(all.found, 10 * all.refused);
    check_round_pairs(&r);
    check_revolved_pairs(&r);
    return check_end();
}
