// Commit, compiler and flags come from the build; the processor is the one that runs this.
#include "common/build.h"

#include <stdio.h>

/// Made at build time, see commit.cmake.
extern const char bench_commit[];

const char *get_build(void) {
    static char text[1024], processor[256] = "unknown";
    FILE *file = fopen("/proc/cpuinfo", "r");
    char line[256];
    while (file && fgets(line, sizeof line, file))
        if (sscanf(line, "model name : %255[^\n]", processor) == 1) break;
    if (file) (void)fclose(file);
    (void)snprintf(text, sizeof text,
                   "commit %s, compiler " OVOID_BENCH_COMPILER ", flags " OVOID_BENCH_FLAGS ", processor %s",
                   bench_commit, processor);
    return text;
}
