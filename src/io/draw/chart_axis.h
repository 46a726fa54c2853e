// The axes of a chart, the area that they span, and the colours of what stands in it.
#ifndef OVOID_IO_DRAW_CHART_AXIS_H
#define OVOID_IO_DRAW_CHART_AXIS_H

#include "io/draw/svg.h"

#include "ovoid/io.h"

/// Values from `low` to `high` along pixels from `from` to `to`.
typedef struct axis {
    double low, high, from, to;
    int is_log;
} axis;

/// A value's pixel; NaN where the axis does not show it.
double axis_project(const axis *a, double value);

enum { TICKS_MAX = 64, SERIES_MAX = 12 };

/// The step from one label to the next of a length drawn over that many pixels: 1, 2 or 5 times a power of ten.
double axis_find_step(double length, double pixels);

/// The values to label, at most TICKS_MAX of them; returns their number.
size_t axis_find_ticks(const axis *a, double ticks[TICKS_MAX]);

typedef struct canvas {
    FILE *file;
    const ovoid_chart *chart;
    axis x, y;
} canvas;

/// The colour of series i, "#rrggbb": those of M. Okabe and K. Ito (2008), which colour-blind readers tell apart too.
const char *chart_get_color(size_t i);

/// The x of a series' value number i.
static inline double series_get_x(const ovoid_series *s, size_t i) { return s->x ? s->x[i] : (double)i; }

#endif
