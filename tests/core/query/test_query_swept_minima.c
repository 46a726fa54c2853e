// Local minima of the overlap of two cores (query/swept/descend.c), and the proof by dividing the directions that one
// is the least of all (query/swept/divide.c), beside the overlaps along random directions and the minima that descents
// from these find: supports are those of the library, which test_query_swept.c holds against shapes. A box and a
// cylinder or a cone have the least of all along circles of directions (query/swept/circles.c), a hull with faces and a
// cylinder or a cone along arcs (query/swept/hull_arcs.c), two of the latter as query/swept/revolved.c says, beside the
// same; of an ellipsoid and a hull with faces, or another body, a local minimum is shown to be the least by cells
// (query/swept/hull_cells.c, query/swept/ellipsoid_cells.c).
#include "ovoid/shape.h"
#include "query/swept/divide.h"
#include "query/swept/edged.h"
#include "query/swept/ellipsoid_cells.h"
#include "query/swept/hull_cells.h"
#include "query/swept/pair.h"
#include "query/swept/profile.h"

#include "check.h"
#include "places.h"

enum {
    PAIRS = 1500,
    ROUND_PAIRS = 2000,
    HULL_PAIRS = 3000,
    REVOLVED_PAIRS = 8000,
    ELLIPSOID_PAIRS = 2000,
    DIRECTIONS = 400,
    STARTS = 8,
    POINTS = 12
};

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

/// Is a point, from the core's centre, in it, to rounding? In a hull it is behind all triangles of its shape.
static int is_in(const ovoid_swept_sphere *s, vec3 y, double rounding) {
    if (s->core == OVOID_SWEPT_ELLIPSOID) {
        const vec3 m = patch_turn(s, y);
        return vec3_norm((vec3){m.x / s->half[0], m.y / s->half[1], m.z / s->half[2]}) < 1 + 10 * rounding;
    }
    if (s->core != OVOID_SWEPT_POINTS) return swept_leave_core(s, y).distance < rounding;
    const ovoid_polytope hull = ovoid_shape_get_polytope(s->shape);
    const vec3 at = vec3_sub(patch_turn(s, y), hull.origin);
    double most = -INFINITY;
    for (uint32_t i = 0; i < hull.triangle_count; i++) {
        const uint32_t *v = &hull.triangles[3 * i];
        const vec3 a = vec3_at(hull.vertices, v[0]), b = vec3_sub(vec3_at(hull.vertices, v[1]), a),
                   c = vec3_sub(vec3_at(hull.vertices, v[2]), a);
        most = max2(most, vec3_dot(vec3_unit(vec3_cross(b, c)), vec3_sub(at, a)));
    }
    return most < rounding;
}

/// No direction has less overlap than that, whose points are in the cores. -1: it was not found; 0: the cores are
/// apart.
static int check_search(const cores *p, overlap_function *find, uint64_t *r) {
    const double least = sample_minima(p, r);
    least_overlap found;
    if (!(least > 0.01)) return 0;
    if (!find(p, 1e-13 * p->size, &found)) return -1;
    check_minimum(p, &found, least);
    CHECK(is_in(p->a, found.on_a, 2e-13 * p->size));
    CHECK(is_in(p->b, found.on_b, 2e-13 * p->size));
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

/// A hull beside the origin: of random points, of few, or a prism whose sides are of a box or more.
static ovoid_swept_sphere make_hull(int kind, double *xyz, uint64_t *r) {
    ovoid_swept_sphere s = make_turned(OVOID_SWEPT_POINTS, make_rotation(kind / 4 % 4, r), xyz, r);
    if (kind & 1) s.count = 4 + (uint32_t)(random_next(r) % (POINTS - 3));
    const uint32_t sides = 3 + (uint32_t)(random_next(r) % (POINTS / 2 - 2));
    if (kind & 2) s.count = 2 * sides;
    for (uint32_t i = 0; i < s.count && kind & 2; i++) {
        const double angle = 6.283185307179586 / sides * (double)(i / 2);
        xyz[3 * i] = 0.7 * cos(angle), xyz[3 * i + 1] = 0.7 * sin(angle), xyz[3 * i + 2] = i & 1 ? 0.4 : -0.5;
    }
    // Beside the origin of its frame, or so far that its shape has another one.
    const double far = kind & 1 ? 20 : 1, off[3] = {2 * far, -far, 0.5};
    for (int k = 0; k < 3; k++) s.half[k] = off[k];
    for (uint32_t i = 0; i < 3 * s.count; i++) s.half[i % 3] += xyz[i] / s.count, xyz[i] += off[i % 3];
    return s;
}

static int search_hull_arcs(const cores *p, double tolerance, least_overlap *at) {
    double doubt = 0;
    const int is_found = cores_search_hull_arcs(p, tolerance, at, &doubt);
    if (is_found) CHECK_LE(doubt, 3e-13 * p->size);
    return is_found;
}

/// The cells of an ellipsoid and a hull with faces, or another body.
typedef struct either_cells {
    hull_cells hull;
    ellipsoid_cells other;
    int is_hull;
} either_cells;

static double make_cells(const cores *p, either_cells *c, vec3 *n) {
    c->is_hull = cores_have_hull_cells(p);
    CHECK(c->is_hull != cores_have_ellipsoid_cells(p));
    const double height = c->is_hull ? hull_cells_make(p, &c->hull, n) : ellipsoid_cells_make(p, &c->other, n);
    if (height < INFINITY) CHECK_LE(c->is_hull ? c->hull.doubt : c->other.doubt, 3e-13 * p->size);
    return height;
}

static int hold_cells(either_cells *c, const cores *p, const least_overlap *at, double wanted, vec3 *less) {
    return c->is_hull ? hull_cells_hold(&c->hull, p, at, wanted, less)
                      : ellipsoid_cells_hold(&c->other, at, wanted, less);
}

/// From the first direction, and from where the overlap is less, or beside other bodies than hulls about as low.
static int search_cells(const cores *p, double tolerance, least_overlap *at) {
    either_cells cells;
    least_overlap now;
    vec3 n, less;
    const double height = make_cells(p, &cells, &n);
    at->value = INFINITY;
    if (!(height > 0 && height < INFINITY)) return 0;
    CHECK_NEAR(measure(p, n), height, 1e-12 * p->size);
    for (int i = 0; i < 3; i++) {
        now.count = 0;
        const int is_facet = i == 0 && cells.is_hull && hull_cells_find_facet(&cells.hull, p, &now);
        if (!is_facet && !(cores_descend(p, n, measure(p, n), &now) && now.value > 0)) return 0;
        if (now.value < at->value) *at = now;
        if (hold_cells(&cells, p, &now, at->value - 0.5 * tolerance, &less)) return 1;
        if (!(vec3_norm_squared(less) > 0)) return 0;
        CHECK_LE(measure(p, less), at->value * (cells.is_hull ? 1 : 1.01));
        n = less;
    }
    return 0;
}

/// A local minimum that is held is the least of all.
static void check_cells(const cores *p, double least, uint64_t *r, int count[2]) {
    for (int i = 0; i < 4; i++) {
        either_cells cells;
        least_overlap at;
        vec3 n, less;
        at.count = 0;
        if (!(make_cells(p, &cells, &n) < INFINITY)) return;
        n = vec3_unit((vec3){random_normal(r), random_normal(r), random_normal(r)});
        if (!cores_descend(p, n, measure(p, n), &at) || !(at.value > 0)) continue;
        const int is_held = hold_cells(&cells, p, &at, at.value - 1e-13 * p->size, &less);
        count[is_held]++;
        if (is_held) CHECK_LE(at.value, least + 1e-12 * p->size);
    }
}

/// A cylinder, a cone or an ellipsoid about in the middle of a hull; some axes are the hull's.
static ovoid_swept_sphere make_beside(const ovoid_swept_sphere *hull, int kind, uint64_t *r) {
    static const ovoid_swept_core types[] = {OVOID_SWEPT_CYLINDER, OVOID_SWEPT_CONE, OVOID_SWEPT_ELLIPSOID};
    double none[3 * POINTS];
    const ovoid_swept_core core = types[random_next(r) % 3];
    ovoid_swept_sphere s = make_turned(core, make_rotation(kind % 4, r), none, r);
    const uint64_t first = random_next(r) % 12;
    for (uint64_t k = 0; k < 3 && first < 3; k++) s.axis[k] = hull->axis[(first + k) % 3];
    const vec3 middle = patch_turn_back(hull, (vec3){hull->half[0], hull->half[1], hull->half[2]});
    s.center = vec3_add(vec3_scale(random_vec3(r, 1), 0.4), middle);
    return s;
}

static void check_hull_pairs(uint64_t *r) {
    int count[3] = {0, 0, 0}, of_cells[3] = {0, 0, 0}, shown[2] = {0, 0};
    for (int i = 0; i < HULL_PAIRS; i++) {
        double xyz[3 * POINTS];
        ovoid_swept_sphere a = make_hull((int)(random_next(r) % 16), xyz, r);
        const ovoid_swept_sphere b = make_beside(&a, i, r);
        ovoid_shape *shape = ovoid_shape_create_from_points(xyz, a.count, NULL, NULL);
        a.shape = shape;
        const cores p = {i & 1 ? &b : &a, i & 1 ? &a : &b, i & 1 ? vec3_neg(b.center) : b.center,
                         6 + vec3_norm(b.center)};
        if (cores_have_hull_arcs(&p)) count[1 + check_search(&p, search_hull_arcs, r)]++;
        if (cores_have_hull_cells(&p)) {
            of_cells[1 + check_search(&p, search_cells, r)]++;
            const double least = sample_minima(&p, r);
            if (least > 0.01) check_cells(&p, least, r, shown);
        }
        ovoid_shape_destroy(shape);
    }
    CHECK_LE(HULL_PAIRS / 4, count[2]);
    CHECK_LE(100 * count[0], count[2]);
    CHECK_LE(HULL_PAIRS / 8, of_cells[2]);
    CHECK_LE(5 * of_cells[0], of_cells[2]);
    CHECK_LE(HULL_PAIRS / 8, shown[0]);
    CHECK_LE(HULL_PAIRS / 8, shown[1]);
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

/// An ellipsoid and another body, of which some are flat and some are needles.
static void check_ellipsoid_pairs(uint64_t *r) {
    static const ovoid_swept_core types[] = {OVOID_SWEPT_SEGMENT, OVOID_SWEPT_CYLINDER, OVOID_SWEPT_CONE,
                                             OVOID_SWEPT_BOX, OVOID_SWEPT_ELLIPSOID};
    int count[3] = {0, 0, 0}, shown[2] = {0, 0};
    for (int i = 0; i < ELLIPSOID_PAIRS; i++) {
        double none[3 * POINTS];
        ovoid_swept_sphere a = make_core(types[i % 5], none, r), b = make_core(OVOID_SWEPT_ELLIPSOID, none, r);
        vec3 d = random_vec3(r, i & 1 ? 0.5 : 0.8);
        const unsigned kind = random_next(r) % 16;
        if (kind < 3) b.half[kind] *= 0.3;
        if (kind > 2 && kind < 5) a.half[kind - 3] *= 0.1;
        // Of some the axes are the other one's, or the centre is on one.
        for (int k = 0; k < 3 && kind == 6; k++) a.axis[k] = b.axis[(k + i) % 3];
        if (kind == 7) d = vec3_scale(a.axis[0], random_uniform(r, -0.5, 0.5));
        // Of many an end is in the ellipsoid.
        if (kind > 8) d = vec3_add(vec3_scale(a.axis[0], a.half[0]), random_vec3(r, 0.2));
        const cores p = {i & 2 ? &a : &b, i & 2 ? &b : &a, i & 2 ? d : vec3_neg(d), 4 + vec3_norm(d)};
        count[1 + check_search(&p, search_cells, r)]++;
        const double least = sample_minima(&p, r);
        if (least > 0.01) check_cells(&p, least, r, shown);
    }
    // Nearly all are found, but those that are apart along a direction that was not among the samples.
    CHECK_LE(ELLIPSOID_PAIRS / 2, count[2]);
    CHECK_LE(40 * count[0], count[2]);
    CHECK_LE(ELLIPSOID_PAIRS / 2, shown[0]);
    CHECK_LE(ELLIPSOID_PAIRS / 2, shown[1]);
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
    check_hull_pairs(&r);
    check_revolved_pairs(&r);
    check_ellipsoid_pairs(&r);
    return check_end();
}
