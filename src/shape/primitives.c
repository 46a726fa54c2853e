// Boxes, spheres, capsules, cylinders and cones: a few points and a radius.
#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "linear/vec3.h"
#include "polytope/points.h"
#include "shape/block.h"
#include "shape/create.h"

#include <string.h>

// Checks a length of a primitive: finite and not negative.
static int is_length_or(ovoid_code negative, double length, const char *name, ovoid_error *error) {
    if (!isfinite(length))
        error_write(error, OVOID_ERROR_NOT_FINITE, -1, "the %s is not finite", name);
    else if (length < 0)
        error_write(error, negative, -1, "the %s %g is negative", name, length);
    else
        return 1;
    return 0;
}

static int is_length(double length, const char *name, ovoid_error *error) {
    return is_length_or(OVOID_ERROR_ARGUMENT, length, name, error);
}

static int is_radius(double radius, ovoid_error *error) {
    return is_length_or(OVOID_ERROR_RADIUS, radius, "radius", error);
}

static ovoid_shape *create_box(ovoid_vec3 half, const ovoid_shape_options *options, ovoid_error *error) {
    if (!is_length(half.x, "half size in x", error) || !is_length(half.y, "half size in y", error) ||
        !is_length(half.z, "half size in z", error))
        return NULL;
    double xyz[24];
    for (int i = 0; i < 8; i++) {
        xyz[3 * i] = i & 1 ? half.x : -half.x;
        xyz[3 * i + 1] = i & 2 ? half.y : -half.y;
        xyz[3 * i + 2] = i & 4 ? half.z : -half.z;
    }
    return ovoid_shape_create_from_points(xyz, 8, options, error);
}

ovoid_shape *ovoid_shape_create_box(ovoid_vec3 half, const ovoid_shape_options *options, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_shape *, half, create_box(half, options, error));
}

// The shape of points, enlarged by a radius in addition to that of the options.
static ovoid_shape *create_rounded(xyz_points given, double radius, const ovoid_shape_options *options,
                                   ovoid_error *error) {
    ovoid_shape_options o;
    if (shape_options_make(options, &o, error) != OVOID_OK) return NULL;
    if (!is_radius(radius, error)) return NULL;
    o.radius += radius;
    return ovoid_shape_create_from_points(given.xyz, given.count, &o, error);
}

ovoid_shape *ovoid_shape_create_sphere(double radius, const ovoid_shape_options *options, ovoid_error *error) {
    const double xyz[3] = {0, 0, 0};
    ENVIRONMENT_RETURN(ovoid_shape *, radius, create_rounded((xyz_points){xyz, 1}, radius, options, error));
}

static ovoid_shape *create_capsule(double radius, double half_length, const ovoid_shape_options *options,
                                   ovoid_error *error) {
    if (!is_length(half_length, "half length", error)) return NULL;
    const double xyz[6] = {0, 0, -half_length, 0, 0, half_length};
    return create_rounded((xyz_points){xyz, 2}, radius, options, error);
}

ovoid_shape *ovoid_shape_create_capsule(double radius, double half_length, const ovoid_shape_options *options,
                                        ovoid_error *error) {
    double lengths[2] = {radius, half_length};
    ENVIRONMENT_RETURN(ovoid_shape *, lengths, create_capsule(lengths[0], lengths[1], options, error));
}

// The largest number of sides of a cylinder or cone.
enum { SIDES_MAX = 1 << 16 };

// `sides` points of a circle around z, from *xyz on.
static void fill_circle(double *xyz, double radius, double z, uint32_t sides) {
    for (uint32_t i = 0; i < sides; i++) {
        double angle = 6.283185307179586 * i / sides;
        xyz[3 * (size_t)i] = radius * cos(angle);
        xyz[3 * (size_t)i + 1] = radius * sin(angle);
        xyz[3 * (size_t)i + 2] = z;
    }
}

// A prism (two rings) or a pyramid (one ring) along z.
typedef struct turned {
    double radius, half_length;
    uint32_t sides, rings;
} turned;

static ovoid_shape *create_turned(const turned *t, const ovoid_shape_options *options, ovoid_error *error) {
    double radius = t->radius, half_length = t->half_length;
    uint32_t sides = t->sides, rings = t->rings;
    if (!is_radius(radius, error) || !is_length(half_length, "half length", error)) return NULL;
    if (sides < 3) {
        error_write(error, OVOID_ERROR_ARGUMENT, -1, "%u sides; at least 3 are needed", sides);
        return NULL;
    }
    if (sides > POINTS_MAX / 2) {
        error_write(error, OVOID_ERROR_LIMIT, -1, "%u sides; at most %zu are taken", sides, POINTS_MAX / 2);
        return NULL;
    }
    ovoid_allocator allocator = allocator_make(options ? options->allocator : NULL);
    size_t count = (size_t)sides * rings + (rings == 1);
    double *xyz = allocator_allocate(&allocator, count, 3 * sizeof *xyz);
    if (!xyz) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for %u sides", sides);
        return NULL;
    }
    fill_circle(xyz, radius, -half_length, sides);
    if (rings == 2) {
        // The same corners, higher up.
        memcpy(xyz + 3 * (size_t)sides, xyz, 3 * (size_t)sides * sizeof *xyz);
        for (size_t i = sides; i < count; i++) xyz[3 * i + 2] = half_length;
    } else {
        double *apex = xyz + 3 * (size_t)sides;
        apex[0] = apex[1] = 0;
        apex[2] = half_length;
    }
    ovoid_shape *shape = ovoid_shape_create_from_points(xyz, count, options, error);
    allocator_release(&allocator, xyz);
    return shape;
}

// ---- round bodies, stored as polyhedra
//
// With the greatest angle g between neighbours of a circle of radius R, the cylinder's extreme points, those of its two
// circles, are within R (1 - cos(g / 2)) of the prism, measured across the axis; the distance from a convex body is a
// convex function, so no point of the cylinder is farther. Along the axis the cylinder does not exceed the prism, so
// the allowance has that axis. With u = 2^-53, rounding moves a corner along the circle by less than 32 u R and away
// from it by less than 4 u R; 64 u R and 8 u R cover both. A cone has the same circle, and its apex is exact.

// By how much the circle of radius 1 exceeds a regular polygon: 1 - cos(pi / n), rounding included.
static double compute_sagitta(double sides) {
    double s = sin(1.5707963267948966 / sides);
    return 2 * (s * s) + 64 * 0x1p-53;
}

// The fewest sides whose circle exceeds the polygon by at most `most`; more than SIDES_MAX if that many do not suffice.
static uint32_t find_sides(double most) {
    // sin x < x, so this is at least the number that is needed, and not much more.
    double sides = ceil(1.5707963267948966 / sqrt(most / 2));
    if (!(sides <= SIDES_MAX)) return SIDES_MAX + 1;
    if (sides < 3) sides = 3;
    while (sides > 3 && compute_sagitta(sides - 1) <= most) sides--;
    while (sides <= SIDES_MAX && compute_sagitta(sides) > most) sides++;
    return (uint32_t)sides;
}

static int is_along_z(ovoid_vec3 axis) { return !(fabs(axis.x) > 0) && !(fabs(axis.y) > 0) && fabs(axis.z) > 0; }

static ovoid_shape *create_round(const turned *t, const ovoid_shape_options *options, ovoid_error *error) {
    turned by = *t;
    ovoid_shape_options o = {0};
    if (options) o = *options;
    double tolerance = o.tolerance;
    if (!is_radius(by.radius, error)) return NULL;
    if (!shape_tolerance_is_length(tolerance, error)) return NULL;
    by.sides = by.radius > 0 ? find_sides(tolerance > 0 ? tolerance / by.radius : 0.005) : 3;
    if (by.sides > SIDES_MAX) {
        error_write(error, OVOID_ERROR_LIMIT, -1, "a tolerance of %g at a radius of %g takes more than %d sides",
                    tolerance, by.radius, (int)SIDES_MAX);
        return NULL;
    }
    int is_across = !(o.allowance.outside > 0) || is_along_z(o.allowance.axis);
    if (vec3_is_finite(o.allowance.axis)) o.allowance.axis = (ovoid_vec3){0, 0, is_across};
    o.allowance.outside += by.radius * compute_sagitta(by.sides);
    o.allowance.inside += by.radius * (8 * 0x1p-53);
    ovoid_shape *shape = create_turned(&by, &o, error);
    // An allowance given by the caller leaves the true body unknown.
    int is_known = !options || (!(options->allowance.outside > 0) && !(options->allowance.inside > 0));
    ovoid_round_kind kind = by.rings == 2 ? OVOID_ROUND_CYLINDER : OVOID_ROUND_CONE;
    if (shape && is_known && shape_has_axis(shape))
        shape->round = (ovoid_round){.kind = kind, .radius = by.radius, .half_length = by.half_length + 0.0};
    return shape;
}

ovoid_shape *ovoid_shape_create_cylinder(double radius, double half_length, const ovoid_shape_options *options,
                                         ovoid_error *error) {
    turned prism = {radius, half_length, 0, 2};
    ENVIRONMENT_RETURN(ovoid_shape *, prism, create_round(&prism, options, error));
}

ovoid_shape *ovoid_shape_create_cone(double radius, double half_length, const ovoid_shape_options *options,
                                     ovoid_error *error) {
    turned pyramid = {radius, half_length, 0, 1};
    ENVIRONMENT_RETURN(ovoid_shape *, pyramid, create_round(&pyramid, options, error));
}

ovoid_shape *ovoid_shape_create_prism(const ovoid_prism *prism, const ovoid_shape_options *options,
                                      ovoid_error *error) {
    OVOID_ASSERT(prism);
    turned by = {prism->radius, prism->half_length, prism->sides, 2};
    ENVIRONMENT_RETURN(ovoid_shape *, by, create_turned(&by, options, error));
}

ovoid_shape *ovoid_shape_create_pyramid(const ovoid_prism *prism, const ovoid_shape_options *options,
                                        ovoid_error *error) {
    OVOID_ASSERT(prism);
    turned by = {prism->radius, prism->half_length, prism->sides, 1};
    ENVIRONMENT_RETURN(ovoid_shape *, by, create_turned(&by, options, error));
}
