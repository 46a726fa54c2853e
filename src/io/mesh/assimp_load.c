// Loading Assimp: by the name in which its binary interface has a version, then by the path that the build found.
#ifdef OVOID_WITH_ASSIMP

#define _XOPEN_SOURCE 700 // pthread_once
#include "io/mesh/assimp_load.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

static assimp_functions functions;
static int is_loaded;
static char failure[300];

static void load(void) {
    static const char *const paths[] = {OVOID_ASSIMP_NAME, OVOID_ASSIMP_PATH};
    const struct {
        const char *name;
        void *function;
    } wanted[] = {
        {"aiCreatePropertyStore", &functions.create_store},   {"aiSetImportPropertyInteger", &functions.set_integer},
        {"aiReleasePropertyStore", &functions.release_store}, {"aiImportFileExWithProperties", &functions.import},
        {"aiReleaseImport", &functions.release_import},       {"aiGetErrorString", &functions.get_error},
        {"aiIdentityMatrix4", &functions.set_identity},       {"aiMultiplyMatrix4", &functions.multiply}};
    void *library = NULL;
    for (size_t i = 0; i < sizeof paths / sizeof *paths && !library; i++)
        library = dlopen(paths[i], RTLD_LAZY | RTLD_LOCAL);
    is_loaded = library != NULL;
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted && is_loaded; i++) {
        void *symbol = dlsym(library, wanted[i].name);
        is_loaded = symbol != NULL;
        memcpy(wanted[i].function, &symbol, sizeof symbol);
    }
    const char *why = is_loaded ? NULL : dlerror();
    if (why) (void)snprintf(failure, sizeof failure, "%s", why);
}

const assimp_functions *assimp_load(const char **why) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    (void)pthread_once(&once, load);
    *why = failure;
    return is_loaded ? &functions : NULL;
}

#else

// Without Assimp there is nothing to load.
typedef int assimp_load_nothing;

#endif
