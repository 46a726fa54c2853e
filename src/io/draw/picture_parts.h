// The parts of a picture: faces, ellipsoids, texts; picture.c composes them.
#ifndef OVOID_IO_DRAW_PICTURE_PARTS_H
#define OVOID_IO_DRAW_PICTURE_PARTS_H

#include "io/draw/figure.h"

/// Draws the faces that look away from the eye, or toward it; edges and outline with them.
ovoid_code figure_draw_back(const figure *f, const drawing *d, ovoid_error *error);
ovoid_code figure_draw_front(const figure *f, const drawing *d, ovoid_error *error);

/// Draws the body's mesh, which must have faces, in the place of its polyhedron.
ovoid_code figure_draw_mesh(const figure *f, const drawing *d, ovoid_error *error);
/// The shade of a facet of a body of that colour; normal: unit, toward the eye.
color facet_get_color(color base, vec3 normal, const camera *c);

/// The half of the outer ellipsoid behind its centre: a faint fill and lines; the half before it: lines and outline.
void figure_draw_outer_back(const figure *f, const drawing *d);
void figure_draw_outer_front(const figure *f, const drawing *d);
/// The inner ellipsoid, solid.
void figure_draw_inner(const figure *f, const drawing *d);

/// The tint of an octant; bit i is set where u_i < 0.
color octant_get_color(int octant);

/// The smallest box of pixels that holds the outline of an ellipsoid.
void ellipsoid_get_extent(const solid_ellipsoid *e, const camera *c, vec2 *low, vec2 *high);

/// The boxes that later texts avoid.
enum { LABELS_MAX = 2048 };
typedef struct labels {
    vec2 low[LABELS_MAX], high[LABELS_MAX];
    size_t count;
    vec2 frame_low, frame_high;
} labels;

/// Keeps texts out of a box of the picture.
void labels_block(labels *l, vec2 low, vec2 high);
/// A text of that size about `gap` from a point.
typedef struct label {
    vec2 near, size;
    double gap;
} label;

/// Finds a place for a text, clear of earlier ones: its centre. 0 where there is no room.
int labels_place(labels *l, const label *text, vec2 *at);

/// The figures of a picture, and their numbers in the order of painting.
typedef struct figure_list {
    figure *figures;
    size_t *order;
    size_t count;
} figure_list;

/// Draws the names beside the figures, of those that are seen and where there is room.
void draw_names(const figure_list *list, const drawing *d, labels *l);
/// Draws witness points, the lines between them and their lengths.
void draw_links(const ovoid_picture *picture, const drawing *d, labels *l);
/// Draws the legend and the scale bar.
void draw_legend(const ovoid_picture *picture, const drawing *d, labels *l);

#endif
