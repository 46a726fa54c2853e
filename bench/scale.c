#include "scale.h"
int scale_run(const char *csv, const char *svg, uint32_t m, int s) { (void)csv; (void)svg; (void)m; (void)s; return 1; }
