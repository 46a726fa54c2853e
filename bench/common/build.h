// The build and the processor of the measurements.
#ifndef OVOID_BENCH_COMMON_BUILD_H
#define OVOID_BENCH_COMMON_BUILD_H

/// "commit ..., compiler ..., flags ..., processor ...".
const char *get_build(void);

#endif
