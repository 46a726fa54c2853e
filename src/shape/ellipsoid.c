// Ellipsoids: their numbered points, and their polyhedron as a shape (polytope/ellipsoid_grid.h). The polyhedron holds
// a ball in units of the half axes, so that no point of the ellipsoid is farther from it than the largest half axis
// times what the ball leaves of the unit sphere.
#include "shape/ellipsoid.h"

#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "polytope/ellipsoid_grid.h"
#include "shape/create.h"
#include "shape/rim.h"

enum { STEPS_DEFAULT = 3 };

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
    return ellipsoid_grid_get_point(half, x, y, z);
}

// ---- the shape

// How far the ellipsoid may be outside of its polyhedron.
static double find_outside(const ellipsoid_grid *g) {
    return vec3_max_abs(g->half) * ((1 - g->ball) + g->steps * (32 * 0x1p-53));
}

static double find_inside(vec3 half) { return vec3_max_abs(half) * (8 * 0x1p-53); }

int ellipsoid_is_held(const ovoid_shape *s, vec3 half) {
    ellipsoid_grid grid;
    if (!ellipsoid_grid_find(shape_vertices(s), s->vertex_count, &grid)) return 0;
    vec3 off = vec3_sub(grid.half, half), axis = s->allowance.axis;
    return !(vec3_max_abs(off) > 0) && !(vec3_max_abs(s->origin) > 0) && !(vec3_max_abs(axis) > 0) &&
           s->allowance.outside == find_outside(&grid) && s->allowance.inside == find_inside(half);
}

// The fewest steps that meet the tolerance, or more than there may be.
static uint32_t find_steps(vec3 half, double tolerance) {
    if (!(tolerance > 0)) return STEPS_DEFAULT;
    uint32_t n = GRID_STEPS_LEAST;
    while (n <= GRID_STEPS_MOST && vec3_max_abs(half) / ((double)n * n) > tolerance) n++;
    return n;
}

static ovoid_shape *create_from_grid(vec3 half, uint32_t n, const ovoid_shape_options *given, ovoid_error *error) {
    ovoid_shape_options o;
    if (shape_options_make(given, &o, error) != OVOID_OK) return NULL;
    ellipsoid_grid grid = {half, n, 1 - 1 / ((double)n * n)};
    // A flat or tiny one has no closed form, and no more than its polyhedron is known.
    int is_known = ellipsoid_grid_make(half, n, &grid) && !(o.allowance.outside > 0) && !(o.allowance.inside > 0);
    o.allowance.axis = (vec3){0, 0, 0};
    o.allowance.outside += find_outside(&grid);
    o.allowance.inside += find_inside(half);
    ovoid_allocator allocator = allocator_make(o.allocator);
    size_t count = ellipsoid_grid_count_vertices(n);
    double *xyz = allocator_allocate(&allocator, count, 3 * sizeof *xyz);
    if (!xyz) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for an ellipsoid of %zu vertices", count);
        return NULL;
    }
    ellipsoid_grid_fill_vertices(half, n, xyz);
    ovoid_shape *shape = shape_create_from_points((xyz_points){xyz, count}, &o, error);
    allocator_release(&allocator, xyz);
    if (shape && is_known) shape->round = (ovoid_round){.kind = OVOID_ROUND_ELLIPSOID, .half_axes = half};
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
    if (!shape_tolerance_is_length(tolerance, error)) return NULL;
    uint32_t steps = find_steps(half, tolerance);
    if (steps <= GRID_STEPS_MOST) return create_from_grid(vec3_clear_signs(half), steps, options, error);
    error_write(error, OVOID_ERROR_LIMIT, -1, "a tolerance of %g at a half axis of %g takes more than %d steps",
                tolerance, vec3_max_abs(half), (int)GRID_STEPS_MOST);
    return NULL;
}

ovoid_shape *ovoid_shape_create_ellipsoid(ovoid_vec3 half_axes, const ovoid_shape_options *options,
                                          ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_shape *, half_axes, create_ellipsoid(half_axes, options, error));
}
