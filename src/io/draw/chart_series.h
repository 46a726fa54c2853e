// The series of a chart.
#ifndef OVOID_IO_DRAW_CHART_SERIES_H
#define OVOID_IO_DRAW_CHART_SERIES_H

#include "io/draw/chart_axis.h"

/// Draws all series.
void chart_draw_series(const canvas *c);

/// Draws the mark that stands for series i in the legend, centred at a point.
void chart_draw_key(const canvas *c, size_t i, vec2 at);

#endif
