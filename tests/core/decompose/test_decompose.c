// What is proven of convex parts. Truth: closed forms (an angle, a cube with a hole, a cross of two bars); and of
// random solids and parts the distances of random points by brute force in extended precision, none of which may be
// above the upper ends, and those of the points that show the lower ends, which may not be below them.
#include "countdown.h"
#include "decompositions.h"

#include <ovoid/decompose.h>

static const ovoid_decomposition_options narrow = {.tolerance = 4e-3};

static ovoid_decomposition_proof prove(const ovoid_solid *s, const ovoid_shape *const *parts, size_t count,
                                       const ovoid_decomposition_options *o) {
    ovoid_decomposition d = {s, parts, count};
    ovoid_decomposition_proof proof;
    ovoid_error error = {.message = ""};
    if (!CHECK_EQ(ovoid_decomposition_compute_proof(&d, o, &proof, &error), OVOID_OK)) printf("  %s\n", error.message);
    return proof;
}

static void check_length(const ovoid_decomposition_length *l, double truth, double tolerance) {
    CHECK_LE(l->lower, truth);
    CHECK_LE(truth, l->upper);
    CHECK_LE(l->upper - l->lower, tolerance);
}

// ---- closed forms

static ovoid_solid *make_angle(double scale) {
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_angle(&m, 4 * scale, scale, 0.5 * scale);
    ovoid_solid *s = mesh_make_solid(&m);
    mesh_clear(&m);
    return s;
}

// Two arms of length 4 and width 1: as two boxes it is itself; one box leaves the other arm's end at 3; of the hull the
// deepest point over the notch is halfway between its ends, (4 - 1) / 2 from both arms.
static void check_angle(double scale) {
    ovoid_solid *s = make_angle(scale);
    const double h = 0.5 * scale, l = 4 * scale;
    ovoid_shape *two[2] = {make_box_between((ovoid_vec3){0, 0, -h}, (ovoid_vec3){l, scale, h}),
                           make_box_between((ovoid_vec3){0, 0, -h}, (ovoid_vec3){scale, l, h})};
    const ovoid_shape *const *parts = (const ovoid_shape *const *)two;
    for (double t = 1e-1; t > 1e-9; t /= 100) {
        ovoid_decomposition_options o = {.tolerance = t * scale};
        ovoid_decomposition_proof p = prove(s, parts, 2, &o);
        check_length(&p.uncovered, 0, t * scale);
        check_length(&p.excess, 0, t * scale);
        p = prove(s, parts, 1, &o);
        check_length(&p.uncovered, 3 * scale, t * scale);
        check_length(&p.excess, 0, t * scale);
        CHECK_NEAR(p.uncovered.point.y, l, 1e-9 * scale);
    }
    ovoid_decomposition_options o = {.tolerance = 1e-2 * scale};
    ovoid_shape *hull = ovoid_shape_create_from_points(ovoid_solid_get_points(s), 12, NULL, NULL);
    const ovoid_shape *whole = hull;
    ovoid_decomposition_proof p = prove(s, &whole, 1, &o);
    check_length(&p.uncovered, 0, 1e-9 * scale);
    check_length(&p.excess, 1.5 * scale, 1e-2 * scale);
    // A search that ends early says less, and nothing that is not so.
    ovoid_decomposition_options few = {.tolerance = 1e-9 * scale, .work = 100, .cells = 4096};
    p = prove(s, &whole, 1, &few);
    check_length(&p.excess, 1.5 * scale, INFINITY);
    CHECK(p.excess.upper - p.excess.lower > 1e-6 * scale);
    ovoid_shape_destroy(hull);
    for (int i = 0; i < 2; i++) ovoid_shape_destroy(two[i]);
    ovoid_solid_destroy(s);
}

// A cube of 2 with a hole of 1 in its middle. The cube itself stands out of it by 1/2, in the hole's middle; the hole
// as a part by as much, and leaves the cube's corners uncovered by sqrt(3) / 2; nothing in the hole counts as
// uncovered.
static void check_hole(int is_inside_out) {
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_box(&m, (ovoid_vec3){-1, -1, -1}, (ovoid_vec3){1, 1, 1}, is_inside_out);
    mesh_add_box(&m, (ovoid_vec3){-0.5, -0.5, -0.5}, (ovoid_vec3){0.5, 0.5, 0.5}, !is_inside_out);
    ovoid_solid *s = mesh_make_solid(&m);
    ovoid_shape *cube = make_box_between((ovoid_vec3){-1, -1, -1}, (ovoid_vec3){1, 1, 1});
    ovoid_shape *hole = make_box_between((ovoid_vec3){-0.5, -0.5, -0.5}, (ovoid_vec3){0.5, 0.5, 0.5});
    const ovoid_shape *part = cube;
    ovoid_decomposition_proof p = prove(s, &part, 1, &narrow);
    check_length(&p.uncovered, 0, 1e-9);
    check_length(&p.excess, 0.5, 4e-3);
    part = hole;
    p = prove(s, &part, 1, &narrow);
    check_length(&p.uncovered, sqrt(0.75), 4e-3);
    check_length(&p.excess, 0.5, 4e-3);

    // A gap between two parts, inside the solid: its middle is 1/10 from both.
    mesh_clear(&m);
    mesh_add_box(&m, (ovoid_vec3){-1, -1, -1}, (ovoid_vec3){1, 1, 1}, is_inside_out);
    ovoid_solid *full = mesh_make_solid(&m);
    ovoid_shape *halves[2] = {make_box_between((ovoid_vec3){-1, -1, -1}, (ovoid_vec3){-0.1, 1, 1}),
                              make_box_between((ovoid_vec3){0.1, -1, -1}, (ovoid_vec3){1, 1, 1})};
    p = prove(full, (const ovoid_shape *const *)halves, 2, &narrow);
    check_length(&p.uncovered, 0.1, 4.1e-3);
    CHECK_NEAR(p.uncovered.point.x, 0, 8e-3);
    check_length(&p.excess, 0, 4e-3);

    // Grown by that they cover, and stand out by at most 1.18 times as much.
    ovoid_decomposition d = {full, (const ovoid_shape *const *)halves, 2};
    ovoid_parts *grown = ovoid_parts_create_enlarged(&d, p.uncovered.upper, NULL, NULL);
    CHECK_EQ(ovoid_parts_get_count(grown), 2);
    ovoid_decomposition_options wide = {.tolerance = 0.02};
    ovoid_decomposition_proof q = prove(full, ovoid_parts_get_shapes(grown), 2, &wide);
    check_length(&q.uncovered, 0, 0.02);
    CHECK_LE(q.excess.lower, 1.18 * p.uncovered.upper);
    CHECK_LE(p.uncovered.upper, q.excess.upper);
    ovoid_parts_destroy(grown);
    for (int i = 0; i < 2; i++) ovoid_shape_destroy(halves[i]);
    ovoid_shape_destroy(cube);
    ovoid_shape_destroy(hole);
    ovoid_solid_destroy(s);
    ovoid_solid_destroy(full);
    mesh_clear(&m);
}

// Two bars that cross, as one mesh that crosses itself: both count, the inside of both once.
static void check_crossing(void) {
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    const ovoid_vec3 low[2] = {{-2, -0.5, -0.5}, {-0.5, -2, -0.5}}, high[2] = {{2, 0.5, 0.5}, {0.5, 2, 0.5}};
    ovoid_shape *bars[2];
    for (int i = 0; i < 2; i++) {
        mesh_add_box(&m, low[i], high[i], 0);
        bars[i] = make_box_between(low[i], high[i]);
    }
    ovoid_solid *s = mesh_make_solid(&m);
    ovoid_decomposition_proof p = prove(s, (const ovoid_shape *const *)bars, 2, &narrow);
    check_length(&p.uncovered, 0, 4e-3);
    check_length(&p.excess, 0, 4e-3);
    p = prove(s, (const ovoid_shape *const *)bars, 1, &narrow);
    check_length(&p.uncovered, 1.5, 4e-3);
    check_length(&p.excess, 0, 4e-3);
    for (int i = 0; i < 2; i++) ovoid_shape_destroy(bars[i]);
    ovoid_solid_destroy(s);
    mesh_clear(&m);
}

// A ball, as a point with a radius, in a cube, and a cube's core with a radius.
static void check_rounded(void) {
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_box(&m, (ovoid_vec3){-1, -1, -1}, (ovoid_vec3){1, 1, 1}, 0);
    ovoid_solid *s = mesh_make_solid(&m);
    ovoid_shape *ball = ovoid_shape_create_sphere(1, NULL, NULL);
    const ovoid_shape *part = ball;
    ovoid_decomposition_options wide = {.tolerance = 0.02};
    ovoid_decomposition_proof p = prove(s, &part, 1, &wide);
    check_length(&p.uncovered, sqrt(3) - 1, 0.02);
    check_length(&p.excess, 0, 0.02);
    ovoid_shape *core =
        ovoid_shape_create_box((ovoid_vec3){0.75, 0.75, 0.75}, &(ovoid_shape_options){.radius = 0.5}, NULL);
    part = core;
    p = prove(s, &part, 1, &wide);
    check_length(&p.uncovered, 0, 0.02);
    CHECK_LE(p.excess.lower, 0.25);
    CHECK_LE(0.25, p.excess.upper);
    CHECK_LE(p.excess.upper, 0.28);
    ovoid_shape_destroy(core);
    ovoid_shape_destroy(ball);
    ovoid_solid_destroy(s);
    mesh_clear(&m);
}

// ---- random solids and parts

// Of random points none may be above the upper ends; the points that are named show the lower ends.
static void check_points(const ovoid_decomposition *d, const ovoid_decomposition_proof *p, const double *excess,
                         int points, uint64_t *s) {
    long_mesh solid = long_mesh_of_solid(d->solid), *parts = malloc(d->part_count * sizeof *parts);
    ovoid_box box = ovoid_solid_get_report(d->solid).box;
    double size = fmax(box.max.x - box.min.x, box.max.y - box.min.y), slack = 1e-9 * size;
    for (size_t i = 0; i < d->part_count; i++) parts[i] = long_mesh_of_shape(d->parts[i]);
    for (int i = 0; i < points; i++) {
        long3 x = long3_from(draw_in(s, &box));
        size_t part = random_next(s) % d->part_count;
        if (long_mesh_distance(&solid, x) <= 0)
            CHECK_LE((double)long_parts_distance(parts, d, x), p->uncovered.upper + slack);
        ovoid_polytope q = ovoid_shape_get_polytope(d->parts[part]);
        // A point of the part: a random mean of some of its vertices.
        long3 y = {0, 0, 0};
        double sum = 0;
        for (int k = 0; k < 3; k++) {
            const double *v = q.vertices + 3 * (random_next(s) % q.vertex_count);
            double w = -log(random_uniform(s, 1e-9, 1));
            y = long3_add_scaled(y, (long3){q.origin.x + v[0], q.origin.y + v[1], q.origin.z + v[2]}, w);
            sum += w;
        }
        y = (long3){y.x / sum, y.y / sum, y.z / sum};
        double out = (double)long_mesh_distance(&solid, y);
        CHECK_LE(out, p->excess.upper + slack);
        CHECK_LE(out, excess[part] + slack);
    }
    if (p->uncovered.lower > 0) {
        long3 x = long3_from(p->uncovered.point);
        CHECK_LE((double)long_mesh_distance(&solid, x), slack);
        CHECK_LE(p->uncovered.lower, (double)long_parts_distance(parts, d, x) + slack);
    }
    if (p->excess.lower > 0) {
        long3 x = long3_from(p->excess.point);
        CHECK_LE((double)long_mesh_distance(&parts[p->excess.part], x), slack);
        CHECK_LE(p->excess.lower, (double)long_mesh_distance(&solid, x) + slack);
    }
    for (size_t i = 0; i < d->part_count; i++) {
        CHECK_LE(excess[i], p->excess.upper + slack);
        free(parts[i].corners);
    }
    free(parts);
    free(solid.corners);
}

// Hulls of some of the solid's points, moved a little.
static size_t draw_parts(const ovoid_solid *solid, ovoid_shape *parts[4], double scale, uint64_t *s) {
    size_t count = 1 + random_next(s) % 4, points = ovoid_solid_get_report(solid).points;
    const double *all = ovoid_solid_get_points(solid);
    for (size_t i = 0; i < count; i++) {
        double xyz[36];
        for (int k = 0; k < 12; k++) {
            const double *from = all + 3 * (random_next(s) % points);
            for (int j = 0; j < 3; j++) xyz[3 * k + j] = from[j] + scale * random_uniform(s, -0.1, 0.1);
        }
        parts[i] = ovoid_shape_create_from_points(xyz, 12, NULL, NULL);
    }
    return count;
}

static void check_random(int rounds, double scale) {
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = 100 + (uint64_t)i;
        mesh m = {NULL, NULL, 0, 0, 0, 0};
        mesh_add_random(&m, scale, &s);
        ovoid_solid *solid = mesh_make_solid(&m);
        ovoid_shape *parts[4] = {NULL, NULL, NULL, NULL};
        ovoid_decomposition d = {solid, (const ovoid_shape *const *)parts, draw_parts(solid, parts, scale, &s)};
        ovoid_decomposition_options o = {.tolerance = 0.05 * scale, .work = 4000};
        ovoid_decomposition_proof p;
        double excess[4];
        o.excesses = excess;
        CHECK_EQ(ovoid_decomposition_compute_proof(&d, &o, &p, NULL), OVOID_OK);
        check_points(&d, &p, excess, 60, &s);
        for (int k = 0; k < 4; k++) ovoid_shape_destroy(parts[k]);
        ovoid_solid_destroy(solid);
        mesh_clear(&m);
    }
    check_seed = 0;
}

// ---- parts that are made

static ovoid_parts *make_parts(const ovoid_solid *solid, double error, size_t parts) {
    ovoid_error e = {.message = ""};
    ovoid_decomposition_options o = {.error = error, .parts = parts};
    ovoid_parts *made = ovoid_parts_create_from_solid(solid, &o, &e);
    if (!CHECK(made != NULL)) printf("  %s\n", e.message);
    return made;
}

// The angle falls into two boxes, whatever its size; as one part it is its hull.
static void check_made_angle(double scale) {
    ovoid_solid *s = make_angle(scale);
    ovoid_decomposition_options o = {.tolerance = 1e-6 * scale};
    ovoid_parts *parts = make_parts(s, 0.01 * scale, 0);
    CHECK_EQ(ovoid_parts_get_count(parts), 2);
    ovoid_decomposition_proof p = prove(s, ovoid_parts_get_shapes(parts), 2, &o);
    check_length(&p.uncovered, 0, 1e-6 * scale);
    check_length(&p.excess, 0, 1e-6 * scale);
    ovoid_parts_destroy(parts);
    parts = make_parts(s, 0, 1);
    CHECK_EQ(ovoid_parts_get_count(parts), 1);
    CHECK_EQ(ovoid_shape_get_polytope(ovoid_parts_get_shapes(parts)[0]).vertex_count, 10);
    ovoid_parts_destroy(parts);
    ovoid_solid_destroy(s);
}

// A sheet with two sides and a fold, alone and beside a box: its parts are flat, and the fold takes one cut.
static void check_made_sheet(void) {
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 5; k++) mesh_add_point(&m, i, 0.25 * k, i == 1);
    for (uint32_t i = 0; i < 2; i++)
        for (uint32_t k = 0; k < 4; k++) {
            uint32_t a = 5 * i + k, b = a + 1, c = a + 5, d = c + 1;
            mesh_add_triangle(&m, a, b, d), mesh_add_triangle(&m, a, d, c);
            mesh_add_triangle(&m, d, b, a), mesh_add_triangle(&m, c, d, a);
        }
    for (int round = 0; round < 2; round++) {
        ovoid_solid *s = mesh_make_solid(&m);
        CHECK_EQ(ovoid_solid_get_report(s).is_flat, !round);
        ovoid_parts *parts = make_parts(s, 0.05, 0);
        CHECK_LE((double)ovoid_parts_get_count(parts), 2 + 2 * round);
        ovoid_decomposition_options o = {.tolerance = 0.01};
        ovoid_decomposition_proof p = prove(s, ovoid_parts_get_shapes(parts), ovoid_parts_get_count(parts), &o);
        CHECK_LE(p.uncovered.upper, 0.01);
        CHECK_LE(p.excess.upper, 0.06);
        ovoid_parts_destroy(parts);
        ovoid_solid_destroy(s);
        mesh_add_box(&m, (ovoid_vec3){4, 0, 0}, (ovoid_vec3){5, 1, 1}, 0);
    }
    mesh_clear(&m);
}

// A long box with a square hole through it: no single plane lets any of the hole go, and
// four bars make it.
static void check_made_frame(void) {
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    static const double at[4] = {2, 2, 1, 1}, height[4] = {-4, 4, 4, -4};
    for (int ring = 0; ring < 4; ring++)
        for (int i = 0; i < 4; i++)
            mesh_add_point(&m, height[ring], i == 1 || i == 2 ? at[ring] : -at[ring], i >= 2 ? at[ring] : -at[ring]);
    for (uint32_t ring = 0; ring < 4; ring++)
        for (uint32_t i = 0; i < 4; i++) {
            uint32_t a = 4 * ring + i, b = 4 * ring + (i + 1) % 4, c = (a + 4) % 16, d = (b + 4) % 16;
            mesh_add_triangle(&m, a, b, d);
            mesh_add_triangle(&m, a, d, c);
        }
    ovoid_solid *s = mesh_make_solid(&m);
    CHECK(ovoid_solid_get_report(s).is_closed);
    ovoid_parts *parts = make_parts(s, 0.1, 0);
    CHECK_EQ(ovoid_parts_get_count(parts), 4);
    ovoid_decomposition_options o = {.tolerance = 0.02};
    ovoid_decomposition_proof p = prove(s, ovoid_parts_get_shapes(parts), ovoid_parts_get_count(parts), &o);
    check_length(&p.uncovered, 0, 0.02);
    CHECK_LE(p.excess.upper, 0.15);
    ovoid_parts_destroy(parts);
    ovoid_solid_destroy(s);
    mesh_clear(&m);
}

// Random solids: the parts cover, no more are made than asked for, and more parts stand out less.
static void check_made(int rounds) {
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = 500 + (uint64_t)i;
        mesh m = {NULL, NULL, 0, 0, 0, 0};
        mesh_add_random(&m, 1, &s);
        ovoid_solid *solid = mesh_make_solid(&m);
        double before = INFINITY;
        for (size_t count = 1; count <= 5; count += 4) {
            ovoid_parts *parts = make_parts(solid, 0, count);
            ovoid_decomposition d = {solid, ovoid_parts_get_shapes(parts), ovoid_parts_get_count(parts)};
            CHECK(d.part_count >= 1 && d.part_count <= count);
            ovoid_decomposition_options o = {.tolerance = 0.05, .work = 4000};
            ovoid_decomposition_proof p;
            double excess[9];
            o.excesses = excess;
            CHECK_EQ(ovoid_decomposition_compute_proof(&d, &o, &p, NULL), OVOID_OK);
            CHECK_LE(p.uncovered.lower, 1e-9);
            CHECK_LE(p.excess.lower, 1.2 * before + 0.05);
            check_points(&d, &p, excess, 12, &s);
            before = p.excess.upper;
            ovoid_parts_destroy(parts);
        }
        ovoid_solid_destroy(solid);
        mesh_clear(&m);
    }
    check_seed = 0;
}

// Every direction's support grows by the radius at least, and by no more than 1.18 of it.
static void check_enlarged(void) {
    uint64_t s = 7;
    ovoid_shape *box = make_box_between((ovoid_vec3){1, 2, 3}, (ovoid_vec3){2, 2.5, 7});
    ovoid_solid *solid = make_angle(1);
    const ovoid_shape *part = box;
    ovoid_decomposition d = {solid, &part, 1};
    for (double radius = 1e-12; radius < 1e3; radius *= 100) {
        ovoid_parts *grown = ovoid_parts_create_enlarged(&d, radius, NULL, NULL);
        long_mesh m = long_mesh_of_shape(ovoid_parts_get_shapes(grown)[0]), own = long_mesh_of_shape(box);
        for (int i = 0; i < 500; i++) {
            long3 n = {random_normal(&s), random_normal(&s), random_normal(&s)};
            long double norm = long3_norm(n), most = -INFINITY, before = -INFINITY;
            for (size_t k = 0; k < 3 * m.count; k++) most = fmaxl(most, long3_dot(n, m.corners[k]) / norm);
            for (size_t k = 0; k < 3 * own.count; k++) before = fmaxl(before, long3_dot(n, own.corners[k]) / norm);
            CHECK_LE(radius, (double)(most - before));
            CHECK_LE((double)(most - before), 1.18 * radius + 1e-13);
        }
        free(m.corners);
        free(own.corners);
        ovoid_parts_destroy(grown);
    }
    ovoid_shape_destroy(box);
    ovoid_solid_destroy(solid);
}

// ---- what is refused

static void check_refused(const ovoid_decomposition *d, const ovoid_decomposition_options *o, ovoid_code code,
                          const char *words) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_decomposition_proof proof;
    CHECK_EQ(ovoid_decomposition_compute_proof(d, o, &proof, &error), code);
    CHECK_EQ(error.code, code);
    if (!CHECK(strstr(error.message, words) != NULL)) printf("  \"%s\" lacks \"%s\"\n", error.message, words);
}

static void check_refusals(void) {
    ovoid_solid *s = make_angle(1);
    ovoid_shape *box = make_box_between((ovoid_vec3){0, 0, 0}, (ovoid_vec3){1, 1, 1});
    ovoid_shape_options known = {.allowance = {.outside = 0.1}};
    ovoid_shape *loose = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, &known, NULL);
    const ovoid_shape *parts[3] = {box, NULL, loose};
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_angle(&m, 4, 1, 0.5);
    m.triangles--;
    ovoid_solid *open = mesh_make_solid(&m);

    check_refused(&(ovoid_decomposition){s, parts, 0}, NULL, OVOID_ERROR_EMPTY, "no parts");
    check_refused(&(ovoid_decomposition){s, NULL, 1}, NULL, OVOID_ERROR_ARGUMENT, "NULL");
    check_refused(&(ovoid_decomposition){NULL, parts, 1}, NULL, OVOID_ERROR_ARGUMENT, "no solid");
    check_refused(&(ovoid_decomposition){open, parts, 1}, NULL, OVOID_ERROR_ARGUMENT, "not closed, 3 of its edges");
    check_refused(&(ovoid_decomposition){s, parts, 2}, NULL, OVOID_ERROR_ARGUMENT, "part 1 is NULL");
    parts[1] = loose;
    check_refused(&(ovoid_decomposition){s, parts, 2}, NULL, OVOID_ERROR_ARGUMENT, "part 1 has an allowance");
    check_refused(&(ovoid_decomposition){s, parts, OVOID_DECOMPOSITION_PARTS_MAX + 1}, NULL, OVOID_ERROR_LIMIT,
                  "65537");
    check_refused(NULL, NULL, OVOID_ERROR_ARGUMENT, "NULL");
    ovoid_decomposition d = {s, parts, 1};
    check_refused(&d, &(ovoid_decomposition_options){.tolerance = -1}, OVOID_ERROR_ARGUMENT, "tolerance -1");
    check_refused(&d, &(ovoid_decomposition_options){.tolerance = NAN}, OVOID_ERROR_ARGUMENT, "tolerance");
    check_refused(&d, &(ovoid_decomposition_options){.error = INFINITY}, OVOID_ERROR_ARGUMENT, "error");
    check_refused(&d, &(ovoid_decomposition_options){.cells = 10}, OVOID_ERROR_ARGUMENT, "10 cells");
    CHECK_EQ(ovoid_decomposition_compute_proof(&d, NULL, NULL, NULL), OVOID_ERROR_ARGUMENT);

    ovoid_error error;
    CHECK(!ovoid_parts_create_from_solid(open, NULL, &error) && error.code == OVOID_ERROR_ARGUMENT);
    CHECK(!ovoid_parts_create_from_solid(NULL, NULL, &error) && error.code == OVOID_ERROR_ARGUMENT);
    ovoid_decomposition_options many = {.parts = OVOID_DECOMPOSITION_PARTS_MAX + 1};
    CHECK(!ovoid_parts_create_from_solid(s, &many, &error) && error.code == OVOID_ERROR_LIMIT);
    CHECK(!ovoid_parts_create_enlarged(&d, -1, NULL, &error) && error.code == OVOID_ERROR_ARGUMENT);
    CHECK(!ovoid_parts_create_enlarged(&d, NAN, NULL, &error) && error.code == OVOID_ERROR_ARGUMENT);
    CHECK(!ovoid_parts_create_enlarged(&d, 1e50, NULL, &error) && error.code == OVOID_ERROR_RANGE);
    ovoid_parts_destroy(NULL);
    mesh_clear(&m);
    ovoid_solid_destroy(open);
    ovoid_solid_destroy(s);
    ovoid_shape_destroy(loose);
    ovoid_shape_destroy(box);
}

// With one allocation after another failing: MEMORY, and nothing is held.
static void check_memory(void) {
    countdown memory = {0, 0};
    ovoid_allocator allocator = countdown_make_allocator(&memory);
    ovoid_solid *s = make_angle(1);
    ovoid_decomposition_options o = {.error = 0.1, .allocator = &allocator, .cells = 4096};
    long k = 0;
    for (int is_done = 0; !is_done && k < 10000; k += 1 + k / 16) {
        ovoid_error error = {OVOID_OK, -1, ""};
        memory = (countdown){k, 0};
        ovoid_parts *parts = ovoid_parts_create_from_solid(s, &o, &error);
        is_done = parts != NULL;
        if (!parts) CHECK_EQ(error.code, OVOID_ERROR_MEMORY);
        ovoid_parts_destroy(parts);
        CHECK_EQ(memory.held, 0);
    }
    CHECK(k > 20 && k < 10000);
    ovoid_shape *box = make_box_between((ovoid_vec3){0, 0, 0}, (ovoid_vec3){1, 1, 1});
    const ovoid_shape *part = box;
    ovoid_decomposition d = {s, &part, 1};
    ovoid_code code = OVOID_ERROR_MEMORY;
    for (k = 0; code != OVOID_OK && k < 100; k++) {
        ovoid_decomposition_proof proof;
        memory = (countdown){k, 0};
        code = ovoid_decomposition_compute_proof(&d, &o, &proof, NULL);
        if (code != OVOID_OK) CHECK_EQ(code, OVOID_ERROR_MEMORY);
        CHECK_EQ(memory.held, 0);
    }
    CHECK(k > 2 && code == OVOID_OK);
    memory = (countdown){2, 0};
    CHECK(!ovoid_parts_create_enlarged(&d, 1, &o, NULL));
    CHECK_EQ(memory.held, 0);
    ovoid_shape_destroy(box);
    ovoid_solid_destroy(s);
}

int main(void) {
    check_angle(1);
    check_angle(1e-60);
    check_angle(1e40);
    check_hole(0);
    check_hole(1);
    check_crossing();
    check_rounded();
    check_random(24, 1);
    check_random(5, 1e-60);
    check_made_angle(1);
    check_made_angle(1e-30);
    check_made_angle(1e30);
    check_made_sheet();
    check_made_frame();
    check_made(3);
    check_enlarged();
    check_refusals();
    check_memory();
    return check_end();
}
