// Several charts on one page.
#ifndef OVOID_BENCH_COMMON_SHEET_H
#define OVOID_BENCH_COMMON_SHEET_H

#include <ovoid/io.h>

/// Charts of one size side by side, a caption below, as one SVG file. 0: not written.
int sheet_write(const char *path, const ovoid_chart *charts, uint32_t count, uint32_t columns, const char *caption);

#endif
