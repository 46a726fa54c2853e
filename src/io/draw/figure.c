// Bodies as they are drawn. A rounded body is drawn as the hull of small spheres of points at its vertices, so that
// capsules and rounded boxes need no code of their own; a ball alone is a disc.
#include "io/draw/figure.h"

#include "io/text.h"
#include "linear/rotation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Points of one hull of spheres in all: enough to look round, few enough to be quick.
enum { ROUND_POINTS = 2000, SPHERE_POINTS_MIN = 24, SPHERE_POINTS_MAX = 400 };

camera camera_make(vec3 view) {
    camera c = {.scale = 1};
    c.eye = vec3_unit(view);
    vec3 up = fabs(c.eye.z) > 0.999 ? (vec3){0, 1, 0} : (vec3){0, 0, 1};
    c.right = vec3_unit(vec3_cross(up, c.eye));
    c.up = vec3_cross(c.eye, c.right);
    return c;
}

// ---- rounded bodies

// Point i of n on the unit sphere, evenly spread along a spiral (R. Swinbank, R. J. Purser, Fibonacci grids, 2006).
static vec3 sphere_point(size_t i, size_t n) {
    double z = 1 - (2 * (double)i + 1) / (double)n, r = sqrt(1 - z * z), angle = 2.399963229728653 * (double)i;
    return (vec3){r * cos(angle), r * sin(angle), z};
}

// The hull of spheres at the vertices; the points are relative to the polytope's origin.
static ovoid_shape *make_rounded(const ovoid_polytope *polytope, double radius, ovoid_error *error) {
    size_t n = ROUND_POINTS / polytope->vertex_count;
    n = n < SPHERE_POINTS_MIN ? SPHERE_POINTS_MIN : n > SPHERE_POINTS_MAX ? SPHERE_POINTS_MAX : n;
    size_t count = n * polytope->vertex_count;
    double *xyz = malloc(3 * count * sizeof *xyz);
    if (!xyz) {
        io_fail_memory(error, "picture");
        return NULL;
    }
    for (size_t i = 0; i < count; i++) {
        vec3 p = vec3_add_scaled(vec3_at(polytope->vertices, i / n), sphere_point(i % n, n), radius);
        memcpy(xyz + 3 * i, &p, sizeof p);
    }
    // The ellipsoids of this hull are not drawn, so a coarse fit is enough.
    ovoid_shape_options options = {.gap = 0.5};
    ovoid_shape *shape = ovoid_shape_create_from_points(xyz, count, &options, error);
    free(xyz);
    return shape;
}

// ---- figures

/// Blue, orange, green, violet, rose, teal, ochre, grey: distinct for colour-blind readers too, and muted.
static const color palette[] = {{0.25, 0.47, 0.72}, {0.90, 0.55, 0.24}, {0.33, 0.63, 0.42}, {0.58, 0.43, 0.71},
                                {0.80, 0.38, 0.44}, {0.25, 0.62, 0.67}, {0.71, 0.57, 0.27}, {0.48, 0.52, 0.58}};

/// Where a body's frame is in the world: x -> position + rotation (origin + x).
typedef struct body_frame {
    mat3 rotation;
    vec3 origin, position;
} body_frame;

// An ellipsoid by its principal axes, or by the columns of the symmetric root Q^1/2.
static solid_ellipsoid make_ellipsoid(const ovoid_ellipsoid *e, const body_frame *frame, int symmetric) {
    eigen3 eigen = sym3_compute_eigen(e->q);
    const vec3 rows[3] = {eigen.v.r0, eigen.v.r1, eigen.v.r2};
    double radius[3];
    for (int i = 0; i < 3; i++) radius[i] = sqrt(fmax(eigen.value[i], 0));
    solid_ellipsoid s = {.is_solid = radius[0] > 1e-6 * radius[2]};
    s.center = vec3_add(frame->position, mat3_mul_vec3(frame->rotation, vec3_add(frame->origin, e->center)));
    for (int i = 0; i < 3; i++) {
        // Principal: u = e_i of the basis. Symmetric: u = e_i of the body, whose coordinates are a column of the basis.
        vec3 axis = {0, 0, 0}, dual = {0, 0, 0};
        for (int k = 0; k < 3; k++) {
            const double row[3] = {rows[k].x, rows[k].y, rows[k].z};
            double part = symmetric ? row[i] : k == i;
            axis = vec3_add_scaled(axis, rows[k], part * radius[k]);
            if (s.is_solid) dual = vec3_add_scaled(dual, rows[k], part / radius[k]);
        }
        s.axis[i] = mat3_mul_vec3(frame->rotation, axis);
        s.dual[i] = mat3_mul_vec3(frame->rotation, dual);
    }
    return s;
}

ovoid_code figure_make(figure *f, const ovoid_picture_body *body, const char *path, ovoid_error *error) {
    int number = f->number;
    size_t tone = body->group ? body->group - 1 : (size_t)number;
    *f = (figure){.body = body, .number = number, .base = palette[tone % (sizeof palette / sizeof *palette)]};
    ovoid_polytope own = ovoid_shape_get_polytope(body->shape);
    vec3 origin = own.origin;
    double radius = ovoid_shape_get_radius(body->shape);
    f->has_ellipsoids = own.rank >= 2;
    f->ball = own.vertex_count == 1 ? radius : 0;
    if (radius > 0 && f->ball == 0) {
        f->rounded = make_rounded(&own, radius, error);
        if (!f->rounded) return OVOID_ERROR_HULL;
    }
    f->polytope = f->rounded ? ovoid_shape_get_polytope(f->rounded) : own;
    vec3 drawn_origin = f->rounded ? vec3_add(origin, f->polytope.origin) : origin;
    f->points = malloc((f->polytope.vertex_count + 1) * sizeof *f->points);
    f->normals = malloc((f->polytope.facet_count + 1) * sizeof *f->normals);
    f->pixels = malloc((f->polytope.vertex_count + 1) * sizeof *f->pixels);
    if (!f->points || !f->normals || !f->pixels) return io_fail_memory(error, path);
    mat3 rotation = quat_to_mat3(body->pose.rotation);
    for (uint32_t i = 0; i < f->polytope.vertex_count; i++) {
        vec3 local = vec3_add(drawn_origin, vec3_at(f->polytope.vertices, i));
        f->points[i] = vec3_add(body->pose.position, mat3_mul_vec3(rotation, local));
    }
    for (uint32_t i = 0; i < f->polytope.facet_count; i++)
        f->normals[i] = mat3_mul_vec3(rotation, f->polytope.planes[i].normal);
    ovoid_ellipsoid outer = ovoid_shape_get_outer(body->shape).ellipsoid;
    ovoid_ellipsoid inner = ovoid_shape_get_inner(body->shape).ellipsoid;
    body_frame frame = {rotation, origin, body->pose.position};
    f->outer = make_ellipsoid(&outer, &frame, 0);
    f->inner = make_ellipsoid(&inner, &frame, 0);
    f->areas = make_ellipsoid(&inner, &frame, 1);
    return OVOID_OK;
}

void figure_clear(figure *f) {
    ovoid_shape_destroy(f->rounded);
    free(f->points);
    free(f->normals);
    free(f->pixels);
}

void figure_project(figure *f, const camera *c) {
    f->low = (vec2){INFINITY, INFINITY};
    f->high = (vec2){-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < f->polytope.vertex_count; i++) {
        vec2 p = f->pixels[i] = camera_project(c, f->points[i]);
        double r = f->ball * c->scale;
        f->low = (vec2){fmin(f->low.x, p.x - r), fmin(f->low.y, p.y - r)};
        f->high = (vec2){fmax(f->high.x, p.x + r), fmax(f->high.y, p.y + r)};
    }
}
