// What the parts of a picture share: the camera, the bodies as they are drawn, the places of texts.
#ifndef OVOID_IO_PICTURE_H
#define OVOID_IO_PICTURE_H

#include "io/svg.h"

#include "ovoid/io.h"

/// An orthographic camera: ellipsoids have ellipses as outlines, and one scale holds everywhere. right, up and eye are
/// orthonormal; eye points from the scene to the eye.
typedef struct camera {
    vec3 right, up, eye;
    vec3 center;  ///< a point of the scene, taken away first: scenes far from the origin keep their digits
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
/// Grows toward the eye.
static inline double camera_get_depth(const camera *c, vec3 p) { return vec3_dot(c->eye, vec3_sub(p, c->center)); }

/// An ellipsoid as center + sum of axis[i] u_i, |u| <= 1, world frame; u_i = dual[i] . (x - center). The axes need not
/// be orthogonal: any square root of Q will do.
typedef struct solid_ellipsoid {
    vec3 center, axis[3], dual[3];
    int is_solid; ///< it has a volume to speak of; else there are no duals
} solid_ellipsoid;

/// A body as it is drawn.
typedef struct figure {
    const ovoid_picture_body *body;
    ovoid_shape *rounded;         ///< of a body with a rounding radius: the hull of spheres at its vertices; owned
    ovoid_polytope polytope;      ///< what is drawn, body frame
    vec3 *points;                 ///< its vertices, world frame
    vec3 *normals;                ///< of its facets, world frame
    vec2 *pixels;                 ///< its vertices, projected
    solid_ellipsoid outer, inner; ///< by their principal axes
    solid_ellipsoid areas; ///< the inner one by the axes that bound its octants: those of Q^1/2, as in ovoid_areas
    int has_ellipsoids;    ///< those of a point or a segment are not drawn
    double ball;           ///< the radius of a ball, which has one vertex; 0: not a ball
    color base;
    int number;     ///< of the body, for names in the file
    vec2 low, high; ///< pixels that the points span
} figure;

/// Makes the figure of a body; the pixels come later. figure_clear frees it also after a failure.
ovoid_code figure_make(figure *f, const ovoid_picture_body *body, int number, const char *path, ovoid_error *error);
void figure_clear(figure *f);
/// Fills in pixels, low and high.
void figure_project(figure *f, const camera *c);

/// The options with their defaults filled in, and where to write.
typedef struct drawing {
    FILE *file;
    camera camera;
    uint32_t width, height, layers;
} drawing;

/// Draws the faces that look away from the eye, or toward it; edges and outline with them.
ovoid_code figure_draw_back(const figure *f, const drawing *d, ovoid_error *error);
ovoid_code figure_draw_front(const figure *f, const drawing *d, ovoid_error *error);

/// The half of the outer ellipsoid behind its centre: a faint fill and lines; the half before it: lines and outline.
void figure_draw_outer_back(const figure *f, const drawing *d);
void figure_draw_outer_front(const figure *f, const drawing *d);
/// The inner ellipsoid, solid.
void figure_draw_inner(const figure *f, const drawing *d);

/// The tint of an octant; bit i is set where u_i < 0.
color octant_get_color(int octant);

/// The smallest box of pixels that holds the outline of an ellipsoid.
void ellipsoid_get_extent(const solid_ellipsoid *e, const camera *c, vec2 *low, vec2 *high);

/// Texts that have their place: later ones keep clear of them.
enum { LABELS_MAX = 256 };
typedef struct labels {
    vec2 low[LABELS_MAX], high[LABELS_MAX];
    size_t count;
    vec2 frame_low, frame_high;
} labels;

/// Keeps a box of the picture free.
void labels_block(labels *l, vec2 low, vec2 high);
/// The centre of a text of that size near a point, off it by about `gap`; it keeps clear of others where it can.
vec2 labels_place(labels *l, vec2 near, vec2 size, double gap);
/// The width of a text, about: there are no font tables here.
double text_get_width(const char *text, double font_size);

/// Names at the figures.
void draw_names(const figure *figures, size_t count, const drawing *d, labels *l);
/// Witness points, the lines between them and their lengths.
void draw_links(const ovoid_picture *picture, const drawing *d, labels *l);
/// Legend and scale bar.
void draw_legend(const ovoid_picture *picture, const drawing *d, labels *l);

#endif
