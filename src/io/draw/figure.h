// A picture's camera, and the bodies as they are drawn.
#ifndef OVOID_IO_DRAW_FIGURE_H
#define OVOID_IO_DRAW_FIGURE_H

#include "io/draw/svg.h"

#include "ovoid/io.h"

/// An orthographic camera: ellipsoids have ellipses as outlines, and one scale holds everywhere. right, up and eye are
/// orthonormal; eye points from the scene to the eye.
typedef struct camera {
    vec3 right, up, eye;
    vec3
        center; ///< a point of the scene that is subtracted first, so that scenes far from the origin keep their digits
    double scale; ///< pixels per length
    vec2 origin;  ///< the pixel of the centre
} camera;

/// The camera that looks along -view; up is z where it can be.
camera camera_make(vec3 view);
static inline vec2 camera_project_vector(const camera *c, vec3 v) {
    return (vec2){c->scale * vec3_dot(c->right, v), -c->scale * vec3_dot(c->up, v)};
}
static inline vec2 camera_project(const camera *c, vec3 p) {
    vec2 v = camera_project_vector(c, vec3_sub(p, c->center));
    return (vec2){c->origin.x + v.x, c->origin.y + v.y};
}
/// The depth of a point along the view; larger is nearer to the eye.
static inline double camera_get_depth(const camera *c, vec3 p) { return vec3_dot(c->eye, vec3_sub(p, c->center)); }

/// An ellipsoid as center + sum of axis[i] u_i, |u| <= 1, world frame; u_i = dual[i] . (x - center). The axes need not
/// be orthogonal: any square root of Q will do.
typedef struct solid_ellipsoid {
    vec3 center, axis[3], dual[3];
    int is_solid; ///< 1: its volume is not negligible; 0: there are no duals
} solid_ellipsoid;

/// A body as it is drawn.
typedef struct figure {
    const ovoid_picture_body *body;
    ovoid_shape *rounded; ///< of a body with a rounding radius: the hull of spheres at its vertices, owned; else NULL
    ovoid_polytope polytope;      ///< what is drawn, body frame
    vec3 *points;                 ///< its vertices, world frame
    vec3 *normals;                ///< of its facets, world frame
    vec2 *pixels;                 ///< its vertices, projected
    solid_ellipsoid outer, inner; ///< by their principal axes
    solid_ellipsoid areas; ///< the inner one by the axes that bound its octants: those of Q^1/2, as in ovoid_areas
    int has_ellipsoids;    ///< 0 for a point or a segment, whose ellipsoids are not drawn
    double ball;           ///< the radius of a ball, which has one vertex; 0: not a ball
    color base;
    int number;     ///< of the body, for names in the file
    vec2 low, high; ///< pixels that the points span
} figure;

/// Makes the figure of a body, f->number; the pixels come later. figure_clear frees it also after a failure.
ovoid_code figure_make(figure *f, const ovoid_picture_body *body, const char *path, ovoid_error *error);
void figure_clear(figure *f);
/// Fills in pixels, low and high.
void figure_project(figure *f, const camera *c);

/// The options with their defaults filled in, and where to write.
typedef struct drawing {
    FILE *file;
    camera camera;
    uint32_t width, height, layers;
} drawing;

#endif
