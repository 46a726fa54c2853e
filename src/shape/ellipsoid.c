// Ellipsoids: their points, and their polyhedron as a shape.
//
// The polyhedron of n steps is the hull of the grid's points. Scaling by the half axes maps hulls to hulls, and so do
// the ellipsoids of smallest and largest volume: those of the unit sphere's polyhedron, which has the symmetry of a
// cube, are balls, the outer one the sphere itself. Its triangles are the grid's, and the ball of radius 1 - 1 / n^2 is
// in it: the largest triangles, in the middle of the octahedron's faces, have corners that are less than sqrt(2) / n
// from the normal of their plane. (test_shape_ellipsoid.c measures every n.) So the ellipsoid exceeds its polyhedron by
// at most a / n^2, a the largest half axis.
#include "shape/ellipsoid.h"

#include "base/allocator.h"
#include "base/arena.h"
#include "base/environment.h"
#include "base/error.h"
#include "shape/create.h"
#include "shape/rim.h"

#include <string.h>

enum { STEPS_LEAST = 2, STEPS_DEFAULT = 4, STEPS_MOST = 64 };

// The least half axis of a true ellipsoid, as a part of the largest, and the largest one's least length: squares and
// their quotients stay normal numbers.
#define FLATTEST 1e-6
#define LEAST_LENGTH 1e-60

static vec3 find_grid_point(vec3 half, int x, int y, int z) {
    double length = sqrt((double)(x * x + y * y + z * z));
    return (vec3){half.x * (x / length), half.y * (y / length), half.z * (z / length)};
}

uint32_t ellipsoid_find_number(vec3 m) {
    const double steps = ELLIPSOID_STEPS;
    double scale = steps / (fabs(m.x) + fabs(m.y) + fabs(m.z)), u = 0, v = 0;
    if (scale > 0 && scale < INFINITY) u = m.x * scale, v = m.y * scale;
    if (m.z < 0) {
        double folded = copysign(steps - min2(fabs(v), steps), u);
        v = copysign(steps - min2(fabs(u), steps), v);
        u = folded;
    }
    uint32_t i = (uint32_t)(u + (steps + 0.5)), j = (uint32_t)(v + (steps + 0.5));
    return RIM_POINT + i * ELLIPSOID_SIDE + j;
}

vec3 ellipsoid_compute_point(vec3 half, uint32_t number) {
    const int steps = ELLIPSOID_STEPS;
    uint32_t place = number - RIM_POINT;
    int x = (int)(place / ELLIPSOID_SIDE) - steps, y = (int)(place % ELLIPSOID_SIDE) - steps;
    int across = x < 0 ? -x : x, along = y < 0 ? -y : y, z = steps - across - along;
    if (z < 0) {
        x = x < 0 ? along - steps : steps - along;
        y = y < 0 ? across - steps : steps - across;
    }
    return find_grid_point(half, x, y, z);
}

// ---- the polyhedron
//
// Its vertices are in rings from the upper tip down; ring k has the height z = n - k and m = min(k, 2 n - k) vertices
// in each quadrant, counter-clockwise from x = m, y = 0; one if m = 0.

static uint32_t get_ring(uint32_t n, uint32_t k) { return k < n ? k : 2 * n - k; }
static uint32_t count_vertices(uint32_t n) { return 4 * n * n + 2; }
static uint32_t count_ring(uint32_t m) { return m ? 4 * m : 1; }

// The first vertex of ring k.
static uint32_t find_ring(uint32_t n, uint32_t k) {
    uint32_t m = get_ring(n, k);
    if (k <= n) return k ? 1 + 2 * k * (k - 1) : 0;
    return count_vertices(n) - (1 + 2 * m * (m + 1));
}

// Vertex i of ring k. + 0.0 makes every zero a positive one.
static vec3 find_vertex(vec3 half, uint32_t n, uint32_t k, uint32_t i) {
    int m = (int)get_ring(n, k), s = m ? (int)i % m : 0, x = m - s, y = s;
    for (int quarter = m ? (int)i / m : 0; quarter > 0; quarter--) {
        int turned = -y;
        y = x;
        x = turned;
    }
    return vec3_clear_signs(find_grid_point(half, x, y, (int)n - (int)k));
}

static void fill_vertices(vec3 half, uint32_t n, double *xyz) {
    for (uint32_t k = 0; k <= 2 * n; k++)
        for (uint32_t i = 0; i < count_ring(get_ring(n, k)); i++, xyz += 3) {
            vec3 v = find_vertex(half, n, k, i);
            xyz[0] = v.x, xyz[1] = v.y, xyz[2] = v.z;
        }
}

static uint32_t *put_triangle(uint32_t *to, uint32_t a, uint32_t b, uint32_t c) {
    to[0] = a, to[1] = b, to[2] = c;
    return to + 3;
}

// Between a ring of m and one of m + 1 vertices a quadrant, from their first vertices; counter-clockwise from outside
// where the wide one is below.
static uint32_t *put_band(uint32_t *to, uint32_t narrow, uint32_t wide, uint32_t m, int is_upper) {
    uint32_t around = 4 * (m + 1), within = count_ring(m);
    for (uint32_t quarter = 0; quarter < 4; quarter++)
        for (uint32_t s = 0; s <= m; s++) {
            uint32_t w = wide + quarter * (m + 1) + s, next = wide + (quarter * (m + 1) + s + 1) % around;
            uint32_t v = narrow + (quarter * m + s) % within;
            to = put_triangle(to, v, is_upper ? w : next, is_upper ? next : w);
            if (s == m) continue;
            uint32_t beside = narrow + (quarter * m + s + 1) % within;
            to = put_triangle(to, next, is_upper ? beside : v, is_upper ? v : beside);
        }
    return to;
}

static void fill_triangles(uint32_t n, uint32_t *to) {
    for (uint32_t k = 0; k < n; k++) to = put_band(to, find_ring(n, k), find_ring(n, k + 1), k, 1);
    for (uint32_t k = n; k < 2 * n; k++) to = put_band(to, find_ring(n, k + 1), find_ring(n, k), 2 * n - k - 1, 0);
}

// ---- the shape

static double find_outside(vec3 half, uint32_t n) { return vec3_max_abs(half) / ((double)n * n); }
static double find_inside(vec3 half) { return vec3_max_abs(half) * (8 * 0x1p-53); }

int ellipsoid_is_held(const ovoid_shape *s, vec3 half) {
    uint32_t n = STEPS_LEAST;
    while (count_vertices(n) < s->vertex_count && n < STEPS_MOST) n++;
    vec3 axis = s->allowance.axis, origin = s->origin;
    if (count_vertices(n) != s->vertex_count || vec3_max_abs(origin) > 0 || vec3_max_abs(axis) > 0) return 0;
    if (s->allowance.outside != find_outside(half, n) || s->allowance.inside != find_inside(half)) return 0;
    const double *at = shape_vertices(s);
    for (uint32_t k = 0; k <= 2 * n; k++)
        for (uint32_t i = 0; i < count_ring(get_ring(n, k)); i++, at += 3) {
            vec3 v = find_vertex(half, n, k, i);
            if (v.x != at[0] || v.y != at[1] || v.z != at[2]) return 0;
        }
    return 1;
}

// The fewest steps that meet the tolerance, or more than STEPS_MOST.
static uint32_t find_steps(vec3 half, double tolerance) {
    if (!(tolerance > 0)) return STEPS_DEFAULT;
    uint32_t n = STEPS_LEAST;
    while (n <= STEPS_MOST && find_outside(half, n) > tolerance) n++;
    return n;
}

static ovoid_fit make_fit(vec3 half, double scale, double gap) {
    vec3 a = vec3_scale(half, scale);
    ovoid_fit fit = {.volume = 4.1887902047863905 * a.x * a.y * a.z, .gap = gap, .converged = gap <= 1e-6};
    fit.ellipsoid.q = (sym3){a.x * a.x, 0, 0, a.y * a.y, 0, a.z * a.z};
    return fit;
}

// The outer ellipsoid is the body's, enlarged by more than the roundings of vertices and proof; no ellipsoid in the
// polyhedron is larger than the body.
static void set_fits(ovoid_shape *shape, vec3 half, uint32_t n) {
    double ball = 1 - 1 / ((double)n * n);
    ovoid_fit outer = make_fit(half, 1 + 0x1p-40, 0x1p-38), inner = make_fit(half, ball, 1 / (ball * ball * ball) - 1);
    shape_set_fits(shape, &outer, &inner);
}

// The vertices and triangles of a polyhedron.
typedef struct grid {
    vec3 half;
    uint32_t steps;
    double *xyz;
    uint32_t *triangles;
} grid;

static ovoid_shape *create_solid(const grid *g, const ovoid_shape_options *o, const ovoid_allocator *work,
                                 ovoid_error *error) {
    surface_claim claim = {g->xyz, count_vertices(g->steps), g->triangles, 8 * g->steps * g->steps, {0, 0, 0}};
    surface_flaw flaw;
    hull polytope;
    ovoid_code code = hull_create_proven(&claim, work, &polytope, &flaw);
    if (code != OVOID_OK) {
        error_write(error, code, -1, "the polyhedron of an ellipsoid has no hull: %s", flaw.what);
        return NULL;
    }
    ovoid_shape *shape = shape_create_block(&polytope, o->allocator, work, error);
    if (shape) {
        block_set_radius(shape, o->radius, o->allowance);
        shape->report = polytope.report;
        set_fits(shape, g->half, g->steps);
    }
    hull_destroy(&polytope, work);
    return shape;
}

static int is_known(const ovoid_shape_options *given) {
    return !given || (!(given->allowance.outside > 0) && !(given->allowance.inside > 0));
}

static ovoid_shape *create_from_grid(grid *g, const ovoid_shape_options *given, ovoid_error *error) {
    ovoid_shape_options o;
    if (shape_options_make(given, &o, error) != OVOID_OK) return NULL;
    o.allowance.axis = (vec3){0, 0, 0};
    o.allowance.outside += find_outside(g->half, g->steps);
    o.allowance.inside += find_inside(g->half);
    _Alignas(64) char buffer[SHAPE_WORK_SIZE];
    ovoid_allocator allocator = allocator_make(o.allocator);
    arena a;
    ovoid_allocator work = arena_make(&a, &allocator, buffer, sizeof buffer);
    size_t count = count_vertices(g->steps), triangles = 8 * (size_t)g->steps * g->steps;
    g->xyz = allocator_allocate(&work, count, 3 * sizeof *g->xyz);
    g->triangles = allocator_allocate(&work, triangles, 3 * sizeof *g->triangles);
    double most = vec3_max_abs(g->half), least = min2(g->half.x, min2(g->half.y, g->half.z));
    ovoid_shape *shape = NULL;
    if (!g->xyz || !g->triangles) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for an ellipsoid of %zu vertices", count);
    } else {
        fill_vertices(g->half, g->steps, g->xyz);
        fill_triangles(g->steps, g->triangles);
        int is_solid = least >= FLATTEST * most && most >= LEAST_LENGTH;
        if (is_solid)
            shape = create_solid(g, &o, &work, error);
        else
            shape = shape_create_from_points((xyz_points){g->xyz, count}, &o, error);
        if (shape && is_solid && is_known(given))
            shape->round = (ovoid_round){.kind = OVOID_ROUND_ELLIPSOID, .half_axes = g->half};
    }
    allocator_release(&work, g->triangles);
    allocator_release(&work, g->xyz);
    return shape;
}

static ovoid_shape *create_ellipsoid(vec3 half, const ovoid_shape_options *options, ovoid_error *error) {
    const double lengths[3] = {half.x, half.y, half.z};
    for (int i = 0; i < 3; i++)
        if (!(lengths[i] >= 0 && lengths[i] <= OVOID_LENGTH_MAX)) {
            ovoid_code code = !isfinite(lengths[i]) ? OVOID_ERROR_NOT_FINITE
                              : lengths[i] < 0      ? OVOID_ERROR_ARGUMENT
                                                    : OVOID_ERROR_RANGE;
            error_write(error, code, -1, "the half axis %g is not in [0, %g]", lengths[i], OVOID_LENGTH_MAX);
            return NULL;
        }
    double tolerance = options ? options->tolerance : 0;
    if (!(tolerance >= 0)) {
        error_write(error, OVOID_ERROR_ARGUMENT, -1, "the tolerance %g is not a length >= 0", tolerance);
        return NULL;
    }
    grid g = {.half = vec3_clear_signs(half), .steps = find_steps(half, tolerance)};
    if (g.steps <= STEPS_MOST) return create_from_grid(&g, options, error);
    error_write(error, OVOID_ERROR_LIMIT, -1, "a tolerance of %g at a half axis of %g takes more than %d steps",
                tolerance, vec3_max_abs(half), (int)STEPS_MOST);
    return NULL;
}

ovoid_shape *ovoid_shape_create_ellipsoid(ovoid_vec3 half_axes, const ovoid_shape_options *options,
                                          ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_shape *, half_axes, create_ellipsoid(half_axes, options, error));
}
