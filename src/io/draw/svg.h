// Writing SVG: colours, paths in tenths of a pixel, texts.
#ifndef OVOID_IO_DRAW_SVG_H
#define OVOID_IO_DRAW_SVG_H

#include "linear/vec3.h"

#include <stdio.h>

/// A point of the picture, pixels from its upper left corner.
typedef struct vec2 {
    double x, y;
} vec2;

/// Red, green and blue from 0 to 1.
typedef struct color {
    double r, g, b;
} color;

/// The mixture a + t (b - a).
color color_mix(color a, color b, double t);
/// Writes "#rrggbb", terminated.
void color_write(color c, char out[8]);

/// A path under construction: points are rounded to tenths of a pixel and written relative to the last one.
typedef struct svg_path {
    FILE *file;
    long x, y; ///< the last point, tenths
} svg_path;

void svg_move(svg_path *path, vec2 to);
void svg_line(svg_path *path, vec2 to);
/// A cubic curve.
void svg_curve(svg_path *path, vec2 a, vec2 b, vec2 to);
void svg_close(svg_path *path);
/// A closed polygon of count points.
void svg_polygon(svg_path *path, const vec2 *points, size_t count);
/// center + u cos t + v sin t.
typedef struct ellipse {
    vec2 center, u, v;
} ellipse;

/// The arc of an ellipse, t from `from` to `to`, as cubic curves of at most 45 degrees (error below 1e-5
/// of the size). Starts a new line of the path.
void svg_arc(svg_path *path, const ellipse *of, double from, double to);

/// The approximate width of a text in pixels, without font tables; of common fonts none is wider by much.
double text_get_width(const char *text, double font_size);

/// A text as XML: escaped, control characters left out, bytes that are not UTF-8 replaced.
void svg_escape(FILE *file, const char *text);

#endif
