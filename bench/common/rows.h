// Measured curves: points named by chart and line.
#ifndef OVOID_BENCH_COMMON_ROWS_H
#define OVOID_BENCH_COMMON_ROWS_H

#include "common/measure.h"

typedef struct row {
    const char *chart, *x_name, *y_name, *line; ///< not copied
    double x;
    timing y;             ///< in the unit of y_name
    double judged, wrong; ///< the number of answers, if they are judged
} row;

enum { ROWS_MOST = 400 };
typedef struct rows {
    row items[ROWS_MOST];
    uint32_t count;
} rows;

/// Adds the point and prints it.
void rows_add(rows *all, row one);

/// 0: not written.
int rows_write_csv(const rows *all, const char *path);
int rows_write_svg(const rows *all, const char *path);

#endif
