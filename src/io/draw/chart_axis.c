// The axis of a chart: its range, and the values that it labels.
#include "io/draw/chart_axis.h"

#include <math.h>

/// Pixels from one label to the next, at least.
enum { TICK_ROOM = 45 };

const char *chart_get_color(size_t i) {
    static const char *const colors[SERIES_MAX] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
                                                   "#666666", "#8c6bb1", "#a6761d", "#1b7837", "#b2182b", "#222222"};
    return colors[i % SERIES_MAX];
}

double axis_project(const axis *a, double value) {
    if (!isfinite(value) || (a->is_log && value <= 0)) return NAN;
    double low = a->is_log ? log10(a->low) : a->low, high = a->is_log ? log10(a->high) : a->high;
    double t = ((a->is_log ? log10(value) : value) - low) / (high - low);
    return a->from + fmin(fmax(t, -0.01), 1.01) * (a->to - a->from);
}

double axis_find_step(double length, double pixels) {
    double rough = length / (pixels / TICK_ROOM), power = pow(10, floor(log10(rough))), part = rough / power;
    return power * (part <= 1.001 ? 1 : part <= 2.001 ? 2 : part <= 5.001 ? 5 : 10);
}

static size_t find_log_ticks(const axis *a, double ticks[TICKS_MAX]) {
    static const double parts[] = {1, 2, 5};
    double first = floor(log10(a->low)), last = ceil(log10(a->high));
    int step = last - first > 12 ? (int)ceil((last - first) / 10) : 1, dense = log10(a->high / a->low) <= 3;
    size_t count = 0;
    for (double e = first; e <= last; e += step)
        for (int k = 0; k < (dense ? 3 : 1); k++) {
            double value = parts[k] * pow(10, e);
            int inside = value >= a->low * 0.999 && value <= a->high * 1.001;
            if (inside && count < TICKS_MAX) ticks[count++] = value;
        }
    return count;
}

size_t axis_find_ticks(const axis *a, double ticks[TICKS_MAX]) {
    if (a->is_log) return find_log_ticks(a, ticks);
    double step = axis_find_step(a->high - a->low, fabs(a->to - a->from));
    size_t count = 0;
    for (double k = ceil(a->low / step - 1e-6); k * step <= a->high + 1e-6 * step && count < TICKS_MAX; k++)
        ticks[count++] = k * step;
    return count;
}
