#define _GNU_SOURCE
#include "common/module.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

module_function module_load(const char *path, const char *name) {
    void *module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!module) {
        (void)fprintf(stderr, "bench: %s\n", dlerror());
        return NULL;
    }
    // C has no conversion of an object pointer to a function pointer; POSIX guarantees that copying the bytes works.
    void *symbol = dlsym(module, name);
    module_function function = NULL;
    memcpy(&function, &symbol, sizeof function);
    if (!function) (void)fprintf(stderr, "bench: %s exports no %s\n", path, name);
    return function;
}
